// Water that runs into a plane at 200 m/s: a shock, whose exact state follows from mass and momentum alone, since Tait's law
// is barotropic: p - p0 = rho0 U u and rho (U - u) = rho0 U give u^2 = (p - p0)(1/rho0 - 1/rho).
#include <algorithm>

#include "bodies.hpp"

namespace undex::sph::testing {
namespace {

constexpr double speed = 200.0, length = 0.3, end = 60e-6, rest = 1e5;

materials::PressureSound tait(double rho) {
  return std::get<materials::TaitWater>(materials::find_fluid("water-tait")->law).evaluate(rho, 0.0);
}

/// Density behind the shock [kg/m^3].
double shocked_density(double rho0) {
  double low = rho0, high = 1.5 * rho0;
  for (int k = 0; k < 100; ++k) {
    const double rho = 0.5 * (low + high);
    ((tait(rho).pressure - rest) * (1 / rho0 - 1 / rho) < speed * speed ? low : high) = rho;
  }
  return low;
}

struct Shocked {
  double pressure = 0, density = 0, spacing = 0;  // means behind the front; density by the particles' distances
  double largest = 0;                             // pressure anywhere
};

Shocked run(double spacing, SchemeName scheme) {
  Settings settings = scene_1d(spacing, scheme);
  settings.numerics.courant = Numerics{}.courant;
  settings.symmetry.axis[0] = true;
  settings.bodies = {slab("water", 0, length, "water-tait", -speed)};
  settings.bodies[0].pressure = rest;
  Fluid fluid(settings);
  run_until(fluid, end);
  std::vector<double> x = along_x(fluid.field("position"));
  const std::vector<double> p = fluid.field("pressure"), rho = fluid.field("density");
  Shocked result;
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    result.largest = std::max(result.largest, p[i]);
    if (x[i] < 0.01 || x[i] > 0.05) continue;  // the front is at 0.1 m; next to the plane the start has left its mark
    result.pressure += p[i];
    result.density += rho[i];
    ++count;
  }
  result.pressure /= count;
  result.density /= count;
  std::sort(x.begin(), x.end());
  const auto first = std::lower_bound(x.begin(), x.end(), 0.01), last = std::lower_bound(x.begin(), x.end(), 0.05);
  result.spacing = (*last - *first) / double(last - first);
  return result;
}

class PlaneShock : public Schemes {};

TEST_P(PlaneShock, StateBehindItIsExactAtAnySpacing) {
  const double rho0 = materials::density_at(materials::find_fluid("water-tait")->law, rest, 0.0);
  const double rho = shocked_density(rho0), p = tait(rho).pressure;
  for (const double spacing : {2e-3, 1e-3}) {
    const Shocked found = run(spacing, GetParam());
    std::printf("  spacing %g: pressure %+.3f %%, density by distance %+.3f %%, overshoot %.2f %%\n", spacing,
                100 * (found.pressure / p - 1), 100 * (rho0 * spacing / found.spacing / rho - 1), 100 * (found.largest / p - 1));
    // With the weight rho_i in place of rho_j the pressure is 0.7 % low at every spacing. With corrected gradients it is 0.2 %
    // low: what expands again behind the front is corrected, what was compressed in it was not. (V_j alone: 0.4 % low.)
    EXPECT_NEAR(found.pressure / p, 1.0, GetParam() == SchemeName::riemann ? 1e-3 : 3e-3) << spacing;
    EXPECT_NEAR(found.density / rho, 1.0, 2e-4) << spacing;
    // The density that is carried is that of the particles' distances.
    EXPECT_NEAR(found.density * found.spacing, rho0 * spacing, 2e-3 * rho0 * spacing) << spacing;
    EXPECT_LT(found.largest / p, 1.035) << spacing;  // 4.6 % with 3 in place of 12 in the switch
  }
}

INSTANTIATE_TEST_SUITE_P(, PlaneShock, ::testing::Values(SchemeName::riemann, SchemeName::riemann_corrected),
                         [](const auto& c) { return name_of(c.param); });

}  // namespace
}  // namespace undex::sph::testing
