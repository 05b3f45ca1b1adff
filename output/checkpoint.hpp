// A checkpoint: the state of a run between two steps, and what must agree before another run goes on from it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/state.hpp"

namespace undex::output {

/// What a checkpoint says beside the state.
struct CheckpointTitle {
  double time = 0;  ///< [s]
  long steps = 0;
  std::string scene;       ///< as resolved.toml has it
  std::string numerics;    ///< what the digits depend on beside the scene
  std::string start;       ///< fingerprint of the state that the scene starts from
  bool whole_step = true;  ///< false: of a step that went wrong, see NumericalStop

  void visit_state(StateVisitor& state);
};

/// Names the state's owner to a visitor.
using VisitState = std::function<void(StateVisitor&)>;

/// The checkpoints of a run's folder, the newer one first.
inline constexpr const char* checkpoint_names[] = {"checkpoint.h5", "checkpoint_before.h5"};

/// Writes a sealed HDF5 file into the folder; the checkpoint that is there becomes the one before. The file is made in memory and
/// written aside, so that a disk that fills at any byte leaves both as they were. Returns the bytes written. Throws FileError.
std::size_t write_checkpoint(const std::filesystem::path& folder, CheckpointTitle title, const VisitState& visit);

class Checkpoint {
 public:
  /// Throws FileError where the file is absent, damaged, or of another format.
  explicit Checkpoint(const std::filesystem::path& path);
  const std::filesystem::path& path() const { return path_; }
  const CheckpointTitle& title() const { return title_; }
  /// Gives the owner its state back. Throws FileError where the file holds other arrays than are visited.
  void restore(const VisitState& visit) const;

 private:
  std::filesystem::path path_;
  CheckpointTitle title_;
};

/// A sealed HDF5 file of any state, and back. Throws FileError; the latter where the file is absent, damaged, or holds other
/// arrays.
void write_state(const std::filesystem::path& path, const VisitState& visit);
void read_state(const std::filesystem::path& path, const VisitState& visit);

/// A checksum of a state's numbers, as 32 hexadecimal digits: equal for equal bits.
std::string fingerprint(const VisitState& visit);

}  // namespace undex::output
