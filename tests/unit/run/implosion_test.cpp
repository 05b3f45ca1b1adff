// A cylindrical shell that implodes and is stopped by its own strength: all of its kinetic energy becomes plastic work.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes.hpp"

namespace undex::run::test {
namespace {

constexpr double inner = 0.08, outer = 0.1, long_ = 0.01, rho = 1845, yield = 330e6;

std::string shell(double speed, const std::string& more) {
  return R"(
dimension = "axisymmetric"
axis = "z"
end_time = 1e-3
threads = 1
[structure]
name = "shell"
shape = {type = "tube", axis = "z", inner_radius = 0.08, outer_radius = 0.1, low = 0, high = 0.01}
cells = {through = 20, along = 2, around = 8}
material = {rho0 = 1845, young_modulus = 300e9, poisson_ratio = 0.1, flow = {law = "linear_hardening", Y0 = 330e6, H = 0}}
supports = [{face = "low", fixed = ["z"]}, {face = "high", fixed = ["z"]}]
radial = {about = "z", radius = 0.08, power = -1, speed = )" +
         std::to_string(speed) + "}\n" + more;
}

/// Plastic work [J] of a shell of a rigid, perfectly plastic metal when its inner radius is r: each ring keeps its area and is
/// strained by 2/sqrt(3) ln(R/r).
double plastic_work(double r) {
  constexpr int rings = 2000;
  double work = 0;
  for (int k = 0; k < rings; ++k) {
    const double R = inner + (outer - inner) * (k + 0.5) / rings, now = std::sqrt(R * R - inner * inner + r * r);
    work += yield * 2 / std::sqrt(3.0) * std::log(R / now) * 2 * std::numbers::pi * R * (outer - inner) / rings * long_;
  }
  return work;
}

TEST(Implosion, KineticEnergyBecomesPlasticWork) {
  const double stopped = 0.05;
  // v = V a/r has the energy pi rho (V a)^2 ln(b/a) a length.
  const double speed =
      std::sqrt(plastic_work(stopped) / (std::numbers::pi * rho * inner * inner * std::log(outer / inner) * long_));
  const scene::Scene scene = read_text(shell(-speed, ""));
  Simulation simulation(scene);
  const double start = simulation.energy().structure_kinetic;
  EXPECT_NEAR(start / plastic_work(stopped), 1.0, 1e-3);
  double least = start, radius = inner;
  while (simulation.time() < scene.end_time) {
    simulation.advance(scene.end_time);
    const double kinetic = simulation.energy().structure_kinetic;
    if (kinetic > 1.5 * least + 1e-3 * start) break;  // it springs back
    if (kinetic >= least) continue;
    least = kinetic;
    radius = 1e300;
    for (const Vec3& x : simulation.bodies()[0]->positions()) radius = std::min(radius, x[0]);
  }
  RecordProperty("inner_radius", std::to_string(radius));
  EXPECT_LT(least, 0.01 * start);
  EXPECT_NEAR(radius / stopped, 1.0, 0.01);
  EXPECT_NEAR(start / plastic_work(radius), 1.0, 0.01);
  EXPECT_NEAR(simulation.energy().plastic / start, 1.0, 0.02);
  EXPECT_LT(std::abs(simulation.energy().error()), 5e-3);
}

TEST(Implosion, WhatHasNoBoundIsRefused) {
  const auto says = [](const std::string& text, const std::string& part) {
    try {
      read_text(text);
      FAIL() << "accepted: " << part;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const std::string ball = R"(
end_time = 1e-6
threads = 1
[resolution]
spacing = 0.01
[symmetry]
planes = ["x"]
[[bodies]]
name = "ball"
shape = {type = "sphere", radius = 0.05}
material = "water-tait"
)";
  says(ball + "radial = {speed = -1, radius = 0.05, power = -2}\n", "its centre lies in what moves");
  says(ball + "radial = {speed = -1, radius = 0.05, about = \"z\", power = -1}\n", "its axis lies in what moves");
  says(ball + "radial = {speed = -1, radius = 0.05, center = [0.01, 0, 0]}\n", "off the symmetry plane x = 0");
  says(ball + "radial = {speed = -1}\n", "give the distance from the centre");
  says(ball + "radial = -1\n", "must be a table");
  EXPECT_NO_THROW(read_text(ball + "radial = {speed = -1, radius = 0.05, power = 1}\n"));
}

}  // namespace
}  // namespace undex::run::test
