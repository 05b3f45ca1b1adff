#include "coupling/coupler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <variant>

#include "coupling/liquid_layers.hpp"
#include "coupling/wall_depth.hpp"

namespace undex::coupling {

sph::StepLimit added_mass_limit(const sph::Settings& fluid, const WetBody& structure) {
  const WetSurface& surface = structure.wet_surface();
  const std::vector<double> area = nodal_areas(surface.faces, surface.nodes, fluid.axisymmetric);
  const auto mass = structure.wet_masses();
  const LiquidLayers liquids(fluid);
  sph::StepLimit limit;
  limit.step = std::numeric_limits<double>::infinity();
  limit.criterion = "added mass";
  if (liquids.empty()) return limit;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const LiquidLayers::Layer& liquid = liquids.nearest(surface.nodes[n]);
    const double step = added_mass_share * std::sqrt(mass[n] / (area[n] * liquid.stiffness));
    if (step < limit.step) {
      limit.step = step;
      limit.position = surface.nodes[n];
      limit.body = liquid.body->name;
    }
  }
  return limit;
}

namespace {

/// The nodes from `first` to `last` and their faces.
WetSurface part_of(const WetSurface& surface, std::size_t first, std::size_t last) {
  WetSurface part;
  part.nodes.assign(surface.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                    surface.nodes.begin() + static_cast<std::ptrdiff_t>(last));
  for (std::array<int, 4> face : surface.faces) {
    if (std::size_t(face[0]) < first || std::size_t(face[0]) >= last) continue;
    for (int& node : face) node -= static_cast<int>(first);
    part.faces.push_back(face);
  }
  return part;
}

/// A closed face of a wall in which a wet face lies would bear a part of its load.
void expect_open(const WetSurface& surface, const sph::Settings& fluid) {
  const double near = 1e-3 * fluid.lattice.spacing;
  const auto lies_in_wall = [&](const std::array<int, 4>& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](int n) { return std::abs(depth_in_walls(surface.nodes[std::size_t(n)], fluid)) < near; });
  };
  const auto found = std::find_if(surface.faces.begin(), surface.faces.end(), lies_in_wall);
  if (found == surface.faces.end()) return;
  const Vec3& x = surface.nodes[std::size_t((*found)[0])];
  char place[120];
  std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
  throw std::invalid_argument(
      std::string("wet: a closed face of a wall lies in the wet surface, e.g. at ") + place +
      ", and would bear a part of its load; let that face of the wall be \"open\", which the structure closes");
}

}  // namespace

Coupler::Coupler(Flow& flow, WetBody& structure, const Settings& settings)
    : flow_(flow),
      fluid_(flow.fluid()),
      structure_(structure),
      settings_(settings),
      added_mass_(added_mass_limit(fluid_.settings(), structure)),
      on_faces_(structure.wet_surface(), structure.wet_faces()),
      predicted_position_(structure.wet_surface().nodes.size()),
      predicted_velocity_(predicted_position_.size()),
      nodal_impulse_(predicted_position_.size(), Vec3::Zero()) {
  expect_open(structure.wet_surface(), fluid_.settings());
  const std::vector<std::size_t> begin = structure.wet_walls();
  for (std::size_t k = 0; k + 1 < begin.size(); ++k) {
    if (begin[k + 1] == begin[k]) continue;
    const WetWall wall(part_of(structure.wet_surface(), begin[k], begin[k + 1]), fluid_.settings());
    walls_.push_back({.first = begin[k],
                      .count = begin[k + 1] - begin[k],
                      .wall = wall,
                      .index = wall.add_to(fluid_, settings.free_slip),
                      .impulse = std::vector<Vec3>(begin[k + 1] - begin[k])});
  }
  show_wall(0.0);
}

/// The wall `ahead` [s] after the structure's present state, at its present acceleration.
void Coupler::show_wall(double ahead) {
  const auto timer = timers_.measure("coupling");
  const auto x = structure_.wet_positions(), v = structure_.wet_velocities(), a = structure_.wet_accelerations();
  for (std::size_t n = 0; n < x.size(); ++n) {
    predicted_position_[n] = x[n] + ahead * (v[n] + 0.5 * ahead * a[n]);
    predicted_velocity_[n] = v[n] + ahead * a[n];
  }
  for (const Part& part : walls_) {
    const auto of = [&](const std::vector<Vec3>& all) { return std::span(all).subspan(part.first, part.count); };
    std::visit([&](auto index) { part.wall.move(of(predicted_position_), of(predicted_velocity_), fluid_.wall(index)); },
               part.index);
  }
}

sph::StepLimit Coupler::step_limit() {
  const sph::StepLimit limit = flow_.step_limit();
  return added_mass_.step < limit.step && !fluid_.settings().numerics.fixed_step ? added_mass_ : limit;
}

void Coupler::collect_impulse() {
  for (Part& part : walls_) {
    std::fill(part.impulse.begin(), part.impulse.end(), Vec3::Zero());
    std::visit(
        [&](auto index) {
          auto& wall = fluid_.wall(index);
          ledger_.book_given(wall.impulse);
          part.wall.collect_impulse(wall, part.impulse);
        },
        part.index);
    std::copy(part.impulse.begin(), part.impulse.end(), nodal_impulse_.begin() + static_cast<std::ptrdiff_t>(part.first));
  }
}

Coupler::Window Coupler::advance(double end) {
  Window window;
  const double start = structure_.time();
  const double patience = std::min(settings_.window * structure_.stable_step(), added_mass_.step);
  const long structure_steps = structure_.steps();
  window.limit = step_limit();
  double target = std::min(end, start + std::max(patience, window.limit.step));
  // The last two windows before `end` share what is left, so that none is tiny.
  if (target < end && end - start < 2.0 * (target - start)) target = 0.5 * (start + end);
  do {
    if (window.fluid_steps > 0) window.limit = step_limit();
    const double left = target - fluid_.time();
    window.step = left / std::ceil(left / window.limit.step - 1e-9);
    show_wall(fluid_.time() + window.step - start);
    flow_.step(window.step);
    ++window.fluid_steps;
  } while (fluid_.time() < target * (1 - 1e-12));
  window.held_by_structure = window.fluid_steps > 1;

  {
    const auto timer = timers_.measure("coupling");
    collect_impulse();
    ledger_.book_received(nodal_impulse_);
    on_faces_.book(nodal_impulse_, structure_.wet_positions());
  }
  structure_.advance(fluid_.time(), nodal_impulse_);
  window.structure_steps = structure_.steps() - structure_steps;
  return window;
}

void Coupler::visit_state(StateVisitor& state) {
  ledger_.visit_state(state);
  on_faces_.visit_state(state);
  state("timers", timers_);
}

InterfaceLedger Coupler::ledger() const {
  InterfaceLedger ledger = ledger_;
  ledger.work_given = fluid_.ledger().wall_work;
  ledger.work_received = structure_.ledger().received;
  return ledger;
}

}  // namespace undex::coupling
