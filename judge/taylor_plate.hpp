// comparison.kind = "taylor_plate": Taylor's air-backed plate beside the same plate, rigid, on a fine one-dimensional mesh, and
// beside linear theory. What did not happen, or was not reached, is NaN.
#pragma once

#include <string>

#include "output/run_record.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// A free plate struck by a plane wave.
struct PlateHistories {
  output::Series pressure;  ///< of the fluid at the plate [Pa]
  output::Series velocity;  ///< of the plate, along the wave's way [m/s]
};

/// With `mass` of the plate per area [kg/m^2] and `peak` [Pa] of the incident wave above the pressure at rest:
///   cavitation<label>_s         the pressure at the plate, having passed `peak`, is gone: its fall from 0.2 to 0.1 `peak`
///                               continued in a straight line
///   impulse<label>_pa_s         mass times velocity then
///   end_impulse<label>_pa_s     mass times mean velocity from then to the end of the history
/// Throws std::invalid_argument on a series that is not one.
output::NamedNumbers plate_metrics(const PlateHistories& histories, double mass, double peak, const std::string& label = "");

/// Histories of the scene's wave and water against a rigid plate of the structure's mass per area with vacuum behind, on a
/// one-dimensional mesh, to `end` [s]. `refinement` scales its cells' number.
PlateHistories plate_in_one_dimension(const scene::Scene& scene, double end, int refinement = 1);

}  // namespace undex::judge
