// Layers of hexahedra on surfaces of quadrangles: their volume, their joints, and what is refused.
#include "core/quadrangle_surface.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace undex {
namespace {

/// A surface put together from patches, whose nodes at one place are one.
struct Sheets {
  QuadrangleSurface surface;

  int node(const Vec3& x) {
    for (std::size_t i = 0; i < surface.nodes.size(); ++i)
      if ((surface.nodes[i] - x).norm() < 1e-9) return int(i);
    surface.nodes.push_back(x);
    return int(surface.nodes.size()) - 1;
  }
  /// m x n quadrangles; `at` takes the unit square into space.
  void add(int group, int m, int n, const auto& at) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < m; ++i) {
        const auto x = [&](int a, int b) { return node(at(double(i + a) / m, double(j + b) / n)); };
        surface.cells.push_back({x(0, 0), x(1, 0), x(1, 1), x(0, 1)});
        surface.groups.push_back(group);
      }
  }
};

double volume(const HexahedralMesh& mesh) {
  double sum = 0.0;  // by the flow of x / 3 through the faces, whose four triangles meet in the middle
  for (const HexahedralMesh::Face& face : mesh.faces) {
    Vec3 middle = Vec3::Zero();
    for (const int node : face.nodes) middle += 0.25 * mesh.nodes[std::size_t(node)];
    for (int v = 0; v < 4; ++v) {
      const Vec3 &a = mesh.nodes[std::size_t(face.nodes[v])], &b = mesh.nodes[std::size_t(face.nodes[(v + 1) % 4])];
      sum += middle.dot(a.cross(b)) / 6.0;
    }
  }
  return std::abs(sum);
}

/// Of flat cells.
double area(const Sheets& sheets) {
  const auto& [nodes, cells, groups, edges, group_names, edge_names, remarks] = sheets.surface;
  double sum = 0.0;
  for (const auto& cell : cells)
    sum += 0.5 * (nodes[std::size_t(cell[2])] - nodes[std::size_t(cell[0])])
                     .cross(nodes[std::size_t(cell[3])] - nodes[std::size_t(cell[1])])
                     .norm();
  return sum;
}

std::function<Layer(int)> all(double thickness, ShellOffset offset = ShellOffset::mid) {
  return [=](int) { return Layer{thickness, offset}; };
}

HexahedralMesh made(const Sheets& sheets, const std::function<Layer(int)>& layer, const std::vector<int>& planes = {}) {
  return thickened(sheets.surface, layer, planes, "m.msh");
}

std::string refusal(const Sheets& sheets, const std::function<Layer(int)>& layer) {
  try {
    made(sheets, layer);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Sheets flat() {
  Sheets sheets;
  sheets.add(1, 3, 2, [](double u, double v) { return Vec3(0.3 * u + 0.02 * std::sin(9 * u * v), 0.2 * v, 0); });
  return sheets;
}

/// A plate, and a bar across its middle.
Sheets tee(bool crossing = false) {
  Sheets sheets;
  sheets.add(1, 4, 4, [](double u, double v) { return Vec3(0.4 * u, 0.4 * v, 0); });
  sheets.add(2, 4, 2, [](double u, double v) { return Vec3(0.4 * u, 0.2, 0.1 * v); });
  if (crossing) sheets.add(3, 4, 2, [](double u, double v) { return Vec3(0.2, 0.4 * u, 0.1 * v); });
  return sheets;
}

TEST(QuadrangleSurface, FlatSheetsHaveAreaTimesThickness) {
  Sheets sheets = flat();
  double low[3], high[3];
  int k = 0;
  for (const ShellOffset offset : {ShellOffset::mid, ShellOffset::top, ShellOffset::bottom}) {
    const HexahedralMesh mesh = made(sheets, all(0.004, offset));
    EXPECT_NEAR(volume(mesh), 0.004 * area(sheets), 1e-16);
    const Bounds box = bounds(mesh);
    low[k] = box.low[2];
    high[k++] = box.high[2];
  }
  EXPECT_DOUBLE_EQ(low[0], -0.002);
  EXPECT_DOUBLE_EQ(high[0], 0.002);
  EXPECT_DOUBLE_EQ(low[1], 0.0);
  EXPECT_DOUBLE_EQ(high[1], 0.004);
  EXPECT_DOUBLE_EQ(low[2], -0.004);
  EXPECT_DOUBLE_EQ(high[2], 0.0);
  Sheets tilted;
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  tilted.add(1, 3, 2, [&](double u, double v) { return Vec3(turn * Vec3(0.3 * u, 0.2 * v, 0)); });
  for (const ShellOffset offset : {ShellOffset::mid, ShellOffset::top, ShellOffset::bottom})
    EXPECT_NEAR(volume(made(tilted, all(0.004, offset))), 0.004 * 0.06, 1e-15);
}

TEST(QuadrangleSurface, CornersOfABoxAreMitred) {
  for (const ShellOffset offset : {ShellOffset::mid, ShellOffset::top, ShellOffset::bottom}) {
    Sheets box;  // normals to the outside
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {0.0, 1.0})
        box.add(1, 2, 2, [&](double u, double v) {
          Vec3 x;
          x[axis] = side;
          x[(axis + 1) % 3] = side > 0 ? u : v;
          x[(axis + 2) % 3] = side > 0 ? v : u;
          return x;
        });
    const double t = 0.1, outer = offset == ShellOffset::mid ? 1 + t : offset == ShellOffset::top ? 1 + 2 * t : 1;
    const HexahedralMesh mesh = made(box, all(t, offset));
    EXPECT_EQ(mesh.nodes.size(), 52u);
    EXPECT_NEAR(volume(mesh), std::pow(outer, 3) - std::pow(outer - 2 * t, 3), 1e-9);
    EXPECT_TRUE(mesh.ties.empty());
  }
}

TEST(QuadrangleSurface, FacetsOfACylinderAreAsThickAsSaid) {
  Sheets sheets;
  const double radius = 0.5, t = 0.02;
  const int around = 12;
  sheets.add(1, around, 2, [&](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), v);
  });
  const HexahedralMesh whole = made(sheets, all(t));
  // Of a regular polygon: the mean perimeter times the thickness.
  EXPECT_NEAR(volume(whole), t * 2 * around * radius * std::sin(std::numbers::pi / around), 1e-13);
  // A quarter has the nodes of the whole, in its planes too.
  Sheets quarter;
  quarter.add(1, around / 4, 2, [&](double u, double v) {
    const double angle = 0.5 * std::numbers::pi * u;
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), v);
  });
  const HexahedralMesh part = made(quarter, all(t), {0, 1});
  EXPECT_NEAR(4 * volume(part), volume(whole), 1e-13);
  for (const Vec3& x : part.nodes) {
    double nearest = 1.0;
    for (const Vec3& y : whole.nodes) nearest = std::min(nearest, (x - y).norm());
    EXPECT_LT(nearest, 1e-14);
  }
}

TEST(QuadrangleSurface, BarsBeginAtTheFaceOfThePlate) {
  const auto layer = [](int group) { return Layer{group == 1 ? 0.02 : 0.01}; };
  const HexahedralMesh mesh = made(tee(), layer);
  EXPECT_NEAR(volume(mesh), 0.16 * 0.02 + 0.4 * 0.01 * (0.1 - 0.01), 1e-14);
  EXPECT_EQ(mesh.ties.size(), 10u);
  for (const HexahedralMesh::Tie& tie : mesh.ties) {
    EXPECT_NEAR(mesh.nodes[std::size_t(tie.node)][2], 0.01, 1e-15);
    EXPECT_NEAR(std::abs(mesh.nodes[std::size_t(tie.node)][1] - 0.2), 0.005, 1e-9);
    double sum = 0.0;
    for (const auto& [node, weight] : tie.to) sum += weight;
    EXPECT_NEAR(sum, 1.0, 1e-15);
  }
  EXPECT_EQ(pieces(mesh, JoinedBy::nodes).back(), 0);
  EXPECT_EQ(pieces(mesh, JoinedBy::faces).back(), 0);
  EXPECT_TRUE(mesh.remarks.empty());
}

TEST(QuadrangleSurface, CrossingBarsHangTogether) {
  const auto layer = [](int group) { return Layer{group == 1 ? 0.02 : 0.01}; };
  const HexahedralMesh mesh = made(tee(true), layer);
  // One bar goes through; the other ends at its faces.
  EXPECT_NEAR(volume(mesh), 0.16 * 0.02 + 0.01 * (0.1 - 0.01) * (0.4 + 0.4 - 0.01), 1e-9);
  EXPECT_EQ(pieces(mesh, JoinedBy::nodes).back(), 0);
  std::vector<int> tied(mesh.nodes.size(), 0);
  for (const HexahedralMesh::Tie& tie : mesh.ties) tied[std::size_t(tie.node)] = 1;
  for (const HexahedralMesh::Tie& tie : mesh.ties)
    for (const auto& [node, weight] : tie.to) EXPECT_EQ(tied[std::size_t(node)], 0);
}

TEST(QuadrangleSurface, FacesAreNamedByGroups) {
  Sheets sheets = tee();
  sheets.surface.group_names.given = {{1, "plating"}};
  sheets.surface.edge_names.given = {{7, "clamped"}};
  for (int i = 0; i < 4; ++i)
    sheets.surface.edges.push_back({{sheets.node(Vec3(0, 0.1 * i, 0)), sheets.node(Vec3(0, 0.1 * (i + 1), 0))}, 7});
  const HexahedralMesh mesh = made(sheets, all(0.01));
  std::map<std::string, int> count;
  for (const HexahedralMesh::Face& face : mesh.faces) ++count[mesh.face_names.of(face.id)];
  EXPECT_EQ(count, (std::map<std::string, int>{{"plating.top", 16},
                                               {"plating.bottom", 16},
                                               {"2.top", 8},
                                               {"2.bottom", 8},
                                               {"clamped", 4},
                                               {"2.root", 4},
                                               {"0", 12 + 4 + 2 * 2}}));
  sheets.surface.edge_names.given[7] = "plating.top";
  EXPECT_NE(refusal(sheets, all(0.01)).find("the curves 'plating.top' are called like a side"), std::string::npos);
}

TEST(QuadrangleSurface, OneLayerHasItsTopOnOneSide) {
  Sheets sheets = flat();
  std::reverse(sheets.surface.cells[2].begin(), sheets.surface.cells[2].end());
  const HexahedralMesh mesh = made(sheets, all(0.004, ShellOffset::top));
  ASSERT_EQ(mesh.remarks.size(), 1u);
  EXPECT_NE(mesh.remarks[0].find("1 of the quadrangles are listed the other way round"), std::string::npos);
  EXPECT_DOUBLE_EQ(bounds(mesh).low[2], 0.0);
}

TEST(QuadrangleSurface, WhatWouldCrossItselfIsRefused) {
  const auto expect = [](const std::string& found, const std::string& wanted) {
    EXPECT_TRUE(found.starts_with("m.msh: ")) << found;
    EXPECT_NE(found.find(wanted), std::string::npos) << found;
  };
  Sheets strip;
  strip.add(1, 16, 1, [](double u, double v) {
    const double angle = 2 * std::numbers::pi * u, half = (v - 0.5) * 0.4, turn = 0.5 * angle;
    const double radius = 1 + half * std::cos(turn);
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), half * std::sin(turn));
  });
  expect(refusal(strip, all(0.01)), "as a Moebius strip");

  Sheets folded;
  folded.add(1, 2, 2, [](double u, double v) { return Vec3(u, v, 0); });
  folded.add(1, 2, 2, [](double u, double v) { return Vec3(u, v * std::cos(0.2), v * std::sin(0.2)); });
  expect(refusal(folded, all(0.01)), "at less than 30 degrees");

  Sheets star;
  for (int k = 0; k < 5; ++k) {
    const double angle = 2 * std::numbers::pi * (0.25 + 0.15 * k) * 0.5;
    star.add(1, 1, 1, [&](double u, double v) { return Vec3(u * std::cos(angle), u * std::sin(angle), v); });
  }
  expect(refusal(star, all(0.01)), "less than 30 degrees");
  Sheets corner;
  for (int axis = 0; axis < 3; ++axis) {
    const double angle[3] = {0, 0.5 * std::numbers::pi, 0.25 * std::numbers::pi};
    corner.add(1, 1, 1, [&](double u, double v) { return Vec3(u * std::cos(angle[axis]), u * std::sin(angle[axis]), v); });
  }
  expect(refusal(corner, all(0.01)), "of which no two go on in one another");

  Sheets tube;
  tube.add(1, 12, 2, [](double u, double v) {
    const double angle = 2 * std::numbers::pi * u;
    return Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), v);
  });
  expect(refusal(tube, all(0.25)), "too thick for its cells or its curvature");
}

}  // namespace
}  // namespace undex
