// By CGAL: its reader of STL, its tree of triangles, its test of sides, its search for crossings. Numbers are doubles; what
// decides on which side a place lies is computed exactly.
#include "core/triangle_surface.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace undex {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;
using Triangle = std::array<std::size_t, 3>;

constexpr std::size_t most_triangles = 5'000'000, most_bytes = std::size_t{2} << 30;
constexpr double farthest = 1e5;  // [m]

Vec3 vector(const Point& p) { return {p.x(), p.y(), p.z()}; }

std::string words(const Vec3& x) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
  return text;
}

struct Soup {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
};

[[noreturn]] void refuse(const std::string& path, const std::string& why) { throw std::invalid_argument(path + ": " + why); }

/// Does the text have the length of a binary file with the count that it names?
bool is_binary(std::string_view text, std::size_t& count) {
  constexpr std::size_t head = 84, record = 50;
  if (text.size() < head) return false;
  std::uint32_t named = 0;
  std::memcpy(&named, text.data() + 80, sizeof named);
  count = named;
  return text.size() - head == count * record;
}

Soup soup_of(std::string_view text, const std::string& path, double scale) {
  std::size_t count = 0;
  const bool binary = is_binary(text, count);
  if (!binary && text.substr(0, 5) != "solid")
    refuse(path, text.size() < 84
                     ? "it is no STL file: it begins with no 'solid', and is too short for a binary one; check the file"
                     : "it is no STL file, or cut off: it begins with no 'solid', and as a binary one with its " +
                           std::to_string(count) + " triangles it would have " + std::to_string(84 + 50 * count) +
                           " bytes, not " + std::to_string(text.size()) + "; write it again");
  if (!binary && text.find("endsolid") == std::string_view::npos)
    refuse(path, "it is cut off: there is no 'endsolid'; write it again");
  if (binary && count > most_triangles)
    refuse(path, "it has " + std::to_string(count) + " triangles, more than " + std::to_string(most_triangles) + "; coarsen it");
  Soup soup;
  std::istringstream stream{std::string(text)};
  std::vector<std::array<std::size_t, 3>> triangles;
  const bool good = binary ? CGAL::IO::internal::parse_binary_STL(stream, soup.points, triangles, false)
                           : CGAL::IO::internal::parse_ASCII_STL(stream, soup.points, triangles, false);
  if (!good) refuse(path, "it cannot be read as STL; write it again, e.g. as binary STL");
  if (triangles.empty()) refuse(path, "it has no triangles");
  if (triangles.size() > most_triangles)
    refuse(path, "it has more than " + std::to_string(most_triangles) + " triangles; coarsen it");
  soup.triangles = std::move(triangles);
  for (Point& p : soup.points) {
    const Vec3 x = scale * vector(p);
    for (const double each : x)
      if (!(std::abs(each) <= farthest))
        refuse(path, "a corner at " + words(x) + " is no place within 1e5 m; mend the file, or mind `scale`");
    p = Point(x[0], x[1], x[2]);
  }
  pmp::merge_duplicate_points_in_polygon_soup(soup.points, soup.triangles);
  return soup;
}

void check_triangles(const Soup& soup, const std::string& path) {
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Triangle& corner = soup.triangles[t];
    const Point &a = soup.points[corner[0]], &b = soup.points[corner[1]], &c = soup.points[corner[2]];
    if (CGAL::collinear(a, b, c))
      refuse(path, "triangle " + std::to_string(t + 1) + " is flat: its corners lie on one line, at " + words(vector(a)) +
                       "; remove flat triangles (clean the mesh)");
  }
}

/// Each edge has two triangles, which run along it in opposite ways.
void check_edges(const Soup& soup, const std::string& path) {
  std::map<std::pair<std::size_t, std::size_t>, std::array<int, 2>> edges;
  for (const Triangle& corner : soup.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = corner[k], to = corner[(k + 1) % 3];
      ++edges[std::minmax(from, to)][from < to ? 0 : 1];
    }
  std::size_t open = 0;
  std::pair<std::size_t, std::size_t> first{};
  for (const auto& [edge, ways] : edges) {
    const auto place = [&, &edge = edge] {
      return words(vector(soup.points[edge.first])) + " to " + words(vector(soup.points[edge.second]));
    };
    if (ways[0] + ways[1] > 2)
      refuse(path, "the edge from " + place() + " has " + std::to_string(ways[0] + ways[1]) +
                       " triangles, where a surface has two: parts of it touch or lie on each other; part or join them");
    if (ways[0] + ways[1] == 1 && open++ == 0) first = edge;
  }
  if (open > 0)
    refuse(path, "the surface is open: " + std::to_string(open) + " edges have one triangle only, the first from " +
                     words(vector(soup.points[first.first])) + " to " + words(vector(soup.points[first.second])) +
                     "; close the holes");
  for (const auto& [edge, ways] : edges)
    if (ways[0] != ways[1])
      refuse(path, "triangles at the edge from " + words(vector(soup.points[edge.first])) + " to " +
                       words(vector(soup.points[edge.second])) +
                       " are turned against each other; let all corners run counterclockwise seen from outside");
}

using Corners = std::vector<Vec3>;

/// The part of a polygon where side (x[axis] - at) <= 0.
Corners below(const Corners& polygon, int axis, double at, double side) {
  Corners kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double here = side * (from[axis] - at), there = side * (to[axis] - at);
    if (here <= 0) kept.push_back(from);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      kept.push_back(from + here / (here - there) * (to - from));
      kept.back()[axis] = at;
    }
  }
  return kept;
}

/// Volume between a polygon and its projection on z = 0, negative where it runs clockwise; heights count up to `top`.
double prism(const Corners& polygon, double top) {
  double sum = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 &a = polygon[0], &b = polygon[k - 1], &c = polygon[k];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    sum += area * (std::min(a[2], top) + std::min(b[2], top) + std::min(c[2], top)) / 3.0;
  }
  return sum;
}

}  // namespace

struct TriangleSurface::Implementation {
  Mesh mesh;
  Tree tree;
  std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel, CGAL::Default, Tree>> side;
  Bounds box;
  double volume = 0;
  Vec3 centroid = Vec3::Zero();
  Mat3 second = Mat3::Zero();

  /// Integrals over the tetrahedra that the triangles make with the middle of the box.
  void integrate() {
    const Vec3 origin = 0.5 * (box.low + box.high);
    Vec3 first = Vec3::Zero();
    for (const auto face : mesh.faces()) {
      std::array<Vec3, 3> x;
      std::size_t k = 0;
      for (const auto vertex : CGAL::vertices_around_face(mesh.halfedge(face), mesh))
        x[k++] = vector(mesh.point(vertex)) - origin;
      const double part = x[0].dot(x[1].cross(x[2])) / 6.0;
      const Vec3 sum = x[0] + x[1] + x[2];
      volume += part;
      first += part * sum / 4.0;
      second += part / 20.0 * (sum * sum.transpose());
      for (const Vec3& corner : x) second += part / 20.0 * (corner * corner.transpose());
    }
    const Vec3 middle = first / volume;
    second -= volume * middle * middle.transpose();
    centroid = origin + middle;
  }
};

TriangleSurface::TriangleSurface(std::unique_ptr<Implementation> self) : self_(std::move(self)) {}
TriangleSurface::~TriangleSurface() = default;

std::shared_ptr<const TriangleSurface> TriangleSurface::parse(std::string_view text, const std::string& path, double scale) {
  Soup soup = soup_of(text, path, scale);
  check_triangles(soup, path);
  check_edges(soup, path);
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.triangles))
    refuse(path, "parts of the surface meet in a corner only; part or join them");
  auto self = std::make_unique<Implementation>();
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, self->mesh);
  for (const Point& p : soup.points) self->box.include(vector(p));
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> crossings;
  pmp::self_intersections(self->mesh, std::back_inserter(crossings));
  if (!crossings.empty()) {
    Vec3 middle = Vec3::Zero();
    for (const auto vertex : CGAL::vertices_around_face(self->mesh.halfedge(crossings[0].first), self->mesh))
      middle += vector(self->mesh.point(vertex)) / 3.0;
    refuse(path, "the surface crosses itself at " + std::to_string(crossings.size()) + " pairs of triangles, the first near " +
                     words(middle) + "; mend it, or join the parts");
  }
  self->integrate();
  if (!(self->volume > 0))
    refuse(path, "the surface is turned inside out: it encloses " + std::to_string(self->volume) +
                     " m^3; let the corners of its triangles run counterclockwise seen from outside");
  if (!pmp::does_bound_a_volume(self->mesh))
    refuse(path, "a part of the surface is turned inside out, or lies within another that is turned the same way; turn it round");
  self->tree.insert(CGAL::faces(self->mesh).first, CGAL::faces(self->mesh).second, self->mesh);
  self->tree.build();
  self->tree.accelerate_distance_queries();
  self->side = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel, CGAL::Default, Tree>>(self->tree);
  return std::shared_ptr<const TriangleSurface>(new TriangleSurface(std::move(self)));
}

std::shared_ptr<const TriangleSurface> TriangleSurface::read(const std::string& path, double scale) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) refuse(path, "it cannot be read; check that you may read it");
  const auto size = file.tellg();
  if (size < 0 || std::size_t(size) > most_bytes) refuse(path, "it has more than 2 GB; coarsen the surface");
  std::string text(std::size_t(size), '\0');
  file.seekg(0);
  if (!file.read(text.data(), size)) refuse(path, "it cannot be read to its end; check the file");
  return parse(text, path, scale);
}

double TriangleSurface::signed_distance(const Vec3& x, double beyond) const {
  const Bounds& box = self_->box;
  const Vec3 nearest_in_box = x.cwiseMax(box.low).cwiseMin(box.high);
  if ((x - nearest_in_box).norm() >= beyond) return beyond;
  const Point place(x[0], x[1], x[2]);
  const bool far = std::isfinite(beyond) && !self_->tree.do_intersect(Kernel::Sphere_3(place, beyond * beyond));
  const double distance = far ? beyond : std::min(beyond, std::sqrt(self_->tree.squared_distance(place)));
  if (!box.holds(x, 0.0)) return distance;
  return (*self_->side)(place) == CGAL::ON_BOUNDED_SIDE ? -distance : distance;
}

const Bounds& TriangleSurface::bounds() const { return self_->box; }

double TriangleSurface::reach(const Vec3& direction) const {
  double most = -1e300;
  for (const auto vertex : self_->mesh.vertices()) most = std::max(most, vector(self_->mesh.point(vertex)).dot(direction));
  return most;
}

double TriangleSurface::volume() const { return self_->volume; }

/// Beneath each triangle stands a prism along z; those of triangles that look down count negative, and what is left is the body.
double TriangleSurface::volume(const Bounds& window) const {
  const Vec3 low = window.low.cwiseMax(self_->box.low), high = window.high.cwiseMin(self_->box.high), size = high - low;
  if (!(size.minCoeff() > 0)) return 0;
  double sum = 0;
  for (const auto face : self_->mesh.faces()) {
    Corners corners;
    for (const auto vertex : CGAL::vertices_around_face(self_->mesh.halfedge(face), self_->mesh))
      corners.push_back(vector(self_->mesh.point(vertex)) - low);
    for (const int a : {0, 1}) corners = below(below(corners, a, size[a], 1.0), a, 0.0, -1.0);
    corners = below(corners, 2, 0.0, -1.0);  // beneath the window there is nothing
    const bool rises = std::any_of(corners.begin(), corners.end(), [&](const Vec3& x) { return x[2] > size[2]; });
    sum += prism(below(corners, 2, size[2], 1.0), size[2]);
    if (rises) sum += prism(below(corners, 2, size[2], -1.0), size[2]);
  }
  return sum;
}

const Vec3& TriangleSurface::centroid() const { return self_->centroid; }
const Mat3& TriangleSurface::second_moment() const { return self_->second; }
std::size_t TriangleSurface::triangle_count() const { return self_->mesh.number_of_faces(); }

}  // namespace undex
