// What a run may begin from: spherical starts, and plane waves under gravity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "run/plane_wave_start.hpp"
#include "run/spherical_flow.hpp"
#include "run/spherical_start.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

const std::string bubble_in_a_tank = R"(
end_time = 1e-4
threads = 1
[resolution]
spacing = 0.004
[start]
kind = "spherical"
body = "bubble"
[[bodies]]
name = "bubble"
shape = {type = "sphere", radius = 0.01}
material = {law = "barotropic_gas", rho0 = 1400, p0 = 1.2e9, gamma = 2}
[[bodies]]
name = "water"
shape = {type = "box", low = [-0.06, -0.06, -0.06], high = [0.06, 0.06, 0.06]}
subtract = ["bubble", "other"]
material = "water-tait"
pressure = 1e5
[[bodies]]
name = "other"
shape = {type = "sphere", radius = 0.01, center = [0, 0, 0.045]}
material = "water-tait"
pressure = 1e5
)";
const std::string plate_beside = R"(
[structure]
shape = {type = "plate", low = [-0.06, -0.06, 0.06], high = [0.06, 0.06, 0.064]}
cells = {x = 4, y = 4, z = 1}
material = {rho0 = 2700, young_modulus = 7.1e10, poisson_ratio = 0.33, flow = {law = "elastic"}}
wet = ["z_low"]
)";

const std::string two_bubbles = R"(
end_time = 1e-4
threads = 1
[resolution]
spacing = 0.003
[symmetry]
planes = ["x", "y"]
[start]
kind = "spherical"
[[bodies]]
name = "upper"
shape = {type = "sphere", radius = 0.01, center = [0, 0, 0.03]}
material = {law = "ideal_gas", rho0 = 500, gamma = 2}
energy = 1e6
[[bodies]]
name = "lower"
shape = {type = "sphere", radius = 0.01, center = [0, 0, -0.03]}
material = {law = "ideal_gas", rho0 = 500, gamma = 2}
energy = 1e6
[[bodies]]
name = "water"
shape = {type = "cylinder", axis = "z", radius = 0.045, low = -0.075, high = 0.075}
subtract = ["upper", "lower"]
material = "water-tait"
pressure = 1e5
)";

std::string refusal(const std::string& text, const std::vector<scene::Override>& overrides) {
  scene::Scene scene = read_text(text, overrides);
  try {
    begin_spherically(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// Only the charge's flow is computed until the particles take over: whatever would not stay at rest until then is refused.
TEST(SphericalStart, RefusesWhatWouldNotRest) {
  EXPECT_EQ(refusal(bubble_in_a_tank, {}), "");
  const auto says = [](const std::string& text, const std::vector<scene::Override>& overrides, const char* what) {
    EXPECT_NE(refusal(text, overrides).find(what), std::string::npos) << refusal(text, overrides);
  };
  says(bubble_in_a_tank, {{"bodies.other.pressure", "1.2e7"}}, "'other' begins at 1.2e+07 Pa");
  says(bubble_in_a_tank, {{"bodies.other.velocity", "[0, 0, 10]"}}, "'other' moves");
  const std::string coupled = bubble_in_a_tank + plate_beside;
  EXPECT_EQ(refusal(coupled, {}), "");
  EXPECT_EQ(refusal(coupled, {{"structure.loads", "[{face = \"z_high\", time = [0], pressure = [1e5]}]"}}), "");
  says(coupled, {{"structure.velocity", "[0, 0, 1]"}}, "velocity");
  says(coupled, {{"structure.loads", "[{face = \"z_high\", time = [0], pressure = [1e7]}]"}}, "a load of 1e+07 Pa");
  EXPECT_THROW(read_text(bubble_in_a_tank, {{"start.time", "1"}}), SceneError);
}

/// Under gravity the flow is that of the medium at the charge's depth, and the column's pressure beyond that is added to it.
TEST(SphericalStart, OnAHydrostaticColumn) {
  const double g = 1e5;
  scene::Scene scene = read_text(
      bubble_in_a_tank, {{"gravity", "[0, 0, -1e5]"}, {"bodies.water.level", "0.06"}, {"bodies.other.pressure", "1.6e6"}});
  const materials::FluidLaw law = scene.fluid.bodies[1].material.law;
  const Vec3 down(0, 0, -1);
  const materials::HydrostaticColumn column(law, 0, 1e5, g, 0, 0.12);
  begin_spherically(scene);
  const double rest = *scene.fluid.bodies[1].start->rest_pressure;
  EXPECT_NEAR(rest / column.pressure(0.06), 1.0, 1e-9);
  // What the one-dimensional flow has at a place, and the weight.
  const auto flow = scene.fluid.bodies[1].start->state;
  Simulation simulation(scene);
  const auto x = simulation.fluid()->field("position"), p = simulation.fluid()->field("pressure"),
             body = simulation.fluid()->field("material");
  int in_the_wave = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 place(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
    if (body[i] != 1) continue;
    const double alone = std::visit([&](const auto& each) { return each.evaluate(flow(place, 0.004).density, 0).pressure; }, law);
    const double more = column.pressure(0.06 - place[2]) - rest;
    if (alone > 10 * rest) ++in_the_wave;
    if (alone + more > 2e5) {
      EXPECT_NEAR(p[i], alone + more, 1e-6 * std::abs(alone) + 1.0) << place.transpose();
    }
  }
  EXPECT_GT(in_the_wave, 20);
  run_to(simulation, simulation.time() + 5e-6);
  EXPECT_LT(std::abs(simulation.energy().error()), 0.01);
  EXPECT_NE(simulation.energy().gravity, 0.0);
}

TEST(SphericalStart, ChargesOfOneDepthOnly) {
  const std::vector<scene::Override> deep{{"gravity", "[0, 0, -1e5]"}, {"bodies.water.level", "0.075"}};
  EXPECT_NE(refusal(two_bubbles, deep).find("lie in water under other pressures"), std::string::npos)
      << refusal(two_bubbles, deep);
}

/// A load that balances the water's pressure does not push the plate before the water is there.
TEST(SphericalStart, LoadsWaitForTheWater) {
  scene::Scene scene =
      read_text(bubble_in_a_tank + plate_beside, {{"structure.loads", "[{face = \"z_high\", time = [0], pressure = [1e5]}]"}});
  begin_spherically(scene);
  const Simulation simulation(scene);
  EXPECT_GT(simulation.time(), 1e-6);
  EXPECT_EQ(simulation.bodies().front()->time(), simulation.time());
  EXPECT_EQ(simulation.bodies().front()->ledger().momentum, Vec3(0, 0, 0));
}

double mass_of(const Simulation& simulation, int body) {
  const auto mass = simulation.fluid()->field("mass"), material = simulation.fluid()->field("material");
  double sum = 0;
  for (std::size_t i = 0; i < mass.size(); ++i)
    if (material[i] == body) sum += mass[i];
  return sum;
}

/// Masses are those of time zero, and so is all energy: nothing has left. In space and about the axis through both.
TEST(SphericalStart, SeveralChargesEachHaveAFlow) {
  double kinetic[2];
  for (const bool ring : {false, true}) {
    std::vector<scene::Override> overrides{{"dimension", ring ? "\"axisymmetric\"" : "3"}, {"start.time", "5e-6"}};
    scene::Scene scene = read_text(two_bubbles, overrides);
    const std::string report = begin_spherically(scene);
    EXPECT_NE(report.find("'upper'"), std::string::npos) << report;
    EXPECT_NE(report.find("'lower'"), std::string::npos) << report;
    Simulation both(scene);
    const Simulation plain(read_text(two_bubbles, {overrides[0], {"start.kind", "\"plain\""}}));
    for (const int body : {0, 1, 2}) EXPECT_NEAR(mass_of(both, body) / mass_of(plain, body), 1.0, 2e-5);
    EXPECT_NEAR(both.energy().total() / plain.energy().total(), 1.0, 2e-5);
    kinetic[ring] = both.energy().kinetic;
    run_to(both, both.time() + 4e-6);
    EXPECT_LT(std::abs(both.energy().error()), 2e-3);
    if (ring) {
      EXPECT_LT(both.momentum_error(), 1e-8);
    }
  }
  EXPECT_NEAR(kinetic[1] / kinetic[0], 1.0, 0.02);
}

/// A plane of symmetry beside a charge stands for a second one: the same time, and half of everything.
TEST(SphericalStart, APlaneBesideAChargeStandsForItsImage) {
  std::string half = two_bubbles;
  half.replace(half.find("[\"x\", \"y\"]"), 10, "[\"x\", \"y\", \"z\"]");
  const std::size_t from = half.find("[[bodies]]\nname = \"lower\""), to = half.find("[[bodies]]\nname = \"water\"");
  half.erase(from, to - from);
  half.replace(half.find("[\"upper\", \"lower\"]"), 18, "[\"upper\"]");
  scene::Scene one = read_text(half), two = read_text(two_bubbles);
  begin_spherically(one);
  begin_spherically(two);
  EXPECT_NEAR(one.fluid.start_time / two.fluid.start_time, 1.0, 5e-3);  // a look at the fronts
  EXPECT_LT(two.fluid.start_time, 0.02 / 1500);
  const Simulation mirrored(one), whole(two);
  EXPECT_NEAR(mirrored.energy().kinetic / whole.energy().kinetic, 1.0, 1e-2);
  EXPECT_NEAR(2.0 * mass_of(mirrored, 1) / mass_of(whole, 2), 1.0, 1e-5);
}

TEST(SphericalStart, RefusesChargesWhoseWavesMeetTooSoon) {
  const auto says = [](const std::vector<scene::Override>& overrides, const char* what) {
    EXPECT_NE(refusal(two_bubbles, overrides).find(what), std::string::npos) << refusal(two_bubbles, overrides);
  };
  says({{"start.time", "1.5e-5"}}, "the waves of two charges have met");
  says({{"start.body", "\"upper\""}}, "'lower' begins at");
  says({{"bodies.upper.shape.center", "[0, 0, 0]"}, {"bodies.lower.shape.center", "[0, 0, -0.022]"}}, "too near to the charge");
}

/// A ball of gas in water to `wide` about it and to `top` above it, closed as `walls` say; in a quarter.
std::string ball_in_a_box(double wide, double top, const std::string& walls) {
  const std::string w = std::to_string(wide), box = "shape = {type = \"box\", low = [-" + w + ", -" + w + ", -" + w +
                                                    "], high = [" + w + ", " + w + ", " + std::to_string(top) + "]}\n";
  return R"(
end_time = 1e-4
threads = 1
[resolution]
spacing = 0.003
origin = [0, 0, 0]
[symmetry]
planes = ["x", "y"]
[start]
kind = "spherical"
[[bodies]]
name = "gas"
shape = {type = "sphere", radius = 0.009}
material = {law = "ideal_gas", rho0 = 1000, gamma = 2}
energy = 1e6
[[bodies]]
name = "water"
subtract = ["gas"]
material = "water-tait"
pressure = 1e5
)" + box +
         (walls.empty() ? "" : "[[walls]]\nname = \"sea\"\n" + box + walls);
}
const std::string rigid_ball = R"(
[[obstacles]]
name = "ball"
shape = {type = "sphere", center = [0, 0, 0.054], radius = 0.009}
)";

/// The largest difference of pressure in two simulations at a place, and the largest pressure.
std::pair<double, double> difference(Simulation& one, Simulation& other, const Vec3& x, double end) {
  double most = 0, peak = 0;
  for (double t = one.time(); t < end; t += 5e-7) {
    run_to(one, t);
    run_to(other, t);
    const double p = one.fluid()->at(x).pressure, q = other.fluid()->at(x).pressure;
    most = std::max(most, std::abs(p - q));
    peak = std::max(peak, q);
  }
  return {most, peak};
}

/// A radiating face ends no flow: the particles take over when the wave nears the ball, long after it has left at the sides.
TEST(SphericalStart, RadiatingFacesAreNoObstacles) {
  scene::Scene box = read_text(ball_in_a_box(0.03, 0.075, "condition = \"radiating\"\n") + rigid_ball),
               sea = read_text(ball_in_a_box(0.075, 0.075, "") + rigid_ball);
  const std::string report = begin_spherically(box);
  EXPECT_NE(report.find("of 45.00 mm"), std::string::npos) << report;
  begin_spherically(sea);
  EXPECT_NEAR(box.fluid.start_time / sea.fluid.start_time, 1.0, 1e-9);
  EXPECT_EQ(box.fluid.bodies[1].start->mass, 0.0);  // the wave has left
  EXPECT_GT(sea.fluid.bodies[1].start->mass, 0.0);
  Simulation here(box), there(sea);
  const auto before_ball = difference(here, there, Vec3(0.006, 0.006, 0.03), here.time() + 1.5e-5);
  RecordProperty("share_of_the_peak", std::to_string(before_ball.first / before_ball.second));
  EXPECT_LT(before_ball.first, 0.03 * before_ball.second);
  EXPECT_LT(std::abs(here.energy().error()), 5e-3);
}

/// A body that is drawn on the kept side of the symmetry planes only goes on beyond them, and so do its walls.
TEST(SphericalStart, BodiesMayEndAtSymmetryPlanes) {
  for (const char* walls : {"condition = \"radiating\"\n", "condition = \"free_slip\"\n"}) {
    scene::Scene whole = read_text(ball_in_a_box(0.03, 0.06, walls));
    scene::Scene kept = read_text(ball_in_a_box(0.03, 0.06, walls),
                                  {{"bodies.water.shape.low", "[0, 0, -0.03]"}, {"walls.sea.shape.low", "[0, 0, -0.03]"}});
    begin_spherically(whole);
    begin_spherically(kept);
    EXPECT_EQ(kept.fluid.start_time, whole.fluid.start_time);
    for (std::size_t b : {0, 1})  // to how exactly the mass in the box is integrated
      EXPECT_NEAR(kept.fluid.bodies[b].start->mass / whole.fluid.bodies[b].start->mass, 1.0, 1e-6);
    const double early = 0.9 * whole.fluid.start_time;
    EXPECT_NO_THROW(read_text(ball_in_a_box(0.03, 0.06, walls), {{"bodies.water.shape.low", "[0, 0, -0.03]"},
                                                                 {"walls.sea.shape.low", "[0, 0, -0.03]"},
                                                                 {"start.time", std::to_string(early)}}));
  }
}

TEST(SphericalStart, WarnsOfAGasOfFewSpacings) {
  const auto warnings = [](const char* spacing) {
    scene::Scene scene = read_text(ball_in_a_box(0.06, 0.06, ""), {{"resolution.spacing", spacing}, {"start.time", "1e-6"}});
    begin_spherically(scene);
    return scene.warnings;
  };
  EXPECT_TRUE(warnings("0.002").empty());
  ASSERT_EQ(warnings("0.003").size(), 1u);
  EXPECT_NE(warnings("0.003")[0].find("bodies.gas: its gas has a radius of 3"), std::string::npos) << warnings("0.003")[0];
}

/// With start.time as late as one likes, as long as the gas is inside; without one when the wave nears the face.
TEST(SphericalStart, TheWaveMayHaveLeft) {
  const std::string radiating = ball_in_a_box(0.03, 0.06, "condition = \"radiating\"\n");
  scene::Scene at_the_face = read_text(radiating);
  begin_spherically(at_the_face);
  EXPECT_LT(at_the_face.fluid.start_time, 0.02 / 1500);
  EXPECT_GT(at_the_face.fluid.bodies[1].start->mass, 0.0);
  const std::vector<scene::Override> late{{"start.time", "3e-5"}};
  scene::Scene box = read_text(radiating, late), sea = read_text(ball_in_a_box(0.09, 0.09, ""), late);
  begin_spherically(box);
  begin_spherically(sea);
  EXPECT_EQ(box.fluid.bodies[1].start->mass, 0.0);
  EXPECT_NEAR(box.fluid.bodies[0].start->mass / sea.fluid.bodies[0].start->mass, 1.0, 1e-12);
  Simulation here(box), there(sea);
  for (const Vec3& x : {Vec3(0.021, 0.003, 0.003), Vec3(0.003, 0.003, 0.045)}) {
    EXPECT_NEAR(here.fluid()->at(x).pressure / there.fluid()->at(x).pressure, 1.0, 0.01);
    EXPECT_NEAR(here.fluid()->at(x).velocity.norm() / there.fluid()->at(x).velocity.norm(), 1.0, 0.01);
  }
  const auto [most, peak] = difference(here, there, Vec3(0.012, 0.012, 0.03), 4.5e-5);
  RecordProperty("share_of_the_peak", std::to_string(most / peak));
  EXPECT_LT(most, 0.05 * peak);
  const auto says = [&](const std::string& text, const std::vector<scene::Override>& overrides, const char* what) {
    EXPECT_NE(refusal(text, overrides).find(what), std::string::npos) << refusal(text, overrides);
  };
  says(radiating, {{"bodies.gas.shape.center", "[0, 0, -0.015]"}}, "radiating face is too near to the charge");
  EXPECT_THROW(read_text(ball_in_a_box(0.03, 0.06, "faces = {x_high = \"open\"}\ncondition = \"radiating\"\n"), late),
               SceneError);
}

/// Twice as far costs a fixed number of steps more, not four times the work.
TEST(SphericalStart, CostGrowsWithTheLogarithmOfTheWay) {
  const scene::Scene scene = read_text(bubble_in_a_tank);
  long steps[3];
  int cells[3];
  for (int k = 0; k < 3; ++k) {
    const double outer = 0.01 * (10 << k);
    SphericalFlow flow(scene, outer, 30);
    flow.advance(0.8 * outer / 1500);
    steps[k] = flow.mesh().steps();
    cells[k] = flow.mesh().cells();
    RecordProperty("steps_" + std::to_string(k), std::to_string(steps[k]) + " " + std::to_string(cells[k]));
  }
  EXPECT_LT(steps[2] - steps[1], 1.5 * (steps[1] - steps[0]));
  EXPECT_LT(cells[2], 1.5 * cells[0]);
}

/// A plane wave on a hydrostatic column: pressures of both, and the column at rest where the wave has not come.
TEST(PlaneWaveStart, OnAHydrostaticColumn) {
  const std::string text = R"(
dimension = 1
end_time = 1e-3
gravity = [-9810]
[resolution]
spacing = 0.01
[start]
kind = "plane_wave"
axis = "x"
front = -1
peak = 1e6
decay = 2e-4
[[bodies]]
name = "water"
shape = {type = "box", low = -4, high = 0}
material = "water-tait"
pressure = 1e5
level = 0
[[walls]]
name = "tank"
shape = {type = "box", low = -4, high = 1}
faces = {x_high = "open"}
)";
  scene::Scene scene = read_text(text);
  begin_with_plane_wave(scene);
  Simulation simulation(scene);
  // 1000 g: 9.81 MPa a metre.
  EXPECT_NEAR(simulation.fluid()->at(Vec3(-0.5, 0, 0)).pressure, 1e5 + 9.81e6 * 0.5, 0.03e6);
  const double behind = 0.5, length = 2e-4 * plane_wave(scene).rest_sound();
  EXPECT_NEAR(simulation.fluid()->at(Vec3(-1.5, 0, 0)).pressure, 1e5 + 9.81e6 * 1.5 + 1e6 * std::exp(-behind / length), 0.06e6);
  run_to(simulation, 2e-4);
  EXPECT_LT(std::abs(simulation.energy().error()), 0.002);
  // Ahead of the wave nothing has moved.
  EXPECT_LT(std::abs(simulation.fluid()->at(Vec3(-0.5, 0, 0)).velocity[0]), 0.02);
}

}  // namespace
}  // namespace undex::run::test
