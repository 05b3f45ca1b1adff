// Contact with rigid planes: a bar that bounces, momentum and energy booked, no pull.
#include <gtest/gtest.h>

#include "bodies.hpp"

namespace undex::fem::testing {
namespace {

constexpr double length = 1.0, speed = 1.0;

/// A bar of n cells without lateral contraction that flies towards z = 0 from a distance of `gap`.
Settings flying_bar(int n, double gap) {
  Settings settings = plate(Vec3(0, 0, gap), Vec3(0.02, 0.02, gap + length), {1, 1, n}, elastic(2700.0, 71e9, 0.0));
  settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
  settings.initial_velocity = Vec3(0, 0, -speed);
  settings.planes = {{2, 0.0, true}};
  return settings;
}

struct Bounce {
  double contact, rebound, impact, balance;
};

Bounce bounce(int n) {
  const double c = std::sqrt(71e9 / 2700.0), gap = 1e-5;
  Structure bar(flying_bar(n, gap));
  const double start = bar.ledger().balance(), mass = bar.ledger().mass;
  double last_push = 0.0, before = 0.0;
  while (bar.time() < gap / speed + 3.0 * length / c) {
    bar.advance(bar.time() + bar.stable_step(), {});
    if (bar.plane_impulse()[2] > before) last_push = bar.time();
    before = bar.plane_impulse()[2];
    EXPECT_NEAR(bar.ledger().momentum[2], -mass * speed + before, 1e-12 * mass * speed);
  }
  const BodyLedger energies = bar.ledger();
  return {(last_push - gap / speed) / (2.0 * length / c), bar.ledger().momentum[2] / mass / speed, energies.impact / start,
          energies.balance() / start - 1.0};
}

TEST(Contact, ElasticBarBouncesOffAfterTwoPassagesOfTheWave) {
  const Bounce coarse = bounce(50), fine = bounce(200);
  for (const auto& [name, b] : {std::pair{"coarse", coarse}, {"fine", fine}}) {
    RecordProperty(std::string(name) + "_contact_time", std::to_string(b.contact));
    RecordProperty(std::string(name) + "_rebound", std::to_string(b.rebound));
    RecordProperty(std::string(name) + "_impact", std::to_string(b.impact));
    RecordProperty(std::string(name) + "_balance", std::to_string(1e6 * b.balance) + "e-6");
    EXPECT_NEAR(b.balance, 0.0, 1e-5);
  }
  EXPECT_NEAR(fine.contact, 1.0, 0.01);
  EXPECT_NEAR(fine.rebound, 1.0, 0.01);
  // Half a cell's kinetic energy, and a little more where the end's node leaves and meets the plane again.
  EXPECT_GT(fine.impact, 0.5 / 200);
  EXPECT_LT(fine.impact, 1.3 * 0.5 / 200);
  EXPECT_LT(std::abs(fine.rebound - 1.0), 0.6 * std::abs(coarse.rebound - 1.0));
}

TEST(Contact, NothingPullsWhatLeaves) {
  Settings settings = flying_bar(20, 0.0);
  settings.initial_velocity = Vec3(1, 2, speed);
  Structure bar(settings);
  bar.advance(1e-3, {});
  EXPECT_EQ(bar.plane_impulse(), Vec3(0, 0, 0));
  EXPECT_EQ(bar.ledger().impact, 0.0);
  EXPECT_NEAR(bar.ledger().momentum[2], bar.ledger().mass * speed, 1e-12 * bar.ledger().mass * speed);
}

TEST(Contact, RestsUnderALoadWithoutWork) {
  // Pressed onto a plane from its low side: the reaction is the load, and no work is done at the plane.
  Settings settings = plate(Vec3(0, 0, 0), Vec3(0.3, 0.02, 0.02), {30, 1, 1}, elastic(2700.0, 71e9, 0.0));
  settings.planes = {{0, 0.3, false}};
  settings.loads = {{"x_low", {0.0, 1e-3}, {0.0, 1e7}}};
  Structure bar(settings);
  bar.advance(2e-3, {});
  const double force = 1e7 * 4e-4, given = 0.5 * force * 1e-3 + force * 1e-3;
  EXPECT_NEAR(bar.plane_impulse()[0], -given, 0.01 * given);
  EXPECT_LT(bar.ledger().impact, 1e-4 * bar.ledger().external);
  EXPECT_NEAR(bar.ledger().balance(), 0.0, 1e-4 * bar.ledger().external);
}

TEST(Contact, BodyBeyondThePlaneIsRefused) {
  Settings settings = flying_bar(4, -0.1);
  EXPECT_THROW(Structure{settings}, std::invalid_argument);
}

/// The largest change of kinetic, stored and spent energy [-] over 60 steps of `settings`, over `scale` [J] or what loads have
/// done.
double worst_energy(const Settings& settings, double scale = 0) {
  Structure body(settings);
  const auto all = [&] {
    const BodyLedger l = body.ledger();
    return l.kinetic + l.elastic + l.plastic + l.viscous + l.impact - l.external;
  };
  const double start = all();
  double worst = 0.0, work = 0.0;
  for (int step = 0; step < 60; ++step) {
    body.advance(body.time() + body.stable_step(), {});
    work = std::max(work, std::abs(body.ledger().external));
    worst = std::max(worst, std::abs(all() - start));
  }
  return worst / std::max(scale, work);
}

/// A bar of aluminium of n cells of 0.25 mm, in uniaxial strain.
Settings struck_bar(int n) {
  materials::Solid aluminium = elastic(2700.0, 71e9, 0.33);
  aluminium.pressure = materials::MieGruneisenPressure{.C = 5350, .S = 1.34, .Gamma = 2.0};
  Settings bar = plate(Vec3(0, 0, 0), Vec3(2.5e-4, 2.5e-4, n * 2.5e-4), {1, 1, n}, aluminium);
  bar.supports = {{"x_low", {true, false, false}},
                  {"x_high", {true, false, false}},
                  {"y_low", {false, true, false}},
                  {"y_high", {false, true, false}}};
  return bar;
}

/// Bulk viscosity shortens the stable step in the step in which an impact begins.
TEST(Contact, FirstStepKnowsTheSpeedOfAnImpact) {
  for (const double impact : {500.0, 3000.0, 7000.0}) {
    for (const int n : {60, 240}) {
      Settings bar = struck_bar(n);
      bar.initial_velocity = Vec3(0, 0, -impact);
      const double scale = 0.5 * 2700.0 * std::pow(2.5e-4, 3) * n * impact * impact;
      bar.planes = {{2, 0.0, true}};
      EXPECT_LT(worst_energy(bar, scale), 0.005) << n << " cells at " << impact << " m/s";
      // The same where a held face stops it: the velocity jumps at the start.
      bar.planes.clear();
      bar.supports.push_back({"z_low", {false, false, true}});
      EXPECT_LT(worst_energy(bar, scale), 0.005) << n << " held cells at " << impact << " m/s";
    }
  }
}

TEST(Contact, AStepKnowsALoadThatJumps) {
  for (const double pressure : {1e9, 5e10}) {
    Settings bar = struck_bar(60);
    bar.loads = {{"z_high", {0.0, 2e-7, 2.0001e-7}, {0.0, 0.0, pressure}}};
    EXPECT_LT(worst_energy(bar), 0.01) << pressure;
  }
}

}  // namespace
}  // namespace undex::fem::testing
