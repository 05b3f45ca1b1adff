#include "run/checkpoints.hpp"

#include <cstdio>
#include <new>

#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::run {

void RunState::visit_state(StateVisitor& state) {
  state.part("simulation", [&] { simulation.visit_state(state); });
  state.part("observed", [&] { observer.visit_state(state); });
  state.part("cost", [&] { cost.visit_state(state); });
  state("energy off", energy_off);
}

Checkpoints::Checkpoints(RunState state, const std::filesystem::path& folder, double interval, std::string scene,
                         std::string numerics)
    : state_(state), folder_(folder), interval_(interval), last_time_(state.simulation.time() - 1.0) {
  const auto timer = timers_.measure("checkpoints");
  title_.scene = std::move(scene);
  title_.numerics = std::move(numerics);
  title_.start = output::fingerprint([&](StateVisitor& visitor) { state_.simulation.visit_state(visitor); });
}

void Checkpoints::visit_state(StateVisitor& state) {
  state_.visit_state(state);
  state("timers", timers_);
}

void Checkpoints::restore(const output::Checkpoint& checkpoint) {
  const output::CheckpointTitle& title = checkpoint.title();
  if (title.start != title_.start)
    throw RestartError(
        checkpoint.path().string() +
        ": the scene does not start from the same state any more, to the last bit: a file that it reads (a mesh) has "
        "changed, or the libraries; bring back the old ones, or begin anew with undex run --force");
  checkpoint.restore([&](StateVisitor& visitor) { visit_state(visitor); });
  if (!title.whole_step) state_.simulation.find_rates_anew();
  last_time_ = state_.simulation.time();
  // Where the newest was damaged, it gives its place to the good one: the next to be written must not push that out.
  const std::filesystem::path newest = folder_ / output::checkpoint_names[0];
  if (checkpoint.path() != newest) output::put_in_place(checkpoint.path(), newest);
}

void Checkpoints::write_if_due() {
  if (interval_ > 0 && std::chrono::duration<double>(Clock::now() - last_).count() >= interval_) write();
}

void Checkpoints::write(bool whole_step) {
  if (interval_ <= 0 || state_.simulation.time() == last_time_) return;
  title_.time = state_.simulation.time();
  title_.steps = state_.simulation.steps();
  title_.whole_step = whole_step;
  std::string why;
  const auto timer = timers_.measure("checkpoints");
  try {
    output::write_checkpoint(folder_, title_, [&](StateVisitor& visitor) { visit_state(visitor); });
    last_time_ = title_.time;
  } catch (const FileError& error) {
    why = error.what();
  } catch (const std::bad_alloc&) {
    why = "out of memory";
  }
  last_ = Clock::now();
  if (why.empty()) return;
  char when[60];
  std::snprintf(when, sizeof when, "no checkpoint at %.6g s: ", title_.time);
  warnings_.push_back(when + why);
  std::fprintf(stderr, "warning: %s\n", warnings_.back().c_str());
}

}  // namespace undex::run
