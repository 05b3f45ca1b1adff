#include "scene/plausible.hpp"

#include <cmath>

#include "materials/burn.hpp"
#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

using namespace materials;

/// What a quantity is of real materials, in SI units, and how it looks in other units: a value times `factor` is in SI.
struct Usual {
  const char* key;
  const char* unit;
  double low, high;
  struct Other {
    const char* unit;
    double factor;
  };
  std::vector<Other> others;
};

/// " (is it in km/s?)" where the value would be usual in another unit.
std::string guess(const Usual& usual, double value) {
  for (const auto& [unit, factor] : usual.others)
    if (value * factor >= usual.low && value * factor <= usual.high)
      return std::string("; is it in ") + unit + "? In " + usual.unit + " it would be " + rounded(value * factor);
  return "; check its unit";
}

const std::vector<Usual> of_explosives{
    {"rho0", "kg/m^3", 50, 2e4, {{"g/cm^3", 1e3}}},
    {"A", "Pa", 1e8, 1e14, {{"GPa", 1e9}, {"Mbar", 1e11}, {"MPa", 1e6}}},
    {"R1", "", 0.5, 30, {}},
    {"R2", "", 0.05, 10, {}},
    {"omega", "", 0.01, 3, {}},
    {"E0", "J/kg", 1e4, 1e8, {{"kJ/g or MJ/kg", 1e6}, {"kJ/kg", 1e3}}},
    {"D", "m/s", 500, 2e4, {{"km/s", 1e3}, {"cm/us", 1e4}}},
    {"p_cj", "Pa", 1e7, 1e12, {{"GPa", 1e9}, {"Mbar", 1e11}, {"MPa", 1e6}}},
};

void expect_usual(const TableReader& table, const std::vector<Usual>& usual, const Jwl::Parameters& p) {
  for_each_field(p, [&](const auto& value, const Key& key) {
    for (const Usual& one : usual) {
      if (std::string_view(one.key) != key.name || (value >= one.low && value <= one.high)) continue;
      std::string why = guess(one, value);
      if (std::string_view(key.name) == "E0" && value / p.rho0 >= one.low && value / p.rho0 <= one.high && value > one.high)
        why = "; is it per volume, in J/m^3? Per mass it would be " + rounded(value / p.rho0);
      table.complain(key.name, table.path_of(key.name) + " = " + shortest(value) +
                                   (*one.unit ? std::string(" [") + one.unit + "]" : "") + " is not that of an explosive, " +
                                   rounded(one.low) + " to " + rounded(one.high) + why);
    }
  });
}

double off(double given, double own) { return std::abs(given / own - 1); }

/// The set's own Chapman-Jouguet state beside the published D and p_cj.
void check(const TableReader& table, const Jwl& law, Report& warnings) {
  const Jwl::Parameters& p = law.parameters();
  const std::size_t before = table.report().size();
  expect_usual(table, of_explosives, p);
  if (table.report().size() > before) return;
  const Node& at = table.has("D") ? *table.find("D") : table.node();
  try {
    const ChapmanJouguet own = chapman_jouguet(law);
    const std::string state =
        "A, B, R1, R2, omega, E0 and rho0 have their Chapman-Jouguet state at D = " + rounded(own.detonation_speed) +
        " m/s and p_cj = " + rounded(own.pressure * 1e-9) + " GPa";
    if (own.detonation_speed > 2 * p.D || p.D > 2 * own.detonation_speed)
      table.report().add(at, table.path() + ".D = " + shortest(p.D) + " [m/s] and the rest of the set contradict each other: " +
                                 state + "; correct one of them (units? E0 is per mass)");
    else if (off(p.D, own.detonation_speed) > 0.02 || off(p.p_cj, own.pressure) > 0.02)
      warnings.add(at, table.path() + ": D = " + rounded(p.D) + " m/s and p_cj = " + rounded(p.p_cj * 1e-9) +
                           " GPa are not those of the set itself: " + state +
                           "; a programmed burn runs at D and gives neither pressure then. Take one set from one source");
  } catch (const std::domain_error& none) {
    warnings.add(at, table.path() + ": " + none.what() + ": such products do not detonate; check the set");
  }
}

/// Other fluids are told from nothing but their speed of sound: no fluid has less than ten metres a second or more than 2e4.
template <class Law>
void check(const TableReader& table, const Law& law, Report& warnings) {
  if (Law::is_gas) return;  // also used without dimensions
  const double rho0 = law.parameters().rho0;
  double sound = 0;
  try {
    sound = law.evaluate(rho0 * (1 + 1e-9), 0.0).sound_speed;
  } catch (const std::exception&) {
    return;
  }
  if (Law::uses_energy && !(sound > 10)) return;  // at energy zero it may be anything
  if (rho0 > 30 && rho0 < 3e4 && sound > 10 && sound < 2e4) return;
  warnings.add(table.node(), table.path() + ": a liquid of " + rounded(rho0) + " kg/m^3 with a sound speed of " + rounded(sound) +
                                 " m/s; are its numbers in SI units (kg/m^3, Pa, m/s)?");
}

}  // namespace

void expect_plausible(const TableReader& table, const FluidLaw& law, Report& warnings) {
  std::visit([&](const auto& each) { check(table, each, warnings); }, law);
}

void expect_plausible(const TableReader& table, const Solid& solid, Report& warnings) {
  const double K = bulk_modulus(solid.pressure, solid.rho0);
  const double G = solid.shear_modulus, sound = std::sqrt((K + 4 * G / 3) / solid.rho0);
  const double poisson = (3 * K - 2 * G) / (2 * (3 * K + G));
  if (poisson < -0.5 || poisson >= 0.5)
    warnings.add(table.node(), table.path() + ": shear modulus " + rounded(G) + " Pa and bulk modulus " + rounded(K) +
                                   " Pa have a Poisson's ratio of " + rounded(poisson) + "; are both in Pa?");
  if (solid.rho0 < 30 || solid.rho0 > 3e4 || sound < 10 || sound > 2e5)
    warnings.add(table.node(), table.path() + ": a solid of " + rounded(solid.rho0) + " kg/m^3 with a sound speed of " +
                                   rounded(sound) + " m/s; are its numbers in SI units (kg/m^3, Pa)?");
}

}  // namespace undex::scene
