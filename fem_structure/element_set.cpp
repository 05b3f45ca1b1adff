#include "fem_structure/element_set.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/hexahedral_mesh.hpp"

namespace undex::fem {
namespace {

// Cells below this count are not worth waking threads for.
constexpr std::size_t cells_worth_threads = 512;
// A cell that has strained by this much gets its highest frequency anew.
constexpr double frequency_strain = 0.01;

// A step may close a cell by this much.
constexpr double most_closing = 0.05;

/// Rate of volume change [1/s] at a cell's middle: the trace of the velocity's gradient there. Across a meridian that is v_r / r.
double expansion_rate(const std::array<int, 8>& cell, std::span<const Vec3> x, std::span<const Vec3> v) {
  constexpr bool high[3][8] = {{0, 1, 1, 0, 0, 1, 1, 0}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};  // VTK's order
  Mat3 tangents = Mat3::Zero(), slopes = Mat3::Zero();  // of place and velocity, along the unit coordinates
  for (int node = 0; node < 8; ++node)
    for (int d = 0; d < 3; ++d) {
      const double sign = high[d][node] ? 0.25 : -0.25;
      tangents.col(d) += sign * x[cell[node]];
      slopes.col(d) += sign * v[cell[node]];
    }
  if (is_quadrangle(cell))
    for (int node = 0; node < 4; ++node) {
      tangents(2, 2) += 0.25 * x[cell[node]][0];
      slopes(2, 2) += 0.25 * v[cell[node]][0];
    }
  double rate = 0.0;
  for (int d = 0; d < 3; ++d) rate += tangents.col((d + 1) % 3).cross(tangents.col((d + 2) % 3)).dot(slopes.col(d));
  return rate / tangents.determinant();
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

ElementSet::ElementSet(const Grid& grid, const materials::Solid& material, double linear_viscosity, double quadratic_viscosity,
                       std::size_t at_once)
    : material_(material),
      linear_viscosity_(linear_viscosity),
      quadratic_viscosity_(quadratic_viscosity),
      cells_(grid.cells),
      axisymmetric_(grid.axisymmetric),
      nodes_per_cell_(grid.axisymmetric ? 4 : 8),
      at_once_(at_once) {
  const std::size_t n = cells_.size(), corners = nodes_per_cell_;
  for (auto* field : {&elastic_, &plastic_, &viscous_, &frequency_, &frequency_bulk_, &strain_since_, &compression_rate_,
                      &critical_step_, &cell_mass_})
    field->assign(n, 0.0);
  corner_force_.assign(3 * corners * n, 0.0);
  mode_.resize(3 * corners * n);
  corner_mass_.resize(corners * n);
  nodal_mass_.assign(grid.nodes.size(), 0.0);

  std::vector<std::size_t> count(grid.nodes.size() + 1, 0);
  for (const auto& cell : cells_)
    for (std::size_t i = 0; i < corners; ++i) ++count[cell[i] + 1];
  std::partial_sum(count.begin(), count.end(), count.begin());
  corners_begin_ = count;
  corners_.resize(corners * n);
  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = 0; i < corners; ++i) corners_[count[cells_[c][i]]++] = corners * c + i;

  for (std::size_t c = 0; c < n; ++c)
    for (std::size_t i = 0; i < corners; ++i) {
      const double mass = corner_mass_[corners * c + i] = material.rho0 * grid.nodal_volume[c][i];
      cell_mass_[c] += mass;
      nodal_mass_[cells_[c][i]] += mass;
    }
}

void ElementSet::find_first_steps(const Grid& grid) {
  const auto rest = materials::evaluate(material_.pressure, material_.rho0, material_.rho0, 0.0);
  const Moduli moduli{material_.rho0 * rest.bulk_sound * rest.bulk_sound, 2.0 * material_.shear_modulus};
#pragma omp parallel for schedule(static) if (cells_.size() > cells_worth_threads)
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    CellVectors x;
    collect(grid.nodes, cells_[c], x);
    // A start that no symmetry of the cell can hide from.
    const int size = static_cast<int>(3 * nodes_per_cell_);
    for (int k = 0; k < size; ++k) mode_[size * c + k] = std::sin(1.0 + 1.7 * k + 0.31 * k * k);
    find_frequency(c, x, moduli, 400);
    set_critical_step(c, moduli.bulk);
  }
}

long ElementSet::advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force) {
  const long n = static_cast<long>(cells_.size()), at_once = static_cast<long>(at_once_);
  long failed = n;
#pragma omp parallel for schedule(static) reduction(min : failed) if (cells_.size() > cells_worth_threads)
  for (long c = 0; c < n; c += at_once) {
    const long wrong = advance_cells(c, std::min(at_once, n - c), x, u, dt);
    if (wrong >= 0) failed = std::min(failed, wrong);
  }
  gather(corner_force_, force);
  return failed == n ? -1 : failed;
}

bool ElementSet::put_forces(std::size_t c, const CellVectors& force) {
  const int nodes = static_cast<int>(nodes_per_cell_);
  double* out = &corner_force_[3 * nodes * c];
  double sum = 0.0;
  for (int node = 0; node < nodes; ++node)
    for (int i = 0; i < 3; ++i) sum += std::abs(out[3 * node + i] = force[i][node]);
  return std::isfinite(sum);
}

void ElementSet::gather(const std::vector<double>& corner_force, std::span<Vec3> force) const {
  const long nodes = static_cast<long>(nodal_mass_.size());
#pragma omp parallel for schedule(static) if (cells_.size() > cells_worth_threads)
  for (long node = 0; node < nodes; ++node) {
    Vec3 sum_of_cells = Vec3::Zero();
    for (std::size_t k = corners_begin_[node]; k < corners_begin_[node + 1]; ++k)
      sum_of_cells += Eigen::Map<const Vec3>(&corner_force[3 * corners_[k]]);
    force[node] = sum_of_cells;
  }
}

double ElementSet::viscous_pressure(std::size_t c, double rate, double density, double sound) {
  const double length = 2.0 * sound / frequency_[c];  // the cell's shortest extent, as its highest mode sees it
  compression_rate_[c] = std::max(0.0, -rate);
  return density * length * compression_rate_[c] *
         (linear_viscosity_ * sound + quadratic_viscosity_ * quadratic_viscosity_ * length * compression_rate_[c]);
}

void ElementSet::follow_frequency(std::size_t c, const CellVectors& x, double most_strain, double bulk) {
  strain_since_[c] += most_strain;
  if (strain_since_[c] > frequency_strain) find_frequency(c, x, {bulk, 2.0 * material_.shear_modulus}, 20);
  set_critical_step(c, bulk);
}

void ElementSet::linear_force(std::span<const Vec3> positions, std::span<const Vec3> displacements, std::span<Vec3> force) const {
  std::vector<double> corner_force(3 * nodes_per_cell_ * cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    CellVectors x, u, f;
    collect(positions, cells_[c], x);
    collect(displacements, cells_[c], u);
    linear_cell_force(x, u, moduli(c), f);
    for (std::size_t node = 0; node < nodes_per_cell_; ++node)
      for (int i = 0; i < 3; ++i) corner_force[3 * (nodes_per_cell_ * c + node) + i] = f[i][node];
  }
  gather(corner_force, force);
}

void ElementSet::find_frequency(std::size_t c, const CellVectors& x, Moduli moduli, int most_iterations) {
  const int nodes = static_cast<int>(nodes_per_cell_);
  double* mode = &mode_[3 * nodes * c];
  const double* mass = &corner_mass_[nodes * c];
  CellVectors v = {}, f;
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < nodes; ++node) v[i][node] = mode[nodes * i + node];
  // A node on the axis has no radial motion.
  const auto hold_axis = [&] {
    for (int node = 0; axisymmetric_ && node < nodes; ++node)
      if (x[0][node] == 0.0) v[0][node] = 0.0;
  };
  hold_axis();
  double square = 0.0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    double norm = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < nodes; ++node) norm += mass[node] * v[i][node] * v[i][node];
    const double scale = 1.0 / std::sqrt(norm);
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < nodes; ++node) v[i][node] *= scale;
    linear_cell_force(x, v, moduli, f);
    double power = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int node = 0; node < nodes; ++node) {
        power += v[i][node] * f[i][node];
        v[i][node] = f[i][node] / mass[node];
      }
    hold_axis();
    const bool settled = std::abs(power - square) <= 1e-6 * power;
    square = power;
    if (settled) break;
  }
  for (int i = 0; i < 3; ++i)
    for (int node = 0; node < nodes; ++node) mode[nodes * i + node] = v[i][node];
  // Power iteration ends a little low.
  frequency_[c] = std::sqrt(square) * (1.0 + 1e-4);
  frequency_bulk_[c] = moduli.bulk;
  strain_since_[c] = 0.0;
  // The next start needs a share of every mode: the highest may have become another.
  double largest = 0.0;
  for (int k = 0; k < 3 * nodes; ++k) largest = std::max(largest, std::abs(mode[k]));
  for (int k = 0; k < 3 * nodes; ++k) mode[k] = mode[k] / largest + 0.02 * std::sin(1.0 + 1.7 * k + 0.31 * k * k);
}

void ElementSet::set_critical_step(std::size_t c, double bulk) {
  const double stiffening = std::max(1.0, std::sqrt(bulk / frequency_bulk_[c]));
  const double frequency = frequency_[c] * stiffening * (1.0 + strain_since_[c]);
  critical_step_[c] = 2.0 / frequency * damped_share(c, compression_rate_[c]);
}

double ElementSet::damped_share(std::size_t c, double compression_rate) const {
  const double length_over_sound = 2.0 / frequency_[c];
  const double damping = linear_viscosity_ + quadratic_viscosity_ * quadratic_viscosity_ * length_over_sound * compression_rate;
  return std::sqrt(1.0 + damping * damping) - damping;
}

double ElementSet::coming_step(std::span<const Vec3> x, std::span<const Vec3> v) const {
  double least = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : least) if (cells_.size() > cells_worth_threads)
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const double rate = -expansion_rate(cells_[c], x, v);
    least = std::min(least, critical_step_[c]);
    if (rate <= 0.0) continue;
    least = std::min(least, most_closing / rate);
    if (rate > compression_rate_[c])
      least = std::min(least, critical_step_[c] * damped_share(c, rate) / damped_share(c, compression_rate_[c]));
  }
  return least;
}

double ElementSet::critical_step() const { return *std::min_element(critical_step_.begin(), critical_step_.end()); }

std::size_t ElementSet::critical_cell() const {
  return std::min_element(critical_step_.begin(), critical_step_.end()) - critical_step_.begin();
}

double ElementSet::elastic_energy() const { return sum(elastic_); }
double ElementSet::plastic_work() const { return sum(plastic_); }
double ElementSet::viscous_work() const { return sum(viscous_); }

void ElementSet::visit_state(StateVisitor& state) {
  for (int k = 0; k < 6; ++k) state("deviator_" + std::to_string(k), deviator_[k]);
  state("plastic strain", plastic_strain_);
  state("temperature", temperature_);
  state("damage", damage_);
  state("weight", weight_);
  state("elastic energy", elastic_);
  state("plastic work", plastic_);
  state("viscous work", viscous_);
  state("frequency", frequency_);
  state("bulk modulus of the frequency", frequency_bulk_);
  state("strain since the frequency", strain_since_);
  state("compression rate", compression_rate_);
  state("critical step", critical_step_);
  state("mode", mode_);
}

std::size_t ElementSet::shared_memory_bytes() const {
  std::size_t values = 0;
  for (const auto& component : deviator_) values += component.size();
  for (const auto* field :
       {&plastic_strain_, &temperature_, &damage_, &weight_, &elastic_, &plastic_, &viscous_, &frequency_, &frequency_bulk_,
        &strain_since_, &compression_rate_, &critical_step_, &mode_, &cell_mass_, &corner_mass_, &nodal_mass_, &corner_force_})
    values += field->size();
  return values * sizeof(double) + cells_.size() * sizeof(cells_[0]) +
         (corners_.size() + corners_begin_.size()) * sizeof(std::size_t);
}

}  // namespace undex::fem
