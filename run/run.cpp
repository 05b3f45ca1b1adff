#include "run/run.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>

#include "judge/comparison.hpp"
#include "run/plane_wave_start.hpp"
#include "run/probes.hpp"
#include "run/progress.hpp"
#include "run/simulation.hpp"
#include "run/snapshots.hpp"
#include "run/spherical_start.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"
#include "output/history.hpp"
#include "output/run_record.hpp"
#include "sph_fluid/lattice.hpp"

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

/// energy.csv: where the energy of the whole body is, and what the ledger does not account for.
class EnergyHistory {
 public:
  EnergyHistory(const std::filesystem::path& folder, bool gravity)
      : gravity_(gravity), history_(folder / "energy.csv", columns(gravity)) {}
  void sample(const Simulation& simulation) {
    const EnergyBalance e = simulation.energy();
    std::vector<double> row{simulation.time(), e.kinetic, e.internal,   e.dissipated,    e.structure_kinetic, e.elastic,
                            e.plastic,         e.viscous, e.work_given, e.work_received, e.external};
    if (gravity_) row.push_back(e.gravity);
    row.insert(row.end(), {e.total(), e.error()});
    history_.append(row);
  }
  void flush() { history_.flush(); }

 private:
  static std::vector<output::Column> columns(bool gravity) {
    std::vector<output::Column> all{{"time", "s"}};
    for (const char* name : {"kinetic", "internal", "dissipated", "structure_kinetic", "structure_elastic", "structure_plastic",
                             "structure_viscous", "interface_work_given", "interface_work_received", "external"})
      all.push_back({name, "J"});
    if (gravity) all.push_back({"gravity", "J"});
    all.push_back({"total", "J"});
    all.push_back({"error", ""});
    return all;
  }

  bool gravity_;
  output::History history_;
};

/// Wall and CPU time since it was made: what loading the program costs is not the run's.
class Stopwatch {
 public:
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }
  double cpu() const { return output::cpu_time() - cpu_; }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = output::cpu_time();
};

output::RunRecord record_of(const scene::Scene& scene, const RunOptions& options, const Simulation& simulation,
                            const Stopwatch& since) {
  output::RunRecord record;
  record.scene = scene.name;
  record.program = options.program;
  record.time_s = simulation.time();
  record.steps = simulation.steps();
  if (const sph::Fluid* fluid = simulation.fluid()) record.fluid_substeps = fluid->substeps();
  record.wall_time_s = since.wall();
  record.cpu_time_s = since.cpu();
  record.threads = omp_get_max_threads();
  if (const sph::Fluid* fluid = simulation.fluid()) {
    record.particles = std::int64_t(fluid->particle_count());
    record.wall_particles = std::int64_t(fluid->wall_particle_count());
    record.particle_updates = record.particles * record.steps;
    record.neighbour_interactions = fluid->neighbour_interactions();
    record.solver_memory_bytes += std::int64_t(fluid->memory_bytes());
    const sph::Clamps clamps = fluid->clamps();
    record.clamps = {
        {"density", clamps.density}, {"smoothing", clamps.smoothing}, {"filling", clamps.filling}, {"energy", clamps.energy}};
  }
  for (const auto& body : simulation.bodies()) {
    const auto particles = std::int64_t(body->size().particles);
    record.particles += particles;
    record.particle_updates += particles * body->steps();
    record.cells += std::int64_t(body->size().cells);
    record.solver_memory_bytes += std::int64_t(body->memory_bytes());
  }
  record.peak_memory_bytes = output::peak_memory_bytes();
  record.mass_error = simulation.mass_error();
  record.momentum_error = simulation.momentum_error();
  record.angular_momentum_error = simulation.angular_momentum_error();
  record.energy_error = simulation.energy().error();
  record.interface_energy_error = simulation.interface_energy_error();
  record.interface_impulse_error = simulation.interface_impulse_error();
  record.passes = simulation.passes();
  return record;
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

void print_cost(const output::RunRecord& record) {
  std::printf("%s: %s at %.6g us after %lld steps, %.1f s of wall time, %.1f s of CPU time, %.0f MB\n", record.scene.c_str(),
              record.status.c_str(), record.time_s * 1e6, static_cast<long long>(record.steps), record.wall_time_s,
              record.cpu_time_s, record.peak_memory_bytes / 1e6);
  if (record.particles > 0)
    std::printf("%lld particles, %.4g particle updates, %.3f million per second and core, %.0f bytes per particle\n",
                static_cast<long long>(record.particles), double(record.particle_updates),
                record.particle_updates / std::max(record.cpu_time_s, 1e-9) * 1e-6,
                double(record.peak_memory_bytes) / double(record.particles));
  std::printf("energy error %.2e, mass error %.1e", record.energy_error, record.mass_error);
  if (record.momentum_error == record.momentum_error) std::printf(", momentum error %.1e", record.momentum_error);
  if (record.angular_momentum_error) std::printf(", angular momentum error %.1e", *record.angular_momentum_error);
  if (record.interface_energy_error)
    std::printf(", interface energy error %.2e, impulse error %.1e", *record.interface_energy_error,
                record.interface_impulse_error.value_or(0.0));
  std::printf("\n");
  if (std::abs(record.energy_error) > 0.01)
    std::printf(
        "note: the energy balance is off by %.1f %%; compare with a smaller step (scheme.courant, structure.courant, "
        "solid_scheme.courant)\n",
        100.0 * record.energy_error);
}

}  // namespace

int compute(const scene::Scene& given, const RunOptions& options) {
  const Stopwatch since;
  scene::Scene scene = given;
  if (options.threads > 0) scene.fluid.numerics.threads = options.threads;
  const std::filesystem::path& folder = options.output;
  const std::string resolved = scene::to_toml(scene);
  if (scene.start.kind == scene::Start::Kind::spherical) {
    const std::string report = begin_spherically(scene);
    if (options.verbosity >= 0) std::printf("%s\n", report.c_str());
  } else if (scene.start.kind == scene::Start::Kind::plane_wave) {
    const std::string report = begin_with_plane_wave(scene);
    if (options.verbosity >= 0) std::printf("%s\n", report.c_str());
  }
  Simulation simulation(scene);

  const std::vector<std::string> warnings = sph::lattice_warnings(scene.fluid);
  if (options.verbosity >= 0)
    for (const std::string& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());

  // Now the scene is known to be sound: nothing was written for one that is not.
  output::make_folder(folder);
  output::write_text_atomically(folder / "scene.toml", options.scene_text);
  output::write_text_atomically(folder / "resolved.toml", resolved);
  std::filesystem::remove(folder / "summary.json");  // an older run's must not pass for this one's
  Probes probes(scene, simulation, folder);
  EnergyHistory energy(folder, !scene.fluid.gravity.isZero());
  Snapshots snapshots(scene, simulation, folder);
  Progress progress(simulation.time(), scene.end_time, options.verbosity);
  catch_signals();

  const auto finish = [&](const std::string& status, const std::string& message) {
    progress.finish(simulation);
    probes.flush();
    energy.flush();
    output::RunRecord record = record_of(scene, options, simulation, since);
    record.status = status;
    record.message = message;
    record.warnings = warnings;
    try {
      record.metrics = judge::compare(given, simulation, probes, folder);
    } catch (const std::invalid_argument&) {
      // A history that ends in values that are no numbers has no results; the record of the stop matters more.
    }
    output::write_summary(folder / "summary.json", record);
    if (options.verbosity >= 0) {
      print_cost(record);
      std::printf("%s", judge::comparison_table(scene, record.metrics).c_str());
    }
  };

  const auto sample = [&] {
    probes.sample(simulation);
    energy.sample(simulation);
  };
  double next_history = 0, next_snapshot = snapshots.next_after(simulation.time() > 0 ? simulation.time() : -1.0);
  const auto observe = [&] {
    const double now = simulation.time() * (1 + 1e-12);
    if (now >= next_history || now >= scene.end_time) {
      sample();
      const double interval = scene.output.history_interval;
      next_history = interval > 0 ? (std::floor(now / interval) + 1) * interval : 0.0;
    }
    if (now >= next_snapshot) {
      snapshots.write();
      next_snapshot = snapshots.next_after(simulation.time());
    }
  };

  bool energy_off = false, step_done = true;
  try {
    if (simulation.time() > 0) probes.sample_before(0.0);
    observe();
    while (simulation.time() < scene.end_time * (1 - 1e-12)) {
      step_done = false;
      simulation.advance(std::min(scene.end_time, next_snapshot));
      step_done = true;
      observe();
      expect_energy(simulation, energy_off);
      progress.report(simulation);
      if (signal_received != 0) {
        finish("interrupted", signal_received == SIGINT ? "SIGINT" : "SIGTERM");
        return 128 + signal_received;
      }
    }
  } catch (const NumericalStop& stop) {
    std::string text = std::string(stop.what()) + "; the last step was set by " + simulation.last_step();
    try {
      char where[80];
      std::snprintf(where, sizeof where, "; fields/ ends with the %s, at %.6g s",
                    step_done ? "state at the stop" : "last sound state", simulation.time());
      if (snapshots.write_at_stop()) text += where;
    } catch (const FileError& error) {
      text += std::string("; its state could not be written: ") + error.what();
    }
    finish("stopped", text);
    throw NumericalStop(text);
  }
  finish("done", "");
  return exit_done;
}

}  // namespace undex::run
