// The library's text made into sets.
#pragma once

#include <string_view>
#include <vector>

#include "materials/library.hpp"
#include "materials/pedigree.hpp"

namespace undex::materials {

/// materials/data/*.toml, a text a family.
const std::vector<std::string_view>& library_texts();

/// All sets, in the order of the texts; pedigrees of all, fluids and solids alike.
struct Sets {
  std::vector<Fluid> fluids;
  std::vector<Solid> solids;
  std::vector<Pedigree> pedigrees;
};
/// Throws std::logic_error naming the set and the key where a text is not as materials/data/explosives.toml says.
Sets read_sets(const std::vector<std::string_view>& texts);

}  // namespace undex::materials
