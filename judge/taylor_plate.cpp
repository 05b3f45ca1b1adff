#include "judge/taylor_plate.hpp"

#include <algorithm>
#include <cmath>

#include "run/plane_wave_start.hpp"
#include "exact/classical.hpp"
#include "exact/lagrangian_1d.hpp"

namespace undex::judge {
namespace {

/// The scene along the wave's way, with the plate's wet face at zero and the water below it.
struct Line {
  double way;            // sign of the wave's direction
  double length, front;  // of the water; of the wave's front [m]
  double plate_mass;     // per area [kg/m^2]
};

Line line_of(const scene::Scene& scene) {
  const scene::Start::Wave& wave = scene.start.wave;
  const auto& plate = std::get<fem::PlateMesh>(scene.structure->mesh);
  const double way = wave.upward ? 1.0 : -1.0;
  const double face = wave.upward ? plate.low[wave.axis] : plate.high[wave.axis];
  const Bounds water = bounds(scene.fluid.bodies[run::wave_body(scene)].shape, scene.fluid.dimension);
  const double far_end = wave.upward ? water.low[wave.axis] : water.high[wave.axis];
  return {way, way * (face - far_end), way * (wave.front - face),
          scene.structure->material.rho0 * (plate.high - plate.low)[wave.axis]};
}

}  // namespace

output::PlateHistories plate_in_one_dimension(const scene::Scene& scene, double end, int refinement) {
  const Line line = line_of(scene);
  const exact::PlaneWave wave = run::plane_wave(scene);
  // As fine as the wave asks for, and finer towards a plate that weighs less than little water.
  const int cells = refinement * int(std::ceil(300.0 * line.length / wave.length()));
  const double uniform = line.length / cells;
  const double last = std::min(uniform, line.plate_mass / wave.rest().density / (40.0 * refinement));
  exact::Layer water{
      .law = scene.fluid.bodies[run::wave_body(scene)].material.law, .inner = -line.length, .outer = 0.0, .cells = cells};
  if (last < 0.99 * uniform) water.ratio = 1.0 / exact::grading(line.length, cells, last);
  water.start = [&wave, &line](double x) {
    const exact::PlaneWaveState s = wave.at(line.front - x);
    return exact::StartPoint{s.density, s.velocity, s.energy};
  };
  exact::Lagrangian1D mesh(1, {water}, exact::Boundary::free, exact::Boundary::free, {.outer_mass = line.plate_mass});
  output::PlateHistories histories;
  constexpr int samples = 1000;
  for (int i = 0; i <= samples; ++i) {
    mesh.advance(end * i / samples);
    histories.pressure.append(mesh.time(), mesh.cell_pressure().back());
    histories.velocity.append(mesh.time(), mesh.node_velocity().back());
  }
  return histories;
}

output::NamedNumbers taylor_plate(const scene::Scene& scene, const run::Probes& probes, double end) {
  const Line line = line_of(scene);
  const scene::Start::Wave& given = scene.start.wave;
  output::PlateHistories run;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::wall && run.pressure.empty()) run.pressure = probes.series(probe.name, "pressure");
  run.velocity = probes.series(scene.comparison.probe, std::string("velocity_") + "xyz"[given.axis]);
  for (double& v : run.velocity.y) v *= line.way;

  const output::PlateHistories reference = plate_in_one_dimension(scene, end);
  output::NamedNumbers metrics = output::plate_metrics(run, line.plate_mass, given.peak);
  const output::NamedNumbers exact = output::plate_metrics(reference, line.plate_mass, given.peak, "_1d");
  const output::NamedNumbers own = metrics;
  metrics.insert(metrics.end(), exact.begin(), exact.end());

  const exact::PlaneWave wave = run::plane_wave(scene);
  const exact::TaylorPlate theory{
      .peak = given.peak, .decay = given.decay, .impedance = wave.impedance(), .plate_mass = line.plate_mass};
  metrics.emplace_back("cavitation_acoustic_s", theory.cavitation_time() - line.front / wave.rest_sound());
  metrics.emplace_back("impulse_acoustic_pa_s", theory.impulse());
  const char* const names[] = {"cavitation_error", "impulse_error", "end_impulse_error"};
  for (int k = 0; k < 3; ++k) metrics.emplace_back(names[k], own[k].second / exact[k].second - 1.0);
  metrics.emplace_back("velocity_l1", output::difference_norms(run.velocity, reference.velocity, 0.0, end).l1);
  return metrics;
}

}  // namespace undex::judge
