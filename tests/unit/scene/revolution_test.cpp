// Axisymmetric scenes: what is of revolution and what is not, and what the solvers are given.
#include "scene/revolution.hpp"

#include <gtest/gtest.h>

#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene::test;
using scene::Override;

const Override axisymmetric{"dimension", "axisymmetric"};

/// About a line along y that does not go through the origin.
const std::string vessel = R"(end_time = 1e-5
gravity = [0, -9.81, 0]
[resolution]
spacing = 0.001
[[walls]]
name = "vessel"
shape = {type = "cylinder", axis = "y", center = [0.1, 0, 0.2], radius = 0.03, low = -0.04, high = 0.06}
faces = {high = "open"}
[[bodies]]
name = "ball"
shape = {type = "sphere", center = [0.1, 0.01, 0.2], radius = 0.005}
material = "bubble-gas"
[[bodies]]
name = "water"
shape = {type = "cylinder", axis = "y", center = [0.1, 0, 0.2], radius = 0.03, low = -0.04, high = 0.05}
subtract = ["ball"]
material = "water-tait"
velocity = [0, 3, 0]
)";

void expect(const std::string& text, const std::vector<Override>& overrides, const std::string& expected) {
  const std::string found = mistakes(text, overrides);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
}

TEST(Revolution, TheAxisIsFound) {
  const scene::Scene read = read_text(vessel, {axisymmetric});
  ASSERT_TRUE(read.meridian);
  EXPECT_EQ(read.axis, 1);
  EXPECT_EQ(read.meridian->axis, 1);
  EXPECT_EQ(read.meridian->center, Vec3(0.1, 0, 0.2));
  EXPECT_FALSE(read_text(vessel).meridian);
}

TEST(Revolution, SolversAreGivenTheMeridian) {
  const scene::Scene solved = scene::for_solvers(read_text(vessel, {axisymmetric}));
  EXPECT_TRUE(solved.fluid.axisymmetric);
  EXPECT_EQ(solved.fluid.dimension, 2);
  EXPECT_EQ(solved.fluid.gravity, Vec3(0, -9.81, 0));
  EXPECT_EQ(solved.fluid.symmetry.axis, (std::array{true, false, false}));
  EXPECT_EQ(solved.fluid.bodies[1].velocity, Vec3(0, 3, 0));
  const auto& water = std::get<Box>(solved.fluid.bodies[1].shape.base);
  EXPECT_EQ(water.low, Vec3(-0.03, -0.04, 0));
  EXPECT_EQ(water.high, Vec3(0.03, 0.05, 0));
  EXPECT_EQ(std::get<Sphere>(solved.fluid.bodies[1].shape.removed[0]).center, Vec3(0, 0.01, 0));
  const auto& faces = solved.fluid.walls[0].faces;
  EXPECT_EQ(faces.at("y_high"), sph::FaceCondition::open);
  EXPECT_EQ(faces.at("y_low"), sph::FaceCondition::free_slip);
  EXPECT_EQ(faces.at("x_high"), sph::FaceCondition::free_slip);
}

/// Planes through the axis say nothing more; the plane across it halves.
TEST(Revolution, PlanesThroughTheAxisGo) {
  const scene::Scene read = read_text(coupled_tube, {axisymmetric});
  EXPECT_EQ(read.fluid.symmetry.axis, (std::array{false, false, true}));
  EXPECT_EQ(read.structure->symmetry_axes, std::vector<int>{2});
  const scene::Scene solved = scene::for_solvers(read);
  EXPECT_EQ(solved.fluid.symmetry.axis, (std::array{true, true, false}));
  EXPECT_TRUE(solved.structure->axisymmetric);
  EXPECT_EQ(solved.structure->symmetry_axes, std::vector<int>{1});
  EXPECT_EQ(std::get<fem::TubeMesh>(solved.structure->mesh).axis, 1);
}

TEST(Revolution, VolumesAreExact) {
  const scene::Scene read = read_text(vessel, {axisymmetric});
  const double ball = 4.0 / 3.0 * M_PI * std::pow(0.005, 3), column = M_PI * 0.03 * 0.03 * 0.09;
  EXPECT_NEAR(scene::kept_volume(read.fluid.bodies[0].shape, read) / ball, 1.0, 2e-5);
  EXPECT_NEAR(scene::kept_volume(read.fluid.bodies[1].shape, read) / (column - ball), 1.0, 1e-6);
}

TEST(Revolution, WhatIsNotOfRevolutionIsNamed) {
  EXPECT_EQ(mistakes(vessel, {axisymmetric}), "");
  expect(with(vessel, "center = [0.1, 0.01, 0.2]", "center = [0.101, 0.01, 0.2]"), {axisymmetric},
         "bodies.ball.shape: its middle [0.101, 0.01, 0.2] m lies off the axis of revolution, along y");
  expect(with(vessel, "[0, -9.81, 0]", "[0, -9.81, 1]"), {axisymmetric}, "gravity: it must act along the axis of revolution, y");
  expect(with(vessel, "[0, 3, 0]", "[1, 3, 0]"), {axisymmetric}, "bodies.water.velocity: it must be along the axis");
  expect(vessel, {axisymmetric, {"axis", "z"}}, "walls.vessel.shape: its axis is \"y\", that of revolution is \"z\"");
  expect(vessel, {axisymmetric, {"scheme.name", "paper"}}, "scheme.name: this scheme does not compute rings");
  expect(with(vessel, "high = \"open\"", "side = \"no_slip\""), {axisymmetric}, "the fluid slips along walls of revolution");
  expect(vessel, {axisymmetric, {"symmetry.planes", "[\"x\"]"}}, "the plane x = 0 does not go through the axis");
  expect(with(vessel, "{type = \"sphere\", center = [0.1, 0.01, 0.2], radius = 0.005}",
              "{type = \"box\", low = [0.09, 0, 0.19], high = [0.11, 0.02, 0.21]}"),
         {axisymmetric}, "bodies.ball.shape: a box is no body of revolution");
  expect(
      with(vessel, "subtract = [\"ball\"]", "subtract = [\"ball\", {type = \"box\", low = [0.1, 0, 0.2], high = [0.2, 1, 1]}]"),
      {axisymmetric}, "bodies.water.subtract: a box is no body of revolution");
  expect(coupled_tube, {axisymmetric, {"coupling.slip", "false"}}, "coupling.slip: the fluid slips");
  expect(coupled_tube, {axisymmetric, {"structure.supports", "[{face = \"high\", fixed = [\"x\"]}]"}},
         "structure.supports: on the face 'high' both components across the axis");
}

}  // namespace
