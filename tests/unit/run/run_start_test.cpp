// Starts from the state of another run: what is exact, what passes through as it is, and what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "core/errors.hpp"
#include "output/checkpoint.hpp"
#include "output/folder_lock.hpp"
#include "run/particle_state.hpp"
#include "run/run.hpp"
#include "run/starts.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

namespace fs = std::filesystem;

/// Files of one test, which go with it.
class Folder {
 public:
  Folder() { fs::create_directories(path_); }
  ~Folder() { fs::remove_all(path_); }
  fs::path file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const fs::path& path() const { return path_; }

 private:
  static inline int count_ = 0;
  fs::path path_ = fs::temp_directory_path() / ("undex_run_start_" + std::to_string(getpid()) + "_" + std::to_string(count_++));
};

/// A ball of gas off the middle of water; `water` is the water's shape, and what closes it.
std::string ball(const std::string& top, const std::string& water, const std::string& start = "") {
  return "threads = 1\n" + top + start + R"(
[[bodies]]
name = "gas"
shape = {type = "sphere", center = [0, 0, 0.004], radius = 0.008}
material = {law = "ideal_gas", rho0 = 500, gamma = 2}
energy = 1e6
[[bodies]]
name = "water"
)" + water +
         R"(
subtract = ["gas"]
material = "water-tait"
pressure = 1e5
)";
}

const std::string in_a_tank = R"(shape = {type = "cylinder", axis = "z", radius = 0.03, low = -0.03, high = 0.03})";
const std::string tank = R"(
[[walls]]
name = "tank"
shape = {type = "cylinder", axis = "z", radius = 0.03, low = -0.03, high = 0.03}
)";
const std::string wide = R"(shape = {type = "sphere", center = [0, 0, 0.004], radius = 0.06})";

const std::string on_a_radius = ball("dimension = \"spherical\"\nend_time = 1e-5\n[resolution]\nspacing = 2e-4\n", wide);
const std::string in_the_meridian =
    ball("dimension = \"axisymmetric\"\naxis = \"z\"\nend_time = 1e-5\n[resolution]\nspacing = 0.0015\nfit = \"tank\"\n",
         in_a_tank) +
    tank;
std::string in_space(double spacing, const std::string& planes) {
  return ball("end_time = 2e-5\n[resolution]\nfit = \"tank\"\nspacing = " + std::to_string(spacing) +
                  "\n[symmetry]\nplanes = " + planes + "\n",
              in_a_tank) +
         tank;
}

std::string started(const std::string& text, const fs::path& from, const std::string& time) {
  return text + "\n[start]\nkind = \"run\"\nfrom = \"" + from.string() + "\"\n" + (time.empty() ? "" : "time = " + time + "\n");
}

/// Sums over a body of a run in particles, mirror images included.
struct Sums {
  double mass = 0, energy = 0;
  double along = 0;  // momentum along z
};
std::vector<Sums> sums_of(const Simulation& simulation, int copies) {
  const sph::Fluid& fluid = *simulation.fluid();
  const auto m = fluid.field("mass"), v = fluid.field("velocity"), e = fluid.field("energy"), body = fluid.field("material");
  std::vector<Sums> sums(fluid.particles_by_body().size());
  for (std::size_t i = 0; i < m.size(); ++i) {
    Sums& sum = sums[std::size_t(body[i])];
    const Vec3 u(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
    sum.mass += copies * m[i];
    sum.energy += copies * m[i] * (e[i] + 0.5 * u.squaredNorm());
    sum.along += copies * m[i] * (simulation.meridian() ? u[1] : u[2]);
  }
  return sums;
}

/// Of a receiver and a donor in particles: masses, energies and momenta by body.
void expect_exact(const Simulation& receiver, int receiver_copies, const Simulation& donor, int donor_copies) {
  const std::vector<Sums> here = sums_of(receiver, receiver_copies), there = sums_of(donor, donor_copies);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t b = 0; b < here.size(); ++b) {
    EXPECT_NEAR(here[b].mass / there[b].mass, 1.0, 1e-12) << b;
    const double scale = std::sqrt(2.0 * there[b].mass * donor.energy().kinetic);
    EXPECT_NEAR(here[b].along, there[b].along, 1e-12 * scale) << b;
  }
  EXPECT_NEAR(here[0].energy / there[0].energy, 1.0, 1e-12);  // the gas; of water some is dissipated
  // What gravity did in the donor is part of what it has.
  EXPECT_NEAR(receiver.energy().total() / (donor.energy().total() + donor.energy().gravity), 1.0, 1e-12);
  EXPECT_EQ(receiver.time(), donor.time());
}

scene::Scene begun(const std::string& text, const StartOptions& options = {}) {
  scene::Scene scene = read_text(text);
  begin(scene, options);
  return scene;
}

Simulation run_of(const std::string& text, double time) {
  Simulation simulation(read_text(text));
  run_to(simulation, time);
  return simulation;
}

TEST(RunStart, FromTheMeridianIntoSpaceIsExactByBody) {
  const Folder folder;
  const fs::path from = folder.file("donor.toml", in_the_meridian);
  const Simulation donor = run_of(in_the_meridian, 6e-6);
  for (const auto& [planes, copies] : {std::pair("[\"x\", \"y\"]", 4), {"[]", 1}}) {
    Simulation receiver(begun(started(in_space(0.003, planes), from, "6e-6")));
    expect_exact(receiver, copies, donor, 1);
    EXPECT_LT(receiver.energy().kinetic / donor.energy().kinetic, 1.0);
    EXPECT_GT(receiver.energy().kinetic / donor.energy().kinetic, 0.85);
    run_to(receiver, 8e-6);
    EXPECT_LT(std::abs(receiver.energy().error()), 2e-3);
    EXPECT_LT(receiver.mass_error(), 1e-14);
  }
}

TEST(RunStart, FromSpaceIntoSpaceIsExactByBody) {
  const Folder folder;
  const std::string quarter = in_space(0.003, "[\"x\", \"y\"]");
  const fs::path from = folder.file("donor.toml", quarter);
  const Simulation donor = run_of(quarter, 6e-6);
  Simulation receiver(begun(started(in_space(0.004, "[\"y\"]"), from, "6e-6")));
  expect_exact(receiver, 2, donor, 4);
}

TEST(RunStart, FromARadiusIsExactByBody) {
  const Folder folder;
  const fs::path from = folder.file("donor.toml", on_a_radius);
  const Simulation donor = run_of(on_a_radius, 4e-6);
  const exact::Lagrangian1D& mesh = donor.line()->mesh();
  const std::string ring =
      ball("dimension = \"axisymmetric\"\naxis = \"z\"\nend_time = 1e-4\n[resolution]\nspacing = 0.002\n", wide);
  const std::string space = ball("end_time = 1e-4\n[resolution]\nspacing = 0.004\n[symmetry]\nplanes = [\"x\", \"y\"]\n", wide);
  for (const auto& [text, copies] : {std::pair(ring, 1), {space, 4}}) {
    Simulation receiver(begun(started(text, from, "4e-6")));
    const std::vector<Sums> sums = sums_of(receiver, copies);
    for (int layer : {0, 1}) {
      const exact::IntervalIntegral whole = mesh.integral(0, 1, layer);
      EXPECT_NEAR(sums[layer].mass / whole.mass, 1.0, 1e-12);
      EXPECT_LT(std::abs(sums[layer].along), 1e-12 * whole.momentum);
      if (layer == 0) {
        EXPECT_NEAR(sums[layer].energy / (whole.internal_energy + whole.kinetic_energy), 1.0, 1e-12);
      }
    }
    EXPECT_NEAR(receiver.energy().total() / donor.energy().total(), 1.0, 1e-12);
  }
}

/// Where the donor ends sooner than the scene, and the scene has a tank that the donor lacks: the rest is the scene's own.
TEST(RunStart, GoesUpToWhatTheDonorLacks) {
  const Folder folder;
  const fs::path from = folder.file("donor.toml", on_a_radius);
  const std::string text = in_space(0.003, "[\"x\", \"y\"]");
  scene::Scene scene = read_text(started(text, from, ""));
  const std::string report = begin(scene);
  EXPECT_NE(report.find("'tank'"), std::string::npos) << report;
  Simulation receiver(scene), plain(read_text(text));
  EXPECT_GT(receiver.time(), 1e-6);
  EXPECT_LT(receiver.time(), 0.026 / 1500);
  EXPECT_NEAR(sums_of(receiver, 4)[1].mass / sums_of(plain, 4)[1].mass, 1.0, 1e-12);
  EXPECT_NEAR(receiver.fluid()->at(Vec3(0, 0, -0.028)).pressure, 1e5, 1e3);
}

/// A radiating tank of the scene's own is no obstacle: what has left stays what it is in the donor's larger water. A donor's is
/// one, where the scene's water goes on beyond it.
TEST(RunStart, ARadiatingTankIsNoObstacle) {
  const Folder folder;
  std::string narrow = in_space(0.003, "[\"x\", \"y\"]"),
              sea = ball(
                  "end_time = 2e-5\n[resolution]\nfit = \"water\"\nspacing = 0.003\n"
                  "[symmetry]\nplanes = [\"x\", \"y\"]\n",
                  R"(shape = {type = "box", low = [-0.06, -0.06, -0.06], high = [0.06, 0.06, 0.06]})");
  narrow += "condition = \"radiating\"\n";
  const fs::path from = folder.file("sea.toml", sea), tank = folder.file("tank.toml", narrow);
  const std::string laid = started(narrow, from, "1.6e-5");
  scene::Scene scene = read_text(laid);
  begin(scene);
  EXPECT_EQ(scene.fluid.bodies[1].start->mass, 0.0);
  Simulation receiver(scene), donor = run_of(sea, 1.6e-5);
  EXPECT_NEAR(sums_of(receiver, 4)[0].mass / sums_of(donor, 4)[0].mass, 1.0, 1e-12);
  const Vec3 x(0.018, 0.003, 0.004);
  EXPECT_NEAR(receiver.fluid()->at(x).pressure / donor.fluid()->at(x).pressure, 1.0, 0.03);
  run_to(receiver, 1.9e-5);
  run_to(donor, 1.9e-5);
  EXPECT_NEAR(receiver.fluid()->at(x).pressure / donor.fluid()->at(x).pressure, 1.0, 0.1);
  scene::Scene other = read_text(started(sea, tank, "1.6e-5"));
  EXPECT_THROW(begin(other), SceneError);
}

/// A donor that is given as a folder goes on from its checkpoint, to the same digits as one that is given as a scene.
TEST(RunStart, AFolderAndASceneGiveTheSameDigits) {
  const Folder folder;
  std::string short_donor = in_the_meridian;
  short_donor.replace(short_donor.find("end_time = 1e-5"), 15, "end_time = 4e-6");
  const fs::path from = folder.file("donor.toml", short_donor), out = folder.path() / "out";
  fs::create_directories(out);
  {
    const output::FolderLock lock(out, "test");
    compute(scene::read(from, {}), {.output = out, .verbosity = -1, .scene_text = short_donor, .numerics = "of the test"});
  }
  const auto digits = [&](const fs::path& donor, std::string& report) {
    scene::Scene scene = read_text(started(in_space(0.004, "[\"x\", \"y\"]"), donor, "4e-6"));
    report = begin(scene, {.numerics = "of the test", .output = {}});
    Simulation simulation(scene);
    return output::fingerprint([&](StateVisitor& state) { simulation.visit_state(state); });
  };
  std::string of_scene, of_folder;
  EXPECT_EQ(digits(from, of_scene), digits(out, of_folder));
  EXPECT_EQ(of_scene.find("checkpoint"), std::string::npos) << of_scene;
  EXPECT_NE(of_folder.find("checkpoint"), std::string::npos) << of_folder;
}

/// Fields that a lattice holds exactly come back exactly, over any width: one pressure under two densities, a linear velocity.
TEST(RunStart, UniformAndLinearFieldsPass) {
  const double pressure = 1e8;
  for (const std::string& top :
       {std::string("end_time = 1e-3\n"), std::string("dimension = \"axisymmetric\"\naxis = \"z\"\nend_time = 1e-3\n")}) {
    scene::Scene scene = read_text(top + R"(
threads = 1
[resolution]
spacing = 0.002
[[bodies]]
name = "gas"
shape = {type = "cylinder", axis = "z", radius = 0.02, low = -0.02, high = 0.02}
material = {law = "ideal_gas", rho0 = 500, gamma = 1.5}
pressure = 1e8
energy = 4e5
)");
    const bool ring = scene.meridian.has_value();
    const auto velocity = [&](const Vec3& x) { return Vec3(300 * x[0], 300 * x[1], 100 - 200 * x[2] + (ring ? 0 : 50 * x[0])); };
    const auto density = [](const Vec3& x) { return x[2] > 0 ? 500.0 : 250.0; };
    auto field = std::make_shared<sph::StartField>();
    field->state = [&](const Vec3& x, double) { return sph::StartState{density(x), 2.0 * pressure / density(x), velocity(x)}; };
    scene.fluid.bodies[0].start = field;
    const Simulation simulation(scene);
    const ParticleState state(scene, simulation, ParticleState::places_of(simulation), 1e6, 0.006);
    const sph::StartState at_rest{500, 4e5, Vec3::Zero()};
    for (const double width : {0.001, 0.002, 0.005})
      for (const Vec3& x :
           {Vec3(0.003, 0.004, 0.007), Vec3(-0.0061, 0.0013, -0.0004), Vec3(1e-4, 0, 0.0102), Vec3(0.011, -0.002, -0.011)}) {
        const sph::StartState here = state.state(0, x, width, at_rest);
        EXPECT_NEAR(here.density * here.energy / (2.0 * pressure), 1.0, 1e-12) << width;
        EXPECT_LT((here.velocity - velocity(x)).norm(), 1e-9) << width << " " << x.transpose();
      }
    EXPECT_EQ(state.owner_at(Vec3(0.003, 0.004, 0.007)).body, std::optional<std::size_t>(0));
    EXPECT_FALSE(state.owner_at(Vec3(0, 0, 0.04)).body);
  }
}

std::string refusal(const std::string& text, const std::vector<scene::Override>& overrides = {}) {
  try {
    scene::Scene scene = read_text(text, overrides);
    begin(scene);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(RunStart, RefusesWhatItCannotGive) {
  const Folder folder;
  const fs::path radius = folder.file("radius.toml", on_a_radius), ring = folder.file("ring.toml", in_the_meridian);
  const std::string space = in_space(0.004, "[\"x\", \"y\"]");
  const auto says = [&](const std::string& text, const std::vector<scene::Override>& overrides, const char* what) {
    const std::string found = refusal(text, overrides);
    EXPECT_NE(found.find(what), std::string::npos) << what << ": " << found;
  };
  const std::string from_ring = started(space, ring, "4e-6"), from_radius = started(space, radius, "4e-6");
  EXPECT_EQ(refusal(from_ring), "");
  EXPECT_EQ(refusal(from_radius), "");
  says(started(space, folder.path() / "nowhere.toml", "4e-6"), {}, "neither a scene nor the folder of a run");
  says(started(space, folder.file("broken.toml", "end_time = 1\n"), "4e-6"), {}, "the donor cannot be begun");
  says(from_ring, {{"start.time", "2e-5"}}, "must come before end_time");
  says(from_ring, {{"start.time", "1.5e-5"}}, "the donor ends at 10 us");
  says(started(space, ring, ""), {}, "no obstacle says when to begin");
  says(started(in_the_meridian, folder.file("space.toml", space), "4e-6"), {}, "a donor in space is not laid over a meridian");
  says(from_ring, {{"bodies.water.material", "\"water-tait-cutoff\""}}, "take one material in both");
  says(from_ring, {{"bodies.gas.energy", "1.1e6"}}, "give both scenes the same state at time zero");
  says(from_ring, {{"bodies.water.velocity", "[0, 0, 1]"}}, "moves");
  says(from_ring, {{"symmetry.planes", "[\"z\"]"}}, "symmetry");
  says(from_ring, {{"gravity", "[0, 0, -9.81]"}}, "the donor has another gravity");
  says(from_ring, {{"surroundings.pressure", "1e5"}}, "the donor has other surroundings");
  says(from_radius, {{"gravity", "[0, 0, -9.81]"}, {"bodies.water.level", "0.03"}}, "the pressure of its middle's depth");
  EXPECT_EQ(refusal(from_radius, {{"gravity", "[0, 0, -9.81]"}, {"bodies.water.level", "0.004"}}), "");
  says(from_ring, {{"walls.tank.faces", "{high = \"open\"}"}, {"start.time", "9e-6"}}, "has come to wall 'tank'");
  says(from_radius, {{"start.time", "9.9e-6"}}, "has come to");
  std::string renamed = space;
  for (const char* name : {"\"gas\"", "\"water\""})
    for (std::size_t at = 0; (at = renamed.find(name, at)) != std::string::npos;)
      renamed.replace(at, std::string(name).size(), std::string("\"other_") + (name + 1));
  says(started(renamed, ring, "4e-6"), {}, "no body of the donor has the name");
  // In a circle.
  const fs::path one = folder.path() / "one.toml", other = folder.file("other.toml", started(space, one, "4e-6"));
  folder.file("one.toml", started(space, other, "4e-6"));
  scene::Scene scene = scene::read(one, {});
  EXPECT_THROW(begin(scene), SceneError);
}

/// Two scenes under one gravity: what the wave has not come to keeps the pressure of its depth, and all is exact by body.
TEST(RunStart, UnderOneGravity) {
  const Folder folder;
  std::string ring = in_the_meridian, space = in_space(0.003, "[\"x\", \"y\"]");
  for (std::string* text : {&ring, &space}) {
    text->insert(0, "gravity = [0, 0, -1e5]\n");
    const std::string pressure = "pressure = 1e5";
    text->replace(text->find(pressure), pressure.size(), pressure + "\nlevel = 0.03");
  }
  const fs::path from = folder.file("donor.toml", ring);
  const Simulation donor = run_of(ring, 4e-6);
  Simulation receiver(begun(started(space, from, "4e-6")));
  expect_exact(receiver, 4, donor, 1);
  EXPECT_NEAR(receiver.fluid()->at(Vec3(0, 0, -0.024)).pressure, 1e5 + 1e8 * 0.054, 0.05e6);
  run_to(receiver, 6e-6);
  EXPECT_LT(std::abs(receiver.energy().error()), 0.01);
  const std::string level = "level = 0.03";
  space.replace(space.find(level), level.size(), "level = 0.031");
  EXPECT_NE(refusal(started(space, from, "4e-6")).find("give both the same level and pressure"), std::string::npos)
      << refusal(started(space, from, "4e-6"));
}

/// A chain: radius, meridian, space.
TEST(RunStart, ChainsOfDonors) {
  const Folder folder;
  const fs::path radius = folder.file("radius.toml", on_a_radius);
  const fs::path ring = folder.file("ring.toml", started(in_the_meridian, radius, "4e-6"));
  Simulation between(begun(started(in_the_meridian, radius, "4e-6")));
  run_to(between, 6e-6);
  const Simulation receiver(begun(started(in_space(0.003, "[\"x\", \"y\"]"), ring, "6e-6")));
  expect_exact(receiver, 4, between, 1);
}

/// A run that is gone on with has its start from its own folder: the donor may be gone, and the digits are those of a run that
/// was not cut. (The snapshot cuts a step of both where the one ends.)
TEST(RunStart, IsGoneOnWithWithoutItsDonor) {
  const Folder folder;
  const fs::path from = folder.file("donor.toml", in_the_meridian), whole = folder.path() / "whole", cut = folder.path() / "cut";
  const std::string text = started(in_space(0.004, "[\"x\", \"y\"]"), from, "4e-6") + "[output]\nfield_times = [6e-6]\n";
  const auto run = [&](const fs::path& out, const std::string& end, const output::Checkpoint* checkpoint) {
    fs::create_directories(out);
    const output::FolderLock lock(out, "test");
    return compute(read_text(text, {{"end_time", end}}), {.output = out,
                                                          .verbosity = -1,
                                                          .scene_text = text,
                                                          .numerics = "of the test",
                                                          .last_fields = {"fluid.velocity"},
                                                          .checkpoint = checkpoint});
  };
  const Result expected = run(whole, "8e-6", nullptr);
  run(cut, "6e-6", nullptr);
  fs::remove(from);
  const output::Checkpoint checkpoint(cut / output::checkpoint_names[0]);
  const Result resumed = run(cut, "8e-6", &checkpoint);
  EXPECT_EQ(resumed.record.status, "done");
  EXPECT_EQ(resumed.record.steps, expected.record.steps);
  EXPECT_EQ(resumed.evidence.fields.at("fluid.velocity").values, expected.evidence.fields.at("fluid.velocity").values);
}

}  // namespace
}  // namespace undex::run::test
