// A study of one scene, a small one, is read, or refused with SceneError or FileError.
#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "scene/study.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/toml_mutator.hpp"

using namespace undex;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return fuzz::mutate_toml(data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path small = fuzz::written("case.toml", R"(dimension = 1
end_time = 0.1
[resolution]
spacing = 0.1
[[bodies]]
name = "gas"
shape = {type = "box", low = 0, high = 1}
material = {law = "ideal_gas", rho0 = 1, gamma = 1.4}
energy = 2.5
)");
  try {
    fuzz::require(
        !scene::read_study(fuzz::written("study.toml", fuzz::text_of(data, size)), judge::comparison_kinds()).runs.empty(),
        "a study has a run");
  } catch (const SceneError& error) {
    fuzz::require(!error.findings().empty(), "a refused study has findings");
  } catch (const FileError&) {
  }
  return 0;
}
