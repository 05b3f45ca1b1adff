// Bodies of revolution in their meridian: rings of quadrangles and thin-walled ones by themselves, and in motion, against exact
// values and the hexahedra of three dimensions.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <memory>
#include <numbers>
#include <tuple>

#include "bodies.hpp"
#include "matrices.hpp"
#include "core/gmsh_file.hpp"
#include "core/surface.hpp"
#include "fem_structure/shell_elements.hpp"

namespace undex::fem::testing {
namespace {

using Nodes = std::vector<Vec3>;
constexpr double pi = std::numbers::pi;

Settings tube(double inner, double outer, double low, double high, int through, int along, const materials::Solid& material) {
  Settings settings;
  settings.axisymmetric = true;
  settings.mesh = TubeMesh{.axis = 1,
                           .center = Vec3::Zero(),
                           .inner_radius = inner,
                           .outer_radius = outer,
                           .low = low,
                           .high = high,
                           .cells_through = through,
                           .cells_along = along};
  settings.material = material;
  return settings;
}

Settings rod(double radius, double low, double high, int radial, int along, const materials::Solid& material) {
  Settings settings;
  settings.axisymmetric = true;
  settings.mesh = RodMesh{.axis = 1,
                          .center = Vec3::Zero(),
                          .radius = radius,
                          .low = low,
                          .high = high,
                          .cells_radial = radial,
                          .cells_along = along};
  settings.material = material;
  return settings;
}

/// Takes the rings' volumes anew.
void take_ring_volumes(Grid& grid) {
  const ReferenceCell& reference = grid.reference;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    grid.nodal_volume[c].fill(0.0);
    for (int q = 0; q < 4; ++q) {
      Mat3 jacobian = Mat3::Zero();
      double r = 0.0;
      for (int i = 0; i < 4; ++i) {
        const Vec3& x = grid.nodes[grid.cells[c][i]];
        for (int d = 0; d < 2; ++d) jacobian.col(d) += x * reference.gradient[d][i][q];
        r += reference.value[i][q] * x[0];
      }
      const double section = jacobian(0, 0) * jacobian(1, 1) - jacobian(0, 1) * jacobian(1, 0);
      for (int i = 0; i < 4; ++i) grid.nodal_volume[c][i] += reference.value[i][q] * reference.weight[q] * section * 2.0 * pi * r;
    }
  }
}

/// Nodes off their places by up to `size` [m], those on the axis along it.
Grid distorted(const Settings& settings, double size) {
  Grid grid = Mesher(settings).grid();
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    for (int d = grid.nodes[i][0] == 0.0 ? 1 : 0; d < 2; ++d)
      grid.nodes[i][d] += size * std::sin(12.9 * (i + 1) + 78.2 * (d + 1));
  take_ring_volumes(grid);
  return grid;
}

const materials::Solid soft = elastic(1.0, 1.0, 0.3);

/// Takes the cells from x to map(reference) in one step.
template <class Map>
void move(ElementSet& elements, const Grid& grid, Nodes& x, Nodes& force, const Map& map) {
  Nodes u(grid.nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const Vec3 to = map(grid.nodes[i]);
    u[i] = to - x[i];
    x[i] = to;
  }
  ASSERT_EQ(elements.advance(x, u, 1.0, force), -1);
}

double largest(const Nodes& values) {
  double most = 0.0;
  for (const Vec3& v : values) most = std::max(most, v.norm());
  return most;
}

/// Either kind of ring; a shell's wall runs radially in a tube, along the axis in a rod.
std::unique_ptr<ElementSet> rings(ElementKind kind, const Settings& settings, const Grid& grid, double linear = 0.0,
                                  double quadratic = 0.0) {
  if (kind == ElementKind::hexahedron) return std::make_unique<RingElements>(grid, settings.material, linear, quadratic);
  return std::make_unique<RingShells>(grid, settings.material, linear, quadratic,
                                      thickness_direction(settings.mesh, true, "body"), 5);
}
constexpr ElementKind both[] = {ElementKind::hexahedron, ElementKind::shell};

/// Of the free components: radial and axial, but for the radial ones on the axis.
Matrices ring_matrices(const ElementSet& elements, const Grid& grid, const Matrices::Held& held = {}) {
  return Matrices(elements, grid, 2,
                  [&](const Vec3& node, int d) { return (d == 0 && node[0] == 0.0) || (held && held(node, d)); });
}

double ring_area(double inner, double outer) { return pi * (outer * outer - inner * inner); }

TEST(Rings, MassIsThatOfTheWholeBody) {
  const Structure pipe(tube(0.3, 0.5, -1.0, 2.0, 3, 7, soft));
  EXPECT_NEAR(pipe.ledger().mass, 3.0 * ring_area(0.3, 0.5), 1e-14);
  const Structure bar(rod(0.5, 0.0, 2.0, 4, 5, soft));
  EXPECT_NEAR(bar.ledger().mass, 2.0 * ring_area(0.0, 0.5), 1e-14);
  for (const double mass : bar.masses()) EXPECT_GT(mass, 0.0);
}

TEST(Rings, UniformStrainIsExactOnAnyMesh) {
  // u_r = a r, u_z = b z and shear along the axis, u_z = c: what a body of revolution can strain uniformly.
  for (const Settings& settings : {tube(2.0, 5.0, 0.0, 3.0, 3, 3, soft), rod(3.0, 0.0, 3.0, 3, 3, soft)}) {
    const Grid grid = distorted(settings, 0.15);
    for (const double size : {1e-7, 0.1}) {
      const double a = 0.4 * size, b = -0.7 * size;
      RingElements elements(grid, soft, 0.0, 0.0);
      Nodes x = grid.nodes, force(x.size());
      move(elements, grid, x, force, [&](const Vec3& r) { return Vec3((1 + a) * r[0], (1 + b) * r[1] + 0.3 * size, 0.0); });
      const Mat3 first = elements.stress(0, 0);
      for (std::size_t c = 0; c < grid.cells.size(); ++c)
        for (int q = 0; q < 4; ++q) EXPECT_LT((elements.stress(c, q) - first).norm(), 1e-8 * 1e-7 + 1e-13);
      if (size < 1e-3) {
        Mat3 strain = Mat3::Zero();
        strain.diagonal() << a, b, a;
        const Mat3 hooke = 2.0 * soft.shear_modulus * strain + 0.3 / (1.3 * 0.4) * strain.trace() * Mat3::Identity();
        EXPECT_LT((first - hooke).norm(), 1e-6 * hooke.norm());
      }
      // Inside nothing is left over: the forces of uniform stress close on every node, the axis included.
      Bounds box;
      for (const Vec3& r : grid.nodes) box.include(r);
      for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        const Vec3& r = grid.nodes[i];
        const bool inside =
            r[1] > 0.5 && r[1] < 2.5 && r[0] < box.high[0] - 0.5 && (box.low[0] == 0.0 || r[0] > box.low[0] + 0.5);
        if (inside) {
          EXPECT_LT(std::abs(force[i][1]), 2e-13);
          if (r[0] > 0.0) {
            EXPECT_LT(std::abs(force[i][0]), 2e-13);
          }
        }
      }
      EXPECT_GT(largest(force), 0.1 * size);
    }
  }
}

TEST(Rings, ThinWallsTakeUniformStrain) {
  for (const Settings& settings : {tube(2.0, 2.1, 0.0, 3.0, 1, 4, soft), rod(3.0, 0.0, 0.1, 4, 1, soft)})
    for (const int layers : {2, 3, 5, 8}) {
      const int through = thickness_direction(settings.mesh, true, "body"), along = 1 - through;
      Grid grid = Mesher(settings).grid();
      for (Vec3& x : grid.nodes) x[along] += 0.1 * std::sin(pi * x[along] / 3.0);  // alike at both faces
      take_ring_volumes(grid);
      RingShells elements(grid, soft, 0.0, 0.0, through, layers);
      const double a = 0.4e-7, b = -0.7e-7;
      Nodes x = grid.nodes, force(x.size());
      move(elements, grid, x, force, [&](const Vec3& r) { return Vec3((1 + a) * r[0], (1 + b) * r[1], 0.0); });
      Mat3 strain = Mat3::Zero();
      strain.diagonal() << a, b, a;
      const Mat3 hooke = 2.0 * soft.shear_modulus * strain + 0.3 / (1.3 * 0.4) * strain.trace() * Mat3::Identity();
      double whole = 0.0;
      for (int q = 0; q < elements.points_per_cell(); ++q) whole += elements.mean_share(q);
      EXPECT_NEAR(whole, 1.0, 1e-14);
      for (std::size_t c = 0; c < grid.cells.size(); ++c)
        for (int q = 0; q < elements.points_per_cell(); ++q)
          EXPECT_LT((elements.stress(c, q) - hooke).norm(), 1e-6 * hooke.norm()) << through << layers;
    }
}

TEST(Rings, RigidMotionAlongTheAxisMakesNoStress) {
  for (const ElementKind kind : both) {
    const Settings settings = rod(2.0, 0.0, 2.0, 2, 3, soft);
    const Grid grid = distorted(settings, 0.1);
    const auto elements = rings(kind, settings, grid, 0.06, 1.2);
    Nodes x = grid.nodes, force(x.size());
    for (int step = 1; step <= 400; ++step)
      move(*elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + Vec3(0, 0.25 * step, 0)); });
    for (std::size_t c = 0; c < grid.cells.size(); ++c)
      for (int q = 0; q < elements->points_per_cell(); ++q) EXPECT_LT(elements->stress(c, q).norm(), 1e-11);
    EXPECT_LT(largest(force), 1e-10);
  }
}

TEST(Rings, ForceIsTheDerivativeOfTheWork) {
  const auto shape = [](const Vec3& r) {
    return Vec3(r[0] * (0.3 + 0.2 * std::sin(r[1])), std::sin(r[0]) + 0.1 * r[1] * r[1], 0.0);
  };
  for (const ElementKind kind : both) {
    const Settings settings = rod(3.0, 0.0, 1.0, 3, 1, soft);  // an odd count: half of the last batch is idle
    const Grid grid = distorted(settings, 0.05);
    const auto elements = rings(kind, settings, grid);
    Nodes x = grid.nodes, force(x.size(), Vec3::Zero());
    double work = 0.0;
    const int steps = 200;
    for (int step = 1; step <= steps; ++step) {
      const Nodes old_force = force, old_x = x;
      move(*elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + 0.05 * step / steps * shape(r)); });
      for (std::size_t i = 0; i < x.size(); ++i) work += 0.5 * (old_force[i] + force[i]).dot(x[i] - old_x[i]);
    }
    RecordProperty("energy_over_work", std::to_string(1e6 * (elements->elastic_energy() / work - 1.0)) + "e-6");
    EXPECT_NEAR(elements->elastic_energy(), work, 1e-5 * work);
    for (int step = steps - 1; step >= 0; --step)
      move(*elements, grid, x, force, [&](const Vec3& r) { return Vec3(r + 0.05 * step / steps * shape(r)); });
    EXPECT_LT(std::abs(elements->elastic_energy()), 1e-5 * work);
  }
}

TEST(Rings, OneCellHasOneZeroMode) {
  for (const ElementKind kind : both) {
    const Settings settings = tube(1.0, 2.0, 0.0, 1.0, 1, 1, soft);
    const Grid grid = distorted(settings, 0.05);
    const Matrices m = ring_matrices(*rings(kind, settings, grid), grid);
    EXPECT_LT((m.stiffness - m.stiffness.transpose()).norm(), 1e-14 * m.stiffness.norm());
    const Eigen::VectorXd values = eigenvalues(m.stiffness);
    EXPECT_LT(std::abs(values[0]), 1e-13 * values[7]);
    EXPECT_GT(values[1], 1e-3 * values[7]) << "the section's turning strains the hoop alone";
    EXPECT_GT(values[2], 5e-3 * values[7]) << "an hourglass mode";
  }
}

TEST(Rings, NearlyIncompressibleCellHasOneStiffMode) {
  const Settings settings = tube(1.0, 2.0, 0.0, 1.0, 1, 1, elastic(1.0, 1.0, 0.49999));
  const Grid grid = distorted(settings, 0.05);
  const Matrices m = ring_matrices(*rings(ElementKind::hexahedron, settings, grid), grid);
  const Eigen::VectorXd values = eigenvalues(m.stiffness);
  EXPECT_LT(values[6], 40.0);  // of shear, times the ring of 2 pi 1.5 m
  EXPECT_GT(values[7], 1e4);
}

TEST(Rings, LinearForceIsTheTangent) {
  for (const ElementKind kind : both) {
    const Settings settings = rod(2.0, 0.0, 3.0, 2, 3, soft);
    const Grid grid = distorted(settings, 0.1);
    const auto elements = rings(kind, settings, grid);
    Nodes u(grid.nodes.size()), x = grid.nodes, force(u.size()), linear(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
      u[i] = 1e-7 * Vec3(grid.nodes[i][0] > 0.0 ? std::sin(i) : 0.0, std::cos(2.0 * i), 0.0);
      x[i] += u[i];
    }
    elements->linear_force(grid.nodes, u, linear);
    ASSERT_EQ(elements->advance(x, u, 1.0, force), -1);
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_LT((force[i] - linear[i]).norm(), 1e-5 * largest(linear));
  }
}

TEST(Rings, StableStepIsThatOfTheHighestFrequency) {
  for (const ElementKind kind : both)
    for (const double poisson : {0.0, 0.3, 0.45}) {
      const materials::Solid metal = elastic(1.0, 1.0, poisson);
      for (const Settings& settings : {rod(1.0, 0.0, 1.0, 1, 1, metal), tube(1.0, 2.0, 0.0, 1.0, 1, 1, metal)}) {
        const Grid one = distorted(settings, 0.1);
        const auto cell = rings(kind, settings, one);
        EXPECT_NEAR(cell->critical_step() * ring_matrices(*cell, one).highest_frequency(), 2.0, 2e-3);
      }
      const Settings settings = rod(4.0, 0.0, 4.0, 4, 4, metal);
      const Grid many = distorted(settings, 0.1);
      const auto assembly = rings(kind, settings, many);
      const double share = assembly->critical_step() * ring_matrices(*assembly, many).highest_frequency() / 2.0;
      RecordProperty("share_of_true_limit_" + std::to_string(poisson), std::to_string(share));
      EXPECT_LE(share, 1.0);
      EXPECT_GT(share, 0.6);
    }
}

/// Static displacements under a unit pressure on a face, small, by the linear stiffness.
Nodes pressed_still(ElementKind kind, const Settings& settings, const std::vector<std::string>& faces,
                    const std::function<bool(const Vec3&, int)>& held) {
  const Mesher mesher(settings);
  const Grid& grid = mesher.grid();
  const auto elements = rings(kind, settings, grid);
  const Matrices m = ring_matrices(*elements, grid, held);
  Nodes load(grid.nodes.size(), Vec3::Zero());
  for (const std::string& face : faces)
    for (const auto& segment : grid.faces.at(face)) {
      const Vec3 &a = grid.nodes[segment[0]], &b = grid.nodes[segment[1]];
      const Vec3 into(b[1] - a[1], a[0] - b[0], 0);
      load[segment[0]] += 2.0 * pi * (2.0 * a[0] + b[0]) / 6.0 * into;
      load[segment[1]] += 2.0 * pi * (a[0] + 2.0 * b[0]) / 6.0 * into;
    }
  Eigen::VectorXd right(m.of.size());
  for (std::size_t k = 0; k < m.of.size(); ++k) right[k] = load[m.of[k][0]][m.of[k][1]];
  const Eigen::VectorXd solution = m.solve(right);
  Nodes displacement(grid.nodes.size(), Vec3::Zero());
  for (std::size_t k = 0; k < m.of.size(); ++k) displacement[m.of[k][0]][m.of[k][1]] = solution[k];
  return displacement;
}

TEST(Rings, ThickTubeUnderPressureIsLames) {
  // Plane strain: u = p a^2 / (2 G (b^2 - a^2)) ((1 - 2 nu) r + b^2 / r), also where the material is nearly incompressible.
  const double a = 0.1, b = 0.3;
  for (const double poisson : {0.3, 0.499}) {
    const materials::Solid metal = elastic(1.0, 1.0, poisson);
    double error[3];
    for (int k = 0; k < 3; ++k) {
      const int through = 4 << k;
      const Settings settings = tube(a, b, 0.0, 0.2 / through, through, 1, metal);
      const Nodes u = pressed_still(ElementKind::hexahedron, settings, {"inner"}, [](const Vec3&, int d) { return d == 1; });
      const Grid grid = Mesher(settings).grid();
      error[k] = 0.0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        const double r = grid.nodes[i][0];
        const double exact = a * a / (2.0 * metal.shear_modulus * (b * b - a * a)) * ((1.0 - 2.0 * poisson) * r + b * b / r);
        error[k] = std::max(error[k], std::abs(u[i][0] / exact - 1.0));
      }
    }
    const double order = std::log2(error[1] / error[2]);
    std::printf("Lame, nu %.3f: errors %.5f %.5f %.5f, order %.2f\n", poisson, error[0], error[1], error[2], order);
    EXPECT_GT(order, 1.8);
    EXPECT_LT(error[2], 0.005);
  }
}

TEST(Rings, PinchedDiscWidensByPoissonsRatio) {
  // Pressed on both faces: uniform stress, exact on one layer of any cells; rings close to the axis are no exception.
  for (const ElementKind kind : both) {
    const Settings settings = rod(1.0, -0.05, 0.05, 6, 1, elastic(1.0, 1.0, 0.3));
    const Nodes u =
        pressed_still(kind, settings, {"low", "high"}, [](const Vec3& x, int d) { return d == 1 && x[0] == 0 && x[1] < 0; });
    const Grid grid = Mesher(settings).grid();
    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_NEAR(u[i][0], 0.3 * grid.nodes[i][0], 1e-11);
      EXPECT_NEAR(u[i][1], -(grid.nodes[i][1] + 0.05), 1e-11);
    }
  }
}

/// Deflection of a round plate's centre under a unit pressure over that of a plate which shears (Mindlin, Reissner):
/// clamped q R^4/(64 D) + q R^2/(4 k G t), k = 5/6; simply supported with (5 + nu)/(1 + nu) in the first term (Timoshenko,
/// Woinowsky-Krieger, Theory of Plates and Shells, 1959, sections 16 and 20).
double plate_error(ElementKind kind, double thickness, bool clamped, int radial, int through) {
  const double poisson = 0.3, t = thickness;
  const materials::Solid metal = elastic(1.0, 1.0, poisson);
  const Settings settings = rod(1.0, -0.5 * t, 0.5 * t, radial, through, metal);
  const Nodes u = pressed_still(kind, settings, {"low"}, [&](const Vec3& x, int d) {
    return x[0] == 1.0 && (clamped || (d == 1 && std::abs(x[1] + (through == 1 ? 0.5 * t : 0.0)) < 1e-12));
  });
  const Grid grid = Mesher(settings).grid();
  double center = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (grid.nodes[i][0] == 0.0) center += u[i][1] / (through + 1);
  const double rigidity = t * t * t / (12.0 * (1.0 - poisson * poisson));
  const double bent = 1.0 / (64.0 * rigidity) * (clamped ? 1.0 : (5.0 + poisson) / (1.0 + poisson));
  return center / (bent + 1.0 / (4.0 * 5.0 / 6.0 * metal.shear_modulus * t)) - 1.0;
}

TEST(Rings, RoundPlatesBend) {
  for (const bool clamped : {true, false}) {
    const char* name = clamped ? "clamped" : "simply supported";
    for (const double t : {0.1, 0.01, 0.001}) {
      double error[3];
      for (int k = 0; k < 3; ++k) error[k] = plate_error(ElementKind::shell, t, clamped, 4 << k, 1);
      const double order = std::log2(error[1] / error[2]);
      std::printf("%s plate, t/R %.3f, shells: %+.5f %+.5f %+.5f, order %.2f\n", name, t, error[0], error[1], error[2], order);
      EXPECT_NEAR(error[2], 0.0, t > 0.05 ? 0.01 : 0.002);  // a thick plate's theory has an error of its own
      if (t < 0.05) {
        EXPECT_NEAR(order, 2.0, 0.15);
      }
    }
    double error[3];
    for (int k = 0; k < 3; ++k) error[k] = plate_error(ElementKind::hexahedron, 0.1, clamped, 10 << k, 2 << k);
    const double order = std::log2((error[0] - error[1]) / (error[1] - error[2]));
    std::printf("%s plate, t/R 0.100, quadrangles: %+.5f %+.5f %+.5f, order %.2f\n", name, error[0], error[1], error[2], order);
    EXPECT_NEAR(error[2], 0.0, 0.02);
    EXPECT_GT(order, 1.5);
  }
}

TEST(Rings, ClampedEdgeOfAThinTubeBends) {
  // A long tube under pressure, held at one end: w = w0 (1 - e^-bx (cos bx + sin bx)), w0 = p R^2/(E t),
  // b^4 = 3 (1 - nu^2)/(R t)^2
  // (Timoshenko, Woinowsky-Krieger, section 115), with p at the bore.
  const double radius = 1.0, t = 0.001, poisson = 0.3, length = 0.25;
  const double b = std::pow(3.0 * (1.0 - poisson * poisson), 0.25) / std::sqrt(radius * t);
  const double far = (radius - 0.5 * t) * radius / t;
  double error[3];
  for (int k = 0; k < 3; ++k) {
    const Settings settings = tube(radius - 0.5 * t, radius + 0.5 * t, 0.0, length, 1, 40 << k, elastic(1.0, 1.0, poisson));
    const Nodes u = pressed_still(ElementKind::shell, settings, {"inner"}, [](const Vec3& x, int) { return x[1] == 0.0; });
    const Grid grid = Mesher(settings).grid();
    error[k] = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double x = grid.nodes[i][1], exact = far * (1.0 - std::exp(-b * x) * (std::cos(b * x) + std::sin(b * x)));
      error[k] = std::max(error[k], std::abs(u[i][0] - exact) / far);
    }
  }
  std::printf("edge of a tube, shells: %.5f %.5f %.5f\n", error[0], error[1], error[2]);
  EXPECT_LT(error[2], 0.003);
  EXPECT_GT(std::log2(error[0] / error[1]), 1.5);
}

TEST(Rings, BarOscillatesAsPochhammersWaves) {
  // A round bar between smooth walls: standing waves of the wave number pi/L, exactly those of an infinite bar. The frequency
  // solves Pochhammer's equation (Achenbach, Wave Propagation in Elastic Solids, 1973, eq 6.156), the longitudinal root.
  const double radius = 0.2, length = 1.0, poisson = 0.33, k = pi / length;
  const materials::Solid metal = elastic(1.0, 1.0, poisson);
  const double shear = metal.shear_modulus, dilatational = materials::wave_speed(metal), transverse = std::sqrt(shear);
  const auto pochhammer = [&](double frequency) {
    const double gamma = std::sqrt(k * k - std::pow(frequency / dilatational, 2));
    const double beta = std::sqrt(std::pow(frequency / transverse, 2) - k * k);
    const double i0 = std::cyl_bessel_i(0, gamma * radius), i1 = std::cyl_bessel_i(1, gamma * radius);
    const double j0 = std::cyl_bessel_j(0, beta * radius), j1 = std::cyl_bessel_j(1, beta * radius);
    return 2.0 * gamma / radius * (beta * beta + k * k) * i1 * j1 + std::pow(beta * beta - k * k, 2) * i0 * j1 -
           4.0 * k * k * gamma * beta * i1 * j0;
  };
  double low = 0.95 * k, high = k;  // below the slender bar's, sqrt(E/rho) k
  ASSERT_LT(pochhammer(low) * pochhammer(high), 0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (pochhammer(low) * pochhammer(middle) <= 0.0 ? high : low) = middle;
  }
  EXPECT_NEAR(low / k, 1.0 - 0.25 * std::pow(poisson * k * radius, 2), 0.003) << "Rayleigh's correction";
  double error[3];
  for (int mesh = 0; mesh < 3; ++mesh) {
    const int radial = 2 << mesh;
    const Grid grid = Mesher(rod(radius, 0.0, length, radial, 5 * radial, metal)).grid();
    const RingElements elements(grid, metal, 0.0, 0.0);
    const Matrices m =
        ring_matrices(elements, grid, [&](const Vec3& x, int d) { return d == 1 && (x[1] == 0.0 || x[1] == length); });
    const Eigen::VectorXd squares = m.squares();
    double nearest = 1e300;
    for (Eigen::Index i = 0; i < squares.size(); ++i) {
      const double here = std::sqrt(std::max(0.0, squares[i])) / low - 1.0;
      if (std::abs(here) < std::abs(nearest)) nearest = here;
    }
    error[mesh] = nearest;
  }
  const double order = std::log2(error[1] / error[2]);
  std::printf("Pochhammer's bar: errors %+.5f %+.5f %+.5f, order %.2f\n", error[0], error[1], error[2], order);
  EXPECT_NEAR(order, 2.0, 0.2);
  EXPECT_NEAR(error[2], 0.0, 0.002);
}

/// A free piece of a soft plastic tube or rod that is hit so hard that it yields.
Settings free_body(bool solid, ElementKind kind = ElementKind::hexahedron) {
  const materials::Solid metal = hardening(2700, 71e9, 0.33, 50e6, 1e9);
  const bool shell = kind == ElementKind::shell;
  Settings settings = solid ? rod(0.03, 0.01, shell ? 0.013 : 0.04, 5, shell ? 1 : 4, metal)
                            : tube(shell ? 0.047 : 0.02, 0.05, 0.01, 0.04, shell ? 1 : 4, 3, metal);
  settings.element = kind;
  settings.wet_faces = {solid ? "side" : "inner", "low"};
  settings.initial_velocity = Vec3(0, 20, 0);
  return settings;
}

Nodes kicks(const Structure& body, double size) {
  const WetSurface& surface = body.wet_surface();
  Nodes impulse(surface.nodes.size());
  const std::vector<double> area = nodal_areas(surface.faces, surface.nodes);
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    const double r = surface.nodes[i][0];
    impulse[i] = size * area[i] * Vec3(r > 0.0 ? std::sin(1.0 + 3.0 * i) : 0.0, std::cos(2.0 * i) + 0.3, 0.0);
  }
  return impulse;
}

TEST(Rings, FreeBodyKeepsItsMomentumAlongTheAxisAndItsEnergy) {
  for (const auto& [solid, viscous, kind] : {std::tuple(false, false, both[0]),
                                             {false, true, both[0]},
                                             {true, true, both[0]},
                                             {false, true, both[1]},
                                             {true, false, both[1]}}) {
    const bool shell = kind == ElementKind::shell;
    Settings settings = free_body(solid, kind);
    if (!viscous) settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
    Structure body(settings);
    const double start = body.ledger().balance();
    double expected = body.ledger().momentum[1], time = 0.0;
    for (int window = 1; window <= 30; ++window) {
      const Nodes impulse = kicks(body, shell ? 4.0 : 40.0);
      body.advance(time += 0.3e-6, impulse);
      for (const Vec3& part : impulse) expected += part[1];
    }
    EXPECT_NEAR(body.ledger().momentum[1], expected, 1e-13 * std::abs(expected));
    const double momentum = body.ledger().momentum[1];
    while (body.steps() < 600) body.advance(body.time() + body.stable_step(), {});
    const BodyLedger energies = body.ledger();
    const double drift = energies.momentum[1] / momentum - 1.0, left = (energies.balance() - start) / energies.received;
    std::printf("free %s%s%s: momentum %.1e, energy %.1e, plastic %.2f of the work\n", solid ? "rod" : "ring",
                shell ? ", shells" : "", viscous ? ", viscous" : "", drift, left, energies.plastic / energies.received);
    EXPECT_LT(std::abs(drift), 2e-14);
    EXPECT_LT(std::abs(left), shell ? 2e-4 : 1e-4);
    EXPECT_GT(energies.plastic, 0.05 * energies.received);
    EXPECT_EQ(energies.viscous > 0.0, viscous);
    for (std::size_t i = 0; i < body.positions().size(); ++i) {
      EXPECT_EQ(body.positions()[i][2], 0.0);
      EXPECT_GE(body.positions()[i][0], 0.0);
    }
  }
}

TEST(Rings, EnergyClosesToRoundOffInSmallStrain) {
  // What finite strain within a step leaves of the balance vanishes with the strain; nothing else is left.
  for (const bool solid : {false, true}) {
    Settings settings = free_body(solid);
    settings.initial_velocity.setZero();
    Structure body(settings);
    for (int window = 1; window <= 30; ++window) body.advance(0.3e-6 * window, kicks(body, window < 15 ? 4e-4 : 0.0));
    const BodyLedger energies = body.ledger();
    std::printf("free %s, strain of 1e-8: energy %.1e\n", solid ? "rod" : "ring", energies.balance() / energies.received);
    EXPECT_NEAR(energies.balance(), 0.0, 1e-7 * energies.received);
  }
}

TEST(Rings, PressureAllRoundBalances) {
  // Follower loads of whole rings: uniform pressure has no resultant along the axis, whatever the shape has become.
  for (const bool solid : {false, true}) {
    const materials::Solid metal = elastic(2700, 71e9, 0.33);
    Settings settings = solid ? rod(0.03, 0.0, 0.04, 3, 4, metal) : tube(0.02, 0.05, 0.0, 0.04, 3, 4, metal);
    for (const char* face : {"side", "inner", "outer", "low", "high"})
      if (Mesher(settings).grid().faces.count(face)) settings.loads.push_back({face, {0.0, 2e-5}, {0.0, 1e8}});
    settings.wet_faces = {"low"};
    settings.linear_viscosity = settings.quadratic_viscosity = 0.0;
    Structure body(settings);
    for (int window = 1; window <= 20; ++window) {
      const double rise = std::sin(pi * window / 20);
      Nodes push = kicks(body, 30.0 * rise * rise);
      body.advance(window * 1e-6, push);
    }
    const double momentum = body.ledger().momentum[1];
    body.advance(2e-4, {});
    EXPECT_NEAR(body.ledger().momentum[1], momentum, 1e-12 * std::abs(momentum));
    const BodyLedger energies = body.ledger();
    EXPECT_NEAR(energies.balance(), 0.0, 2e-4 * energies.kinetic);
  }
  // The force of a pressure on one end, and on a bore.
  Settings pushed = rod(0.03, 0.0, 0.04, 3, 4, soft);
  pushed.material = elastic(2700, 71e9, 0.33);
  pushed.loads = {{"low", {0.0, 1e-5}, {1e7, 0.0}}};
  Structure block(pushed);
  block.advance(1e-4, {});
  EXPECT_NEAR(block.ledger().momentum[1], 0.5 * 1e7 * 1e-5 * ring_area(0.0, 0.03), 0.01 * 0.5 * 100 * ring_area(0.0, 0.03));
}

TEST(Rings, WallsAndSupportsHold) {
  Settings settings = rod(0.01, 0.0, 0.1, 4, 40, elastic(2700, 71e9, 0.33));
  settings.planes = {{.axis = 1, .position = 0.0, .body_above = true}};
  settings.initial_velocity = Vec3(0, -10, 0);
  Structure bar(settings);
  // It bounces: the wave has come back after 2 L / c, and the bar leaves with almost its speed.
  const double start = bar.ledger().kinetic, speed = std::sqrt(71e9 / 2700);
  bar.advance(4.0 * 0.1 / speed, {});
  const double mass = bar.ledger().mass;
  EXPECT_GT(bar.ledger().momentum[1], 0.9 * mass * 10.0);
  EXPECT_NEAR(bar.plane_impulse()[1], bar.ledger().momentum[1] + mass * 10.0, 1e-12 * mass * 10);
  EXPECT_NEAR(bar.ledger().balance(), start, 1e-3 * start);
  Settings held = tube(0.02, 0.03, -0.05, 0.05, 2, 10, elastic(2700, 71e9, 0.33));
  held.symmetry_axes = {1};
  held.loads = {{"inner", {0.0}, {1e6}}};
  held.supports = {{"high", {true, true, false}}};
  Structure half(held);
  EXPECT_NEAR(half.ledger().mass, 2700 * 0.05 * ring_area(0.02, 0.03), 1e-10);
  half.advance(1e-4, {});
  for (std::size_t i = 0; i < half.positions().size(); ++i) {
    if (half.locate(Vec3(0.025, 0, 0)).distance > 0.0) ADD_FAILURE();
  }
  const MaterialPoint middle = half.read(half.locate(Vec3(0.03, 0, 0))), end = half.read(half.locate(Vec3(0.03, 0.05, 0)));
  EXPECT_GT(middle.displacement[0], 0.0);
  EXPECT_EQ(middle.displacement[1], 0.0);
  EXPECT_EQ(end.displacement, Vec3(Vec3::Zero()));
}

TEST(Rings, ProbesReadLinearFields) {
  Structure body(rod(0.5, 0.0, 1.0, 3, 5, soft));
  for (const Vec3& x : {Vec3(0, 0, 0), Vec3(0.21, 0.33, 0), Vec3(0.5, 1.0, 0)}) {
    const BodyPoint point = body.locate(x);
    EXPECT_NEAR(point.distance, 0.0, 1e-12);
    EXPECT_LT((body.read(point).position - x).norm(), 1e-12);
    double shares = 0.0;
    for (const auto& share : point.state) shares += share.weight;
    EXPECT_NEAR(shares, 1.0, 1e-14);
  }
  EXPECT_NEAR(body.locate(Vec3(0.7, 0.5, 0)).distance, 0.2, 1e-9);
  for (const auto& cell : body.snapshot().cells)
    for (int i = 0; i < 4; ++i) EXPECT_EQ(cell[i], cell[i + 4]);
}

TEST(Rings, MeridiansOfGmshAreBuilt) {
  // A cone's frustum on the axis, radius 2 below and 1 above, of two quadrangles, one of them mirrored.
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 3 0\n5 0.5 3 0\n"
      "6 1 3 0\n$EndNodes\n$Elements\n4\n1 1 2 5 5 3 6\n2 1 2 6 6 1 4\n3 3 2 1 1 1 2 5 4\n"
      "4 3 2 1 1 2 5 6 3\n$EndElements\n";
  Settings settings;
  settings.axisymmetric = true;
  settings.mesh = GmshMesh{"m.msh", std::make_shared<const HexahedralMesh>(parse_gmsh(text, "m.msh", GmshCells::quadrangles))};
  settings.material = soft;
  settings.wet_faces = {"5"};
  const Structure cone(settings);
  EXPECT_NEAR(cone.ledger().mass, pi * 3.0 / 3.0 * (4.0 + 2.0 + 1.0), 1e-12);
  ASSERT_EQ(cone.wet_surface().faces.size(), 1u);
  const auto x = corners_of(cone.wet_surface().faces[0], cone.wet_positions());
  EXPECT_LT((x[1] - x[0]).cross(x[3] - x[0])[0], 0.0) << "into the cone";
  settings.wet_faces = {"6"};
  EXPECT_THROW(Structure{settings}, std::invalid_argument) << "the axis is no face";
}

TEST(Rings, WetMassesAreAllOfTheMass) {
  Settings settings = tube(0.3, 0.5, 0.0, 1.0, 3, 4, soft);
  settings.wet_faces = {"outer"};
  const Structure body(settings);
  double sum = 0.0;
  for (const double mass : body.wet_masses()) sum += mass;
  EXPECT_NEAR(sum, body.ledger().mass, 1e-14);
  for (const auto& face : body.wet_surface().faces) {
    ASSERT_TRUE(is_segment(face));
    const auto x = corners_of(face, body.wet_positions());
    EXPECT_LT((x[1] - x[0]).cross(x[3] - x[0])[0], 0.0) << "into the wall";
  }
}

materials::Solid bar_metal() {
  materials::Solid iron = elastic(7890, 1, 0.3);
  iron.shear_modulus = 80e9;
  iron.pressure = materials::LinearPressure{164e9};
  iron.flow = materials::JohnsonCook{.A = 175e6, .B = 380e6, .n = 0.32, .C = 0.06, .m = 0.55, .T_melt = 1811.0};
  iron.heat_capacity = 452.0;
  return iron;
}

TEST(Rings, TaylorBarIsThatOfHexahedra) {
  const double length = 25.4e-3, radius = 3.8e-3;
  Settings flat = rod(radius, 0.0, length, 4, 32, bar_metal());
  flat.supports = {{"low", {false, true, false}}};
  flat.initial_velocity = Vec3(0, -221, 0);
  Settings full = flat;
  full.axisymmetric = false;
  full.mesh = RodMesh{
      .axis = 2, .center = Vec3::Zero(), .radius = radius, .low = 0.0, .high = length, .cells_radial = 4, .cells_along = 32};
  full.symmetry_axes = {0, 1};
  full.supports = {{"low", {false, false, true}}};
  full.initial_velocity = Vec3(0, 0, -221);
  Structure ring(flat), bar(full);
  const double start = ring.ledger().balance();
  const double polygon = std::sin(pi / 8) / (pi / 8);  // of the hexahedra's rim
  EXPECT_NEAR(polygon * start, 4.0 * bar.ledger().balance(), 1e-10 * start) << "whole rings";
  const auto end = ring.locate(Vec3(0, length, 0)), foot = ring.locate(Vec3(radius, 0, 0));
  const auto end_3d = bar.locate(Vec3(0, 0, length)), foot_3d = bar.locate(Vec3(radius, 0, 0));
  ring.advance(60e-6, {});
  bar.advance(60e-6, {});
  const double l = ring.read(end).position[1] / bar.read(end_3d).position[2] - 1.0;
  const double r = ring.read(foot).position[0] / bar.read(foot_3d).position[0] - 1.0;
  std::printf("Taylor bar, rings less hexahedra: length %+.5f, foot %+.5f, energy balance %.1e\n", l, r,
              ring.ledger().balance() / start - 1.0);
  EXPECT_NEAR(l, 0.0, 0.005);
  EXPECT_NEAR(r, 0.0, 0.005);
  EXPECT_NEAR(ring.ledger().balance(), start, 1e-3 * start);
}

TEST(Rings, WhatIsNotOfRevolutionIsRefused) {
  const auto message = [](Settings settings) {
    try {
      const Structure body(settings);
    } catch (const std::invalid_argument& mistake) {
      return std::string(mistake.what());
    }
    return std::string("accepted");
  };
  const auto expect = [&](const Settings& settings, const char* part) {
    EXPECT_NE(message(settings).find(part), std::string::npos) << message(settings);
  };
  const Settings good = rod(0.5, 0.0, 1.0, 3, 5, soft);
  EXPECT_EQ(message(good), "accepted");
  Settings bad = good;
  bad.mesh = PlateMesh{Vec3::Zero(), Vec3::Ones(), {1, 1, 1}};
  expect(bad, "not of revolution");
  bad = good;
  std::get<RodMesh>(bad.mesh).axis = 2;
  expect(bad, "axis of revolution");
  bad = good;
  bad.symmetry_axes = {0};
  expect(bad, "symmetry axis 0");
  bad = good;
  bad.initial_velocity = Vec3(1, 0, 0);
  expect(bad, "initial velocity");
  bad = good;
  bad.gravity = Vec3(0, 0, 1);
  expect(bad, "gravity");
  bad = good;
  bad.planes = {{.axis = 0, .position = 0.0, .body_above = true}};
  expect(bad, "rigid plane");
}

}  // namespace
}  // namespace undex::fem::testing
