// Impossible geometry: overlaps, gaps, things outside of others.
#include <gtest/gtest.h>

#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene::test;

void expect(const std::string& scene, const std::string& expected) {
  const std::string found = mistakes(scene);
  EXPECT_NE(found.find(expected), std::string::npos) << "gave:\n" << found << "expected:\n" << expected;
}

const std::string tank = R"(
[[walls]]
name = "tank"
shape = {type = "box", low = 0, high = 1}
)";

TEST(Geometry, OverlapOfBodies) {
  expect(with(coupled_tube, "subtract = [\"charge\"]\n", ""), "16:9: bodies.water overlaps bodies.charge, e.g. at [");
  expect(with(two_gases, "low = 0.5, high = 1", "low = 0.499, high = 1"),
         "15:9: bodies.right overlaps bodies.left, e.g. at [0.499");
}

TEST(Geometry, TouchingBodiesDoNotOverlap) {
  EXPECT_EQ(mistakes(R"(end_time = 1e-5
[resolution]
spacing = 0.01
[[bodies]]
name = "core"
shape = {type = "cylinder", axis = "x", center = [0, 0.3, 0.1], radius = 0.1, low = 0, high = 1}
material = "water-tait"
[[bodies]]
name = "coat"
shape = {type = "tube", axis = "x", center = [0, 0.3, 0.1], inner_radius = 0.1, outer_radius = 0.2, low = 0, high = 1}
material = "water-tait"
[[bodies]]
name = "ball"
shape = {type = "sphere", center = [1.1, 0.3, 0.1], radius = 0.1}
material = "water-tait"
)"),
            "");
}

TEST(Geometry, ThinOverlapAlongASurfaceIsFound) {
  expect(with(coupled_tube, "radius = 0.044, low", "radius = 0.0442, low"),
         "16:9: bodies.water overlaps the structure, e.g. at [");
}

TEST(Geometry, OutsideTheWall) {
  EXPECT_EQ(mistakes(two_gases + tank), "");
  expect(with(two_gases + tank, "low = 0.5, high = 1}", "low = 0.5, high = 1.2}"),
         "15:9: bodies.right reaches outside the wall 'tank', e.g. at [");
  EXPECT_EQ(mistakes(with(two_gases + tank, "low = 0.5, high = 1}", "low = 0.5, high = 1.2}") + "faces = {x_high = \"open\"}\n"),
            "");
  EXPECT_EQ(mistakes(two_gases + tank + "faces = {side = \"open\"}\n"),
            "23:10: unknown key 'side' in walls.tank.faces; known: x_low, x_high, y_low, y_high, z_low, z_high\n");
  EXPECT_EQ(mistakes(two_gases + tank + "faces = {z_low = \"open\"}\n"),
            "23:18: walls.tank.faces.z_low: in dimension = 1 the wall has only the faces x_low, x_high\n");
}

TEST(Geometry, InThePartThatSymmetryLeavesOut) {
  expect(with(two_gases, "low = 0, high = 0.5", "low = -1, high = -0.5") + "[symmetry]\nplanes = [\"x\"]\n",
         "9:9: bodies.left lies wholly at x <= 0, in the part that the symmetry plane leaves out");
  expect(with(coupled_tube, "point = [0.044, 0, 0]", "point = [0.044, 0, -0.01]"),
         "30:9: probes.wall.point lies at z < 0, in the part that the symmetry plane leaves out; mirror it");
}

TEST(Geometry, SmallerThanTheSpacing) {
  expect(with(coupled_tube, "radius = 0.0072", "radius = 0.0007"),
         "11:9: bodies.charge is 0.0014 m at its thinnest, less than the spacing 0.002 m; make the spacing smaller or the body "
         "larger");
}

TEST(Geometry, Subtractions) {
  expect(with(two_gases, "density = 0.125", "subtract = [{type = \"box\", low = 0, high = 2}]"),
         "17:12: bodies.right: its subtractions leave nothing of it; make them smaller");
  expect(with(two_gases, "density = 0.125", "subtract = [{type = \"box\", low = 2, high = 3}]"),
         "17:12: bodies.right.subtract: the shape number 0 (from 0) does not meet the body, it removes nothing");
  expect(with(two_gases, "density = 0.125", "subtract = [\"lef\"]"),
         "17:13: bodies.right.subtract: no body 'lef'; did you mean 'left'?");
  expect(with(two_gases, "density = 0.125", "subtract = [\"right\"]"),
         "17:13: bodies.right.subtract: a body cannot be subtracted from itself");
}

TEST(Geometry, BodyWithoutEnd) {
  expect(with(coupled_tube, "{type = \"sphere\", radius = 0.0072}", "{type = \"slab\", axis = \"y\", low = 1, high = 2}"),
         "11:9: bodies.charge has no end along x; take a box instead of a slab");
}

TEST(Geometry, StructureThatTouchesNoWater) {
  expect(with(coupled_tube, "radius = 0.044, low", "radius = 0.03, low"),
         "25:7: structure.wet: the face 'inner' touches no water: no body comes within two spacings (0.004 m) of it");
  EXPECT_EQ(mistakes(with(coupled_tube, "radius = 0.044, low", "radius = 0.042, low")), "");
  expect(with(coupled_tube, "wet = [\"inner\"]\n", ""),
         "21:1: structure.wet is empty, so the water does not see the structure; name the faces that it touches, e.g. wet = "
         "[\"inner\"]");
}

TEST(Geometry, StructureThatSymmetryDoesNotHalve) {
  expect(with(coupled_tube, "outer_radius = 0.05, low = -0.1, high = 0.1", "outer_radius = 0.05, low = -0.1, high = 0.2"),
         "22:9: structure: the symmetry plane z = 0 does not halve it (it runs from -0.1 to 0.2 m)");
}

TEST(Geometry, ProbesInNowhere) {
  expect(with(coupled_tube, "point = [0.05, 0, 0]", "point = [0.06, 0, 0]"),
         "35:9: probes.outer.point is 0.01 m away from the structure; move it onto it");
  expect(with(coupled_tube, "point = [0.044, 0, 0]", "point = [0.02, 0, 0]"),
         "30:9: probes.wall.point is 0.024 m away from every wall, more than two spacings; move it to the wall");
  expect(two_gases + "[[probes]]\nname = \"far\"\npoint = 3\n",
         "21:9: probes.far.point lies outside everything: 2 m from the nearest fluid or wall; move it");
  expect(two_gases + "[[probes]]\nname = \"a\"\nkind = \"structure\"\npoint = 0.5\n",
         "21:8: probes.a is a structure probe, but the scene has no [structure] and no [[solids]]");
  expect(two_gases + "[[probes]]\nname = \"a\"\nkind = \"wall\"\npoint = 0.5\n",
         "21:8: probes.a is a wall probe, but the scene has neither [[walls]] nor a wet face nor [[solids]]");
}

TEST(Geometry, Solids) {
  expect(with(impact, "0.0121", "0.0115"), "17:9: solids.plate overlaps solids.ball, e.g. at [");
  expect(with(bathed_disc, "subtract = [\"disc\"]\n", ""), "14:9: solids.disc overlaps bodies.water, e.g. at [");
  expect(with(bathed_disc, "subtract = [\"disc\"]", "subtract = [\"dsic\"]"),
         "10:13: bodies.water.subtract: no body 'dsic'; did you mean 'disc'?");
  expect(with(bathed_disc, "name = \"disc\"", "name = \"water\""),
         "14:8: solids: the name 'water' is that of a body; choose another one");
  expect(with(impact, "name = \"plate\"", "name = \"ball\""), "16:8: solids: the name 'ball' is used twice; choose another one");
  expect(with(impact, "position = -0.01", "position = -0.001"),
         "22:12: planes.0: solids.plate starts 0.001 m beyond the plane z = -0.001, whose free side is above; move one of them");
  expect(with(impact, "low = [-0.05,", "low = [-0.04,"),
         "17:9: solids.plate: the symmetry plane x = 0 does not halve it (it runs from -0.04 to 0.05 m); centre the whole solid");
  expect(with(impact, "velocity = [0, 0, -1000]", "velocity = [1, 0, -1000]"),
         "13:12: solids.ball: its motion is not its own mirror image across the symmetry plane x = 0; change the motion");
  expect(with(impact, "velocity = [0, 0, -1000]", "spin = [0, 0, 3]"),
         "13:8: solids.ball: its motion is not its own mirror image");
  EXPECT_EQ(mistakes(with(impact, "velocity = [0, 0, -1000]", "spin = [3, 0, 0]")), "");
  expect(with(impact, "velocity = [0, 0, -1000]", "wet = [\"side\"]"),
         "13:7: solids.ball.wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
  expect(with(impact, "point = [0, 0, -0.002]", "point = [0, 0, -0.004]"),
         "26:9: probes.middle.point is 0.002 m away from every solid; move it onto one");
  expect(with(bathed_disc, "point = [0.01, 0]", "point = [0.02, 0]"), "22:9: probes.rim.point is 0.01 m away from every wall");
}

const std::string pool = R"(end_time = 1e-3
dimension = 2
gravity = [0, -9.81]
[resolution]
spacing = 0.01
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0], high = [1, 1]}
material = "water-tait"
pressure = 1e5
level = [0, 1]
)";

TEST(Geometry, Gravity) {
  EXPECT_EQ(mistakes(pool), "");
  const undex::scene::Scene scene = read_text(pool);
  EXPECT_EQ(scene.fluid.gravity, undex::Vec3(0, -9.81, 0));
  ASSERT_TRUE(scene.fluid.bodies[0].level);
  EXPECT_EQ(*scene.fluid.bodies[0].level, undex::Vec3(0, 1, 0));
  EXPECT_EQ(*read_text(with(pool, "level = [0, 1]", "level = 1.5")).fluid.bodies[0].level, undex::Vec3(0, 1.5, 0));
  expect(with(with(pool, "level = [0, 1]", "level = 1.5"), "gravity = [0, -9.81]", "gravity = [1, -9.81]"),
         "11:9: bodies.water.level = 1.5: a number is a coordinate along gravity, which is along no axis here; give a point");
  expect(with(with(pool, "level = [0, 1]", "level = 1"), "gravity = [0, -9.81]\n", ""),
         "10:9: bodies.water.level means nothing without gravity");
  expect(with(pool, "level = [0, 1]", "level = inf"), "11:9: ");
  expect(with(pool, "gravity = [0, -9.81]\n", ""), "10:9: bodies.water.level means nothing without gravity");
  expect(with(pool, "pressure = 1e5\n", ""), "10:9: bodies.water.level is where the body has its pressure: give pressure");
  expect(with(pool, "level = [0, 1]", "level = [0, -20]"),
         "11:9: bodies.water.level: with 1e+05 Pa there the body has no hydrostatic equilibrium");
  // A symmetry plane may be the bottom, but not cut the water.
  const std::string planes = "\n[symmetry]\nplanes = [\"y\"]\n";
  EXPECT_EQ(mistakes(pool + planes), "");
  expect(with(pool, "low = [0, 0]", "low = [0, -1]") + planes,
         "3:11: gravity is not its own mirror image across the symmetry plane y = 0");
  EXPECT_EQ(mistakes(pool + "[start]\nkind = \"plane_wave\"\naxis = \"y\"\nfront = 0.5\npeak = 1e6\ndecay = 1e-5\n"), "");
}

TEST(Geometry, Rotation) {
  EXPECT_EQ(mistakes(with(pool, "spacing = 0.01", "spacing = 0.01\nrotation = 17")), "");
  expect(with(pool, "spacing = 0.01", "spacing = 0.01\nrotation = [1, 2, 3]"),
         "6:12: resolution.rotation must be a number in degrees");
  expect(with(pool, "spacing = 0.01", "spacing = 0.01\nrotation = 17\nfit = \"water\""),
         "6:12: resolution.rotation turns a Cartesian lattice that is not fitted, in 2D and 3D; leave out fit or rotation");
}

TEST(Geometry, NamesAndFit) {
  expect(with(two_gases, "name = \"right\"", "name = \"left\""),
         "14:8: bodies: the name 'left' is used twice; choose another one");
  expect(with(coupled_tube, "spacing = 0.002", "spacing = 0.002\nfit = \"watr\""),
         "5:7: resolution.fit: no body or wall 'watr'; did you mean 'water'?");
  expect(with(coupled_tube, "spacing = 0.002", "spacing = 0.002\nlattice = \"rings\""),
         "5:11: resolution.lattice = \"rings\" needs a round body or wall to fit; add fit = \"its name\"");
  expect(with(two_gases, "spacing = 0.01", "spacing = 0.01\nlattice = \"rings\"\nfit = \"left\""),
         "6:11: resolution.lattice = \"rings\" needs dimension = 2 or 3");
}

}  // namespace
