#include "run/run.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <sstream>

#include "core/errors.hpp"
#include "core/last_words.hpp"
#include "core/signals.hpp"
#include "fem_structure/structure.hpp"
#include "output/run_folder.hpp"
#include "run/checkpoints.hpp"
#include "run/laid_start.hpp"
#include "run/observer.hpp"
#include "run/progress.hpp"
#include "run/record.hpp"
#include "run/room.hpp"
#include "run/simulation.hpp"
#include "run/stages.hpp"
#include "run/starts.hpp"
#include "run/trust.hpp"
#include "run/validity.hpp"

namespace undex::run {
namespace {

volatile std::sig_atomic_t signal_received = 0;
void remember_signal(int number) { signal_received = number; }

/// The energies of a state that may be written: numbers. Throws NumericalStop.
EnergyBalance expect_numbers(const Simulation& simulation) {
  const EnergyBalance energy = simulation.energy();
  if (std::isfinite(energy.total()) && std::isfinite(energy.scale)) return energy;
  char text[300];
  std::snprintf(
      text, sizeof text,
      "time %.6g s: the energy of the whole body is no number; look for a value of the scene that is far from all others",
      simulation.time());
  throw NumericalStop(text);
}

/// A run whose energy is off by half computes something else than the scene. Throws NumericalStop, when it is so a second time
/// in a row: what goes wrong within a step is caught in the next, and named more closely; and where loads set in on a body at
/// rest, the work of the first step is behind the energy by all of it.
void expect_balance(const EnergyBalance& energy, const Simulation& simulation, bool& was_off) {
  constexpr double most = 0.5;
  const bool off = std::abs(energy.error()) > most, again = off && was_off;
  was_off = off;
  if (!again) return;
  char text[500];
  std::snprintf(
      text, sizeof text,
      "time %.6g s: the energy balance is off by %.0f %% (undex help outputs, energy.csv)%s; a smaller scheme.courant (or "
      "scheme.fixed_step, structure.courant, solid_scheme.courant) may hold it",
      simulation.time(), 100.0 * energy.error(), simulation.fastest_particle().c_str());
  throw NumericalStop(text);
}

struct End {
  std::string status, message;
  int signal = 0;
  std::exception_ptr failure = nullptr;  ///< of files or memory
};

/// How far the loop over steps has come.
struct Course {
  double time;              ///< [s] of the last state that was sound
  long steps = 0;           ///< to it
  bool step_done = true;    ///< false within a step
  bool energy_off = false;  ///< see expect_balance
};

/// Steps to the end of the scene, or until a signal. Throws NumericalStop, and what files and memory throw.
End advance(const scene::Scene& scene, Simulation& simulation, Observer& observer, Checkpoints& checkpoints, Progress& progress,
            Course& course) {
  while (simulation.time() < scene.end_time * (1 - 1e-12)) {
    course.step_done = false;
    simulation.advance(std::min(scene.end_time, observer.next_snapshot()));
    course.step_done = true;
    const EnergyBalance energy = expect_numbers(simulation);
    observer.observe(simulation);
    expect_balance(energy, simulation, course.energy_off);
    course.time = simulation.time();
    course.steps = simulation.steps();
    progress.report(simulation);
    checkpoints.write_if_due();
    if (signal_received != 0)
      return {.status = "interrupted", .message = end_signal(signal_received).name, .signal = signal_received};
  }
  return {.status = "done", .message = ""};
}

/// The energy was off after the last step, for the first time, and no step comes that would tell what that means: one more is
/// taken. Throws NumericalStop. Nothing may be observed of the simulation after it.
void look_beyond_the_end(Simulation& simulation, Course& course) {
  course.step_done = false;
  simulation.advance(simulation.time() + simulation.last_step_size());
  course.step_done = true;
  expect_balance(expect_numbers(simulation), simulation, course.energy_off);
}

/// What the record says of a stop, and where its state was saved.
std::string stop_message(const NumericalStop& stop, const Simulation& simulation, Observer& observer, const Course& course) {
  std::string text = std::string(stop.what()) + "; the last step was set by " + simulation.last_step();
  try {
    char where[80];
    std::snprintf(where, sizeof where, "; fields/ ends with the %s, at %.6g s",
                  course.step_done ? "state at the stop" : "last sound state", simulation.time());
    if (observer.write_at_stop()) text += where;
  } catch (const FileError& error) {
    text += std::string("; its state could not be written: ") + error.what();
  }
  return text;
}

/// Why files or memory ended a run.
std::string failure_message(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::bad_alloc&) {
    return out_of_memory;
  } catch (const std::exception& error) {
    return error.what();
  }
}

/// Of a run that failed within a step: nothing is asked of solvers that may stand anywhere.
output::RunRecord record_without_state(const scene::Scene& scene, const Course& course, const Stopwatch& since) {
  output::RunRecord record;
  record.scene = scene.name;
  record.time_s = course.time;
  record.steps = course.steps;
  record.wall_time_s = since.wall();
  record.cpu_time_s = since.cpu();
  record.threads = omp_get_max_threads();
  record.peak_memory_bytes = output::peak_memory_bytes();
  record.mass_error = record.momentum_error = record.energy_error = std::numeric_limits<double>::quiet_NaN();
  return record;
}

/// Lays the scene's start, and says what was done.
void begin_in_stages(scene::Scene& scene, Stages& stages, const RunOptions& options) {
  if (scene.start.kind != scene::Start::Kind::plain) stages.begin(start_words(scene.start.kind));
  std::istringstream lines(begin(scene, {.stages = &stages, .numerics = options.numerics, .output = options.output}));
  for (std::string line; std::getline(lines, line);) stages.end(line);
}

/// Notes the first reason why something of the folder is not as it should be.
template <class Write>
void attempt(const Write& write, std::string& not_saved) {
  try {
    write();
  } catch (const FileError& error) {
    if (not_saved.empty()) not_saved = error.what();
  }
}

}  // namespace

Result compute(const scene::Scene& given, const RunOptions& options) {
  if (!given.structures.empty()) fem::load_meshes();  // no part of the run's cost
  Stopwatch since;
  scene::Scene scene = given;
  if (options.threads > 0) scene.fluid.numerics.threads = options.threads;
  const std::string resolved = scene::to_toml(scene);
  const bool goes_on = options.checkpoint != nullptr;
  expect_room(scene);
  Stages stages(options.verbosity < 0);
  const bool from_run = scene.start.kind == scene::Start::Kind::run;
  if (!goes_on || !from_run || !take_start(options.output, scene)) begin_in_stages(scene, stages, options);
  Simulation simulation(scene, &stages);
  for (sph::Body& body : scene.fluid.bodies) body.start.reset();  // it may hold much
  const std::vector<std::string> warnings = warnings_of(scene, options.output);
  if (options.verbosity >= 0)
    for (const std::string& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());

  // From here on a signal ends the run after the present step.
  catch_end_signals(remember_signal, /*second_kills=*/true);
  // The solvers have accepted the scene: nothing was written for one that they refuse.
  if (!goes_on) output::begin_run_folder(options.output, options.scene_text, resolved);
  if (!goes_on && from_run) keep_start(simulation, options.output);
  Observer observer(scene, given, simulation, options.output, goes_on);
  Course course{.time = simulation.time()};
  Checkpoints checkpoints({simulation, observer, since, course.energy_off}, options.output, scene.output.checkpoint_interval,
                          resolved, options.numerics);
  if (goes_on) {
    checkpoints.restore(*options.checkpoint);
    course.time = simulation.time();
    course.steps = simulation.steps();
    output::continue_run_folder(options.output, resolved);
  }
  Progress progress(simulation.time(), scene.end_time, options.verbosity);
  std::vector<char> reserve(1 << 20);  // [byte] from which the record is written when memory has run out
  End end;
  // The loops over particles take memory as they go, and what they throw ends the program within them.
  const LastWords words([&](const char* why) {
    std::vector<char>().swap(reserve);
    output::RunRecord record = record_without_state(scene, course, since);
    record.program = options.program;
    record.status = "failed";
    record.message = why;
    output::write_summary(options.output / "summary.json", record);
    observer.flush();
  });
  const auto guarded = [&](const auto& steps) {
    try {
      steps();
    } catch (const NumericalStop& stop) {
      if (course.step_done) checkpoints.write();
      else if (stop.resumable() && simulation.bodies().empty()) checkpoints.write(/*whole_step=*/false);
      end = {.status = "stopped", .message = stop_message(stop, simulation, observer, course)};
    } catch (...) {
      std::vector<char>().swap(reserve);
      end = {.status = "failed", .message = failure_message(std::current_exception()), .failure = std::current_exception()};
    }
  };
  Result result;
  const auto observe_end = [&] {
    attempt([&] { observer.flush(); }, result.not_saved);
    if (end.failure && !course.step_done) {
      result.record = record_without_state(scene, course, since);
    } else {
      result.evidence = observer.evidence(simulation, options.last_fields);
      result.record = record_of(scene, simulation, since);
      observer.add_to(result.record);
    }
  };
  guarded([&] {
    if (!goes_on) {
      expect_numbers(simulation);
      observer.begin(simulation);
    }
    end = advance(scene, simulation, observer, checkpoints, progress, course);
    checkpoints.write();
  });
  if (!end.failure) progress.finish(simulation);
  observe_end();
  if (end.status == "done" && course.energy_off) {
    guarded([&] { look_beyond_the_end(simulation, course); });
    if (end.status != "done") observe_end();
  }

  result.record.program = options.program;
  result.record.status = end.status;
  result.record.message = end.message;
  result.record.warnings = warnings;
  if (scene.output.checkpoint_interval > 0)
    for (const auto& pass : checkpoints.timers().seconds()) result.record.passes.push_back(pass);
  if (const LineFlow* line = simulation.line(); line && !line->remark().empty()) {
    result.record.warnings.push_back(line->remark());
    if (options.verbosity >= 0) std::fprintf(stderr, "warning: %s\n", line->remark().c_str());
  }
  for (const std::string& beyond : beyond_validity(scene, result.record.largest)) {
    result.record.warnings.push_back(beyond);
    if (options.verbosity >= 0) std::fprintf(stderr, "warning: %s\n", beyond.c_str());
  }
  const auto& not_kept = checkpoints.warnings();
  result.record.warnings.insert(result.record.warnings.end(), not_kept.begin(), not_kept.end());
  result.record.trust = trust_of(given, result.record);
  result.signal = end.signal;
  result.failure = end.failure;
  if (!end.failure || course.step_done)
    attempt([&] { output::write_evidence(options.output / "evidence.h5", result.evidence); }, result.not_saved);
  return result;
}

}  // namespace undex::run
