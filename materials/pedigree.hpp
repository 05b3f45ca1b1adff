// What is known of a set of the library beside its constants.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "materials/burn.hpp"

namespace undex::materials {

struct Pedigree {
  std::string name, kind;                       ///< kind: "explosive", "water", "gas" or "metal", the family's
  std::string grade;                            ///< "A" to "D" (materials/data/*.toml say what they mean)
  std::string checked;                          ///< what was checked, and the outcome
  double valid_from, valid_to;                  ///< pressures between which it may be used [Pa]
  std::optional<double> listed_D, listed_p_cj;  ///< of an explosive, as its source prints them [m/s], [Pa]
};

/// A speed or a pressure of detonation agrees with that of the set itself where it is off by no more than the first, and
/// contradicts it by more than the second [-].
inline constexpr double agreement = 0.02, contradiction = 0.2;
/// Does the set fulfil what its source lists? What is not listed cannot be missed.
bool is_verified(const Pedigree& pedigree, const ChapmanJouguet& own);

/// That of the set of the library with that name, or nothing.
std::optional<Pedigree> find_pedigree(std::string_view name);

}  // namespace undex::materials
