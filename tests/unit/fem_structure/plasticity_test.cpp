// Plastic flow: the limit pressure of a thick tube, and a Taylor bar.
#include <gtest/gtest.h>

#include <numbers>

#include "core/errors.hpp"

#include "bodies.hpp"

namespace undex::fem::testing {
namespace {

/// Radial displacement of the bore, in elastic deflections at the first yield, after a slow rise of the pressure to
/// `share` of the exact limit 2/sqrt(3) Y ln(b/a) of a long tube.
double bore_at(double share) {
  const double a = 0.1, b = 0.2, young = 200e9, yield = 200e6;
  Settings settings;
  settings.mesh = TubeMesh{.axis = 2,
                           .center = Vec3::Zero(),
                           .inner_radius = a,
                           .outer_radius = b,
                           .low = 0.0,
                           .high = 0.0125,
                           .cells_through = 8,
                           .cells_around = 48,
                           .cells_along = 1};
  settings.material = hardening(7800, young, 0.3, yield, 0.0);
  settings.symmetry_axes = {0, 1};
  settings.supports = {{"low", {false, false, true}}, {"high", {false, false, true}}};
  const double limit = 2.0 / std::sqrt(3.0) * yield * std::log(b / a);
  const double period = 2.0 * std::numbers::pi * b / std::sqrt(young / 7800), rise = 20.0 * period;
  settings.loads = {{"inner", {0.0, rise}, {0.0, share * limit}}};
  Structure tube(settings);
  tube.advance(rise + 5.0 * period, {});
  const auto bore = tube.locate(Vec3(a, 0, 0.006));
  return tube.read(bore).displacement[0] / (yield / young * a);
}

TEST(Plasticity, ThickTubeCollapsesAtItsLimitPressure) {
  const double below = bore_at(0.98), above = bore_at(1.02);
  RecordProperty("below", std::to_string(below));
  RecordProperty("above", std::to_string(above));
  EXPECT_LT(below, 12.0) << "a few elastic deflections: contained plastic flow";
  EXPECT_GT(above, 40.0) << "a collapse";
}

TEST(Plasticity, TaylorBarOfArmcoIron) {
  materials::Solid iron = elastic(7890, 1, 0.3);
  iron.name = "Armco iron";
  iron.shear_modulus = 80e9;
  iron.pressure = materials::LinearPressure{164e9};
  iron.flow = materials::JohnsonCook{.A = 175e6, .B = 380e6, .n = 0.32, .C = 0.06, .m = 0.55, .T_melt = 1811.0};
  iron.heat_capacity = 452.0;
  const double length = 25.4e-3, radius = 3.8e-3;
  Settings settings;
  settings.mesh = RodMesh{
      .axis = 2, .center = Vec3::Zero(), .radius = radius, .low = 0.0, .high = length, .cells_radial = 4, .cells_along = 32};
  settings.material = iron;
  settings.symmetry_axes = {0, 1};
  settings.supports = {{"low", {false, false, true}}};
  settings.initial_velocity = Vec3(0, 0, -221.0);
  Structure bar(settings);
  const double start = bar.ledger().balance();
  const auto end = bar.locate(Vec3(0, 0, length)), foot = bar.locate(Vec3(radius, 0, 0));
  bar.advance(60e-6, {});
  const BodyLedger energies = bar.ledger();
  const double final_length = bar.read(end).position[2], final_radius = bar.read(foot).position[0];
  RecordProperty("length_mm", std::to_string(1e3 * final_length));
  RecordProperty("foot_diameter_mm", std::to_string(2e3 * final_radius));
  RecordProperty("balance", std::to_string(energies.balance() / start - 1.0));
  RecordProperty("kinetic", std::to_string(energies.kinetic / start));
  EXPECT_NEAR(final_length, 19.8e-3, 0.05 * 19.8e-3);
  EXPECT_GT(final_radius, 1.3 * radius);
  EXPECT_LT(energies.kinetic, 0.01 * start) << "it has stopped";
  EXPECT_NEAR(energies.balance(), start, 1e-3 * start);
  EXPECT_GT(energies.plastic, 0.9 * start);

  // The heat is the Taylor-Quinney share of the plastic work.
  const BodySnapshot view = bar.snapshot();
  const std::vector<double>&displacement = view.of_points[0].values, &temperature = view.of_cells[3].values;
  double heat = 0.0;
  for (std::size_t c = 0; c < view.cells.size(); ++c) {
    Vec3 x[8];
    for (int i = 0; i < 8; ++i) {
      const int node = view.cells[c][i];
      x[i] = view.position[node] - Eigen::Map<const Vec3>(&displacement[3 * node]);
    }
    double volume = 0.0;  // of the reference prism: its section times its height
    const double height = x[4][2] - x[0][2];
    for (int i = 0; i < 4; ++i) {
      const Vec3 &p = x[i], &q = x[(i + 1) % 4];
      volume += 0.5 * (p[0] * q[1] - p[1] * q[0]) * height;
    }
    heat += iron.rho0 * std::abs(volume) * iron.heat_capacity * (temperature[c] - iron.T_room);
  }
  RecordProperty("heat_over_plastic", std::to_string(heat / energies.plastic));
  EXPECT_NEAR(heat, iron.taylor_quinney * energies.plastic, 0.01 * energies.plastic);
}

TEST(Plasticity, CrushedCellsStopTheRunWithItsPlace) {
  Settings settings = plate(Vec3(0, 0, 0), Vec3(1, 1, 1), {2, 2, 2}, elastic(1000, 1e6, 0.3));
  settings.loads = {{"x_low", {0.0}, {1e9}}};
  settings.supports = {{"x_high", {true, true, true}}};
  settings.name = "cushion";
  Structure cushion(settings);
  try {
    cushion.advance(1.0, {});
    FAIL() << "must not survive";
  } catch (const NumericalStop& stop) {
    const std::string text = stop.what();
    for (const char* part : {"cushion", "step", "time", "cell", "reference position", "courant"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace undex::fem::testing
