// Temperature behind plane shocks in particles, of both descriptions.
#include <gtest/gtest.h>

#include <cmath>

#include "materials/library.hpp"
#include "sph_solid/solids.hpp"
#include "tests/unit/materials/solid_hugoniot.hpp"

namespace undex::solid {
namespace {

class ShockTemperature : public ::testing::TestWithParam<Description> {};
INSTANTIATE_TEST_SUITE_P(Descriptions, ShockTemperature,
                         ::testing::Values(Description::total_lagrangian, Description::updated_lagrangian),
                         [](const auto& one) { return one.param == Description::total_lagrangian ? "Total" : "Updated"; });

struct Behind {
  double temperature, of_state;  ///< means [K]: of the particles, and of what their densities and energies say
};

/// Well behind the shocks in a bar in one dimension whose halves run into each other, each at `u` [m/s].
Behind behind_the_shock(Description description, double u) {
  const double length = 0.02;
  Body bar;
  bar.name = "bar";
  bar.shape = {Box{Vec3(-length, -1, -1), Vec3(length, 1, 1)}, {}};
  bar.material = *materials::find_solid("al-impact-table2");
  bar.description = description;
  Settings settings;
  settings.bodies = {bar};
  sph::Settings around;
  around.dimension = 1;
  around.lattice.spacing = 0.0001;
  around.numerics.threads = 1;
  Solids solids(settings, around);
  std::vector<Vec3> impulse(solids.particle_count(), Vec3::Zero());
  for (std::size_t i = 0; i < impulse.size(); ++i)
    impulse[i][0] = std::copysign(u, -solids.positions()[i][0]) * solids.masses()[i];
  solids.kick(impulse);
  solids.advance(0.55 * length / (5300 + 1.5 * u));
  const std::vector<double> T = solids.field("temperature"), rho = solids.field("density"), e = solids.field("energy");
  Behind mean{};
  int count = 0;
  for (std::size_t i = 0; i < T.size(); ++i) {
    const double x = std::abs(solids.positions()[i][0]);
    if (x < 0.1 * length || x > 0.25 * length) continue;
    mean.temperature += T[i];
    mean.of_state += materials::testing::temperature_of(bar.material, rho[i], e[i]);
    ++count;
  }
  return {mean.temperature / count, mean.of_state / count};
}

TEST_P(ShockTemperature, IsThatOfTheHugoniot) {
  for (const double u : {1000.0, 3090.0}) {
    const double exact = materials::testing::hugoniot_temperature(*materials::find_solid("al-impact-table2"), u);
    const Behind mean = behind_the_shock(GetParam(), u);
    EXPECT_NEAR(mean.temperature / mean.of_state, 1.0, 0.01) << u << " m/s";
    // Up to 2.5 % of the shock's energy stay in particles that swing about their mean motion, at any spacing.
    EXPECT_NEAR(mean.temperature / exact, 1.0, 0.025) << u << " m/s, exact " << exact << " K";
  }
}

}  // namespace
}  // namespace undex::solid
