// Symmetry planes and rigid planes confine solids: a body that is driven against one is half of a symmetric impact, and a guided
// strip carries the shock that the conservation laws ask for, from the first row at the guide on.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "materials/library.hpp"
#include "sph_solid/solids.hpp"
#include "tests/unit/materials/solid_hugoniot.hpp"

namespace undex::solid {
namespace {

using materials::testing::hugoniot_pressure;

constexpr double dx = 0.00025, speed = 3090;

class Planes : public ::testing::TestWithParam<Description> {};
INSTANTIATE_TEST_SUITE_P(Descriptions, Planes, ::testing::Values(Description::total_lagrangian, Description::updated_lagrangian),
                         [](const auto& one) { return one.param == Description::total_lagrangian ? "Total" : "Updated"; });

struct Strip {
  Settings solids;
  sph::Settings around;

  explicit Strip(Description description, double length = 0.012, double half_width = 0.002, double gap = 0.0) {
    Body bar;
    bar.name = "bar";
    bar.shape = {Box{Vec3(gap, -half_width, -1), Vec3(gap + length, half_width, 1)}, {}};
    bar.material = *materials::find_solid("al-impact-table2");
    bar.description = description;
    bar.velocity = Vec3(-speed, 0, 0);
    solids.bodies = {bar};
    around.dimension = 2;
    around.lattice.spacing = dx;
    around.numerics.threads = 1;
  }
  std::unique_ptr<Solids> run(double time) const {
    auto solids_run = std::make_unique<Solids>(solids, around);
    solids_run->advance(time);
    return solids_run;
  }
};

TEST_P(Planes, GuidedStripCarriesTheShockOfTheConservationLaws) {
  Strip strip(GetParam());
  strip.around.symmetry.axis[1] = true;
  strip.solids.planes = {{0, 0.0, true}, {1, 0.002, false}};
  const auto run = strip.run(0.8e-6);
  const double exact = hugoniot_pressure(strip.solids.bodies[0].material, speed);
  const std::vector<double> pressure = run->field("pressure");
  double row[8] = {};
  int count[8] = {};
  for (std::size_t i = 0; i < run->particle_count(); ++i) {
    const Vec3& x = run->positions()[i];
    EXPECT_GT(x[0], 0.0);
    EXPECT_GT(x[1], 0.0);
    EXPECT_LT(x[1], 0.002);
    if (x[0] < 0.001 || x[0] > 0.003) continue;
    const int k = int(x[1] / dx);
    row[k] += pressure[i];
    ++count[k];
  }
  for (int k = 0; k < 8; ++k) {
    EXPECT_GT(count[k], 5) << k;
    EXPECT_NEAR(row[k] / count[k] / exact, 1.0, 0.025) << "row " << k << " from the mirror to the rigid plane";
    EXPECT_NEAR((row[k] / count[k]) / (row[3] / count[3]), 1.0, 1e-3) << k;
  }
  EXPECT_LT(run->maximum_pressure(), 1.4 * exact);
}

TEST_P(Planes, RigidPlaneIsTheMirrorOfASymmetricImpact) {
  const double time = 0.8e-6;
  Strip rigid(GetParam()), mirror(GetParam()), whole(GetParam());
  for (Strip* guided : {&rigid, &mirror, &whole}) {  // free sides would shed jets, in which round-off grows
    guided->around.symmetry.axis[1] = true;
    guided->solids.planes = {{1, 0.002, false}};
  }
  rigid.solids.planes.push_back({0, 0.0, true});
  mirror.around.symmetry.axis[0] = true;
  std::get<Box>(whole.solids.bodies[0].shape.base).low[0] = -0.012;
  const auto driven = [&](Strip& strip) {  // towards x = 0, by a kick
    strip.solids.bodies[0].velocity = Vec3::Zero();
    auto run = std::make_unique<Solids>(strip.solids, strip.around);
    std::vector<Vec3> impulse(run->particle_count(), Vec3::Zero());
    for (std::size_t i = 0; i < impulse.size(); ++i)
      impulse[i][0] = run->masses()[i] * (run->positions()[i][0] < 0 ? speed : -speed);
    run->kick(impulse);
    return run;
  };
  const auto at_rigid = driven(rigid), at_mirror = driven(mirror), both = driven(whole);
  const std::vector<Vec3> start(both->positions().begin(), both->positions().end());
  for (const auto& run : {at_rigid.get(), at_mirror.get(), both.get()}) run->advance(time);
  ASSERT_EQ(at_rigid->particle_count(), at_mirror->particle_count());
  const Solids fresh(mirror.solids, mirror.around);
  int found = 0;
  for (std::size_t i = 0; i < fresh.particle_count(); ++i) {
    EXPECT_LT((at_rigid->positions()[i] - at_mirror->positions()[i]).norm(), 1e-6 * dx) << i;
    EXPECT_LT((at_rigid->velocities()[i] - at_mirror->velocities()[i]).norm(), 1e-6 * speed) << i;
    for (std::size_t j = 0; j < start.size(); ++j)
      if ((start[j] - fresh.positions()[i]).norm() < 1e-6 * dx) {
        ++found;
        EXPECT_LT((both->positions()[j] - at_mirror->positions()[i]).norm(), 1e-3 * dx) << i;  // round-off, as shocks amplify it
      }
  }
  EXPECT_EQ(found, int(fresh.particle_count()));
  // A mirror does no work, and gives the momentum that the other half would.
  const BodyLedger ledger = at_rigid->ledger();
  EXPECT_EQ(ledger.external, 0.0);
  EXPECT_NEAR((ledger.momentum[0] - ledger.impulse[0]) / (-ledger.mass * speed), 1.0, 1e-12);
}

TEST_P(Planes, ContactBeginsAtTheFaceAndEndsWithoutAPull) {
  // A gap is crossed freely, and what has bounced is free again: it keeps its momentum.
  Strip strip(GetParam(), 0.004, 0.001, 0.001);
  strip.solids.bodies[0].velocity = Vec3(-20, 0, 0);
  strip.solids.planes = {{0, 0.0, true}};
  Solids solids(strip.solids, strip.around);
  solids.advance(49e-6);
  for (const Vec3& v : solids.velocities()) EXPECT_NEAR(v[0], -20, 1e-9);
  solids.advance(54e-6);
  const double leaving = solids.ledger().momentum[0];
  EXPECT_GT(leaving, 0.75 * 20 * solids.ledger().mass);
  solids.advance(60e-6);
  EXPECT_NEAR(solids.ledger().momentum[0] / leaving, 1.0, 1e-12);
  EXPECT_NEAR(solids.ledger().balance() / (0.5 * solids.ledger().mass * 400), 1.0, 3e-3);
}

TEST_P(Planes, NothingPassesAMirrorInAStrongShock) {
  // The strip meets the mirror as fast as it can without being crushed.
  for (const double fast : {500.0, 6000.0}) {
    Strip strip(GetParam(), 0.006);
    strip.solids.bodies[0].velocity[0] = -fast;
    strip.around.symmetry.axis = {true, true, false};
    strip.solids.planes = {{1, 0.002, false}};
    const auto run = strip.run(0.25e-6);
    for (const Vec3& x : run->positions()) {
      EXPECT_GT(x[0], 0.0) << fast;
      EXPECT_GT(x[1], 0.0) << fast;
      EXPECT_LT(x[1], 0.002) << fast;
    }
  }
}

TEST_P(Planes, NoStepCarriesAParticleThroughAPlane) {
  // A blow that the step did not foresee: twice the wave speed, straight at the planes.
  Strip strip(GetParam(), 0.004);
  strip.solids.bodies[0].velocity = Vec3::Zero();
  strip.around.symmetry.axis[1] = true;
  strip.solids.planes = {{1, 0.002, false}};
  const auto run = std::make_unique<Solids>(strip.solids, strip.around);
  std::vector<Vec3> impulse(run->particle_count(), Vec3::Zero());
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    const Vec3& x = run->positions()[i];
    if (std::abs(x[0] - 0.002) > 0.6 * dx || std::abs(x[1] - 0.001) < 0.001 - 0.6 * dx) continue;
    impulse[i][1] = run->masses()[i] * (x[1] < 0.001 ? -12e3 : 12e3);
  }
  run->kick(impulse);
  run->advance(run->stable_step());
  for (const Vec3& x : run->positions()) {
    EXPECT_GT(x[1], 0.0);
    EXPECT_LT(x[1], 0.002);
  }
}

}  // namespace
}  // namespace undex::solid
