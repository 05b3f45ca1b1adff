// Axisymmetric scenes beside the same ones in space.
#include <gtest/gtest.h>

#include <cmath>

#include "run/probes.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

/// A ball of gas in a closed cylinder of water about an axis along x, off the origin; its middle lies off that of the cylinder.
const std::string tank = R"(
end_time = 3e-5
threads = 1
[resolution]
spacing = 0.002
fit = "tank"
[scheme]
precision = "full"
[[walls]]
name = "tank"
shape = {type = "cylinder", axis = "x", center = [0, 0.1, -0.1], radius = 0.02, low = -0.03, high = 0.03}
[[bodies]]
name = "gas"
shape = {type = "sphere", center = [-0.005, 0.1, -0.1], radius = 0.008}
material = {law = "ideal_gas", rho0 = 500, gamma = 2}
energy = 1e6
[[bodies]]
name = "water"
shape = {type = "cylinder", axis = "x", center = [0, 0.1, -0.1], radius = 0.02, low = -0.03, high = 0.03}
subtract = ["gas"]
material = "water-tait"
pressure = 1e5
)";

/// Everything means what it means in space: energies, masses, pressures and velocities at points.
TEST(Axisymmetric, NumbersMeanWhatTheyMeanInSpace) {
  Simulation ring(read_text(tank, {{"dimension", "axisymmetric"}}));
  Simulation space(read_text(tank));
  ASSERT_TRUE(ring.meridian());
  EXPECT_EQ(ring.meridian()->axis, 0);
  EXPECT_NEAR(ring.fluid()->ledger().mass / space.fluid()->ledger().mass, 1.0, 1e-4);
  EXPECT_NEAR(ring.energy().internal / space.energy().internal, 1.0, 1e-3);
  run_to(ring, 15e-6);
  run_to(space, 15e-6);
  EXPECT_NEAR(ring.energy().kinetic / space.energy().kinetic, 1.0, 0.05);
  const Vec3 x(0.01, 0.1 - 0.012, -0.1);
  const FluidPoint here = ring.fluid()->at(ring.meridian()->place(x)), there = space.fluid()->at(x);
  EXPECT_NEAR(here.pressure / there.pressure, 1.0, 0.1);
  const Vec3 v = ring.meridian()->vector_in_space(here.velocity, ring.meridian()->outward_at(x));
  EXPECT_LT((v - there.velocity).norm(), 0.1 * there.velocity.norm());
  EXPECT_LT(ring.mass_error(), 1e-14);
  EXPECT_LT(std::abs(ring.energy().error()), 2e-3);
}

/// Nothing leaves along an open duct: momentum along the axis.
TEST(Axisymmetric, MomentumAlongTheAxis) {
  Simulation ring(read_text(tank, {{"dimension", "axisymmetric"}, {"walls.tank.faces", "{low = \"open\", high = \"open\"}"}}));
  run_to(ring, 15e-6);
  EXPECT_LT(ring.momentum_error(), 1e-13);
}

}  // namespace
}  // namespace undex::run::test
