#include "fem_structure/element_parts.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <type_traits>

#include "fem_structure/elements.hpp"
#include "fem_structure/shell_elements.hpp"

namespace undex::fem {
namespace {

std::unique_ptr<ElementSet> make_elements(const Settings& settings, const Grid& grid, const materials::Solid& material) {
  const auto make = [&]<class Kind>(std::type_identity<Kind>, auto... more) -> std::unique_ptr<ElementSet> {
    return std::make_unique<Kind>(grid, material, settings.linear_viscosity, settings.quadratic_viscosity, more...);
  };
  const bool rings = settings.axisymmetric;
  if (settings.element == ElementKind::hexahedron)
    return rings ? make(std::type_identity<RingElements>()) : make(std::type_identity<Elements>());
  const int through = thickness_direction(settings.mesh, rings, "structure '" + settings.name + "'");
  return rings ? make(std::type_identity<RingShells>(), through, settings.points_through)
               : make(std::type_identity<ShellElements>(), through, settings.points_through);
}

/// Cells of a grid with all of its nodes.
Grid grid_of(const Grid& grid, const std::vector<std::size_t>& cells) {
  Grid part;
  part.axisymmetric = grid.axisymmetric;
  part.nodes = grid.nodes;
  part.reference = grid.reference;
  for (const std::size_t c : cells) {
    part.cells.push_back(grid.cells[c]);
    part.nodal_volume.push_back(grid.nodal_volume[c]);
  }
  return part;
}

template <class Of>
double sum(const std::vector<std::unique_ptr<ElementSet>>& sets, Of of) {
  double total = 0.0;
  for (const auto& set : sets) total += of(*set);
  return total;
}

}  // namespace

std::vector<int> parts_of(const Settings& settings, const Grid& grid) {
  std::vector<int> part_of(grid.cells.size(), -1);
  std::map<int, int> of_group;
  for (std::size_t p = 0; p < settings.parts.size(); ++p) {
    if (!settings.parts[p].material) continue;
    const std::string name = grid.group_names.meant_by(settings.parts[p].group);
    for (const int group : grid.groups)
      if (!of_group.count(group) && grid.group_names.of(group) == name) of_group[group] = int(p);
  }
  for (std::size_t c = 0; c < grid.groups.size(); ++c)
    if (const auto found = of_group.find(grid.groups[c]); found != of_group.end()) part_of[c] = found->second;
  return part_of;
}

const materials::Solid& material_of(const Settings& settings, int part) {
  return part < 0 ? settings.material : *settings.parts[std::size_t(part)].material;
}

ElementParts::ElementParts(const Settings& settings, const Grid& grid) {
  std::map<int, std::vector<std::size_t>> cells_of;
  const std::vector<int> part_of = parts_of(settings, grid);
  for (std::size_t c = 0; c < part_of.size(); ++c) cells_of[part_of[c]].push_back(c);
  if (cells_of.size() > 1) places_.resize(grid.cells.size());
  for (const auto& [part, cells] : cells_of) {
    const materials::Solid& material = material_of(settings, part);
    materials_ += (materials_.empty() ? "" : ", ") + material.name;
    if (cells_of.size() == 1) {
      sets_.push_back(make_elements(settings, grid, material));
      return;
    }
    for (std::size_t k = 0; k < cells.size(); ++k) places_[cells[k]] = {sets_.size(), k};
    sets_.push_back(make_elements(settings, grid_of(grid, cells), material));
    cells_.push_back(cells);
  }
  nodal_mass_.assign(grid.nodes.size(), 0.0);
  for (const auto& set : sets_)
    for (std::size_t i = 0; i < nodal_mass_.size(); ++i) nodal_mass_[i] += set->nodal_mass()[i];
  force_of_set_.assign(grid.nodes.size(), Vec3::Zero());
}

long ElementParts::advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force) {
  if (places_.empty()) return sets_[0]->advance(x, u, dt, force);
  std::fill(force.begin(), force.end(), Vec3::Zero());
  long failed = -1;
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const long wrong = sets_[s]->advance(x, u, dt, force_of_set_);
    if (wrong >= 0 && failed < 0) failed = long(cells_[s][std::size_t(wrong)]);
    for (std::size_t i = 0; i < force.size(); ++i) force[i] += force_of_set_[i];
  }
  return failed;
}

double ElementParts::critical_step() const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& set : sets_) least = std::min(least, set->critical_step());
  return least;
}

std::size_t ElementParts::critical_cell() const {
  std::size_t tightest = 0;
  for (std::size_t s = 1; s < sets_.size(); ++s)
    if (sets_[s]->critical_step() < sets_[tightest]->critical_step()) tightest = s;
  const std::size_t cell = sets_[tightest]->critical_cell();
  return places_.empty() ? cell : cells_[tightest][cell];
}

double ElementParts::coming_step(std::span<const Vec3> x, std::span<const Vec3> v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& set : sets_) least = std::min(least, set->coming_step(x, v));
  return least;
}

double ElementParts::elastic_energy() const {
  return sum(sets_, [](const ElementSet& set) { return set.elastic_energy(); });
}
double ElementParts::plastic_work() const {
  return sum(sets_, [](const ElementSet& set) { return set.plastic_work(); });
}
double ElementParts::viscous_work() const {
  return sum(sets_, [](const ElementSet& set) { return set.viscous_work(); });
}

std::size_t ElementParts::memory_bytes() const {
  std::size_t bytes = (nodal_mass_.size() * sizeof(double)) + places_.size() * (sizeof(Place) + sizeof(std::size_t));
  for (const auto& set : sets_) bytes += set->memory_bytes();
  return bytes + force_of_set_.size() * sizeof(Vec3);
}

void ElementParts::visit_state(StateVisitor& state) {
  if (places_.empty()) return sets_[0]->visit_state(state);
  for (std::size_t s = 0; s < sets_.size(); ++s) state.part("part " + std::to_string(s), [&] { sets_[s]->visit_state(state); });
}

}  // namespace undex::fem
