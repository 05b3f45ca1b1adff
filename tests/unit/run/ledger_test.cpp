// What every part of a run's ledger holds, where loads, planes, gravity and the water act on one body at once.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"

namespace undex::run::test {
namespace {

constexpr double area = 0.016 * 0.016, pressure = 1e5;  // of the plate [m^2]; of the water [Pa]

const std::string load = "[{face = \"z_high\", time = [0, 1], pressure = [1e5, 1e5]}]";

/// Water at 0.1 MPa below, a load of 0.1 MPa above: nothing moves but the plate's own ringing, as it takes up the pressure.
TEST(Ledger, EquilibriumStaysInEquilibrium) {
  const scene::Scene scene = read_text(plate_on_water, {{"structure.loads", load}, {"scheme.courant", "0.1"}});
  Simulation simulation(scene);
  const double impedance = 2700 * std::sqrt(7.1e10 * 0.67 / (1.33 * 0.34) / 2700);
  const auto middle = simulation.bodies().front()->locate(Vec3(0, 0, 0.003));
  double fastest = 0;
  while (simulation.time() < 100e-6) {
    simulation.advance(100e-6);
    fastest = std::max(fastest, std::abs(simulation.bodies().front()->read(middle).velocity[2]));
    ASSERT_LT(std::abs(simulation.energy().error()), 0.02) << simulation.time();
  }
  EXPECT_LT(fastest, pressure / impedance);  // the elastic wave's velocity
  EXPECT_NEAR(simulation.fluid()->at(Vec3(0, 0, -0.016)).pressure / pressure, 1.0, 0.02);
  EXPECT_LT(std::abs(simulation.bodies().front()->read(middle).displacement[2]), 1e-8);
  // What presses it from either side becomes its elastic and kinetic energy.
  const BodyLedger ledger = simulation.bodies().front()->ledger();
  EXPECT_GT(ledger.received + ledger.external, 0.0);
  EXPECT_NEAR(ledger.balance(), 0.0, 1e-3 * (ledger.received + ledger.external));
}

/// A load that throws the plate away from water without pressure: each entry has its own value.
TEST(Ledger, LoadsWorkIsNotTheInterfaces) {
  const scene::Scene scene =
      read_text(plate_on_water, {{"bodies.water.pressure", "1e6"},
                                 {"scheme.courant", "0.05"},
                                 {"structure.loads", "[{face = \"z_high\", time = [0, 1], pressure = [4e5, 4e5]}]"}});
  Simulation simulation(scene);
  run_to(simulation, 20e-6);
  const DeformableBody& plate = *simulation.bodies().front();
  const BodyLedger ledger = plate.ledger();
  // The load's work: pressure times area times the way of the face it acts on. One of four quarters is computed.
  const double way = plate.read(plate.locate(Vec3(0.004, 0.004, 0.006))).displacement[2];
  EXPECT_GT(way, 1e-6);
  EXPECT_NEAR(ledger.external / (-4e5 * 0.25 * area * way), 1.0, 0.01);
  EXPECT_NEAR(ledger.impulse[2] / (-4e5 * 0.25 * area * 20e-6), 1.0, 1e-9);
  const EnergyBalance e = simulation.energy();
  EXPECT_NEAR(e.external, 4 * ledger.external, 1e-12 * std::abs(e.external));
  EXPECT_NEAR(e.work_received, 4 * ledger.received, 1e-12 * std::abs(e.work_received));
  // The body's own balance closes, and the interface passes on what the water gives.
  EXPECT_NEAR(ledger.balance(), 0.0, 1e-4 * ledger.received);
  EXPECT_NEAR(e.work_given / e.work_received, 1.0, 0.02);
  EXPECT_NEAR(*simulation.interface_energy_error(), e.work_given / e.work_received - 1.0, 1e-4);
  EXPECT_LT(std::abs(e.error()), 0.01);
}

/// Free above and below: water, plate, load and gravity share one momentum.
TEST(Ledger, MomentumWithLoadsAndGravity) {
  const scene::Scene scene = read_text(plate_on_water, {{"structure.loads", load},
                                                        {"walls.duct.faces", "{z_high = \"open\", z_low = \"open\"}"},
                                                        {"gravity", "[0, 0, -1000]"},
                                                        {"scheme.precision", "\"full\""}});
  Simulation simulation(scene);
  run_to(simulation, 50e-6);
  EXPECT_LT(simulation.momentum_error(), 1e-12);  // of the axis along which the duct is open
  EXPECT_NE(simulation.energy().gravity, 0.0);
  EXPECT_TRUE(std::isnan(Simulation(read_text(plate_on_water)).momentum_error()));  // its floor pushes
}

}  // namespace
}  // namespace undex::run::test
