// Cells of the one-dimensional mesh made one: what a wave has left behind need not be as fine as the wave. Mass, momentum and
// energy stay.
#include <algorithm>

#include "exact/lagrangian_1d.hpp"

namespace undex::exact {

double Lagrangian1D::add_to_node(int node, double mass, double velocity) {
  double &all = node_mass_[node], &u = u_[node];
  const bool held = (node == 0 && inner_ == Boundary::rigid) || (node == cells() && outer_ == Boundary::rigid);
  const double lost = held ? 0.5 * mass * velocity * velocity : 0.5 * mass * all / (mass + all) * (velocity - u) * (velocity - u);
  if (!held) u = (all * u + mass * velocity) / (all + mass);
  all += mass;
  return lost;
}

double Lagrangian1D::drop_node(int cell, double inner, double outer) {
  const auto moving = [&](int node) { return 0.5 * node_mass_[node] * u_[node] * u_[node]; };
  const double middle = 0.5 * (inner + outer);
  const double before = moving(cell) + 0.5 * middle * u_[cell + 1] * u_[cell + 1] + moving(cell + 2);
  const double left = middle * u_[cell + 1] - 0.5 * (outer * u_[cell] + inner * u_[cell + 2]);  // of momentum
  node_mass_[cell] += 0.5 * outer;
  node_mass_[cell + 2] += 0.5 * inner;
  const bool held = cell == 0 && inner_ == Boundary::rigid;
  const double change = left / ((held ? 0.0 : node_mass_[cell]) + node_mass_[cell + 2]);
  if (!held) u_[cell] += change;
  u_[cell + 2] += change;
  return before - moving(cell) - moving(cell + 2);
}

void Lagrangian1D::merge_solids(int one, int other, int into) {
  const double a = cell_mass_[one], b = cell_mass_[other];
  const auto mean = [&](std::vector<double>& values) {
    values[into] = one == other ? values[one] : (a * values[one] + b * values[other]) / (a + b);
  };
  mean(solids_.deviator);
  mean(solids_.plastic_strain);
  mean(solids_.temperature);
  solids_.damage[into] = std::max(solids_.damage[one], solids_.damage[other]);
  solids_.plastic_energy[into] = solids_.plastic_energy[one] + (one == other ? 0.0 : solids_.plastic_energy[other]);
}

void Lagrangian1D::coarsen(const std::function<double(double place)>& width, int least) {
  const int n = cells();
  std::vector<int> first;  // old cell with which a new one begins
  const auto may_merge = [&](int layer) { return blocks_[layer].end - blocks_[layer].begin >= 2 * least && !still_burns(layer); };
  for (int i = 0; i < n;) {
    first.push_back(i);
    const bool pair = i + 3 < active_ && cell_layer_[i] == cell_layer_[i + 1] && r_[i + 2] - r_[i] <= width(r_[i + 1]) &&
                      may_merge(cell_layer_[i]);
    i += pair ? 2 : 1;
  }
  const int left = static_cast<int>(first.size());
  if (left == n) return;
  first.push_back(n);
  for (int k = 0; k < left; ++k) {
    const int i = first[k];
    double mass = cell_mass_[i], energy = mass * e_[i], volume = start_volume_[i];
    if (!solids_.deviator.empty()) merge_solids(i, first[k + 1] - 1, k);
    if (first[k + 1] == i + 2) {
      const double other = cell_mass_[i + 1];
      if (options_.front_width) energy += other * e_[i + 1] + drop_node(i, mass, other);
      else energy += other * e_[i + 1] + add_to_node(i, 0.5 * other, u_[i + 1]) + add_to_node(i + 2, 0.5 * mass, u_[i + 1]);
      mass += other;
      volume += start_volume_[i + 1];
    }
    cell_mass_[k] = mass;
    start_volume_[k] = volume;
    start_density_[k] = first[k + 1] == i + 2 ? mass / volume : start_density_[i];
    start_middle_[k] = start_middle_[i];
    cell_layer_[k] = cell_layer_[i];
    // What is ahead of a followed front stays at rest to the bit.
    e_[k] = options_.front_width && first[k + 1] == i + 1 ? e_[i] : energy / mass;
  }
  for (int k = 0; k <= left; ++k) {
    r_[k] = r_[first[k]];
    u_[k] = u_[first[k]];
    node_mass_[k] = node_mass_[first[k]];
  }
  const auto new_index = [&](int old) { return int(std::lower_bound(first.begin(), first.end(), old) - first.begin()); };
  active_ = new_index(active_);
  if (front_is_fitted()) front_cell_ = new_index(front_cell_);
  for (Block& block : blocks_) {
    block.begin = new_index(block.begin);
    block.end = new_index(block.end);
  }
  for (auto* field :
       {&cell_mass_, &start_volume_, &start_density_, &start_middle_, &e_, &rho_, &p_, &q_, &c_, &viscous_sound_, &slope_})
    field->resize(left);
  if (!solids_.deviator.empty()) {
    solids_.for_each([&](const char*, std::vector<double>& values) { values.resize(left); });
    push_in_.resize(left);
    push_out_.resize(left);
    solids_new_ = solids_;
  }
  cell_layer_.resize(left);
  for (auto* field : {&r_, &u_, &node_mass_, &area_}) field->resize(left + 1);
  for (int k = 0; k < left; ++k) rho_[k] = start_density_[k] * (start_volume_[k] / (volume_to(r_[k + 1]) - volume_to(r_[k])));
  pressures(0, left, time_, r_, u_, rho_, e_, p_, q_);
  fill_new();
}

}  // namespace undex::exact
