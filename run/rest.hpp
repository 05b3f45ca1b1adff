// What the bodies of a scene are before anything happens: uniform, or under gravity of their depth.
#pragma once

#include <functional>

#include "scene/scene.hpp"

namespace undex::run {

/// A body at rest at a place of the scene.
struct Rest {
  double density, energy, pressure;  ///< [kg/m^3], specific internal energy [J/kg], [Pa]
};
/// Of a body of the scene, at any place [m].
std::function<Rest(const Vec3&)> rest_of(const sph::Body& body, const scene::Scene& scene);

/// Where a body has its pressure at the start [m]: its level, or anywhere.
Vec3 place_of_pressure(const sph::Body& body, const scene::Scene& scene);

/// Specific internal energy [J/kg] of a body of that density at rest: its compression energy where the law is barotropic.
double rest_energy(const sph::Body& body, double density);

/// Mean density and internal energy of a body at rest, over the depths that it has.
struct MeanRest {
  double density, energy;  ///< [kg/m^3], [J/kg]
};
MeanRest mean_rest(const sph::Body& body, const scene::Scene& scene);

}  // namespace undex::run
