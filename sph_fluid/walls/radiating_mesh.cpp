#include "sph_fluid/walls/radiating_mesh.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

#include "core/constants.hpp"
#include "core/surface.hpp"

namespace undex::sph {
namespace {

using Place = std::array<long, 3>;
using Direction = std::function<Vec3(const Vec3&)>;

/// Places that differ by round-off are one node.
Place rounded(const Vec3& x, double spacing) {
  Place place{};
  for (int a = 0; a < 3; ++a) place[a] = std::lround(x[a] / spacing * 1e5);
  return place;
}

class Mesher {
 public:
  Mesher(const Settings& settings, const Wall& wall) : settings_(settings), wall_(wall), dx_(settings.lattice.spacing) {}

  void mesh(std::vector<RadiatingMesh>& faces) {
    for (const auto& [face, condition] : wall_.faces) {
      if (condition != FaceCondition::radiating) continue;
      if (const std::string why = why_not_radiating(wall_.container, settings_.dimension); !why.empty())
        throw std::invalid_argument("wall '" + wall_.name + "': " + why);
      mesh_ = {.name = "the face '" + face + "' of wall '" + wall_.name + "'", .source = wall_.source, .wall = {}, .normal = {}};
      nodes_.clear();
      if (const auto* box = std::get_if<Box>(&wall_.container)) of_box(*box, face);
      else if (const auto* cylinder = std::get_if<Cylinder>(&wall_.container)) of_cylinder(*cylinder, face);
      else of_sphere(std::get<Sphere>(wall_.container));
      if (mesh_.wall.faces.empty()) continue;  // beyond a symmetry plane
      mesh_.wall.velocity.assign(mesh_.wall.position.size(), Vec3::Zero());
      mesh_.wall.impulse = mesh_.wall.velocity;
      mesh_.wall.pressure.assign(mesh_.wall.position.size() * seen_depths, 0.0);
      faces.push_back(std::move(mesh_));
    }
  }

 private:
  /// Cells of about `width` spacings on a length, a multiple of `of`.
  int cells(double length, double width = 2.0, int of = 1) const {
    return of * std::max(1, int(std::ceil(length / (width * dx_ * of) - 1e-9)));
  }

  int node(const Vec3& x, const Direction& outward) {
    const auto [place, added] = nodes_.try_emplace(rounded(x, dx_), int(mesh_.wall.position.size()));
    if (added) {
      mesh_.wall.position.push_back(x);
      mesh_.normal.push_back(outward(x));
    }
    return place->second;
  }

  bool is_kept(const Vec3& x) const {
    for (int a = 0; a < 3; ++a)
      if (settings_.symmetry.axis[a] && x[a] < 0.0) return false;
    return true;
  }

  /// Cells of the surface place(u, v), u and v in [0, 1]; in fewer than three dimensions of the line place(u, 0).
  template <class At>
  void block(int along_u, int along_v, const Direction& outward, At place) {
    const double du = 1.0 / along_u, dv = 1.0 / along_v;
    const bool line = settings_.dimension < 3;
    for (int j = 0; j < (line ? 1 : along_v); ++j)
      for (int i = 0; i < along_u; ++i) {
        const Vec3 a = place(i * du, j * dv), b = place((i + 1) * du, j * dv);
        if (line) {
          if (is_kept(0.5 * (a + b))) segment(a, b, outward);
          continue;
        }
        const Vec3 c = place((i + 1) * du, (j + 1) * dv), d = place(i * du, (j + 1) * dv);
        const Vec3 middle = 0.25 * (a + b + c + d);
        if (!is_kept(middle)) continue;
        const bool turned = (b - a).cross(d - a).dot(outward(middle)) < 0.0;
        const int n[] = {node(a, outward), node(b, outward), node(c, outward), node(d, outward)};
        if (turned) mesh_.wall.faces.push_back({n[0], n[3], n[2], n[1]});
        else mesh_.wall.faces.push_back({n[0], n[1], n[2], n[3]});
      }
  }
  void segment(const Vec3& a, const Vec3& b, const Direction& outward) {
    const bool turned = (b - a).cross(Vec3::UnitZ()).dot(outward(0.5 * (a + b))) < 0.0;
    const int n = node(turned ? b : a, outward), m = node(turned ? a : b, outward);
    mesh_.wall.faces.push_back({n, m, m, n});
  }

  void of_box(const Box& box, const std::string& face) {
    const int axis = face[0] - 'x', dimension = settings_.dimension;
    const bool high = face.ends_with("_high");
    if (axis >= dimension) return;
    if (!high && settings_.symmetry.axis[axis] && box.low[axis] <= 0.0) return;
    Vec3 low = box.low, length = box.high - box.low;
    for (int a = 0; a < dimension; ++a)
      if (settings_.symmetry.axis[a] && low[a] < 0.0) {
        low[a] = 0.0;
        length[a] = box.high[a];
      }
    const Vec3 normal = (high ? 1.0 : -1.0) * Vec3::Unit(axis);
    low[axis] = high ? box.high[axis] : box.low[axis];
    const int u = axis == 0 ? 1 : 0, v = 3 - axis - u;
    if (dimension == 1) {  // a metre across, in whose middle the line ends
      low[1] = -0.5, low[2] = 0.0, length[1] = 1.0;
    } else if (dimension == 2) {
      low[2] = 0.0;
    }
    block(
        dimension == 1 ? 1 : cells(length[u]), dimension < 3 ? 1 : cells(length[v]), [=](const Vec3&) { return normal; },
        [&](double s, double t) {
          Vec3 x = low;
          x[u] += s * length[u];
          if (dimension == 3) x[v] += t * length[v];
          return x;
        });
  }

  void of_cylinder(const Cylinder& cylinder, const std::string& face) {
    const int axis = cylinder.axis, a = (axis + 1) % 3, b = (axis + 2) % 3;
    const bool flat = settings_.dimension == 2;
    double low = cylinder.low;
    if (!flat && settings_.symmetry.axis[axis] && low < 0.0) low = 0.0;
    const int quarter = cells(0.5 * pi * cylinder.radius, 2.5, 2);
    const auto at = [&](double away, double angle, double along) {
      Vec3 x = cylinder.center;
      x[axis] = flat ? 0.0 : along;
      x[a] += away * std::cos(angle);
      x[b] += away * std::sin(angle);
      return x;
    };
    if (face == "side") {
      const Direction outward = [=](const Vec3& x) {
        Vec3 away = x - cylinder.center;
        away[axis] = 0.0;
        return Vec3(away.normalized());
      };
      return block(4 * quarter, flat ? 1 : cells(cylinder.high - low), outward,
                   [&](double u, double v) { return at(cylinder.radius, 2.0 * pi * u, low + v * (cylinder.high - low)); });
    }
    const bool high = face == "high";
    if (!high && settings_.symmetry.axis[axis] && cylinder.low <= 0.0) return;
    const Vec3 normal = (high ? 1.0 : -1.0) * Vec3::Unit(axis);
    const Direction outward = [=](const Vec3&) { return normal; };
    const double along = high ? cylinder.high : cylinder.low, half = 0.4 * cylinder.radius;
    // A square, and about it four blocks out to the rim.
    block(quarter, quarter, outward, [&](double u, double v) {
      Vec3 x = at(0.0, 0.0, along);
      x[a] += half * (2.0 * u - 1.0);
      x[b] += half * (2.0 * v - 1.0);
      return x;
    });
    for (int k = 0; k < 4; ++k)
      block(quarter, cells(0.5 * cylinder.radius), outward, [&](double u, double v) {
        const double angle = 0.5 * pi * (k + u - 0.5), turn = 0.5 * pi * k;
        const Vec3 rim = at(cylinder.radius, angle, along);
        Vec3 square = at(half, turn, along);
        square[a] -= half * (2.0 * u - 1.0) * std::sin(turn);
        square[b] += half * (2.0 * u - 1.0) * std::cos(turn);
        return Vec3((1.0 - v) * square + v * rim);
      });
  }

  void of_sphere(const Sphere& sphere) {
    const Direction outward = [=](const Vec3& x) { return Vec3((x - sphere.center).normalized()); };
    if (settings_.dimension == 2)
      return block(4 * cells(0.5 * pi * sphere.radius), 1, outward, [&](double u, double) {
        return Vec3(sphere.center + sphere.radius * Vec3(std::sin(2.0 * pi * u), -std::cos(2.0 * pi * u), 0.0));
      });
    // The six faces of a cube, at equal angles.
    const int n = cells(0.5 * pi * sphere.radius, 2.0, 2);
    for (int k = 0; k < 6; ++k)
      block(n, n, outward, [&](double u, double v) {
        Vec3 away;
        away[k % 3] = k < 3 ? 1.0 : -1.0;
        away[(k + 1) % 3] = std::tan(0.25 * pi * (2.0 * u - 1.0));
        away[(k + 2) % 3] = std::tan(0.25 * pi * (2.0 * v - 1.0));
        return Vec3(sphere.center + sphere.radius * away.normalized());
      });
  }

  const Settings& settings_;
  const Wall& wall_;
  double dx_;
  RadiatingMesh mesh_;
  std::map<Place, int> nodes_;
};

std::vector<SharedNode> shared_nodes(const std::vector<RadiatingMesh>& faces, double spacing) {
  std::map<Place, SharedNode> all;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t n = 0; n < faces[f].wall.position.size(); ++n)
      all[rounded(faces[f].wall.position[n], spacing)].places.push_back({int(f), int(n)});
  std::vector<SharedNode> shared;
  for (auto& [place, node] : all)
    if (node.places.size() > 1) shared.push_back(std::move(node));
  return shared;
}

}  // namespace

std::string why_not_radiating(const Primitive& container, int dimension) {
  const auto* cylinder = std::get_if<Cylinder>(&container);
  const bool section = dimension == 2 && cylinder && cylinder->axis == 2;
  if (std::holds_alternative<Box>(container) || (dimension > 1 && std::holds_alternative<Sphere>(container)) ||
      (cylinder && (dimension == 3 || section)))
    return {};
  return std::string("faces of a ") + std::visit([](const auto& shape) { return shape.name; }, container) + " do not radiate" +
         (cylinder ? " in this dimension" : "") + "; take a box" + (dimension == 3 ? ", a cylinder or a sphere" : "");
}

RadiatingMeshes radiating_meshes(const Settings& settings) {
  RadiatingMeshes meshes;
  for (const Wall& wall : settings.walls) Mesher(settings, wall).mesh(meshes.faces);
  meshes.shared = shared_nodes(meshes.faces, settings.lattice.spacing);
  return meshes;
}

}  // namespace undex::sph
