// Several bodies as one: each does what it would do by itself, the sums are theirs, and where two meet the run ends.
#include "coupling/body_group.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "core/errors.hpp"
#include "fem_structure/structure.hpp"

namespace undex::coupling::testing {
namespace {

materials::Solid elastic(double rho, double shear) {
  materials::Solid solid;
  solid.name = "elastic";
  solid.rho0 = rho;
  solid.shear_modulus = shear;
  solid.pressure = materials::LinearPressure{2 * shear};
  solid.flow = materials::Elastic{};
  return solid;
}

fem::Settings block(const Vec3& low, const Vec3& high, const std::array<int, 3>& cells, const Vec3& velocity = Vec3::Zero()) {
  fem::Settings settings;
  settings.mesh = fem::PlateMesh{low, high, cells};
  settings.material = elastic(2700, 27e9);
  settings.wet_faces = {"z_low"};
  settings.initial_velocity = velocity;
  return settings;
}

fem::Settings coarse_block() {
  fem::Settings settings = block(Vec3(0, 0, 0), Vec3(0.03, 0.02, 0.01), {3, 2, 1}, Vec3(10, 0, 0));
  settings.name = "coarse";
  return settings;
}
fem::Settings fine_block() {
  fem::Settings settings = block(Vec3(0.1, 0, 0), Vec3(0.13, 0.02, 0.02), {6, 4, 5});
  settings.name = "fine";
  settings.material = elastic(7800, 80e9);
  settings.wet_faces = {"x_high", "z_low"};
  return settings;
}

struct Two {
  fem::Structure one, other;
  BodyGroup group;
  Two(const fem::Settings& a, const fem::Settings& b) : one(a), other(b), group({{a.name, &one}, {b.name, &other}}) {}
};

TEST(ABodyGroup, ShowsTheFacesOfAllBesideEachOther) {
  const Two two(coarse_block(), fine_block());
  const WetSurface &all = two.group.wet_surface(), &first = two.one.wet_surface(), &second = two.other.wet_surface();
  ASSERT_EQ(all.nodes.size(), first.nodes.size() + second.nodes.size());
  ASSERT_EQ(all.faces.size(), first.faces.size() + second.faces.size());
  EXPECT_EQ(two.group.wet_walls(), (std::vector<std::size_t>{0, first.nodes.size(), all.nodes.size()}));
  for (std::size_t f = 0; f < all.faces.size(); ++f)
    for (int v = 0; v < 4; ++v) {
      const bool of_first = f < first.faces.size();
      const Vec3 x = of_first ? first.nodes[first.faces[f][v]] : second.nodes[second.faces[f - first.faces.size()][v]];
      EXPECT_EQ(all.nodes[all.faces[f][v]], x);
    }
  EXPECT_EQ(two.group.wet_velocities()[0], Vec3(10, 0, 0));
  EXPECT_EQ(two.group.wet_velocities().back(), Vec3(0, 0, 0));
  EXPECT_EQ(two.group.wet_masses().size(), all.nodes.size());
  EXPECT_EQ(two.group.stable_step(), std::min(two.one.stable_step(), two.other.stable_step()));
  EXPECT_NE(two.group.stable_step_owner().find("'fine'"), std::string::npos);
}

/// Windows of some steps of the coarse block: the fine one takes more.
TEST(ABodyGroup, MovesEachAsByItself) {
  Two two(coarse_block(), fine_block());
  fem::Structure one(coarse_block()), other(fine_block());
  const std::size_t first = one.wet_surface().nodes.size(), all = two.group.wet_surface().nodes.size();
  std::vector<Vec3> impulse(all), first_impulse, second_impulse;
  for (std::size_t n = 0; n < all; ++n) impulse[n] = Vec3(1e-6 * double(n), 0, 2e-5);
  first_impulse.assign(impulse.begin(), impulse.begin() + long(first));
  second_impulse.assign(impulse.begin() + long(first), impulse.end());
  Vec3 given = Vec3::Zero();
  for (int window = 1; window <= 20; ++window) {
    const double end = window * 1.7 * one.stable_step();
    two.group.advance(end, impulse);
    one.advance(end, first_impulse);
    other.advance(end, second_impulse);
    for (const Vec3& each : second_impulse) given += each;
  }
  EXPECT_GT(other.steps(), one.steps());
  EXPECT_EQ(two.group.steps(), other.steps());
  for (const auto& [ours, theirs] : {std::pair{&two.one, &one}, std::pair{&two.other, &other}}) {
    EXPECT_EQ(ours->steps(), theirs->steps());
    for (std::size_t i = 0; i < theirs->positions().size(); ++i) ASSERT_EQ(ours->positions()[i], theirs->positions()[i]);
  }
  for (std::size_t n = 0; n < all; ++n)
    EXPECT_EQ(two.group.wet_positions()[n], n < first ? one.wet_positions()[n] : other.wet_positions()[n - first]);
  const BodyLedger sum = two.group.ledger(), a = one.ledger(), b = other.ledger();
  EXPECT_DOUBLE_EQ(sum.kinetic, a.kinetic + b.kinetic);
  EXPECT_DOUBLE_EQ(sum.received, a.received + b.received);
  EXPECT_DOUBLE_EQ(sum.balance(), a.balance() + b.balance());
  EXPECT_EQ(sum.momentum, Vec3(a.momentum + b.momentum));
  EXPECT_EQ(two.group.received_by(1), given);
}

/// Where one flies at the other over a gap of `gap`, moved aside by `aside`.
double time_of_meeting(double gap, double aside, double end) {
  fem::Settings flying = block(Vec3(0, aside, 0), Vec3(0.01, aside + 0.02, 0.02), {2, 3, 3}, Vec3(200, 0, 0));
  fem::Settings resting = block(Vec3(0.01 + gap, 0, 0), Vec3(0.02 + gap, 0.02, 0.02), {1, 2, 2});
  flying.name = "flying";
  resting.name = "resting";
  Two two(flying, resting);
  try {
    while (two.group.time() < end) two.group.advance(two.group.time() + two.group.stable_step());
  } catch (const NumericalStop& stop) {
    EXPECT_NE(std::string(stop.what()).find("structures 'flying' and 'resting' have met at ("), std::string::npos) << stop.what();
    return two.group.time();
  }
  return -1;
}

TEST(ABodyGroup, EndsWhereTwoMeet) {
  const double within = 0.05 * 0.005;  // a twentieth of the thinnest cell [m]
  for (const double gap : {0.002, 0.0001}) {
    const double meeting = time_of_meeting(gap, 0, 1e-4);
    EXPECT_GT(meeting, (gap + within) / 200);
    EXPECT_LT(meeting, (gap + 2 * within) / 200 + 2e-6);
  }
}

TEST(ABodyGroup, LetsThemPass) {
  EXPECT_EQ(time_of_meeting(0.002, 0.0201, 2e-4), -1);   // 0.1 mm beside each other
  EXPECT_GT(time_of_meeting(0.002, 0.0195, 2e-4), 0);    // a corner
  EXPECT_EQ(time_of_meeting(0.002, 0, 0.9 * 1e-5), -1);  // not yet there
}

/// Blocks that touch all along may lie on each other as they do.
TEST(ABodyGroup, LetsThemTouch) {
  fem::Settings lower = block(Vec3(0, 0, 0), Vec3(0.02, 0.02, 0.01), {2, 2, 2}, Vec3(0, 0, 3));
  fem::Settings upper = block(Vec3(0, 0, 0.01), Vec3(0.02, 0.02, 0.02), {2, 2, 2}, Vec3(0, 0, 3));
  lower.name = "lower";
  upper.name = "upper";
  Two two(lower, upper);
  while (two.group.time() < 1e-5) two.group.advance(two.group.time() + two.group.stable_step());
  EXPECT_NEAR((two.other.positions()[0][2] - 0.01) / (3 * two.group.time()), 1.0, 1e-9);
}

}  // namespace
}  // namespace undex::coupling::testing
