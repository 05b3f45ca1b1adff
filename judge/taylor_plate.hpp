// comparison.kind = "taylor_plate": Taylor's air-backed plate beside the same plate, rigid, on a fine one-dimensional mesh, and
// beside linear theory; or Bleich and Sandler's, on the sea: under gravity, the atmosphere and loads on its back. What did not
// happen, or was not reached, is NaN.
#pragma once

#include <string>

#include "output/run_record.hpp"
#include "output/series.hpp"
#include "scene/scene.hpp"

namespace undex::judge {

/// A free plate struck by a plane wave.
struct PlateHistories {
  output::Series pressure;        ///< of the fluid at the plate [Pa]
  output::Series velocity;        ///< of the plate, along the wave's way [m/s]
  output::Series displacement{};  ///< likewise [m]
};

/// With `mass` of the plate per area [kg/m^2] and `peak` [Pa] of the incident wave above the pressure at rest:
///   cavitation<label>_s         the pressure at the plate, having passed `peak`, is gone: its fall from 0.2 to 0.1 `peak`
///                               continued in a straight line
///   impulse<label>_pa_s         mass times velocity then
///   end_impulse<label>_pa_s     mass times mean velocity from then to the end of the history
/// Throws std::invalid_argument on a series that is not one.
output::NamedNumbers plate_metrics(const PlateHistories& histories, double mass, double peak, const std::string& label = "");

/// Of a plate that the atmosphere and its weight drive back:
///   peak_velocity<label>_m_s, peak_displacement<label>_m
///   closure<label>_s            the cavity below it has closed: the plate, on its way back, has lost half of its largest speed
output::NamedNumbers return_metrics(const PlateHistories& histories, const std::string& label = "");

/// The same plate on a one-dimensional mesh.
struct PlateReference : PlateHistories {
  double first_void;  ///< when the water first cavitates [s]; NaN: it does not
};

/// Histories of the scene's wave and water against a rigid plate of the structure's mass per area, with the pressure of the
/// surroundings and the scene's loads behind, to `end` [s]. `refinement` scales the number of cells.
PlateReference plate_in_one_dimension(const scene::Scene& scene, double end, int refinement = 1);

}  // namespace undex::judge
