// Tait's pressure of compressed water, and the particles of a box.
#include <cstdio>

#include "materials/tait_water.hpp"
#include "sph_fluid/lattice.hpp"

int main() {
  std::printf("pressure %.6e\n", undex::materials::TaitWater().evaluate(1100.0, 0.0).pressure);
  undex::Shape box;
  box.base = undex::Box{.low = {0, 0, 0}, .high = {0.03, 0.02, 0.01}};
  undex::sph::Settings settings;
  settings.dimension = 3;
  const auto particles = undex::sph::fill(undex::sph::cartesian({0, 0, 0}, 0.001, 3), settings, box, "box");
  std::printf("particles %zu\n", particles.position.size());
}
