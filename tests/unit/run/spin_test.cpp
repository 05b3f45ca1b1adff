// Bodies, structures and solids that turn at the start: their energy and momentum, and what cannot turn.
#include <gtest/gtest.h>

#include <string>

#include "scenes.hpp"

namespace undex::run::test {
namespace {

const std::string head = R"(
end_time = 1e-6
threads = 1
[resolution]
spacing = 0.005
)";
const std::string box = R"(shape = {type = "box", low = [0.1, 0, 0], high = [0.2, 0.06, 0.04]}
)";
/// A block of 0.1 x 0.06 x 0.04 m about the middle of its mass, turning at 10 rad/s about z.
double energy_of_block(double rho) {
  const double a = 0.1, b = 0.06, mass = rho * a * b * 0.04;
  return 0.5 * mass * (a * a + b * b) / 12 * 100;
}

TEST(Spin, WaterTurnsAboutItsMiddle) {
  const Simulation simulation(
      read_text(head + "[[bodies]]\nname = \"block\"\nmaterial = \"water-tait\"\nspin = [0, 0, 10]\n" + box));
  // A lattice of n cells has 1 - 1/n^2 of the moment of inertia along each side.
  const double a = 0.1, b = 0.06;
  const double lattice = (a * a * (1 - 1 / 400.0) + b * b * (1 - 1 / 144.0)) / (a * a + b * b);
  EXPECT_NEAR(simulation.energy().kinetic, energy_of_block(1000) * lattice, 1e-4 * energy_of_block(1000));
  EXPECT_LT(simulation.momentum().norm(), 1e-12);
}

TEST(Spin, TheStructureTurnsAboutItsMiddle) {
  Simulation simulation(read_text(head + R"([structure]
shape = {type = "plate", low = [0.1, 0, 0], high = [0.2, 0.06, 0.04]}
cells = {x = 20, y = 12, z = 8}
material = {rho0 = 2000, young_modulus = 70e9, poisson_ratio = 0.3, flow = {law = "linear_hardening", Y0 = 1e12, H = 0}}
spin = [0, 0, 10]
velocity = [0, 0, 3]
)"));
  const double mass = 2000 * 0.1 * 0.06 * 0.04, whole = energy_of_block(2000) + 0.5 * mass * 9;
  EXPECT_NEAR(simulation.energy().structure_kinetic, whole, 0.01 * whole);
  EXPECT_NEAR(simulation.momentum()[2], 3 * mass, 1e-9 * mass);
  const double x = simulation.momentum()[0], y = simulation.momentum()[1];
  EXPECT_LT(std::hypot(x, y), 1e-12 * mass);
}

TEST(Spin, WhatIsNoMirrorImageIsRefused) {
  const auto says = [](const std::string& text, const std::string& part) {
    try {
      read_text(text);
      ADD_FAILURE() << "accepted: " << part;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const std::string half = head + "[symmetry]\nplanes = [\"x\"]\n";
  const std::string ball = "[[bodies]]\nname = \"ball\"\nmaterial = \"water-tait\"\nshape = {type = \"sphere\", radius = 0.05}\n";
  EXPECT_NO_THROW(read_text(half + ball + "spin = [10, 0, 0]\n"));
  says(half + ball + "spin = [10, 0, 1]\n", "bodies.ball: its spin about an axis within the symmetry plane x = 0");
  const std::string plate = R"([structure]
shape = {type = "plate", low = [-0.1, 0, 0], high = [0.1, 0.06, 0.04]}
cells = {x = 4, y = 2, z = 2}
material = "al-5083-h116"
)";
  EXPECT_NO_THROW(read_text(half + plate + "spin = [10, 0, 0]\n"));
  says(half + plate + "spin = [0, 10, 0]\n", "structure.spin has a component about an axis within the symmetry plane x = 0");
  const std::string line = "dimension = \"spherical\"\nend_time = 1e-6\n[resolution]\nspacing = 0.005\n";
  says(line + ball + "spin = [0, 0, 1]\n", "spin");
}

}  // namespace
}  // namespace undex::run::test
