// comparison.kind = "free_field": a spherical charge in the open, beside its one-dimensional flow.
#pragma once

#include <string>
#include <vector>

#include "output/run_record.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// A blast wave at a fixed point, as a mesh shows it from time zero on.
struct Blast {
  output::Series pressure;  ///< [Pa]
  /// The time [s] over which the mesh smears the front; 0: it is sharp.
  double smear = 0;
};

/// The peak behind the wave's front [Pa]: where that is smeared, the pressure a few widths behind it continued to the time of
/// its half rise, log p by a parabola. The largest value of a mesh is low in first order where its viscosity smears the front,
/// and high where a limiter lets it overshoot.
double peak_behind_front(const Blast& blast);

/// A blast wave at a fixed point, run beside reference:
/// peak_<name>_pa, arrival_<name>_s of the run, over the time a..b [s] that it covers; NaN where the wave has passed before a
/// peak_1d_<name>_pa, arrival_1d_<name>_s of the reference, over all its time: its front's (peak_behind_front) and its half
/// rise
///   impulse_<name>_pa_s, impulse_1d_<name>_pa_s   integrals over a..b of both
///   l1_pressure_<name>          mean of |p - reference| over a..b, over the reference's peak
/// Throws std::invalid_argument on a series that is not one.
output::NamedNumbers blast_metrics(const output::Series& pressure, const Blast& reference, const std::string& name, double a,
                                   double b);

/// Pressures at the scene's fluid probes, in their order, from the charge's one-dimensional flow in unbounded water to `end` [s].
/// `charge_cells` as of run::SphericalFlow. They depend on charge, medium and probes alone, not on how far the scene's water
/// goes.
std::vector<Blast> free_field_in_one_dimension(const scene::Scene& scene, double end, int charge_cells);

}  // namespace undex::judge
