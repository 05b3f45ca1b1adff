// Overrides (-P key=value, one a line) of a shipped scene, which the first byte chooses, change it or are refused.
#include "core/errors.hpp"
#include "judge/comparisons.hpp"
#include "scene/scene.hpp"
#include "tests/fuzz/input.hpp"

using namespace undex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto& scenes = fuzz::shipped_scenes();
  std::string_view text = fuzz::text_of(data + 1, size - 1);
  std::vector<scene::Override> overrides;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos)
      overrides.push_back({std::string(line.substr(0, equals)), std::string(line.substr(equals + 1))});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  try {
    scene::to_toml(scene::read(scenes[data[0] % scenes.size()], judge::comparison_kinds(), overrides));
  } catch (const SceneError& error) {
    fuzz::require(!error.findings().empty(), "a refused scene has findings");
  } catch (const FileError&) {
  }
  return 0;
}
