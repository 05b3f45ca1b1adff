#include "judge/tube.hpp"

#include <cmath>

#include "core/constants.hpp"
#include "judge/comparisons.hpp"
#include "judge/metric_names.hpp"
#include "judge/peaks.hpp"
#include "judge/radial.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;
using output::Series;

void add_table(NamedNumbers& out, const Series& series, const std::string& name, const std::string& unit,
               std::initializer_list<int> times_us) {
  for (const int time : times_us)
    if (covers(series, time * us, time * us)) out.emplace_back(metric_at_time(name, time, unit), value_at(series, time * us));
}

void add_velocity(NamedNumbers& out, const Series& v) {
  add_table(out, v, "wall_velocity", "m_s", {20, 25, 30, 40, 60, 80});
  out.emplace_back("motion_start_s", first_rise(v, 1.0, -forever, forever));
  const output::Extremum top = maximum(v, -forever, forever);
  const bool passed = top.y > 0 && !std::isnan(first_below(v, 0.9 * top.y, top.t, forever));
  out.emplace_back("peak_wall_velocity_m_s", passed ? top.y : nan);
  out.emplace_back("peak_wall_velocity_time_s", passed ? top.t : nan);

  // The largest rise from any earlier value within the interval.
  double start = nan, end = nan, gain = 0, lowest = forever, lowest_t = nan;
  if (covers(v, 85 * us, 125 * us))
    for (std::size_t i = 0; i < v.t.size(); ++i) {
      if (v.t[i] < 85 * us || v.t[i] > 125 * us) continue;
      if (v.y[i] < lowest) lowest = v.y[i], lowest_t = v.t[i];
      if (v.y[i] - lowest > gain) gain = v.y[i] - lowest, start = lowest_t, end = v.t[i];
    }
  const bool reloaded = gain > 5;
  out.emplace_back("reload_start_s", reloaded ? start : nan);
  out.emplace_back("reload_end_s", reloaded ? end : nan);
  out.emplace_back("reload_gain_m_s", reloaded ? gain : nan);
}

void add_pressure(NamedNumbers& out, const Series& p) {
  const Peak peak = first_peak(p, 45 * us);
  out.emplace_back("arrival_s", half_rise(p, peak));
  out.emplace_back("peak_pressure_pa", peak.y);
  out.emplace_back("peak_pressure_time_s", peak.t);
  out.emplace_back("peak_pressure_3us_pa", peak.found() ? largest_mean(p, 3 * us, 0, 45 * us) : nan);
  for (const int end : {30, 60, 100})
    if (covers(p, 0, end * us)) out.emplace_back("impulse_0_" + std::to_string(end) + "us_pa_s", integral(p, 0, end * us));
  const double cavitation = peak.found() ? fall_to_zero(p, peak.t, 85 * us) : nan;
  out.emplace_back("cavitation_s", cavitation);
  out.emplace_back("closure_s", std::isnan(cavitation) ? nan : first_rise(p, cavitated, cavitation, forever));
}

/// The tube that a probe lies on: the structure that it names, or the only one; or the nearest solid of such a shape.
std::optional<TubeShape> tube_at(const scene::Scene& scene, const scene::Probe& probe) {
  for (const fem::Settings& structure : scene.structures) {
    if (probe.structure && *probe.structure != structure.name) continue;
    if (const auto* t = std::get_if<fem::TubeMesh>(&structure.mesh))
      return TubeShape{.axis = t->axis,
                       .center = t->center,
                       .inner = t->inner_radius,
                       .outer = t->outer_radius,
                       .low = t->low,
                       .high = t->high};
  }
  std::optional<TubeShape> nearest;
  double least = 1e300;
  for (const solid::Body& solid : scene.solids.bodies) {
    const double away = signed_distance(solid.shape, probe.point, scene.fluid.dimension);
    if (const auto* t = std::get_if<TubeShape>(&solid.shape.base); t && away < least) {
      least = away;
      nearest = *t;
    }
  }
  return nearest;
}

/// The component of a vector history along the outward radius at the probe.
Series radial_at(const scene::Scene& scene, const output::Evidence& evidence, const scene::Probe& probe,
                 const std::string& quantity) {
  const std::optional<TubeShape> tube = tube_at(scene, probe);
  const Axis axis = tube ? Axis{.direction = tube->axis, .center = tube->center} : Axis{};
  const auto component = [&](const char* end) { return evidence.series(probe.name, quantity + end); };
  return radial({component("_x"), component("_y"), component("_z")}, axis.outward(probe.point));
}

/// The compared probe gives displacement and velocity; the first wall probe gives the pressure; the plastic strain is that
/// of another structure probe (mid-wall), or of the compared one.
TubeHistories histories_of(const scene::Scene& scene, const output::Evidence& evidence) {
  TubeHistories histories;
  for (const scene::Probe& probe : scene.probes) {
    if (probe.name != scene.comparison.probe || probe.kind != scene::Probe::Kind::structure) continue;
    histories.displacement = radial_at(scene, evidence, probe, "displacement");
    histories.velocity = radial_at(scene, evidence, probe, "velocity");
    histories.plastic_strain = evidence.series(probe.name, "plastic_strain");
  }
  for (const scene::Probe& probe : scene.probes) {
    if (probe.kind == scene::Probe::Kind::wall && histories.pressure.empty())
      histories.pressure = evidence.series(probe.name, "pressure");
    if (probe.kind == scene::Probe::Kind::structure && probe.name != scene.comparison.probe)
      if (Series strain = evidence.series(probe.name, "plastic_strain"); !strain.empty())
        histories.plastic_strain = std::move(strain);
  }
  return histories;
}

Verdict judge_tube(const scene::Scene& scene, const output::Evidence& evidence, const Reference&) {
  return {.metrics = tube_metrics(histories_of(scene, evidence))};
}

}  // namespace

NamedNumbers tube_metrics(const TubeHistories& histories) {
  for (const Series* series : {&histories.pressure, &histories.displacement, &histories.velocity, &histories.plastic_strain})
    require_valid(*series);
  NamedNumbers out;
  add_table(out, histories.displacement, "displacement", "m", {20, 30, 40, 60, 80, 100, 120, 150, 200, 250, 300});
  if (!histories.velocity.empty()) add_velocity(out, histories.velocity);
  if (!histories.pressure.empty()) add_pressure(out, histories.pressure);
  add_table(out, histories.plastic_strain, "plastic_strain", "", {60, 150});
  return out;
}

Comparison tube() {
  return {.kind = {.name = "tube", .needs_probe = true},
          .title = "motion of a tube's wall, and the pressure at it",
          .judge = judge_tube};
}

}  // namespace undex::judge
