// What is noted of a run beside probes and energies: bodies as wholes, bubbles, largest values, forces on faces, profiles along
// lines, the one-dimensional flow at probes; and that all of it goes on after a cut.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "output/checkpoint.hpp"
#include "run/body_history.hpp"
#include "run/observer.hpp"
#include "run/starts.hpp"
#include "run/validity.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

namespace fs = std::filesystem;
using output::Samples;

class Histories : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_ = fs::temp_directory_path() / ("undex_histories_" + std::to_string(getpid()));

  /// A run to the end of the scene, without a program round it.
  struct Observed {
    output::Evidence evidence;
    output::RunRecord record;
  };
  Observed observed(const scene::Scene& read) {
    scene::Scene scene = read;
    begin(scene, {.numerics = "", .output = ""});
    Simulation simulation(scene);
    Observer observer(scene, read, simulation, folder_, false);
    observer.begin(simulation);
    while (simulation.time() < scene.end_time * (1 - 1e-12)) {
      simulation.advance(std::min(scene.end_time, observer.next_snapshot()));
      observer.observe(simulation);
    }
    Observed all{.evidence = observer.evidence(simulation, {}), .record = {}};
    observer.add_to(all.record);
    return all;
  }
};

double last(const Samples& samples, const std::string& column) { return samples.series(column).y.back(); }

const std::string ball_in_an_octant = R"(
end_time = 1e-6
threads = 1
[resolution]
spacing = 0.1
[symmetry]
planes = ["x", "y", "z"]
[[bodies]]
name = "ball"
shape = {type = "sphere", radius = 1}
material = {base = "water-tait", A = 0, cavitation = "none"}
)";

/// Water without pressure stays as it is.
TEST_F(Histories, VolumeOfABallAtRest) {
  const Samples bodies = observed(read_text(ball_in_an_octant)).evidence.bodies;
  Simulation simulation(read_text(ball_in_an_octant));
  const double mass = 8.0 * simulation.fluid()->ledger().mass;
  EXPECT_NEAR(last(bodies, "ball.volume") / (mass / 1000.0), 1.0, 1e-9);
  EXPECT_NEAR(last(bodies, "ball.volume") / (4.0 / 3.0 * std::numbers::pi), 1.0, 0.02);  // as particles fill it
  EXPECT_NEAR(std::pow(last(bodies, "ball.radius"), 3) * 4.0 / 3.0 * std::numbers::pi / last(bodies, "ball.volume"), 1.0, 1e-12);
  for (const char* axis : {"x", "y", "z"}) EXPECT_EQ(last(bodies, std::string("ball.centre_") + axis), 0.0);
  EXPECT_EQ(last(bodies, "ball.cavitated_volume"), 0.0);
}

const std::string moving_block = R"(
dimension = 2
end_time = 1e-3
threads = 1
[resolution]
spacing = 0.1
[[bodies]]
name = "block"
shape = {type = "box", low = [0, 0], high = [1, 2]}
material = {base = "water-tait", A = 0, cavitation = "none"}
velocity = [3, -4]
)";

TEST_F(Histories, ABlockInUniformMotion) {
  const Samples bodies = observed(read_text(moving_block)).evidence.bodies;
  EXPECT_NEAR(last(bodies, "block.volume"), 2.0, 1e-11);
  EXPECT_NEAR(last(bodies, "block.radius"), std::sqrt(2.0 / std::numbers::pi), 1e-11);
  EXPECT_NEAR(last(bodies, "block.centre_x"), 0.5 + 3e-3, 1e-12);
  EXPECT_NEAR(last(bodies, "block.centre_y"), 1.0 - 4e-3, 1e-12);
  EXPECT_NEAR(last(bodies, "block.kinetic") / (0.5 * 2000.0 * 25.0), 1.0, 1e-12);
}

const std::string charge = R"(
end_time = 2e-5
threads = 1
[resolution]
spacing = 0.004
[symmetry]
planes = ["x", "y", "z"]
[[bodies]]
name = "charge"
shape = {type = "sphere", radius = 0.012}
material = "petn"
burn = "instantaneous"
[[bodies]]
name = "water"
shape = {type = "sphere", radius = 0.06}
subtract = ["charge"]
material = "water-tait"
pressure = 1e5
[[probes]]
name = "near"
point = [0.03, 0, 0]
)";

TEST_F(Histories, BodiesSumUpToTheLedger) {
  for (const char* dimension : {"3", "\"axisymmetric\"", "\"spherical\""}) {
    std::vector<scene::Override> overrides{{"dimension", dimension}};
    if (dimension[1] == 's') overrides.push_back({"resolution.spacing", "3e-4"});
    const Observed run = observed(read_text(charge, overrides));
    const Samples &bodies = run.evidence.bodies, &energy = run.evidence.energy;
    ASSERT_GT(bodies.rows(), 3u);
    EXPECT_EQ(bodies.values[0].back(), energy.values[0].back());
    for (const char* part : {"kinetic", "internal"}) {
      const auto a = bodies.series(std::string("charge.") + part).y, b = bodies.series(std::string("water.") + part).y,
                 t = bodies.values[0];
      const output::Series all = energy.series(part);
      const double scale = *std::max_element(all.y.begin(), all.y.end());
      for (std::size_t i = 0; i < t.size(); ++i)
        EXPECT_NEAR((a[i] + b[i]) / scale, value_at(all, t[i]) / scale, 1e-12) << dimension;
    }
    // The run is a sphere's, whichever part of it is computed.
    const double mass = 1770.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.012, 3);
    EXPECT_NEAR(bodies.series("charge.volume").y.front() * 1770.0 / mass, 1.0, 0.03) << dimension;
    EXPECT_GT(last(bodies, "charge.radius"), 0.018) << dimension;
    EXPECT_LT(last(bodies, "charge.radius"), 0.03) << dimension;
    ASSERT_EQ(run.record.bubbles.size(), 1u);
    EXPECT_TRUE(std::isnan(run.record.bubbles[0].largest_radius_m));
    EXPECT_NE(run.record.bubbles[0].missing, "");
  }
}

TEST_F(Histories, LargestValuesAreThoseOfTheFields) {
  scene::Scene scene = read_text(charge);
  Simulation simulation(scene);
  double pressure = -1e300, speed = 0, time = 0;
  Vec3 place = Vec3::Zero();
  const auto look = [&] {
    const auto p = simulation.fluid_field("pressure"), v = simulation.fluid_field("velocity"),
               body = simulation.fluid_field("material"), x = simulation.fluid_field("position");
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (body[i] != 1) continue;
      if (p[i] > pressure) {
        pressure = p[i];
        time = simulation.time();
        place = Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
      }
      speed = std::max(speed, std::sqrt(v[3 * i] * v[3 * i] + v[3 * i + 1] * v[3 * i + 1] + v[3 * i + 2] * v[3 * i + 2]));
    }
  };
  look();
  while (simulation.time() < scene.end_time * (1 - 1e-12)) {
    simulation.advance(scene.end_time);
    look();
  }
  for (const output::LargestRecord& each : observed(scene).record.largest) {
    if (each.part != "water") continue;
    if (each.quantity == "speed") {
      EXPECT_EQ(each.value, speed);
    }
    if (each.quantity != "pressure") continue;
    EXPECT_EQ(each.value, pressure);
    EXPECT_EQ(each.time_s, time);
    // One of several particles by symmetry.
    EXPECT_NEAR(Vec3(each.place[0], each.place[1], each.place[2]).norm(), place.norm(), 1e-6);
  }
}

const std::string sloshing = R"(
dimension = 2
end_time = 2e-3
threads = 1
[resolution]
spacing = 0.05
[scheme]
precision = "full"
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0], high = [1, 0.5]}
material = "water-tait"
pressure = 1e5
velocity = [2, -1]
[[walls]]
name = "tank"
shape = {type = "box", low = [0, 0], high = [1, 0.5]}
faces = {y_high = "open"}
[output]
histories = ["forces"]
)";

/// What the water has lost of its momentum the walls have received, face by face.
TEST_F(Histories, ForcesOnWallsTakeTheMomentum) {
  for (const char* integrator : {"\"leapfrog\"", "\"ssp_rk3\""})
    for (const char* shape : {"box", "cylinder"}) {
      std::vector<scene::Override> overrides{{"scheme.integrator", integrator}};
      const bool round = *shape == 'c';
      if (round) {
        overrides.push_back({"bodies.water.shape", "{type = \"cylinder\", radius = 0.5}"});
        overrides.push_back({"walls.tank.shape", "{type = \"cylinder\", radius = 0.5}"});
        overrides.push_back({"walls.tank.faces", "{side = \"free_slip\"}"});
      }
      const scene::Scene scene = read_text(sloshing, overrides);
      Simulation simulation(scene);
      const Vec3 start = simulation.fluid()->ledger().momentum;
      const Samples forces = observed(scene).evidence.forces;
      run_to(simulation, scene.end_time);
      const Vec3 lost = start - simulation.fluid()->ledger().momentum;
      Vec3 received = Vec3::Zero();
      for (const Vec3& face : simulation.fluid()->on_fixed_faces()) received += face;
      EXPECT_GT(lost.norm(), 0.1 * start.norm());
      EXPECT_NEAR((lost - received).norm() / start.norm(), 0.0, 1e-12) << integrator << shape;
      if (round) {
        EXPECT_NEAR(last(forces, "walls.side.impulse_x"), received[0], 1e-9 * start.norm());
        continue;
      }
      EXPECT_NEAR(last(forces, "walls.x_low.impulse_x") + last(forces, "walls.x_high.impulse_x"), lost[0], 1e-9 * start.norm());
      EXPECT_NEAR(last(forces, "walls.y_low.impulse_y"), lost[1], 1e-9 * start.norm());
      EXPECT_GT(last(forces, "walls.x_high.impulse_x"), 0.0);
      EXPECT_LT(last(forces, "walls.x_low.impulse_x"), 0.0);
      // The force is the impulse's growth.
      const auto t = forces.series("walls.x_high.force_x").t, force = forces.series("walls.x_high.force_x").y;
      double sum = 0;
      for (std::size_t i = 1; i < t.size(); ++i) sum += force[i] * (t[i] - t[i - 1]);
      EXPECT_NEAR(sum / last(forces, "walls.x_high.impulse_x"), 1.0, 1e-12);
    }
}

/// Also where a body takes steps of its own.
TEST_F(Histories, ForcesOnWallsWithLocalSteps) {
  const scene::Scene scene = read_text(R"(
dimension = 2
end_time = 3e-4
threads = 1
[resolution]
spacing = 0.05
[scheme]
precision = "full"
local_steps = true
[[bodies]]
name = "gas"
shape = {type = "cylinder", center = [0.3, 0.4], radius = 0.12}
material = {law = "barotropic_gas", rho0 = 50, p0 = 2e8, gamma = 1.4}
spacing = 0.02
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0], high = [1, 1]}
subtract = ["gas"]
material = "water-tait"
pressure = 1e5
[[walls]]
name = "tank"
shape = {type = "box", low = [0, 0], high = [1, 1]}
)");
  Simulation simulation(scene);
  run_to(simulation, scene.end_time);
  EXPECT_GT(simulation.fluid()->substeps(), 0);
  Vec3 received = Vec3::Zero();
  double exchanged = 0;
  for (const Vec3& face : simulation.fluid()->on_fixed_faces()) {
    received += face;
    exchanged += face.norm();
  }
  EXPECT_GT(exchanged, 0.0);
  EXPECT_NEAR((received + simulation.fluid()->ledger().momentum).norm() / exchanged, 0.0, 1e-12);
}

TEST_F(Histories, ForceOnAStructureIsWhatItReceives) {
  const scene::Scene scene =
      read_text(plate_on_water,
                {{"end_time", "2e-5"}, {"bodies.water.pressure", "1e6"}, {"output.histories", "[\"forces\", \"largest\"]"}});
  const Observed run = observed(scene);
  Simulation simulation(scene);
  run_to(simulation, 2e-5);
  const Vec3 given = simulation.on_structure()->impulse_received;
  EXPECT_GT(given[2], 0.0);
  EXPECT_NEAR(last(run.evidence.forces, "structure.impulse_z") / given[2], 1.0, 1e-12);
  EXPECT_GT(last(run.evidence.forces, "walls.z_low.impulse_z"), -1e300);
  bool plate = false;
  for (const output::LargestRecord& each : run.record.largest) plate = plate || (each.part == "structure" && each.value > 0);
  EXPECT_TRUE(plate);
}

/// A velocity that grows with the place, read at places about which particles lie evenly.
/// A block that hangs into the water: its bottom and its sides are faces of their own.
TEST_F(Histories, ForcesOnFacesAreThoseOfTheStructure) {
  const auto block = [](const std::string& table, const std::string& floor, const std::string& more) {
    return R"(
end_time = 2e-5
threads = 1
[resolution]
spacing = 0.01
[[bodies]]
name = "water"
shape = {type = "box", low = [0, 0, -0.1], high = [0.1, 0.1, 0]}
subtract = [{type = "box", low = [0, 0, -0.05], high = [0.05, 0.05, 0.05]}]
material = "water-tait"
pressure = 2e6
[[walls]]
name = "tank"
shape = {type = "box", low = [0, 0, -0.1], high = [0.1, 0.1, 0.1]}
faces = {z_high = "open")" +
           floor + R"(}
[symmetry]
planes = ["x", "y"]
)" + table +
           R"(
name = "block"
shape = {type = "plate", low = [-0.05, -0.05, -0.05], high = [0.05, 0.05, 0.05]}
cells = {x = 10, y = 10, z = 10}
material = "al-6061-t6"
wet = ["z_low", "x_high", "y_high"]
[output]
histories = ["forces"]
)" + more;
  };
  const Samples one = observed(read_text(block("[structure]", "", ""))).evidence.forces;
  for (char axis : {'x', 'y', 'z'}) {
    const std::string column = std::string(".impulse_") + axis;
    double sum = 0;
    for (const char* face : {"z_low", "x_high", "y_high"}) sum += last(one, std::string("structure.") + face + column);
    EXPECT_NEAR(sum / last(one, "structure" + column), 1.0, 1e-12) << axis;
  }
  EXPECT_GT(last(one, "structure.z_low.impulse_z"), 0.9 * last(one, "structure.impulse_z"));
  EXPECT_LT(last(one, "structure.x_high.impulse_x"), 0.9 * last(one, "structure.impulse_x"));
  EXPECT_NEAR(last(one, "structure.x_high.impulse_x") / last(one, "structure.y_high.impulse_y"), 1.0, 1e-3);
  EXPECT_LT(last(one, "structure.x_high.impulse_x"), 0.0);

  const std::string other = R"(
[[structures]]
name = "other"
shape = {type = "plate", low = [-0.1, -0.1, -0.11], high = [0.1, 0.1, -0.1]}
cells = {x = 8, y = 8, z = 2}
material = "al-6061-t6"
wet = ["z_high"]
)";
  const Samples two = observed(read_text(block("[[structures]]", ", z_low = \"open\"", other))).evidence.forces;
  for (const char* column : {"z_low.impulse_z", "x_high.impulse_x"})
    EXPECT_NEAR(last(two, std::string("structures.block.") + column) / last(one, std::string("structure.") + column), 1.0, 1e-3);
}

/// A set of the library is left where the largest pressure lies beyond its own; one's own set has none.
TEST(Validity, SaysWhichSetsWereLeft) {
  scene::Scene scene;
  const auto body = [&](const char* name, const char* material, double pressure) {
    sph::Body& added = scene.fluid.bodies.emplace_back();
    added.name = name;
    added.material.name = material;
    return output::LargestRecord{.part = name, .quantity = "pressure", .value = pressure, .place = {0.1, 0, 0}, .time_s = 2e-6};
  };
  const std::vector<output::LargestRecord> largest{body("near", "water-tait", 3e9),
                                                   body("far", "water-tait", 1.04e9),
                                                   body("other", "water-steinberg", 3e9),
                                                   body("own", "my water", 3e9),
                                                   {.part = "near", .quantity = "speed", .value = 5e9, .place = {}, .time_s = 0}};
  EXPECT_EQ(
      beyond_validity(scene, largest),
      std::vector<std::string>{"bodies.near reached 3 GPa at (0.1, 0, 0) m, 2e-06 s, beyond the 1 GPa to which 'water-tait' "
                               "may be used; 'undex materials --kind water' shows sets that go further"});
  EXPECT_TRUE(beyond_validity(scene, {}).empty());
}

TEST_F(Histories, ProfileOfALinearFieldIsExact) {
  const scene::Scene scene = read_text(
      R"(
dimension = 2
end_time = 1e-9
threads = 1
[resolution]
spacing = 0.1
[[bodies]]
name = "water"
shape = {type = "box", low = [-2, -2], high = [2, 2]}
material = {base = "water-tait", A = 0, cavitation = "none"}
radial = {speed = 5, radius = 1, power = 1}
[[lines]]
name = "across"
from = [-1, 0.3]
to = [3, 0.3]
points = 41
quantities = ["velocity", "pressure"]
times = [0]
)");
  const Samples profile = observed(scene).evidence.lines.at("across");
  ASSERT_EQ(profile.rows(), 41u);
  for (std::size_t i = 0; i < profile.rows(); ++i) {
    const double x = profile.values[2][i], velocity = profile.values[4][i];
    EXPECT_NEAR(x, -1.0 + 0.1 * double(i), 1e-12);
    EXPECT_NEAR(profile.values[1][i], 0.1 * double(i), 1e-12);
    if (x < 1.6) {
      EXPECT_NEAR(velocity, 5.0 * x, 1e-11);
    } else if (x > 2.4) {
      EXPECT_TRUE(std::isnan(velocity));  // no fluid
    }
  }
}

/// On the mesh of one coordinate the run is nearly the reference; a wall sends it back.
TEST_F(Histories, OneDimensionalFlowAtProbes) {
  const std::vector<scene::Override> overrides{{"dimension", "\"spherical\""},
                                               {"resolution.spacing", "5e-5"},
                                               {"end_time", "6e-5"},
                                               {"output.histories", "[\"one_dimensional\"]"}};
  const auto probes = observed(read_text(charge, overrides)).evidence.probes;
  const output::Series run = probes.at("near").series("pressure"), reference = probes.at("near_1d").series("pressure");
  ASSERT_FALSE(reference.empty());
  // The water ends at 60 mm: the wave comes there at about 17 us, and sound from there at about 32.
  EXPECT_GT(reference.t.back(), 24e-6);
  EXPECT_LT(reference.t.back(), 38e-6);
  const double peak = *std::max_element(run.y.begin(), run.y.end());
  double sum = 0;
  for (std::size_t i = 1; i < reference.t.size(); ++i)
    sum += std::abs(value_at(run, reference.t[i]) - reference.y[i]) * (reference.t[i] - reference.t[i - 1]);
  EXPECT_LT(sum / reference.t.back() / peak, 0.005);
  // Before anything has come back both are the same flow.
  EXPECT_NEAR(value_at(run, reference.t.back()) / peak, reference.y.back() / peak, 0.01);
}

TEST_F(Histories, GoOnAfterACut) {
  const std::vector<scene::Override> overrides{
      {"resolution.spacing", "0.006"},
      {"resolution.settle", "false"},
      {"output.histories", "[\"bodies\", \"largest\", \"forces\", \"one_dimensional\"]"},
      {"walls", "[{name = \"hull\", shape = {type = \"sphere\", radius = 0.06}}]"},
      {"lines", "[{name = \"out\", from = [0, 0, 0], to = [0.05, 0, 0], points = 5, interval = 3e-6}]"}};
  const scene::Scene scene = read_text(charge, overrides);
  struct Run {
    Run(const scene::Scene& scene, const fs::path& folder, bool goes_on)
        : simulation(scene), observer(scene, scene, simulation, folder, goes_on) {}
    void advance(const scene::Scene& scene, double end) {
      while (simulation.time() < end * (1 - 1e-12)) {
        simulation.advance(scene.end_time);
        observer.observe(simulation);
      }
    }
    void visit(StateVisitor& state) {
      state.part("simulation", [&] { simulation.visit_state(state); });
      state.part("observer", [&] { observer.visit_state(state); });
    }
    output::RunRecord record() {
      output::RunRecord all;
      observer.add_to(all);
      return all;
    }
    Simulation simulation;
    Observer observer;
  };
  const fs::path one = folder_ / "one", other = folder_ / "other";
  fs::create_directories(one);
  fs::create_directories(other);
  Run whole(scene, one, false);
  whole.observer.begin(whole.simulation);
  whole.advance(scene, 6e-6);
  output::write_checkpoint(folder_, {.time = 0, .steps = 0, .scene = "", .numerics = "", .start = ""},
                           [&](StateVisitor& state) { whole.visit(state); });
  whole.advance(scene, 1.2e-5);
  Run resumed(scene, other, true);
  output::Checkpoint(folder_ / output::checkpoint_names[0]).restore([&](StateVisitor& state) { resumed.visit(state); });
  resumed.advance(scene, 1.2e-5);
  const output::Evidence a = whole.observer.evidence(whole.simulation, {}), b = resumed.observer.evidence(resumed.simulation, {});
  EXPECT_EQ(a.bodies.values, b.bodies.values);
  EXPECT_EQ(a.forces.values, b.forces.values);
  EXPECT_GT(a.forces.rows(), 0u);
  ASSERT_GT(a.lines.at("out").rows(), 15u);
  EXPECT_TRUE(std::equal(a.lines.at("out").values[5].begin(), a.lines.at("out").values[5].end(),
                         b.lines.at("out").values[5].begin(), b.lines.at("out").values[5].end()));
  EXPECT_EQ(a.probes.at("near_1d").values, b.probes.at("near_1d").values);
  EXPECT_EQ(to_json(whole.record()), to_json(resumed.record()));
}

TEST(Bubble, RadiusAndPeriod) {
  output::Series radius;
  for (int i = 0; i <= 1000; ++i) {
    const double t = 1e-3 * i;
    radius.append(t, 0.1 + std::abs(std::sin(std::numbers::pi * t / 0.6)));  // minima at 0, 0.6
  }
  const output::BubbleRecord whole = bubble_of(radius);
  EXPECT_NEAR(whole.largest_radius_m, 1.1, 1e-5);
  EXPECT_NEAR(whole.largest_radius_time_s, 0.3, 1e-3);
  EXPECT_NEAR(whole.period_s, 0.6, 1e-3);
  EXPECT_NEAR(whole.least_radius_m, 0.1, 1e-9);
  EXPECT_EQ(whole.missing, "");
  const auto until = [&](std::size_t count) {
    return bubble_of({{radius.t.begin(), radius.t.begin() + long(count)}, {radius.y.begin(), radius.y.begin() + long(count)}});
  };
  EXPECT_TRUE(std::isnan(until(300).largest_radius_m));
  EXPECT_NE(until(300).missing, "");
  EXPECT_NEAR(until(500).largest_radius_m, 1.1, 1e-5);
  EXPECT_TRUE(std::isnan(until(500).period_s));
  EXPECT_NE(until(500).missing, "");
}

}  // namespace
}  // namespace undex::run::test
