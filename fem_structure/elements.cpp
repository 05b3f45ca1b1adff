#include "fem_structure/elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace undex::fem {
namespace {

// Cells below this count are not worth waking threads for.
constexpr std::size_t worth_threads = 512;
// A cell that has strained by this much gets its highest frequency anew.
constexpr double frequency_strain = 0.01;

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
inline void spread(const Lanes (&stress)[6], const Lanes (&inverse)[3][3], const Lanes& weight,
                   const ReferenceCell& reference, double (&force)[3][8]) {
  constexpr int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  for (int i = 0; i < 3; ++i) {
    Lanes pulled[3];
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        pulled[j][q] = weight[q] * (stress[component[i][0]][q] * inverse[j][0][q] +
                                    stress[component[i][1]][q] * inverse[j][1][q] +
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

inline void collect(std::span<const Vec3> from, const std::array<int, 8>& cell, double (&to)[3][8]) {
  for (int node = 0; node < 8; ++node) {
    const Vec3& value = from[cell[node]];
    for (int i = 0; i < 3; ++i) to[i][node] = value[i];
  }
}

/// Share of the points that have not failed.
inline double intact_share(const Lanes& damage) {
  int intact = 0;
  for (int q = 0; q < 8; ++q) intact += damage[q] < materials::failed;
  return 0.125 * intact;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

Elements::Elements(const Grid& grid, const materials::Solid& material, double linear_viscosity,
                   double quadratic_viscosity)
    : material_(material),
      linear_viscosity_(linear_viscosity),
      quadratic_viscosity_(quadratic_viscosity),
      reference_(grid.reference),
      cells_(grid.cells) {
  const std::size_t n = cells_.size();
  for (auto& component : deviator_) component.assign(8 * n, 0.0);
  plastic_strain_.assign(8 * n, 0.0);
  temperature_.assign(8 * n, material.T_room);
  weight_.resize(8 * n);
  if (materials::can_fail(material)) damage_.assign(8 * n, 0.0);
  for (auto* field : {&pressure_, &viscous_pressure_, &energy_, &volume_, &elastic_, &plastic_, &viscous_, &frequency_,
                      &frequency_bulk_, &strain_since_, &compression_rate_, &critical_step_, &cell_mass_})
    field->assign(n, 0.0);
  corner_force_.assign(24 * n, 0.0);
  mode_.resize(24 * n);
  corner_mass_.resize(8 * n);
  nodal_mass_.assign(grid.nodes.size(), 0.0);

  std::vector<std::size_t> count(grid.nodes.size() + 1, 0);
  for (const auto& cell : cells_)
    for (int node : cell) ++count[node + 1];
  std::partial_sum(count.begin(), count.end(), count.begin());
  corners_begin_ = count;
  corners_.resize(8 * n);
  for (std::size_t c = 0; c < n; ++c)
    for (int i = 0; i < 8; ++i) corners_[count[cells_[c][i]]++] = 8 * c + i;

  for (std::size_t c = 0; c < n; ++c)
    for (int i = 0; i < 8; ++i) {
      corner_mass_[8 * c + i] = material.rho0 * grid.nodal_volume[c][i];
      cell_mass_[c] += corner_mass_[8 * c + i];
      nodal_mass_[cells_[c][i]] += corner_mass_[8 * c + i];
    }

  const auto rest = materials::evaluate(material_.pressure, material_.rho0, material_.rho0, 0.0);
  const Moduli moduli{material_.rho0 * rest.bulk_sound * rest.bulk_sound, 2.0 * material_.shear_modulus};
#pragma omp parallel for schedule(static) if (n > worth_threads)
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
    pressure_[c] = rest.pressure;
    // A start that no symmetry of the cell can hide from.
    for (int k = 0; k < 24; ++k) mode_[24 * c + k] = std::sin(1.0 + 1.7 * k + 0.31 * k * k);
    find_frequency(c, x, moduli, 400);
    set_critical_step(c, std::sqrt((moduli.bulk + 2.0 / 3.0 * moduli.twice_shear) / material_.rho0), moduli.bulk);
  }
}

long Elements::advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force) {
  const long n = static_cast<long>(cells_.size());
  long failed = n;
#pragma omp parallel for schedule(static) reduction(min : failed) if (cells_.size() > worth_threads)
  for (long c = 0; c < n; ++c)
    if (!advance_cell(c, x, u, dt)) failed = std::min(failed, c);
  gather(corner_force_, force);
  return failed == n ? -1 : failed;
}

bool Elements::advance_cell(std::size_t c, std::span<const Vec3> positions, std::span<const Vec3> displacements,
                            double dt) {
  double x[3][8], u[3][8];
  collect(positions, cells_[c], x);
  collect(displacements, cells_[c], u);

  // Displacement gradient of the step in its midpoint configuration.
  Lanes jacobian[3][3], change[3][3], middle[3][3], inverse[3][3], determinant, gradient[3][3];
  contract(x, reference_, jacobian);
  contract(u, reference_, change);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q) middle[i][j][q] = jacobian[i][j][q] - 0.5 * change[i][j][q];
  invert(middle, inverse, determinant);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int q = 0; q < 8; ++q)
        gradient[i][j][q] = change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] +
                            change[i][2][q] * inverse[2][j][q];
  bool sound_geometry = true;
  for (int q = 0; q < 8; ++q) sound_geometry &= determinant[q] > 0.0;

  // New geometry.
  invert(jacobian, inverse, determinant);
  Lanes weight;
  double volume = 0.0;
  for (int q = 0; q < 8; ++q) {
    sound_geometry &= determinant[q] > 0.0;  // false for NaN
    weight[q] = reference_.weight[q] * determinant[q];
    volume += weight[q];
  }
  if (!sound_geometry || !std::isfinite(volume)) return false;

  // Stress deviator at the quadrature points.
  materials::SolidPoints points;
  materials::SolidStep done;
  Lanes specific_volume, start_pressure;
  for (int q = 0; q < 8; ++q) {
    const std::size_t at = 8 * c + q;
    for (int k = 0; k < 6; ++k) points.deviator[k][q] = deviator_[k][at];
    points.plastic_strain[q] = plastic_strain_[at];
    points.temperature[q] = temperature_[at];
    specific_volume[q] = volume / cell_mass_[c];
    start_pressure[q] = pressure_[c];
  }
  const bool can_fail = !damage_.empty();
  double intact_before = 1.0, intact = 1.0;  // share of the points
  if (can_fail) {
    std::copy_n(&damage_[8 * c], 8, points.damage);
    intact_before = intact_share(points.damage);
  }
  materials::advance_deviator(material_, gradient, specific_volume, start_pressure, dt, points, done);
  if (can_fail) {
    std::copy_n(points.damage, 8, &damage_[8 * c]);
    intact = intact_share(points.damage);
  }
  double deviatoric_work = 0.0, plastic_work = 0.0, most_strain = 0.0;
  for (int q = 0; q < 8; ++q) {
    const std::size_t at = 8 * c + q;
    most_strain = std::max(most_strain, done.strain_norm[q]);
    deviatoric_work += 0.5 * (weight_[at] * done.old_work[q] + weight[q] * done.new_work[q]);
    plastic_work += 0.5 * (weight_[at] + weight[q]) * done.plastic_work[q];
    for (int k = 0; k < 6; ++k) deviator_[k][at] = points.deviator[k][q];
    plastic_strain_[at] = points.plastic_strain[q];
    temperature_[at] = points.temperature[q];
    weight_[at] = weight[q];
  }

  // Pressure from the mean density; the work of this very pressure enters the energy it depends on: one correction.
  const double mass = cell_mass_[c], density = mass / volume, opened = volume - volume_[c];
  const double old_pressure = pressure_[c], old_viscous = viscous_pressure_[c];
  const double rate = opened / (0.5 * (volume + volume_[c]) * dt);
  auto state = materials::evaluate(material_.pressure, material_.rho0, density, energy_[c] / mass);
  const double shear = material_.shear_modulus;
  const double sound = std::sqrt(state.bulk_sound * state.bulk_sound + 4.0 / 3.0 * shear / density);
  const double length = 2.0 * sound / frequency_[c];  // the cell's shortest extent, as its highest mode sees it
  compression_rate_[c] = std::max(0.0, -rate);
  viscous_pressure_[c] = density * length * compression_rate_[c] *
                         (linear_viscosity_ * sound +
                          quadratic_viscosity_ * quadratic_viscosity_ * length * compression_rate_[c]);
  const double viscous_work = -0.5 * (old_viscous + viscous_pressure_[c]) * opened;
  const double other_work = energy_[c] + deviatoric_work + viscous_work;
  const auto carried = [&](double pressure) {
    return pressure < 0.0 ? intact * materials::carried_pressure(material_, pressure, 0.0) : pressure;
  };
  double pressure = carried(state.pressure);
  for (int correction = 0; correction < 2; ++correction) {
    state = materials::evaluate(material_.pressure, material_.rho0, density,
                                (other_work - 0.5 * (old_pressure + pressure) * opened) / mass);
    pressure = carried(state.pressure);
  }
  if (materials::spalls(material_, state.pressure)) {
    std::fill_n(&damage_[8 * c], 8, materials::failed);  // the deviator goes in the next step
    intact = pressure = 0.0;
  }
  const double pressure_work = -0.5 * (old_pressure + pressure) * opened;
  if (intact < intact_before && old_pressure < 0.0) {
    // What the failed points had stored in tension, and what the old pressure added, is spent (to first order in strain).
    const double stored = 0.5 * old_pressure * old_pressure / (intact_before * density * state.bulk_sound * state.bulk_sound);
    plastic_work += (1.0 - intact / intact_before) * (stored * volume_[c] - 0.5 * old_pressure * opened);
  }
  pressure_[c] = pressure;
  energy_[c] = other_work + pressure_work;
  volume_[c] = volume;
  elastic_[c] += deviatoric_work - plastic_work + pressure_work;
  plastic_[c] += plastic_work;
  viscous_[c] += viscous_work;

  // Highest frequency: anew when the cell has changed, otherwise enlarged by what the strain since may have done.
  const double bulk_modulus = density * state.bulk_sound * state.bulk_sound;
  strain_since_[c] += most_strain;
  if (strain_since_[c] > frequency_strain) find_frequency(c, x, {bulk_modulus, 2.0 * shear}, 20);
  set_critical_step(c, sound, bulk_modulus);

  const double total_pressure = pressure + viscous_pressure_[c];
  for (int k = 0; k < 3; ++k)
    for (int q = 0; q < 8; ++q) points.deviator[k][q] -= total_pressure;
  double force[3][8];
  spread(points.deviator, inverse, weight, reference_, force);
  double* out = &corner_force_[24 * c];
  for (int node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i) out[3 * node + i] = force[i][node];
  return std::isfinite(total_pressure);
}

void Elements::gather(const std::vector<double>& corner_force, std::span<Vec3> force) const {
  const long nodes = static_cast<long>(nodal_mass_.size());
#pragma omp parallel for schedule(static) if (cells_.size() > worth_threads)
  for (long node = 0; node < nodes; ++node) {
    Vec3 sum_of_cells = Vec3::Zero();
    for (std::size_t k = corners_begin_[node]; k < corners_begin_[node + 1]; ++k)
      sum_of_cells += Eigen::Map<const Vec3>(&corner_force[3 * corners_[k]]);
    force[node] = sum_of_cells;
  }
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
        gradient[i][j][q] = change[i][0][q] * inverse[0][j][q] + change[i][1][q] * inverse[1][j][q] +
                            change[i][2][q] * inverse[2][j][q];
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

void Elements::linear_force(std::span<const Vec3> positions, std::span<const Vec3> displacements,
                            std::span<Vec3> force) const {
  std::vector<double> corner_force(24 * cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    CellVectors x, u, f;
    collect(positions, cells_[c], x);
    collect(displacements, cells_[c], u);
    const double density = cell_mass_[c] / volume_[c];
    const auto state = materials::evaluate(material_.pressure, material_.rho0, density, energy_[c] / cell_mass_[c]);
    linear_cell_force(x, u, {density * state.bulk_sound * state.bulk_sound, 2.0 * material_.shear_modulus}, f);
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i) corner_force[24 * c + 3 * node + i] = f[i][node];
  }
  gather(corner_force, force);
}

void Elements::find_frequency(std::size_t c, const CellVectors& x, Moduli moduli, int most_iterations) {
  double* mode = &mode_[24 * c];
  const double* mass = &corner_mass_[8 * c];
  CellVectors v, f;
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < 8; ++node) v[i][node] = mode[8 * i + node];
  double square = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double norm = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < 8; ++node) norm += mass[node] * v[i][node] * v[i][node];
    const double scale = 1.0 / std::sqrt(norm);
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < 8; ++node) v[i][node] *= scale;
    linear_cell_force(x, v, moduli, f);
    double power = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < 8; ++node) {
        power += v[i][node] * f[i][node];
        v[i][node] = f[i][node] / mass[node];
      }
    const bool settled = std::abs(power - square) <= 1e-6 * power;
    square = power;
    if (settled) break;
  }
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < 8; ++node) mode[8 * i + node] = v[i][node];
  // Power iteration ends a little low.
  frequency_[c] = std::sqrt(square) * (1.0 + 1e-4);
  frequency_bulk_[c] = moduli.bulk;
  strain_since_[c] = 0.0;
  // The next start needs a share of every mode: the highest may have become another.
  double largest = 0.0;
  for (int k = 0; k < 24; ++k) largest = std::max(largest, std::abs(mode[k]));
  for (int k = 0; k < 24; ++k) mode[k] = mode[k] / largest + 0.02 * std::sin(1.0 + 1.7 * k + 0.31 * k * k);
}

void Elements::set_critical_step(std::size_t c, double sound, double bulk) {
  const double stiffening = std::max(1.0, std::sqrt(bulk / frequency_bulk_[c]));
  const double frequency = frequency_[c] * stiffening * (1.0 + strain_since_[c]);
  const double length = 2.0 * sound / frequency_[c];
  const double damping =
      linear_viscosity_ + quadratic_viscosity_ * quadratic_viscosity_ * length * compression_rate_[c] / sound;
  critical_step_[c] = 2.0 / frequency * (std::sqrt(1.0 + damping * damping) - damping);
}

double Elements::critical_step() const { return *std::min_element(critical_step_.begin(), critical_step_.end()); }

std::size_t Elements::critical_cell() const {
  return std::min_element(critical_step_.begin(), critical_step_.end()) - critical_step_.begin();
}

double Elements::elastic_energy() const { return sum(elastic_); }
double Elements::plastic_work() const { return sum(plastic_); }
double Elements::viscous_work() const { return sum(viscous_); }

Mat3 Elements::stress(std::size_t cell, int q) const {
  const std::size_t at = 8 * cell + q;
  const auto& s = deviator_;
  Mat3 full;
  full << s[0][at], s[5][at], s[4][at],  //
      s[5][at], s[1][at], s[3][at],      //
      s[4][at], s[3][at], s[2][at];
  return full - pressure_[cell] * Mat3::Identity();
}

std::size_t Elements::memory_bytes() const {
  std::size_t values = 0;
  for (const auto& component : deviator_) values += component.size();
  for (const auto* field : {&plastic_strain_, &temperature_, &damage_, &weight_, &pressure_, &viscous_pressure_, &energy_,
                            &volume_, &elastic_, &plastic_, &viscous_, &frequency_, &frequency_bulk_, &strain_since_, &compression_rate_,
                            &critical_step_, &mode_, &cell_mass_, &corner_mass_, &nodal_mass_, &corner_force_})
    values += field->size();
  return values * sizeof(double) + cells_.size() * sizeof(cells_[0]) +
         (corners_.size() + corners_begin_.size()) * sizeof(std::size_t);
}

}  // namespace undex::fem
