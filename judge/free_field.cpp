#include "judge/free_field.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "judge/comparisons.hpp"
#include "run/spherical_flow.hpp"
#include "scene/line.hpp"
#include "scene/numbers.hpp"
#include "scene/table_reader.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;
using output::Series;

constexpr int reference_cells = 400;  // in the charge; docs/results/free_field.md shows how converged that is

constexpr double most_samples = 1e5;
constexpr double nearest_fit = 4, farthest_fit = 20;  // of the pressure behind a front, in times of smearing

/// When p first rises through half of its `top`; NaN where that is nothing.
double half_rise_of(const Series& p, double top) { return top > 0 ? first_rise(p, 0.5 * top, -forever, forever) : nan; }

std::vector<scene::Probe> probes_of_free_field(const scene::Scene& scene) {
  std::vector<scene::Probe> found;
  for (const scene::Probe& probe : scene.probes)
    if (probe.kind == scene::Probe::Kind::fluid) found.push_back(probe);
  return found;
}

/// A spherical charge in one medium, and probes in it.
void check_free_field(const scene::TableReader& table, const scene::Scene& scene) {
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
Verdict judge_free_field(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  const std::vector<scene::Probe> places = probes_of_free_field(scene);
  const std::vector<Blast> exact = free_field_in_one_dimension(scene, evidence.time, reference_cells);
  Verdict verdict;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Series run = evidence.series(places[k].name, "pressure");
    if (run.empty()) continue;
    NamedNumbers one = blast_metrics(run, exact[k], places[k].name, run.t.front(), evidence.time);
    if (on_a_line(scene.geometry) && !scene::line_of(scene).rests_ahead) {  // smeared as the reference's is, over its own cells
      const double wider = scene.fluid.lattice.spacing * reference_cells / run::spherical_charge(scene).radius;
      one.front().second = peak_behind_front({.pressure = run, .smear = wider * exact[k].smear});
    }
    verdict.metrics.insert(verdict.metrics.end(), one.begin(), one.end());
    for (const char* what : {"peak_", "arrival_"})
      verdict.missing.emplace_back(what + places[k].name + (*what == 'p' ? "_pa" : "_s"),
                                   "the wave passed the probe before the particles took over, at " +
                                       scene::rounded(run.t.front()) + " s; take an earlier start.time");
  }
  return verdict;
}

}  // namespace

double peak_behind_front(const Blast& blast) {
  const Series& p = blast.pressure;
  const output::Extremum top = maximum(p, -forever, forever);
  const double arrival = half_rise_of(p, top.y);
  if (!(blast.smear > 0) || std::isnan(arrival)) return top.y;
  // Least squares of log p over (t - arrival)/smear.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  int count = 0;
  for (std::size_t i = 0; i < p.t.size(); ++i) {
    const double x = (p.t[i] - arrival) / blast.smear;
    if (x < nearest_fit || x > farthest_fit || !(p.y[i] > 0)) continue;
    const Vec3 powers(1, x, x * x);
    normal += powers * powers.transpose();
    right += std::log(p.y[i]) * powers;
    ++count;
  }
  const bool ends_early = (p.t.back() - arrival) / blast.smear < farthest_fit;
  if (ends_early || count < 8) return top.y;
  return std::exp(Vec3(normal.ldlt().solve(right))[0]);
}

NamedNumbers blast_metrics(const Series& pressure, const Blast& reference, const std::string& name, double a, double b) {
  require_valid(pressure);
  require_valid(reference.pressure);
  const double peak = peak_behind_front(reference);
  const double arrival = half_rise_of(reference.pressure, maximum(reference.pressure, -forever, forever).y);
  const bool seen = !(arrival <= a) || a <= reference.pressure.t.front();
  const double top = seen ? maximum(pressure, a, b).y : nan;
  return {{"peak_" + name + "_pa", top},
          {"arrival_" + name + "_s", top > 0 ? first_rise(pressure, 0.5 * top, a, b) : nan},
          {"impulse_" + name + "_pa_s", integral(pressure, a, b)},
          {"peak_1d_" + name + "_pa", peak},
          {"arrival_1d_" + name + "_s", arrival},
          {"impulse_1d_" + name + "_pa_s", integral(reference.pressure, a, b)},
          {"l1_pressure_" + name, difference_norms(pressure, reference.pressure, a, b).l1}};
}

std::vector<Blast> free_field_in_one_dimension(const scene::Scene& scene, double end, int charge_cells) {
  const std::vector<scene::Probe> probes = probes_of_free_field(scene);
  double farthest = 0;
  const auto radius = [](const scene::Probe& probe, const Sphere& charge) { return (probe.point - charge.center).norm(); };
  const Sphere charge = run::spherical_charge(scene);
  for (const scene::Probe& probe : probes) farthest = std::max(farthest, radius(probe, charge));
  // What the mesh's end sends back comes too late for the farthest probe.
  run::SphericalFlow flow(scene, std::max(2.0 * farthest, 4.0 * charge.radius), charge_cells);
  // A sample whenever sound crosses half a cell of those at the front.
  const double rest_sound = flow.mesh().cell_sound().back();
  std::vector<Blast> blasts(probes.size());
  for (std::size_t k = 0; k < probes.size(); ++k) blasts[k].smear = flow.cell_width(radius(probes[k], charge)) / rest_sound;
  for (;;) {
    for (std::size_t k = 0; k < probes.size(); ++k)
      blasts[k].pressure.append(flow.time(), flow.mesh().at(radius(probes[k], charge)).pressure);
    if (flow.time() >= end) return blasts;
    const double width = flow.cell_width(std::min(farthest, std::max(flow.front(), charge.radius)));
    flow.advance(std::min(end, flow.time() + std::max(0.5 * width / rest_sound, end / most_samples)));
  }
}

Comparison free_field() {
  return {.kind = {.name = "free_field", .check = check_free_field},
          .title = "pressures of a spherical charge in the open, beside its one-dimensional flow",
          .judge = judge_free_field};
}

}  // namespace undex::judge
