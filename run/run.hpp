// One run: a scene computed from start to end, with its histories, fields and evidence in one folder. Nothing here judges it.
#pragma once

#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "output/checkpoint.hpp"
#include "output/evidence.hpp"
#include "output/run_record.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// What is said when memory runs out.
inline constexpr const char* out_of_memory = "out of memory; take a larger spacing, or symmetry planes";

struct RunOptions {
  std::filesystem::path output = {};               ///< there, and held by an output::FolderLock
  int threads = 0;                                 ///< 0: the scene's choice, or all the machine has
  int verbosity = 0;                               ///< -1 quiet, 0 normal, 1 every step
  std::string scene_text = {};                     ///< the scene file as the user wrote it
  std::string program = {};                        ///< version text for the record
  std::string numerics = {};                       ///< what the digits depend on beside the scene, for checkpoints
  std::vector<std::string> last_fields = {};       ///< of the last state that a verdict needs, such as "fluid.pressure"
  const output::Checkpoint* checkpoint = nullptr;  ///< to go on from, in the same folder; null: from the scene's start
};

/// How a run ended and what it has observed.
struct Result {
  output::Evidence evidence;  ///< also in evidence.h5
  output::RunRecord
      record;      ///< without metrics; its status is "done", "interrupted" (a signal), "stopped" (the numerics) or "failed"
  int signal = 0;  ///< that interrupted it, of end_signals
  std::exception_ptr failure;  ///< of files or memory, which ended it; null: none
  std::string not_saved;       ///< why a history or evidence.h5 is not whole; empty: they are
};

/// Computes the scene and leaves everything in the folder but summary.json, which waits for the metrics. What was computed
/// before a signal, a stop by the numerics or a failure of files or memory is kept and returned likewise. Throws SceneError,
/// FileError, RestartError.
Result compute(const scene::Scene& scene, const RunOptions& options);

}  // namespace undex::run
