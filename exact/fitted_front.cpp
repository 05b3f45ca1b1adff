// The first wave's front, followed as a discontinuity through uniform fluid at rest (shock fitting, after R. D. Richtmyer and
// K. W. Morton, Difference Methods for Initial-Value Problems, 1967), on the compatible staggered mesh.
//
// The front is a node that runs through the mass: with R its radius, V the volume within it and D its speed,
//   dR/dt = D(u_s),   dm/dt = rho_0 dV/dt   for the cell behind it, and minus that for the one ahead,
// where D and the pressure p_H belong to the velocity u_s behind a shock (jump conditions with the fluid's own law); a front that
// sucks is the head of a rarefaction, D = c_0, p_H = p_0 + rho_0 c_0 u_s. Of what comes in, one half goes on to the inner node f
// of the cell with that node's velocity, so that it needs no force, and the front node, mu = m/2, moves by
//   d(mu u_s)/dt = A (P - p_0) - u_f (dm/dt)/2.
// In smooth flow that is rho Du/Dt = -dp/dr at the front: (dm/dt)/2 (u_s - u_f) carries the momentum from the front's path to the
// particles', and A (P - p_H) the rest. The fluid ahead gives its energy and no work, so what the cell behind has of internal
// energy is what the sum of all leaves it: mass, momentum (planar) and energy are kept to round-off.
//
// The cell behind the front is split in two when it has grown to twice its width; mass, momentum, energy stay. The front sets out
// a cell ahead of the contact: a shock catches up with it, sound never would, so weak waves are left to the mesh.
#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "exact/lagrangian_1d.hpp"

namespace undex::exact {

using materials::FluidLaw;

/// The cells ahead must be one fluid at rest under pressure; what has begun to move is not.
bool Lagrangian1D::can_follow_in(int k) const {
  const Layer& layer = layers_[k];
  const Block& block = blocks_[k];
  return options_.front_width && k > 0 && std::holds_alternative<FluidLaw>(layer.law) && !layer.burn && !layer.start &&
         layer.velocity == 0.0 && block.end - block.begin >= 3 && p_[block.begin + 1] > 0.0 && c_[block.begin + 1] > 0.0;
}

int Lagrangian1D::next_followed_layer() const {
  if (!options_.front_width) return layers();
  for (int k = 0; k < layers(); ++k)
    if (blocks_[k].begin >= active_ && can_follow_in(k)) return k;
  return layers();
}

/// Has nothing reached its inner end yet?
bool Lagrangian1D::still_waits(int k) const {
  const int node = blocks_[k].begin;
  return u_[node] == 0.0 && std::abs(p_[node - 1] + q_[node - 1] - p_[node]) <= options_.held_pressure;
}

/// From the step on in which the inner end of its layer begins to move.
void Lagrangian1D::start_following() {
  const int k = next_followed_layer();
  if (k == layers() || blocks_[k].begin != active_ || still_waits(k)) return;
  front_cell_ = active_;
  node_mass_[front_cell_ + 1] = 0.5 * cell_mass_[front_cell_];
  node_mass_[front_cell_ + 2] += 0.5 * cell_mass_[front_cell_ + 1];
  active_ = front_cell_ + 1;
  front_ = front_at(0.0);
  tend_front();
}

Lagrangian1D::Front Lagrangian1D::front_at(double u) const {
  const int ahead = front_cell_ + 1;
  const double rho0 = rho_[ahead], p0 = p_[ahead], e0 = e_[ahead], c0 = c_[ahead];
  if (!(u > 1e-9 * c0)) return {c0, p0 + rho0 * c0 * u, rho0 * (1.0 + u / c0), e0 + p0 / rho0 * u / c0};
  const auto& fluid = std::get<FluidLaw>(layers_[cell_layer_[ahead]].law);
  Front front{};
  std::visit(
      [&](const auto& law) {
        // Newton on D: the law's pressure at the density that mass, and the energy that momentum and energy ask for, against
        // p0 + rho0 D u.
        double D = std::max(front_.speed, c0 + u);
        for (int k = 0; k < 50; ++k) {
          const double volume = (1.0 - u / D) / rho0;
          front = {D, p0 + rho0 * D * u, 1.0 / volume, e0 + 0.5 * u * u + p0 * (1.0 / rho0 - volume)};
          const auto state = law.evaluate(front.density, front.energy);
          const double stiffness = front.density * state.sound_speed;
          const double change = (state.pressure - front.pressure) / (rho0 * u + stiffness * stiffness * u / (rho0 * D * D));
          D = std::max(D + change, 0.5 * (D + u));
          if (std::abs(change) <= 1e-13 * D) return;
        }
      },
      fluid);
  return front;
}

/// Velocities of the front and of the node behind it, and the front's place, at the end of a step in which it runs at `speed` and
/// the cell behind it has the pressure `total`.
void Lagrangian1D::move_front(double dt, double speed, double total) {
  const int f = front_cell_, front = f + 1;
  r_new_[front] = r_[front] + dt * speed;
  front_volume_ = volume_to(r_new_[front]) - volume_to(r_[front]);
  const double given = 0.5 * start_density_[f] * front_volume_;  // to the node behind
  u_new_[f] = u_[f] + (u_new_[f] - u_[f]) * node_mass_[f] / (node_mass_[f] + 0.5 * given);
  const double force = mean_area(r_[front], r_new_[front]) * (total - p_[front]);
  u_new_[front] = (node_mass_[front] * u_[front] + dt * force - given * 0.5 * (u_[f] + u_new_[f])) / (node_mass_[front] + given);
}

/// Density and energy of the cell behind the front at the end of the step.
void Lagrangian1D::fill_front_cell(double dt, double total) {
  const int f = front_cell_, front = f + 1;
  const double swept = area_[f] * (0.5 * dt * (u_[f] + u_new_[f]));
  const double come = start_density_[f] * front_volume_, given = 0.5 * come;
  const double mass = cell_mass_[f] + come;
  const double moves =
      0.5 * ((node_mass_[front] + given) * u_new_[front] * u_new_[front] - node_mass_[front] * u_[front] * u_[front]) +
      0.25 * given * (u_[f] * u_[f] + u_new_[f] * u_new_[f]);
  e_new_[f] = (cell_mass_[f] * e_[f] + come * e_[front] + total * swept - moves) / mass;
  rho_new_[f] = start_density_[f] * ((start_volume_[f] + front_volume_) / (volume_to(r_new_[front]) - volume_to(r_new_[f])));
}

/// What has come into the cell behind the front is its own from now on.
void Lagrangian1D::keep_front_cell() {
  const int f = front_cell_, front = f + 1;
  const double come = start_density_[f] * front_volume_;
  cell_mass_[f] += come;
  start_volume_[f] += front_volume_;
  node_mass_[f] += 0.5 * come;
  node_mass_[front] += 0.5 * come;
  cell_mass_[front] -= come;
  start_volume_[front] = volume_to(r_[front + 1]) - volume_to(r_new_[front]);
  node_mass_[front + 1] -= come;
}

/// At the end of a step: room ahead of the front, and cells of their width behind it.
void Lagrangian1D::tend_front() {
  const int f = front_cell_, front = f + 1;
  front_ = front_at(u_[front]);
  const double width = r_[front] - r_[f];
  // A step goes no farther than about a cell.
  while (r_[front + 1] - r_[front] < 3.0 * width && front + 1 < blocks_[cell_layer_[f]].end) {
    node_mass_[front + 2] += cell_mass_[front] + 0.5 * cell_mass_[front + 1];
    cell_mass_[front] += cell_mass_[front + 1];
    erase_cell(front + 1);
    start_volume_[front] = volume_to(r_[front + 1]) - volume_to(r_[front]);
  }
  if (r_[front + 1] - r_[front] < 0.02 * width) return end_following();
  if (width > 2.0 * options_.front_width(r_[front])) split_front_cell();
}

/// No farther than most of the way to the end of the layer [s].
double Lagrangian1D::step_to_layers_end() const { return 0.7 * (r_[front_cell_ + 2] - r_[front_cell_ + 1]) / front_.speed; }

/// Two cells of one mass, with the gradient of density and energy between the middle of the old one and the front.
void Lagrangian1D::split_front_cell() {
  const int f = front_cell_;
  const double mass = cell_mass_[f], volume = volume_to(r_[f + 1]) - volume_to(r_[f]), specific = volume / mass;
  // Of specific volume and energy, inner half less outer half, halved; none where the state is not as far apart as a gradient is.
  double opened = 0.5 * (specific - 1.0 / front_.density), warmed = 0.5 * (e_[f] - front_.energy);
  if (!(std::abs(opened) < 0.1 * specific)) opened = warmed = 0.0;
  const double u = 0.5 * (u_[f] + u_[f + 1]);
  const double lost = 0.0625 * mass * (u_[f + 1] - u_[f]) * (u_[f + 1] - u_[f]);  // kinetic
  insert_cell(f);
  front_cell_ = f + 1;
  active_ = f + 2;
  const double inner = 0.5 * mass * (specific + opened);
  const double place = volume_to(r_[f]) + inner;
  r_[f + 1] = dimension_ == 1   ? place
              : dimension_ == 2 ? std::sqrt(2.0 * place / area_factor_)
                                : std::cbrt(3.0 * place / area_factor_);
  u_[f + 1] = u;
  node_mass_[f] -= 0.25 * mass;
  node_mass_[f + 1] = 0.5 * mass;
  node_mass_[f + 2] = 0.25 * mass;
  const double heat = lost / mass, energy = e_[f] + heat;
  for (const int half : {0, 1}) {
    cell_mass_[f + half] = 0.5 * mass;
    e_[f + half] = energy + (half == 0 ? warmed : -warmed);
    start_volume_[f + half] = 0.5 * mass / start_density_[f];
    rho_[f + half] = start_density_[f] * (start_volume_[f + half] / (volume_to(r_[f + half + 1]) - volume_to(r_[f + half])));
  }
  pressures(f, f + 2, time_, r_, u_, rho_, e_, p_, q_);
}

/// At the end of the layer: what is left ahead joins the cell behind, and its end takes what the front had.
void Lagrangian1D::end_following() {
  const int f = front_cell_, front = f + 1, end = front + 1;
  const bool held = end == cells() && outer_ == Boundary::rigid;
  const double left = cell_mass_[front], beyond = node_mass_[end] - left;  // what follows, and plates
  const double mass = cell_mass_[f] + left;
  const double momentum = node_mass_[front] * u_[front] - 0.5 * left * u_[f];
  double energy =
      cell_mass_[f] * e_[f] + left * e_[front] + 0.5 * node_mass_[front] * u_[front] * u_[front] - 0.25 * left * u_[f] * u_[f];
  node_mass_[f] += 0.5 * left;
  node_mass_[end] = 0.5 * mass + beyond;
  u_[end] = held ? 0.0 : momentum / node_mass_[end];
  energy -= 0.5 * node_mass_[end] * u_[end] * u_[end];
  cell_mass_[f] = mass;
  e_[f] = energy / mass;
  start_volume_[f] = mass / start_density_[f];
  erase_cell(front);
  rho_[f] = start_density_[f] * (start_volume_[f] / (volume_to(r_[front]) - volume_to(r_[f])));
  front_cell_ = -1;
  active_ = front;
  pressures(f, f + 1, time_, r_, u_, rho_, e_, p_, q_);
}

/// A copy of the cell after it, and of its outer node.
void Lagrangian1D::insert_cell(int cell) {
  for (auto* values : cell_arrays()) values->insert(values->begin() + cell, (*values)[cell]);
  for (auto* values : node_arrays()) values->insert(values->begin() + cell + 1, (*values)[cell + 1]);
  cell_layer_.insert(cell_layer_.begin() + cell, cell_layer_[cell]);
  count_blocks(cell_layer_[cell], 1);
}

/// With its inner node.
void Lagrangian1D::erase_cell(int cell) {
  const int layer = cell_layer_[cell];
  for (auto* values : cell_arrays()) values->erase(values->begin() + cell);
  for (auto* values : node_arrays()) values->erase(values->begin() + cell);
  cell_layer_.erase(cell_layer_.begin() + cell);
  count_blocks(layer, -1);
}

/// So many cells more in a layer.
void Lagrangian1D::count_blocks(int layer, int more) {
  blocks_[layer].end += more;
  for (std::size_t k = layer + 1; k < blocks_.size(); ++k) {
    blocks_[k].begin += more;
    blocks_[k].end += more;
  }
}

}  // namespace undex::exact
