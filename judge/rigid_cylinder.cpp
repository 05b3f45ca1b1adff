#include "judge/rigid_cylinder.hpp"

#include <cmath>

#include "core/constants.hpp"
#include "judge/comparisons.hpp"
#include "judge/peaks.hpp"

namespace undex::judge {
namespace {

using output::NamedNumbers;
using output::Series;

double mean_difference(const Series& p, const Series& reference, double a, double b) {
  if (!covers(p, a, b) || !covers(reference, a, b)) return nan;
  constexpr int samples = 9500;
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const double t = a + (b - a) * (i + 0.5) / samples;
    sum += std::abs(value_held(p, t) - value_held(reference, t));
  }
  return sum / samples;
}

Verdict judge_rigid_cylinder(const scene::Scene& scene, const output::Evidence& evidence, const Reference& reference) {
  return {.metrics = rigid_cylinder_metrics(evidence.series(scene.comparison.probe, "pressure"), reference.first_history())};
}

}  // namespace

NamedNumbers rigid_cylinder_metrics(const Series& p, const Series& reference) {
  require_valid(p);
  require_valid(reference);
  const Peak peak = first_peak(p, 45 * us);
  Peak second;
  if (covers(p, 85 * us, 112.5 * us)) {
    const output::Extremum top = maximum(p, 85 * us, 112.5 * us);
    if (top.y >= least_peak) second = {top.t, top.y};
  }
  NamedNumbers out;
  out.emplace_back("arrival_s", half_rise(p, peak));
  out.emplace_back("first_peak_pa", peak.y);
  out.emplace_back("first_peak_time_s", peak.t);
  out.emplace_back("first_peak_5us_pa", peak.found() ? largest_mean(p, 5 * us, 0, 45 * us) : nan);
  out.emplace_back("impulse_0_45us_pa_s", integral(p, 0, 45 * us));
  out.emplace_back("cavitation_s", peak.found() ? fall_to_zero(p, peak.t, 85 * us) : nan);
  out.emplace_back("collapse_s", first_rise(p, 1e8, 60 * us, forever));
  out.emplace_back("second_peak_time_s", second.t);
  out.emplace_back("second_peak_5us_pa", second.found() ? largest_mean(p, 5 * us, 85 * us, 110 * us) : nan);
  out.emplace_back("impulse_85_112us_pa_s", integral(p, 85 * us, 112.5 * us));
  out.emplace_back("second_cavitation_s", second.found() ? fall_to_zero(p, second.t, forever) : nan);
  if (!reference.empty()) out.emplace_back("l1_0_95us", mean_difference(p, reference, 0, 95 * us) / 0.722e9);
  return out;
}

Comparison rigid_cylinder() {
  return {.kind = {.name = "rigid_cylinder", .needs_probe = true},
          .title = "pressure at the wall of a rigid cylinder",
          .history = "midline_wall_pressure.csv",
          .judge = judge_rigid_cylinder};
}

}  // namespace undex::judge
