// Structure fields as VTKHDF 1.0 unstructured grids of hexahedra, of quadrangles (a meridian's cells, faces of a surface) or of
// segments (faces in a plane): one file per snapshot and an
// index with the times (structure.hdf.series), the form that ParaView 5.11 opens with true times; it refuses temporal VTKHDF.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/state.hpp"
#include "output/field.hpp"

namespace undex::output {

/// One state of the mesh. Spans are borrowed for the call.
struct StructureSnapshot {
  std::span<const Vec3> positions;  ///< present positions of the nodes [m]
  /// VTK's order, of hexahedra or of a meridian (core/hexahedral_mesh.hpp); a face a, b, c, d is the quadrangle of these.
  std::span<const std::array<int, 8>> cells;
  std::vector<Field> point_data, cell_data;
};

class StructureFields {
 public:
  /// Files will be folder/stem_00000.hdf, ... and folder/stem.hdf.series. The folder must exist.
  explicit StructureFields(std::filesystem::path folder, std::string stem = "structure");

  /// Writes the snapshot's file, then the index with it; both whole or not at all. Throws FileError (disk),
  /// std::invalid_argument (sizes that do not fit, a node number out of range).
  void write(double time, const StructureSnapshot& snapshot);

  std::size_t snapshots() const { return times_.size(); }
  /// The times of the snapshots. Restored, it takes away those that came later. Throws FileError where one is missing.
  void visit_state(StateVisitor& state);

 private:
  std::string name_of(std::size_t number) const;
  void cut() const;
  void write_index() const;

  std::filesystem::path folder_;
  std::string stem_;
  std::vector<double> times_;  ///< of the snapshots [s]
};

}  // namespace undex::output
