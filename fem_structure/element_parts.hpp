// All cells of a structure, in sets of one material each: what its step asks of them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fem_structure/element_set.hpp"
#include "fem_structure/settings.hpp"

namespace undex::fem {

/// The part with a material of its own that each cell belongs to, an index into settings.parts; -1: to none.
std::vector<int> parts_of(const Settings& settings, const Grid& grid);
/// The material of a part, -1 for what is in none.
const materials::Solid& material_of(const Settings& settings, int part);

class ElementParts {
 public:
  ElementParts(const Settings& settings, const Grid& grid);

  // As those of ElementSet, of all cells in the grid's order.
  long advance(std::span<const Vec3> x, std::span<const Vec3> u, double dt, std::span<Vec3> force);
  double critical_step() const;
  std::size_t critical_cell() const;
  double coming_step(std::span<const Vec3> x, std::span<const Vec3> v) const;
  const std::vector<double>& nodal_mass() const { return places_.empty() ? sets_[0]->nodal_mass() : nodal_mass_; }
  double elastic_energy() const;
  double plastic_work() const;
  double viscous_work() const;
  int points_per_cell() const { return sets_[0]->points_per_cell(); }
  double mean_share(int q) const { return sets_[0]->mean_share(q); }
  std::vector<double> shares_at(const std::array<double, 3>& unit) const { return sets_[0]->shares_at(unit); }
  Mat3 stress(std::size_t cell, int q) const { return set(cell).stress(index(cell), q); }
  double pressure(std::size_t cell) const { return set(cell).pressure(index(cell)); }
  double plastic_strain(std::size_t cell, int q) const { return set(cell).plastic_strain(index(cell), q); }
  double temperature(std::size_t cell, int q) const { return set(cell).temperature(index(cell), q); }
  std::size_t memory_bytes() const;
  void visit_state(StateVisitor& state);

  /// visit(set, cell_of): each set, and the cell of the grid that an index in it stands for.
  template <class Visit>
  void for_each_set(Visit&& visit) const {
    for (std::size_t s = 0; s < sets_.size(); ++s)
      visit(*sets_[s], [&](std::size_t i) { return places_.empty() ? i : cells_[s][i]; });
  }

  /// Names of the materials, "a" or "a, b".
  const std::string& materials() const { return materials_; }

 private:
  struct Place {
    std::size_t set, index;
  };
  const ElementSet& set(std::size_t cell) const { return *sets_[places_.empty() ? 0 : places_[cell].set]; }
  std::size_t index(std::size_t cell) const { return places_.empty() ? cell : places_[cell].index; }

  std::vector<std::unique_ptr<ElementSet>> sets_;
  std::vector<Place> places_;                    ///< of each cell; empty where there is one set
  std::vector<std::vector<std::size_t>> cells_;  ///< of each set, where there are several
  std::vector<double> nodal_mass_;               ///< likewise
  std::vector<Vec3> force_of_set_;               // scratch
  std::string materials_;
};

}  // namespace undex::fem
