// The deviatoric stress of a solid over one step, for eight points at once: Hughes-Winget rotation and elastic increment,
// then the radial return of materials/solid.hpp. Elements and particles both come here, so that a comparison of the two
// compares discretisations, not laws. Hypoelastic with the Jaumann rate in the limit of small steps (Chen et al. 2019,
// eqs 12-15); the finite rotation is that of Hughes and Winget 1980, doi 10.1002/nme.1620151210.
#pragma once

#include "materials/solid.hpp"

namespace undex::materials {

/// One value at each of eight points.
inline constexpr int points_at_once = 8;
using EightPoints = double[points_at_once];

/// State of eight points. Deviator of the Cauchy stress: xx, yy, zz, yz, zx, xy [Pa].
struct SolidPoints {
  EightPoints deviator[6];
  EightPoints plastic_strain;  ///< [-]
  EightPoints temperature;     ///< [K]
  EightPoints damage;          ///< [-]; failed at 1. Neither read nor written where the solid cannot fail (`can_fail`)
};

/// What a step did at the eight points.
struct SolidStep {
  EightPoints strain_norm;   ///< size of the strain increment, an upper bound of its largest principal value [-]
  EightPoints old_work;      ///< deviator at the start times the strain increment [J/m^3]
  EightPoints new_work;      ///< deviator at the end times the strain increment [J/m^3]
  EightPoints plastic_work;  ///< [J/m^3]
};

/// Takes eight points over a step dt [s] in which the displacement has changed by the gradient d u_i/d x_j =
/// gradient[i][j] with respect to the positions at the middle of the step. Half of the elastic increment comes before the
/// step's rotation and half after it. `specific_volume` [m^3/kg] turns plastic work into heat. Traces of gradient leave the
/// deviator alone: pressure is the caller's (`evaluate`, then `spalls` and `carried_pressure`; a cut-off acts even where no
/// point can fail).
/// `pressure` [Pa] is that at the start of the step; only Johnson-Cook damage reads it. A failed point, from the step in
/// which its damage reaches 1 on, has no deviator; the elastic energy which that held counts as plastic work.
void advance_deviator(const Solid& solid, const EightPoints (&gradient)[3][3], const EightPoints& specific_volume,
                      const EightPoints& pressure, double dt, SolidPoints& points, SolidStep& step);

}  // namespace undex::materials
