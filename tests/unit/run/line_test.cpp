// Scenes of one coordinate on the one-dimensional mesh: rest, conservation, waves with exact solutions, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/errors.hpp"
#include "exact/classical.hpp"
#include "exact/riemann.hpp"
#include "run/plane_wave_start.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

const std::string charge_in_a_case = R"(
end_time = 4e-5
dimension = "spherical"
[[bodies]]
name = "charge"
shape = {type = "sphere", radius = 0.01}
material = "petn"
[[solids]]
name = "case"
shape = {type = "sphere", radius = 0.011}
subtract = ["charge"]
material = "al-5083-h116"
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 0.06}
subtract = [{type = "sphere", radius = 0.011}]
material = "water-tait"
pressure = 1e5
[[bodies]]
name = "air"
shape = {type = "sphere", radius = 0.08}
subtract = [{type = "sphere", radius = 0.06}]
material = "air"
energy = 2e5
[[walls]]
name = "hull"
shape = {type = "sphere", radius = 0.08}
)";

/// Burn, all kinds of layers, merging of cells, a reflection at the end.
TEST(ALine, KeepsMassAndEnergyOfALayeredCharge) {
  Simulation simulation(read_text(charge_in_a_case, {{"resolution.spacing", "1e-4"}}));
  const std::size_t cells = simulation.line()->cells();
  run_to(simulation, 4e-5);
  EXPECT_LT(simulation.line()->cells(), cells);  // merged
  EXPECT_LT(std::abs(simulation.energy().error()), 1e-12);
  EXPECT_LT(simulation.mass_error(), 1e-14);
  EXPECT_GT(simulation.energy().plastic, 0.0);
  EXPECT_GT(simulation.energy().structure_kinetic, 0.0);
  const double mass = 4.0 / 3.0 * std::numbers::pi * 1e-6 * 1770.0;
  double charge = 0;
  const auto m = simulation.fluid_field("mass"), body = simulation.fluid_field("material");
  for (std::size_t i = 0; i < m.size(); ++i)
    if (body[i] == 0) charge += m[i];
  EXPECT_NEAR(charge / mass, 1.0, 1e-12);
  // As points of space: velocity away from the middle, whatever the direction.
  const FluidPoint one = simulation.line()->at({0, 0, 0.05}), other = simulation.line()->at({-0.03, 0, 0.04});
  EXPECT_DOUBLE_EQ(one.pressure, other.pressure);
  EXPECT_NEAR(one.velocity[2], -other.velocity[0] / 0.6, 1e-9 * std::abs(one.velocity[2]));
}

TEST(ALine, AtRestNothingMoves) {
  const scene::Scene scene = read_text(R"(
end_time = 1e-3
dimension = "spherical"
[resolution]
spacing = 1e-3
[[bodies]]
name = "inside"
shape = {type = "sphere", radius = 0.1}
material = "water-tait"
pressure = 1e7
[[bodies]]
name = "shell"
shape = {type = "sphere", radius = 0.3}
subtract = ["inside"]
material = "water-tait"
pressure = 1e7
[[walls]]
name = "tank"
shape = {type = "sphere", radius = 0.3}
)");
  Simulation simulation(scene);
  run_to(simulation, 1e-3);
  EXPECT_GT(simulation.steps(), 100);
  for (const double u : simulation.line()->mesh().node_velocity()) EXPECT_EQ(u, 0.0);
  EXPECT_EQ(simulation.energy().error(), 0.0);
}

/// A ball of radius R at a small overpressure P sends out p = P (r - c t)/(2 r) where |r - c t| < R (linear acoustics).
TEST(ALine, AcousticPulseFallsAsOneOverTheRadius) {
  const double over = 1e4, R = 0.1;
  const auto error = [&](double spacing) {
    Simulation simulation(read_text(R"(
end_time = 1e-3
dimension = "spherical"
[[bodies]]
name = "ball"
shape = {type = "sphere", radius = 0.1}
material = "water-tait"
pressure = 1.01e6
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 1.5}
subtract = ["ball"]
material = "water-tait"
pressure = 1e6
[[walls]]
name = "tank"
shape = {type = "sphere", radius = 1.5}
)",
                                    {{"resolution.spacing", std::to_string(spacing)}}));
    const double c = simulation.line()->mesh().cell_sound().back(), t = 0.7 / c;
    run_to(simulation, t);
    double sum = 0;
    int count = 0;
    for (double r = 0.45; r < 0.95; r += 0.5e-3, ++count) {
      const double exact = std::abs(r - c * t) < R ? 0.5 * over * (r - c * t) / r : 0.0;
      sum += std::abs(simulation.line()->at({0, r, 0}).pressure - 1e6 - exact);
    }
    return sum / count / (0.5 * over * R / 0.7);
  };
  const double coarse = error(1e-3), fine = error(2.5e-4);
  EXPECT_LT(fine, 0.03);
  EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 0.5);  // two jumps
}

/// Gas against water on a line, beside the exact solution.
TEST(ALine, PlaneRiemannProblemConverges) {
  const auto error = [&](double spacing) {
    const scene::Scene scene = read_text(R"(
end_time = 1e-4
dimension = "plane"
[[bodies]]
name = "gas"
shape = {type = "box", low = -0.3, high = 0}
material = {law = "ideal_gas", rho0 = 100, gamma = 1.4}
density = 100
energy = 2.5e6
[[bodies]]
name = "water"
shape = {type = "box", low = 0, high = 0.3}
material = "water-tait"
pressure = 1e5
[[walls]]
name = "ends"
shape = {type = "box", low = -0.3, high = 0.3}
)",
                                         {{"resolution.spacing", std::to_string(spacing)}});
    Simulation simulation(scene);
    run_to(simulation, 1e-4);
    const sph::Body &gas = scene.fluid.bodies[0], &water = scene.fluid.bodies[1];
    const exact::RiemannSolution exact({.law = gas.material.law, .density = 100, .velocity = 0, .energy = 2.5e6},
                                       {.law = water.material.law, .density = start_density(water), .velocity = 0, .energy = 0});
    double sum = 0;
    int count = 0;
    for (double x = -0.2; x < 0.2; x += 2e-4, ++count)
      sum += std::abs(simulation.line()->at({x, 0, 0}).pressure - exact.sample(x / 1e-4).pressure);
    EXPECT_LT(std::abs(simulation.energy().error()), 1e-12);
    return sum / count / 1e8;
  };
  const double coarse = error(1e-3), fine = error(2.5e-4);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log(coarse / fine) / std::log(4.0), 0.8);
}

const std::string plate_on_a_line = R"(
end_time = 2e-5
dimension = "plane"
[resolution]
spacing = 5e-5
[start]
kind = "plane_wave"
axis = "x"
front = 0.0
peak = 1e6
decay = 20e-6
[[bodies]]
name = "water"
shape = {type = "box", low = -0.05, high = 0}
material = "water-tait-cutoff"
pressure = 1
[[solids]]
name = "plate"
shape = {type = "box", low = 0, high = 0.00635}
material = {rho0 = 2700, young_modulus = 1e12, poisson_ratio = 0.33, flow = {law = "elastic"}}
[[probes]]
name = "plate"
kind = "structure"
point = 0.003
)";

/// A stiff free plate under an exponential wave: Taylor's velocity, until the water cavitates at it. What is left is the plate's
/// own ringing, which falls with its impedance.
TEST(ALine, PlateMovesAsTaylorsDoes) {
  const auto error = [](const std::string& young_modulus) {
    const scene::Override stiff{"solids.plate.material", "{rho0 = 2700, young_modulus = " + young_modulus +
                                                             ", poisson_ratio = 0.33, flow = {law = \"elastic\"}}"};
    scene::Scene scene = read_text(plate_on_a_line, {{"resolution.spacing", "1e-4"}, stiff});
    begin_with_plane_wave(scene);
    Simulation simulation(scene);
    const auto plate = simulation.line()->in_solid({0.003, 0, 0});
    const exact::TaylorPlate exact{
        .peak = 1e6, .decay = 20e-6, .impedance = plane_wave(scene).impedance(), .plate_mass = 2700 * 0.00635};
    const double end = 0.95 * exact.cavitation_time();
    double sum = 0;
    constexpr int samples = 40;
    for (int k = 1; k <= samples; ++k) {
      run_to(simulation, k * end / samples);
      sum += std::pow(plate().velocity[0] - exact.velocity(k * end / samples), 2);
    }
    EXPECT_LT(std::abs(simulation.energy().error()), 1e-12);
    EXPECT_LT(simulation.momentum_error(), 1e-12);
    return std::sqrt(sum / samples) / exact.velocity(end);
  };
  const double soft = error("1e12"), stiff = error("7e12");
  EXPECT_LT(soft, 0.015);
  EXPECT_LT(stiff, 0.6 * soft) << soft;
}

std::string refusal(const std::string& text, const std::vector<scene::Override>& overrides) {
  try {
    read_text(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// A sea under the atmosphere, 50 m deep, from its bottom up.
const std::string sea_on_a_line = R"(
end_time = 0.05
dimension = "plane"
gravity = [-9.81]
threads = 1
[resolution]
spacing = 0.1
[surroundings]
pressure = 1e5
[[bodies]]
name = "water"
shape = {type = "box", low = 0, high = 50}
material = "water-tait"
pressure = 1e5
level = 50
)";
const std::string bottom = R"(
[[walls]]
name = "bottom"
shape = {type = "box", low = 0, high = 60}
faces = {x_high = "open"}
)";
const std::string open_sea = R"(
[[walls]]
name = "sea"
shape = {type = "box", low = 0, high = 50}
condition = "radiating"
)";

/// What is left of motion is the mesh's second order in the column: a cell's pressure beside the mean of its column's.
TEST(ALine, AColumnRestsUnderGravity) {
  for (const std::string& end : {bottom, open_sea}) {
    Simulation simulation(read_text(sea_on_a_line + end));
    for (const double x : {0.5, 25.0, 49.0}) {
      const double depth = 50 - x, linear = 1e5 + 9.81 * 1000 * depth;
      EXPECT_NEAR(simulation.line()->at(Vec3(x, 0, 0)).pressure, linear, 3e-3 * linear);
    }
    run_to(simulation, 0.05);
    double fastest = 0;
    for (const double u : simulation.line()->mesh().node_velocity()) fastest = std::max(fastest, std::abs(u));
    EXPECT_LT(fastest, 1e-6);
    EXPECT_LT(std::abs(simulation.energy().error()), 1e-12);
  }
}

/// A plane wave on the column throws a plate that lies on it as Taylor's linear theory says, before weight and atmosphere matter.
TEST(ALine, AWaveOnTheColumnThrowsAPlate) {
  const std::string wave = R"(
[start]
kind = "plane_wave"
axis = "x"
front = 50
peak = 7e5
decay = 1e-3
[[solids]]
name = "plate"
shape = {type = "box", low = 50, high = 50.1}
material = {rho0 = 5000, young_modulus = 2e11, poisson_ratio = 0, flow = {law = "elastic"}}
[[probes]]
name = "plate"
kind = "structure"
point = 50.05
)";
  scene::Scene scene = read_text(sea_on_a_line + bottom + wave, {{"bodies.water.pressure", "104905"}});
  begin_with_plane_wave(scene);
  Simulation line(scene);
  EXPECT_NEAR(line.line()->at(Vec3(10, 0, 0)).pressure, 104905 + 40 * 9.81e3, 2e3);  // the wave's length ends far above
  const auto plate = line.line()->in_solid(Vec3(50.05, 0, 0));
  double fastest = 0;
  while (line.time() < 1e-3) {
    run_to(line, line.time() + 1e-5);
    fastest = std::max(fastest, plate().velocity[0]);
  }
  // (2 p0 theta/m) z^(z/(1 - z)), z = rho c theta/m
  const double z = 1000 * 1538 * 1e-3 / 500, largest = 2 * 7e5 * 1e-3 / 500 * std::pow(z, z / (1 - z));
  EXPECT_NEAR(fastest, largest, 0.005 * largest);
  EXPECT_LT(std::abs(line.energy().error()), 1e-8);
  EXPECT_LT(line.energy().gravity, 0.0);
}

/// A plate alone falls: its speed and energy are gravity's.
TEST(ALine, APlateAloneFalls) {
  Simulation simulation(read_text(R"(
end_time = 1e-3
dimension = "plane"
gravity = [-9.81]
[resolution]
spacing = 1e-3
[[solids]]
name = "plate"
shape = {type = "box", low = 0, high = 0.1}
material = {rho0 = 2700, young_modulus = 7e10, poisson_ratio = 0.33, flow = {law = "elastic"}}
)"));
  run_to(simulation, 1e-3);
  for (const double u : simulation.line()->mesh().node_velocity()) EXPECT_NEAR(u, -9.81e-3, 1e-9);
  EXPECT_NEAR(simulation.energy().gravity, 0.5 * 270 * std::pow(9.81e-3, 2), 1e-9);
  EXPECT_LT(std::abs(simulation.energy().error()), 1e-9);
  EXPECT_LT(simulation.momentum_error(), 1e-9);
}

TEST(ALine, RefusesWhatOneCoordinateHasNot) {
  EXPECT_EQ(refusal(charge_in_a_case, {}), "");
  EXPECT_EQ(refusal(plate_on_a_line, {}), "");
  using Settings = std::vector<scene::Override>;
  const std::vector<std::tuple<std::string, Settings, std::string>> all{
      {charge_in_a_case, {{"bodies.water.shape.center", "[0.01, 0, 0]"}}, "spheres about one middle"},
      {charge_in_a_case,
       {{"bodies.water.shape", "{type = \"box\", low = [-1, -1, -1], high = [1, 1, 1]}"}},
       "spheres about one middle"},
      {charge_in_a_case, {{"bodies.water.subtract", "[{type = \"sphere\", radius = 0.012}]"}}, "nothing between 0.011 and 0.012"},
      {charge_in_a_case, {{"bodies.water.subtract", "[\"charge\"]"}}, "something else lies between"},
      {charge_in_a_case, {{"walls.hull.shape.radius", "0.09"}}, "a layer that comes to a wall later is not built"},
      {charge_in_a_case, {{"gravity", "[0, 0, -9.81]"}}, "gravity has a direction"},
      {charge_in_a_case, {{"bodies.water.velocity", "[1, 0, 0]"}}, "has a direction"},
      {charge_in_a_case, {{"bodies.charge.burn", "{initiation = [0, 0, 0.005]}"}}, "begins in the middle"},
      {charge_in_a_case, {{"start.kind", "\"spherical\""}}, "the whole run is one-dimensional"},
      {charge_in_a_case, {{"solids.case.spin", "[1, 0, 0]"}}, "spin does not go with"},
      {charge_in_a_case,
       {{"symmetry.planes", "[\"x\"]"}, {"bodies.charge.shape.center", "[0.1, 0, 0]"}},
       "its middle must lie on every"},
      {charge_in_a_case, {{"resolution.spacing", "1e-12"}}, "cells, more than"},
      {plate_on_a_line, {{"bodies.water.radial_velocity", "1"}}, "take velocity"},
      {plate_on_a_line, {{"probes.plate.point", "-0.01"}}, "lies in no solid"},
      {plate_on_a_line, {{"probes.plate.point", "1"}}, "outside of the layers"},
  };
  for (const auto& [text, settings, what] : all) {
    const std::string said = refusal(text, settings);
    EXPECT_FALSE(said.empty()) << what;
    EXPECT_NE(said.find(what), std::string::npos) << said;
  }
  const scene::Scene warned = read_text(charge_in_a_case, {{"scheme.courant", "0.2"}, {"resolution.origin", "[0, 0, 0]"}});
  ASSERT_EQ(warned.warnings.size(), 1U);
  EXPECT_NE(warned.warnings[0].find("resolution.origin, scheme.courant"), std::string::npos) << warned.warnings[0];
}

}  // namespace
}  // namespace undex::run::test
