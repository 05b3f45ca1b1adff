#include "run/resume.hpp"

#include <algorithm>
#include <cstdio>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/run_folder.hpp"
#include "scene/changes.hpp"

namespace undex::run {
namespace {

namespace fs = std::filesystem;

std::string words_of(const output::Checkpoint& checkpoint) {
  char text[120];
  std::snprintf(text, sizeof text, " at %.6g us, after %ld steps", checkpoint.title().time * 1e6, checkpoint.title().steps);
  return "going on from " + checkpoint.path().string() + text;
}

}  // namespace

Continued find_checkpoint(const fs::path& folder, const std::string& numerics) {
  Continued found;
  std::error_code ignored;
  for (const char* name : output::checkpoint_names) {
    if (found.checkpoint || !fs::exists(folder / name, ignored)) continue;
    try {
      found.checkpoint.emplace(folder / name);
    } catch (const FileError& damage) {
      found.warnings.push_back(damage.what());
    }
  }
  if (!found.checkpoint && !found.warnings.empty())
    throw RestartError(found.warnings.front() + "; no checkpoint of " + folder.string() +
                       " is whole: bring one back, or begin anew with undex run --force");
  if (!found.checkpoint) {
    if (!fs::exists(folder / "resolved.toml", ignored))
      throw UsageError(folder.string() + ": holds no run to go on with (no checkpoint, no resolved.toml)");
    found.words = folder.string() + " has no checkpoint yet: the run begins at its start";
    return found;
  }
  const output::CheckpointTitle& title = found.checkpoint->title();
  if (title.numerics != numerics)
    throw RestartError(found.checkpoint->path().string() + ": its digits are of \"" + title.numerics +
                       "\", and this program computes with \"" + numerics +
                       "\"; go on with the program and the kind of machine that began the run");
  if (!fs::exists(folder / "resolved.toml", ignored)) output::write_text_atomically(folder / "resolved.toml", title.scene);
  found.words = words_of(*found.checkpoint);
  return found;
}

void require_same_scene(const Continued& continued, const scene::Scene& scene) {
  if (!continued.checkpoint) return;
  const std::vector<std::string> changes = scene::changes_of_state(continued.checkpoint->title().scene, scene::to_toml(scene));
  if (changes.empty()) return;
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, changes.size()); ++k) text += (k > 0 ? ", " : "") + changes[k];
  if (changes.size() > most) text += " and " + std::to_string(changes.size() - most) + " more";
  throw RestartError(continued.checkpoint->path().string() + ": the scene has changed: " + text +
                     "; a run goes on with the scene that it began with, but for the end time, threads, output, comparison and "
                     "new probes: undo the change, or begin anew with undex run --force");
}

bool is_done(const fs::path& folder, const Continued& continued, const scene::Scene& scene) {
  if (!continued.checkpoint || continued.checkpoint->title().time < scene.end_time * (1 - 1e-12)) return false;
  std::error_code ignored;
  return fs::exists(folder / "summary.json", ignored) && !output::is_unfinished_run(folder);
}

}  // namespace undex::run
