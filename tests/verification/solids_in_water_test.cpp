// Water against solids in particles, in a strip of the plane between slip walls: reflection and transmission of a plane wave as
// the impedances say, water at rest and water that pulls.
#include <algorithm>

#include "bodies.hpp"
#include "coupling/particle_system.hpp"

namespace undex::sph::testing {
namespace {

constexpr double spacing = 0.002;

/// Without lateral strain under stress along x: a bar's wave is a plane one.
materials::Solid bar(double density, double wave_speed = 5000.0) {
  const double E = density * wave_speed * wave_speed;
  materials::Solid solid;
  solid.name = "bar";
  solid.rho0 = density;
  solid.shear_modulus = 0.5 * E;
  solid.pressure = materials::LinearPressure{E / 3.0};
  solid.flow = materials::Elastic{};
  return solid;
}

Shape between(double low, double high, double width) { return {Box{Vec3(low, 0, 0), Vec3(high, width, 0)}, {}}; }

Body water(const std::string& name, double low, double high, double width, double pressure) {
  Body body;
  body.name = name;
  body.shape = between(low, high, width);
  body.material = materials::find_fluid("water-tait").value();
  body.pressure = pressure;
  return body;
}

/// Water in a duct on the right of a solid that fills it from -`length` to 0.
class Duct {
 public:
  Duct(std::vector<Body> bodies, double width, double end, const materials::Solid& solid, double length, SchemeName scheme,
       double around, bool closed = false) {
    settings_.dimension = 2;
    settings_.lattice.spacing = spacing;
    settings_.numerics.scheme = scheme;
    settings_.numerics.threads = 1;
    settings_.bodies = std::move(bodies);
    settings_.surroundings.pressure = around;
    Wall walls{.name = "duct", .container = Box{Vec3(-1, 0, -1), Vec3(end, width, 1)}, .faces = {}};
    for (const char* face : {"y_low", "y_high"}) walls.faces[face] = FaceCondition::free_slip;
    walls.faces["x_low"] = FaceCondition::open;
    walls.faces["x_high"] = closed ? FaceCondition::free_slip : FaceCondition::open;
    settings_.walls = {walls};
    solid::Body block;
    block.name = "block";
    block.shape = between(-length, 0, width);
    block.material = solid;
    block.wet = {"x_high"};
    solid_settings_.bodies = {block};
    fluid_ = std::make_unique<Fluid>(settings_);
    solids_ = std::make_unique<solid::Solids>(solid_settings_, settings_);
    solids_->mesh_wet_faces();
    flow_ = std::make_unique<coupling::Flow>(*fluid_);
    system_ = std::make_unique<coupling::ParticleSystem>(*flow_, *solids_, coupling::Settings{});
    fluid_->settle();
  }

  void run_to(double end) {
    while (fluid_->time() < end * (1 - 1e-12)) system_->advance(end);
  }
  const Fluid& fluid() const { return *fluid_; }

  double pressure_between(double low, double high) const {
    const std::vector<double> x = fluid_->field("position"), p = fluid_->field("pressure");
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (x[3 * i] > low && x[3 * i] < high) sum += p[i], ++count;
    return sum / count;
  }
  /// The means of -sigma_xx and the velocity.
  std::pair<double, double> solid_between(double low, double high) const {
    double stress = 0, velocity = 0;
    int count = 0;
    for (std::size_t i = 0; i < solids_->particle_count(); ++i) {
      if (solids_->positions()[i][0] < low || solids_->positions()[i][0] > high) continue;
      stress -= solids_->stress(i)(0, 0);
      velocity += solids_->velocities()[i][0];
      ++count;
    }
    return {stress / count, velocity / count};
  }

 private:
  Settings settings_;
  solid::Settings solid_settings_;
  std::unique_ptr<Fluid> fluid_;
  std::unique_ptr<solid::Solids> solids_;
  std::unique_ptr<coupling::Flow> flow_;
  std::unique_ptr<coupling::ParticleSystem> system_;
};

class SolidInWater : public Schemes {};

TEST_P(SolidInWater, ReflectsAndTransmitsAsTheImpedancesSay) {
  const double rest = 1e5, incident = 1e6, width = 5 * spacing;
  for (const auto& [density, wave_speed] :
       {std::pair(2.7e6, 5000.0), {2700.0, 5000.0}, {1200.0, 2500.0}, {1000.0, 1500.0}, {300.0, 5000.0}}) {
    Body still = water("still", 0, 0.06, width, rest), wave = water("wave", 0.06, 0.4, width, rest + incident);
    const materials::TaitWater law{materials::TaitWater::Parameters{}};
    const double Z = law.density_at(rest) * law.evaluate(law.density_at(rest), 0).sound_speed, Zs = density * wave_speed;
    wave.velocity = Vec3(-incident / Z, 0, 0);
    Duct duct({still, wave}, width, 0.4, bar(density, wave_speed), 0.4, GetParam(), rest);
    duct.run_to(100e-6);
    const double passed = incident * 2.0 * Zs / (Z + Zs);
    const auto [stress, velocity] = duct.solid_between(-0.06, -0.02);
    const double before = duct.pressure_between(0.01, 0.06) - rest;
    report("water over the exact one, solid of " + scientific(density), before / passed);
    report("stress", stress / passed);
    report("velocity", -velocity * Zs / passed);
    EXPECT_NEAR(before / passed, 1.0, 0.006) << density;
    EXPECT_NEAR(stress / passed, 1.0, 0.006) << density;
    EXPECT_NEAR(-velocity * Zs / passed, 1.0, 0.006) << density;
  }
}

TEST_P(SolidInWater, RestsUnderPressure) {
  const double rest = 1e7, width = 5 * spacing;
  Duct duct({water("water", 0, 0.05, width, rest)}, width, 0.05, bar(2.7e9), 0.03, GetParam(), 0.0, true);
  duct.run_to(1e-3);
  double worst = 0;
  for (const double p : duct.fluid().field("pressure")) worst = std::max(worst, std::abs(p / rest - 1.0));
  EXPECT_LT(worst, 0.002);
}

TEST_P(SolidInWater, IsPulledByWaterThatCarriesTension) {
  materials::TaitWater::Parameters parameters;
  parameters.cavitation = materials::Cavitation::none;
  const materials::TaitWater law{parameters};
  const double speed = 5.0, rest = 1e5, N = parameters.N, B = parameters.B;
  // As in tension_test.cpp: c falls by (N - 1)/2 times the speed.
  const double c = law.evaluate(law.density_at(rest), 0).sound_speed - 0.5 * (N - 1) * speed;
  const double exact = B * (std::pow(c * c * parameters.rho0 / (N * B), N / (N - 1)) - 1) + parameters.A;
  for (const int across : {5, 10}) {
    const double width = across * spacing;
    Body pulling = water("water", 0, 0.6, width, rest);
    pulling.material.name = "water in tension";
    pulling.material.law = law;
    pulling.velocity = Vec3(speed, 0, 0);
    Duct duct({pulling}, width, 2.0, bar(2.7e7), 0.05, GetParam(), 0.0);
    duct.run_to(1.5e-4);
    EXPECT_NEAR(duct.pressure_between(0.02, 0.12) / exact, 1.0, 0.01) << across;
  }
}

INSTANTIATE_TEST_SUITE_P(, SolidInWater,
                         ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected, SchemeName::monaghan),
                         [](const auto& c) { return name_of(c.param); });

}  // namespace
}  // namespace undex::sph::testing
