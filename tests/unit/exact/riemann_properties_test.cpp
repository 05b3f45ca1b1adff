// Random Riemann problems of every law: what comes back obeys the conservation laws, or the problem is refused with a reason.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "exact/riemann.hpp"
#include "materials/library.hpp"

namespace undex::exact {
namespace {

using materials::Cavitation;
using materials::FluidLaw;

struct Named {
  std::string name;
  FluidLaw law;
  double density, energy;  ///< typical
};

materials::MieGruneisenWater::Parameters aluminium() {
  materials::MieGruneisenWater::Parameters p;
  p.rho0 = 2710, p.C0 = 5300, p.S1 = 1.5, p.S2 = 0, p.S3 = 0, p.gamma0 = 1.7, p.alpha = 0;
  p.cavitation = Cavitation::none;
  return p;
}

std::vector<Named> laws() {
  std::vector<Named> all;
  for (const char* name : {"water-tait", "water-tait-isentropic", "sjogreen-gas", "sjogreen-gas-gamma2", "bubble-gas", "air",
                           "water-steinberg", "water-paper-mg", "petn"}) {
    const auto fluid = materials::find_fluid(name);
    if (!fluid) throw std::invalid_argument(std::string("no such fluid: ") + name);
    const double energy = std::holds_alternative<materials::Jwl>(fluid->law)
                              ? std::get<materials::Jwl>(fluid->law).parameters().E0
                          : name == std::string("air") ? 2e5
                                                       : 0.0;
    const double rho0 = std::visit([](const auto& l) { return l.parameters().rho0; }, fluid->law);
    all.push_back({name, fluid->law, rho0, energy});
  }
  materials::TaitWater::Parameters tait;
  tait.cavitation = Cavitation::none;
  all.push_back({"tait, tension", materials::TaitWater(tait), 1000, 0});
  tait.cavitation = Cavitation::cutoff;
  all.push_back({"tait, cut-off", materials::TaitWater(tait), 1000, 0});
  tait.cavitation = Cavitation::isentropic;
  tait.p_floor = 10;
  all.push_back({"tait, isentropic", materials::TaitWater(tait), 1000, 0});
  all.push_back({"aluminium", materials::MieGruneisenWater(aluminium()), 2710, 0});
  auto cut = aluminium();
  cut.cavitation = Cavitation::cutoff;
  all.push_back({"aluminium, cut-off", materials::MieGruneisenWater(cut), 2710, 0});
  materials::MieGruneisenWater::Parameters steinberg;
  steinberg.cavitation = Cavitation::none;
  all.push_back({"water, tension", materials::MieGruneisenWater(steinberg), 1000, 0});
  all.push_back({"ideal gas", materials::IdealGas({.rho0 = 1.0, .gamma = 1.4}), 1.0, 2.5});
  all.push_back({"stiffened gas", materials::StiffenedGas({.rho0 = 1000, .gamma = 4.4, .p_inf = 6e8}), 1000, 0.78e6});
  return all;
}

/// The state that an isentrope from (rho, e) has at `end` [kg/m^3], and the speed gained: Runge and Kutta's fourth
/// order, in ln rho.
struct Simple {
  double energy, speed;
};
Simple simple_wave(const FluidLaw& law, double rho, double energy, double end) {
  if (const auto* tait = std::get_if<materials::TaitWater>(&law)) {  // the sound speed jumps where cavitation begins
    const double above = tait->liquid_limit() * (1 + 1e-12), below = tait->liquid_limit() * (1 - 1e-12);
    if (rho > above && end < below) return {0, simple_wave(law, rho, 0, above).speed + simple_wave(law, below, 0, end).speed};
  }
  const int steps = 4000;
  const double h = std::log(end / rho) / steps;
  const bool heat = materials::uses_energy(law);
  Simple y{energy, 0};
  double s = 0;
  const auto slope = [&](double at, double e) {
    const double density = rho * std::exp(at);
    const auto local = true_pressure_sound(law, density, e);
    return Simple{heat ? local.pressure / density : 0.0, local.sound_speed};
  };
  for (int k = 0; k < steps; ++k, s += h) {
    const Simple a = slope(s, y.energy), b = slope(s + h / 2, y.energy + h / 2 * a.energy),
                 c = slope(s + h / 2, y.energy + h / 2 * b.energy), d = slope(s + h, y.energy + h * c.energy);
    y.energy += h / 6 * (a.energy + 2 * b.energy + 2 * c.energy + d.energy);
    y.speed += h / 6 * (a.speed + 2 * b.speed + 2 * c.speed + d.speed);
  }
  return y;
}

/// Checks one side; says what is wrong.
void expect_wave(const RiemannSolution& solution, const RiemannSide& side, int k, const std::string& what) {
  const auto start = true_pressure_sound(side.law, side.density, side.energy);
  const RiemannSample star = solution.star(k);
  const bool heat = materials::uses_energy(side.law);
  const double outward = k == 0 ? -1.0 : 1.0;
  const auto behind = true_pressure_sound(side.law, star.density, star.energy);
  const double stiffness =
      std::max({side.density * start.sound_speed * start.sound_speed, star.density * behind.sound_speed * behind.sound_speed,
                std::abs(start.pressure), std::abs(star.pressure)});
  EXPECT_NEAR(behind.pressure, star.pressure, 1e-8 * stiffness) << what << ": the law at the star's state, side " << k;
  if (solution.shock(k)) {
    const double s = solution.head(k), in = outward * (s - side.velocity), out = outward * (s - star.velocity);
    const double flux = side.density * in;
    EXPECT_GT(flux, 0.0) << what;
    // Pressures are known to round-off of the stiffness, and the flux is their rise over the velocity's.
    const double known = 1e-8 * flux + 1e-10 * stiffness / std::abs(star.velocity - side.velocity);
    EXPECT_NEAR(star.density * out, flux, known) << what << ": mass, side " << k;
    EXPECT_NEAR(star.pressure - start.pressure, flux * outward * (star.velocity - side.velocity), 1e-8 * stiffness)
        << what << ": momentum, side " << k;
    if (heat) {
      const double rise = 0.5 * (star.pressure + start.pressure) * (1 / side.density - 1 / star.density);
      EXPECT_NEAR(star.energy - side.energy, rise, 1e-8 * stiffness / side.density) << what << ": energy, side " << k;
    }
  } else if (std::log(side.density / star.density) < 3.0 && !(solution.cavity() && materials::is_gas(side.law))) {
    const Simple wave = simple_wave(side.law, side.density, side.energy, star.density);
    const double sound = std::max(start.sound_speed, 1e-12);
    EXPECT_NEAR(outward * (star.velocity - side.velocity), wave.speed, 2e-6 * sound) << what << ": fan, side " << k;
    if (heat) {
      EXPECT_NEAR(star.energy, wave.energy, 1e-6 * sound * sound) << what << ": fan, side " << k;
    }
  }
}

/// Many pairs of any of these laws.
void expect_solutions(const std::vector<Named>& all, int tries) {
  std::mt19937 random(7);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  int solved = 0, refused = 0;
  std::vector<int> solved_by_law(all.size());
  const auto attempt = [&](const RiemannSide& left, const RiemannSide& right, std::size_t a, std::size_t b) {
    const std::string what = all[a].name + " | " + all[b].name + ", rho " + std::to_string(left.density) + " " +
                             std::to_string(right.density) + ", u " + std::to_string(left.velocity) + " " +
                             std::to_string(right.velocity) + ", e " + std::to_string(left.energy) + " " +
                             std::to_string(right.energy);
    try {
      const RiemannSolution solution(left, right);
      expect_wave(solution, left, 0, what);
      expect_wave(solution, right, 1, what);
      for (const double xi : {-1e5, -3e3, -10.0, 0.0, 10.0, 3e3, 1e5}) {
        const RiemannSample sample = solution.sample(xi);
        EXPECT_TRUE(std::isfinite(sample.pressure) && std::isfinite(sample.velocity) && sample.density >= 0.0) << what;
      }
      ++solved;
      ++solved_by_law[a];
      ++solved_by_law[b];
    } catch (const std::domain_error& reason) {
      EXPECT_GT(std::string(reason.what()).size(), 20u) << what;
      ++refused;
    }
  };
  for (int k = 0; k < tries; ++k) {
    const std::size_t a = k % all.size(), b = k % 3 == 0 ? a : std::size_t(uniform(0, all.size() - 1e-9));
    RiemannSide side[2];
    const std::size_t which[2] = {a, b};
    const double wild = k % 4 == 0 ? 1.0 : 0.15;  // mostly states that a scene has
    for (int s = 0; s < 2; ++s) {
      const Named& law = all[which[s]];
      const bool energetic = law.energy > 0;
      side[s] = {law.law, law.density * (energetic ? std::exp(uniform(-2 * wild, wild)) : 1 + uniform(-0.3, 0.6) * wild), 0,
                 law.energy * std::exp(uniform(-2, 2) * wild)};
      side[s].velocity = uniform(-1, 1) * true_pressure_sound(law.law, side[s].density, side[s].energy).sound_speed * wild * 2;
    }
    attempt(side[0], side[1], a, b);
  }
  EXPECT_GT(solved, 2 * refused) << solved << " solved, " << refused << " refused";
  for (std::size_t a = 0; a < all.size(); ++a) EXPECT_GT(solved_by_law[a], 3) << all[a].name;
}

TEST(RiemannProperties, EverySolutionConservesOrIsRefusedWithAReason) { expect_solutions(laws(), 200); }

TEST(RiemannProperties, PolynomialWaterBesideOtherLaws) {
  materials::PolynomialWater::Parameters tension;
  tension.cavitation = Cavitation::none;
  std::vector<Named> all{{"polynomial", materials::PolynomialWater(materials::PolynomialWater::Parameters{}), 1000, 0},
                         {"polynomial, tension", materials::PolynomialWater(tension), 1000, 0}};
  for (const Named& one : laws())
    if (one.name == "petn" || one.name == "water-tait" || one.name == "ideal gas") all.push_back(one);
  expect_solutions(all, 60);
}

TEST(RiemannProperties, MoleculesOfAStiffenedGasTakeTheirVolume) {
  const materials::StiffenedGas water({.rho0 = 1000, .gamma = 1.19, .p_inf = 7.028e8, .b = 6.61e-4, .q = -1177788});
  const auto side = [&](double density, double pressure, double velocity) {
    RiemannSide of{water, density, velocity};
    of.energy = water.energy_at(pressure, density);
    return of;
  };
  for (const auto& [left, right] :
       {std::pair(side(1000, 1e5, 300), side(1000, 1e5, -300)), std::pair(side(1000, 1e9, 0), side(1000, 1e5, 0)),
        std::pair(side(1150, 8e9, 0), side(900, 1e5, 100)), std::pair(side(1000, 1e8, -20), side(1000, 1e8, 20))}) {
    const RiemannSolution solution(left, right);
    const std::string what = std::to_string(left.density) + " " + std::to_string(right.density);
    expect_wave(solution, left, 0, what);
    expect_wave(solution, right, 1, what);
  }
  // A liquid of free volume v - b is a stiffened gas of that volume: of a weak wave the impedance is rho c.
  const RiemannSolution weak(side(1000, 1e5, 1), side(1000, 1e5, -1));
  EXPECT_NEAR(weak.pressure() - 1e5, 1000 * 1570.8, 1000 * 4.0);
}

TEST(RiemannProperties, AMetalWithoutCutOffIsSolvedUnderImpactAndRefusedWhenTornApart) {
  const FluidLaw metal = materials::MieGruneisenWater(aluminium());
  // The shock of a symmetric impact: p = rho0 (C0 + S u) u.
  const RiemannSolution impact({metal, 2710, 6180}, {metal, 2710, 0});
  EXPECT_NEAR(impact.pressure(), 2710 * (5300 + 1.5 * 3090) * 3090.0, 1e-7 * impact.pressure());
  EXPECT_NEAR(impact.velocity(), 3090, 1e-6);
  const RiemannSolution pull({metal, 2710, -5}, {metal, 2710, 5});
  EXPECT_NEAR(pull.pressure(), -2710 * 5300 * 5.0, 2e-3 * 2710 * 5300 * 5.0);
  try {
    RiemannSolution({metal, 2710, -6000}, {metal, 2710, 6000});
    ADD_FAILURE() << "torn apart, and solved";
  } catch (const std::domain_error& reason) {
    EXPECT_NE(std::string(reason.what()).find("cutoff"), std::string::npos) << reason.what();
  }
}

TEST(RiemannProperties, WaterThatCarriesTensionIsPulledToItsImpedance) {
  materials::TaitWater::Parameters p;
  p.cavitation = Cavitation::none;
  const materials::TaitWater water(p);
  const double rho = water.density_at(1e5);
  const RiemannSolution pull({water, rho, -5}, {water, rho, 5});
  // Riemann's invariant: c rises by (N - 1)/2 times the speed.
  const double c0 = water.evaluate(rho, 0).sound_speed, c = c0 - 0.5 * (p.N - 1) * 5;
  const double expected = p.B * (std::pow(c * c * p.rho0 / (p.N * p.B), p.N / (p.N - 1)) - 1) + p.A;
  EXPECT_NEAR(pull.pressure(), expected, 1e-7 * std::abs(expected));
  EXPECT_LT(pull.pressure(), -7e6);
  EXPECT_THROW(RiemannSolution({water, rho, -3000}, {water, rho, 3000}), std::domain_error);
}

}  // namespace
}  // namespace undex::exact
