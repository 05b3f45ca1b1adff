// The named sets: complete, with sources, and with the numbers they are known by.
#include "materials/library.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "materials/burn.hpp"
#include "materials/tensile_test.hpp"

namespace undex::materials {
namespace {

double value(const std::vector<std::pair<std::string, double>>& table, const std::string& name) {
  for (const auto& [row, number] : table)
    if (row == name) return number;
  ADD_FAILURE() << "no row " << name;
  return std::nan("");
}

TEST(Library, HasEverySetByName) {
  const std::vector<std::string> fluids = fluid_names(), solids = solid_names();
  EXPECT_EQ(std::set<std::string>(fluids.begin(), fluids.end()), (std::set<std::string>{"water-tait",
                                                                                        "water-tait-cutoff",
                                                                                        "water-tait-isentropic",
                                                                                        "seawater",
                                                                                        "water-steinberg",
                                                                                        "water-paper-mg",
                                                                                        "water-mg-schwer",
                                                                                        "water-polynomial",
                                                                                        "water-sg-sussman",
                                                                                        "water-sg-applaud",
                                                                                        "water-sg-ecogen",
                                                                                        "water-sg-ecogen-300k",
                                                                                        "water-sg-saurel",
                                                                                        "water-nasg-ecogen",
                                                                                        "water-nasg-ecogen-298-474k",
                                                                                        "petn",
                                                                                        "tnt",
                                                                                        "tnt-omega035",
                                                                                        "comp-b",
                                                                                        "comp-b-isentrope",
                                                                                        "c-4",
                                                                                        "lx-14",
                                                                                        "hmx",
                                                                                        "anfo",
                                                                                        "anfo-1160",
                                                                                        "pbx-9501",
                                                                                        "pbx-9404",
                                                                                        "pbx-9502",
                                                                                        "bubble-gas",
                                                                                        "sjogreen-gas",
                                                                                        "sjogreen-gas-gamma2",
                                                                                        "air"}));
  EXPECT_EQ(fluids.size(), 32u);
  EXPECT_EQ(std::set<std::string>(solids.begin(), solids.end()), (std::set<std::string>{"al-impact-table2",
                                                                                        "al-2024-t351",
                                                                                        "al-6061-t6",
                                                                                        "al-5083-h116",
                                                                                        "al-5083-h116-m0859",
                                                                                        "al-5086-o",
                                                                                        "al-5086-h116",
                                                                                        "armco-iron",
                                                                                        "copper-ofhc",
                                                                                        "al-5086-za",
                                                                                        "steel-4340",
                                                                                        "armco-iron-za",
                                                                                        "copper-ofhc-za",
                                                                                        "armco-iron-damage",
                                                                                        "copper-ofhc-damage",
                                                                                        "steel-4340-damage",
                                                                                        "steel-4340-mg",
                                                                                        "copper-ofhc-mg",
                                                                                        "steel-hzb",
                                                                                        "steel-s7",
                                                                                        "steel-hy100",
                                                                                        "steel-17-4ph",
                                                                                        "brass-half-hard",
                                                                                        "tungsten",
                                                                                        "tungsten-alloy",
                                                                                        "tungsten-alloy-damage",
                                                                                        "lead"}));
  EXPECT_EQ(solids.size(), 27u);
}

TEST(Library, UnknownNamesAreNothing) {
  for (const char* name : {"", "water", "Water-Tait", "petn ", "al-5083"}) {
    EXPECT_FALSE(find_fluid(name).has_value()) << name;
    EXPECT_FALSE(find_solid(name).has_value()) << name;
  }
  EXPECT_FALSE(find_fluid("armco-iron").has_value());
  EXPECT_FALSE(find_solid("petn").has_value());
}

TEST(Library, FluidsAreUsable) {
  for (const std::string& name : fluid_names()) {
    const Fluid fluid = find_fluid(name).value();
    EXPECT_EQ(fluid.name, name);
    EXPECT_GT(fluid.source.size(), 20u) << name;
    EXPECT_GT(fluid.rho0, 0.0) << name;
    const auto* stiffened = std::get_if<StiffenedGas>(&fluid.law);
    const double energy = stiffened ? stiffened->energy_at(1e5, fluid.rho0) : 2e5;
    const PressureSound s = std::visit([&](const auto& law) { return law.evaluate(fluid.rho0, energy); }, fluid.law);
    EXPECT_GT(s.pressure, 0.0) << name;
    EXPECT_GT(s.sound_speed, 0.0) << name;
    const double back = density_at(fluid.law, s.pressure, energy);
    EXPECT_NEAR(back, fluid.rho0, 1e-9 * fluid.rho0) << name;
    EXPECT_EQ(value(parameters(fluid), "rho0 [kg/m^3]"), fluid.rho0) << name;
  }
}

TEST(Library, EveryParameterHasAUnitAndANumber) {
  const auto check = [](const auto& set) {
    const auto table = parameters(set);
    EXPECT_GE(table.size(), 2u) << set.name;
    std::set<std::string> names;
    for (const auto& [row, number] : table) {
      EXPECT_TRUE(row.find(" [") != std::string::npos && row.back() == ']') << set.name << ": " << row;
      EXPECT_TRUE(std::isfinite(number)) << set.name << ": " << row;
      EXPECT_TRUE(names.insert(row).second) << set.name << " has two rows " << row;
    }
  };
  for (const std::string& name : fluid_names()) check(find_fluid(name).value());
  for (const std::string& name : solid_names()) check(find_solid(name).value());
}

TEST(Library, SolidsAreUsable) {
  for (const std::string& name : solid_names()) {
    const Solid s = find_solid(name).value();
    EXPECT_EQ(s.name, name);
    EXPECT_GT(s.source.size(), 20u) << name;
    EXPECT_GT(s.rho0, 0.0) << name;
    EXPECT_GT(s.shear_modulus, 0.0) << name;
    // Poisson's ratio from the two moduli: metals lie between 0.25 and 0.4, but for lead.
    const double K = bulk_modulus(s), nu = (3 * K - 2 * s.shear_modulus) / (2 * (3 * K + s.shear_modulus));
    EXPECT_GT(nu, 0.25) << name;
    EXPECT_LT(nu, name == "lead" ? 0.43 : 0.4) << name;
    EXPECT_GT(wave_speed(s), name == "lead" ? 2000.0 : 4000.0) << name;
    EXPECT_LT(wave_speed(s), 7000.0) << name;
    EXPECT_GT(s.heat_capacity, 100.0) << name;
    EXPECT_LT(s.heat_capacity, 1000.0) << name;
    EXPECT_EQ(s.taylor_quinney, 0.9) << name;
    const double yield = flow_stress(s.flow, 0.0, 1.0, s.T_room);
    EXPECT_GT(yield, name == "lead" ? 10e6 : 50e6) << name;
    EXPECT_LT(yield, 1600e6) << name;
    if (const auto* jc = std::get_if<JohnsonCook>(&s.flow)) {
      EXPECT_EQ(jc->T_room, s.T_room) << name;
    }
  }
}

TEST(Library, RecalledValuesSaySo) {
  for (const char* name : {"al-2024-t351", "al-5083-h116", "al-5083-h116-m0859", "al-5086-o", "al-5086-h116", "steel-4340",
                           "armco-iron-za", "copper-ofhc-za"})
    EXPECT_NE(find_solid(name)->source.find("recalled, not read"), std::string::npos) << name;
  for (const char* name : {"water-steinberg", "water-tait-isentropic", "seawater", "air"})
    EXPECT_NE(find_fluid(name)->source.find("recalled, not read"), std::string::npos) << name;
}

TEST(Library, KnownNumbers) {
  EXPECT_NEAR(std::get<TaitWater>(find_fluid("water-tait")->law).evaluate(1000.0, 0.0).sound_speed, 1538.4, 0.05);
  EXPECT_EQ(std::get<TaitWater>(find_fluid("water-tait")->law).parameters().cavitation, Cavitation::schmidt);
  EXPECT_EQ(std::get<TaitWater>(find_fluid("water-tait-cutoff")->law).parameters().cavitation, Cavitation::cutoff);
  EXPECT_NEAR(std::get<TaitWater>(find_fluid("seawater")->law).evaluate(1025.0, 0.0).sound_speed, 1500.0, 1e-6);
  EXPECT_NEAR(std::get<MieGruneisenWater>(find_fluid("water-steinberg")->law).evaluate(1200.0, 0.0).pressure, 847e6, 0.5e6);
  EXPECT_NEAR(std::get<MieGruneisenWater>(find_fluid("water-paper-mg")->law).evaluate(1200.0, 0.0).pressure, 1332e6, 0.5e6);
  EXPECT_EQ(std::get<BarotropicGas>(find_fluid("bubble-gas")->law).evaluate(1770.0, 0.0).pressure, 2e9);
  EXPECT_EQ(std::get<BarotropicGas>(find_fluid("sjogreen-gas")->law).parameters().gamma, 1.4);
  EXPECT_EQ(std::get<BarotropicGas>(find_fluid("sjogreen-gas-gamma2")->law).parameters().gamma, 2.0);
  const Jwl petn = std::get<Jwl>(find_fluid("petn")->law);
  EXPECT_NEAR(petn.parameters().E0, 5.706e6, 500.0);
  // The published front speed and pressure fit the set's own Chapman-Jouguet state.
  EXPECT_NEAR(chapman_jouguet(petn).detonation_speed, petn.parameters().D, 1.0);
  EXPECT_NEAR(chapman_jouguet(petn).pressure, petn.parameters().p_cj, 0.01e9);

  const Solid plate = find_solid("al-5083-h116").value();
  EXPECT_NEAR(plate.shear_modulus, 71e9 / 2.66, 1.0);
  EXPECT_NEAR(bulk_modulus(plate), 71e9 / 1.02, 1.0);
  EXPECT_EQ(std::get<JohnsonCook>(plate.flow).m, 1.0);
  EXPECT_EQ(std::get<JohnsonCook>(find_solid("al-5083-h116-m0859")->flow).m, 0.859);
  EXPECT_EQ(std::get<LinearHardening>(find_solid("al-impact-table2")->flow).H, 0.0);
  EXPECT_EQ(value(parameters(find_solid("al-impact-table2").value()), "pressure.C [m/s]"), 5300.0);
  EXPECT_EQ(value(parameters(find_solid("copper-ofhc").value()), "flow.A [Pa]"), 90e6);
}

/// Sound speeds at rest, as the data files state them.
TEST(Library, StiffenedWatersSoundAsStated) {
  for (const auto& [name, sound] : std::map<std::string, double>{{"water-sg-sussman", 1539},
                                                                 {"water-sg-applaud", 1449},
                                                                 {"water-sg-ecogen", 1625},
                                                                 {"water-sg-ecogen-300k", 1461},
                                                                 {"water-sg-saurel", 1533},
                                                                 {"water-nasg-ecogen", 1571},
                                                                 {"water-nasg-ecogen-298-474k", 1589.7}}) {
    const auto law = std::get<StiffenedGas>(find_fluid(name)->law);
    const PressureSound s = law.evaluate(1000, law.energy_at(1.01325e5, 1000));
    EXPECT_NEAR(s.sound_speed, sound, 0.6) << name;
    EXPECT_NEAR(s.pressure, 1.01325e5, 10) << name;
  }
}

TEST(Library, ZerilliArmstrongOf5086IsTheFormulaOfItsSource) {
  const Solid tube = find_solid("al-5086-za").value();
  const double strain = 0.07, rate = 2500.0, T = 350.0;
  EXPECT_NEAR(flow_stress(tube.flow, strain, rate, T),
              234e6 + 1283e6 * std::sqrt(strain) * std::exp(-(0.00371 - 0.000153 * std::log(rate)) * T), 1e-3);
  EXPECT_EQ(tube.shear_modulus, 26.4e9);
}

// Failure is only in sets whose name says so, and changes nothing else of them.
TEST(Library, DamageIsAnOption) {
  for (const std::string& name : solid_names()) {
    const Solid s = find_solid(name).value();
    const auto at = name.find("-damage");
    EXPECT_EQ(can_fail(s), at != std::string::npos) << name;
    EXPECT_FALSE(s.spall.has_value()) << name;
    if (at == std::string::npos) continue;
    const Solid base = find_solid(name.substr(0, at)).value();
    const auto rows = parameters(base), damaged = parameters(s);
    EXPECT_TRUE(std::equal(rows.begin(), rows.end(), damaged.begin())) << name;
    EXPECT_EQ(damaged.size(), rows.size() + 8) << name;
    EXPECT_EQ(s.damage->T_melt, std::get<JohnsonCook>(s.flow).T_melt) << name;
    EXPECT_GT(fracture_strain(*s.damage, 1e3, 1.0, 293.0), 0.03) << name;
  }
  EXPECT_NEAR(fracture_strain(*find_solid("copper-ofhc-damage")->damage, 1.0 / 3.0, 1.0, 293.0), 2.3211, 1e-4);
}

TEST(Library, HardeningOf5086FollowsFromItsTensileTests) {
  const auto check = [](const char* name, const TensileTest& test) {
    const auto law = std::get<JohnsonCook>(find_solid(name)->flow);
    const PowerHardening h = hardening_from(test);
    EXPECT_EQ(law.A, h.A) << name;
    EXPECT_NEAR(law.B, h.B, 0.5e6) << name;
    EXPECT_NEAR(law.n, h.n, 0.0005) << name;
  };
  check("al-5086-o", {.yield = 117e6, .ultimate = 262e6, .uniform_elongation = 0.22});
  check("al-5086-h116", {.yield = 207e6, .ultimate = 290e6, .uniform_elongation = 0.12});
}

}  // namespace
}  // namespace undex::materials
