// undex judge: a verdict again from what is on disk, so that a changed definition or reference needs no new run.
#pragma once

#include <filesystem>

namespace undex::judge {

struct RejudgeOptions {
  std::filesystem::path run;        ///< output folder of a run that has ended
  std::filesystem::path reference;  ///< table or history in place of the scene's; may be empty
  bool quiet = false;
};

/// Judges a run again from what it has left, as its scene (resolved.toml) says. Rewrites the metrics of summary.json
/// and the comparison's own tables. Throws UsageError where there is nothing to judge or a file cannot be understood, SceneError
/// where this program no longer reads the scene, FileError where it cannot write.
void rejudge(const RejudgeOptions& options);

}  // namespace undex::judge
