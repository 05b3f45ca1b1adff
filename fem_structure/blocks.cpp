// Structured cells of tubes, rods and plates. Nodes of round surfaces lie on true circles, those of symmetry planes
// exactly on the plane.
#include "fem_structure/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "fem_structure/mistakes.hpp"

namespace undex::fem {
namespace {

constexpr const char* axis_names[3] = {"x", "y", "z"};

bool has(const std::vector<int>& axes, int axis) { return std::find(axes.begin(), axes.end(), axis) != axes.end(); }

void check_symmetry_axes(Mistakes& mistakes, const std::vector<int>& axes) {
  for (int axis : axes)
    mistakes.require(axis >= 0 && axis <= 2, "symmetry axis ", axis, " does not exist; give 0, 1 or 2 (x, y, z)");
}

/// An extent low..high with its cells, and what a symmetry plane at zero leaves of it.
struct Extent {
  double low, high;
  int cells;
  bool cut = false;  ///< the low end is the symmetry plane, no longer a face of the body

  double at(int i) const { return i == cells ? high : low + (high - low) * i / cells; }
};

Extent kept(Mistakes& mistakes, double low, double high, int cells, int axis, const std::vector<int>& symmetry_axes,
            const char* cells_name) {
  Extent extent{low, high, cells};
  const char* name = axis_names[axis];
  mistakes.require(std::isfinite(low) && std::isfinite(high) && low < high, "extent along ", name, " runs from ", low, " to ",
                   high, " m; the lower end must be below the upper one");
  mistakes.require(cells >= 1, cells_name, " = ", cells, "; at least 1 cell is needed");
  if (!has(symmetry_axes, axis) || low >= 0.0) return extent;
  mistakes.require(high > 0.0, "the symmetry plane ", name, " = 0 keeps nothing of a body from ", low, " to ", high,
                   " m; move the body to ", name, " >= 0 or drop the symmetry axis ", axis);
  if (high <= 0.0) return extent;
  mistakes.require(std::abs(low + high) <= 1e-9 * (high - low), "the body runs from ", low, " to ", high, " m along ", name,
                   ", so it is not symmetric about ", name, " = 0; make low = -high, or drop the symmetry axis ", axis);
  mistakes.require(cells % 2 == 0, cells_name, " = ", cells, " cannot be halved by the symmetry plane ", name,
                   " = 0; give an even number");
  extent.low = 0.0;
  extent.cells = std::max(1, cells / 2);
  extent.cut = true;
  return extent;
}

/// What symmetry planes through the axis of a round body leave of the full turn, in quarters.
struct Turn {
  int first_quarter = 0;  ///< quarters are counted from the first in-plane axis towards the second
  int quarters = 4;
};

Turn kept(Mistakes& mistakes, const Vec3& center, double radius, int axis, const std::vector<int>& symmetry_axes) {
  bool cut[2];
  for (int side = 0; side < 2; ++side) {
    const int across = (axis + 1 + side) % 3;
    const double c = center[across];
    cut[side] = has(symmetry_axes, across) && c < radius;
    mistakes.require(!cut[side] || c == 0.0, "the axis of the body lies at ", axis_names[across], " = ", c,
                     " m, so it is not symmetric about ", axis_names[across], " = 0; put the center there, or drop the ",
                     "symmetry axis ", across);
  }
  if (cut[0] && cut[1]) return {0, 1};
  if (cut[0]) return {3, 2};  // first in-plane coordinate >= 0: fourth and first quarter
  if (cut[1]) return {0, 2};
  return {0, 4};
}

/// Cosine and sine of a part of a quarter turn, exact at its ends.
std::array<double, 2> in_quarter(int i, int cells) {
  if (i == 0) return {1.0, 0.0};
  if (i == cells) return {0.0, 1.0};
  const double angle = 0.5 * std::numbers::pi * i / cells;
  return {std::cos(angle), std::sin(angle)};
}

/// A quarter-turn image, without round-off.
std::array<double, 2> turned(std::array<double, 2> p, int quarters) {
  for (int k = 0; k < ((quarters % 4) + 4) % 4; ++k) p = {-p[1], p[0]};
  return p;
}

Vec3 placed(const std::array<double, 2>& across, double along, int axis, const Vec3& center) {
  Vec3 x;
  x[axis] = along;
  x[(axis + 1) % 3] = center[(axis + 1) % 3] + across[0];
  x[(axis + 2) % 3] = center[(axis + 2) % 3] + across[1];
  return x;
}

void check_round(Mistakes& mistakes, int axis, const Vec3& center) {
  mistakes.require(axis >= 0 && axis <= 2, "axis ", axis, " does not exist; give 0, 1 or 2 (x, y, z)");
  mistakes.require(center.allFinite(), "the center is not finite; give three coordinates in metres");
}

/// Cells and faces of an n0 x n1 x n2 block whose vertex numbers come from `vertex`; faces[2 d + side] is the name of
/// that side, -1 for none.
template <class Vertex>
void add_block(Blocks& blocks, std::array<int, 3> n, const Vertex& vertex, const std::array<int, 6>& faces) {
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        std::array<unsigned, 8> cell;
        for (int v = 0; v < 8; ++v) cell[v] = vertex(i + (v & 1), j + (v >> 1 & 1), k + (v >> 2));
        blocks.cells.push_back(cell);
        const std::array<int, 3> at{i, j, k};
        for (int d = 0; d < 3; ++d)
          for (int side = 0; side < 2; ++side) {
            if (faces[2 * d + side] < 0 || at[d] != (side ? n[d] - 1 : 0)) continue;
            Blocks::Face face{{}, faces[2 * d + side]};
            int found = 0;
            for (int v = 0; v < 8; ++v)
              if ((v >> d & 1) == side) face.vertices[found++] = cell[v];
            blocks.faces.push_back(face);
          }
      }
}

void check_sizes(Mistakes& mistakes, const TubeMesh& mesh) {
  mistakes.require(mesh.inner_radius > 0.0, "inner radius = ", mesh.inner_radius,
                   " m; a tube needs a bore, use a rod for a solid bar");
  mistakes.require(mesh.outer_radius > mesh.inner_radius && std::isfinite(mesh.outer_radius),
                   "outer radius = ", mesh.outer_radius, " m must exceed the inner radius = ", mesh.inner_radius, " m");
  mistakes.require(mesh.cells_through >= 1, "cells_through = ", mesh.cells_through, "; at least 1 cell is needed");
}

void check_radius(Mistakes& mistakes, const RodMesh& mesh) {
  mistakes.require(mesh.radius > 0.0 && std::isfinite(mesh.radius), "radius = ", mesh.radius, " m must be positive");
}

/// A rectangle of a meridian, radially from `low` to `high` [m].
Blocks rectangle(double low, double high, int cells, const Extent& along, std::vector<std::string> names,
                 const std::array<int, 6>& faces) {
  Blocks blocks;
  blocks.names = std::move(names);
  for (int j = 0; j <= along.cells; ++j)
    for (int i = 0; i <= cells; ++i)
      blocks.vertices.emplace_back(i == cells ? high : low + (high - low) * i / cells, along.at(j), 0.0);
  const auto vertex = [&](int i, int j, int) { return static_cast<unsigned>(j * (cells + 1) + i); };
  add_block(blocks, {cells, along.cells, 1}, vertex, faces);
  return blocks;
}

/// A round body's meridian is that of the axis of revolution.
Extent kept_meridian(Mistakes& mistakes, const auto& mesh, const std::vector<int>& symmetry_axes) {
  mistakes.require(mesh.axis == 1 && mesh.center[0] == 0.0 && mesh.center[2] == 0.0,
                   "its axis is not the axis of revolution; move it there, or compute in 3D");
  for (const int axis : symmetry_axes)
    mistakes.require(axis == 1, "symmetry axis ", axis, " does not exist in a meridian; only that along the axis, 1, does");
  return kept(mistakes, mesh.low, mesh.high, mesh.cells_along, 1, symmetry_axes, "cells_along");
}

}  // namespace

Blocks build_blocks(const TubeMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who) {
  Mistakes mistakes(who);
  check_symmetry_axes(mistakes, symmetry_axes);
  check_round(mistakes, mesh.axis, mesh.center);
  mistakes.throw_if_any();
  check_sizes(mistakes, mesh);
  mistakes.require(mesh.cells_around >= 8 && mesh.cells_around % 4 == 0, "cells_around = ", mesh.cells_around,
                   "; give the cells of the full turn, a multiple of 4 and at least 8");
  const Extent along = kept(mistakes, mesh.low, mesh.high, mesh.cells_along, mesh.axis, symmetry_axes, "cells_along");
  const Turn turn = kept(mistakes, mesh.center, mesh.outer_radius, mesh.axis, symmetry_axes);
  mistakes.throw_if_any();

  Blocks blocks;
  blocks.names = {"inner", "outer", "high"};
  if (!along.cut) blocks.names.push_back("low");
  const int through = mesh.cells_through, quarter = mesh.cells_around / 4, around = quarter * turn.quarters;
  const int lines = turn.quarters == 4 ? around : around + 1;
  for (int k = 0; k <= along.cells; ++k)
    for (int j = 0; j < lines; ++j)
      for (int i = 0; i <= through; ++i) {
        const double r =
            i == through ? mesh.outer_radius : mesh.inner_radius + (mesh.outer_radius - mesh.inner_radius) * i / through;
        const auto [c, s] = in_quarter(j % quarter, quarter);
        blocks.vertices.push_back(
            placed(turned({r * c, r * s}, turn.first_quarter + j / quarter), along.at(k), mesh.axis, mesh.center));
      }
  const auto vertex = [&](int i, int j, int k) { return static_cast<unsigned>((k * lines + j % lines) * (through + 1) + i); };
  add_block(blocks, {through, around, along.cells}, vertex, {0, 1, -1, -1, along.cut ? -1 : 3, 2});
  return blocks;
}

Blocks build_blocks(const PlateMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who) {
  Mistakes mistakes(who);
  check_symmetry_axes(mistakes, symmetry_axes);
  std::array<Extent, 3> extent;
  for (int d = 0; d < 3; ++d)
    extent[d] = kept(mistakes, mesh.low[d], mesh.high[d], mesh.cells[d], d, symmetry_axes,
                     (std::string("cells along ") + axis_names[d]).c_str());
  mistakes.throw_if_any();

  Blocks blocks;
  std::array<int, 6> faces;
  for (int d = 0; d < 3; ++d)
    for (int side = 0; side < 2; ++side) {
      faces[2 * d + side] = -1;
      if (side == 0 && extent[d].cut) continue;
      faces[2 * d + side] = static_cast<int>(blocks.names.size());
      blocks.names.push_back(std::string(axis_names[d]) + (side ? "_high" : "_low"));
    }
  const std::array<int, 3> n{extent[0].cells, extent[1].cells, extent[2].cells};
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) blocks.vertices.emplace_back(extent[0].at(i), extent[1].at(j), extent[2].at(k));
  const auto vertex = [&](int i, int j, int k) { return static_cast<unsigned>((k * (n[1] + 1) + j) * (n[0] + 1) + i); };
  add_block(blocks, n, vertex, faces);
  return blocks;
}

// Each quarter of the section is a core block and two ring blocks. The core's outer corner lies at 45 degrees, its two
// outer sides bulge a little, so that no cell is far from square.
Blocks build_blocks(const RodMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who) {
  Mistakes mistakes(who);
  check_symmetry_axes(mistakes, symmetry_axes);
  check_round(mistakes, mesh.axis, mesh.center);
  mistakes.throw_if_any();
  check_radius(mistakes, mesh);
  mistakes.require(mesh.cells_radial >= 2, "cells_radial = ", mesh.cells_radial,
                   "; a rod needs at least 2 cells from its axis to its rim");
  const Extent along = kept(mistakes, mesh.low, mesh.high, mesh.cells_along, mesh.axis, symmetry_axes, "cells_along");
  const Turn turn = kept(mistakes, mesh.center, mesh.radius, mesh.axis, symmetry_axes);
  mistakes.throw_if_any();

  Blocks blocks;
  blocks.names = {"side", "high"};
  if (!along.cut) blocks.names.push_back("low");
  const int low = along.cut ? -1 : 2;
  const int core = (mesh.cells_radial + 1) / 2, ring = mesh.cells_radial - core;
  const double side = 0.55 * mesh.radius, corner = 0.43 * mesh.radius;
  using Point = std::array<double, 2>;
  const auto core_point = [&](int i, int j) {
    const double u = static_cast<double>(i) / core, v = static_cast<double>(j) / core;
    return Point{u * (side + v * (corner - side)), v * (side + u * (corner - side))};
  };
  // Ring line `step` of 2 core, counted from the first axis to the second.
  const auto ring_point = [&](int layer, int step) {
    const Point from = step <= core ? core_point(core, step) : core_point(2 * core - step, core);
    const auto [c, s] = in_quarter(step, 2 * core);
    const double t = static_cast<double>(layer) / ring;
    if (layer == ring) return Point{mesh.radius * c, mesh.radius * s};
    return Point{(1 - t) * from[0] + t * mesh.radius * c, (1 - t) * from[1] + t * mesh.radius * s};
  };

  // Vertices of neighbouring blocks are the same where they coincide.
  std::map<std::array<long long, 2>, unsigned> section;
  std::vector<Point> points;
  const auto number = [&](const Point& p) {
    const double unit = 1e-7 * mesh.radius;
    const auto [found, is_new] =
        section.try_emplace({std::llround(p[0] / unit), std::llround(p[1] / unit)}, static_cast<unsigned>(points.size()));
    if (is_new) points.push_back(p);
    return found->second;
  };
  std::vector<std::vector<unsigned>> cores, rings;
  for (int quarter = turn.first_quarter; quarter < turn.first_quarter + turn.quarters; ++quarter) {
    cores.emplace_back();
    for (int j = 0; j <= core; ++j)
      for (int i = 0; i <= core; ++i) cores.back().push_back(number(turned(core_point(i, j), quarter)));
    rings.emplace_back();
    for (int step = 0; step <= 2 * core; ++step)
      for (int layer = 0; layer <= ring; ++layer) rings.back().push_back(number(turned(ring_point(layer, step), quarter)));
  }
  const unsigned per_layer = static_cast<unsigned>(points.size());
  for (int k = 0; k <= along.cells; ++k)
    for (const Point& p : points) blocks.vertices.push_back(placed(p, along.at(k), mesh.axis, mesh.center));
  for (std::size_t quarter = 0; quarter < cores.size(); ++quarter) {
    add_block(blocks, {core, core, along.cells},
              [&](int i, int j, int k) { return k * per_layer + cores[quarter][j * (core + 1) + i]; }, {-1, -1, -1, -1, low, 1});
    add_block(blocks, {ring, 2 * core, along.cells},
              [&](int i, int j, int k) { return k * per_layer + rings[quarter][j * (ring + 1) + i]; }, {-1, 0, -1, -1, low, 1});
  }
  return blocks;
}

Blocks build_meridian(const TubeMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who) {
  Mistakes mistakes(who);
  check_sizes(mistakes, mesh);
  const Extent along = kept_meridian(mistakes, mesh, symmetry_axes);
  mistakes.throw_if_any();
  std::vector<std::string> names{"inner", "outer", "high"};
  if (!along.cut) names.push_back("low");
  return rectangle(mesh.inner_radius, mesh.outer_radius, mesh.cells_through, along, names, {0, 1, along.cut ? -1 : 3, 2, -1, -1});
}

Blocks build_meridian(const RodMesh& mesh, const std::vector<int>& symmetry_axes, const std::string& who) {
  Mistakes mistakes(who);
  check_radius(mistakes, mesh);
  mistakes.require(mesh.cells_radial >= 1, "cells_radial = ", mesh.cells_radial, "; at least 1 cell is needed");
  const Extent along = kept_meridian(mistakes, mesh, symmetry_axes);
  mistakes.throw_if_any();
  std::vector<std::string> names{"side", "high"};
  if (!along.cut) names.push_back("low");
  return rectangle(0.0, mesh.radius, mesh.cells_radial, along, names, {-1, 0, along.cut ? -1 : 2, 1, -1, -1});
}

Blocks build_meridian(const PlateMesh&, const std::vector<int>&, const std::string& who) {
  throw std::invalid_argument(who +
                              ": a plate is a box, which is not of revolution; take a rod (a disc is a short one), or "
                              "compute in 3D");
}

}  // namespace undex::fem
