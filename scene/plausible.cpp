#include "scene/plausible.hpp"

#include <cmath>

#include "materials/burn.hpp"
#include "materials/pedigree.hpp"
#include "scene/numbers.hpp"
#include "scene/usual_units.hpp"

namespace undex::scene {
namespace {

using namespace materials;

const Usual none_but_si(double low, double high) { return {"", low, high, 1, {}}; }

struct OfExplosive {
  const char* key;
  Usual usual;
};
const std::vector<OfExplosive>& of_explosives() {
  static const std::vector<OfExplosive> all{
      {"rho0", {"kg/m^3", 50, 2e4, 1.6e3, usual_density.others}},
      {"A", explosive_pressure},
      {"R1", none_but_si(0.5, 30)},
      {"R2", none_but_si(0.05, 10)},
      {"omega", none_but_si(0.01, 3)},
      {"E0", explosive_energy},
      {"D", explosive_speed},
      {"p_cj", explosive_front_pressure},
  };
  return all;
}

double off(double given, double own) { return std::abs(given / own - 1); }

std::string in_words(const ChapmanJouguet& own) {
  return "A, B, R1, R2, omega, E0 and rho0 have their Chapman-Jouguet state at D = " + rounded(own.detonation_speed) +
         " m/s and p_cj = " + rounded(own.pressure * 1e-9) + " GPa";
}

/// The set's own Chapman-Jouguet state beside the published D and p_cj.
void check(const TableReader& table, const Jwl& law, Report& warnings) {
  const Jwl::Parameters& p = law.parameters();
  const Node& at = table.has("D") ? *table.find("D") : table.node();
  try {
    const ChapmanJouguet own = chapman_jouguet(law);
    const bool speed = off(p.D, own.detonation_speed) > contradiction;
    if (speed || off(p.p_cj, own.pressure) > contradiction)
      table.complain(speed ? "D" : "p_cj", (speed ? table.path_of("D") + " = " + shortest(p.D) + " [m/s]"
                                                  : table.path_of("p_cj") + " = " + shortest(p.p_cj) + " [Pa]") +
                                               " and the rest of the set contradict each other: " + in_words(own) +
                                               "; correct one of them (units? E0 is per mass)");
    else if (off(p.D, own.detonation_speed) > agreement || off(p.p_cj, own.pressure) > agreement)
      warnings.add(at, table.path() + ": D = " + rounded(p.D) + " m/s and p_cj = " + rounded(p.p_cj * 1e-9) +
                           " GPa are not those of the set itself: " + in_words(own) +
                           "; a programmed burn runs at D and gives neither pressure then. Take one set from one source");
  } catch (const std::domain_error& none) {
    warnings.add(at, table.path() + ": " + none.what() + ": such products do not detonate; check the set");
  }
}

/// Of what is left liquids are told from nothing but their speed of sound: none has less than ten metres a second or more
/// than 2e4.
template <class Law>
void check(const TableReader& table, const Law& law, Report& warnings) {
  if constexpr (!Law::is_gas) {  // gases are also used without dimensions
    const double rho0 = law.parameters().rho0;
    double sound = 0;
    try {
      sound = law.evaluate(rho0 * (1 + 1e-9), 0.0).sound_speed;
    } catch (const std::exception&) {
      return;
    }
    if (Law::uses_energy && !(sound > 10)) return;  // at energy zero it may be anything
    if (rho0 > 30 && rho0 < 3e4 && sound > 10 && sound < 2e4) return;
    warnings.add(table.node(), table.path() + ": a liquid of " + rounded(rho0) + " kg/m^3 with a sound speed of " +
                                   rounded(sound) + " m/s; are its numbers in SI units (kg/m^3, Pa, m/s)?");
  }
}

/// The numbers of a solid by themselves.
void check_units(const TableReader& table, const Solid& solid) {
  const char* what = "a solid";
  expect_unit(table, "rho0", table.path_of("rho0"), what, usual_density, solid.rho0);
  expect_unit(table, "heat_capacity", table.path_of("heat_capacity"), what, usual_heat_capacity, solid.heat_capacity);
  std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.C; })
          expect_unit(table, "pressure", table.path_of("pressure") + ".C", what, usual_speed, law.C);
      },
      solid.pressure);
  std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.Y0; })
          expect_unit(table, "flow", table.path_of("flow") + ".Y0", what, usual_strength, law.Y0);
        else if constexpr (requires { law.A; })
          expect_unit(table, "flow", table.path_of("flow") + ".A", what, usual_strength, law.A);
      },
      solid.flow);
  if (solid.spall) expect_unit(table, "spall", table.path_of("spall") + ".strength", what, usual_strength, solid.spall->strength);
}

/// Moduli, of gels to diamond, are told by the wave speed that they make with the density [kg/m^3] that is meant.
void check_moduli(const TableReader& table, const Solid& solid, double density, double wave_speed) {
  constexpr double softest = 1e3;  // [Pa], of gels
  if (table.has("shear_modulus") && solid.shear_modulus > 0 && solid.shear_modulus < softest)
    return expect_unit(table, "shear_modulus", table.path_of("shear_modulus"), "a solid", usual_modulus, solid.shear_modulus);
  if (wave_speed > 30 && wave_speed < 1e5) return;
  const char* key = table.has("young_modulus") ? "young_modulus" : "shear_modulus";
  double value = solid.shear_modulus;
  if (table.has("young_modulus")) table.read("young_modulus", value);
  for (const Usual::Other& other : usual_modulus.others) {
    const double sound = wave_speed * std::sqrt(other.factor);
    if (sound < 800 || sound > 2e4) continue;
    table.complain(key, table.path_of(key) + " = " + shortest(value) + " [Pa] makes a wave speed of " + rounded(wave_speed) +
                            " m/s with rho0 = " + rounded(density) + " kg/m^3; is it in " + other.unit + "? In Pa it would be " +
                            rounded(value * other.factor));
    return;
  }
}

void expect_usual_unit_of_explosive(const TableReader& table, const Key& key, double value, double density) {
  for (const auto& [name, usual] : of_explosives()) {
    if (std::string_view(name) != key.name || usual.holds(value) || !table.has(key.name)) continue;
    std::string why = guess(usual, value);
    if (std::string_view(key.name) == "E0" && value > usual.high && usual.holds(value / density))
      why = "; is it per volume, in J/m^3? Per mass it would be " + rounded(value / density);
    table.complain(key.name, table.path_of(key.name) + " = " + shortest(value) +
                                 (*usual.unit ? std::string(" [") + usual.unit + "]" : "") + " is not that of an explosive, " +
                                 rounded(usual.low) + " to " + rounded(usual.high) + why);
  }
}

}  // namespace

void expect_usual_units(const TableReader& table, const Jwl::Parameters& p) {
  for_each_field(p, [&](const auto& member, const Key& key) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
      expect_usual_unit_of_explosive(table, key, member, p.rho0);
  });
}

void expect_usual_units(const TableReader& table, const TaitWater::Parameters& p) {
  expect_unit(table, "rho0", table.path_of("rho0"), "a liquid", usual_density, p.rho0);
  expect_unit(table, "B", table.path_of("B"), "a liquid", usual_stiffness, p.B);
}
void expect_usual_units(const TableReader& table, const MieGruneisenWater::Parameters& p) {
  expect_unit(table, "rho0", table.path_of("rho0"), "a liquid", usual_density, p.rho0);
  expect_unit(table, "C0", table.path_of("C0"), "a liquid", usual_speed, p.C0);
}
void expect_usual_units(const TableReader& table, const PolynomialWater::Parameters& p) {
  expect_unit(table, "rho0", table.path_of("rho0"), "a liquid", usual_density, p.rho0);
  expect_unit(table, "A", table.path_of("A"), "a liquid", usual_stiffness, p.A);
}
/// Also used without dimensions: only where the density is a liquid's.
void expect_usual_units(const TableReader& table, const StiffenedGas::Parameters& p) {
  if (p.rho0 >= 300 && usual_density.holds(p.rho0) && p.p_inf > 0)
    expect_unit(table, "p_inf", table.path_of("p_inf"), "a liquid", usual_stiffness, p.p_inf);
}

void expect_plausible(const TableReader& table, const FluidLaw& law, Report& warnings) {
  std::visit([&](const auto& each) { check(table, each, warnings); }, law);
}

void expect_plausible(const TableReader& table, const Solid& solid, Report& warnings) {
  const double K = bulk_modulus(solid.pressure, solid.rho0);
  const double G = solid.shear_modulus, sound = std::sqrt((K + 4 * G / 3) / solid.rho0);
  const std::size_t before = table.report().size();
  check_units(table, solid);
  const Usual::Other* other = usual_density.holds(solid.rho0) ? nullptr : usual_density.likely(solid.rho0);
  const double density = solid.rho0 * (other ? other->factor : 1);
  check_moduli(table, solid, density, std::sqrt((K + 4 * G / 3) / density));
  if (table.report().size() > before) return;
  const double poisson = (3 * K - 2 * G) / (2 * (3 * K + G));
  if (poisson < -0.01 || poisson >= 0.5)
    warnings.add(table.node(), table.path() + ": shear modulus " + rounded(G) + " Pa and bulk modulus " + rounded(K) +
                                   " Pa have a Poisson's ratio of " + rounded(poisson) + "; are both in Pa?");
  if (solid.rho0 < 30 || solid.rho0 > 3e4 || sound < 10 || sound > 2e5)
    warnings.add(table.node(), table.path() + ": a solid of " + rounded(solid.rho0) + " kg/m^3 with a sound speed of " +
                                   rounded(sound) + " m/s; are its numbers in SI units (kg/m^3, Pa)?");
}

void expect_plausible_burn(const TableReader& burn, const Jwl& products, double speed, Report& warnings) {
  if (!burn.has("speed")) return;
  try {
    const ChapmanJouguet own = chapman_jouguet(products);
    if (off(speed, own.detonation_speed) <= agreement) return;
    const std::string message =
        burn.path_of("speed") + " = " + shortest(speed) + " [m/s] is not the detonation speed of the material: " + in_words(own);
    if (off(speed, own.detonation_speed) > contradiction)
      burn.complain("speed", message + "; leave it out, or change the material");
    else warnings.add(*burn.find("speed"), message + "; the front's pressure is then not that of the set");
  } catch (const std::domain_error&) {  // the material has been complained of
  }
}

std::string beyond_set(std::string_view material, double pressure) {
  constexpr double margin = 1.05;  // the sets' own pressures are round numbers
  const auto pedigree = find_pedigree(material);
  if (!pedigree || !(pressure > margin * pedigree->valid_to)) return {};
  return "beyond the " + rounded(1e-9 * pedigree->valid_to) + " GPa to which '" + pedigree->name +
         "' may be used; 'undex materials --kind " + pedigree->kind + "' shows sets that go further";
}

}  // namespace undex::scene
