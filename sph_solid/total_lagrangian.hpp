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
// Behind strong shocks, where neighbours run into each other faster than k can hold apart, a viscosity acts along the pair on
// what is left of their relative velocity once both sides' F have carried it to the middle,
//   pull_ij = s_ij |X_ij| rho (alpha c + beta |w|) w,   w = e . (v_ij - (F'_i + F'_j) X_ij/2),
// with a share that rises from 0 to 1 between compressions (1 - rho0/rho) of 10 and 15 %. Without it particles pass each other.
// A flat layer that touches a rigid plane, and what lies upon it, has images behind the plane as at a symmetry plane
// (plane_contact.hpp): neighbours of the start that count as long as both sides of the pair are backed.
//
// Of a body of revolution x = (r, axial, 0) lies in its meridian, V are volumes of whole rings, A = V/(2 pi R) areas, and
//   w_ij = A_i A_j 2 pi |R_i + R_j|/2 grad W_ij,   F_theta = r/R,   f_i receives -V_i P_theta/R_i along r.
// A pair's ring is the one half-way between both, R_j of an image across the axis being negative. F is exact for u_r = a R,
// u_z = b Z + c all the same, and the force is the derivative of sum V P : dF/dt. With areas alone for weights (R_i in place
// of the mean) uniform stress would throw the first column off the axis; half-way rings leave a quarter of that force, which is
// taken away by what the first column borrows: its F_theta is (1 - b) r/R + b (r/R of the next column), b such that the columns
// of a lattice stay at rest under uniform pressure (total_lagrangian_rings.cpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph_fluid/pairs/kernels.hpp"
#include "sph_solid/plane_contact.hpp"
#include "sph_solid/settings.hpp"
#include "sph_solid/solid_particles.hpp"

namespace undex::solid {

class TotalLagrangian {
 public:
  /// Finds the neighbours of particles begin..end, whose volumes [m^d] at the start are given, within the reach of a kernel of
  /// smoothing length h [m]; `layer` is the body's towards each rigid plane. Throws std::invalid_argument where a particle has
  /// too few neighbours for a gradient.
  TotalLagrangian(const Settings& settings, const sph::Settings& around, const Body& body, std::uint32_t begin, std::uint32_t end,
                  double h, double spacing, std::span<const double> volume, std::span<const OuterLayer> layer,
                  const SolidParticles& particles);

  /// Deformation gradients at the present positions, and stresses after a step dt [s].
  void update(SolidParticles& particles, double dt);
  /// Adds the forces of the present stresses, after a step dt [s] (zero: at the start). `acceleration` [m/s^2] predicts
  /// velocities for the viscosity of pairs.
  void add_forces(SolidParticles& particles, const std::vector<Vec3>& acceleration, double dt);

  /// Can the particle touch that rigid plane as a mirror? It belongs to a flat layer that is parallel to the plane.
  bool may_touch(std::size_t plane, std::uint32_t particle) const;

  void visit_state(StateVisitor& state);

  double hourglass_energy() const;  ///< [J]
  std::size_t memory_bytes() const;

 private:
  using Kernel = sph::WendlandC2;
  static constexpr std::uint32_t none = ~std::uint32_t(0);
  struct Neighbour {
    double wx, wy, wz, s;
    std::uint32_t index;  ///< of the body's own numbering
    std::uint32_t image;  ///< which of images_; 0: the particle itself
  };
  /// How particles are mirrored: x -> sign x + offset.
  struct Image {
    double sign[3], offset[3];  ///< of the present [m]
    double at_start[3];         ///< offset of the start [m]
    PlaneSet planes;            ///< the rigid ones among the mirrors
  };
  struct alignas(64) Row {
    double a[9], k, x[3];
    double hoop;  ///< V P_theta [N m]
  };
  void list_images(const sph::Settings& around, const Settings& settings, std::span<const OuterLayer> layer,
                   const SolidParticles& particles);
  void find_rings(double eta, const SolidParticles& particles);
  /// What makes the weight of a pair at a distance d [m] from V_i V_j times a kernel's gradient [1/m]; 1 in the plane.
  double ring_of_pair(std::uint32_t i, std::uint32_t j, const Vec3& d) const;
  void add_hoop_forces(SolidParticles& particles) const;
  void find_layers(const Settings& settings, std::span<const OuterLayer> layer, const SolidParticles& particles);
  /// Particles that have begun or ceased to be backed since the last step: their moments.
  void follow_contact(const SolidParticles& particles);
  /// F of particle i by the places of all, and sum_j s_ij |F X_ij - x_ij|^2.
  template <class Place>
  double hoop_stretch(const Place& place, std::uint32_t i) const {
    const double own = place(i)[0] / radius_[i];
    const std::uint32_t next = next_column_[i];
    return next == none ? own : (1.0 - borrowed_) * own + borrowed_ * (place(next)[0] / radius_[next]);
  }
  template <class Place>
  Mat3 gradient_of(const Place& place, std::uint32_t i, double& stretched) const;
  void begin_anew(SolidParticles& particles, std::uint32_t i, double dt);
  Mat3 moment_of(std::uint32_t i) const;
  bool counts(std::uint32_t i, const Neighbour& j) const {
    if (j.image == 0) return true;
    const PlaneSet planes = images_[j.image].planes;
    return (planes & backed_[i] & backed_[j.index]) == planes;
  }
  void find_neighbours(std::span<const double> volume, const SolidParticles& particles);
  void make_row(const SolidParticles& particles, std::uint32_t k, const Mat3& F);
  void add_pair_viscosity(SolidParticles& particles, const std::vector<Vec3>& acceleration, double dt);
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
  std::vector<Mat3> deformation_rate_;  ///< over the last step [1/s]
  std::vector<double> stretched_;       ///< sum_j s_ij |F_i X_ij - x_ij|^2 [N m/Pa]
  std::vector<double> stiffness_;       ///< k [Pa]
  std::vector<Row> rows_;
  std::vector<Image> images_;
  std::vector<RigidPlane> planes_;
  std::vector<std::vector<std::uint32_t>> below_;  ///< per rigid plane: which particle of the flat layer one lies upon, or none
  std::vector<double> swollen_;                    ///< volume over V det F, where neighbours have come or gone [-]
  std::vector<unsigned char> anew_;                ///< whose neighbours have in this step; empty: nobody's
  std::vector<PlaneSet> backed_;                   ///< by which rigid planes

  // Of a body of revolution; empty in the plane.
  std::vector<double> radius_;              ///< at the start [m]
  std::vector<std::uint32_t> next_column_;  ///< from whom a particle beside the axis borrows, or none
  double borrowed_ = 0;
};

}  // namespace undex::solid
