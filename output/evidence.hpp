// evidence.h5: what a run has observed, in full precision, so that it can be judged again without being computed again.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/vector.hpp"
#include "output/samples.hpp"

namespace undex::output {

/// Values of one field at the end of a run, in double precision.
struct LastField {
  int components = 1;
  std::vector<double> values;  ///< those of a point side by side

  /// Of a field of three components.
  std::vector<Vec3> vectors() const;
};

struct Evidence {
  double time = 0;                          ///< that the run has reached [s]
  std::map<std::string, Samples> probes;    ///< histories by the probe's name
  Samples energy;                           ///< as in energy.csv
  Samples bodies;                           ///< as in bodies.csv; without columns where the run has none
  Samples forces;                           ///< as in forces.csv; likewise
  std::map<std::string, Samples> lines;     ///< as in lines/<name>.csv, by the line's name
  std::map<std::string, LastField> fields;  ///< of the last state, such as "fluid.pressure"

  /// A column of a probe over time; empty where there is none.
  Series series(const std::string& probe, const std::string& column) const;
  /// The field of that name. Throws FileError where the run has not kept it.
  const LastField& field(const std::string& name) const;
};

/// Writes the file atomically. Throws FileError.
void write_evidence(const std::filesystem::path& path, const Evidence& evidence);

/// Reads it back, bit for bit. Throws FileError where the file is absent, damaged or another program's.
Evidence read_evidence(const std::filesystem::path& path);

}  // namespace undex::output
