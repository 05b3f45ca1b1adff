#include "sph_fluid/lattice.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "sph_fluid/lattice_grid.hpp"
#include "sph_fluid/pairs/kernels.hpp"

namespace undex::sph {
namespace {

Bounds kept_window(const Settings& settings, Bounds box) {
  for (int a = 0; a < 3; ++a)
    if (settings.symmetry.axis[a]) box.low[a] = std::max(box.low[a], 0.0);
  return box;
}

}  // namespace

double lattice_factor(KernelName kernel, double eta, int dimension) {
  return with_kernel(kernel, [&](auto k) { return lattice_factor<decltype(k)>(eta, dimension); });
}

double kernel_support(KernelName kernel) {
  return with_kernel(kernel, [](auto k) { return k.support; });
}

double smoothing_length(const Settings& settings, double spacing) { return settings.numerics.eta * spacing; }

BodyParticles fill(const Grid& grid, const Settings& settings, const Shape& shape, const std::string& who) {
  const Bounds box = bounds(shape, settings.dimension);
  BodyParticles out;
  double sum = 0;
  walk(grid, settings, box, [&](const Vec3& x, double cell_volume) {
    if (signed_distance(shape, x, settings.dimension) >= 0.0) return;
    out.position.push_back(x);
    out.volume.push_back(settings.axisymmetric ? 2.0 * std::numbers::pi * x[0] * cell_volume : cell_volume);
    sum += out.volume.back();
  });
  if (out.position.empty())
    throw std::invalid_argument(who + " gets no particle: it is smaller than the spacing or lies outside the kept part");
  const Bounds kept = kept_window(settings, box);
  const double scale =
      (settings.axisymmetric ? volume_of_revolution(shape, kept) : volume(shape, kept, settings.dimension)) / sum;
  for (double& cell_volume : out.volume) cell_volume *= scale;
  return out;
}

std::vector<BodyParticles> fill_bodies(const Settings& settings) {
  std::vector<BodyParticles> result;
  for (const Body& body : settings.bodies)
    result.push_back(fill(body_grid(settings, body), settings, body.shape, "body '" + body.name + "'"));
  return result;
}

}  // namespace undex::sph
