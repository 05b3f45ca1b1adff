#include "sph_fluid/walls/sheets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "core/surface.hpp"

namespace undex::sph {
namespace {

constexpr double smooth = 0.3;  // cosine of the largest turn within a sheet

Vec3 area_vector(const std::array<int, 4>& face, std::span<const Vec3> position) {
  const std::array<Vec3, 4> x = corners_of(face, position);
  return 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
}

Vec3 middle(const std::array<int, 4>& face, std::span<const Vec3> position) {
  return 0.25 * (position[face[0]] + position[face[1]] + position[face[2]] + position[face[3]]);
}

/// Faces in sets that are joined two by two.
class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace

Sheets::Sheets(std::span<const std::array<int, 4>> faces, std::span<const Vec3> position, const Ends& ends) {
  struct Side {
    int face, edge;
  };
  std::map<std::pair<int, int>, std::vector<Side>> edges;
  for (int f = 0; f < int(faces.size()); ++f)
    for (int e = 0; e < 4; ++e) {
      if (is_segment(faces[f]) && e % 2 == 0) continue;
      const auto [a, b] = std::minmax(faces[f][e], faces[f][(e + 1) % 4]);
      edges[{a, b}].push_back({f, e});
    }
  const auto lies_in_plane = [&](int node, int axis) {
    return ends.symmetry[axis] && std::abs(position[node][axis]) <= ends.tolerance;
  };

  Union joined(faces.size());
  open_.assign(faces.size(), 0u);
  sharp_.assign(faces.size(), 0u);
  goes_on_.assign(faces.size(), 0u);
  std::vector<bool> parted(position.size(), false);
  for (const auto& [nodes, sides] : edges) {
    const bool goes_on = ends.radiating.hold(position[nodes.first], position[nodes.second], ends.tolerance);
    bool held = goes_on || ends.fixed.hold(position[nodes.first], position[nodes.second], ends.tolerance);
    for (int a = 0; a < 3; ++a) held = held || (lies_in_plane(nodes.first, a) && lies_in_plane(nodes.second, a));
    if (sides.size() == 1) {
      if (!held) open_[sides[0].face] |= 1u << sides[0].edge;
      if (goes_on) goes_on_[sides[0].face] |= 1u << sides[0].edge;
      continue;
    }
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const int f = sides[0].face, g = sides[k].face;
      const Vec3 n = area_vector(faces[f], position).normalized();
      if (n.dot(area_vector(faces[g], position).normalized()) > smooth) {
        joined.join(f, g);
        continue;
      }
      parted[nodes.first] = parted[nodes.second] = true;
      if (n.dot(middle(faces[g], position) - middle(faces[f], position)) <= 0.0 && sides.size() == 2) continue;
      for (const Side& side : {sides[0], sides[k]}) {
        open_[side.face] |= 1u << side.edge;
        sharp_[side.face] |= 1u << side.edge;
      }
    }
  }
  std::map<int, int> number;
  for (int f = 0; f < int(faces.size()); ++f)
    sheet_.push_back(number.try_emplace(joined.root(f), int(number.size())).first->second);
  count_ = int(number.size());

  std::vector<std::vector<int>> at_node(position.size());
  for (int f = 0; f < int(faces.size()); ++f)
    for (const int n : faces[f])
      if (parted[n] && (at_node[n].empty() || at_node[n].back() != f)) at_node[n].push_back(f);
  for (int f = 0; f < int(faces.size()); ++f)
    for (int c = 0; c < 4; ++c) {
      const int node = faces[f][c];
      if (!parted[node]) continue;
      Corner corner{.face = f, .corner = c, .mates = {}, .kept = {}};
      for (const int g : at_node[node])
        if (sheet_[g] == sheet_[f]) corner.mates.push_back(g);
      for (int a = 0; a < 3; ++a) corner.kept[a] = lies_in_plane(node, a);
      corners_.push_back(corner);
    }
}

void Sheets::part_normals(int face, std::span<const std::array<int, 4>> faces, std::span<const Vec3> position,
                          std::array<Vec3, 4>& normal) const {
  auto at = std::lower_bound(corners_.begin(), corners_.end(), face, [](const Corner& a, int f) { return a.face < f; });
  for (; at != corners_.end() && at->face == face; ++at) {
    Vec3 sum = Vec3::Zero();
    for (const int g : at->mates) sum += area_vector(faces[g], position);
    for (int a = 0; a < 3; ++a)
      if (at->kept[a]) sum[a] = 0.0;
    normal[at->corner] = sum.normalized();
  }
}

}  // namespace undex::sph
