#include "scene/usual_units.hpp"

#include <cmath>

#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

const std::vector<Usual::Other> pressures{{"GPa", 1e9}, {"Mbar", 1e11}, {"MPa", 1e6}};
const std::vector<Usual::Other> speeds{{"km/s", 1e3}, {"cm/us", 1e4}, {"mm/s", 1e-3}};

}  // namespace

const Usual usual_density{"kg/m^3", 20, 3e4, 3e3, {{"g/cm^3", 1e3}, {"t/mm^3", 1e12}}};
const Usual usual_modulus{"Pa", 1e5, 1e14, 1e11, pressures};
const Usual usual_stiffness{"Pa", 1e5, 1e12, 5e8, pressures};
const Usual usual_strength{"Pa", 1e4, 2e10, 3e8, {{"MPa", 1e6}, {"GPa", 1e9}, {"Mbar", 1e11}}};
const Usual usual_speed{"m/s", 100, 3e4, 3e3, speeds};
const Usual usual_heat_capacity{"J/kg/K", 50, 1e4, 600, {{"J/g/K", 1e3}, {"mJ/t/K", 1e-6}}};
const Usual explosive_pressure{"Pa", 1e8, 1e14, 4e11, pressures};
const Usual explosive_energy{"J/kg", 1e4, 1e8, 5e6, {{"kJ/g or MJ/kg", 1e6}, {"kJ/kg", 1e3}}};
const Usual explosive_speed{"m/s", 500, 2e4, 7e3, speeds};
const Usual explosive_front_pressure{"Pa", 1e7, 1e12, 2e10, pressures};

const Usual::Other* Usual::likely(double value) const {
  const Other* best = nullptr;
  const auto off = [&](const Other& other) { return std::abs(std::log(value * other.factor / typical)); };
  for (const Other& other : others)
    if (holds(value * other.factor) && (!best || off(other) < off(*best))) best = &other;
  return best;
}

std::string guess(const Usual& usual, double value) {
  const Usual::Other* other = usual.likely(value);
  if (!other) return "; check its unit";
  return std::string("; is it in ") + other->unit + "? In " + usual.unit + " it would be " + rounded(value * other->factor);
}

void expect_unit(const TableReader& table, const char* key, const std::string& path, const char* what, const Usual& usual,
                 double value) {
  if (usual.holds(value) || !usual.likely(value)) return;
  table.complain(key, path + " = " + shortest(value) + " [" + usual.unit + "] is not that of " + what + ", " +
                          rounded(usual.low) + " to " + rounded(usual.high) + guess(usual, value));
}

}  // namespace undex::scene
