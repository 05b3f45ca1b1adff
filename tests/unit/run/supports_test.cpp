// Solids in particles that are held at a face.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "scenes.hpp"

namespace undex::run::test {
namespace {

/// A bar of 0.1 m, without lateral strain, whose lower end is held, all of it in motion at the start.
const char* const held_end = "supports = [{face = \"x_low\", fixed = [\"x\"]}]\n";
std::string bar(const std::string& description, double spacing, const std::string& more = "",
                const std::string& supports = held_end) {
  return "dimension = 2\nend_time = 1e-3\nthreads = 1\n[resolution]\nspacing = " + std::to_string(spacing) + R"(
[[solids]]
name = "bar"
shape = {type = "box", low = [0, 0], high = [0.1, 0.01]}
material = {rho0 = 2700, young_modulus = 70e9, poisson_ratio = 0, flow = {law = "linear_hardening", Y0 = 1e12, H = 0}}
velocity = [1, 0]
description = ")" +
         description + "\"\n" + more + supports;
}

/// A wave of rest runs from the held end to the free one, and comes back as one of -1 m/s: the momentum falls along a line,
/// through zero when it has reached the free end.
TEST(Supports, ABarComesBackFromItsHeldEnd) {
  const double sound = std::sqrt(70e9 / 2700);
  for (const char* description : {"total_lagrangian", "updated_lagrangian"}) {
    double missing = 0.05;
    for (const double spacing : {0.002, 0.001}) {
      Simulation simulation(read_text(bar(description, spacing)));
      double before = 0, last = 0, zero = 0, least = 1;
      const double whole = 2700 * (0.1 - spacing) * 0.01;  // the held row rests
      EXPECT_NEAR(simulation.momentum()[0], whole, 1e-9 * whole);
      while (simulation.time() < 2.2 * 0.1 / sound) {
        before = simulation.time();
        last = simulation.momentum()[0];
        simulation.advance(1e-3);
        const double now = simulation.momentum()[0];
        if (zero == 0 && now < 0) zero = before + (simulation.time() - before) * last / (last - now);
        least = std::min(least, now / whole);
      }
      // The held row stands half a spacing inside, and the zero of its motion with it.
      EXPECT_NEAR(zero * sound / (0.1 - 0.5 * spacing), 1.0, 0.01) << description << ' ' << spacing;
      // Viscosity rounds the corners of the wave over some spacings, the less the finer they are.
      EXPECT_LT(least + 1.0, missing) << description << ' ' << spacing;
      missing = 0.8 * (least + 1.0);
      EXPECT_LT(std::abs(simulation.energy().error()), 0.02) << description << ' ' << spacing;
    }
  }
}

/// Only what is named is held: a plate that slips along its support moves on as it did.
TEST(Supports, OtherComponentsAreFree) {
  Simulation simulation(read_text(R"(dimension = 2
end_time = 1e-5
threads = 1
[resolution]
spacing = 0.001
[[solids]]
name = "plate"
shape = {type = "box", low = [0, 0], high = [0.02, 0.01]}
material = "al-5083-h116"
velocity = [3, 0]
supports = [{face = "y_low", fixed = ["y"]}]
)"));
  const double start = simulation.momentum()[0];
  while (simulation.time() < 1e-5) simulation.advance(1e-5);
  EXPECT_NEAR(simulation.momentum()[0], start, 1e-9 * start);
  EXPECT_LT(std::abs(simulation.momentum()[1]), 1e-9 * start);
}

/// What holds a solid may turn it: only a free one keeps its angular momentum.
TEST(Supports, TurnWhatTheyHold) {
  const std::string turning = bar("total_lagrangian", 0.001, "spin = 100\n");
  const auto off = [](const std::string& text) {
    Simulation simulation(read_text(text));
    while (simulation.time() < 5e-6) simulation.advance(5e-6);
    return simulation.angular_momentum_error();
  };
  EXPECT_FALSE(off(turning).has_value());
  const auto free = off(bar("total_lagrangian", 0.001, "spin = 100\n", ""));
  ASSERT_TRUE(free.has_value());
  EXPECT_LT(*free, 1e-9);
}

TEST(Supports, HoldRingsAboutTheAxis) {
  const std::string tube = R"(dimension = "axisymmetric"
axis = "z"
end_time = 7e-6
threads = 1
[resolution]
spacing = 0.001
[[solids]]
name = "tube"
shape = {type = "tube", axis = "z", inner_radius = 0.02, outer_radius = 0.024, low = 0, high = 0.02}
material = "al-5083-h116"
velocity = [0, 0, 3]
)";
  const auto falls = [&](const std::string& supports) {
    Simulation simulation(read_text(tube + supports));
    while (simulation.time() < 7e-6) simulation.advance(7e-6);
    return simulation.momentum()[1];
  };
  const double free = falls("");
  EXPECT_LT(falls("supports = [{face = \"low\", fixed = [\"z\"]}]\n"), -0.5 * free);
  EXPECT_LT(falls("supports = [{face = \"inner\", fixed = [\"z\"]}]\n"), 0.5 * free);
}

TEST(Supports, UnknownFacesAreNamed) {
  try {
    std::string text = bar("total_lagrangian", 0.002);
    text.replace(text.find("x_low"), 5, "z_low");
    read_text(text);
    FAIL() << "accepted";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("z_low"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace undex::run::test
