// Rings of bodies in an updated Lagrangian description: their lengths, and what the hoop adds to strains and forces.
//   L_tt = o v_r/r + (1 - o) L_rr,   o = s^4/(1 + s^4),  s = r/(width dx)
// is exact where v_r = a r. Beside the axis, where v_r/r is dv_r/dr and half-way rings leave the first column of a lattice a
// force under uniform pressure, it is taken from the neighbours; the width is such that this column stays at rest. The next one
// has 1 - o near 1e-3. A ring with no neighbours has no strain in the meridian. It is a wire then, whose section gives way to its
// stretch: L_rr and L_zz get -L_tt/2 each, by the share that the neighbours do not say. Forces follow as the derivative of the
// power of the stresses.
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sph_fluid/pairs/ring_kernel.hpp"
#include "sph_solid/first_column.hpp"
#include "sph_solid/solid_pairs.hpp"

namespace undex::solid {

/// Radius in spacings at which o = 1/2: the first column, r = 1/2, takes from its neighbours what balances it.
double SolidPairs::width_of_axis(double eta) {
  const FirstColumn column = first_column(eta);
  const double taken = std::clamp((1.0 - column.inward) / (1.0 + column.own), 1e-3, 0.5);
  return 0.5 * std::pow(taken / (1.0 - taken), 0.25);
}

/// Length of a particle's ring [m]: by which volumes and stresses become those of the meridian; 1 in the plane and in space. That
/// of a total Lagrangian body is the one of the start: with it the forces of contact are the exact derivative of
/// sum V q^2/(2 K) with respect to r as well.
double SolidPairs::ring(const SolidParticles& p, const Range& range, std::uint32_t i) const {
  if (!around_.axisymmetric) return 1.0;
  if (!range.updated) return 2.0 * std::numbers::pi * p.start[i][0];
  const double volume = p.mass[i] / p.rho[i];
  return volume / sph::ring_area(volume, p.x[i][0]);
}

double SolidPairs::own_hoop(const SolidParticles& p, const Range& range, std::uint32_t i) const {
  const double s2 = std::pow(p.x[i][0] / (axis_width_ * range.spacing), 2), s4 = s2 * s2;
  return s4 / (1.0 + s4);
}

void SolidPairs::add_hoop_strain(const SolidParticles& p, const Range& range, std::uint32_t row) {
  const std::uint32_t i = particle_[row];
  double* L = deformation_[row].gradient;
  const double own = own_hoop(p, range, i), alone = 1.0 - deformation_[row].correction[2];
  const double hoop = own * (p.v[i][0] / p.x[i][0]) + (1.0 - own) * L[0];
  L[0] -= 0.5 * alone * hoop;
  L[4] -= 0.5 * alone * hoop;
  L[8] = hoop;
}

/// The stress that works with the hoop strain [Pa].
double SolidPairs::hoop_stress(const Mat3& sigma, std::uint32_t row) const {
  const double alone = 1.0 - deformation_[row].correction[2];
  return sigma(2, 2) - 0.5 * alone * (sigma(0, 0) + sigma(1, 1));
}

void SolidPairs::add_hoop_forces(SolidParticles& p, const Range& range, std::uint32_t row) const {
  const std::uint32_t i = particle_[row];
  Mat3 sigma = p.stress(i);
  sigma.diagonal().array() -= p.viscous_pressure[i];
  p.force[i][0] -= p.mass[i] / p.rho[i] * hoop_stress(sigma, row) * own_hoop(p, range, i) / p.x[i][0];
}

}  // namespace undex::solid
