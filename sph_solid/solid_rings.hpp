// The passes of solid_schemes.hpp over rings about an axis, seen in the meridian (r, axial). Rows hold areas A where they else
// hold volumes, and a pair's ring is the one half-way between its two, the image of j across the axis having r_j < 0:
//   w_ij = A_j 2 pi |r_i + r_j|/2 grad W_ij
//   GradientOfRings  L_i = (sum_j (v_j - v_i) w_ij^T) B_i,  B_i = (sum_j (x_j - x_i) w_ij^T)^-1, exact for linear motions
//   ForcesOfRings    f_i = sum_j A_i (V_i/A_i sigma_i B_i + V_j/A_j sigma_j B_j) w_ij, the derivative of the stresses' power
//                    with L
// A tension repels rings nearer than a spacing, and than the side of their areas: a stretch round the axis draws all of them
// together, without clumps. No more of a tension counts than the ideal strength of a solid, a tenth of its shear modulus: a law
// without spall has no bound, and what clumps would take from the heat as they are pushed apart would make more tension.
// What the hoop adds to both belongs to each ring alone (solid_pairs_rings.cpp). Pairs push each other alike; what they give
// across the axis is no momentum of a whole ring.
#pragma once

#include "sph_solid/solid_schemes.hpp"

namespace undex::solid::UNDEX_LEVEL {

/// A row has no third velocity in the meridian; there it has the radius.
template <class Base, class V>
struct StateOfSolidRing : Base {
  V radius;

  template <class Read>
  UNDEX_INLINE void read(Read entry) {
    Base::read(entry);
    radius = this->vz;
    this->vz = V{};
  }
  UNDEX_INLINE V half_way(const Pair<V>& pair) const {
    const V middle = radius - Element<V>(0.5) * pair.dx;
    return maximum(middle, -middle);
  }
};

template <class T>
struct GradientOfRings : VelocityGradient<T> {
  using V = Vec<T>;
  using Plane = VelocityGradient<T>;
  using State = StateOfSolidRing<typename Plane::State, V>;
  using Sums = typename Plane::Sums;

  explicit GradientOfRings(const PairInput& in) : Plane(in) { this->least = 0.08; }  // a corner in the meridian has 0.12 to 0.15

  UNDEX_INLINE void pair(const State& i, const State& j, Pair<V> pair, Sums& si, Sums& sj) const {
    pair.F *= i.half_way(pair);
    Plane::pair(i, j, pair, si, sj);
  }

  /// The sums are made such that those of a ring far from the axis are the plane's; B comes without 2 pi [1/m]. In place of zz it
  /// has the share of the ring's motion that its neighbours say, from 0 (alone) to 1.
  void store(const Vec<double>* s, bool gas, const PairInput& in, std::uint32_t first, int count) const {
    Vec<double> scaled[Sums::count], inverse{};
    for (int l = 0; l < count; ++l) {
      const double r = in.x[first + l], least = 0.5 * __builtin_sqrt(in.fluid[first + l].volume);  // as ring_area has it
      inverse[l] = 1.0 / (r > least ? r : least);
    }
    for (int k = 0; k < Sums::count; ++k) scaled[k] = s[k] * inverse;
    Plane::store(scaled, gas, in, first, count);
    for (int l = 0; l < count; ++l) {
      double* B = in.deformation[first + l].correction;
      for (int k = 0; k < 6; ++k) B[k] *= inverse[l];
      B[2] = this->trust_in(scaled[0][l] * scaled[1][l] - scaled[3][l] * scaled[3][l]);
    }
  }
};

template <class T>
struct ForcesOfRings : SolidForces<T> {
  using V = Vec<T>;
  using Plane = SolidForces<T>;
  using State = StateOfSolidRing<typename Plane::State, V>;
  using Sums = typename Plane::Sums;
  using Plane::Plane;

  UNDEX_INLINE void pair(const State& i, const State& j, Pair<V> pair, Sums& si, Sums& sj) const {
    pair.F *= T(2.0 * 3.14159265358979323846) * i.half_way(pair);
    const V near2 = minimum(T(0.5) * (i.volume + j.volume), broadcast(this->spacing2));
    Plane::push(i, j, pair, near2, pull(i, pair) + pull(j, pair), si, sj);
  }
  UNDEX_INLINE static V pull(const State& i, const Pair<V>& pair) {
    const V strength = T(0.1) * i.rho * i.shear_sound * i.shear_sound;
    return maximum(minimum(along(i.stress, pair), strength * pair.r2), V{});
  }
};

}  // namespace undex::solid::UNDEX_LEVEL
