// A solid body whose particles keep the neighbours and the kernels of the start. With X_ij = X_j - X_i and w_ij = V_i V_j
// grad W_ij, all of the start,
//   F_i = (sum_j x_ij w_ij^T) M_i^-1,  M_i = sum_j X_ij w_ij^T          (exact for linear motions)
//   f_i = sum_j (A_i + A_j) w_ij + s_ij (k_i + k_j) x_ij,  A_i = V_i P_i M_i^-1 - k_i F_i
// P = J sigma F^-T being the first Piola-Kirchhoff stress. The terms with k are the exact derivative of
//   U = sum_i k_i/2 sum_j s_ij |F_i X_ij - x_ij|^2,  s_ij = w_ij . X_ij/|X_ij|^2 > 0,
// the stiffness of motions that no F sees (the zero-energy modes of nodal integration; compare Silling 2017,
// doi 10.1016/j.cma.2017.03.043, and Ganzenmueller 2015, doi 10.1016/j.cma.2014.12.005). F_i minimises the sum for fixed
// weights s_ij, which is why no term with dF/dx is left over. k follows the secant of the flow curve, so that plastic flow
// is not held up: k = hourglass G/(1 + 3 G eps_p/Y).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph_solid/settings.hpp"
#include "sph_solid/solid_particles.hpp"

namespace undex::solid {

class TotalLagrangian {
 public:
  /// Finds the neighbours of particles begin..end, whose volumes [m^d] at the start are given. `scale` multiplies volumes'
  /// smoothing length h [m]. Throws std::invalid_argument where a particle has too few neighbours for a gradient.
  TotalLagrangian(const Settings& settings, const sph::Settings& around, const Body& body, std::uint32_t begin, std::uint32_t end,
                  double h, double spacing, std::span<const double> volume, const SolidParticles& particles);

  /// Deformation gradients at the present positions, and stresses after a step dt [s].
  void update(SolidParticles& particles, double dt);
  /// Adds the forces of the present stresses.
  void add_forces(SolidParticles& particles);

  void visit_state(StateVisitor& state);

  double hourglass_energy() const;  ///< [J]
  const Mat3& deformation(std::uint32_t particle) const { return deformation_[particle - begin_]; }
  std::size_t memory_bytes() const;

 private:
  struct Neighbour {
    double wx, wy, wz, s;
    std::uint32_t index;  ///< of the body's own numbering
    std::uint32_t image;  ///< mirrored across which planes
  };
  struct alignas(64) Row {
    double a[9], k, x[3];
  };
  void find_neighbours(const sph::Settings& around, std::span<const double> volume, const SolidParticles& particles);
  void make_row(const SolidParticles& particles, std::uint32_t k, const Mat3& F);
  void find_rate(SolidParticles& particles, std::uint32_t i, const Mat3& F) const;

  const Body* body_;
  std::uint32_t begin_, end_;
  int dimension_;
  double h_, spacing_, hourglass_, yield_;
  BulkViscosity viscosity_;
  std::vector<std::uint64_t> first_;  ///< of each particle's neighbours
  std::vector<Neighbour> neighbours_;
  std::vector<double> start_density_, volume_;
  std::vector<Mat3> inverse_moment_, deformation_;
  std::vector<double> stretched_;  ///< sum_j s_ij |F_i X_ij - x_ij|^2 [N m/Pa]
  std::vector<double> stiffness_;  ///< k [Pa]
  std::vector<Row> rows_;
};

}  // namespace undex::solid
