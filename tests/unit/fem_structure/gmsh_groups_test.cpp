// Structures on meshes of gmsh with named groups: materials of parts, shells of quadrangles, plates that stand on plates.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>

#include "bodies.hpp"
#include "core/gmsh_file.hpp"

namespace undex::fem::testing {
namespace {

/// The text of a .msh file of version 2.2, put together from patches; nodes at one place are one.
class MeshText {
 public:
  int node(const Vec3& x) {
    const auto key = std::array<long, 3>{std::lround(1e9 * x[0]), std::lround(1e9 * x[1]), std::lround(1e9 * x[2])};
    const auto [found, fresh] = number_.emplace(key, int(nodes_.size()) + 1);
    if (fresh) nodes_.push_back(x);
    return found->second;
  }
  void name(int dimension, int id, const std::string& name) {
    names_.push_back(std::to_string(dimension) + " " + std::to_string(id) + " \"" + name + "\"");
  }
  /// Quadrangles; `at` takes the unit square into space.
  void sheet(int group, int m, int n, const auto& at) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < m; ++i) {
        const auto x = [&](int a, int b) { return node(at(double(i + a) / m, double(j + b) / n)); };
        add(3, group, {x(0, 0), x(1, 0), x(1, 1), x(0, 1)});
      }
  }
  /// Hexahedra of a box.
  void block(int group, const Vec3& low, const Vec3& high, std::array<int, 3> n) {
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) {
          const auto x = [&](int a, int b, int c) {
            const Vec3 unit(double(i + a) / n[0], double(j + b) / n[1], double(k + c) / n[2]);
            return node(low + unit.cwiseProduct(high - low));
          };
          add(5, group, {x(0, 0, 0), x(1, 0, 0), x(1, 1, 0), x(0, 1, 0), x(0, 0, 1), x(1, 0, 1), x(1, 1, 1), x(0, 1, 1)});
        }
  }
  void line(int group, const Vec3& a, const Vec3& b, int n) {
    for (int i = 0; i < n; ++i) add(1, group, {node(a + (b - a) * double(i) / n), node(a + (b - a) * double(i + 1) / n)});
  }
  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << names_.size() << '\n';
    for (const std::string& name : names_) out << name << '\n';
    out << "$EndPhysicalNames\n$Nodes\n" << nodes_.size() << '\n';
    for (std::size_t i = 0; i < nodes_.size(); ++i) out << i + 1 << ' ' << nodes_[i].transpose() << '\n';
    out << "$EndNodes\n$Elements\n" << elements_.size() << '\n';
    for (std::size_t i = 0; i < elements_.size(); ++i) out << i + 1 << ' ' << elements_[i] << '\n';
    out << "$EndElements\n";
    return out.str();
  }

 private:
  void add(int type, int group, const std::vector<int>& nodes) {
    std::string element = std::to_string(type) + " 2 " + std::to_string(group) + " 1";
    for (const int node : nodes) element += " " + std::to_string(node);
    elements_.push_back(element);
  }
  std::map<std::array<long, 3>, int> number_;
  std::vector<Vec3> nodes_;
  std::vector<std::string> names_, elements_;
};

Settings of_hexahedra(const MeshText& mesh, const materials::Solid& material) {
  Settings settings;
  settings.mesh = GmshMesh{"m.msh", std::make_shared<const HexahedralMesh>(parse_gmsh(mesh.text(), "m.msh"))};
  settings.material = material;
  return settings;
}

Settings of_shells(const MeshText& mesh, double thickness, const materials::Solid& material, const std::vector<Part>& parts = {},
                   const std::vector<int>& planes = {}, ShellOffset offset = ShellOffset::mid) {
  Settings settings;
  GmshMesh gmsh{"m.msh", nullptr, thickness, offset};
  gmsh.read = std::make_shared<const HexahedralMesh>(shells_on(parse_gmsh_surface(mesh.text(), "m.msh"), gmsh, parts, planes));
  settings.mesh = gmsh;
  settings.element = ElementKind::shell;
  settings.material = material;
  settings.parts = parts;
  settings.symmetry_axes = planes;
  return settings;
}

TEST(GmshGroups, ShellsOfQuadranglesAreTheBuiltInPlate) {
  const materials::Solid steel = hardening(7800, 200e9, 0.3, 300e6, 1e9);
  Settings built_in = plate(Vec3(0, 0, -0.005), Vec3(0.4, 0.3, 0.005), {4, 3, 1}, steel);
  built_in.element = ElementKind::shell;
  MeshText mesh;
  mesh.name(2, 1, "skin");
  mesh.name(1, 5, "clamped");
  mesh.sheet(1, 4, 3, [](double u, double v) { return Vec3(0.4 * u, 0.3 * v, 0); });
  mesh.line(5, Vec3(0, 0, 0), Vec3(0, 0.3, 0), 3);
  Settings own = of_shells(mesh, 0.01, steel);
  own.supports = {{"clamped", {true, true, true}}};
  own.loads = {{"skin.bottom", {0}, {2e6}}};
  built_in.supports = {{"x_low", {true, true, true}}};
  built_in.loads = {{"z_low", {0}, {2e6}}};
  Structure a(built_in), b(own);
  EXPECT_DOUBLE_EQ(a.ledger().mass, b.ledger().mass);
  EXPECT_NEAR(a.stable_step() / b.stable_step(), 1.0, 1e-9);
  for (Structure* each : {&a, &b}) each->advance(1.5e-3);
  EXPECT_GT(a.ledger().plastic, 1.0);
  EXPECT_NEAR(b.ledger().plastic / a.ledger().plastic, 1.0, 1e-8);
  for (const Vec3& x : {Vec3(0.4, 0.3, 0), Vec3(0.25, 0.1, 0.004), Vec3(0.1, 0.02, -0.005)}) {
    const Vec3 moved = a.read(a.locate(x)).displacement;
    EXPECT_LT((b.read(b.locate(x)).displacement - moved).norm(), 1e-9 * moved.norm());
  }
}

TEST(GmshGroups, WavesPassFromOneMaterialToAnother) {
  // A bar that cannot widen: soft to x = 1, hard beyond. A pressure of 1 MPa acts on its end from the start.
  const materials::Solid soft = elastic(1000, 10e9, 0.25), hard = elastic(3000, 60e9, 0.25);
  MeshText mesh;
  mesh.name(3, 1, "soft");
  mesh.name(3, 2, "hard piece");
  mesh.block(1, Vec3(0, 0, 0), Vec3(1, 0.005, 0.005), {200, 1, 1});
  mesh.block(2, Vec3(1, 0, 0), Vec3(2, 0.005, 0.005), {200, 1, 1});
  Settings settings = of_hexahedra(mesh, soft);
  settings.parts = {{"hard piece", hard, {}, {}}};
  const auto sides = [&](Settings& of) {
    HexahedralMesh changed = *std::get<GmshMesh>(of.mesh).read;
    for (HexahedralMesh::Face& face : changed.faces) {
      Bounds box;
      for (const int node : face.nodes) box.include(changed.nodes[std::size_t(node)]);
      const Vec3 extent = box.high - box.low;
      face.id = extent[0] < 1e-9 ? (box.low[0] < 1e-9 ? 1 : 2) : extent[1] < 1e-9 ? 3 : 4;
    }
    changed.face_names.given = {{1, "struck"}, {3, "y"}, {4, "z"}};
    std::get<GmshMesh>(of.mesh).read = std::make_shared<const HexahedralMesh>(changed);
  };
  sides(settings);
  settings.supports = {{"y", {false, true, false}}, {"4", {false, false, true}}};
  settings.loads = {{"struck", {0}, {1e6}}};
  Structure bar(settings);
  EXPECT_NEAR(bar.ledger().mass, 0.005 * 0.005 * (1000 + 3000), 1e-12);
  const auto modulus = [](double E) { return E * 0.75 / (1.25 * 0.5); };
  const double c1 = std::sqrt(modulus(10e9) / 1000), c2 = std::sqrt(modulus(60e9) / 3000);
  const double z1 = 1000 * c1, z2 = 3000 * c2, passed = 2 * z2 / (z1 + z2) * 1e6;
  bar.advance(1.0 / c1 + 0.4 / c2);
  const auto at = [&](double x) { return bar.read(bar.locate(Vec3(x, 0.0025, 0.0025))); };
  // Behind the front in the hard piece, and behind the echo in the soft one.
  EXPECT_NEAR(at(1.2).stress(0, 0), -passed, 0.01 * passed);
  EXPECT_NEAR(at(1.2).velocity[0], passed / z2, 0.01 * passed / z2);
  EXPECT_NEAR(at(0.9).stress(0, 0), -passed, 0.01 * passed);
  EXPECT_NEAR(at(0.9).velocity[0], passed / z2, 0.01 * passed / z2);
  EXPECT_NEAR(at(0.3).stress(0, 0), -1e6, 0.01 * 1e6);
  // The front is where the speed in the hard piece takes it.
  double front = 1.0;
  while (at(front).velocity[0] > 0.5 * passed / z2) front += 0.0025;
  EXPECT_NEAR(front, 1.4, 0.01);
  const BodyLedger ledger = bar.ledger();
  EXPECT_NEAR((ledger.kinetic + ledger.elastic + ledger.viscous + ledger.integrator) / ledger.external, 1.0, 1e-6);
}

TEST(GmshGroups, PartsOfOneMaterialAreTheWhole) {
  const materials::Solid steel = hardening(7800, 200e9, 0.3, 300e6, 1e9);
  MeshText mesh;
  mesh.block(1, Vec3(0, 0, 0), Vec3(0.2, 0.1, 0.05), {4, 2, 2});
  mesh.block(2, Vec3(0.2, 0, 0), Vec3(0.3, 0.1, 0.05), {2, 2, 2});
  Settings one = of_hexahedra(mesh, steel), two = one;
  two.parts = {{"2", steel, {}, {}}};
  for (Settings* each : {&one, &two}) each->loads = {{"0", {0}, {5e8}}};
  Structure a(one), b(two);
  for (Structure* each : {&a, &b}) each->advance(1e-4);
  EXPECT_GT(a.ledger().plastic, 0.0);
  for (const Vec3& x : {Vec3(0.3, 0.1, 0.05), Vec3(0.19, 0.03, 0.02), Vec3(0.21, 0.03, 0.02)})
    EXPECT_LT((a.read(a.locate(x)).displacement - b.read(b.locate(x)).displacement).norm(), 1e-12);
}

TEST(GmshGroups, PartsAreGroupsOfTheMesh) {
  const materials::Solid steel = elastic(7800, 200e9, 0.3);
  MeshText mesh;
  mesh.name(3, 1, "left");
  mesh.name(3, 2, "right");
  mesh.block(1, Vec3(0, 0, 0), Vec3(1, 1, 1), {1, 1, 1});
  mesh.block(2, Vec3(1, 0, 0), Vec3(2, 1, 1), {1, 1, 1});
  const auto refusal = [&](const std::vector<Part>& parts, const materials::Solid& material) -> std::string {
    Settings settings = of_hexahedra(mesh, material);
    settings.parts = parts;
    try {
      Structure structure(settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({{"right", steel, {}, {}}}, steel), "");
  EXPECT_NE(refusal({{"rigth", steel, {}, {}}}, steel).find("the group 'rigth'; the groups of this mesh are left, right"),
            std::string::npos);
  EXPECT_NE(refusal({{"right", steel, {}, {}}, {"2", steel, {}, {}}}, steel).find("two parts name the group '2'"),
            std::string::npos);
  EXPECT_NE(refusal({{"right", steel, {}, {}}}, {}).find("both must be positive"), std::string::npos);
}

TEST(GmshGroups, OffsetShellsHaveTheirVolume) {
  const materials::Solid steel = elastic(7800, 200e9, 0.3);
  MeshText mesh;
  mesh.name(2, 3, "b");
  mesh.sheet(2, 3, 2, [](double u, double v) { return Vec3(0.3 * u + 0.02 * std::sin(4 * u * v), 0.2 * v, 0); });
  mesh.sheet(3, 3, 2, [](double u, double v) { return Vec3(0.3 * u, 1 + 0.2 * v, 0.4); });
  for (const ShellOffset offset : {ShellOffset::mid, ShellOffset::top, ShellOffset::bottom}) {
    const Settings settings = of_shells(mesh, 0.004, steel, {{"b", {}, 0.01, {}}}, {}, offset);
    double area = 0.0;
    const QuadrangleSurface surface = parse_gmsh_surface(mesh.text(), "m.msh");
    for (std::size_t c = 0; c < surface.cells.size(); ++c) {
      const auto& cell = surface.cells[c];
      const auto x = [&](int v) { return surface.nodes[std::size_t(cell[std::size_t(v)])]; };
      area += (surface.groups[c] == 3 ? 0.01 : 0.004) * 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
    }
    EXPECT_NEAR(Structure(settings).ledger().mass / (7800 * area), 1.0, 1e-12);
  }
}

TEST(GmshGroups, CylinderOfShellsUnderInnerPressure) {
  // A quarter of a ring of 0.5 m, 10 mm thick, held in length; the pressure comes so slowly that nothing swings.
  const double E = 200e9, nu = 0.3, radius = 0.5, t = 0.01, p = 1e6;
  MeshText mesh;
  mesh.name(2, 1, "ring");
  mesh.name(1, 1, "end");
  const int around = 16;
  const auto at = [&](double u, double v) {
    const double angle = 0.5 * std::numbers::pi * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.1 * v);
  };
  mesh.sheet(1, around, 1, at);
  for (int i = 0; i < around; ++i)
    for (const double v : {0.0, 1.0}) mesh.line(1, at(double(i) / around, v), at(double(i + 1) / around, v), 1);
  Settings settings = of_shells(mesh, t, elastic(7800, E, nu), {}, {0, 1});
  settings.supports = {{"end", {false, false, true}}};
  const double period = 2 * std::numbers::pi * radius * std::sqrt(7800 * (1 - nu * nu) / E);
  settings.loads = {{"ring.bottom", {0, 10 * period}, {0, p}}};
  Structure ring(settings);
  ring.advance(10 * period);
  // Lame's tube of thick walls in plane strain.
  const double a = radius - t / 2, b = radius + t / 2, r = radius;
  const double moved = (1 + nu) / E * a * a * p / (b * b - a * a) * ((1 - 2 * nu) * r + b * b / r);
  double sum = 0.0;
  for (int i = 0; i <= 8; ++i) {
    const Vec3 x = at(i / 8.0, 0.5);
    sum += ring.read(ring.locate(x)).displacement.dot(x.normalized() - Vec3(0, 0, x.normalized()[2])) / 9.0;
  }
  EXPECT_NEAR(sum / moved, 1.0, 0.01);
  std::printf("hoop strain %.6e, exact %.6e\n", sum / radius, moved / radius);
}

/// A point of a structure that swings about where a load, there at once, holds it: the first harmonic that fits best.
struct Swing {
  double deflection, period;
};
Swing swing(Structure& beam, const Vec3& at, int axis, double until, double shortest, double longest) {
  const BodyPoint point = beam.locate(at);
  std::vector<std::array<double, 2>> places;
  for (int i = 1; i <= 300; ++i) {
    beam.advance(until * i / 300);
    places.push_back({beam.time(), beam.read(point).displacement[axis]});
  }
  Swing best{};
  double least = 1e300;
  for (double period = shortest; period <= longest; period += 1e-3 * shortest) {
    Mat3 matrix = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    const auto shape = [&](double time) {
      const double angle = 2 * std::numbers::pi * time / period;
      return Vec3(1.0, std::cos(angle), std::sin(angle));
    };
    for (const auto& [time, place] : places) {
      matrix += shape(time) * shape(time).transpose();
      right += place * shape(time);
    }
    const Vec3 fitted = matrix.inverse() * right;
    double square = 0.0;
    for (const auto& [time, place] : places) square += std::pow(shape(time).dot(fitted) - place, 2);
    if (square >= least) continue;
    least = square;
    best = {std::abs(fitted[0]), period};
  }
  return best;
}

TEST(GmshGroups, TeeBeamOfShellsIsThatOfHexahedra) {
  // A cantilever of half a metre: a flange of 0.2 m x 8 mm with a web of 80 mm x 6 mm under it.
  const materials::Solid steel = elastic(7800, 200e9, 0.3);
  const double length = 0.5, half = 0.1, t = 0.008, web = 0.006, depth = 0.08;
  const auto solid = [&](int n, int through) {
    MeshText mesh;
    mesh.name(2, 1, "root");
    mesh.name(2, 2, "top");
    const double ys[4] = {-half, -web / 2, web / 2, half};
    const int ny[3] = {n, 1, n}, nx = 10 * n;
    for (int k = 0; k < 3; ++k) mesh.block(1, Vec3(0, ys[k], -t / 2), Vec3(length, ys[k + 1], t / 2), {nx, ny[k], through});
    mesh.block(1, Vec3(0, -web / 2, -depth), Vec3(length, web / 2, -t / 2), {nx, 1, n});
    Settings settings = of_hexahedra(mesh, steel);
    HexahedralMesh named = *std::get<GmshMesh>(settings.mesh).read;
    for (HexahedralMesh::Face& face : named.faces) {
      Bounds box;
      for (const int node : face.nodes) box.include(named.nodes[std::size_t(node)]);
      if (box.high[0] < 1e-9) face.id = 1;
      else if (box.low[2] > t / 2 - 1e-9) face.id = 2;
    }
    named.face_names.given = {{1, "root"}, {2, "top"}};
    std::get<GmshMesh>(settings.mesh).read = std::make_shared<const HexahedralMesh>(named);
    settings.supports = {{"root", {true, true, true}}};
    settings.loads = {{"top", {0}, {1e4}}};
    return settings;
  };
  const auto shells = [&](int n) {
    MeshText mesh;
    mesh.name(2, 1, "flange");
    mesh.name(2, 2, "web");
    mesh.name(1, 1, "root");
    mesh.sheet(1, 10 * n, 2 * n, [&](double u, double v) { return Vec3(length * u, half * (2 * v - 1), 0); });
    mesh.sheet(2, 10 * n, n, [&](double u, double v) { return Vec3(length * u, 0, -depth * v); });
    mesh.line(1, Vec3(0, -half, 0), Vec3(0, half, 0), 2 * n);
    mesh.line(1, Vec3(0, 0, 0), Vec3(0, 0, -depth), n);
    Settings settings = of_shells(mesh, t, steel, {{"web", {}, web, {}}});
    settings.supports = {{"root", {true, true, true}}};
    settings.loads = {{"flange.top", {0}, {1e4}}};
    return settings;
  };
  const double mass = 7800 * length * (2 * half * t + web * (depth - t / 2));
  Structure hexahedra(solid(3, 2)), shell(shells(2));
  EXPECT_NEAR(hexahedra.ledger().mass / mass, 1.0, 1e-10);
  EXPECT_NEAR(shell.ledger().mass / mass, 1.0, 1e-10);
  const auto of = [&](Structure& beam) { return swing(beam, Vec3(length, 0, 0), 2, 5e-3, 4e-3, 6e-3); };
  const Swing wanted = of(hexahedra), found = of(shell);
  std::printf("deflection: hexahedra %.4e m, shells %.4e m; period %.4e s, %.4e s\n", wanted.deflection, found.deflection,
              wanted.period, found.period);
  EXPECT_NEAR(found.deflection / wanted.deflection, 1.0, 0.02);
  EXPECT_NEAR(found.period / wanted.period, 1.0, 0.03);
}

TEST(GmshGroups, TiedPlatesKeepMomentumAndEnergy) {
  // A plate with crossing bars, thrown and loaded: nothing holds it.
  const materials::Solid steel = hardening(7800, 200e9, 0.3, 300e6, 1e9);
  MeshText mesh;
  mesh.name(2, 1, "plate");
  mesh.sheet(1, 6, 6, [](double u, double v) { return Vec3(0.3 * u, 0.3 * v, 0); });
  mesh.sheet(2, 6, 2, [](double u, double v) { return Vec3(0.3 * u, 0.15, 0.06 * v); });
  mesh.sheet(3, 6, 2, [](double u, double v) { return Vec3(0.15, 0.3 * u, 0.06 * v); });
  Settings settings = of_shells(mesh, 0.006, steel, {{"3", elastic(2700, 70e9, 0.33), 0.004, {}}});
  settings.initial_velocity = Vec3(3, -2, 10);
  settings.wet_faces = {"plate.bottom", "2.top"};
  Structure body(settings);
  const BodyLedger start = body.ledger();
  std::vector<Vec3> impulse(body.wet_surface().nodes.size());
  double sum = 0.0;
  for (const double mass : body.wet_masses()) sum += mass;
  EXPECT_NEAR(sum / start.mass, 1.0, 1e-12);
  Vec3 given = Vec3::Zero();
  for (std::size_t i = 0; i < impulse.size(); ++i) {
    impulse[i] = Vec3(0.01 * std::sin(double(i)), 0.01, 0.2 + 0.2 * std::cos(0.7 * double(i)));
    given += impulse[i];
  }
  body.advance(2e-5, impulse);
  body.advance(5e-4);
  const BodyLedger end = body.ledger();
  EXPECT_LT((end.momentum - start.momentum - given).norm(), 1e-10 * given.norm());
  const auto energy = [](const BodyLedger& of) { return of.kinetic + of.elastic + of.plastic + of.viscous + of.integrator; };
  EXPECT_GT(end.elastic, 0.0);
  EXPECT_NEAR((energy(end) - energy(start)) / end.received, 1.0, 1e-6);
  // Without forces the angular momentum stays.
  const Vec3 before = body.ledger().angular_momentum;
  body.advance(1e-3);
  EXPECT_LT((body.ledger().angular_momentum - before).norm(), 2e-3 * before.norm());
}

}  // namespace
}  // namespace undex::fem::testing
