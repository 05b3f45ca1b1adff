// A start from a computation before: particles keep the momentum of the means that they are given, and the kinetic energy that
// means lose is heat.
#include <numbers>

#include "scenes.hpp"

namespace undex::sph::testing {
namespace {

constexpr double amplitude = 50.0;  // [m/s]

/// A column of a metre at one density, with a sine of velocity of which each particle gets the mean over its cell.
Settings sine(const std::string& material, double density, double energy, int particles) {
  Settings s;
  s.dimension = 1;
  s.lattice.spacing = 1.0 / particles;
  s.numerics.threads = 1;
  Body column = body("column", box(Vec3(0, -1, -1), Vec3(1, 1, 1)), material);
  column.density = density;
  StartField field;
  field.state = [=](const Vec3& x, double spacing) {
    const double k = std::numbers::pi, from = x[0] - 0.5 * spacing, to = x[0] + 0.5 * spacing;
    return StartState{density, energy, Vec3(amplitude * (std::cos(k * from) - std::cos(k * to)) / (k * spacing), 0, 0)};
  };
  field.mass = density;
  field.kinetic_energy = 0.25 * density * amplitude * amplitude;
  field.internal_energy = density * energy;
  column.start = std::make_shared<StartField>(field);
  s.bodies = {column};
  s.walls = {box_wall(Vec3(0, -9, -9), Vec3(1, 9, 9))};
  return s;
}

double momentum(const Settings& s) { return Fluid(s).ledger().momentum[0]; }

TEST(StartField, KeepsTheMomentumOfItsMeans) {
  for (const int particles : {4, 16})
    EXPECT_NEAR(momentum(sine("water-tait", 1010.0, 0.0, particles)), 1010.0 * amplitude * 2 / std::numbers::pi, 1e-8);
}

TEST(StartField, KineticEnergyThatMeansLoseIsDissipatedWhereTheLawHasNone) {
  const Ledger ledger = Fluid(sine("water-tait", 1010.0, 0.0, 4)).ledger();
  const double whole = 0.25 * 1010.0 * amplitude * amplitude;
  EXPECT_LT(ledger.kinetic, 0.97 * whole);
  EXPECT_NEAR(ledger.kinetic + ledger.dissipated, whole, 1e-9 * whole);
}

TEST(StartField, AndInternalWhereItHasOne) {
  const double energy = 1e6;
  const Ledger ledger = Fluid(sine("petn", 1000.0, energy, 4)).ledger();
  const double whole = 0.25 * 1000.0 * amplitude * amplitude;
  EXPECT_LT(ledger.kinetic, 0.97 * whole);
  EXPECT_NEAR(ledger.kinetic + ledger.internal, whole + 1000.0 * energy, 1e-12 * 1000.0 * energy);
  EXPECT_EQ(ledger.dissipated, 0.0);
}

/// An exact start gives what averaging has lost back to what moves: momentum as speed, energy as heat where there was motion.
TEST(StartField, AnExactStartHasMomentumAndEnergy) {
  const double density = 1000.0, energy = 1e6, wanted = 1.01 * density * amplitude * 2 / std::numbers::pi;
  for (const char* material : {"petn", "water-tait"}) {
    Settings s = sine(material, density, energy, 8);
    StartField field = *s.bodies[0].start;
    const auto sines = field.state;
    field.state = [=](const Vec3& x, double spacing) {  // the upper half rests
      StartState state = sines(x, spacing);
      if (x[0] > 0.5) state.velocity.setZero();
      return state;
    };
    field.exact = true;
    field.momentum = Vec3(wanted, 0, 0);
    field.internal_energy = density * energy;
    s.bodies[0].start = std::make_shared<StartField>(field);
    const Fluid fluid(s);
    const Ledger ledger = fluid.ledger();
    const double whole = field.kinetic_energy + field.internal_energy;
    EXPECT_NEAR(ledger.momentum[0] / wanted, 1.0, 1e-13);
    EXPECT_NEAR((ledger.kinetic + ledger.internal + ledger.dissipated) / whole, 1.0, 1e-13);
    EXPECT_NEAR(ledger.mass / field.mass, 1.0, 1e-13);
    const auto x = fluid.field("position"), v = fluid.field("velocity"), e = fluid.field("energy");
    for (std::size_t i = 0; i < e.size(); ++i) {
      if (x[3 * i] < 0.5) continue;
      EXPECT_EQ(v[3 * i], 0.0);
      if (std::string(material) == "petn") {
        EXPECT_EQ(e[i], energy);
      }
    }
  }
}

/// Whose a place is may be said in place of a shape: what is covered has the lattice's own cells.
TEST(StartField, CoversInPlaceOfTheShape) {
  Settings s = sine("water-tait", 1000.0, 0.0, 16);
  StartField field;
  field.state = [](const Vec3&, double) { return StartState{1000.0, 0.0, Vec3::Zero()}; };
  field.covers = [](const Vec3& x) { return x[0] > 0.25 && x[0] < 1.0; };
  field.box = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  s.bodies[0].start = std::make_shared<StartField>(field);
  const Ledger ledger = Fluid(s).ledger();
  EXPECT_NEAR(ledger.mass, 750.0, 1e-10);
}

}  // namespace
}  // namespace undex::sph::testing
