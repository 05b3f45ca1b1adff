#include "scratch.hpp"

#include "core/errors.hpp"
#include "judge/comparisons.hpp"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <stdexcept>

namespace undex::scene::test {

Scratch::Scratch() {
  static std::atomic<int> count{0};
  folder_ = std::filesystem::temp_directory_path() / ("undex_scene_" + std::to_string(getpid()) + "_" + std::to_string(count++));
  std::filesystem::create_directories(folder_);
}
Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::filesystem::path Scratch::write(const std::string& text, const std::string& name) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
  return folder_ / name;
}

Scene read(const std::filesystem::path& path, const std::vector<Override>& overrides) {
  return scene::read(path, judge::comparison_kinds(), overrides);
}

Study read_study(const std::filesystem::path& path) { return scene::read_study(path, judge::comparison_kinds()); }

Scene read_text(const std::string& text, const std::vector<Override>& overrides) {
  const Scratch scratch;
  return read(scratch.write(text), overrides);
}

std::string mistakes(const std::string& text, const std::vector<Override>& overrides) {
  try {
    read_text(text, overrides);
    return "";
  } catch (const SceneError& error) {
    std::string all;
    for (const Finding& finding : error.findings())
      all += (finding.where.line > 0 ? std::to_string(finding.where.line) + ':' + std::to_string(finding.where.column) + ": "
                                     : std::string()) +
             finding.message + '\n';
    return all;
  }
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const auto at = text.find(old);
  if (at == std::string::npos || text.find(old, at + 1) != std::string::npos)
    throw std::logic_error("not exactly once in the scene: " + old);
  return text.replace(at, old.size(), replacement);
}

const std::string coupled_tube = R"(end_time = 1e-5

[resolution]
spacing = 0.002

[symmetry]
planes = ["x", "y", "z"]

[[bodies]]
name = "charge"
shape = {type = "sphere", radius = 0.0072}
material = "petn"

[[bodies]]
name = "water"
shape = {type = "cylinder", radius = 0.044, low = -0.1, high = 0.1}
subtract = ["charge"]
material = "water-tait"
pressure = 1e5

[structure]
shape = {type = "tube", inner_radius = 0.044, outer_radius = 0.05, low = -0.1, high = 0.1}
cells = {through = 2, around = 32, along = 20}
material = "al-5083-h116"
wet = ["inner"]

[[probes]]
name = "wall"
kind = "wall"
point = [0.044, 0, 0]

[[probes]]
name = "outer"
kind = "structure"
point = [0.05, 0, 0]
)";

const std::string two_gases = R"(dimension = 1
end_time = 0.1

[resolution]
spacing = 0.01

[[bodies]]
name = "left"
shape = {type = "box", low = 0, high = 0.5}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 2.5

[[bodies]]
name = "right"
shape = {type = "box", low = 0.5, high = 1}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
density = 0.125
energy = 2
)";

const std::string impact = R"(end_time = 1e-5

[resolution]
spacing = 0.001

[symmetry]
planes = ["x"]

[[solids]]
name = "ball"
shape = {type = "sphere", center = [0, 0, 0.0121], radius = 0.01}
material = "al-6061-t6"
velocity = [0, 0, -1000]

[[solids]]
name = "plate"
shape = {type = "box", low = [-0.05, -0.05, -0.002], high = [0.05, 0.05, 0.002]}
material = "al-6061-t6"

[[planes]]
axis = "z"
position = -0.01

[[probes]]
name = "middle"
point = [0, 0, -0.002]
)";

const std::string bathed_disc = R"(dimension = 2
end_time = 1e-5

[resolution]
spacing = 0.001

[[bodies]]
name = "water"
shape = {type = "box", low = [-0.03, -0.03], high = [0.03, 0.03]}
subtract = ["disc"]
material = "water-tait"

[[solids]]
name = "disc"
shape = {type = "cylinder", radius = 0.01}
material = "copper-ofhc"
wet = ["side"]

[[probes]]
name = "rim"
kind = "wall"
point = [0.01, 0]
)";

}  // namespace undex::scene::test
