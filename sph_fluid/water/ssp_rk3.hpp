// The strong-stability-preserving Runge-Kutta method of third order (Shu, Osher 1988, J. Comput. Phys. 77, 439, eq. 2.18), for
// u = (x, v, ln rho, e, and alpha of a viscosity with a switch):
//   u1 = u + dt L(u),   u2 = 3/4 u + 1/4 (u1 + dt L(u1)),   u' = 1/3 u + 2/3 (u2 + dt L(u2))
// that is u' = u + dt (L(u)/6 + L(u1)/6 + 2 L(u2)/3): what walls receive is booked with these weights, so nothing is lost.
// The logarithm keeps densities positive. Rates of the step's end are those of the next step's beginning: three evaluations.
// A step of which a stage goes wrong is not taken.
#pragma once

#include "sph_fluid/water/water.hpp"

namespace undex::sph {

/// One step of all; throws NumericalStop in the middle of one that goes wrong. Moving walls are as their owner shows them at the
/// end of the step; before it they are where the last step left them, and in its middle on the cubic through both.
void step_ssp_rk3(Water& water, double dt);

}  // namespace undex::sph
