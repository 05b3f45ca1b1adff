#include "judge/free_field.hpp"

#include <algorithm>
#include <limits>

#include "judge/comparisons.hpp"
#include "run/spherical_start.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;
using output::Series;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int reference_cells = 150;  // in the charge; cases/free_field/README.md shows how converged that is

std::vector<scene::Probe> fluid_probes(const scene::Scene& scene) {
  std::vector<scene::Probe> found;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::fluid) found.push_back(probe);
  return found;
}

/// A spherical charge in one medium, and probes in it.
void check(const scene::TableReader& table, const scene::Scene& scene) {
  const auto& bodies = scene.fluid.bodies;
  const auto is_charge = [](const sph::Body& body) {
    return body.variable_h && body.shape.removed.empty() && std::holds_alternative<Sphere>(body.shape.base);
  };
  const auto charges = std::count_if(bodies.begin(), bodies.end(), is_charge);
  if (scene.fluid.dimension != 3 || bodies.size() != 2 || charges != 1)
    table.complain("kind",
                   "comparison.kind = \"free_field\" needs dimension = 3 and two bodies: a \"sphere\" of gas or of a charge, and "
                   "the medium from which it is subtracted");
  if (std::none_of(scene.probes.begin(), scene.probes.end(),
                   [](const scene::Probe& p) { return p.kind == scene::Probe::Kind::fluid; }))
    table.complain("kind", "comparison.kind = \"free_field\" compares the pressures of fluid probes; add [[probes]]");
}

/// Every fluid probe, from the run's first row on. The charge is the scene's own, not yet grown by a spherical start.
Verdict judge_run(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  const std::vector<scene::Probe> places = fluid_probes(scene);
  const std::vector<Series> exact = free_field_in_one_dimension(scene, evidence.time, reference_cells);
  Verdict verdict;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Series run = evidence.series(places[k].name, "pressure");
    if (run.empty()) continue;
    const NamedNumbers one = blast_metrics(run, exact[k], places[k].name, run.t.front(), evidence.time);
    verdict.metrics.insert(verdict.metrics.end(), one.begin(), one.end());
  }
  return verdict;
}

}  // namespace

NamedNumbers blast_metrics(const Series& pressure, const Series& reference, const std::string& name, double a, double b) {
  require_valid(pressure);
  require_valid(reference);
  NamedNumbers out;
  for (const auto& [series, label] : {std::pair{&pressure, ""}, {&reference, "1d_"}}) {
    const output::Extremum top = maximum(*series, a, b);
    out.emplace_back(std::string("peak_") + label + name + "_pa", top.y);
    out.emplace_back(std::string("arrival_") + label + name + "_s", top.y > 0 ? first_rise(*series, 0.5 * top.y, a, b) : nan);
    out.emplace_back(std::string("impulse_") + label + name + "_pa_s", integral(*series, a, b));
  }
  out.emplace_back("l1_pressure_" + name, difference_norms(pressure, reference, a, b).l1);
  return out;
}

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

Comparison free_field() {
  return {.kind = {.name = "free_field", .check = check},
          .title = "pressures of a spherical charge in the open, beside its one-dimensional flow",
          .judge = judge_run};
}

}  // namespace undex::judge
