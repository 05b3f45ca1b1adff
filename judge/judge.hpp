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
  /// Empty where the scene has no comparison. Every metric that is NaN has its reason; where a history ends in values that are no
  /// numbers there are no metrics and one reason, named "all".
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

/// Which metrics have no value and why, a line a reason; empty where all have one.
std::string missing_text(const output::Reasons& missing);

}  // namespace undex::judge
