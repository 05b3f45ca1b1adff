// The one-dimensional solver: conservation, order on smooth waves, shock tubes against the exact Riemann
// solution, classical implosion and explosion, and what it answers when asked.
#include "exact/lagrangian_1d.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "core/errors.hpp"
#include "exact/classical.hpp"
#include "exact/riemann.hpp"
#include "materials/library.hpp"

namespace undex::exact {
namespace {

using materials::FluidLaw;

FluidLaw fluid(const char* name) { return materials::find_fluid(name)->law; }
FluidLaw ideal(double gamma) { return materials::IdealGas({.rho0 = 1.0, .gamma = gamma}); }
double detonation_energy() { return std::get<materials::Jwl>(fluid("petn")).parameters().E0; }

/// Products, water and gas: one layer of every kind.
std::vector<Layer> mixed_layers(double inner) {
  return {{.law = fluid("petn"), .inner = inner, .outer = inner + 0.01, .cells = 40, .density = 1500, .energy = 3e6},
          {.law = fluid("water-tait"), .inner = inner + 0.01, .outer = inner + 0.03, .cells = 60, .density = 1000},
          {.law = fluid("water-steinberg"), .inner = inner + 0.03, .outer = inner + 0.05, .cells = 60, .density = 1000},
          {.law = fluid("bubble-gas"), .inner = inner + 0.05, .outer = inner + 0.06, .cells = 30, .density = 100},
          {.law = fluid("air"), .inner = inner + 0.06, .outer = inner + 0.08, .cells = 30, .density = 1.2, .energy = 2e5}};
}

TEST(Lagrangian1D, ClosedBoxKeepsItsEnergy) {
  for (const int d : {1, 2, 3}) {
    Lagrangian1D s(d, mixed_layers(0.0));
    const double start = s.total_energy();
    double mass = 0;
    for (const double m : s.cell_mass()) mass += m;
    s.advance(40e-6);  // shocks have gone to and fro
    EXPECT_GT(s.kinetic_energy(), 1e-3 * start);
    EXPECT_NEAR(s.total_energy() / start, 1.0, 1e-13) << d;
    EXPECT_GT(s.barotropic_heat(), 0.0);
    double volume_mass = 0;
    for (int i = 0; i < s.cells(); ++i) {
      const auto in = s.integral(s.node_radius()[i], s.node_radius()[i + 1]);
      volume_mass += in.volume * s.cell_density()[i];
    }
    EXPECT_NEAR(volume_mass / mass, 1.0, 1e-12);
    EXPECT_EQ(s.time(), 40e-6);
  }
}

TEST(Lagrangian1D, OpenEndsAreBookedAndPlanarMomentumIsKept) {
  Lagrangian1D free(1, mixed_layers(-0.04), Boundary::free, Boundary::free);
  const double start = free.total_energy();
  const double weight = std::sqrt(2.0 * start * 100.0);  // a momentum to compare with
  free.advance(20e-6);
  EXPECT_NEAR(free.integral(-1.0, 1.0).momentum / weight, 0.0, 1e-13);
  EXPECT_EQ(free.boundary_work(), 0.0);
  EXPECT_NEAR(free.total_energy() / start, 1.0, 1e-13);
  Lagrangian1D held(2, mixed_layers(0.01), Boundary::free, Boundary::free, {.inner_pressure = 3e8, .outer_pressure = 2e8});
  const double held_start = held.total_energy();
  held.advance(10e-6);
  EXPECT_GT(std::abs(held.boundary_work()), 0.01 * held_start);
  EXPECT_NEAR((held.total_energy() + held.boundary_work()) / held_start, 1.0, 1e-13);
  Lagrangian1D open(3, mixed_layers(0.01), Boundary::rigid, Boundary::transmitting);
  const double open_start = open.total_energy();
  open.advance(60e-6);
  EXPECT_GT(open.boundary_work(), 0.001 * open_start);
  EXPECT_NEAR((open.total_energy() + open.boundary_work()) / open_start, 1.0, 1e-12);
}

TEST(Lagrangian1D, StillWaterStaysStillToTheBit) {
  const FluidLaw law = fluid("water-tait");
  const double rho = materials::density_at(law, 1e5, 0.0);
  for (const Boundary outer : {Boundary::transmitting, Boundary::radiating}) {
    Lagrangian1D s(3, {{.law = law, .inner = 0, .outer = 0.7, .cells = 333, .ratio = 1.01, .density = rho}}, Boundary::rigid,
                   outer);
    s.advance(1e-4);
    for (const double u : s.node_velocity()) ASSERT_EQ(u, 0.0);
    for (const double density : s.cell_density()) ASSERT_EQ(density, rho);
  }
}

TEST(Lagrangian1D, SecondOrderOnASmoothWave) {
  // Standing sound wave of small amplitude between walls, after three quarters of its period.
  const double c = std::sqrt(1.4 * 0.4), amplitude = 1e-5, pi = std::numbers::pi;
  double last = 0.0;
  for (const int n : {40, 80, 160}) {
    std::vector<Layer> layers;
    for (int i = 0; i < n; ++i) {
      Layer layer{.law = ideal(1.4), .inner = double(i) / n, .outer = double(i + 1) / n, .cells = 1, .density = 1, .energy = 1};
      layer.velocity = amplitude * std::sin(pi * (i + 0.5) / n);
      layers.push_back(layer);
    }
    Lagrangian1D s(1, layers);
    s.advance(1.8 / c);
    double error = 0;
    for (int i = 0; i <= n; ++i)
      error += std::abs(s.node_velocity()[i] / amplitude - std::sin(pi * i / n) * std::cos(1.8 * pi)) / n;
    if (last > 0) {
      EXPECT_GT(std::log2(last / error), 1.85) << n;
    }
    last = error;
  }
  EXPECT_LT(last, 2e-3);
}

/// Relative L1 errors of density, velocity and pressure against a Riemann solution about x = 0.
struct Errors {
  double density, velocity, pressure;
};
Errors errors(const Lagrangian1D& s, const RiemannSolution& exact) {
  Errors e{};
  double rho = 0, u = 0, p = 0;
  for (int i = 0; i < s.cells(); ++i) {
    const double from = s.node_radius()[i], to = s.node_radius()[i + 1];
    const RiemannSample x = exact.sample(0.5 * (from + to) / s.time());
    const double width = to - from, speed = 0.5 * (s.node_velocity()[i] + s.node_velocity()[i + 1]);
    e.density += width * std::abs(s.cell_density()[i] - x.density);
    e.velocity += width * std::abs(speed - x.velocity);
    e.pressure += width * std::abs(s.cell_pressure()[i] - x.pressure);
    rho += width * x.density;
    u += width * std::abs(x.velocity);
    p += width * x.pressure;
  }
  return {e.density / rho, e.velocity / u, e.pressure / p};
}

/// Two materials on [-1, 1] with 100 and 400 cells each, at time t: errors of the finer, and mean order.
void compare_with_exact(const char* name, const RiemannSide& left, const RiemannSide& right, double t, double limit,
                        double least_order) {
  const RiemannSolution exact(left, right);
  Errors by_mesh[2];
  for (const int k : {0, 1}) {
    const int n = k == 0 ? 100 : 400;
    Layer a{.law = left.law, .inner = -1, .outer = 0, .cells = n, .density = left.density};
    Layer b{.law = right.law, .inner = 0, .outer = 1, .cells = n, .density = right.density};
    a.energy = left.energy;
    b.energy = right.energy;
    Lagrangian1D s(1, {a, b}, Boundary::transmitting, Boundary::transmitting);
    s.advance(t);
    by_mesh[k] = errors(s, exact);
  }
  const auto judge = [&](const char* field, double coarse, double fine) {
    EXPECT_LT(fine, limit) << name << ", " << field;
    EXPECT_GT(0.5 * std::log2(coarse / fine), least_order) << name << ", " << field;
  };
  judge("density", by_mesh[0].density, by_mesh[1].density);
  judge("velocity", by_mesh[0].velocity, by_mesh[1].velocity);
  judge("pressure", by_mesh[0].pressure, by_mesh[1].pressure);
}

TEST(Lagrangian1D, SodsTube) {
  compare_with_exact("sod", {ideal(1.4), 1.0, 0.0, 2.5}, {ideal(1.4), 0.125, 0.0, 2.0}, 0.4, 0.005, 0.9);
}

TEST(Lagrangian1D, GasAgainstWater) {
  compare_with_exact("gas-water", {fluid("bubble-gas"), 1770.0, 0.0}, {fluid("water-tait"), 1000.0, 0.0}, 3.5e-4, 0.005, 0.9);
}

TEST(Lagrangian1D, ProductsAgainstWater) {
  compare_with_exact("jwl-mg", {fluid("petn"), 1770.0, 0.0, detonation_energy()}, {fluid("water-steinberg"), 1000.0, 0.0, 100.0},
                     1.2e-4, 0.005, 0.85);
}

TEST(Lagrangian1D, TornWater) {
  // Scene of the cavitating tube: position of the wave, speed change across it, edge of the cavity.
  const FluidLaw law = fluid("water-tait");
  const double rho = materials::density_at(law, 1e5, 0.0), t = 2e-4;
  const RiemannSolution exact({law, rho, -100.0}, {law, rho, 100.0});
  const int n = 400;
  Lagrangian1D s(1,
                 {{.law = law, .inner = -0.5, .outer = 0, .cells = n, .density = rho, .velocity = -100},
                  {.law = law, .inner = 0, .outer = 0.5, .cells = n, .density = rho, .velocity = 100}},
                 Boundary::free, Boundary::free, {.inner_pressure = 1e5, .outer_pressure = 1e5});
  s.advance(t);
  double wave = 0, edge = 0, error = 0;
  for (int i = n; i < 2 * n; ++i) {
    const double x = 0.5 * (s.node_radius()[i] + s.node_radius()[i + 1]);
    if (s.cell_pressure()[i] < 5e4) wave = x;
    // The cell at the middle is the cavity, with its own liquid somewhere in it.
    if (s.cell_density()[i] < 500) edge = s.node_radius()[i + 1] - s.cell_mass()[i] / rho;
    if (x < 0.45)
      error += std::abs(s.cell_pressure()[i] - exact.sample(x / t).pressure) * (s.node_radius()[i + 1] - s.node_radius()[i]);
  }
  // The mesh's dispersion makes the half level of a sharp fan lag by some t^(1/3) dx^(2/3).
  EXPECT_NEAR(wave, 0.32768, 3.0 * 0.5 / n);
  EXPECT_NEAR(edge, 0.01998, 0.1 * 0.5 / n);
  EXPECT_NEAR(s.at(0.2).velocity, exact.sample(0.2 / t).velocity, 0.005);
  EXPECT_LT(error / 0.45, 1.5e3);
}

TEST(Lagrangian1D, NohsImplosion) {
  for (const int d : {1, 2, 3}) {
    double last = 0.0;
    const Noh noh{.dimension = d};
    for (const int n : {100, 200}) {
      Lagrangian1D s(d,
                     {{.law = ideal(5. / 3), .inner = 0, .outer = 1, .cells = n, .density = 1, .energy = 1e-9, .velocity = -1}},
                     Boundary::rigid, Boundary::free);
      s.advance(0.6);
      double error = 0;
      for (int i = 0; s.node_radius()[i + 1] < 0.35; ++i) {
        const double from = s.node_radius()[i], to = s.node_radius()[i + 1];
        error += (to - from) * std::abs(s.cell_density()[i] - noh.sample(0.5 * (from + to), 0.6).density);
      }
      error /= 0.35 * std::pow(4.0, d);
      if (last > 0) {
        EXPECT_GT(std::log2(last / error), 0.7) << d;
        EXPECT_LT(error, 0.12);
        EXPECT_NEAR(s.shock_front(0.5), 0.2, 0.013) << d;
      }
      last = error;
    }
  }
}

TEST(Lagrangian1D, SedovsBlast) {
  for (const int d : {1, 2, 3}) {
    const int n = 400;
    const double first = 1.2 / n, energy = 1.0;
    const double volume = (d == 1 ? 1.0 : d == 2 ? std::numbers::pi : 4.0 / 3 * std::numbers::pi) * std::pow(first, d);
    Lagrangian1D s(d, {{.law = ideal(1.4), .inner = 0, .outer = first, .cells = 1, .density = 1, .energy = energy / volume},
                       {.law = ideal(1.4), .inner = first, .outer = 1.2, .cells = n - 1, .density = 1, .energy = 1e-12}});
    const Sedov exact(d, 1.4, 1.0, energy);
    const double t = std::sqrt(exact.energy_integral());  // front at 1
    s.advance(t);
    double error = 0, sum = 0;
    for (int i = 0; i < n; ++i) {
      const double from = s.node_radius()[i], to = s.node_radius()[i + 1];
      const double rho = exact.sample(0.5 * (from + to), t).density;
      error += (to - from) * std::abs(s.cell_density()[i] - rho);
      sum += (to - from) * rho;
    }
    EXPECT_NEAR(s.shock_front(0.05), 1.0, 0.01) << d;
    EXPECT_LT(error / sum, 0.05) << d;
  }
}

TEST(Lagrangian1D, TransmittingEndLetsSoundOut) {
  const FluidLaw law = fluid("water-tait");
  const double rho = materials::density_at(law, 1e5, 0.0);
  Lagrangian1D s(1,
                 {{.law = law, .inner = 0, .outer = 0.2, .cells = 50, .density = materials::density_at(law, 2e6, 0.0)},
                  {.law = law, .inner = 0.2, .outer = 1, .cells = 200, .density = rho}},
                 Boundary::rigid, Boundary::transmitting);
  const double start = s.kinetic_energy() + s.internal_energy();
  s.advance(1.5e-3);  // a reflected pulse would still be inside
  EXPECT_LT(s.kinetic_energy(), 1e-5 * s.boundary_work());
  for (const double p : s.cell_pressure()) EXPECT_NEAR(p, 1e5, 2e4);
  EXPECT_GT(start, 0.0);
}

/// A layer of 10 cm at a higher pressure in water of 1 m or of 4 m: the wave leaves the short one as it goes on in the long one,
/// and in a sphere so does the flow after it.
TEST(Lagrangian1D, RadiatingEndIsWaterWithoutEnd) {
  const FluidLaw law = fluid("water-tait");
  const double rho = materials::density_at(law, 1e5, 0.0);
  for (const int d : {1, 2, 3})
    for (const double over : {1e5, 2e8}) {
      const auto water = [&](double end, Boundary outer) {
        const double high = materials::density_at(law, 1e5 + over, 0.0);
        return Lagrangian1D(d,
                            {{.law = law, .inner = 0, .outer = 0.1, .cells = 20, .density = high},
                             {.law = law, .inner = 0.1, .outer = end, .cells = int(200 * (end - 0.1) + 0.5), .density = rho}},
                            Boundary::rigid, outer);
      };
      Lagrangian1D here = water(0.5, Boundary::radiating), longer = water(3.0, Boundary::rigid);
      const double start = here.total_energy();
      double peak = 0, difference = 0;
      for (int k = 1; k <= 60; ++k) {
        here.advance(2e-5 * k);
        longer.advance(2e-5 * k);
        const double p = longer.at(0.4).pressure;
        peak = std::max(peak, p - 1e5);
        difference = std::max(difference, std::abs(here.at(0.4).pressure - p));
      }
      RecordProperty("difference_" + std::to_string(d) + (over > 1e6 ? "_strong" : "_weak"), std::to_string(difference / peak));
      EXPECT_LT(difference, (d == 2 ? 0.025 : 0.01) * peak) << d << ' ' << over;  // of a cylinder the first term alone
      EXPECT_NEAR((here.total_energy() + here.boundary_work()) / start, 1.0, 1e-12);
    }
}

TEST(Lagrangian1D, IntervalsTileTheWhole) {
  for (const int d : {1, 2, 3}) {
    Lagrangian1D s(d, mixed_layers(0.0));
    s.advance(7e-6);
    const double end = s.node_radius().back();
    IntervalIntegral sum;
    for (int k = 0; k < 37; ++k)
      for (int layer = 0; layer < s.layers(); ++layer) {
        const auto part = s.integral(end * std::pow(k / 37.0, 1.3), end * std::pow((k + 1) / 37.0, 1.3), layer);
        sum.volume += part.volume;
        sum.mass += part.mass;
        sum.momentum += part.momentum;
        sum.kinetic_energy += part.kinetic_energy;
        sum.internal_energy += part.internal_energy;
      }
    const auto whole = s.integral(-1, 2 * end);
    double mass = 0;
    for (const double m : s.cell_mass()) mass += m;
    EXPECT_NEAR(sum.mass / mass, 1.0, 1e-12);
    EXPECT_NEAR(whole.mass / mass, 1.0, 1e-13);
    EXPECT_NEAR(sum.volume / whole.volume, 1.0, 1e-12);
    EXPECT_NEAR(sum.momentum / whole.momentum, 1.0, 1e-11);
    EXPECT_NEAR(sum.kinetic_energy / s.kinetic_energy(), 1.0, 1e-12);
    EXPECT_NEAR(sum.internal_energy / s.internal_energy(), 1.0, 1e-12);
    const double v = whole.velocity();
    EXPECT_NEAR(whole.mass * (whole.energy_with_lost_motion() + 0.5 * v * v), s.total_energy(), 1e-12 * s.total_energy());
    const auto layer = s.integral(0, end, 1);
    EXPECT_NEAR(layer.volume, s.integral(s.interface_radius(0), s.interface_radius(1)).volume, 1e-12 * layer.volume);
    EXPECT_EQ(s.integral(2 * end, 3 * end).mass, 0.0);
  }
}

TEST(Lagrangian1D, PointsAndFront) {
  const FluidLaw law = fluid("water-tait");
  Lagrangian1D s(3, {{.law = ideal(1.4), .inner = 0, .outer = 0.1, .cells = 10, .density = 2, .energy = 3},
                     {.law = law, .inner = 0.1, .outer = 0.3, .cells = 20, .density = 1000}});
  EXPECT_EQ(s.at(0.0999).density, 2.0);  // no mixing across the contact
  EXPECT_EQ(s.at(0.1001).density, 1000.0);
  EXPECT_EQ(s.at(0.1001).layer, 1);
  EXPECT_EQ(s.at(0.3).pressure, s.cell_pressure().back());
  EXPECT_THROW(s.at(0.31), std::out_of_range);
  EXPECT_EQ(s.shock_front(1e6), 0.0);  // nowhere
  Lagrangian1D hot(1, {{.law = law, .inner = 0, .outer = 1, .cells = 10, .density = 1100},
                       {.law = law, .inner = 1, .outer = 2, .cells = 10, .density = 1000}});
  const double step = hot.cell_pressure()[0] - 1e5;
  EXPECT_NEAR(hot.shock_front(0.5 * step), 1.0, 1e-12);
  EXPECT_NEAR(hot.shock_front(0.25 * step), 1.025, 1e-12);
}

TEST(Lagrangian1D, Grading) {
  for (const double first : {0.001, 0.01, 0.03}) {
    const double ratio = grading(1.0, 100, first);
    double sum = 0, width = first;
    for (int i = 0; i < 100; ++i, width *= ratio) sum += width;
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
  EXPECT_NEAR(grading(1.0, 100, 0.01), 1.0, 1e-9);
  EXPECT_THROW(grading(1.0, 10, 2.0), std::invalid_argument);
  Lagrangian1D s(1, {{.law = ideal(1.4), .inner = 1, .outer = 3, .cells = 7, .ratio = 1.3, .density = 1, .energy = 1}});
  EXPECT_EQ(s.node_radius().back(), 3.0);
  EXPECT_NEAR((s.node_radius()[7] - s.node_radius()[6]) / (s.node_radius()[6] - s.node_radius()[5]), 1.3, 1e-12);
}

TEST(Lagrangian1D, RefusesWhatDoesNotFit) {
  const Layer good{.law = ideal(1.4), .inner = 0, .outer = 1, .cells = 4, .density = 1, .energy = 1};
  const auto bad = [&](auto change) {
    Layer layer = good;
    change(layer);
    EXPECT_THROW(Lagrangian1D(3, {layer}), std::invalid_argument);
  };
  bad([](Layer& l) { l.outer = 0; });
  bad([](Layer& l) { l.cells = 0; });
  bad([](Layer& l) { l.density = 0; });
  bad([](Layer& l) { l.ratio = -1; });
  bad([](Layer& l) { l.inner = -0.5; });
  bad([](Layer& l) { l.burn.emplace(); });
  EXPECT_THROW(Lagrangian1D(4, {good}), std::invalid_argument);
  EXPECT_THROW(Lagrangian1D(3, {}), std::invalid_argument);
  EXPECT_THROW(Lagrangian1D(3, {good, good}), std::invalid_argument);
  EXPECT_THROW(Lagrangian1D(3, {good}, Boundary::rigid, Boundary::rigid, {.courant = 1.5}), std::invalid_argument);
  Layer sick = good;
  sick.energy = std::numeric_limits<double>::quiet_NaN();
  Lagrangian1D s(3, {sick});
  EXPECT_THROW(s.advance(1.0), NumericalStop);
}

/// Merging cells behind a wave: what is conserved stays, and the wave that runs on is the same.
TEST(Lagrangian1DTest, CoarseningKeepsMassMomentumAndEnergy) {
  for (const int dimension : {1, 3}) {
    const Layer hot{.law = ideal(1.4), .inner = 0, .outer = 1, .cells = 200, .density = 1.0, .energy = 2.5e3};
    const Layer cold{.law = ideal(1.4), .inner = 1, .outer = 6, .cells = 1000, .density = 1.0, .energy = 2.5};
    Lagrangian1D fine(dimension, {hot, cold}, dimension == 1 ? Boundary::free : Boundary::rigid, Boundary::free),
        merged(dimension, {hot, cold}, dimension == 1 ? Boundary::free : Boundary::rigid, Boundary::free);
    for (auto* flow : {&fine, &merged}) flow->advance(0.05);
    const IntervalIntegral before = merged.integral(-10, 10);
    const double energy = merged.total_energy();
    const int cells = merged.cells();
    merged.coarsen(0.011);  // two cells of 0.005
    EXPECT_LT(merged.cells(), cells - 100);
    const IntervalIntegral after = merged.integral(-10, 10);
    EXPECT_NEAR(after.mass / before.mass, 1.0, 1e-13);
    EXPECT_NEAR(after.volume / before.volume, 1.0, 1e-13);
    if (dimension == 1) {
      EXPECT_NEAR(after.momentum, before.momentum, 1e-12 * std::sqrt(2 * before.kinetic_energy * before.mass));
    }
    EXPECT_NEAR(merged.total_energy() / energy, 1.0, 1e-13);
    EXPECT_NEAR(merged.interface_radius(0), fine.interface_radius(0), 0.0);
    for (auto* flow : {&fine, &merged}) flow->advance(0.08);
    EXPECT_NEAR((merged.total_energy() + merged.boundary_work()) / (fine.total_energy() + fine.boundary_work()), 1.0, 1e-10);
    EXPECT_NEAR(merged.shock_front(10.0), fine.shock_front(10.0), 0.005);
    EXPECT_NEAR(merged.at(1.2).pressure / fine.at(1.2).pressure, 1.0, 0.01);
    EXPECT_NEAR(merged.interface_radius(0), fine.interface_radius(0), 0.002);
  }
}

}  // namespace
}  // namespace undex::exact
