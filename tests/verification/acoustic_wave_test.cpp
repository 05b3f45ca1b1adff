// A standing sound wave of small amplitude in a closed column of water: its period is 2 L/c.
// On a lattice the discrete gradient of a linear field is M = -sum V x^2 F times the exact one, and sound travels at M c
// however fine the lattice. In 1D M is 0.98765 for Wendland's kernel at h = 1.5 dx (0.9974 in 2D, 1.0006 in 3D), and 1.0001
// for the Gaussian at h = 1.2 dx.
#include <numbers>

#include "bodies.hpp"

namespace undex::sph::testing {
namespace {

/// Period [s] measured between the first and the third passage through zero of the mode's velocity.
double period(int particles, SchemeName scheme, KernelName kernel, double eta, double& sound) {
  const double length = 1.0, amplitude = 0.1, pi = std::numbers::pi;
  Settings settings = scene_1d(length / particles, scheme);
  // A body has one velocity, so every particle is a body.
  for (int i = 0; i < particles; ++i) {
    const double low = length * i / particles, high = length * (i + 1) / particles;
    settings.bodies.push_back(
        slab("slice " + std::to_string(i), low, high, "water-tait", amplitude * std::sin(pi * 0.5 * (low + high) / length)));
    settings.bodies.back().pressure = 1e7;
  }
  Wall wall;
  wall.name = "ends";
  wall.container = Box{Vec3(0, -9, -9), Vec3(length, 9, 9)};
  settings.walls = {wall};
  settings.numerics.kernel = kernel;
  settings.numerics.eta = eta;
  settings.numerics.alpha = 0.05;
  settings.numerics.beta = 0;
  Fluid fluid(settings);
  fluid.step_limit();
  sound = fluid.field("sound_speed")[0];
  std::vector<double> crossings;
  double before = 0, time_before = 0;
  while (crossings.size() < 3 && fluid.time() < 5 * length / sound) {
    fluid.step(fluid.step_limit().step);
    const std::vector<double> x = along_x(fluid.field("position")), u = along_x(fluid.field("velocity"));
    double mode = 0;
    for (std::size_t i = 0; i < x.size(); ++i) mode += u[i] * std::sin(pi * x[i] / length);
    if (before * mode < 0) crossings.push_back(time_before + (fluid.time() - time_before) * before / (before - mode));
    before = mode;
    time_before = fluid.time();
  }
  return crossings.size() < 3 ? 0.0 : crossings[2] - crossings[0];
}

class AcousticWave : public Schemes {};

TEST_P(AcousticWave, PeriodConverges) {
  std::vector<double> error;
  for (const int particles : {16, 32, 64}) {
    double sound = 0;
    const double measured = period(particles, GetParam(), KernelName::gaussian, 1.2, sound);
    error.push_back(std::abs(measured * sound / 2.0 - 1.0));
    report("period_error_" + std::to_string(particles), error.back());
  }
  report("order", std::log2(error[0] / error[2]) / 2);
  EXPECT_LT(error[2], 0.01);
  EXPECT_LT(error[2], 0.5 * error[0]);
}

TEST_P(AcousticWave, EveryKernelCarriesSoundRightOnALattice) {
  double sound = 0;
  const double measured = period(64, GetParam(), KernelName::wendland_c2, 1.5, sound);
  report("period_error_wendland", measured * sound / 2.0 - 1.0);
  EXPECT_NEAR(measured * sound / 2.0, 1.0, 0.003);
}

/// Central fluxes of fourth order halve the error of the period on coarse lattices. (What is left is the limiter's.)
TEST(CorrectedWaves, HaveTheirPeriodOnCoarseLattices) {
  for (const int particles : {8, 16, 32}) {
    double sound = 0;
    const double fourth = period(particles, SchemeName::riemann_corrected, KernelName::wendland_c4, 1.3, sound) * sound / 2.0;
    const double second = period(particles, SchemeName::riemann, KernelName::wendland_c4, 1.3, sound) * sound / 2.0;
    std::printf("  %d spacings a wave: %.2e, in second order %.2e\n", 2 * particles, fourth - 1.0, second - 1.0);
    EXPECT_LT(std::abs(fourth - 1.0), 0.6 * std::abs(second - 1.0)) << 2 * particles << " spacings a wave";
  }
}

INSTANTIATE_TEST_SUITE_P(, AcousticWave, ::testing::Values(SchemeName::monaghan, SchemeName::riemann),
                         [](const auto& c) { return name_of(c.param); });

}  // namespace
}  // namespace undex::sph::testing
