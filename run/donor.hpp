// The run of a scene from whose state another one begins: computed in memory, or gone on with from a checkpoint of its folder.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "run/stages.hpp"
#include "run/starts.hpp"
#include "run/simulation.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class Donor {
 public:
  /// Of start.from of the receiving scene, at the donor's own start. Throws SceneError, as that key, where it cannot be read or
  /// the chain of starts comes back to a scene that waits in it.
  Donor(const scene::Scene& receiver, const StartOptions& options);

  const scene::Scene& scene() const { return scene_; }  ///< as it was given: bodies as they are at time zero
  const Simulation& simulation() const { return *simulation_; }
  /// The same, for somebody who holds a part of it.
  std::shared_ptr<const Simulation> shared() const { return simulation_; }
  double time() const { return simulation_->time(); }

  /// Goes on with the folder's newest checkpoint that is not later than `time` [s], if there is one of these numerics.
  void skip_to(double time);
  /// One step of the donor's run, not beyond `time` [s]. Throws SceneError where its numerics stop.
  void step_towards(double time);
  /// "NAME: 20 steps to 3 us", for reports.
  std::string words() const;

 private:
  [[noreturn]] void refuse(const std::string& why) const;

  const scene::Scene& receiver_;
  std::string numerics_;
  std::filesystem::path folder_;  // of a run; empty: the donor is a scene
  scene::Scene scene_;
  std::shared_ptr<Simulation> simulation_;
  std::optional<double> checkpoint_;  // time of the one that was gone on from [s]
};

}  // namespace undex::run
