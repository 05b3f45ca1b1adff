#include "fem_structure/elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem_structure/pressure_step.hpp"

namespace undex::fem {
namespace {

using Lanes = materials::EightPoints;  // one value per quadrature point
using CellVectors = double[3][8];

/// The cells whose points fill the lanes, one after the other.
template <bool axisymmetric>
using LaneCells = std::array<const CellVectors*, axisymmetric ? 2 : 1>;

/// Of the angle that a cell stands for, per unit of its third coordinate.
template <bool axisymmetric>
constexpr double turn = axisymmetric ? 2.0 * std::numbers::pi : 1.0;

/// result[i][j] = sum over nodes of v[i] dN/dxi_j, at all quadrature points.
template <bool axisymmetric>
inline void contract(const LaneCells<axisymmetric>& cells, const ReferenceCell& reference, Lanes (&result)[3][3]) {
  if constexpr (axisymmetric) {
    for (auto& row : result)
      for (Lanes& lanes : row) std::fill_n(lanes, 8, 0.0);
    for (int q = 0; q < 8; ++q) {
      const CellVectors& v = *cells[q / 4];
      for (int node = 0; node < 4; ++node) {
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) result[i][j][q] += v[i][node] * reference.gradient[j][node][q];
        result[2][2][q] += v[0][node] * reference.value[node][q];  // round the axis
      }
    }
    return;
  }
  const CellVectors& v = *cells[0];
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

/// Nodal forces of a stress field (times quadrature weights): f_I = sum_q w sigma grad N_I, of each cell in the lanes.
template <bool axisymmetric>
inline void spread(const Lanes (&stress)[6], const Lanes (&inverse)[3][3], const Lanes& weight, const ReferenceCell& reference,
                   CellVectors* force) {
  constexpr int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  for (int i = 0; i < 3; ++i) {
    Lanes pulled[3];
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        pulled[j][q] =
            weight[q] * (stress[component[i][0]][q] * inverse[j][0][q] + stress[component[i][1]][q] * inverse[j][1][q] +
                         stress[component[i][2]][q] * inverse[j][2][q]);
    for (int node = 0; node < (axisymmetric ? 4 : 8); ++node) {
      Lanes sum;
      for (int q = 0; q < 8; ++q)
        sum[q] = pulled[0][q] * reference.gradient[0][node][q] + pulled[1][q] * reference.gradient[1][node][q] +
                 pulled[2][q] * reference.gradient[2][node][q];
      if constexpr (axisymmetric) {
        for (int cell = 0; cell < 2; ++cell)
          force[cell][i][node] = (sum[4 * cell] + sum[4 * cell + 1]) + (sum[4 * cell + 2] + sum[4 * cell + 3]);
      } else {
        force[0][i][node] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
      }
    }
  }
  if constexpr (axisymmetric) {
    Lanes hoop;
    for (int q = 0; q < 8; ++q) hoop[q] = weight[q] * stress[2][q] * inverse[2][2][q];
    for (int q = 0; q < 8; ++q)
      for (int node = 0; node < 4; ++node) force[q / 4][0][node] += hoop[q] * reference.value[node][q];
  }
}

/// Share of a cell's points that have not failed.
template <int points>
inline double intact_share(const double* damage) {
  int intact = 0;
  for (int q = 0; q < points; ++q) intact += damage[q] < materials::failed;
  return 1.0 / points * intact;
}

}  // namespace

template <bool axisymmetric>
VolumeElements<axisymmetric>::VolumeElements(const Grid& grid, const materials::Solid& material, double linear_viscosity,
                                             double quadratic_viscosity)
    : ElementSet(grid, material, linear_viscosity, quadratic_viscosity, at_once), reference_(grid.reference) {
  const std::size_t n = cells_.size();
  for (auto& component : deviator_) component.assign(points * n, 0.0);
  plastic_strain_.assign(points * n, 0.0);
  temperature_.assign(points * n, material.T_room);
  weight_.resize(points * n);
  if (materials::can_fail(material)) damage_.assign(points * n, 0.0);
  for (auto* field : {&viscous_pressure_, &energy_, &volume_}) field->assign(n, 0.0);
  pressure_.assign(n, materials::evaluate(material_.pressure, material_.rho0, material_.rho0, 0.0).pressure);
  for (std::size_t c = 0; c < n; ++c) {
    CellVectors x;
    Lanes jacobian[3][3], inverse[3][3], determinant;
    collect(grid.nodes, cells_[c], x);
    LaneCells<axisymmetric> cell;
    cell.fill(&x);
    contract<axisymmetric>(cell, reference_, jacobian);
    invert(jacobian, inverse, determinant);
    for (int q = 0; q < points; ++q) {
      weight_[points * c + q] = turn<axisymmetric> * reference_.weight[q] * determinant[q];
      volume_[c] += weight_[points * c + q];
    }
  }
  find_first_steps(grid);
}

/// What the nodes' displacement does to cells over a step.
template <bool axisymmetric>
struct VolumeElements<axisymmetric>::Step {
  Lanes gradient[3][3];         // of the displacement, in the midpoint configuration
  Lanes inverse[3][3], weight;  // of the Jacobian, and of the quadrature, at the end
  double volume[at_once] = {};  // of each cell, at the end [m^3]

  /// Returns the first cell that has turned inside out on the way, or is not finite; or -1.
  int find(const LaneCells<axisymmetric>& x, const LaneCells<axisymmetric>& u, const ReferenceCell& reference) {
    Lanes jacobian[3][3], change[3][3], middle[3][3], determinant;
    contract<axisymmetric>(x, reference, jacobian);
    contract<axisymmetric>(u, reference, change);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int q = 0; q < 8; ++q) middle[i][j][q] = jacobian[i][j][q] - 0.5 * change[i][j][q];
    invert(middle, inverse, determinant);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int q = 0; q < 8; ++q)
          gradient[i][j][q] =
              change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] + change[i][2][q] * inverse[2][j][q];
    bool upright[at_once];
    std::fill_n(upright, at_once, true);
    for (int q = 0; q < 8; ++q) upright[q / points] &= determinant[q] > 0.0;
    invert(jacobian, inverse, determinant);
    for (int q = 0; q < 8; ++q) {
      upright[q / points] &= determinant[q] > 0.0;  // false for NaN
      weight[q] = turn<axisymmetric> * reference.weight[q] * determinant[q];
      volume[q / points] += weight[q];
    }
    for (int cell = 0; cell < at_once; ++cell)
      if (!upright[cell] || !std::isfinite(volume[cell])) return cell;
    return -1;
  }
};

/// What its points gave a cell: works [J], and how many have not failed.
template <bool axisymmetric>
struct VolumeElements<axisymmetric>::Work {
  double deviatoric = 0.0, plastic = 0.0, most_strain = 0.0;
  double intact_before = 1.0, intact = 1.0;  // share of the points
};

template <bool axisymmetric>
long VolumeElements<axisymmetric>::advance_cells(std::size_t first, std::size_t count, std::span<const Vec3> positions,
                                                 std::span<const Vec3> displacements, double dt) {
  CellVectors x[at_once], u[at_once], force[at_once];
  LaneCells<axisymmetric> x_of, u_of;
  for (std::size_t k = 0; k < at_once; ++k) {
    const std::size_t cell = std::min(k, count - 1);
    collect(positions, cells_[first + cell], x[k]);
    collect(displacements, cells_[first + cell], u[k]);
    x_of[k] = &x[k];
    u_of[k] = &u[k];
  }
  Step step;
  if (const int wrong = step.find(x_of, u_of, reference_); wrong >= 0) return static_cast<long>(first) + wrong;
  Lanes stress[6];
  Work work[at_once];
  advance_points(first, count, step, dt, work, stress);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t c = first + k;
    advance_volume(c, step.volume[k], dt, work[k], x[k]);
    const double total_pressure = pressure_[c] + viscous_pressure_[c];
    for (int i = 0; i < 3; ++i)
      for (std::size_t q = points * k; q < points * (k + 1); ++q) stress[i][q] -= total_pressure;
  }
  spread<axisymmetric>(stress, step.inverse, step.weight, reference_, force);
  for (std::size_t k = 0; k < count; ++k)
    if (!put_forces(first + k, force[k])) return static_cast<long>(first + k);
  return -1;
}

/// Stress deviators at the quadrature points.
template <bool axisymmetric>
void VolumeElements<axisymmetric>::advance_points(std::size_t first, std::size_t count, const Step& step, double dt,
                                                  Work (&work)[at_once], Lanes (&stress)[6]) {
  materials::SolidPoints state;
  materials::SolidStep done;
  Lanes specific_volume, start_pressure;
  const bool can_fail = !damage_.empty();
  for (std::size_t k = 0; k < at_once; ++k) {
    const std::size_t c = first + std::min(k, count - 1);
    for (std::size_t p = 0; p < points; ++p) {
      const std::size_t at = points * c + p, q = points * k + p;
      for (int i = 0; i < 6; ++i) state.deviator[i][q] = deviator_[i][at];
      state.plastic_strain[q] = plastic_strain_[at];
      state.temperature[q] = temperature_[at];
      specific_volume[q] = step.volume[k] / cell_mass_[c];
      start_pressure[q] = pressure_[c];
    }
    if (can_fail) {
      std::copy_n(&damage_[points * c], points, &state.damage[points * k]);
      work[k].intact_before = intact_share<points>(&state.damage[points * k]);
    }
  }
  materials::advance_deviator(material_, step.gradient, specific_volume, start_pressure, dt, state, done);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t c = first + k;
    if (can_fail) {
      std::copy_n(&state.damage[points * k], points, &damage_[points * c]);
      work[k].intact = intact_share<points>(&state.damage[points * k]);
    }
    for (std::size_t p = 0; p < points; ++p) {
      const std::size_t at = points * c + p, q = points * k + p;
      const double weight = step.weight[q];
      work[k].most_strain = std::max(work[k].most_strain, done.strain_norm[q]);
      work[k].deviatoric += 0.5 * (weight_[at] * done.old_work[q] + weight * done.new_work[q]);
      work[k].plastic += 0.5 * (weight_[at] + weight) * done.plastic_work[q];
      for (int i = 0; i < 6; ++i) stress[i][q] = deviator_[i][at] = state.deviator[i][q];
      plastic_strain_[at] = state.plastic_strain[q];
      temperature_[at] = state.temperature[q];
      weight_[at] = weight;
    }
  }
  for (std::size_t q = points * count; q < 8; ++q)  // idle lanes
    for (Lanes& component : stress) component[q] = 0.0;
}

/// Pressure from the mean density, the cell's energies and its next stable step.
template <bool axisymmetric>
void VolumeElements<axisymmetric>::advance_volume(std::size_t c, double volume, double dt, Work work, const CellVectors& x) {
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
    std::fill_n(&damage_[points * c], points, materials::failed);  // the deviator goes in the next step
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
  for (std::size_t q = points * c; q < points * (c + 1); ++q) temperature_[q] = warming(temperature_[q]);
  pressure_[c] = pressure;
  energy_[c] = other_work + pressure_work;
  volume_[c] = volume;
  elastic_[c] += work.deviatoric - work.plastic + pressure_work;
  plastic_[c] += work.plastic;
  viscous_[c] += viscous_work;
  follow_frequency(c, x, work.most_strain, density * state.bulk_sound * state.bulk_sound);
}

template <bool axisymmetric>
void VolumeElements<axisymmetric>::linear_cell_force(const CellVectors& x, const CellVectors& u, Moduli moduli,
                                                     CellVectors& force) const {
  Lanes jacobian[3][3], inverse[3][3], determinant, change[3][3], gradient[3][3], weight, stress[6];
  LaneCells<axisymmetric> x_of, u_of;
  x_of.fill(&x);
  u_of.fill(&u);
  contract<axisymmetric>(x_of, reference_, jacobian);
  invert(jacobian, inverse, determinant);
  contract<axisymmetric>(u_of, reference_, change);
  double volume = 0.0, opened = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        gradient[i][j][q] =
            change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] + change[i][2][q] * inverse[2][j][q];
  for (int q = 0; q < 8; ++q) {
    weight[q] = turn<axisymmetric> * reference_.weight[q] * determinant[q];
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
  CellVectors forces[at_once];  // alike
  spread<axisymmetric>(stress, inverse, weight, reference_, forces);
  std::copy_n(&forces[0][0][0], 24, &force[0][0]);
}

template <bool axisymmetric>
ElementSet::Moduli VolumeElements<axisymmetric>::moduli(std::size_t c) const {
  const double density = cell_mass_[c] / volume_[c];
  const auto state = materials::evaluate(material_.pressure, material_.rho0, density, energy_[c] / cell_mass_[c]);
  return {density * state.bulk_sound * state.bulk_sound, 2.0 * material_.shear_modulus};
}

template <bool axisymmetric>
std::vector<double> VolumeElements<axisymmetric>::shares_at(const std::array<double, 3>& unit) const {
  std::vector<double> shares(points, 1.0);
  for (int q = 0; q < points; ++q)
    for (int d = 0; d < (axisymmetric ? 2 : 3); ++d) {
      const double low = reference_.point[0][d], high = reference_.point[points - 1][d];
      const double t = std::clamp((unit[d] - low) / (high - low), 0.0, 1.0);
      shares[q] *= reference_.point[q][d] > 0.5 ? t : 1.0 - t;
    }
  return shares;
}

template <bool axisymmetric>
Mat3 VolumeElements<axisymmetric>::stress(std::size_t cell, int q) const {
  const std::size_t at = points * cell + q;
  const auto& s = deviator_;
  Mat3 full;
  full << s[0][at], s[5][at], s[4][at],  //
      s[5][at], s[1][at], s[3][at],      //
      s[4][at], s[3][at], s[2][at];
  return full - pressure_[cell] * Mat3::Identity();
}

template <bool axisymmetric>
void VolumeElements<axisymmetric>::visit_state(StateVisitor& state) {
  ElementSet::visit_state(state);
  state("pressure", pressure_);
  state("energy", energy_);
  state("viscous pressure", viscous_pressure_);
  state("volume", volume_);
}

template <bool axisymmetric>
std::size_t VolumeElements<axisymmetric>::memory_bytes() const {
  std::size_t values = 0;
  for (const auto* field : {&pressure_, &viscous_pressure_, &energy_, &volume_}) values += field->size();
  return shared_memory_bytes() + values * sizeof(double);
}

template class VolumeElements<false>;
template class VolumeElements<true>;

}  // namespace undex::fem
