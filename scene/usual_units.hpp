// Values that are no material's in SI units, and would be one's in others that are in use (mm-t-s, g/cm^3, GPa, Mbar, cm/us).
#pragma once

#include <string>
#include <vector>

#include "scene/table_reader.hpp"

namespace undex::scene {

/// What a quantity is of real materials, in SI units, and how it looks in other units: a value times `factor` is in SI.
struct Usual {
  const char* unit;
  double low, high;
  double typical;
  struct Other {
    const char* unit;
    double factor;
  };
  std::vector<Other> others;

  bool holds(double value) const { return value >= low && value <= high; }
  /// Of the other units in which the value would be usual, that in which it is the most typical; null where there is none.
  const Other* likely(double value) const;
};

extern const Usual usual_density, usual_modulus, usual_stiffness, usual_strength, usual_speed,
    usual_heat_capacity;  ///< stiffness: of liquids
extern const Usual explosive_pressure, explosive_energy, explosive_speed, explosive_front_pressure;

/// "; is it in km/s? In m/s it would be 6930", or "; check its unit".
std::string guess(const Usual& usual, double value);

/// Complains of a value that is not usual and would be in another unit. `path` is the user's name of it, `what` what it is not.
void expect_unit(const TableReader& table, const char* key, const std::string& path, const char* what, const Usual& usual,
                 double value);

}  // namespace undex::scene
