// -P key=value: every key can be overridden by its dotted path.
#include <gtest/gtest.h>

#include "scratch.hpp"

namespace {

using namespace undex;
using namespace undex::scene;
using namespace undex::scene::test;

TEST(Overrides, NumbersListsWordsAndTables) {
  const Scene scene = read_text(coupled_tube, {{"resolution.spacing", "0.001"},
                                               {"symmetry.planes", "[]"},
                                               {"scheme.kernel", "gaussian"},
                                               {"title", "\"two words\""},
                                               {"output.structure_fields", "false"},
                                               {"bodies.water.velocity", "[0, 0, 1]"},
                                               {"bodies.water.shape.low", "-0.05"},
                                               {"bodies.0.burn", "instantaneous"},
                                               {"bodies.charge.material.E0", "5e6"},
                                               {"structure.material.flow.A", "1e8"},
                                               {"probes.wall.quantities", "[\"pressure\"]"}});
  EXPECT_EQ(scene.fluid.lattice.spacing, 0.001);
  EXPECT_EQ(scene.fluid.symmetry.axis, (std::array<bool, 3>{false, false, false}));
  EXPECT_TRUE(scene.structures.at(0).symmetry_axes.empty());
  EXPECT_EQ(scene.fluid.numerics.kernel, sph::KernelName::gaussian);
  EXPECT_EQ(scene.title, "two words");
  EXPECT_FALSE(scene.output.structure_fields);
  EXPECT_EQ(scene.fluid.bodies[1].velocity, Vec3(0, 0, 1));
  EXPECT_EQ(std::get<Cylinder>(scene.fluid.bodies[1].shape.base).low, -0.05);
  EXPECT_FALSE(scene.fluid.bodies[0].burn.has_value());
  const auto& petn = std::get<materials::Jwl>(scene.fluid.bodies[0].material.law).parameters();
  EXPECT_EQ(petn.E0, 5e6) << "a parameter of a material given by name";
  EXPECT_EQ(petn.A, 617e9);
  EXPECT_EQ(std::get<materials::JohnsonCook>(scene.structures.at(0).material.flow).A, 1e8);
  EXPECT_EQ(std::get<materials::JohnsonCook>(scene.structures.at(0).material.flow).B, 596e6);
  EXPECT_EQ(scene.probes[0].quantities, (std::vector<std::string>{"pressure"}));
}

TEST(Overrides, TheLastOneCounts) { EXPECT_EQ(read_text(two_gases, {{"end_time", "1"}, {"end_time", "2"}}).end_time, 2); }

TEST(Overrides, ValuesMayCarryAUnit) {
  const Scene scene = read_text(two_gases, {{"end_time", "\"2 us\""}, {"resolution.spacing", "5mm"}});
  EXPECT_EQ(scene.end_time, 2e-6);
  EXPECT_EQ(scene.fluid.lattice.spacing, 0.005);
}

/// As the shell leaves them of -P 'end_time=2 us': no second pair of quotes is wanted.
TEST(Overrides, UnitsMayStandAfterABlank) {
  const Scene scene = read_text(coupled_tube, {{"end_time", "2 us"},
                                               {"resolution.spacing", "2.5 mm"},
                                               {"bodies.water.pressure", "+0.1 MPa"},
                                               {"symmetry.planes", "[]"},
                                               {"bodies.water.velocity", "[0, 0, 10 cm s^-1]"},
                                               {"probes.outer.point", "[5 cm, 0, 0]"}});
  EXPECT_EQ(scene.end_time, 2e-6);
  EXPECT_EQ(scene.fluid.lattice.spacing, 0.0025);
  EXPECT_EQ(scene.fluid.bodies[1].pressure, 1e5);
  EXPECT_EQ(scene.fluid.bodies[1].velocity, Vec3(0, 0, 0.1));
  EXPECT_EQ(scene.probes[1].point, Vec3(0.05, 0, 0));
  EXPECT_EQ(mistakes(two_gases, {{"end_time", "1 kg"}}), "-P end_time: end_time = \"1 kg\" is none in units of s\n");
  EXPECT_EQ(mistakes(two_gases, {{"end_time", "1 ms 2"}}), mistakes(two_gases, {{"end_time", "\"1 ms 2\""}}));
  for (const char* wrong : {"1 ms, 2", "[1 ms", "[1 ms; 2]", "[a b, 2]", "[1 ms, [2 ms]]", "1 \"ms\"", "1 ms = 2"})
    EXPECT_NE(mistakes(two_gases, {{"end_time", wrong}}).find("cannot read the value"), std::string::npos) << wrong;
}

TEST(Overrides, MistakesNameTheOption) {
  const auto expect = [](const Override& given, const std::string& expected) {
    EXPECT_EQ(mistakes(coupled_tube, {given}), expected);
  };
  expect({"resolution.spcing", "1"}, "-P resolution.spcing: unknown key 'spcing' in resolution; did you mean 'spacing'?\n");
  expect({"resolutoin.spacing", "1"},
         "-P resolutoin.spacing: unknown key 'resolutoin' at the top of the file; did you mean 'resolution'?\n");
  expect({"resolution.spacing", "2ms"}, "-P resolution.spacing: resolution.spacing = \"2ms\" is none in units of m\n");
  expect({"resolution.spacing", "-1"},
         "-P resolution.spacing: resolution.spacing = -1 [m] must be greater than 0 and at most 1e+05\n");
  expect({"bodies.watr.pressure", "1"}, "-P bodies.watr.pressure: nothing in bodies is named 'watr'; did you mean 'water'?\n");
  expect({"bodies.7.pressure", "1"}, "-P bodies.7.pressure: bodies has 2 elements, counted from 0\n");
  expect({"end_time.x", "1"}, "-P end_time.x: end_time is the number 1e-05, it has no 'x'\n");
  expect({"resolution..spacing", "1"}, "-P resolution..spacing: not a dotted path; write e.g. resolution.spacing=0.001\n");
  expect({"title", "a b"}, "-P title: cannot read the value 'a b'; write a number, true, \"text\", [list] or {key = value}\n");
  expect({"title", "1\nend_time = 3"},
         "-P title: cannot read the value '1\nend_time = 3'; write a number, true, \"text\", [list] or {key = value}\n");
  expect({"title", ""}, "-P title: cannot read the value ''; write a number, true, \"text\", [list] or {key = value}\n");
}

/// A word for the dimension is refused by itself where the scene has other coordinates: not each place of it.
TEST(Overrides, ADimensionInAWordNeedsItsCoordinates) {
  EXPECT_EQ(mistakes(two_gases, {{"dimension", "axisymmetric"}}),
            "-P dimension: dimension = \"axisymmetric\" is written with 3 coordinates a place, and this scene with 1; write its "
            "places, shapes and velocities with 3\n");
  EXPECT_EQ(mistakes(coupled_tube, {{"dimension", "plane"}}),
            "-P dimension: dimension = \"plane\" is written with 1 coordinates a place, and this scene with 3; write its places, "
            "shapes and velocities with 1\n");
}

TEST(Overrides, MistakesOfFileAndOptionTogether) {
  EXPECT_EQ(mistakes(with(two_gases, "density = 0.125", "densty = 0.125"), {{"scheme.eeta", "1"}}),
            "-P scheme.eeta: unknown key 'eeta' in scheme; did you mean 'eta'?\n"
            "17:1: unknown key 'densty' in bodies.right; did you mean 'density'?\n");
}

}  // namespace
