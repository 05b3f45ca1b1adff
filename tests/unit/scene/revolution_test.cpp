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
  EXPECT_EQ(read.structures.at(0).symmetry_axes, std::vector<int>{2});
  const scene::Scene solved = scene::for_solvers(read);
  EXPECT_EQ(solved.fluid.symmetry.axis, (std::array{true, true, false}));
  EXPECT_TRUE(solved.structures.at(0).axisymmetric);
  EXPECT_EQ(solved.structures.at(0).symmetry_axes, std::vector<int>{1});
  EXPECT_EQ(std::get<fem::TubeMesh>(solved.structures.at(0).mesh).axis, 1);
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

// ---- Cones -----------------------------------------------------------------------------------------------------------

const std::string funnel = R"(end_time = 1e-5
[resolution]
spacing = 0.001
[[walls]]
name = "funnel"
shape = {type = "cone", axis = "y", center = [0.1, 0, 0.2], low_radius = 0.01, high_radius = 0.03, low = -0.02, high = 0.04}
[[bodies]]
name = "water"
shape = {type = "cone", axis = "y", center = [0.1, 0, 0.2], low_radius = 0.01, high_radius = 0.03, low = -0.02, high = 0.04}
material = "water-tait"
[[probes]]
name = "on_the_side"
kind = "wall"
point = [0.12, 0.01, 0.2]
)";

TEST(Revolution, ConesAreRead) {
  EXPECT_EQ(mistakes(funnel), "");
  const scene::Scene read = read_text(funnel, {axisymmetric});
  EXPECT_EQ(read.meridian->center, Vec3(0.1, 0, 0.2));
  ASSERT_EQ(read.warnings.size(), 0u);
  const scene::Scene solved = scene::for_solvers(read);
  const auto& vessel = std::get<Cone>(solved.fluid.walls[0].container);
  EXPECT_EQ(vessel.axis, 1);
  EXPECT_TRUE(vessel.center.isZero());
  EXPECT_EQ(solved.fluid.walls[0].faces.size(), 3u);
  const double exact = M_PI * 0.06 / 3 * (1e-4 + 3e-4 + 9e-4);
  EXPECT_NEAR(scene::kept_volume(read.fluid.bodies[0].shape, read) / exact, 1.0, 1e-5);
  EXPECT_NEAR(scene::kept_volume(read.fluid.bodies[0].shape, read_text(funnel)) / exact, 1.0, 1e-5);
}

TEST(Revolution, MistakesOfConesAreNamed) {
  expect(with(funnel, "[0.12, 0.01, 0.2]", "[0.12, 0.02, 0.2]"), {}, "probes.on_the_side.point is");
  expect(funnel, {{"walls.funnel.shape.high_radius", "0.02"}}, "bodies.water reaches outside the wall 'funnel'");
  expect(funnel, {{"walls.funnel.shape.low_radius", "-1"}}, "walls.funnel.shape.low_radius = -1 [m] must be from 0");
  expect(funnel, {{"bodies.water.shape.low_radius", "0"}, {"bodies.water.shape.high_radius", "0"}}, "both radii are 0");
  expect(funnel, {{"bodies.water.shape.high", "-0.03"}}, "must be greater than low");
  expect(funnel, {{"walls.funnel.faces", "{x_low = \"open\"}"}}, "unknown key 'x_low' in walls.funnel.faces");
  expect(funnel, {{"symmetry.planes", "[\"y\"]"}}, "walls.funnel: the cone's side meets the symmetry plane y = 0 at a slant");
  EXPECT_EQ(mistakes(with(funnel, "low = -0.02, high = 0.04}\n[[bodies]]",
                          "low = -0.02, high = 0.04}\nfaces = {low = \"open\"}\n[[bodies]]"),
                     {{"bodies.water.shape.low", "-0.05"}, {"bodies.water.shape.low_radius", "0"}}),
            "")
      << "out of the open end, to the tip";
}

TEST(Revolution, SlenderTipsAreWarnedOf) {
  const auto warnings = [](const char* radius) {
    return read_text(funnel, {{"walls.funnel.shape.low_radius", radius},
                              {"bodies.water.shape.low_radius", radius},
                              {"probes.on_the_side.point", "[0.116, 0.01, 0.2]"}})
        .warnings;
  };
  EXPECT_TRUE(warnings("0.003").empty());
  ASSERT_EQ(warnings("0.0029").size(), 1u);
  EXPECT_NE(warnings("0")[0].find("walls.funnel: the cone narrows to a radius of 0 m, and the water's kernel reaches 0.003 m"),
            std::string::npos);
}

TEST(Revolution, ConesInAPlaneAreTrapezia) {
  const std::string plane = R"(dimension = 2
end_time = 1e-5
[resolution]
spacing = 0.001
[[bodies]]
name = "water"
shape = {type = "cone", axis = "x", low_radius = 0.01, high_radius = 0.03, low = -0.02, high = 0.04}
material = "water-tait"
)";
  EXPECT_EQ(mistakes(plane), "");
  EXPECT_NEAR(scene::kept_volume(read_text(plane).fluid.bodies[0].shape, read_text(plane)) / (0.06 * 0.04), 1.0, 1e-5);
  expect(with(plane, "axis = \"x\", ", ""), {}, "bodies.water.shape.axis: in two dimensions a cone lies along");
  expect(with(plane, "dimension = 2", "dimension = 1"), {}, "bodies.water.shape: a cone needs dimension = 2 or 3");
}

// ---- Structures ------------------------------------------------------------------------------------------------------

/// A ring plate of two quadrangles, 0.02 to 0.04 m from the axis and 0.01 m thick; its low side is "5", its high one "6".
const std::string washer_mesh = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0.02 0 0
2 0.03 0 0
3 0.04 0 0
4 0.02 0.01 0
5 0.03 0.01 0
6 0.04 0.01 0
$EndNodes
$Elements
6
1 1 2 5 5 1 2
2 1 2 5 5 2 3
3 1 2 6 6 4 5
4 1 2 6 6 5 6
5 3 2 1 1 1 2 5 4
6 3 2 1 1 2 3 6 5
$EndElements
)";

const std::string washer = R"(dimension = "axisymmetric"
axis = "x"
end_time = 1e-5
[structure]
shape = {type = "gmsh", path = "washer.msh"}
material = "al-5083-h116"
supports = [{face = "6", fixed = ["x"]}]
loads = [{face = "5", time = [0], pressure = [1e6]}]
[[probes]]
name = "rim"
kind = "structure"
point = [0.005, 0.024, 0.032]
)";

TEST(Revolution, MeridiansOfGmshAreRead) {
  const Scratch scratch;
  scratch.write(washer_mesh, "washer.msh");
  const auto found = [&](const std::string& text, const std::vector<Override>& overrides = {}) -> std::string {
    try {
      const scene::Scene read = scene::test::read(scratch.write(text), overrides);
      const scene::Scene solved = scene::for_solvers(read);
      EXPECT_TRUE(solved.structures.at(0).axisymmetric);
      EXPECT_EQ(std::get<fem::GmshMesh>(solved.structures.at(0).mesh).read->cells.size(), 2u);
      EXPECT_EQ(solved.structures.at(0).supports[0].fixed, (std::array{false, true, true}));
      return "";
    } catch (const SceneError& error) {
      return error.what();
    }
  };
  const auto expect_found = [&](const std::string& text, const std::vector<Override>& overrides, const std::string& part) {
    const std::string what = found(text, overrides);
    EXPECT_NE(what.find(part), std::string::npos) << what;
  };
  EXPECT_EQ(found(washer), "") << "the probe lies 0.04 m from the axis";
  expect_found(with(washer, "0.032]", "0.036]"), {}, "probes.rim.point is 0.00326");
  expect_found(with(washer, "face = \"6\"", "face = \"7\""), {}, "'7'");
  expect_found(washer, {{"dimension", "3"}}, "the mesh holds no hexahedra");
  EXPECT_EQ(found(washer, {{"dimension", "3"}, {"probes.rim.kind", "wall"}}).find("1e+300"), std::string::npos);
  expect_found(with(washer, "fixed = [\"x\"]", "fixed = [\"y\"]"), {}, "both components across the axis of revolution");

  const std::string wet = R"(
wet = ["5"]
[resolution]
spacing = 0.001
[[bodies]]
name = "water"
shape = {type = "tube", axis = "x", inner_radius = 0.02, outer_radius = 0.04, low = -0.01, high = 0}
material = "water-tait"
)";
  const auto with_water = [&](const std::string& low_high) {
    return with(with(washer, "\n[[probes]]", wet + "[[probes]]"), "low = -0.01, high = 0}", low_high);
  };
  EXPECT_EQ(found(with_water("low = -0.01, high = 0}")), "");
  expect_found(with_water("low = -0.01, high = -0.005}"), {}, "structure.wet: the face '5' touches no water");
  expect_found(with_water("low = -0.01, high = 0.005}"), {}, "bodies.water overlaps the structure");
}

TEST(Revolution, DiscsMayBeShells) {
  const std::string disc = R"(dimension = "axisymmetric"
axis = "z"
end_time = 1e-5
[structure]
shape = {type = "rod", radius = 0.05, low = 0, high = 0.004}
element = "shell"
material = "al-5083-h116"
)";
  const scene::Scene read = read_text(disc);
  const auto& rod = std::get<fem::RodMesh>(read.structures.at(0).mesh);
  EXPECT_EQ(rod.cells_along, 1);
  EXPECT_EQ(rod.cells_radial, 13);
  const auto halved = read_text(with(disc, "low = 0, high", "low = -0.004, high"), {{"symmetry.planes", "[\"z\"]"}});
  EXPECT_EQ(std::get<fem::RodMesh>(halved.structures.at(0).mesh).cells_along, 2);
  expect(disc, {{"dimension", "3"}}, "or of a rod with dimension = \"axisymmetric\"");
}

}  // namespace
