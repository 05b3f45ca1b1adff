// Particle fields as H5Part, which ParaView opens with true times: one file, a group Step#0, Step#1, ... per snapshot,
// with x, y, z [m], the fields and the attribute TimeValue [s]. A vector "velocity" is stored as velocity_0, velocity_1,
// velocity_2, which ParaView joins again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/state.hpp"
#include "output/field.hpp"

namespace undex::output {

/// Writes snapshots into one .h5part file. The file is closed between snapshots, and a snapshot gets its name only when
/// all its data are on disk: a run that is killed leaves every earlier snapshot readable.
class ParticleFields {
 public:
  /// Creates (or empties) the file. Throws FileError.
  explicit ParticleFields(std::filesystem::path path);
  /// Goes on with the file that is there, once visit_state has said how far. Until then nothing is done.
  static ParticleFields continued(std::filesystem::path path);
  /// How many snapshots there are. Restored, it takes away those that came later. Throws FileError where there are fewer.
  void visit_state(StateVisitor& state);

  /// Appends a snapshot. `ids` may be empty; otherwise it is written as int64 "id". Particles may come in any order and
  /// in another number each time. Throws FileError (disk), std::invalid_argument (sizes or names that do not fit).
  void write(double time, std::span<const Vec3> positions, std::span<const Field> fields, std::span<const std::int64_t> ids = {});

  int snapshots() const { return snapshots_; }
  const std::filesystem::path& path() const { return path_; }

 private:
  ParticleFields() = default;
  void create();
  void cut();

  std::filesystem::path path_;
  int snapshots_ = 0;
};

}  // namespace undex::output
