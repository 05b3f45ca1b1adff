#include "run/run.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "run/observer.hpp"
#include "run/plane_wave_start.hpp"
#include "run/progress.hpp"
#include "run/record.hpp"
#include "run/simulation.hpp"
#include "run/spherical_start.hpp"
#include "sph_fluid/walls/lattice_warnings.hpp"

namespace undex::run {
namespace {

volatile std::sig_atomic_t signal_received = 0;
void remember_signal(int number) { signal_received = number; }

/// SIGINT and SIGTERM end the run at the next step instead of at once; a second one kills.
void catch_signals() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// A run whose energy is off by half computes something else than the scene. Throws NumericalStop, when it is so a second
/// time: what goes off within a step is caught there, and named more closely.
void expect_energy(const Simulation& simulation, bool& was_off) {
  constexpr double most = 0.5;
  const double error = simulation.energy().error();
  const bool off = std::abs(error) > most, again = off && was_off;
  was_off = off;
  if (!again) return;
  char text[500];
  std::snprintf(text, sizeof text,
                "time %.6g s: the energy balance is off by %.0f %% (docs/outputs.md, energy.csv)%s; a smaller scheme.courant (or "
                "scheme.fixed_step, structure.courant, solid_scheme.courant) may hold it",
                simulation.time(), 100.0 * error, simulation.fastest_particle().c_str());
  throw NumericalStop(text);
}

/// Says every few seconds how far the one-dimensional flow has come.
class StartNews {
 public:
  explicit StartNews(int verbosity) : quiet_(verbosity < 0) {}
  void operator()(double time, double front, double obstacle) {
    if (quiet_ || since_.wall() < next_) return;
    next_ = since_.wall() + 2.0;
    std::printf("spherical start: %.4g us, front at %.4g mm of %.4g mm\n", time * 1e6, front * 1e3, obstacle * 1e3);
    std::fflush(stdout);
  }

 private:
  bool quiet_;
  Stopwatch since_;
  double next_ = 2.0;  // [s]
};

/// Lays the scene's start on its bodies, and says so.
void begin(scene::Scene& scene, int verbosity) {
  std::string report;
  if (scene.start.kind == scene::Start::Kind::spherical) report = begin_spherically(scene, StartNews(verbosity));
  if (scene.start.kind == scene::Start::Kind::plane_wave) report = begin_with_plane_wave(scene);
  if (!report.empty() && verbosity >= 0) std::printf("%s\n", report.c_str());
}

/// The folder with the scene as it was given and as it was read. An older run's results must not pass for this one's.
void begin_folder(const std::filesystem::path& folder, const std::string& given, const std::string& resolved) {
  output::make_folder(folder);
  output::write_text_atomically(folder / "scene.toml", given);
  output::write_text_atomically(folder / "resolved.toml", resolved);
  for (const char* name : {"summary.json", "evidence.h5"}) std::filesystem::remove(folder / name);
}

struct End {
  std::string status, message;
  int signal = 0;
};

/// Steps to the end of the scene, or until a signal. Throws NumericalStop; `step_done` then says whether between two steps.
End advance(const scene::Scene& scene, Simulation& simulation, Observer& observer, Progress& progress, bool& step_done) {
  bool energy_off = false;
  observer.begin(simulation);
  while (simulation.time() < scene.end_time * (1 - 1e-12)) {
    step_done = false;
    simulation.advance(std::min(scene.end_time, observer.next_snapshot()));
    step_done = true;
    observer.observe(simulation);
    expect_energy(simulation, energy_off);
    progress.report(simulation);
    if (signal_received != 0)
      return {.status = "interrupted", .message = signal_received == SIGINT ? "SIGINT" : "SIGTERM", .signal = signal_received};
  }
  return {.status = "done", .message = ""};
}

/// What the record says of a stop, and where its state was saved.
std::string stop_message(const NumericalStop& stop, const Simulation& simulation, Observer& observer, bool step_done) {
  std::string text = std::string(stop.what()) + "; the last step was set by " + simulation.last_step();
  try {
    char where[80];
    std::snprintf(where, sizeof where, "; fields/ ends with the %s, at %.6g s",
                  step_done ? "state at the stop" : "last sound state", simulation.time());
    if (observer.write_at_stop()) text += where;
  } catch (const FileError& error) {
    text += std::string("; its state could not be written: ") + error.what();
  }
  return text;
}

}  // namespace

Result compute(const scene::Scene& given, const RunOptions& options) {
  const Stopwatch since;
  scene::Scene scene = given;
  if (options.threads > 0) scene.fluid.numerics.threads = options.threads;
  const std::string resolved = scene::to_toml(scene);
  begin(scene, options.verbosity);
  Simulation simulation(scene);
  const std::vector<std::string> warnings = sph::lattice_warnings(scene.fluid);
  if (options.verbosity >= 0)
    for (const std::string& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());

  // The solvers have accepted the scene: nothing was written for one that they refuse.
  begin_folder(options.output, options.scene_text, resolved);
  Observer observer(scene, simulation, options.output);
  Progress progress(simulation.time(), scene.end_time, options.verbosity);
  catch_signals();
  End end;
  bool step_done = true;
  try {
    end = advance(scene, simulation, observer, progress, step_done);
  } catch (const NumericalStop& stop) {
    end = {.status = "stopped", .message = stop_message(stop, simulation, observer, step_done)};
  }
  progress.finish(simulation);

  Result result;
  result.evidence = observer.evidence(simulation, options.last_fields);
  result.record = record_of(scene, simulation, since);
  result.record.program = options.program;
  result.record.status = end.status;
  result.record.message = end.message;
  result.record.warnings = warnings;
  result.signal = end.signal;
  try {
    output::write_evidence(options.output / "evidence.h5", result.evidence);
  } catch (const FileError& error) {
    result.not_saved = error.what();
  }
  return result;
}

}  // namespace undex::run
