// The quantities that several runs have recorded, each with what decides how it is compared.
#pragma once

#include <string>
#include <vector>

#include "output/run_folder.hpp"
#include "study/run_comparison.hpp"
#include "study/run_settings.hpp"

namespace undex::study {

struct ComparedRun {
  output::RunFolder folder;
  ResolvedScene scene;
};

struct Compared {
  Quantity quantity;
  std::string kind;    ///< of its probe: "fluid", "wall", "structure"; or "energy"
  std::string column;  ///< name in a history: "pressure"; of a radial component the vector's: "displacement"

  bool is_pressure() const { return column == "pressure" && kind != "energy"; }
  bool is_error() const { return kind == "energy" && column == "error"; }
};

/// Histories of all probes, the compared probe's first, then the parts of the energy. Adds to the notes what does not fit.
std::vector<Compared> gather(const std::vector<ComparedRun>& runs, std::vector<std::string>& notes);

/// What a pressure is compared by besides itself: centred means, and last the impulse.
std::vector<Compared> derived(const Compared& pressure);

/// Gives each column of the reference (the file at `path`) to the first quantity of its name. Columns are named as in a history,
/// whatever follows ("pressure at 0.25 mm"); of several for one quantity the first counts. Throws UsageError where none is of
/// use.
void attach_reference(std::vector<Compared>& all, const std::vector<output::HistoryColumn>& reference, const std::string& path,
                      std::vector<std::string>& notes);

}  // namespace undex::study
