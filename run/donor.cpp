#include "run/donor.hpp"

#include <algorithm>
#include <cstdio>

#include "core/errors.hpp"
#include "output/checkpoint.hpp"
#include "run/snapshots.hpp"
#include "scene/changes.hpp"

namespace undex::run {
namespace {

namespace fs = std::filesystem;

fs::path settled(const fs::path& path) {
  std::error_code failed;
  const fs::path found = fs::weakly_canonical(path, failed);
  return failed ? path.lexically_normal() : found;
}

/// The scene file of a donor: of a run's folder its resolved scene.
fs::path file_of(const fs::path& from, fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(from, ignored)) return from;
  if (fs::exists(from / "resolved.toml", ignored)) {
    folder = from;
    return from / "resolved.toml";
  }
  return from / "case.toml";
}

}  // namespace

void Donor::refuse(const std::string& why) const {
  throw SceneError(receiver_.file.string(), {receiver_.places.finding("start.from", "start.from: " + why)});
}

Donor::Donor(const scene::Scene& receiver, const StartOptions& options) : receiver_(receiver), numerics_(options.numerics) {
  const fs::path file = settled(file_of(receiver.start.from, folder_));
  std::vector<fs::path> waiting = options.receivers;
  waiting.push_back(settled(receiver.file));
  if (std::find(waiting.begin(), waiting.end(), file) != waiting.end())
    refuse(file.string() + " begins, by way of others or at once, from this very scene; name one that does not");
  if (!folder_.empty() && !options.output.empty() && settled(folder_) == settled(options.output))
    refuse(folder_.string() + " is the folder that this run writes into; take another one by -o");
  if (std::error_code ignored; !fs::is_regular_file(file, ignored))
    refuse(receiver.start.from +
           " is neither a scene nor the folder of a run (with resolved.toml); give it relative to the scene file");
  try {
    scene_ = scene::read(file, {}, {{"comparison", "{kind = \"none\"}"}});  // nothing of it is judged
    scene_.fluid.numerics.threads = receiver.fluid.numerics.threads;
    scene::Scene begun = scene_;
    begin(begun, {.stages = options.stages, .numerics = numerics_, .output = {}, .receivers = waiting});
    simulation_ = std::make_shared<Simulation>(begun);
  } catch (const SceneError& error) {
    refuse("the donor cannot be begun: " + std::string(error.what()));
  } catch (const FileError& error) {
    refuse("the donor cannot be read: " + std::string(error.what()));
  }
}

void Donor::skip_to(double time) {
  if (folder_.empty()) return;
  const std::string start = output::fingerprint([&](StateVisitor& state) { simulation_->visit_state(state); });
  for (const char* name : output::checkpoint_names) {
    std::optional<output::Checkpoint> checkpoint;
    try {
      checkpoint.emplace(folder_ / name);
    } catch (const FileError&) {  // absent or damaged: the donor is computed from its start
      continue;
    }
    const output::CheckpointTitle& title = checkpoint->title();
    const bool timely = title.whole_step && title.time <= time && title.time > this->time();
    if (!timely || title.numerics != numerics_ || title.start != start) continue;
    if (!scene::changes_of_state(title.scene, scene::to_toml(scene_)).empty()) continue;
    checkpoint->restore([&](StateVisitor& state) { state.part("simulation", [&] { simulation_->visit_state(state); }); });
    checkpoint_ = this->time();
    return;
  }
}

void Donor::step_towards(double time) {
  const double snapshot = next_snapshot_after(scene_.output, this->time());  // as its own run would be cut
  try {
    simulation_->advance(std::min({time, scene_.end_time, snapshot}));
  } catch (const NumericalStop& stop) {
    refuse("the donor's numerics stop: " + std::string(stop.what()));
  }
}

std::string Donor::words() const {
  char text[200];
  std::snprintf(text, sizeof text, "%s: %ld steps to %.4g us", scene_.name.c_str(), simulation_->steps(), time() * 1e6);
  std::string words = text;
  if (checkpoint_) {
    std::snprintf(text, sizeof text, ", from its checkpoint at %.4g us", *checkpoint_ * 1e6);
    words += text;
  }
  return words;
}

}  // namespace undex::run
