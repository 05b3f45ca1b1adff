// Meshes: volumes, true circles, symmetry planes, orientation of wet faces, gmsh, point location.
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "bodies.hpp"
#include "core/gmsh_file.hpp"

namespace undex::fem::testing {
namespace {

Settings tube(int axis, std::vector<int> symmetry_axes) {
  Settings settings;
  settings.mesh = TubeMesh{.axis = axis,
                           .center = Vec3::Zero(),
                           .inner_radius = 0.04445,
                           .outer_radius = 0.0508,
                           .low = -0.1143,
                           .high = 0.1143,
                           .cells_through = 2,
                           .cells_around = 32,
                           .cells_along = 8};
  settings.material = elastic(2700, 71e9, 0.33);
  settings.symmetry_axes = std::move(symmetry_axes);
  settings.wet_faces = {"inner"};
  return settings;
}

double volume(const Grid& grid) {
  double sum = 0.0;
  for (const auto& cell : grid.nodal_volume)
    for (double part : cell) sum += part;
  return sum;
}

/// Area vector of a quadrilateral.
Vec3 area(const std::vector<Vec3>& x, const std::array<int, 4>& quad) {
  return 0.5 * (x[quad[2]] - x[quad[0]]).cross(x[quad[3]] - x[quad[1]]);
}

Vec3 middle(const std::vector<Vec3>& x, const std::array<int, 4>& quad) {
  return 0.25 * (x[quad[0]] + x[quad[1]] + x[quad[2]] + x[quad[3]]);
}

TEST(Meshes, TubePartsAreSharesOfTheWhole) {
  const double sides = 32, prism = 0.5 * sides * std::sin(2 * std::numbers::pi / sides);
  const double exact = prism * (0.0508 * 0.0508 - 0.04445 * 0.04445) * 0.2286;
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const std::vector<std::vector<int>> parts{{}, {axis}, {b}, {c}, {b, c}, {axis, b}, {0, 1, 2}};
    for (const auto& planes : parts) {
      const Mesher mesher(tube(axis, planes));
      const Grid& grid = mesher.grid();
      const double share = std::pow(0.5, planes.size());
      EXPECT_NEAR(volume(grid), share * exact, 1e-12 * exact);
      EXPECT_EQ(grid.cells.size(), static_cast<std::size_t>(share * 2 * 32 * 8));
      std::size_t on_circle = 0;
      for (const Vec3& x : grid.nodes) {
        const double r = std::hypot(x[b], x[c]);
        on_circle += std::abs(r - 0.04445) < 1e-15 || std::abs(r - 0.0508) < 1e-15;
        for (int plane : planes) {
          EXPECT_GE(x[plane], 0.0);
          EXPECT_TRUE(x[plane] == 0.0 || x[plane] > 1e-4) << "a node nearly on the plane";
        }
      }
      EXPECT_EQ(on_circle, grid.nodes.size() / 3 * 2) << "two of the three layers";
      const bool cut = std::count(planes.begin(), planes.end(), axis) > 0;
      EXPECT_EQ(grid.faces.count("low"), cut ? 0u : 1u);
    }
  }
}

TEST(Meshes, TubeThatStandsOnTheSymmetryPlaneKeepsItsCells) {
  Settings settings = tube(2, {2});
  std::get<TubeMesh>(settings.mesh).low = 0.0;
  const Mesher mesher(settings);
  EXPECT_EQ(mesher.grid().cells.size(), 2u * 32 * 8);
  settings.initial_velocity = Vec3(0, 0, 5);
  Structure structure(settings);
  const auto foot = structure.locate(Vec3(0.0508, 0, 0)), top = structure.locate(Vec3(0.0508, 0, 0.1143));
  EXPECT_EQ(structure.read(foot).velocity[2], 0.0);
  EXPECT_EQ(structure.read(top).velocity[2], 5.0);
}

TEST(Meshes, WetFacesPointIntoTheStructure) {
  for (int axis = 0; axis < 3; ++axis)
    for (const char* name : {"inner", "outer"}) {
      Settings settings = tube(axis, {});
      settings.wet_faces = {name};
      const Structure structure(settings);
      const WetSurface& wet = structure.wet_surface();
      EXPECT_EQ(wet.faces.size(), 32u * 8);
      EXPECT_EQ(wet.nodes.size(), 32u * 9);
      for (const auto& face : wet.faces) {
        Vec3 outward = middle(wet.nodes, face);
        outward[axis] = 0.0;
        const double cosine = area(wet.nodes, face).normalized().dot(outward.normalized());
        EXPECT_NEAR(cosine, name == std::string("inner") ? 1.0 : -1.0, 1e-12);
      }
    }
  for (const char* name : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) {
    Settings settings = plate(Vec3(0, 0, 0), Vec3(1, 2, 3), {2, 3, 4}, elastic(1, 1, 0.3));
    settings.wet_faces = {name};
    const Structure structure(settings);
    const int d = name[0] - 'x';
    Vec3 sum = Vec3::Zero(), expected = Vec3::Zero();
    for (const auto& face : structure.wet_surface().faces) sum += area(structure.wet_surface().nodes, face);
    expected[d] = (name[2] == 'l' ? 1.0 : -1.0) * 6.0 / (d + 1);
    EXPECT_LT((sum - expected).norm(), 1e-12) << name;
  }
}

/// What is behind a wet node: of a sheet the mass of its whole thickness over the node's area, however many cells are through.
TEST(Meshes, WetNodesCarryWhatIsBehindThem) {
  for (const ElementKind kind : {ElementKind::hexahedron, ElementKind::shell})
    for (const int through : {1, 2, 3}) {
      if (kind == ElementKind::shell && through > 1) continue;
      for (const bool both : {false, true}) {
        Settings settings = plate(Vec3(0, 0, 0), Vec3(2, 3, 0.1), {2, 3, through}, elastic(1000, 1e9, 0.3));
        settings.element = kind;
        settings.wet_faces = {"z_low"};
        if (both) settings.wet_faces.push_back("z_high");
        const Structure structure(settings);
        const auto mass = structure.wet_masses();
        const std::vector<Vec3>& x = structure.wet_surface().nodes;
        ASSERT_EQ(mass.size(), x.size());
        double sum = 0.0;
        for (std::size_t n = 0; n < mass.size(); ++n) {
          const auto edge = [&](double at, double end) { return at == 0.0 || at == end ? 0.5 : 1.0; };
          EXPECT_NEAR(mass[n], (both ? 0.5 : 1.0) * 100 * edge(x[n][0], 2) * edge(x[n][1], 3), 1e-9);
          sum += mass[n];
        }
        EXPECT_NEAR(sum, structure.ledger().mass, 1e-9);
      }
    }
  const Structure whole(tube(2, {}));
  const auto mass = whole.wet_masses();
  double sum = 0.0;
  for (std::size_t n = 0; n < mass.size(); ++n) {
    const bool end = std::abs(std::abs(whole.wet_surface().nodes[n][2]) - 0.1143) < 1e-9;
    EXPECT_NEAR(mass[n], whole.ledger().mass / (32 * 8) * (end ? 0.5 : 1.0), 1e-9);
    sum += mass[n];
  }
  EXPECT_NEAR(sum, whole.ledger().mass, 1e-9);
  Settings dry = tube(2, {});
  dry.wet_faces.clear();
  EXPECT_TRUE(Structure(dry).wet_masses().empty());
}

TEST(Meshes, RodFillsTheCylinder) {
  for (int axis = 0; axis < 3; ++axis) {
    double coarse_error = 0.0;
    for (int cells : {4, 8}) {
      Settings settings;
      settings.mesh = RodMesh{.axis = axis,
                              .center = Vec3::Zero(),
                              .radius = 0.01,
                              .low = -0.03,
                              .high = 0.03,
                              .cells_radial = cells,
                              .cells_along = 6};
      settings.material = elastic(1, 1, 0.3);
      const Grid full = Mesher(settings).grid();
      const double error = 1.0 - volume(full) / (std::numbers::pi * 1e-4 * 0.06);
      EXPECT_GT(error, 0.0);
      if (cells == 4) coarse_error = error;
      if (cells == 8) {
        EXPECT_NEAR(coarse_error / error, 4.0, 0.2);
      }
      settings.symmetry_axes = {0, 1, 2};
      const Grid octant = Mesher(settings).grid();
      EXPECT_NEAR(volume(octant), volume(full) / 8, 1e-12 * volume(full));
      EXPECT_EQ(octant.cells.size() * 8, full.cells.size());
      EXPECT_EQ(full.faces.at("low").size() * 6, full.cells.size());
      for (const auto& quad : full.faces.at("side"))
        for (int node : quad) {
          Vec3 across = full.nodes[node];
          across[axis] = 0.0;
          EXPECT_NEAR(across.norm(), 0.01, 1e-16);
        }
    }
  }
}

TEST(Meshes, OctantMovesLikeTheWholeTube) {
  double displacement[2], energy[2];
  for (int octant = 0; octant < 2; ++octant) {
    Settings settings = tube(2, octant ? std::vector<int>{0, 1, 2} : std::vector<int>{});
    settings.material = hardening(2700, 71e9, 0.33, 100e6, 1e9);
    settings.loads = {{"inner", {0, 2e-5}, {3e8, 0}}};
    Structure structure(settings);
    for (int window = 1; window <= 100; ++window) structure.advance(window * 3e-7, {});
    const auto probe = structure.locate(Vec3(0.0508, 0, 0));
    EXPECT_LT(probe.distance, 1e-12);
    displacement[octant] = structure.read(probe).displacement[0];
    energy[octant] = structure.ledger().plastic * (octant ? 8 : 1);
  }
  EXPECT_GT(displacement[0], 1e-4);
  EXPECT_NEAR(displacement[1], displacement[0], 1e-9 * displacement[0]);
  EXPECT_NEAR(energy[1], energy[0], 1e-9 * energy[0]);
}

/// Two unit cubes side by side along x; faces at x = 0 and x = 2 have physical ids 7 and 8.
std::string two_cubes(const std::string& name, bool tetrahedron = false) {
  const std::string path = (std::filesystem::path(::testing::TempDir()) / name).string();
  std::ofstream file(path);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n";
  for (int i = 0; i < 3; ++i)
    file << 4 * i + 1 << " " << i << " 0 0\n"
         << 4 * i + 2 << " " << i << " 1 0\n"
         << 4 * i + 3 << " " << i << " 1 1\n"
         << 4 * i + 4 << " " << i << " 0 1\n";
  file << "$EndNodes\n$Elements\n";
  if (tetrahedron) file << "1\n1 4 2 1 1 1 5 2 4\n";
  else
    file << "4\n1 3 2 7 7 1 2 3 4\n2 3 2 8 8 9 10 11 12\n"
         << "3 5 2 1 1 1 5 6 2 4 8 7 3\n4 5 2 1 1 5 9 10 6 8 12 11 7\n";
  file << "$EndElements\n";
  return path;
}

TEST(Meshes, GmshFileIsRead) {
  Settings settings;
  settings.mesh = GmshMesh{two_cubes("two_cubes.msh")};
  settings.material = elastic(1000, 1e9, 0.3);
  settings.wet_faces = {"7"};
  settings.supports = {{"8", {true, false, false}}};
  const Structure structure(settings);
  EXPECT_EQ(structure.cell_count(), 2u);
  EXPECT_EQ(structure.node_count(), 12u);
  EXPECT_NEAR(structure.ledger().mass, 2000.0, 1e-9);
  ASSERT_EQ(structure.wet_surface().faces.size(), 1u);
  EXPECT_LT((area(structure.wet_surface().nodes, structure.wet_surface().faces[0]) - Vec3(1, 0, 0)).norm(), 1e-12);
}

TEST(Meshes, GmshMistakesAreNamed) {
  const auto message = [](const std::string& path) -> std::string {
    Settings settings;
    settings.mesh = GmshMesh{path};
    settings.material = elastic(1000, 1e9, 0.3);
    try {
      Structure structure(settings);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message("no/such/mesh.msh").find("no/such/mesh.msh"), std::string::npos);
  EXPECT_NE(message(two_cubes("tetrahedron.msh", true)).find("hexahedra"), std::string::npos)
      << message(two_cubes("tetrahedron.msh", true));
  const std::string garbage = (std::filesystem::path(::testing::TempDir()) / "garbage.msh").string();
  std::ofstream(garbage) << "this is no mesh\n";
  EXPECT_NE(message(garbage).find("not a gmsh mesh of hexahedra"), std::string::npos) << message(garbage);
}

/// Whatever is done to the numbers of a file, it is refused or its mesh can be built.
TEST(Meshes, ChangedGmshFilesAreRefusedOrBuilt) {
  std::ifstream file(two_cubes("sound.msh"));
  std::ostringstream whole;
  whole << file.rdbuf();
  const std::string sound = whole.str();
  const std::vector<std::string> values{"0", "1", "2", "3", "6", "9", "12", "-1", "0.9", "1.5", "0.5", "1e300", "nan", "77"};
  std::mt19937 random(11);
  int built = 0;
  for (int i = 0; i < 1500; ++i) {
    std::string text = sound;
    for (int k = 0; k < 1 + i % 3; ++k) {
      const std::size_t at = text.find_first_of(" \n", random() % (text.size() - 20));
      text.replace(at + 1, text.find_first_of(" \n", at + 1) - at - 1, values[random() % values.size()]);
    }
    Settings settings;
    try {
      settings.mesh = GmshMesh{"changed.msh", std::make_shared<const HexahedralMesh>(parse_gmsh(text, "changed.msh"))};
    } catch (const std::invalid_argument&) {
      continue;
    }
    settings.material = elastic(1000, 1e9, 0.3);
    try {
      EXPECT_GT(Structure(settings).ledger().mass, 0.0) << text;
      ++built;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("is inverted or flat"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(built, 50);
}

TEST(Meshes, LocateFindsPointsInsideAndOutside) {
  const Structure structure(tube(2, {}));
  // Inside: the place maps back to the point.
  for (const Vec3& x : {Vec3(0.047, 0.003, 0.05), Vec3(-0.02, 0.0425, -0.11), Vec3(0, -0.05, 0.0001)}) {
    const auto probe = structure.locate(x);
    EXPECT_LT(probe.distance, 1e-12);
    EXPECT_LT((structure.read(probe).position - x).norm(), 1e-12);
  }
  // Outside: the nearest point of the mesh, here on the outer wall at a node's angle, and on the rim.
  const auto far = structure.locate(Vec3(0.06, 0, 0.0));
  EXPECT_NEAR(far.distance, 0.06 - 0.0508, 1e-12);
  EXPECT_LT((structure.read(far).position - Vec3(0.0508, 0, 0)).norm(), 1e-12);
  const auto rim = structure.locate(Vec3(0.0, 0.0508 + 3e-3, 0.1143 + 4e-3));
  EXPECT_NEAR(rim.distance, 5e-3, 1e-12);
  // On the true circle between two nodes: the chord's sagitta away.
  const double half = std::numbers::pi / 32;
  const auto arc = structure.locate(0.0508 * Vec3(std::cos(half), std::sin(half), 0.0));
  EXPECT_NEAR(arc.distance, 0.0508 * (1 - std::cos(half)), 1e-12);
}

}  // namespace
}  // namespace undex::fem::testing
