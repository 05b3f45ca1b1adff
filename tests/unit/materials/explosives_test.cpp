// The library's explosives: their Chapman-Jouguet states against those that another program has computed from the same constants,
// and the energy of sets that are published by their isentrope.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "materials/burn.hpp"
#include "materials/jwl_isentrope.hpp"
#include "materials/library.hpp"
#include "materials/pedigree.hpp"

namespace undex::materials {
namespace {

struct State {
  double D, p_cj;    ///< [m/s], [GPa], to the digits that are known
  double E0_volume;  ///< [GJ/m^3]
};
const std::map<std::string, State> states{
    {"petn", {8301, 33.51, 10.1}},      {"tnt", {6929, 21.00, 7.0}},        {"tnt-omega035", {6929, 21.00, 6.0}},
    {"comp-b", {7980, 29.50, 8.5}},     {"lx-14", {8800, 37.00, 10.2}},     {"comp-b-isentrope", {8033, 29.89, 8.613}},
    {"c-4", {8193, 28.00, 9.0}},        {"hmx", {8995, 39.95, 10.5}},       {"anfo", {4550, 5.50, 3.15}},
    {"anfo-1160", {5899, 10.17, 4.0}},  {"pbx-9501", {8756, 37.23, 10.64}}, {"pbx-9404", {8760, 37.43, 10.6}},
    {"pbx-9502", {7620, 28.50, 6.679}},
};

Jwl products(const std::string& name) { return std::get<Jwl>(find_fluid(name).value().law); }

TEST(Explosives, HaveTheChapmanJouguetStatesOfTheirConstants) {
  std::size_t found = 0;
  for (const std::string& name : fluid_names()) {
    if (find_pedigree(name)->kind != "explosive") continue;
    ++found;
    ASSERT_TRUE(states.contains(name)) << name;
    const State& known = states.at(name);
    const Jwl set = products(name);
    const ChapmanJouguet own = chapman_jouguet(set);
    EXPECT_NEAR(own.detonation_speed, known.D, 0.002 * known.D) << name;
    EXPECT_NEAR(own.pressure * 1e-9, known.p_cj, 0.002 * known.p_cj) << name;
    EXPECT_NEAR(set.parameters().E0 * set.parameters().rho0 * 1e-9, known.E0_volume, 5e-4 * known.E0_volume) << name;
    // Rayleigh's line touches the Hugoniot where the flow is sonic.
    EXPECT_NEAR(own.density * own.sound_speed, set.parameters().rho0 * own.detonation_speed,
                1e-6 * own.density * own.sound_speed);
  }
  EXPECT_EQ(found, states.size());
}

/// A programmed burn runs with a speed and a pressure that the set itself has.
TEST(Explosives, BurnAtTheirOwnState) {
  for (const auto& [name, state] : states) {
    const Jwl::Parameters p = products(name).parameters();
    const ChapmanJouguet own = chapman_jouguet(products(name));
    EXPECT_NEAR(p.D, own.detonation_speed, 0.005 * p.D) << name;
    EXPECT_NEAR(p.p_cj, own.pressure, 0.005 * p.p_cj) << name;
  }
}

TEST(Explosives, ListWhatTheirSourcePrints) {
  EXPECT_EQ(find_pedigree("c-4")->listed_D.value(), 7850);
  EXPECT_EQ(find_pedigree("hmx")->listed_p_cj.value(), 42e9);
  EXPECT_EQ(find_pedigree("petn")->listed_D.value(), 8300);
  EXPECT_FALSE(find_pedigree("pbx-9502")->listed_D.has_value());
  EXPECT_FALSE(find_pedigree("tnt")->listed_p_cj.has_value());
}

/// The isentrope and the law agree in pressure, slope and energy along it.
TEST(Explosives, IsentropeIsThatOfTheLaw) {
  const JwlIsentrope isentrope{.rho0 = 1840, .A = 774.304e9, .B = 20.927e9, .C = 1.39e9, .R1 = 4.5, .R2 = 1.5, .omega = 0.33};
  const Jwl law = products("pbx-9501");
  EXPECT_NEAR(detonation_energy(isentrope), law.parameters().E0, 1e-9 * law.parameters().E0);
  const ChapmanJouguet front = chapman_jouguet(law);
  const double V = 1840 / front.density;
  EXPECT_NEAR(isentrope.pressure(V), front.pressure, 1e-6 * front.pressure);
  EXPECT_NEAR(isentrope.energy(V) / 1840, front.energy, 1e-6 * front.energy);
  for (const double volume : {0.7, 1.0, 2.0, 7.0, 50.0}) {
    const PressureSound s = law.evaluate(1840 / volume, isentrope.energy(volume) / 1840);
    EXPECT_NEAR(s.pressure, isentrope.pressure(volume), 1e-9 * s.pressure) << volume;
    const double slope = -isentrope.slope(volume) * volume * volume / 1840;  // dp/drho
    EXPECT_NEAR(s.sound_speed * s.sound_speed, slope, 1e-9 * slope) << volume;
    const double step = 1e-6 * volume;
    EXPECT_NEAR((isentrope.energy(volume - step) - isentrope.energy(volume + step)) / (2 * step), isentrope.pressure(volume),
                1e-6 * isentrope.pressure(volume));
  }
}

TEST(Explosives, IsentropeWithoutDetonationIsRefused) {
  EXPECT_THROW(detonation_energy({.rho0 = 1000, .A = 1e9, .B = 0, .C = 0, .R1 = 0.1, .R2 = 1, .omega = 0.3}), std::domain_error);
}

}  // namespace
}  // namespace undex::materials
