// What a run notes as it goes: histories of probes and energies as often as the scene wants, snapshots at their times; at the
// end all of it in full precision, as evidence.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output/evidence.hpp"
#include "output/history.hpp"
#include "run/body_history.hpp"
#include "run/force_history.hpp"
#include "run/largest_values.hpp"
#include "run/open_field.hpp"
#include "run/probes.hpp"
#include "run/profile_lines.hpp"
#include "run/simulation.hpp"
#include "run/snapshots.hpp"
#include "run/step_limits.hpp"
#include "scene/scene.hpp"

namespace undex::run {

/// energy.csv: where the energy of the whole body is, and what the ledger does not account for.
class EnergyHistory {
 public:
  EnergyHistory(const std::filesystem::path& folder, const scene::Scene& scene, bool goes_on);
  void visit_state(StateVisitor& state);
  void sample(const Simulation& simulation);
  void flush() { history_->flush(); }
  const output::Samples& samples() const { return samples_; }

 private:
  bool gravity_, surroundings_, obstacles_, radiating_;
  std::filesystem::path path_;
  output::Samples samples_;
  std::optional<output::History> history_;
};

class Observer {
 public:
  /// `read`: the scene before a start has changed it. `goes_on`: the folder holds what was observed before, and visit_state will
  /// restore how far.
  Observer(const scene::Scene& scene, const scene::Scene& read, const Simulation& simulation, const std::filesystem::path& folder,
           bool goes_on);
  /// All that has been observed. Restored, the files of the folder are cut back to it.
  void visit_state(StateVisitor& state);
  /// The state before the first step.
  void begin(const Simulation& simulation);
  /// A state after a step.
  void observe(const Simulation& simulation);
  /// Puts every row so far on disk, those of all files together.
  void flush();
  /// Time [s] beyond which no step should go.
  double next_snapshot() const { return next_snapshot_; }
  /// See Snapshots.
  bool write_at_stop() { return snapshots_.write_at_stop(); }
  /// Everything observed, with those fields of the last state ("fluid.pressure"; "body.position" is that of the first deformable
  /// body).
  output::Evidence evidence(const Simulation& simulation, const std::vector<std::string>& last_fields) const;
  /// What of the whole run is for its record: largest values and bubbles.
  void add_to(output::RunRecord& record) const;

 private:
  const scene::Scene& scene_;
  const Simulation& simulation_;
  Probes probes_;
  EnergyHistory energy_;
  BodyHistory bodies_;
  ForceHistory forces_;
  LargestValues largest_;
  ProfileLines lines_;
  StepLimits steps_;
  OpenField open_field_;
  Snapshots snapshots_;
  double next_history_ = 0, next_snapshot_ = 0;
  std::chrono::steady_clock::time_point last_flush_;
};

}  // namespace undex::run
