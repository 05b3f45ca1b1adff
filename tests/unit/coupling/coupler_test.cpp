// Water and a real structure together: impulse, momentum and energy across the interface, and who waits for whom.
#include "coupling/coupler.hpp"
#include "fem_structure/structure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace undex::coupling::testing {
namespace {

materials::Solid elastic(double density, double young) {
  const double poisson = 0.3;
  materials::Solid solid;
  solid.name = "elastic";
  solid.rho0 = density;
  solid.shear_modulus = young / (2 * (1 + poisson));
  solid.pressure = materials::LinearPressure{young / (3 * (1 - 2 * poisson))};
  solid.flow = materials::Elastic{};
  return solid;
}

struct Choice {
  double density = 2700, young = 70e9;  ///< of the plate
  std::array<int, 3> cells{3, 2, 2};
  double water_speed = 50;  ///< towards the plate [m/s]
  double structure_courant = 0.8, fluid_courant = 0.3;
  double window = 1.0;
  bool open = false;  ///< nothing beside the water: a free drop meets a free plate
};

/// A column of water in a channel hits a plate that closes it at z = 0; everything else is free.
struct Column {
  sph::Fluid fluid;
  fem::Structure structure;
  Flow flow{fluid};
  Coupler coupler;

  static sph::Settings water(const Choice& s) {
    sph::Settings settings;
    settings.lattice.spacing = 0.005;
    const Vec3 low(0, 0, -0.06), high(0.03, 0.02, 0);
    sph::Body& body = settings.bodies.emplace_back();
    body.name = "water";
    body.shape.base = Box{low, high};
    body.material = materials::find_fluid("water-tait").value();
    body.velocity = Vec3(0, 0, s.water_speed);
    if (!s.open) {
      sph::Wall channel;
      channel.name = "channel";
      channel.container = Box{low, high};
      channel.faces = {{"z_low", sph::FaceCondition::open}, {"z_high", sph::FaceCondition::open}};
      settings.walls = {channel};
    }
    settings.numerics.courant = s.fluid_courant;
    settings.numerics.scheme = sph::SchemeName::monaghan;
    settings.numerics.threads = 1;
    return settings;
  }

  static fem::Settings plate(const Choice& s) {
    fem::Settings settings;
    settings.mesh = fem::PlateMesh{Vec3(0, 0, 0), Vec3(0.03, 0.02, 0.01), s.cells};
    settings.material = elastic(s.density, s.young);
    settings.wet_faces = {"z_low"};
    settings.courant = s.structure_courant;
    return settings;
  }

  static Settings coupling(const Choice& s) {
    Settings settings;
    settings.window = s.window;
    return settings;
  }

  explicit Column(const Choice& s) : fluid(water(s)), structure(plate(s)), coupler(flow, structure, coupling(s)) {}

  Coupler::Window run(double end) {
    Coupler::Window last;
    while (fluid.time() < end * (1 - 1e-9)) last = coupler.advance(end);
    return last;
  }
};

double energy_of(const sph::Ledger& l) { return l.kinetic + l.internal + l.dissipated; }

TEST(Coupler, ImpulseGivenIsImpulseReceived) {
  Column column({});
  const Vec3 fluid_before = column.fluid.ledger().momentum;
  column.run(30e-6);
  const InterfaceLedger ledger = column.coupler.ledger();
  ASSERT_GT(ledger.impulse_given[2], 0.0);
  EXPECT_LT((ledger.impulse_given - ledger.impulse_received).norm(), 1e-12 * ledger.impulse_given.norm());
  // The plate is free: it has just that momentum; along z the channel takes none, so the water has lost it.
  EXPECT_LT((column.structure.ledger().momentum - ledger.impulse_received).norm(), 1e-10 * ledger.impulse_given.norm());
  const Vec3 lost = fluid_before - column.fluid.ledger().momentum;
  EXPECT_NEAR(lost[2], ledger.impulse_given[2], 1e-10 * ledger.impulse_given[2]);
}

/// The channel ends in the plate: a closed end there would bear a part of what the plate is given.
TEST(Coupler, RefusesAClosedEndInTheWetFace) {
  sph::Settings closed = Column::water({});
  closed.walls[0].faces["z_high"] = sph::FaceCondition::free_slip;
  sph::Fluid fluid(closed);
  Flow flow(fluid);
  fem::Structure plate(Column::plate({}));
  EXPECT_THROW(Coupler(flow, plate, {}), std::invalid_argument);
}

/// Nothing but water and plate: the momentum of the two together does not change, in any direction.
TEST(Coupler, MomentumOfTheClosedSystem) {
  Choice choice;
  choice.open = true;
  Column column(choice);
  const Vec3 before = column.fluid.ledger().momentum + column.structure.ledger().momentum;
  column.run(30e-6);
  const Vec3 after = column.fluid.ledger().momentum + column.structure.ledger().momentum;
  EXPECT_LT((after - before).norm(), 1e-10 * before.norm());
  EXPECT_GT(column.structure.ledger().momentum[2], 0.02 * before[2]) << "hardly met";
}

/// Work given and work received differ by the splitting error alone; it falls with the step, and so does that of all energy.
TEST(Coupler, InterfaceEnergyErrorFallsWithTheStep) {
  double error[3], whole[3];
  for (const int k : {0, 1, 2}) {
    Choice choice;
    choice.fluid_courant = 0.3 / (1 << k);
    choice.structure_courant = 0.8 / (1 << k);
    Column column(choice);
    const double before = energy_of(column.fluid.ledger());
    column.run(30e-6);
    const InterfaceLedger ledger = column.coupler.ledger();
    ASSERT_GT(ledger.work_received, 0.0);
    error[k] = std::abs(ledger.work_given - ledger.work_received) / ledger.work_received;
    const BodyLedger plate = column.structure.ledger();
    const double after = energy_of(column.fluid.ledger()) + plate.kinetic + plate.elastic + plate.plastic + plate.viscous;
    whole[k] = std::abs(after - before) / ledger.work_received;
    std::printf("  step / %d: interface energy error %.3g, of all energy %.3g, of the work %.4g J\n", 1 << k, error[k], whole[k],
                ledger.work_received);
    RecordProperty("interface_energy_error_" + std::to_string(1 << k), std::to_string(error[k]));
  }
  EXPECT_LT(error[0], 0.015);  // of second order in the step
  EXPECT_LT(error[2], 0.12 * error[0]);
  EXPECT_LT(whole[0], 0.05);
}

/// A plate a thousand times heavier hardly moves: the water meets it as it meets the same faces held fast, and is stopped by
/// the water hammer.
TEST(Coupler, HeavyPlateIsARigidWall) {
  Choice choice;
  choice.density = 2.7e6;
  choice.young = 7e13;
  choice.cells = {1, 1, 1};
  Column heavy(choice);
  heavy.run(25e-6);
  EXPECT_LT(heavy.structure.wet_velocities()[0].norm(), 0.1);

  sph::Fluid rigid(Column::water(choice));
  const auto wall = rigid.add_wall(heavy.coupler.wall().mesh());
  while (rigid.time() < 25e-6) rigid.step(std::min(rigid.step_limit().step, 25e-6 - rigid.time() + 1e-18));
  Vec3 impulse = Vec3::Zero();
  for (const Vec3& one : rigid.wall(wall).impulse) impulse += one;
  const double given = heavy.coupler.ledger().impulse_given[2], hammer = 1000 * 1538.4 * choice.water_speed;
  std::printf("  heavy plate: impulse %.6g N s, rigid wall: %.6g N s; hammer over area and time: %.6g N s\n", given, impulse[2],
              hammer * 0.03 * 0.02 * 25e-6);
  EXPECT_NEAR(given, impulse[2], 0.003 * given);
  EXPECT_NEAR(given, hammer * 0.03 * 0.02 * 25e-6, 0.15 * given);
  for (const double depth : {0.004, 0.012, 0.02}) {
    const Vec3 at(0.015, 0.01, -depth);
    EXPECT_NEAR(heavy.fluid.at(at).pressure, rigid.at(at).pressure, 0.01 * hammer) << depth;
  }
}

/// One water step over several of the structure's, and the other way round: impulse and momentum are exact both ways, and
/// both get the same plate.
TEST(Coupler, SubCyclingBothWays) {
  Choice soft;  // the structure may take longer steps than the water
  soft.young = 1e9;
  soft.cells = {1, 1, 1};
  soft.fluid_courant = 0.1;
  Choice stiff;  // fine cells: shorter ones
  stiff.cells = {3, 2, 16};
  stiff.fluid_courant = 0.6;
  for (const bool fine : {false, true}) {
    SCOPED_TRACE(fine ? "structure steps within a water step" : "water steps within a structure step");
    Column column(fine ? stiff : soft);
    const Vec3 before = column.fluid.ledger().momentum;
    long windows = 0;
    while (column.fluid.time() < 25e-6 * (1 - 1e-9)) {
      const Coupler::Window window = column.coupler.advance(25e-6);
      ++windows;
      EXPECT_GE(window.fluid_steps, 1);
      EXPECT_GE(window.structure_steps, 1);
      EXPECT_GT(window.step, 0.0);
      EXPECT_LE(window.step, window.limit.step * (1 + 1e-12));
      EXPECT_NEAR(column.structure.time(), column.fluid.time(), 1e-15);
    }
    if (fine) {
      EXPECT_GT(column.structure.steps(), column.fluid.steps() * 3 / 2);
      EXPECT_EQ(column.fluid.steps(), windows);
    } else {
      EXPECT_GT(column.fluid.steps(), windows * 3 / 2);
      EXPECT_EQ(column.structure.steps(), windows);
    }
    EXPECT_NEAR(column.fluid.time(), 25e-6, 1e-12);
    const InterfaceLedger ledger = column.coupler.ledger();
    EXPECT_LT((ledger.impulse_given - ledger.impulse_received).norm(), 1e-12 * ledger.impulse_given.norm());
    EXPECT_NEAR((before - column.fluid.ledger().momentum)[2], column.structure.ledger().momentum[2], 1e-10 * before[2]);
    // An inelastic meeting leaves a velocity between the two: far from rest, below the water's.
    EXPECT_GT(column.structure.ledger().momentum[2] / column.structure.ledger().mass, 5.0);
    EXPECT_LT(column.structure.ledger().momentum[2] / column.structure.ledger().mass, 100.0);
  }
}

/// Advancing to an end that cuts a window short must not lose or repeat anything.
TEST(Coupler, EndsExactlyWhereAsked) {
  Column one({}), two({});
  one.run(20e-6);
  for (const double end : {3.3e-6, 3.3e-6 + 1e-9, 11e-6, 20e-6}) two.run(end);
  EXPECT_NEAR(one.fluid.time(), 20e-6, 1e-18);
  EXPECT_NEAR(two.fluid.time(), 20e-6, 1e-18);
  EXPECT_NEAR(two.structure.time(), 20e-6, 1e-15);
  const double a = one.coupler.ledger().impulse_given[2], b = two.coupler.ledger().impulse_given[2];
  EXPECT_NEAR(a, b, 0.02 * a);
}

}  // namespace
}  // namespace undex::coupling::testing
