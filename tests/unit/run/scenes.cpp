#include "scenes.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace undex::run::test {

scene::Scene read_text(const std::string& text, const std::vector<scene::Override>& overrides) {
  static int count = 0;
  const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                     ("undex_run_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".toml");
  std::ofstream(path) << text;
  struct Remover {
    std::filesystem::path path;
    ~Remover() { std::filesystem::remove(path); }
  } remover{path};
  return scene::read(path, {}, overrides);
}

void run_to(Simulation& simulation, double end) {
  while (simulation.time() < end * (1 - 1e-12)) simulation.advance(end);
}

const std::string plate_on_water = R"(
end_time = 1e-3
threads = 1
[resolution]
spacing = 0.002
fit = "water"
[symmetry]
planes = ["x", "y"]
[[bodies]]
name = "water"
shape = {type = "box", low = [-0.008, -0.008, -0.032], high = [0.008, 0.008, 0]}
material = "water-tait-cutoff"
pressure = 1e5
[[walls]]
name = "duct"
shape = {type = "box", low = [-0.008, -0.008, -0.032], high = [0.008, 0.008, 0.03]}
faces = {z_high = "open"}
[structure]
name = "plate"
shape = {type = "plate", low = [-0.008, -0.008, 0], high = [0.008, 0.008, 0.006]}
cells = {x = 2, y = 2, z = 3}
material = {rho0 = 2700, young_modulus = 7.1e10, poisson_ratio = 0.33, flow = {law = "elastic"}}
wet = ["z_low"]
supports = [{face = "x_high", fixed = ["x"]}, {face = "y_high", fixed = ["y"]}]
)";

}  // namespace undex::run::test
