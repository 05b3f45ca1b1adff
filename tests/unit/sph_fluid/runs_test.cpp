// Runs as a user sees them: reproducibility, what can be read off, and how a run that goes wrong ends.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <memory>
#include <set>

#include "core/errors.hpp"
#include "scenes.hpp"
#include "sph_fluid/pairs/pair_data.hpp"

namespace undex::sph::testing {
namespace {

Settings bubble(int threads, SchemeName scheme, double spacing = 0.025) {
  Settings settings;
  settings.lattice.spacing = spacing;
  settings.lattice.jitter = 0.1;
  const Sphere ball{Vec3::Zero(), 0.15};
  const Vec3 low(-0.3, -0.4, -0.4), high(0.3, 0.4, 0.4);
  settings.bodies = {body("water", Shape{Box{low, high}, {ball}}, "water-tait"), body("bubble", Shape{ball, {}}, "bubble-gas")};
  settings.bodies[1].variable_h = true;
  settings.walls = {box_wall(low, high)};
  settings.symmetry.axis = {true, true, false};
  settings.numerics.threads = threads;
  settings.numerics.scheme = scheme;
  return settings;
}

/// Bit for bit: positions, velocities, densities and the ledger.
TEST(Runs, DoNotDependOnTheNumberOfThreads) {
  for (const auto& [name, scheme] : scheme_names) {
    SCOPED_TRACE(name);
    std::vector<double> positions, velocities, densities, ids;
    Ledger ledger;
    for (const int threads : {1, 2, 8}) {
      Fluid fluid(bubble(threads, scheme));
      ASSERT_GT(fluid.particle_count(), 4096u) << "too few for the threads to share";
      for (int k = 0; k < 8; ++k) fluid.step(fluid.step_limit().step);
      EXPECT_EQ(omp_get_max_threads(), threads);
      if (threads == 1) {
        positions = fluid.field("position");
        velocities = fluid.field("velocity");
        densities = fluid.field("density");
        ids = fluid.field("id");
        ledger = fluid.ledger();
        continue;
      }
      EXPECT_EQ(fluid.field("id"), ids) << threads << " threads";
      EXPECT_EQ(fluid.field("position"), positions) << threads << " threads";
      EXPECT_EQ(fluid.field("velocity"), velocities) << threads << " threads";
      EXPECT_EQ(fluid.field("density"), densities) << threads << " threads";
      EXPECT_EQ(fluid.ledger().kinetic, ledger.kinetic);
      EXPECT_EQ(fluid.ledger().internal, ledger.internal);
      EXPECT_EQ(fluid.ledger().dissipated, ledger.dissipated);
    }
  }
}

TEST(Runs, RepeatBitForBit) {
  std::vector<double> first;
  for (int repeat = 0; repeat < 2; ++repeat) {
    Fluid fluid(bubble(2, SchemeName::monaghan));
    for (int k = 0; k < 3; ++k) fluid.step(fluid.step_limit().step);
    if (repeat == 0) first = fluid.field("velocity");
    EXPECT_EQ(fluid.field("velocity"), first);
  }
}

/// Two fluids in one program, each with its own number of threads.
TEST(Runs, FluidsDoNotShareThreads) {
  Fluid one(bubble(1, SchemeName::monaghan, 0.05));
  Fluid four(bubble(4, SchemeName::monaghan, 0.05));
  for (int k = 0; k < 2; ++k) {
    const double dt = one.step_limit().step;
    one.step(dt);
    four.step(dt);
  }
  EXPECT_EQ(one.field("velocity"), four.field("velocity"));
}

TEST(Runs, MassAndCountsStay) {
  Fluid fluid(bubble(2, SchemeName::monaghan, 0.05));
  const double mass = fluid.ledger().mass;
  const std::vector<std::size_t> counts = fluid.particles_by_body();
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_EQ(counts[0] + counts[1], fluid.particle_count());
  EXPECT_GT(counts[1], 0u);
  for (int k = 0; k < 20; ++k) fluid.step(fluid.step_limit().step);
  EXPECT_NEAR(fluid.ledger().mass, mass, 1e-14 * mass);
  EXPECT_EQ(fluid.particles_by_body(), counts);
  EXPECT_EQ(fluid.steps(), 20);
  EXPECT_GT(fluid.neighbour_interactions(), 20ll * 30 * (long long)(fluid.particle_count()));
  EXPECT_LT(fluid.neighbour_interactions(), 22ll * 200 * (long long)(fluid.particle_count()));
}

/// A gas bubble at the end of a long tank of water without pressure; `axis` is the long one.
Settings long_tank(SchemeName scheme, int axis) {
  Settings settings;
  settings.lattice.spacing = 0.02;
  const Sphere ball{Vec3::Zero(), 0.09};
  Vec3 high = Vec3::Constant(0.12);
  high[axis] = 6.0;
  settings.bodies = {body("water", Shape{Box{-high, high}, {ball}}, "water-tait"), body("bubble", Shape{ball, {}}, "bubble-gas")};
  settings.bodies[1].variable_h = true;
  settings.walls = {box_wall(-high, high)};
  settings.bodies[0].pressure = 1.1e-5;
  settings.symmetry.axis = {true, true, true};
  settings.numerics.scheme = scheme;
  return settings;
}

/// Leaving out what no signal has reached changes nothing but round-off, along every axis, and saves pairs.
TEST(Runs, RestIsLeftOutExactly) {
  for (const auto& [name, scheme] : scheme_names)
    for (int axis = 0; axis < 3; ++axis) {
      SCOPED_TRACE(name);
      if (axis != 1 && scheme != SchemeName::monaghan && scheme != SchemeName::riemann) continue;
      Settings settings = long_tank(scheme, axis);
      Fluid partly(settings);
      settings.numerics.signal = 0.0;
      Fluid whole(settings);
      for (int k = 0; k < 40; ++k) {
        const StepLimit a = partly.step_limit(), b = whole.step_limit();
        ASSERT_NEAR(a.step, b.step, 1e-9 * b.step);
        partly.step(b.step);
        whole.step(b.step);
      }
      const std::vector<Vec3> x = by_id(partly, "position"), wanted_x = by_id(whole, "position");
      const std::vector<Vec3> v = by_id(partly, "velocity"), wanted_v = by_id(whole, "velocity");
      double fastest = 0, difference = 0, moved = 0;
      for (std::size_t i = 0; i < v.size(); ++i) {
        fastest = std::max(fastest, wanted_v[i].norm());
        difference = std::max(difference, (v[i] - wanted_v[i]).norm());
        moved = std::max(moved, (x[i] - wanted_x[i]).norm());
      }
      EXPECT_GT(fastest, 30.0);
      EXPECT_LT(difference, 2e-9 * fastest) << "axis " << axis;
      EXPECT_LT(moved, 1e-10 * settings.lattice.spacing) << "axis " << axis;
      EXPECT_LT(partly.neighbour_interactions(), 7 * whole.neighbour_interactions() / 10) << "axis " << axis;
    }
}

/// A body that nothing holds is no rest: its free surface moves from the first step on.
TEST(Runs, AFreeSurfaceIsNotAtRest) {
  Settings settings = long_tank(SchemeName::riemann, 2);
  settings.bodies[0].pressure = 1e5;
  settings.walls[0].faces["z_high"] = FaceCondition::open;
  Fluid fluid(settings);
  fluid.step(fluid.step_limit().step);
  const std::vector<Vec3> x = by_id(fluid, "position"), v = by_id(fluid, "velocity");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i][2] > 5.98) {
      EXPECT_GT(v[i][2], 1e-6);
    }
}

/// A scene pays for what it names: passes, and memory per particle.
TEST(Runs, OnlyTheWorkThatASceneNeeds) {
  const auto passes = [](const Fluid& fluid) {
    std::set<std::string> names;
    for (const auto& [name, seconds] : fluid.timers().seconds()) names.insert(name);
    return names;
  };
  const auto bytes = [](const Fluid& fluid) { return double(fluid.memory_bytes()) / double(fluid.particle_count()); };
  Settings settings;
  settings.lattice.spacing = 0.05;
  const Vec3 low = Vec3::Zero(), high = Vec3::Constant(1.5);
  settings.bodies = {body("water", box(low, high), "water-tait")};
  settings.numerics.scheme = SchemeName::monaghan;
  Fluid plain(settings);
  plain.step(1e-6);
  EXPECT_EQ(passes(plain), (std::set<std::string>{"sort", "equation of state", "pairs", "integration"}));
  const double least = bytes(plain);
  EXPECT_LT(least, 225.0);

  settings.walls = {box_wall(low, high)};
  Fluid walled(settings);
  walled.step(1e-6);
  EXPECT_EQ(passes(walled), (std::set<std::string>{"sort", "equation of state", "walls", "pairs", "wall forces", "integration"}));
  settings.walls.clear();

  settings.numerics.scheme = SchemeName::riemann;
  EXPECT_NEAR(bytes(Fluid(settings)) - least, sizeof(GradientRow), 1.0);
  settings.numerics.scheme = SchemeName::riemann_corrected;
  EXPECT_NEAR(bytes(Fluid(settings)) - least, sizeof(CorrectedRow), 1.0);
  settings.numerics.scheme = SchemeName::monaghan_switch;
  EXPECT_NEAR(bytes(Fluid(settings)) - least, sizeof(ViscosityRow), 1.0);
  settings.numerics.scheme = SchemeName::paper;
  EXPECT_NEAR(bytes(Fluid(settings)) - least, 0.0, 1.0);
  settings.numerics.scheme = SchemeName::monaghan;
  settings.bodies = {body("gas", box(low, high), "air")};
  EXPECT_NEAR(bytes(Fluid(settings)) - least, sizeof(double), 1.0);  // an energy
}

// ---- The step ------------------------------------------------------------------------------------------------------

/// Volumes must go with the particles: without the filling in the pair rates one particle's volume runs away at 7 us.
TEST(Runs, ProductsExpandIntoVacuum) {
  for (const SchemeName scheme : {SchemeName::riemann, SchemeName::riemann_corrected}) {
    SCOPED_TRACE(scheme == SchemeName::riemann ? "plain" : "corrected");
    Settings settings;
    settings.lattice.spacing = 0.0008;
    Body charge = body("charge", Shape{Sphere{Vec3::Zero(), 0.0072}, {}}, "petn");
    charge.density = 1000.0;
    charge.variable_h = true;
    settings.bodies = {charge};
    settings.symmetry.axis = {true, true, true};
    settings.numerics.threads = 1;
    settings.numerics.scheme = scheme;
    Fluid fluid(settings);
    const auto total = [&] { return fluid.ledger().kinetic + fluid.ledger().internal; };
    const double before = total();
    while (fluid.time() < 15e-6) fluid.step(fluid.step_limit().step);
    EXPECT_NEAR(total(), before, 3e-3 * before);
    EXPECT_LT(fluid.steps(), 300);
    const std::vector<double> density = fluid.field("density"), energy = fluid.field("energy");
    // To some 0.07 m, a thousandth of the density; what flies off alone keeps its own.
    EXPECT_GT(*std::min_element(density.begin(), density.end()), 0.03);
    EXPECT_GT(*std::min_element(energy.begin(), energy.end()), 0.0);
    EXPECT_EQ(fluid.clamps().density, 0);
    EXPECT_EQ(fluid.clamps().energy, 0);
  }
}

TEST(StepLimit, NamesItsOwner) {
  Fluid fluid(bubble(1, SchemeName::monaghan, 0.05));
  const StepLimit limit = fluid.step_limit();
  EXPECT_TRUE(limit.criterion == "Courant" || limit.criterion == "force") << limit.criterion;
  EXPECT_TRUE(limit.body == "water" || limit.body == "bubble");
  const std::vector<Vec3> start = by_id(fluid, "position");
  EXPECT_LT((start.at(limit.particle) - limit.position).norm(), 1e-12);
  EXPECT_GT(limit.step, 0.0);
}

TEST(StepLimit, QuietWaterIsCourant) {
  Settings settings;
  settings.dimension = 1;
  settings.lattice.spacing = 0.01;
  settings.bodies = {body("water", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "water-tait")};
  settings.walls = {box_wall(Vec3(0, -9, -9), Vec3(1, 9, 9))};
  settings.numerics.threads = 1;
  const StepLimit limit = Fluid(settings).step_limit();
  EXPECT_EQ(limit.criterion, "Courant");
  EXPECT_EQ(limit.body, "water");
  // Never beyond a sound wave's way across the smoothing length.
  EXPECT_LT(limit.step * 1538.0, settings.numerics.courant * settings.numerics.eta * 0.01 * (1 + 1e-9));
  EXPECT_GT(limit.step * 1538.0, 0.2 * settings.numerics.courant * settings.numerics.eta * 0.01);
  // Proportional to the spacing and to the Courant number.
  settings.lattice.spacing = 0.005;
  EXPECT_NEAR(Fluid(settings).step_limit().step, 0.5 * limit.step, 1e-9 * limit.step);
  settings.numerics.courant *= 0.5;
  EXPECT_NEAR(Fluid(settings).step_limit().step, 0.25 * limit.step, 1e-9 * limit.step);
  settings.numerics.fixed_step = 1e-8;
  EXPECT_EQ(Fluid(settings).step_limit().step, 1e-8);
  EXPECT_EQ(Fluid(settings).step_limit().criterion, "fixed");
}

// ---- How a run ends badly ------------------------------------------------------------------------------------------

/// Steps far too long: the run stops by name, it neither crashes nor goes on with NaN.
TEST(NumericalStops, NameParticleAndBody) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann})
    for (const double dt : {1e-3, 1.0, 1e5, 1e150}) {
      Settings settings = bubble(1, scheme, 0.1);
      settings.numerics.fixed_step = dt;
      Fluid fluid(settings);
      std::string message;
      try {
        for (int k = 0; k < 30 && message.empty(); ++k) fluid.step(fluid.step_limit().step);
      } catch (const NumericalStop& stop) {
        message = stop.what();
      }
      if (message.empty()) {
        // It may survive, but not with values that are not numbers.
        for (const char* name : {"position", "velocity", "density", "pressure"})
          for (const double value : fluid.field(name)) ASSERT_TRUE(std::isfinite(value)) << name << ", dt " << dt;
        continue;
      }
      EXPECT_NE(message.find("step"), std::string::npos) << message;
      EXPECT_NE(message.find("particle"), std::string::npos) << message;
      EXPECT_TRUE(message.find("water") != std::string::npos || message.find("bubble") != std::string::npos) << message;
    }
}

/// A run whose densities or velocities overflow must be caught whatever the field.
TEST(NumericalStops, HappenAtAll) {
  Settings settings = bubble(1, SchemeName::monaghan, 0.1);
  settings.numerics.fixed_step = 1e150;
  Fluid fluid(settings);
  EXPECT_THROW(for (int k = 0; k < 50; ++k) fluid.step(fluid.step_limit().step), NumericalStop);
}

/// Takes a step of dt [s] and, where it goes wrong, compares what it leaves with what came before. Returns whether it was
/// stopped before its drift (-1), not at all (0), or in its middle (1).
int outcome_of_step(Fluid& fluid, double dt) {
  const std::vector<Vec3> x = by_id(fluid, "position"), v = by_id(fluid, "velocity");
  const double time = fluid.time(), mass = fluid.ledger().mass;
  const long steps = fluid.steps();
  try {
    fluid.step(dt);
    return 0;
  } catch (const NumericalStop&) {
  }
  const bool in_the_middle = fluid.time() > time;
  EXPECT_EQ(fluid.steps(), steps);
  EXPECT_DOUBLE_EQ(fluid.time(), in_the_middle ? time + 0.5 * dt : time);
  EXPECT_DOUBLE_EQ(fluid.ledger().mass, mass);
  EXPECT_TRUE(std::isfinite(fluid.ledger().kinetic + fluid.ledger().internal + fluid.ledger().dissipated));
  for (const char* name : {"position", "velocity", "density", "pressure", "sound_speed", "void_fraction", "smoothing_length"})
    for (const double value : fluid.field(name)) EXPECT_TRUE(std::isfinite(value)) << name;
  const std::vector<Vec3> x_left = by_id(fluid, "position"), v_left = by_id(fluid, "velocity");
  double off = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    // The step drifted with the velocities that are left, and half of that was taken back.
    const Vec3 drift = dt * v_left[i];
    off = std::max(off, in_the_middle ? (x_left[i] - x[i] - 0.5 * drift).norm() / (1.0 + drift.norm())
                                      : (x_left[i] - x[i]).norm() + (v_left[i] - v[i]).norm() / (1e7 * (1.0 + dt)));
  }
  EXPECT_LT(off, 1e-8) << "dt " << dt;  // round-off of a first kick far beyond the bound
  return in_the_middle ? 1 : -1;
}

TEST(NumericalStops, LeaveTheLastSoundState) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann}) {
    // Two streams that meet just below the speed at which a run is stopped: squeezed, they are beyond it.
    Settings settings;
    settings.dimension = 1;
    settings.lattice.spacing = 0.05;
    settings.numerics.scheme = scheme;
    settings.numerics.threads = 1;
    settings.bodies = {body("left", box(Vec3(-1, 0, 0), Vec3(0, 0, 0)), "water-tait"),
                       body("right", box(Vec3(0, 0, 0), Vec3(1, 0, 0)), "water-tait")};
    const double speed = scheme == SchemeName::riemann ? 4.9e6 : 2.5e6;
    settings.bodies[0].velocity = {speed, 0, 0};
    settings.bodies[1].velocity = {-speed, 0, 0};
    std::set<int> outcomes;
    for (double dt = 1e-10; dt < 1e-3; dt *= 1.5) {
      Fluid fluid(settings);
      fluid.step(1e-13);
      outcomes.insert(outcome_of_step(fluid, dt));
    }
    EXPECT_EQ(outcomes, (std::set<int>{-1, 0, 1}));
  }
}

TEST(NumericalStops, NameWhatTheSceneItselfGetsWrong) {
  Settings settings = bubble(1, SchemeName::riemann, 0.1);
  settings.bodies[1].velocity = {0, 0, 1e8};
  Fluid fluid(settings);
  EXPECT_THROW(fluid.step_limit(), NumericalStop);
}

// ---- What can be read off --------------------------------------------------------------------------------------------

Settings uniform() {
  Settings settings;
  settings.dimension = 2;
  settings.lattice.spacing = 0.05;
  settings.bodies = {body("water", box(Vec3(0, 0, 0), Vec3(1, 1, 1)), "water-tait")};
  settings.bodies[0].pressure = 3e7;
  settings.bodies[0].velocity = {7, -2, 0};
  settings.symmetry.axis[0] = true;
  settings.numerics.threads = 1;
  return settings;
}

TEST(Probe, UniformFlow) {
  Fluid fluid(uniform());
  fluid.step_limit();
  const double rho = materials::density_at(uniform().bodies[0].material.law, 3e7, 0);
  for (const Vec3& x : {Vec3(0.5, 0.5, 0), Vec3(0.513, 0.777, 0), Vec3(0.98, 0.97, 0)}) {
    const FluidPoint values = fluid.at(x);
    EXPECT_GT(values.neighbours, 3);
    EXPECT_NEAR(values.pressure, 3e7, 1e-6 * 3e7);
    EXPECT_NEAR(values.density, rho, 1e-9 * rho);
    EXPECT_NEAR(values.velocity[0], 7, 1e-9);
    EXPECT_NEAR(values.velocity[1], -2, 1e-9);
    EXPECT_EQ(values.void_fraction, 0.0);
  }
  // On the plane the normal velocity averages out; the pressure does not.
  EXPECT_NEAR(fluid.at(Vec3(0, 0.5, 0)).velocity[0], 0.0, 1e-9);
  EXPECT_NEAR(fluid.at(Vec3(0, 0.5, 0)).velocity[1], -2.0, 1e-9);
  EXPECT_NEAR(fluid.at(Vec3(0, 0.5, 0)).pressure, 3e7, 30);
  const FluidPoint outside = fluid.at(Vec3(5, 5, 0));
  EXPECT_EQ(outside.neighbours, 0);
  EXPECT_EQ(outside.pressure, 0.0);
}

/// Output at time zero, before anybody asked for a step.
TEST(Probe, ValidFromConstructionOn) {
  Fluid fluid(uniform());
  EXPECT_NEAR(fluid.at(Vec3(0.5, 0.5, 0)).pressure, 3e7, 30);
  for (const double p : fluid.field("pressure")) ASSERT_NEAR(p, 3e7, 30);
  for (const double h : fluid.field("smoothing_length")) ASSERT_NEAR(h, fluid.settings().numerics.eta * 0.05, 1e-12);
  EXPECT_NEAR(fluid.maximum_pressure(), 3e7, 30);
  EXPECT_NEAR(fluid.maximum_speed(), std::hypot(7, 2), 1e-12);
}

TEST(Fields, ShapesAndValues) {
  Fluid fluid(bubble(1, SchemeName::monaghan, 0.1));
  fluid.step_limit();
  const std::size_t n = fluid.particle_count();
  for (const char* name : {"position", "velocity"}) EXPECT_EQ(fluid.field(name).size(), 3 * n);
  for (const char* name :
       {"pressure", "density", "void_fraction", "energy", "smoothing_length", "material", "sound_speed", "mass", "id"})
    EXPECT_EQ(fluid.field(name).size(), n) << name;
  std::vector<double> ids = fluid.field("id");
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(ids[i], double(i));
  const std::vector<double> material = fluid.field("material"), rho = fluid.field("density"), energy = fluid.field("energy"),
                            p = fluid.field("pressure");
  std::size_t gas = 0;
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_TRUE(material[i] == 0.0 || material[i] == 1.0);
    gas += material[i] == 1.0;
    EXPECT_NEAR(rho[i], material[i] == 1.0 ? 1770.0 : 1000.0, 1e-9);
    EXPECT_NEAR(p[i], material[i] == 1.0 ? 2e9 : 1e5, 1);
    if (material[i] == 1.0) {
      EXPECT_NEAR(energy[i], 2e9 / 1770.0, 1e-3);
    }
  }
  EXPECT_EQ(gas, fluid.particles_by_body()[1]);
  double mass = 0;
  for (const double m : fluid.field("mass")) mass += m;
  EXPECT_NEAR(mass, fluid.ledger().mass, 1e-12 * mass);
}

TEST(Fields, UnknownNamesAreRefused) {
  Fluid fluid(uniform());
  try {
    fluid.field("presure");
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("presure"), std::string::npos);
  }
}

}  // namespace
}  // namespace undex::sph::testing
