// The face that all deforming bodies share, shown by finite elements and by particles: what must hold for either.
#include "core/deformable_body.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "fem_structure/structure.hpp"
#include "sph_solid/solids.hpp"

namespace undex::coupling::testing {
namespace {

const Vec3 low(0, 0, 0), high(0.03, 0.02, 0.025), speed(20, -10, 5);

materials::Solid elastic() {
  materials::Solid solid;
  solid.name = "elastic";
  solid.rho0 = 2700;
  solid.shear_modulus = 27e9;
  solid.pressure = materials::LinearPressure{58e9};
  solid.flow = materials::Elastic{};
  return solid;
}

/// A block that flies freely, its lowest face wet.
std::unique_ptr<DeformableBody> block_of_elements() {
  fem::Settings settings;
  settings.mesh = fem::PlateMesh{low, high, {6, 4, 5}};
  settings.material = elastic();
  settings.wet_faces = {"z_low"};
  settings.initial_velocity = speed;
  return std::make_unique<fem::Structure>(settings);
}

std::unique_ptr<DeformableBody> block_of_particles() {
  solid::Body block;
  block.name = "block";
  block.shape.base = Box{low, high};
  block.material = elastic();
  block.velocity = speed;
  block.wet = {"z_low"};
  sph::Settings settings;
  settings.lattice.spacing = 0.005;
  settings.numerics.threads = 1;
  auto solids = std::make_unique<solid::Solids>(solid::Settings{.bodies = {block}, .numerics = {}, .planes = {}}, settings);
  solids->mesh_wet_faces();
  return solids;
}

struct Kind {
  const char* name;
  std::unique_ptr<DeformableBody> (*make)();
};

class AnyBody : public ::testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<DeformableBody> body_ = GetParam().make();
};
INSTANTIATE_TEST_SUITE_P(Kinds, AnyBody,
                         ::testing::Values(Kind{"Elements", block_of_elements}, Kind{"Particles", block_of_particles}),
                         [](const auto& one) { return one.param.name; });

const Vec3 places[] = {{0.011, 0.007, 0.013}, {0, 0, 0}, {0.03, 0.02, 0.025}, {0.03, 0.01, 0.002}};

TEST_P(AnyBody, ImpulsesArriveWhole) {
  Vec3 expected = body_->ledger().momentum;
  const double start = expected.norm();
  for (int window = 1; window <= 20; ++window) {
    std::vector<Vec3> impulse(body_->wet_surface().nodes.size());
    for (std::size_t n = 0; n < impulse.size(); ++n) {
      impulse[n] = 1e-4 * Vec3(std::sin(1.0 + 3.0 * n), std::cos(2.0 * n + window), 1.0);
      expected += impulse[n];
    }
    const double end = body_->time() + (0.3 + 0.1 * (window % 7)) * body_->stable_step();
    body_->advance(end, impulse);
    EXPECT_EQ(body_->time(), end);
  }
  EXPECT_LT((body_->ledger().momentum - expected).norm(), 1e-12 * start);
  EXPECT_NE(body_->ledger().received, 0.0);
}

TEST_P(AnyBody, RefusesImpulsesForOtherNodes) {
  EXPECT_THROW(body_->advance(1e-6, std::vector<Vec3>(3, Vec3::Zero())), std::invalid_argument);
  EXPECT_THROW(body_->advance(0.0), std::invalid_argument);
}

TEST_P(AnyBody, FreeFlightIsExactAndKeepsTheLedger) {
  const BodyLedger start = body_->ledger();
  EXPECT_NEAR(start.mass, 2700 * (high - low).prod(), 1e-12);
  EXPECT_LT((start.momentum - start.mass * speed).norm(), 1e-12);
  std::vector<BodyPoint> points;
  for (const Vec3& x : places) points.push_back(body_->locate(x));
  const auto follow = body_->follow_surface(Vec3(0.01, 0.01, -0.001), 0.002);
  ASSERT_TRUE(follow);
  const double time = 5e-6;
  body_->advance(time);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const MaterialPoint now = body_->read(points[k]);
    EXPECT_LT((now.position - places[k] - time * speed).norm(), 1e-12);
    EXPECT_LT((now.displacement - time * speed).norm(), 1e-12);
    EXPECT_LT((now.velocity - speed).norm(), 1e-8);
  }
  EXPECT_LT((follow() - body_->wet_positions().front() - (Vec3(0.01, 0.01, 0) - body_->wet_surface().nodes.front())).norm(),
            0.002);
  EXPECT_NEAR((follow() - time * speed)[2], 0.0, 1e-12);
  const BodyLedger end = body_->ledger();
  EXPECT_NEAR(end.balance(), start.balance(), 1e-9 * start.kinetic);
  EXPECT_LT((end.angular_momentum - start.angular_momentum).norm(), 1e-11 * start.angular_momentum.norm());
}

TEST_P(AnyBody, WhatActsOnAPointActsOnItsCarriersAlike) {
  const Vec3 force(1, 2, 3);
  for (const Vec3& x : places) {
    std::vector<Vec3> received(body_->positions().size(), Vec3::Zero());
    scatter_to_carriers(body_->locate(x), force, received);
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    for (std::size_t i = 0; i < received.size(); ++i) {
      sum += received[i];
      torque += body_->positions()[i].cross(received[i]);
    }
    EXPECT_LT((sum - force).norm(), 1e-12);
    EXPECT_LT((torque - x.cross(force)).norm(), 1e-13);
  }
}

/// At a symmetry plane a point is also made of mirrored particles: whatever their velocities are, what is given to the point has
/// the power that its particles receive.
TEST(HalfABody, ScatteringIsTheAdjointOfReading) {
  solid::Body block;
  block.name = "block";
  block.shape.base = Box{Vec3(-0.03, 0, 0), high};
  block.material = elastic();
  sph::Settings settings;
  settings.lattice.spacing = 0.005;
  settings.symmetry.axis[0] = true;
  settings.numerics.threads = 1;
  solid::Solids solids(solid::Settings{.bodies = {block}, .numerics = {}, .planes = {}}, settings);
  std::vector<Vec3> impulse;
  for (std::size_t i = 0; i < solids.positions().size(); ++i)
    impulse.push_back(1e-3 * Vec3(std::sin(1.0 + 3.0 * i), std::cos(2.0 * i), std::sin(0.7 * i)));
  solids.kick(impulse);
  const BodyPoint point = solids.locate(Vec3(0.001, 0.008, 0.013));
  EXPECT_TRUE(std::any_of(point.motion.begin(), point.motion.end(), [](const auto& share) { return share.image != 0; }));
  const Vec3 force(3, -2, 1);
  std::vector<Vec3> received(impulse.size(), Vec3::Zero());
  scatter_to_carriers(point, force, received);
  double power = 0;
  for (std::size_t i = 0; i < received.size(); ++i) power += received[i].dot(solids.velocities()[i]);
  EXPECT_NEAR(power, force.dot(solids.read(point).velocity), 1e-12 * std::abs(power));
}

TEST_P(AnyBody, SurfacesBeyondReachAreNotFollowed) { EXPECT_FALSE(body_->follow_surface(Vec3(0.01, 0.01, -0.1), 0.01)); }

TEST_P(AnyBody, WetNodesCarryTheWholeBody) {
  const auto mass = body_->wet_masses();
  ASSERT_EQ(mass.size(), body_->wet_surface().nodes.size());
  for (const double one : mass) EXPECT_GT(one, 0.0);
  // Elements give the whole thickness; particles the layer within a kernel's reach.
  const double sum = std::accumulate(mass.begin(), mass.end(), 0.0);
  EXPECT_LT(sum, (1 + 1e-12) * body_->ledger().mass);
  EXPECT_GT(sum, 0.3 * body_->ledger().mass);
}

TEST_P(AnyBody, CountsFit) {
  const std::string names[] = {"velocity", "pressure"};
  const BodySnapshot now = body_->snapshot(names);
  const BodySize size = body_->size();
  EXPECT_EQ(now.position.size(), size.particles + size.nodes);
  EXPECT_EQ(now.cells.size(), size.cells);
  EXPECT_EQ(body_->masses().size(), body_->positions().size());
  for (const auto& field : now.of_points) EXPECT_EQ(field.values.size(), field.components * now.position.size()) << field.name;
  for (const auto& field : now.of_cells) EXPECT_EQ(field.values.size(), field.components * now.cells.size()) << field.name;
  EXPECT_GT(body_->memory_bytes(), 0u);
  EXPECT_FALSE(body_->description().empty());
  EXPECT_FALSE(body_->stable_step_owner().empty());
}

}  // namespace
}  // namespace undex::coupling::testing
