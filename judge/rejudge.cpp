#include "judge/rejudge.hpp"

#include <cstdio>

#include "core/errors.hpp"
#include "judge/judge.hpp"
#include "output/folder_lock.hpp"
#include "output/run_folder.hpp"
#include "scene/document.hpp"

namespace undex::judge {
namespace {

namespace fs = std::filesystem;

/// A finished run as it stands on disk.
struct Judged {
  scene::Scene scene;
  output::Evidence evidence;
};

/// The scene as the run has resolved it; where its own reference is gone, a table that is given stands for it.
scene::Scene scene_of(const fs::path& run, const fs::path& table) {
  const auto read = [&](const std::vector<scene::Override>& overrides) {
    return scene::read(run / "resolved.toml", comparison_kinds(), overrides);
  };
  if (table.empty()) return read({});
  try {
    return read({});
  } catch (const SceneError&) {
    return read({{"comparison.reference", scene::quoted(fs::absolute(table).string())}});
  }
}

/// What cannot be read was given wrongly: the user's mistake, like that of any other command on runs.
template <class Read>
auto as_usage(const Read& read) {
  try {
    return read();
  } catch (const FileError& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

void rejudge(const RejudgeOptions& options) {
  const fs::path& run = options.run;
  as_usage([&] { output::require_finished_run(run); });
  const output::FolderLock lock(run, "undex judge");
  const Reference instead = as_usage([&] { return options.reference.empty() ? Reference{} : read_reference(options.reference); });
  const Judged judged = as_usage([&] {
    return Judged{.scene = scene_of(run, instead.table ? options.reference : fs::path()),
                  .evidence = output::read_evidence(run / "evidence.h5")};
  });
  const Comparison* comparison = comparison_of(judged.scene);
  if (comparison == nullptr)
    throw UsageError(run.string() + ": its scene has no comparison (comparison.kind), so there is nothing to judge");
  const Judge judge = as_usage([&] { return Judge(judged.scene, instead); });
  const Verdict verdict = as_usage([&] { return judge.verdict(judged.evidence); });
  write_tables(run, verdict);
  output::replace_metrics(run / "summary.json", verdict.metrics, verdict.missing);
  if (options.quiet) return;
  const std::string table = judge.table(verdict.metrics);
  std::printf("%s: %s\n%s%s", judged.scene.name.c_str(), comparison->title,
              (table.empty() ? metrics_text(verdict.metrics) : table).c_str(), missing_text(verdict.missing).c_str());
}

}  // namespace undex::judge
