// Water that meets a light wall: the longest window, the exact exponential of a plate before a column of water, and what a
// window longer than that does.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/errors.hpp"
#include "coupling/coupler.hpp"
#include "sph_solid/solids.hpp"

namespace undex::coupling::testing {
namespace {

const materials::Fluid water = materials::find_fluid("water-tait").value();
constexpr double rest_pressure = 1.5e6;  // three times what the tests add or take, so that nothing cavitates [Pa]
const double rho = materials::density_at(water.law, rest_pressure, 0.0);
const double sound = std::get<materials::TaitWater>(water.law).evaluate(rho, 0.0).sound_speed;

/// A rigid plate of unit area at x = 0, with the water's pressure at rest behind it.
class RigidPlate : public DeformableBody {
 public:
  explicit RigidPlate(double mass) : mass_(mass), nodal_mass_(4, 0.25 * mass) {
    surface_.nodes = {{0, -0.5, -0.5}, {0, 0.5, -0.5}, {0, 0.5, 0.5}, {0, -0.5, 0.5}};
    surface_.faces = {{0, 1, 2, 3}};
    position_ = surface_.nodes;
    velocity_.assign(4, Vec3::Zero());
    acceleration_.assign(4, Vec3::Zero());
  }
  const WetSurface& wet_surface() const override { return surface_; }
  std::span<const Vec3> wet_positions() const override { return position_; }
  std::span<const Vec3> wet_velocities() const override { return velocity_; }
  std::span<const Vec3> wet_accelerations() const override { return acceleration_; }
  std::span<const double> wet_masses() const override { return nodal_mass_; }
  double time() const override { return time_; }
  long steps() const override { return 0; }
  double stable_step() const override { return 1e-12; }  // a window is a step of the water
  void advance(double t_end, std::span<const Vec3> impulse) override {
    const double dt = t_end - time_;
    double received = 0.0;
    for (const Vec3& one : impulse) received += one[0];
    const double a = (received / dt - rest_pressure) / mass_, path = dt * (velocity() + 0.5 * dt * a);
    work_ += received * path / dt;
    for (int n = 0; n < 4; ++n) {
      position_[n][0] += path;
      velocity_[n][0] += dt * a;
      acceleration_[n][0] = a;
    }
    time_ = t_end;
  }
  void visit_state(StateVisitor&) override {}
  BodyLedger ledger() const override {
    BodyLedger ledger;
    ledger.received = work_;
    return ledger;
  }
  // What the coupling does not ask for.
  std::string stable_step_owner() const override { return {}; }
  BodyPoint locate(const Vec3&) const override { return {}; }
  MaterialPoint read(const BodyPoint&) const override { return {}; }
  std::span<const Vec3> positions() const override { return position_; }
  std::span<const double> masses() const override { return nodal_mass_; }
  BodySnapshot snapshot(std::span<const std::string>) const override { return {}; }
  BodySize size() const override { return {}; }
  std::string description() const override { return {}; }
  std::size_t memory_bytes() const override { return 0; }
  const PassTimers& timers() const override { return timers_; }
  double velocity() const { return velocity_[0][0]; }
  /// Kinetic energy, and what the pressure behind has taken [J].
  double energy() const { return 0.5 * mass_ * velocity() * velocity() + rest_pressure * position_[0][0]; }

 private:
  double mass_, time_ = 0.0, work_ = 0.0;
  WetSurface surface_;
  std::vector<Vec3> position_, velocity_, acceleration_;
  std::vector<double> nodal_mass_;
  PassTimers timers_;
};

/// A column of water of one dimension and spacing 1 m that runs onto the plate, whose mass is that of `layers` layers of
/// particles. Times are in units of spacing over sound speed. The plate's velocity is u (1 - exp(-t/layers)) until the far
/// end is felt.
struct Column {
  static constexpr double speed = 0.3;  // [m/s]
  sph::Fluid fluid;
  RigidPlate plate;
  Flow flow{fluid};
  Coupler coupler;
  double start_energy;

  static sph::Settings settings(double length, std::optional<double> fixed_step) {
    sph::Settings s;
    s.dimension = 1;
    s.lattice.spacing = 1.0;
    sph::Body& body = s.bodies.emplace_back();
    body.name = "water";
    body.shape.base = Box{Vec3(-length, -1, -1), Vec3(0, 1, 1)};
    body.material = water;
    body.velocity = Vec3(speed, 0, 0);
    body.pressure = rest_pressure;
    s.numerics.threads = 1;
    if (fixed_step) s.numerics.fixed_step = *fixed_step / sound;
    return s;
  }
  explicit Column(double layers, double length, std::optional<double> fixed_step = {})
      : fluid(settings(length, fixed_step)), plate(layers * rho), coupler(flow, plate, {}), start_energy(energy()) {}

  double energy() const {
    const sph::Ledger l = fluid.ledger();
    return l.kinetic + l.internal + l.dissipated + plate.energy();
  }
  /// To `end`; the largest velocity of the plate over the water's on the way.
  double run(double end) {
    double fastest = 0.0;
    while (fluid.time() < end / sound * (1 - 1e-9)) {
      window = coupler.advance(end / sound);
      fastest = std::max(fastest, plate.velocity() / speed);
    }
    return fastest;
  }
  Coupler::Window window;
};

TEST(AddedMass, LimitInClosedForm) {
  const sph::Settings column = Column::settings(20, {});
  for (const double layers : {0.01, 0.25, 4.0}) {
    const sph::StepLimit limit = added_mass_limit(column, RigidPlate(layers * rho));
    EXPECT_NEAR(limit.step, 0.3 * std::sqrt(layers) / sound, 1e-12 * limit.step);
    EXPECT_EQ(limit.criterion, "added mass");
    EXPECT_EQ(limit.body, "water");
    EXPECT_EQ(limit.position[0], 0.0);
  }
  // Half the spacing, half the layer's mass and twice its stiffness.
  sph::Settings fine = column;
  fine.bodies[0].spacing = 0.25;
  EXPECT_NEAR(added_mass_limit(fine, RigidPlate(rho)).step, 0.5 * 0.3 / sound, 1e-12);
  // Of two liquids the nearest counts; gas does not.
  sph::Settings two = column;
  two.bodies.push_back(two.bodies[0]);
  two.bodies[1].name = "oil";
  two.bodies[1].material = {"oil", "", materials::StiffenedGas({.rho0 = 800.0, .gamma = 1.1, .p_inf = 1e9}), 800.0};
  two.bodies[1].density = 800.0;
  two.bodies[1].energy = (rest_pressure + 1.1e9) / (0.1 * 800.0);
  two.bodies[0].shape.base = Box{Vec3(-2, -1, -1), Vec3(0, 1, 1)};
  two.bodies[1].shape.base = Box{Vec3(-20, -1, -1), Vec3(-2, 1, 1)};
  EXPECT_EQ(added_mass_limit(two, RigidPlate(rho)).body, "water");
  std::swap(two.bodies[0].shape, two.bodies[1].shape);
  const sph::StepLimit beside_oil = added_mass_limit(two, RigidPlate(rho));
  EXPECT_EQ(beside_oil.body, "oil");
  EXPECT_NEAR(beside_oil.step, 0.3 * std::sqrt(rho / (1.1 * (rest_pressure + 1e9))), 1e-9 * beside_oil.step);
  two.bodies[1].variable_h = true;
  EXPECT_EQ(added_mass_limit(two, RigidPlate(rho)).body, "water");
  two.bodies[0].variable_h = true;
  EXPECT_EQ(added_mass_limit(two, RigidPlate(rho)).step, std::numeric_limits<double>::infinity());
}

/// A sheet of particles two spacings thick: its nodes share its mass about as they share its area.
TEST(AddedMass, NodesOfParticlesShareTheirMass) {
  sph::Settings settings;
  settings.lattice.spacing = 0.01;
  solid::Body sheet;
  sheet.name = "sheet";
  sheet.shape.base = Box{Vec3(-0.1, -0.1, 0), Vec3(0.1, 0.1, 0.02)};
  sheet.material = materials::find_solid("al-5083-h116").value();
  sheet.wet = {"z_low"};
  settings.numerics.threads = 1;
  solid::Solids solids({.bodies = {sheet}, .numerics = {}, .planes = {}}, settings);
  solids.mesh_wet_faces();
  const auto mass = solids.wet_masses();
  const std::vector<Vec3>& x = solids.wet_surface().nodes;
  ASSERT_EQ(mass.size(), x.size());
  double sum = 0.0;
  const double behind = sheet.material.rho0 * 0.02 * 0.01 * 0.01;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    sum += mass[n];
    if (std::max(std::abs(x[n][0]), std::abs(x[n][1])) < 0.075) {
      EXPECT_NEAR(mass[n], behind, 0.15 * behind) << x[n].transpose();
    }
    EXPECT_GT(mass[n], 0.15 * behind);
  }
  EXPECT_NEAR(sum, solids.ledger().mass, 1e-12);
}

/// The wall of the experiment's tube, 6.35 mm of aluminium, at the spacings in use: the water's own step is the shorter one.
TEST(AddedMass, OrdinaryWallsAreNotSlowed) {
  for (const double spacing : {0.004, 0.003, 0.002, 0.001}) {
    Column column(2700 * 0.00635 / rho / spacing, 40);
    const double own = column.fluid.step_limit().step;
    EXPECT_GT(added_mass_limit(column.fluid.settings(), column.plate).step, 1.1 * own) << spacing;
    const Coupler::Window window = column.coupler.advance(1.0);
    EXPECT_EQ(window.step, own);
    EXPECT_EQ(window.limit.criterion, "Courant");
  }
}

/// Exact solution: u (1 - exp(-t/tau)), tau = m/(rho c).
TEST(AddedMass, PlateFollowsTheExactExponential) {
  double last = 0.0;
  for (const double layers : {4.0, 8.0, 16.0, 32.0}) {
    Column column(layers, 6 * layers + 20);
    double error = 0.0;
    const int samples = 30;
    for (int i = 1; i <= samples; ++i) {
      const double t = 2.0 * i / samples;  // over tau
      column.run(t * layers);
      error += std::abs(column.plate.velocity() / Column::speed - (1 - std::exp(-t))) / samples;
    }
    std::printf("  plate of %2.0f layers: L1 error of its velocity %.4f\n", layers, error);
    if (last > 0) {
      EXPECT_LT(error, 0.65 * last) << layers;
    }
    last = error;
  }
  EXPECT_LT(last, 0.01);
}

/// At one spacing, the error in time alone: mean over twelve of the longest steps.
TEST(AddedMass, SecondOrderInTheStep) {
  for (const double layers : {1.0, 0.2, 0.05}) {
    const double first = 0.3 * std::sqrt(layers);
    const auto velocities = [&](int refined) {
      Column column(layers, 40, first / refined);
      std::vector<double> found;
      for (int i = 1; i <= 12; ++i) {
        column.run(i * first);
        found.push_back(column.plate.velocity() / Column::speed);
      }
      return found;
    };
    const std::vector<double> exact = velocities(64);
    double error[3] = {};
    for (const int k : {0, 1, 2}) {
      const std::vector<double> found = velocities(1 << k);
      for (std::size_t i = 0; i < found.size(); ++i) error[k] += std::abs(found[i] - exact[i]) / double(found.size());
    }
    std::printf("  plate of %.2f layers, limit and its half and quarter: errors %.2e, %.2e, %.2e\n", layers, error[0], error[1],
                error[2]);
    EXPECT_LT(error[0], 0.05);
    EXPECT_GT(std::log2(error[0] / error[1]), 1.7);
    EXPECT_GT(std::log2(error[1] / error[2]), 1.7);
  }
}

/// A plate much lighter than a layer: the first particle throws it, at twice the water's velocity at most, and energy holds.
TEST(AddedMass, LightPlatesAreHeldByTheLimit) {
  for (const double layers : {0.3, 0.1, 0.03, 0.01}) {
    Column column(layers, 40);
    const double fastest = column.run(10);
    EXPECT_EQ(column.window.limit.criterion, "added mass") << layers;
    const InterfaceLedger ledger = column.coupler.ledger();
    EXPECT_LT((ledger.impulse_given - ledger.impulse_received).norm(), 1e-13 * ledger.impulse_exchanged);
    // Over what the wave that the plate sends back would have done to a rigid wall.
    const double scale = rho * Column::speed * Column::speed * 10;
    const double energy = (column.energy() - column.start_energy) / scale,
                 work = (ledger.work_given - ledger.work_received) / scale;
    std::printf("  plate of %.2f layers: at most %.3f of the water's velocity, energy error %.1e, of the interface %.1e\n",
                layers, fastest, energy, work);
    EXPECT_GT(fastest, 1.0);
    EXPECT_LT(fastest, 2.0);
    EXPECT_LT(std::abs(energy), 0.01);
    EXPECT_LT(std::abs(work), 0.01);
  }
}

/// What the limit is for: the water's own step, which would do for a plate as heavy as a layer.
TEST(AddedMass, LightPlatesBreakTheWatersOwnStep) {
  Column column(0.01, 40, 0.5);
  double fastest = 0.0;
  try {
    fastest = column.run(10);
  } catch (const NumericalStop&) {
    fastest = std::numeric_limits<double>::infinity();
  }
  EXPECT_GT(fastest, 4.0);
}

}  // namespace
}  // namespace undex::coupling::testing
