#include "fem_structure/elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fem_structure/pressure_step.hpp"

namespace undex::fem {
namespace {

using Lanes = materials::EightPoints;  // one value per quadrature point

/// result[i][j] = sum over nodes of v[i] dN/dxi_j, at all quadrature points.
inline void contract(const double (&v)[3][8], const ReferenceCell& reference, Lanes (&result)[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Lanes sum = {};
      for (int node = 0; node < 8; ++node) {
        const double value = v[i][node];
        const double* gradient = reference.gradient[j][node];
        for (int q = 0; q < 8; ++q) sum[q] += value * gradient[q];
      }
      for (int q = 0; q < 8; ++q) result[i][j][q] = sum[q];
    }
}

/// Inverse of the Jacobian and its determinant, at all quadrature points.
inline void invert(const Lanes (&a)[3][3], Lanes (&inverse)[3][3], Lanes& determinant) {
  for (int q = 0; q < 8; ++q) {
    const double c00 = a[1][1][q] * a[2][2][q] - a[1][2][q] * a[2][1][q];
    const double c01 = a[1][2][q] * a[2][0][q] - a[1][0][q] * a[2][2][q];
    const double c02 = a[1][0][q] * a[2][1][q] - a[1][1][q] * a[2][0][q];
    const double det = a[0][0][q] * c00 + a[0][1][q] * c01 + a[0][2][q] * c02;
    const double over = 1.0 / det;
    determinant[q] = det;
    inverse[0][0][q] = c00 * over;
    inverse[1][0][q] = c01 * over;
    inverse[2][0][q] = c02 * over;
    inverse[0][1][q] = (a[0][2][q] * a[2][1][q] - a[0][1][q] * a[2][2][q]) * over;
    inverse[1][1][q] = (a[0][0][q] * a[2][2][q] - a[0][2][q] * a[2][0][q]) * over;
    inverse[2][1][q] = (a[0][1][q] * a[2][0][q] - a[0][0][q] * a[2][1][q]) * over;
    inverse[0][2][q] = (a[0][1][q] * a[1][2][q] - a[0][2][q] * a[1][1][q]) * over;
    inverse[1][2][q] = (a[0][2][q] * a[1][0][q] - a[0][0][q] * a[1][2][q]) * over;
    inverse[2][2][q] = (a[0][0][q] * a[1][1][q] - a[0][1][q] * a[1][0][q]) * over;
  }
}

/// Nodal forces of a stress field (times quadrature weights): f_I = sum_q w sigma grad N_I.
inline void spread(const Lanes (&stress)[6], const Lanes (&inverse)[3][3], const Lanes& weight, const ReferenceCell& reference,
                   double (&force)[3][8]) {
  constexpr int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  for (int i = 0; i < 3; ++i) {
    Lanes pulled[3];
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        pulled[j][q] =
            weight[q] * (stress[component[i][0]][q] * inverse[j][0][q] + stress[component[i][1]][q] * inverse[j][1][q] +
                         stress[component[i][2]][q] * inverse[j][2][q]);
    for (int node = 0; node < 8; ++node) {
      Lanes sum;
      for (int q = 0; q < 8; ++q)
        sum[q] = pulled[0][q] * reference.gradient[0][node][q] + pulled[1][q] * reference.gradient[1][node][q] +
                 pulled[2][q] * reference.gradient[2][node][q];
      force[i][node] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    }
  }
}

/// Share of the points that have not failed.
inline double intact_share(const Lanes& damage) {
  int intact = 0;
  for (int q = 0; q < 8; ++q) intact += damage[q] < materials::failed;
  return 0.125 * intact;
}

}  // namespace

Elements::Elements(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity)
    : ElementSet(grid, material, linear_viscosity, quadratic_viscosity), reference_(grid.reference) {
  const std::size_t n = cells_.size();
  for (auto& component : deviator_) component.assign(8 * n, 0.0);
  plastic_strain_.assign(8 * n, 0.0);
  temperature_.assign(8 * n, material.T_room);
  weight_.resize(8 * n);
  if (materials::can_fail(material)) damage_.assign(8 * n, 0.0);
  for (auto* field : {&viscous_pressure_, &energy_, &volume_}) field->assign(n, 0.0);
  pressure_.assign(n, materials::evaluate(material_.pressure, material_.rho0, material_.rho0, 0.0).pressure);
  for (std::size_t c = 0; c < n; ++c) {
    double x[3][8];
    Lanes jacobian[3][3], inverse[3][3], determinant;
    collect(grid.nodes, cells_[c], x);
    contract(x, reference_, jacobian);
    invert(jacobian, inverse, determinant);
    for (int q = 0; q < 8; ++q) {
      weight_[8 * c + q] = reference_.weight[q] * determinant[q];
      volume_[c] += weight_[8 * c + q];
    }
  }
  find_first_steps(grid);
}

/// What the nodes' displacement does to a cell over a step.
struct Elements::Step {
  Lanes gradient[3][3];         // of the displacement, in the midpoint configuration
  Lanes inverse[3][3], weight;  // of the Jacobian, and of the quadrature, at the end
  double volume = 0.0;          // at the end [m^3]

  /// False where the cell has turned inside out on the way, or is not finite.
  bool find(const CellVectors& x, const CellVectors& u, const ReferenceCell& reference) {
    Lanes jacobian[3][3], change[3][3], middle[3][3], determinant;
    contract(x, reference, jacobian);
    contract(u, reference, change);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int q = 0; q < 8; ++q) middle[i][j][q] = jacobian[i][j][q] - 0.5 * change[i][j][q];
    invert(middle, inverse, determinant);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int q = 0; q < 8; ++q)
          gradient[i][j][q] =
              change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] + change[i][2][q] * inverse[2][j][q];
    bool upright = true;
    for (int q = 0; q < 8; ++q) upright &= determinant[q] > 0.0;
    invert(jacobian, inverse, determinant);
    for (int q = 0; q < 8; ++q) {
      upright &= determinant[q] > 0.0;  // false for NaN
      weight[q] = reference.weight[q] * determinant[q];
      volume += weight[q];
    }
    return upright && std::isfinite(volume);
  }
};

/// What its points gave: works [J], and how many have not failed.
struct Elements::Work {
  double deviatoric = 0.0, plastic = 0.0, most_strain = 0.0;
  double intact_before = 1.0, intact = 1.0;  // share of the points
};

bool Elements::advance_cell(std::size_t c, std::span<const Vec3> positions, std::span<const Vec3> displacements, double dt) {
  CellVectors x, u, force;
  collect(positions, cells_[c], x);
  collect(displacements, cells_[c], u);
  Step step;
  if (!step.find(x, u, reference_)) return false;
  Lanes stress[6];
  Work work = advance_points(c, step, dt, stress);
  advance_volume(c, step.volume, dt, work, x);
  const double total_pressure = pressure_[c] + viscous_pressure_[c];
  for (int k = 0; k < 3; ++k)
    for (int q = 0; q < 8; ++q) stress[k][q] -= total_pressure;
  spread(stress, step.inverse, step.weight, reference_, force);
  return put_forces(c, force);
}

/// Stress deviators at the quadrature points.
Elements::Work Elements::advance_points(std::size_t c, const Step& step, double dt, Lanes (&stress)[6]) {
  materials::SolidPoints points;
  materials::SolidStep done;
  Lanes specific_volume, start_pressure;
  for (int q = 0; q < 8; ++q) {
    const std::size_t at = 8 * c + q;
    for (int k = 0; k < 6; ++k) points.deviator[k][q] = deviator_[k][at];
    points.plastic_strain[q] = plastic_strain_[at];
    points.temperature[q] = temperature_[at];
    specific_volume[q] = step.volume / cell_mass_[c];
    start_pressure[q] = pressure_[c];
  }
  Work work;
  const bool can_fail = !damage_.empty();
  if (can_fail) {
    std::copy_n(&damage_[8 * c], 8, points.damage);
    work.intact_before = intact_share(points.damage);
  }
  materials::advance_deviator(material_, step.gradient, specific_volume, start_pressure, dt, points, done);
  if (can_fail) {
    std::copy_n(points.damage, 8, &damage_[8 * c]);
    work.intact = intact_share(points.damage);
  }
  for (int q = 0; q < 8; ++q) {
    const std::size_t at = 8 * c + q;
    const double weight = step.weight[q];
    work.most_strain = std::max(work.most_strain, done.strain_norm[q]);
    work.deviatoric += 0.5 * (weight_[at] * done.old_work[q] + weight * done.new_work[q]);
    work.plastic += 0.5 * (weight_[at] + weight) * done.plastic_work[q];
    for (int k = 0; k < 6; ++k) stress[k][q] = deviator_[k][at] = points.deviator[k][q];
    plastic_strain_[at] = points.plastic_strain[q];
    temperature_[at] = points.temperature[q];
    weight_[at] = weight;
  }
  return work;
}

/// Pressure from the mean density, the cell's energies and its next stable step.
void Elements::advance_volume(std::size_t c, double volume, double dt, Work work, const CellVectors& x) {
  const double mass = cell_mass_[c], density = mass / volume, opened = volume - volume_[c];
  const double old_pressure = pressure_[c], old_viscous = viscous_pressure_[c];
  const double rate = opened / (0.5 * (volume + volume_[c]) * dt);
  const auto guess = materials::evaluate(material_.pressure, material_.rho0, density, energy_[c] / mass);
  const double sound = std::sqrt(guess.bulk_sound * guess.bulk_sound + 4.0 / 3.0 * material_.shear_modulus / density);
  viscous_pressure_[c] = viscous_pressure(c, rate, density, sound);
  const double viscous_work = -0.5 * (old_viscous + viscous_pressure_[c]) * opened;
  const double other_work = energy_[c] + work.deviatoric + viscous_work;
  auto [pressure, state] = carried_pressure(material_,
                                            {.density = density,
                                             .mass = mass,
                                             .opened = opened,
                                             .other_energy = other_work,
                                             .old_pressure = old_pressure,
                                             .intact = work.intact},
                                            guess);
  if (materials::spalls(material_, state.pressure)) {
    std::fill_n(&damage_[8 * c], 8, materials::failed);  // the deviator goes in the next step
    work.intact = pressure = 0.0;
  }
  const double pressure_work = -0.5 * (old_pressure + pressure) * opened;
  if (work.intact < work.intact_before && old_pressure < 0.0) {
    // What the failed points had stored in tension, and what the old pressure added, is spent (to first order in strain).
    const double stored =
        0.5 * old_pressure * old_pressure / (work.intact_before * density * state.bulk_sound * state.bulk_sound);
    work.plastic += (1.0 - work.intact / work.intact_before) * (stored * volume_[c] - 0.5 * old_pressure * opened);
  }
  const bool broken = work.intact < 1.0;
  const materials::Warming warming =
      materials::warming(material_, {.before = volume_[c] / mass,
                                     .after = volume / mass,
                                     .energy = energy_[c] / mass,
                                     .pressure_work = pressure_work / mass,
                                     .dissipated = viscous_work / mass,
                                     .parted = materials::is_parted(material_, std::min(old_pressure, pressure), broken)});
  for (std::size_t q = 8 * c; q < 8 * (c + 1); ++q) temperature_[q] = warming(temperature_[q]);
  pressure_[c] = pressure;
  energy_[c] = other_work + pressure_work;
  volume_[c] = volume;
  elastic_[c] += work.deviatoric - work.plastic + pressure_work;
  plastic_[c] += work.plastic;
  viscous_[c] += viscous_work;
  follow_frequency(c, x, work.most_strain, density * state.bulk_sound * state.bulk_sound);
}

void Elements::linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli, CellVectors& force) const {
  Lanes jacobian[3][3], inverse[3][3], determinant, change[3][3], gradient[3][3], weight, stress[6];
  contract(x, reference_, jacobian);
  invert(jacobian, inverse, determinant);
  contract(u, reference_, change);
  double volume = 0.0, opened = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        gradient[i][j][q] =
            change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] + change[i][2][q] * inverse[2][j][q];
  for (int q = 0; q < 8; ++q) {
    weight[q] = reference_.weight[q] * determinant[q];
    volume += weight[q];
    opened += weight[q] * (gradient[0][0][q] + gradient[1][1][q] + gradient[2][2][q]);
  }
  const double tension = moduli.bulk * opened / volume;
  for (int q = 0; q < 8; ++q) {
    const double mean = (gradient[0][0][q] + gradient[1][1][q] + gradient[2][2][q]) / 3.0;
    for (int k = 0; k < 3; ++k) stress[k][q] = moduli.twice_shear * (gradient[k][k][q] - mean) + tension;
    stress[3][q] = 0.5 * moduli.twice_shear * (gradient[1][2][q] + gradient[2][1][q]);
    stress[4][q] = 0.5 * moduli.twice_shear * (gradient[2][0][q] + gradient[0][2][q]);
    stress[5][q] = 0.5 * moduli.twice_shear * (gradient[0][1][q] + gradient[1][0][q]);
  }
  spread(stress, inverse, weight, reference_, force);
}

ElementSet::Moduli Elements::moduli(std::size_t c) const {
  const double density = cell_mass_[c] / volume_[c];
  const auto state = materials::evaluate(material_.pressure, material_.rho0, density, energy_[c] / cell_mass_[c]);
  return {density * state.bulk_sound * state.bulk_sound, 2.0 * material_.shear_modulus};
}

std::vector<double> Elements::shares_at(const std::array<double, 3>& unit) const {
  std::vector<double> shares(8, 1.0);
  for (int q = 0; q < 8; ++q)
    for (int d = 0; d < 3; ++d) {
      const double low = reference_.point[0][d], high = reference_.point[7][d];
      const double t = std::clamp((unit[d] - low) / (high - low), 0.0, 1.0);
      shares[q] *= reference_.point[q][d] > 0.5 ? t : 1.0 - t;
    }
  return shares;
}

Mat3 Elements::stress(std::size_t cell, int q) const {
  const std::size_t at = 8 * cell + q;
  const auto& s = deviator_;
  Mat3 full;
  full << s[0][at], s[5][at], s[4][at],  //
      s[5][at], s[1][at], s[3][at],      //
      s[4][at], s[3][at], s[2][at];
  return full - pressure_[cell] * Mat3::Identity();
}

void Elements::visit_state(StateVisitor& state) {
  ElementSet::visit_state(state);
  state("pressure", pressure_);
  state("energy", energy_);
  state("viscous pressure", viscous_pressure_);
  state("volume", volume_);
}

std::size_t Elements::memory_bytes() const {
  std::size_t values = 0;
  for (const auto* field : {&pressure_, &viscous_pressure_, &energy_, &volume_}) values += field->size();
  return shared_memory_bytes() + values * sizeof(double);
}

}  // namespace undex::fem
