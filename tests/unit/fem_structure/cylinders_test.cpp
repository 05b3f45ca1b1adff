// Plastic cylinders against exact and converged solutions: a thick wall of hexahedra under slow pressure, thin rings of
// either element under a pulse.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <tuple>

#include "bodies.hpp"
#include "materials/stress_update.hpp"

namespace undex::fem::testing {
namespace {

/// Thick cylinder, perfectly plastic and nearly incompressible, in plane strain. Pressure of an elastic-plastic radius c
/// (Hill, The Mathematical Theory of Plasticity, 1950; for incompressible material):
/// p = 2Y/sqrt3 (ln(c/a) + (1 - c^2/b^2)/2); outside c Lame's solution, u(b) = (1 - nu) c^2 Y/(sqrt3 G b).
struct ThickWall {
  double a = 0.1, b = 0.2, young = 200e9, yield = 200e6, poisson = 0.49;
  double unit() const { return 2.0 * yield / std::sqrt(3.0); }
  double pressure(double c) const { return unit() * (std::log(c / a) + 0.5 * (1.0 - c * c / (b * b))); }
  double radial(double r, double c) const {
    if (r <= c) return -unit() * (0.5 * (1.0 - c * c / (b * b)) + std::log(c / r));
    return -0.5 * unit() * c * c * (1.0 / (r * r) - 1.0 / (b * b));
  }
  double hoop(double r, double c) const {
    if (r <= c) return radial(r, c) + unit();
    return 0.5 * unit() * c * c * (1.0 / (r * r) + 1.0 / (b * b));
  }
};

struct WallErrors {
  double radius, radial, hoop;  ///< of the plastic radius, relative; of stresses, largest, over 2Y/sqrt3
};

/// A body about z, held along it, in its meridian: the same numbers about y.
Settings in_meridian(Settings settings) {
  settings.axisymmetric = true;
  std::get<TubeMesh>(settings.mesh).axis = 1;
  settings.symmetry_axes.clear();
  for (Support& support : settings.supports) support.fixed = {false, true, false};
  return settings;
}

WallErrors thick_wall(int through, double c, bool meridian) {
  const ThickWall exact;
  Settings settings;
  settings.mesh = TubeMesh{.axis = 2,
                           .center = Vec3::Zero(),
                           .inner_radius = exact.a,
                           .outer_radius = exact.b,
                           .low = 0.0,
                           .high = 0.1 / through,
                           .cells_through = through,
                           .cells_around = 8 * through,
                           .cells_along = 1};
  settings.material = hardening(7800, exact.young, exact.poisson, exact.yield, 0.0);
  settings.symmetry_axes = {0, 1};
  settings.supports = {{"low", {false, false, true}}, {"high", {false, false, true}}};
  const double period = 2.0 * std::numbers::pi * exact.b / std::sqrt(exact.young / 7800), rise = 20.0 * period;
  PressureLoad load{"inner", {}, {}};
  for (int i = 0; i <= 40; ++i) {  // without a jump of rate, so that nothing rings
    const double t = i / 40.0;
    load.time.push_back(t * rise);
    load.pressure.push_back(t * t * (3.0 - 2.0 * t) * exact.pressure(c));
  }
  settings.loads = {load};
  Structure tube(meridian ? in_meridian(settings) : settings);
  tube.advance(rise + period, {});
  const double z = 0.05 / through;
  const double u_b = tube.read(tube.locate(meridian ? Vec3(exact.b, z, 0) : Vec3(exact.b, 0, z))).displacement[0];
  const double shear = settings.material.shear_modulus;
  WallErrors errors{std::sqrt(u_b * exact.b * std::sqrt(3.0) * shear / ((1.0 - exact.poisson) * exact.yield)) / c - 1.0, 0.0,
                    0.0};
  for (int i = 0; i < through; ++i) {  // at the cells' centres
    const double r = exact.a + (exact.b - exact.a) * (i + 0.5) / through;
    const double angle = meridian ? 0.0 : std::numbers::pi / (8.0 * through);  // half a cell's
    const double chord = r * std::cos(angle);                                  // a straight-edged cell's centre
    const Vec3 n(std::cos(angle), std::sin(angle), 0), up = meridian ? Vec3::UnitY() : Vec3::UnitZ(), t = up.cross(n);
    const Mat3 stress = tube.read(tube.locate(chord * n + z * up)).stress;
    errors.radial = std::max(errors.radial, std::abs(n.dot(stress * n) - exact.radial(r, c)) / exact.unit());
    errors.hoop = std::max(errors.hoop, std::abs(t.dot(stress * t) - exact.hoop(r, c)) / exact.unit());
  }
  return errors;
}

TEST(Cylinders, ThickWallFollowsThePlasticFront) {
  for (const auto& [c, through, meridian] : {std::tuple(0.13, 5, false),
                                             {0.13, 10, false},
                                             {0.16, 5, false},
                                             {0.16, 10, false},
                                             {0.13, 10, true},
                                             {0.16, 5, true},
                                             {0.16, 10, true}}) {
    const WallErrors e = thick_wall(through, c, meridian);
    std::printf("thick wall, %s, c %.2f, %2d cells: plastic radius %+.4f, radial stress %.4f, hoop stress %.4f\n",
                meridian ? "rings" : "hexahedra", c, through, e.radius, e.radial, e.hoop);
    const std::string name =
        "c_" + std::to_string(c).substr(0, 4) + "_cells_" + std::to_string(through) + (meridian ? "_rings" : "");
    RecordProperty(name + "_radius", std::to_string(e.radius));
    RecordProperty(name + "_radial", std::to_string(e.radial));
    RecordProperty(name + "_hoop", std::to_string(e.hoop));
    if (through >= 10) {
      EXPECT_NEAR(e.radius, 0.0, 0.01);
      EXPECT_LT(e.radial, 0.01);
    }
  }
}

/// A thin ring in plane strain as one material point: hoop strain from the radius, radial stress the mean of pressure and
/// nothing, the same law. Second order in thickness over radius.
class RingModel {
 public:
  RingModel(const materials::Solid& solid, double inner, double outer)
      : solid_(solid), inner_(inner), outer_(outer), area_(0.5 * (outer * outer - inner * inner)) {
    for (auto& component : points_.deviator)
      for (double& s : component) s = 0.0;
    for (int q = 0; q < 8; ++q) {
      points_.plastic_strain[q] = 0.0;
      points_.temperature[q] = solid.T_room;
    }
  }
  /// One step [s] under the pressure [Pa] on the bore.
  void step(double dt, double pressure) {
    // Mass per radian and length rho0 A moves with the middle: rho0 A a = p r_inner - (hoop stress) thickness.
    const double thickness = outer_ - inner_;
    const double acceleration = (pressure * inner_ - hoop_ * thickness) / (solid_.rho0 * area_);
    velocity_ += dt * acceleration;
    const double middle = 0.5 * (inner_ + outer_), next = middle + dt * velocity_;
    const double hoop_strain = (next - middle) / (0.5 * (next + middle));
    // Radial strain such that the radial stress is minus half the pressure: secant steps.
    double strain[2] = {-0.4 * hoop_strain, -0.6 * hoop_strain}, excess[2];
    materials::SolidPoints trial;
    double trial_hoop = 0.0, trial_dilatation = 1.0;
    const auto respond = [&](double radial_strain) {
      trial = points_;
      materials::EightPoints gradient[3][3] = {}, volume;
      for (int q = 0; q < 8; ++q) {
        gradient[0][0][q] = radial_strain;
        gradient[1][1][q] = hoop_strain;
        volume[q] = dilatation_ / solid_.rho0;
      }
      materials::SolidStep done;
      materials::advance_deviator(solid_, gradient, volume, {}, dt, trial, done);
      const double opened = radial_strain + hoop_strain;
      trial_dilatation = dilatation_ * (1.0 + 0.5 * opened) / (1.0 - 0.5 * opened);
      const double p = materials::evaluate(solid_.pressure, solid_.rho0, solid_.rho0 / trial_dilatation, 0.0).pressure;
      trial_hoop = trial.deviator[1][0] - p;
      return trial.deviator[0][0] - p + 0.5 * pressure;
    };
    excess[0] = respond(strain[0]);
    for (int iteration = 0; iteration < 50; ++iteration) {
      excess[1] = respond(strain[1]);
      if (std::abs(excess[1]) < 10.0 || excess[1] == excess[0]) break;
      const double better = strain[1] - excess[1] * (strain[1] - strain[0]) / (excess[1] - excess[0]);
      strain[0] = strain[1];
      excess[0] = excess[1];
      strain[1] = better;
    }
    points_ = trial;
    hoop_ = trial_hoop;
    dilatation_ = trial_dilatation;
    const double half = 0.5 * thickness * (1.0 + 0.5 * strain[1]) / (1.0 - 0.5 * strain[1]);
    inner_ = next - half;
    outer_ = next + half;
  }
  double outer() const { return outer_; }
  double plastic_strain() const { return points_.plastic_strain[0]; }

 private:
  materials::Solid solid_;
  double inner_, outer_, area_;
  double velocity_ = 0.0, hoop_ = 0.0, dilatation_ = 1.0;
  materials::SolidPoints points_;
};

struct RingResult {
  double displacement, plastic_strain;  ///< of the outer wall, largest [m]; at mid-wall at the end
};

constexpr double mean_radius = 0.05, wall = 0.001, ring_end = 150e-6, peak = 60e6, decay = 15e-6;

materials::Solid ring_metal() {
  materials::Solid metal = elastic(2700, 71e9, 0.33);
  metal.flow = materials::JohnsonCook{.A = 167e6, .B = 596e6, .n = 0.551, .C = 0.001, .m = 1.0, .T_melt = 893.0};
  return metal;
}

/// With no cells around: in the meridian.
RingResult ring_of_elements(ElementKind kind, int around) {
  Settings settings;
  settings.mesh = TubeMesh{.axis = 2,
                           .center = Vec3::Zero(),
                           .inner_radius = mean_radius - 0.5 * wall,
                           .outer_radius = mean_radius + 0.5 * wall,
                           .low = 0.0,
                           .high = wall,
                           .cells_through = kind == ElementKind::shell ? 1 : 2,
                           .cells_around = around,
                           .cells_along = 1};
  settings.element = kind;
  settings.material = ring_metal();
  settings.symmetry_axes = {0, 1};
  settings.supports = {{"low", {false, false, true}}, {"high", {false, false, true}}};
  PressureLoad pulse{"inner", {}, {}};
  for (int i = 0; i <= 400; ++i) {
    pulse.time.push_back(i * 0.025 * decay);
    pulse.pressure.push_back(peak * std::exp(-i * 0.025));
  }
  settings.loads = {pulse};
  Structure ring(around == 0 ? in_meridian(settings) : settings);
  const Vec3 height = 0.5 * wall * (around == 0 ? Vec3::UnitY() : Vec3::UnitZ());
  const auto outer = ring.locate(Vec3(mean_radius + 0.5 * wall, 0, 0) + height),
             middle = ring.locate(Vec3(mean_radius, 0, 0) + height);
  RingResult result{0.0, 0.0};
  for (int sample = 1; sample <= 300; ++sample) {
    ring.advance(sample * ring_end / 300, {});
    result.displacement = std::max(result.displacement, ring.read(outer).displacement[0]);
  }
  result.plastic_strain = ring.read(middle).plastic_strain;
  EXPECT_NEAR(ring.ledger().balance(), 0.0, 1e-4 * ring.ledger().external);
  return result;
}

TEST(Cylinders, ThinRingUnderAPulse) {
  RingModel model(ring_metal(), mean_radius - 0.5 * wall, mean_radius + 0.5 * wall);
  RingResult exact{0.0, 0.0};
  const double dt = 5e-9;
  for (long step = 0; step < std::lround(ring_end / dt); ++step) {
    model.step(dt, peak * std::exp(-std::min(dt * step / decay, 10.0)));
    exact.displacement = std::max(exact.displacement, model.outer() - (mean_radius + 0.5 * wall));
  }
  exact.plastic_strain = model.plastic_strain();
  std::printf("ring model: largest displacement %.5f mm, plastic strain %.5f\n", 1e3 * exact.displacement, exact.plastic_strain);
  for (ElementKind kind : {ElementKind::hexahedron, ElementKind::shell}) {
    const char* name = kind == ElementKind::shell ? "shell" : "hexahedron";
    double error[3];
    for (int k = 0; k < 3; ++k) {
      const int around = 32 << k;
      const RingResult r = ring_of_elements(kind, around);
      error[k] = r.displacement / exact.displacement - 1.0;
      std::printf("%-10s %3d cells around: displacement %+.5f, plastic strain %+.5f\n", name, around, error[k],
                  r.plastic_strain / exact.plastic_strain - 1.0);
      RecordProperty(std::string(name) + "_" + std::to_string(around), std::to_string(error[k]));
      if (k == 2) {
        EXPECT_NEAR(error[k], 0.0, 0.005) << name;
        EXPECT_NEAR(r.plastic_strain / exact.plastic_strain, 1.0, 0.01) << name;
      }
    }
    const double order = std::log2((error[1] - error[0]) / (error[2] - error[1]));
    std::printf("%-10s observed order of the displacement %.2f\n", name, order);
    EXPECT_GT(order, 1.7) << name;
    // In the meridian there is no polygon: the model's own error, of second order in thickness over radius, is left.
    const RingResult r = ring_of_elements(kind, 0);
    std::printf("%-10s in the meridian: displacement %+.5f, plastic strain %+.5f\n", name,
                r.displacement / exact.displacement - 1.0, r.plastic_strain / exact.plastic_strain - 1.0);
    EXPECT_NEAR(r.displacement / exact.displacement, 1.0, 0.0005) << name;
    EXPECT_NEAR(r.plastic_strain / exact.plastic_strain, 1.0, 0.01) << name;
  }
}

}  // namespace
}  // namespace undex::fem::testing
