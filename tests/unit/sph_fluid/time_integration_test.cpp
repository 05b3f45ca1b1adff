// The integrators: observed order, what they conserve whatever the step, and how large a step they bear.
#include <algorithm>
#include <numbers>
#include <set>

#include "refused_step.hpp"

namespace undex::sph::testing {
namespace {

constexpr double pi = std::numbers::pi;

/// A closed column of water of a metre with a smooth wave in it, without dissipation.
Settings column(Integrator integrator, int particles, double amplitude) {
  Settings s;
  s.dimension = 1;
  s.lattice.spacing = 1.0 / particles;
  s.numerics.threads = 1;
  s.numerics.scheme = SchemeName::monaghan;
  s.numerics.alpha = s.numerics.beta = 0;
  s.numerics.integrator = integrator;
  s.numerics.courant = default_courant(integrator, s.numerics.kernel);
  Body water = body("water", box(Vec3(0, -1, -1), Vec3(1, 1, 1)), "water-tait");
  StartField field;
  field.state = [=](const Vec3& x, double) { return StartState{1010.0, 0.0, Vec3(amplitude * std::sin(pi * x[0]), 0, 0)}; };
  field.mass = 1010.0;
  field.kinetic_energy = 1010.0 * amplitude * amplitude / 4;
  water.start = std::make_shared<StartField>(field);
  s.bodies = {water};
  s.walls = {box_wall(Vec3(0, -9, -9), Vec3(1, 9, 9))};
  return s;
}

struct OfOrder {
  Integrator integrator;
  double order;
};
class Order : public ::testing::TestWithParam<OfOrder> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Order,
                         ::testing::Values(OfOrder{Integrator::leapfrog, 2.0}, OfOrder{Integrator::ssp_rk3, 3.0}),
                         [](const auto& one) { return one.param.order > 2 ? "ssp_rk3" : "leapfrog"; });

/// On one lattice, so that the error in space drops out of the differences between steps of dt, dt/2 and dt/4. A small wave:
/// where particles move by more of a spacing, pairs enter and leave the kernel's support, whose third derivative jumps there, and
/// so does the Runge-Kutta method's order fall to 2.4.
TEST_P(Order, SmoothWave) {
  std::vector<std::vector<Vec3>> velocity, position;
  std::vector<double> energy;
  const int first = 64;
  for (const int steps : {first, 2 * first, 4 * first, 8 * first}) {
    Fluid fluid(column(GetParam().integrator, 32, 1.0));
    const double start = total(fluid.ledger()), end = 8e-4;
    for (int k = 0; k < steps; ++k) fluid.step(end / steps);
    velocity.push_back(by_id(fluid, "velocity"));
    position.push_back(by_id(fluid, "position"));
    energy.push_back(std::abs(total(fluid.ledger()) - start) / fluid.ledger().kinetic);
  }
  const auto distance = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
    return std::sqrt(sum / double(a.size()));
  };
  const auto order_of = [&](const std::vector<std::vector<Vec3>>& u) {
    return std::log2(distance(u[1], u[2]) / distance(u[2], u[3]));
  };
  RecordProperty("order_velocity", std::to_string(order_of(velocity)));
  RecordProperty("order_energy", std::to_string(std::log2(energy[2] / energy[3])));
  EXPECT_GT(order_of(velocity), GetParam().order - 0.2);
  EXPECT_GT(order_of(position), GetParam().order - 0.2);
  EXPECT_GT(std::log2(energy[2] / energy[3]), GetParam().order - 0.2);
  EXPECT_LT(distance(velocity[2], velocity[3]), 1.0);
}

/// A free blob of water with gas in it loses neither mass nor momentum, and energy to the integrator's error alone.
TEST(SspRk3, FreeBlob) {
  for (const auto& [name, scheme] : scheme_names) {
    std::vector<double> error;
    for (const double courant : {0.4, 0.2}) {
      Settings s;
      s.dimension = 2;
      s.lattice.spacing = 0.05;
      const Sphere bubble{Vec3(0.1, 0.05, 0), 0.3};
      Body water = body("water", Shape{Sphere{Vec3::Zero(), 0.8}, {bubble}}, "water-tait"),
           gas = body("gas", Shape{bubble, {}}, "bubble-gas");
      water.pressure = 5e7;
      water.velocity = {20, -10, 0};
      gas.density = 300.0;
      gas.variable_h = true;
      s.bodies = {water, gas};
      s.numerics.threads = 1;
      s.numerics.scheme = scheme;
      s.numerics.integrator = Integrator::ssp_rk3;
      s.numerics.courant = courant;
      Fluid fluid(s);
      const Ledger start = fluid.ledger();
      while (fluid.time() < 4e-4) fluid.step(fluid.step_limit().step);
      const Ledger end = fluid.ledger();
      const std::vector<double> m = fluid.field("mass"), v = fluid.field("velocity");
      double speed_sum = 0;
      for (std::size_t i = 0; i < m.size(); ++i) speed_sum += m[i] * vector_of(v, i).norm();
      EXPECT_NEAR(end.mass, start.mass, 1e-14 * start.mass);
      EXPECT_LT((end.momentum - start.momentum).norm(), 1e-12 * speed_sum);
      error.push_back(std::abs(total(end) - total(start)) / end.kinetic);
    }
    RecordProperty(name, std::to_string(error[0]) + " " + std::to_string(error[1]));
    EXPECT_LT(error[0], 5e-3) << name;
    EXPECT_LT(error[1], 0.3 * error[0]) << name;
  }
}

/// What the fluid loses, a wall that moves receives, over whole steps: momentum to round-off, energy but for the step's error.
TEST(SspRk3, MovingWallReceivesWhatTheFluidLoses) {
  std::vector<double> error;
  for (const double courant : {0.4, 0.2}) {
    Settings s;
    s.dimension = 2;
    s.lattice.spacing = 0.02;
    s.numerics.threads = 1;
    s.numerics.integrator = Integrator::ssp_rk3;
    s.numerics.courant = courant;
    s.bodies = {body("water", box(Vec3(0, 0, -1), Vec3(0.2, 0.3, 1)), "water-tait")};
    s.bodies[0].velocity = Vec3(5, -40, 0);
    Fluid fluid(s);
    LinedWall wall;
    for (int row = 0; row < 4; ++row)
      for (int k = -5; k < 15; ++k) wall.position.push_back(Vec3(0.02 * (k + 0.5), -0.02 * (row + 0.5), 0));
    wall.velocity.assign(wall.position.size(), Vec3(0, 10, 0));
    wall.normal.assign(wall.position.size(), Vec3(0, -1, 0));
    wall.volume.assign(wall.position.size(), 4e-4);
    const auto index = fluid.add_wall(wall);
    const Ledger start = fluid.ledger();
    while (fluid.time() < 2e-4) {
      const double dt = fluid.step_limit().step;
      for (Vec3& x : fluid.wall(index).position) x[1] += 10 * dt;
      fluid.step(dt);
    }
    Vec3 received = Vec3::Zero();
    for (const Vec3& impulse : fluid.wall(index).impulse) received += impulse;
    const Ledger end = fluid.ledger();
    EXPECT_LT(received[1], 0.2 * start.momentum[1]);  // it has been struck
    EXPECT_LT((end.momentum + received - start.momentum).norm(), 1e-12 * start.momentum.norm());
    EXPECT_NEAR(end.wall_work, 10.0 * received[1], 1e-9 * std::abs(end.wall_work));
    error.push_back(std::abs(total(end) / total(start) - 1.0));
  }
  RecordProperty("energy_error", std::to_string(error[0]) + " " + std::to_string(error[1]));
  EXPECT_LT(error[0], 0.01);
  EXPECT_LT(error[1], 0.4 * error[0]);
}

/// Two jets of gas meet; half of the scene behind a symmetry plane is as good as the whole, though particles cross the plane.
TEST(SspRk3, SymmetryPlane) {
  double kinetic[2], internal[2];
  for (const bool half : {false, true}) {
    Settings s;
    s.dimension = 1;
    s.lattice.spacing = 0.02;
    s.numerics.threads = 1;
    s.numerics.integrator = Integrator::ssp_rk3;
    s.numerics.courant = 0.5;
    // One body in both: pairs of two bodies are not those of one.
    Body jets =
        body("jets", Shape{Box{Vec3(half ? 0 : -0.5, -1, -1), Vec3(0.5, 1, 1)}, {Box{Vec3(-0.05, -1, -1), Vec3(0.05, 1, 1)}}},
             "sjogreen-gas");
    StartField field;
    field.state = [](const Vec3& x, double) { return StartState{0.5, 0.0, Vec3(x[0] > 0 ? -4 : 4, 0, 0)}; };
    jets.start = std::make_shared<StartField>(field);
    s.bodies = {jets};
    s.symmetry.axis[0] = half;
    Fluid fluid(s);
    for (int k = 0; k < 400; ++k) fluid.step(2.5e-4);
    kinetic[half] = fluid.ledger().kinetic;
    internal[half] = fluid.ledger().internal;
  }
  EXPECT_NEAR(2 * kinetic[1] / kinetic[0], 1.0, 1e-7);
  EXPECT_NEAR(2 * internal[1] / internal[0], 1.0, 1e-7);
}

/// At a Courant number of 1.5 (it bears 1.6; the leapfrog 0.4 without viscosity, 0.5 with the Riemann scheme) the shortest waves
/// of a lattice do not grow.
TEST(SspRk3, BearsItsStep) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann})
    for (const Integrator integrator : {Integrator::ssp_rk3, Integrator::leapfrog}) {
      Settings s = column(integrator, 64, 1e-3);
      s.numerics.scheme = scheme;
      s.numerics.courant = 1.5;
      const auto smooth = s.bodies[0].start->state;
      auto field = std::make_shared<StartField>(*s.bodies[0].start);
      field->state = [=](const Vec3& x, double dx) {
        StartState state = smooth(x, dx);
        state.velocity *= std::sin(1e4 * x[0]);  // all that the lattice can hold
        return state;
      };
      s.bodies[0].start = field;
      Fluid fluid(s);
      const double start = fluid.ledger().kinetic;
      double largest = 0;
      for (int k = 0; k < 500 && largest < 1e3 * start; ++k) {
        fluid.step(fluid.step_limit().step);
        largest = std::max(largest, fluid.ledger().kinetic);
      }
      if (integrator == Integrator::ssp_rk3) EXPECT_LT(largest, 1.5 * start);
      else EXPECT_GT(largest, 1e2 * start);
    }
}

/// The coefficient of a switched viscosity moves as it does with the leapfrog: what both dissipate meets as the step falls, and
/// is far less than with the coefficient held at its bound.
TEST(SspRk3, SwitchedViscosity) {
  const auto dissipated = [](SchemeName scheme, Integrator integrator, double dt) {
    Settings s = column(integrator, 64, 20.0);
    s.numerics.scheme = scheme;
    s.numerics.alpha = 1.0;
    s.numerics.beta = 2.0;
    Fluid fluid(s);
    for (int n = 0; n < std::lround(2e-3 / dt); ++n) fluid.step(dt);
    return fluid.ledger().dissipated;
  };
  double difference[2];
  for (const int k : {0, 1}) {
    const double dt = 2e-6 / (1 + k), rk = dissipated(SchemeName::monaghan_switch, Integrator::ssp_rk3, dt);
    difference[k] = std::abs(dissipated(SchemeName::monaghan_switch, Integrator::leapfrog, dt) / rk - 1.0);
    EXPECT_LT(rk, 0.7 * dissipated(SchemeName::monaghan, Integrator::ssp_rk3, dt));
  }
  RecordProperty("difference", std::to_string(difference[0]) + " " + std::to_string(difference[1]));
  EXPECT_LT(difference[0], 0.01);
  EXPECT_LT(difference[1], 0.6 * difference[0]);
}

/// A step that goes wrong in any of its stages is not taken: everything is as it was before, to the last digit. Two streams meet
/// just below the speed at which a run is stopped, or one of them and a symmetry plane that it crosses; a wall moves behind.
TEST(SspRk3, RefusedStepLeavesItsStart) {
  for (const SchemeName scheme : {SchemeName::monaghan, SchemeName::riemann, SchemeName::monaghan_switch})
    for (const bool half : {false, true}) {
      Settings s;
      s.dimension = 1;
      s.lattice.spacing = 0.05;
      s.numerics.scheme = scheme;
      s.numerics.threads = 1;
      s.numerics.integrator = Integrator::ssp_rk3;
      s.numerics.beta = 2.0;
      const double speed = scheme == SchemeName::riemann ? 4.9e6 : 2.5e6;
      s.bodies = {body("right", box(Vec3(0, 0, 0), Vec3(1, 0, 0)), "water-tait")};
      s.bodies[0].velocity = {-speed, 0, 0};
      if (half) {
        s.symmetry.axis[0] = true;
      } else {
        s.bodies.push_back(body("left", box(Vec3(-1, 0, 0), Vec3(0, 0, 0)), "water-tait"));
        s.bodies[1].velocity = {speed, 0, 0};
      }
      std::set<bool> outcomes;
      for (double dt = 1e-10; dt < 1e-3; dt *= 1.5) {
        Fluid fluid(s);
        const auto wall = fluid.add_wall(layers_beyond(1, 1, -speed));
        fluid.step(1e-13);
        outcomes.insert(refuses(fluid, wall, dt));
      }
      EXPECT_EQ(outcomes, (std::set<bool>{false, true})) << int(scheme) << half;
    }
}

}  // namespace
}  // namespace undex::sph::testing
