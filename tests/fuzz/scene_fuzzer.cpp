// A scene file is read, or refused with SceneError or FileError. What is read is read back from resolved.toml as the same scene.
#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "scene/scene.hpp"
#include "tests/fuzz/input.hpp"
#include "tests/fuzz/toml_mutator.hpp"

using namespace undex;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  return fuzz::mutate_toml(data, size, most, seed);
}
extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t one_size, const std::uint8_t* other,
                                                 std::size_t other_size, std::uint8_t* out, std::size_t most, unsigned seed) {
  return fuzz::cross_toml(one, one_size, other, other_size, out, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string resolved;
  try {
    resolved = scene::to_toml(scene::read(fuzz::written("case.toml", fuzz::text_of(data, size)), judge::comparison_kinds()));
  } catch (const SceneError& error) {
    fuzz::require(!error.findings().empty(), "a refused scene has findings");
    return 0;
  } catch (const FileError&) {
    return 0;
  }
  const scene::Scene again = scene::read(fuzz::written("resolved.toml", resolved), judge::comparison_kinds());
  fuzz::require(scene::to_toml(again) == resolved, "resolved.toml is read back as the same scene");
  return 0;
}
