// Several structures in one scene: each as by itself, sums closed as with one, mirror images alike, an end where two meet.
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "run/observer.hpp"
#include "scenes.hpp"

namespace undex::run::test {
namespace {

/// A ring about z with its middle at x, under a pressure inside.
std::string ring(const std::string& header, const std::string& name, double x, int around, double pressure) {
  const auto text = [](double value) { return std::to_string(value); };
  return header + "\nname = \"" + name + "\"\nshape = {type = \"ring\", center = [" + text(x) +
         ", 0, 0], inner_radius = 0.04, outer_radius = 0.05, low = 0, high = 0.01}\ncells = {through = 2, around = " +
         std::to_string(around) + ", along = 2}\nmaterial = \"al-5083-h116\"\nsupports = [{face = \"low\", fixed = [\"z\"]}]\n" +
         "loads = [{face = \"inner\", time = [0, 1e-5, 2e-5], pressure = [0, " + text(pressure) + ", 0]}]\n";
}

const std::string top = "end_time = 60e-6\nthreads = 1\n";

/// Steps shorter than any is stable at: both scenes take the same.
TEST(SeveralStructures, FarApartEachIsAsByItself) {
  const scene::Scene both =
      read_text(top + ring("[[structures]]", "near", 0, 48, 2e8) + ring("[[structures]]", "far", 0.5, 32, 1e8));
  const scene::Scene near = read_text(top + ring("[structure]", "near", 0, 48, 2e8));
  const scene::Scene far = read_text(top + ring("[structure]", "far", 0.5, 32, 1e8));
  Simulation together(both), first(near), second(far);
  ASSERT_EQ(together.bodies().size(), 2u);
  const double step = 0.5 * first.bodies()[0]->stable_step();
  for (int k = 1; k <= 150; ++k)
    for (Simulation* each : {&together, &first, &second}) each->advance(k * step);
  EXPECT_GT(first.bodies()[0]->ledger().plastic, 0.0);
  for (const auto& [ours, theirs] : {std::pair{together.bodies()[0].get(), first.bodies()[0].get()},
                                     std::pair{together.bodies()[1].get(), second.bodies()[0].get()}}) {
    EXPECT_EQ(ours->steps(), theirs->steps());
    ASSERT_EQ(ours->positions().size(), theirs->positions().size());
    for (std::size_t i = 0; i < ours->positions().size(); ++i) ASSERT_EQ(ours->positions()[i], theirs->positions()[i]);
    EXPECT_EQ(ours->ledger().plastic, theirs->ledger().plastic);
    EXPECT_EQ(ours->ledger().external, theirs->ledger().external);
  }
  const std::vector<StructureAccount> accounts = together.accounts();
  ASSERT_EQ(accounts.size(), 2u);
  EXPECT_EQ(accounts[0].name, "near");
  EXPECT_EQ(accounts[1].external, second.energy().external);
  EXPECT_EQ(accounts[0].kinetic, first.energy().structure_kinetic);
  EXPECT_LT(std::abs(accounts[0].error), 1e-3);
  EXPECT_LT(std::abs(accounts[1].error), 1e-3);
  EXPECT_DOUBLE_EQ(together.energy().external, first.energy().external + second.energy().external);
  EXPECT_DOUBLE_EQ(together.energy().plastic, first.energy().plastic + second.energy().plastic);
  EXPECT_TRUE(first.accounts().empty());
}

/// Steps of their own choice: those of both are the shorter ones, which makes a difference of second order.
TEST(SeveralStructures, StepOfTheShortest) {
  Simulation together(read_text(top + ring("[[structures]]", "near", 0, 48, 2e8) + ring("[[structures]]", "far", 0.5, 32, 1e8)));
  Simulation far(read_text(top + ring("[structure]", "far", 0.5, 32, 1e8)));
  run_to(together, 60e-6);
  run_to(far, 60e-6);
  EXPECT_GT(together.steps(), far.steps());
  EXPECT_NEAR(together.accounts()[1].plastic / far.energy().plastic, 1.0, 2e-3);
  EXPECT_LT(std::abs(together.energy().error()), 2e-3);
}

/// Two discs that slide in a duct, water before, between and behind them, open at either end; the first is thrown at the second.
const std::string two_discs = R"(
end_time = 1e-3
threads = 1
dimension = "axisymmetric"
[scheme]
precision = "full"
courant = 0.1
[resolution]
spacing = 0.002
fit = "water"
[[bodies]]
name = "water"
shape = {type = "cylinder", axis = "z", radius = 0.016, low = -0.02, high = 0}
material = "water-tait"
pressure = 2e7
[[bodies]]
name = "gap"
shape = {type = "cylinder", axis = "z", radius = 0.016, low = 0.004, high = 0.024}
material = "water-tait"
pressure = 2e7
[[bodies]]
name = "behind"
shape = {type = "cylinder", axis = "z", radius = 0.016, low = 0.027, high = 0.047}
material = "water-tait"
pressure = 2e7
[[walls]]
name = "duct"
shape = {type = "cylinder", axis = "z", radius = 0.016, low = -0.1, high = 0.1}
faces = {low = "open", high = "open"}
[[structures]]
name = "front"
shape = {type = "rod", axis = "z", radius = 0.016, low = 0, high = 0.004}
cells = {radial = 4, along = 2}
material = "steel-4340"
wet = ["low", "high"]
velocity = [0, 0, 20]
supports = [{face = "side", fixed = ["x", "y"]}]
[[structures]]
name = "back"
shape = {type = "rod", axis = "z", radius = 0.016, low = 0.024, high = 0.027}
cells = {radial = 3, along = 1}
element = "shell"
material = "steel-hy100"
wet = ["low", "high"]
supports = [{face = "side", fixed = ["x", "y"]}]
)";

TEST(SeveralStructures, WithWaterBetweenShareOneMomentumAndEnergy) {
  Simulation simulation(read_text(two_discs));
  const double front = simulation.bodies()[0]->ledger().momentum[1];  // of rings, along the axis
  run_to(simulation, 40e-6);
  EXPECT_LT(simulation.bodies()[0]->ledger().momentum[1], 0.9 * front);
  EXPECT_GT(simulation.bodies()[1]->ledger().momentum[1], 0.02 * front);
  EXPECT_LT(simulation.momentum_error(), 1e-12);
  EXPECT_LT(*simulation.interface_impulse_error(), 1e-12);
  EXPECT_LT(std::abs(*simulation.interface_energy_error()), 0.02);
  EXPECT_LT(std::abs(simulation.energy().error()), 0.005);
  // The sums are made of what each has.
  const std::vector<StructureAccount> accounts = simulation.accounts();
  ASSERT_EQ(accounts.size(), 2u);
  const EnergyBalance e = simulation.energy();
  EXPECT_DOUBLE_EQ(accounts[0].received + accounts[1].received, e.work_received);
  EXPECT_DOUBLE_EQ(accounts[0].kinetic + accounts[1].kinetic, e.structure_kinetic);
  for (std::size_t k = 0; k < 2; ++k) {
    const BodyLedger ledger = simulation.bodies()[k]->ledger();
    EXPECT_NEAR(accounts[k].impulse[2], ledger.momentum[1] - (k == 0 ? front : 0.0), 1e-12 * front) << k;
    EXPECT_LT(std::abs(accounts[k].error), 1e-3) << k;
  }
}

/// What a structure does does not hang on its number in the file.
TEST(SeveralStructures, TheirOrderDoesNotMatter) {
  const auto order = [](const std::string& text, bool turned) {
    const std::size_t one = text.find("[[structures]]"), two = text.find("[[structures]]", one + 1);
    return turned ? text.substr(0, one) + text.substr(two) + text.substr(one, two - one) : text;
  };
  Simulation as_written(read_text(order(two_discs, false))), turned(read_text(order(two_discs, true)));
  run_to(as_written, 20e-6);
  run_to(turned, 20e-6);
  const auto a = as_written.accounts(), b = turned.accounts();
  ASSERT_EQ(a[0].name, b[1].name);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(a[k].received / b[1 - k].received, 1.0, 1e-9);
    EXPECT_NEAR(a[k].kinetic / b[1 - k].kinetic, 1.0, 1e-9);
  }
}

/// A plate on water that is cut in its middle: either half is the mirror image of the other.
const std::string halves = R"(
end_time = 1e-3
threads = 1
[scheme]
precision = "full"
[resolution]
spacing = 0.002
fit = "water"
[[bodies]]
name = "water"
shape = {type = "box", low = [-0.016, -0.008, -0.016], high = [0.016, 0.008, 0]}
material = "water-tait"
pressure = 1e6
[[walls]]
name = "duct"
shape = {type = "box", low = [-0.016, -0.008, -0.016], high = [0.016, 0.008, 0.03]}
faces = {z_high = "open"}
[[structures]]
name = "left"
shape = {type = "plate", low = [-0.016, -0.008, 0], high = [-0.001, 0.008, 0.004]}
cells = {x = 4, y = 3, z = 2}
material = "al-5083-h116"
wet = ["z_low"]
supports = [{face = "x_low"}]
loads = [{face = "z_high", time = [0, 1e-5], pressure = [0, 3e8]}]
[[structures]]
name = "right"
shape = {type = "plate", low = [0.001, -0.008, 0], high = [0.016, 0.008, 0.004]}
cells = {x = 4, y = 3, z = 2}
material = "al-5083-h116"
wet = ["z_low"]
supports = [{face = "x_high"}]
loads = [{face = "z_high", time = [0, 1e-5], pressure = [0, 3e8]}]
)";

TEST(SeveralStructures, HalvesMoveAsMirrorImages) {
  Simulation simulation(read_text(halves));
  run_to(simulation, 15e-6);
  const DeformableBody &left = *simulation.bodies()[0], &right = *simulation.bodies()[1];
  double most = 0;
  for (const Vec3& x : {Vec3(0.001, 0, 0.004), Vec3(0.008, 0.004, 0.002), Vec3(0.012, -0.008, 0), Vec3(0.001, 0.008, 0)}) {
    const Vec3 mirror(-x[0], x[1], x[2]);
    const Vec3 one = right.read(right.locate(x)).displacement, other = left.read(left.locate(mirror)).displacement;
    EXPECT_LT((one - Vec3(-other[0], other[1], other[2])).norm(), 1e-9 * one.norm()) << x.transpose();
    most = std::max(most, one.norm());
  }
  EXPECT_GT(most, 1e-4);
  EXPECT_GT(left.ledger().plastic, 0);
  EXPECT_NEAR(left.ledger().plastic / right.ledger().plastic, 1.0, 1e-9);
}

/// Without water between them nothing keeps them apart.
TEST(SeveralStructures, EndWhereTheyMeet) {
  const std::string flying = R"(
end_time = 1e-3
threads = 1
[[structures]]
name = "anvil"
shape = {type = "plate", low = [0, 0, 0], high = [0.02, 0.02, 0.01]}
material = "steel-4340"
[[structures]]
name = "hammer"
shape = {type = "plate", low = [0, 0, 0.012], high = [0.01, 0.01, 0.022]}
material = "steel-4340"
velocity = [0, 0, -100]
)";
  Simulation simulation(read_text(flying));
  std::string message;
  try {
    run_to(simulation, 1e-3);
  } catch (const NumericalStop& stop) {
    message = stop.what();
  }
  EXPECT_NE(message.find("structures 'anvil' and 'hammer' have met at ("), std::string::npos) << message;
  EXPECT_GT(simulation.time(), 20e-6);
  EXPECT_LT(simulation.time(), 30e-6);
}

}  // namespace
}  // namespace undex::run::test
