// Values that carry their unit: "7 mm", "3 g", "2 GPa". Read by udunits2; everything behind the reader is in SI.
#pragma once

#include <optional>
#include <string>

namespace undex::scene {

/// Outcome of a conversion: the value, or why there is none.
struct Converted {
  std::optional<double> value;
  std::string flaw;  ///< completes "... = "7 m" "
};

/// The value of a text, a number and its unit, in `unit` (empty: a pure number) to 15 digits.
Converted in_unit(const std::string& text, const std::string& unit);

}  // namespace undex::scene
