// Waves and vibrations with exact answers.
#include <gtest/gtest.h>

#include <numbers>

#include "bodies.hpp"

namespace undex::fem::testing {
namespace {

/// First time at which the value falls through zero, by linear interpolation; `value` is asked after every step.
template <class Value>
double first_fall_through_zero(Structure& structure, double t_end, const Value& value) {
  double old_time = structure.time(), old_value = 0.0;
  while (structure.time() < t_end) {
    structure.advance(structure.time() + structure.stable_step(), {});
    const double now = value();
    if (old_value > 0.0 && now <= 0.0) return old_time + (structure.time() - old_time) * old_value / (old_value - now);
    old_time = structure.time();
    old_value = now;
  }
  return -1.0;
}

/// A bar held at z_high and thrown along z: its free end is back where it began after two passages of the wave.
double wave_speed_of_bar(double width, bool held_sideways, const materials::Solid& material) {
  const double length = 1.0;
  Settings settings = plate(Vec3(0, 0, 0), Vec3(width, width, length), {1, 1, 100}, material);
  settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
  settings.supports = {{"z_high", {false, false, true}}};
  if (held_sideways)
    for (const char* face : {"x_low", "x_high", "y_low", "y_high"})
      settings.supports.push_back({face, {face[0] == 'x', face[0] == 'y', false}});
  settings.initial_velocity = Vec3(0, 0, 0.1);
  Structure bar(settings);
  const auto end = bar.locate(Vec3(0.5 * width, 0.5 * width, 0));
  const double speed = materials::wave_speed(material);
  const double back = first_fall_through_zero(bar, 5.0 * length / speed, [&] { return bar.read(end).displacement[2]; });
  return 2.0 * length / back;
}

TEST(Dynamics, DilatationalWaveSpeed) {
  const auto material = elastic(2700.0, 71e9, 0.33);
  const double speed = wave_speed_of_bar(0.01, true, material);
  RecordProperty("error", std::to_string(speed / materials::wave_speed(material) - 1.0));
  EXPECT_NEAR(speed / materials::wave_speed(material), 1.0, 0.003);
}

TEST(Dynamics, SlenderBarWaveSpeed) {
  const double speed = wave_speed_of_bar(0.02, false, elastic(2700.0, 71e9, 0.33));
  RecordProperty("error", std::to_string(speed / std::sqrt(71e9 / 2700.0) - 1.0));
  EXPECT_NEAR(speed / std::sqrt(71e9 / 2700.0), 1.0, 0.005);
}

/// A bar that begins to hang by its top: the lower end falls freely until the wave from the top has come, and is lowest,
/// at g L^2/c^2, when it has come back: twice as low as at rest.
TEST(Dynamics, BarThatBeginsToHang) {
  const double length = 1.0, width = 0.02, g = 1e4;
  const auto material = elastic(2700.0, 71e9, 0.0);  // one-dimensional by itself
  Settings settings = plate(Vec3(0, 0, 0), Vec3(width, width, length), {1, 1, 100}, material);
  settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
  settings.supports = {{"z_high", {true, true, true}}};
  settings.gravity = Vec3(0, 0, -g);
  Structure bar(settings);
  const auto end = bar.locate(Vec3(0.5 * width, 0.5 * width, 0));
  const double speed = materials::wave_speed(material), lowest = g * length * length / (speed * speed);
  bar.advance(0.9 * length / speed, {});
  EXPECT_NEAR(bar.read(end).displacement[2], -0.5 * g * bar.time() * bar.time(), 1e-4 * lowest);
  bar.advance(2.0 * length / speed, {});
  EXPECT_NEAR(bar.read(end).displacement[2], -lowest, 2e-3 * lowest);
  const BodyLedger energies = bar.ledger();
  EXPECT_GT(energies.gravity, 0.0);
  EXPECT_LT(std::abs(energies.balance()), 2e-3 * energies.gravity);
}

Settings thin_ring(const materials::Solid& material, double radius, double thickness) {
  Settings settings;
  settings.mesh = TubeMesh{.axis = 2,
                           .center = Vec3::Zero(),
                           .inner_radius = radius - 0.5 * thickness,
                           .outer_radius = radius + 0.5 * thickness,
                           .low = 0.0,
                           .high = thickness,
                           .cells_through = 2,
                           .cells_around = 96,
                           .cells_along = 1};
  settings.material = material;
  settings.symmetry_axes = {0, 1};
  return settings;
}

TEST(Dynamics, RingBreathes) {
  const double radius = 0.5, thickness = 0.005, pressure = 1e4;
  Settings settings = thin_ring(elastic(2700.0, 71e9, 0.33), radius, thickness);
  settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
  settings.loads = {{"inner", {0.0}, {pressure}}};
  Structure ring(settings);
  const auto point = ring.locate(Vec3(radius, 0, 0.5 * thickness));
  const double frequency = std::sqrt(71e9 / 2700.0) / radius;
  const double swing = first_fall_through_zero(ring, 10.0 / frequency, [&] { return ring.read(point).velocity[0]; });
  RecordProperty("error", std::to_string(swing * frequency / std::numbers::pi - 1.0));
  EXPECT_NEAR(swing * frequency / std::numbers::pi, 1.0, 0.003);
  // Twice the static deflection at the turn.
  const double still = pressure * (radius - 0.5 * thickness) * radius / (71e9 * thickness);
  EXPECT_NEAR(ring.read(point).displacement[0] / (2.0 * still), 1.0, 0.01);
  const BodyLedger energies = ring.ledger();
  EXPECT_NEAR(energies.balance(), 0.0, 1e-4 * energies.external);
}

TEST(Dynamics, PlasticRingUnderAPulse) {
  const double radius = 0.5, thickness = 0.005, density = 2700.0, young = 71e9, yield = 150e6, tangent = 1e9;
  const double peak = 60e6, decay = 20e-6;
  Settings settings = thin_ring(hardening(density, young, 0.33, yield, tangent), radius, thickness);
  PressureLoad pulse{"inner", {}, {}};
  for (int i = 0; i <= 400; ++i) {
    pulse.time.push_back(i * 0.025 * decay);
    pulse.pressure.push_back(peak * std::exp(-i * 0.025));
  }
  pulse.time.push_back(400.5 * 0.025 * decay);
  pulse.pressure.push_back(0.0);
  settings.loads = {pulse};
  Structure ring(settings);
  const auto point = ring.locate(Vec3(radius, 0, 0.5 * thickness));

  // One degree of freedom: rho V r'' = p (inner area) - sigma V / r, uniaxial hoop stress with logarithmic strain.
  double r = radius, v = 0.0, stress = 0.0, plastic = 0.0, strain = 0.0, time = 0.0, largest_r = r;
  const double dt = 2e-9, t_end = 1e-3;
  const auto advance_ode = [&](double to) {
    while (time < to) {
      const double p = time < 10.0 * decay ? peak * std::exp(-time / decay) : 0.0;
      const double width = std::sqrt(radius / r);  // the section shrinks alike in both directions
      const double acceleration =
          p * (r - 0.5 * thickness * width) * width / (density * thickness * radius) - stress / (density * r);
      v += dt * acceleration;
      r += dt * v;
      const double increment = std::log(r / radius) - strain;
      strain += increment;
      stress += young * increment;
      const double limit = yield + tangent * plastic;
      if (std::abs(stress) > limit) {
        const double flow = (std::abs(stress) - limit) / (young + tangent);
        plastic += flow;
        stress -= std::copysign(young * flow, stress);
      }
      time += dt;
      largest_r = std::max(largest_r, r);
    }
  };
  double largest_displacement = 0.0;
  for (int sample = 1; sample <= 100; ++sample) {
    ring.advance(sample * t_end / 100, {});
    advance_ode(sample * t_end / 100);
    const auto now = ring.read(point);
    largest_displacement = std::max(largest_displacement, now.displacement[0]);
    EXPECT_NEAR(now.displacement[0], r - radius, 0.01 * (largest_r - radius)) << "sample " << sample;
  }
  EXPECT_GT(largest_r - radius, 0.02 * radius) << "the pulse must strain the ring well beyond yield";
  EXPECT_NEAR(largest_displacement / (largest_r - radius), 1.0, 0.01);
  EXPECT_NEAR(ring.read(point).plastic_strain / plastic, 1.0, 0.01);
  RecordProperty("error_largest", std::to_string(largest_displacement / (largest_r - radius) - 1.0));
  RecordProperty("error_plastic_strain", std::to_string(ring.read(point).plastic_strain / plastic - 1.0));
  const BodyLedger energies = ring.ledger();
  RecordProperty("balance", std::to_string(energies.balance() / energies.external));
  EXPECT_NEAR(energies.balance(), 0.0, 1e-4 * energies.external);
}

}  // namespace
}  // namespace undex::fem::testing
