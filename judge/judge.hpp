// Evidence in, verdict out: a scene's comparison with everything that it needs, read and checked before the run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "judge/comparisons.hpp"

namespace undex::judge {

class Judge {
 public:
  /// Reads the scene's reference, the table or the history of which may be another (UsageError where the comparison knows none).
  /// Throws FileError where one cannot be read or understood.
  explicit Judge(const scene::Scene& scene, const Reference& instead = {});

  /// What of the run's last state its evidence must hold.
  std::vector<std::string> last_fields() const;
  /// Empty where the scene has no comparison, or a history ends in values that are no numbers.
  Verdict verdict(const output::Evidence& evidence) const;
  /// Metrics beside the reference table as text; a profile's alone; empty without a table.
  std::string table(const output::NamedNumbers& metrics) const;

 private:
  scene::Scene scene_;
  const Comparison* comparison_;  ///< null: none
  Reference reference_;
};

/// Writes the verdict's own tables into the run's folder. Throws FileError.
void write_tables(const std::filesystem::path& folder, const Verdict& verdict);

/// A line a metric.
std::string metrics_text(const output::NamedNumbers& metrics);

struct RejudgeOptions {
  std::filesystem::path run;        ///< output folder of a run that has ended
  std::filesystem::path reference;  ///< table or history in place of the scene's; may be empty
  bool quiet = false;
};

/// undex judge: judges a run again from what it has left, as its scene (resolved.toml) says. Rewrites the metrics of summary.json
/// and the comparison's own tables. Throws UsageError where there is nothing to judge or a file cannot be understood, SceneError
/// where this program no longer reads the scene, FileError where it cannot write.
void rejudge(const RejudgeOptions& options);

}  // namespace undex::judge
