#include "judge/free_field.hpp"

#include <algorithm>

#include "run/spherical_start.hpp"
#include "judge/wave_metrics.hpp"

namespace undex::judge {
namespace {

constexpr int reference_cells = 150;  // in the charge; cases/free_field/README.md shows how converged that is

std::vector<scene::Probe> fluid_probes(const scene::Scene& scene) {
  std::vector<scene::Probe> found;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::fluid) found.push_back(probe);
  return found;
}

}  // namespace

std::vector<output::Series> free_field_in_one_dimension(const scene::Scene& scene, double end, int charge_cells) {
  const std::vector<scene::Probe> probes = fluid_probes(scene);
  double farthest = 0;
  const auto radius = [](const scene::Probe& probe, const Sphere& charge) { return (probe.point - charge.center).norm(); };
  const Sphere charge = run::spherical_charge(scene);
  for (const scene::Probe& probe : probes) farthest = std::max(farthest, radius(probe, charge));
  // What the mesh's end sends back comes too late for the farthest probe.
  exact::Lagrangian1D flow = run::spherical_flow(scene, std::max(2.0 * farthest, 4.0 * charge.radius), charge_cells);
  std::vector<output::Series> pressures(probes.size());
  constexpr int samples = 2000;
  for (int i = 0; i <= samples; ++i) {
    flow.advance(end * i / samples);
    for (std::size_t k = 0; k < probes.size(); ++k) pressures[k].append(flow.time(), flow.at(radius(probes[k], charge)).pressure);
  }
  return pressures;
}

output::NamedNumbers free_field(const scene::Scene& scene, const run::Probes& probes, double end) {
  const std::vector<scene::Probe> places = fluid_probes(scene);
  const std::vector<output::Series> exact = free_field_in_one_dimension(scene, end, reference_cells);
  output::NamedNumbers metrics;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const output::Series run = probes.series(places[k].name, "pressure");
    if (run.empty()) continue;
    const output::NamedNumbers one = output::blast_metrics(run, exact[k], places[k].name, run.t.front(), end);
    metrics.insert(metrics.end(), one.begin(), one.end());
  }
  return metrics;
}

}  // namespace undex::judge
