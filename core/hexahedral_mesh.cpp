#include "core/hexahedral_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/surface.hpp"

namespace undex {
namespace {

Vec3 middle_of(const auto& corners) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : corners) sum += x;
  return sum / double(corners.size());
}

/// Boxes in a binary tree, halved at the median of their middles.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Bounds> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!order_.empty()) build(0, order_.size());
  }

  /// The least of distance(item), which is never less than that to the item's box, if it is less than `least`.
  template <class Distance>
  double nearest(const Vec3& x, double least, Distance distance) const {
    if (!tree_.empty()) search(0, x, least, distance);
    return least;
  }
  /// Does test(item) hold for one whose box contains x?
  template <class Test>
  bool any_at(const Vec3& x, Test test) const {
    return !tree_.empty() && find(0, x, test);
  }

 private:
  struct Branch {
    Bounds box;
    std::size_t first, last;
    std::size_t low = 0, high = 0;  // children; none where both are 0
  };

  std::size_t build(std::size_t first, std::size_t last) {
    Branch branch{{}, first, last};
    for (std::size_t i = first; i < last; ++i) {
      branch.box.include(boxes_[order_[i]].low);
      branch.box.include(boxes_[order_[i]].high);
    }
    const std::size_t at = tree_.size();
    tree_.push_back(branch);
    if (last - first <= 4) return at;
    Eigen::Index axis = 0;
    (branch.box.high - branch.box.low).maxCoeff(&axis);
    const std::size_t half = (first + last) / 2;
    const auto place = [&](std::size_t i) { return boxes_[i].low[axis] + boxes_[i].high[axis]; };
    std::nth_element(order_.begin() + long(first), order_.begin() + long(half), order_.begin() + long(last),
                     [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    const std::size_t low = build(first, half), high = build(half, last);
    tree_[at].low = low;
    tree_[at].high = high;
    return at;
  }

  static double distance_to(const Bounds& box, const Vec3& x) { return (x - x.cwiseMax(box.low).cwiseMin(box.high)).norm(); }

  template <class Distance>
  void search(std::size_t at, const Vec3& x, double& least, Distance& distance) const {
    const Branch& branch = tree_[at];
    if (distance_to(branch.box, x) >= least) return;
    if (branch.high == 0) {
      for (std::size_t i = branch.first; i < branch.last; ++i)
        if (distance_to(boxes_[order_[i]], x) < least) least = std::min(least, distance(order_[i]));
      return;
    }
    const bool low_first = distance_to(tree_[branch.low].box, x) <= distance_to(tree_[branch.high].box, x);
    search(low_first ? branch.low : branch.high, x, least, distance);
    search(low_first ? branch.high : branch.low, x, least, distance);
  }

  template <class Test>
  bool find(std::size_t at, const Vec3& x, Test& test) const {
    const Branch& branch = tree_[at];
    if (distance_to(branch.box, x) > 0) return false;
    if (branch.high != 0) return find(branch.low, x, test) || find(branch.high, x, test);
    for (std::size_t i = branch.first; i < branch.last; ++i)
      if (distance_to(boxes_[order_[i]], x) <= 0 && test(order_[i])) return true;
    return false;
  }

  std::vector<Bounds> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Branch> tree_;
};

/// Is x in the tetrahedron, either way round?
bool in_tetrahedron(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double whole = (b - a).cross(c - a).dot(d - a);
  const double parts[4] = {(b - x).cross(c - x).dot(d - x), (x - a).cross(c - a).dot(d - a), (b - a).cross(x - a).dot(d - a),
                           (b - a).cross(c - a).dot(x - a)};
  return std::all_of(parts, parts + 4, [&](double part) { return part / whole >= -1e-12; });
}

/// Faces with the cells that have them, the nodes in order.
std::map<std::array<int, 4>, std::vector<int>> cells_of_faces(const HexahedralMesh& mesh) {
  std::map<std::array<int, 4>, std::vector<int>> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    for (const auto& face : hexahedron_faces) {
      std::array<int, 4> key;
      for (int v = 0; v < 4; ++v) key[v] = mesh.cells[c][face[v]];
      std::sort(key.begin(), key.end());
      cells[key].push_back(int(c));
    }
  return cells;
}

}  // namespace

std::array<Vec3, 8> corners_of(const std::array<int, 8>& cell, std::span<const Vec3> position) {
  std::array<Vec3, 8> corner;
  for (int i = 0; i < 8; ++i) corner[i] = position[cell[i]];
  if (is_quadrangle(cell))
    for (int i = 0; i < 8; ++i) corner[i][2] += i < 4 ? -0.5 : 0.5;
  return corner;
}

std::array<double, 8> corner_volumes(const std::vector<Vec3>& nodes, const std::array<int, 8>& cell) {
  constexpr int corners[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                 {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
  const std::array<Vec3, 8> at = corners_of(cell, nodes);
  std::array<double, 8> volume;
  for (int i = 0; i < 8; ++i) {
    const Vec3& x = at[corners[i][0]];
    volume[i] = (at[corners[i][1]] - x).cross(at[corners[i][2]] - x).dot(at[corners[i][3]] - x);
  }
  return volume;
}

Bounds bounds(const HexahedralMesh& mesh) {
  Bounds box;
  for (const Vec3& x : mesh.nodes) box.include(x);
  return box;
}

std::vector<HexahedralMesh::Face> outer_faces(const HexahedralMesh& mesh) {
  const auto cells = cells_of_faces(mesh);
  std::vector<HexahedralMesh::Face> outer;
  for (const auto& cell : mesh.cells)
    for (const auto& face : hexahedron_faces) {
      const std::array<int, 4> round{cell[face[0]], cell[face[1]], cell[face[2]], cell[face[3]]};
      std::array<int, 4> key = round;
      std::sort(key.begin(), key.end());
      if (cells.at(key).size() == 1) outer.push_back({round, 0});
    }
  return outer;
}

std::vector<int> pieces(const HexahedralMesh& mesh, JoinedBy by) {
  std::vector<int> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  const auto join = [&](int a, int b) { parent[root(std::max(a, b))] = root(std::min(a, b)); };
  if (by == JoinedBy::faces) {
    for (const auto& [face, cells] : cells_of_faces(mesh))
      for (const int cell : cells) join(cell, cells.front());
  } else {
    std::vector<int> first(mesh.nodes.size(), -1);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (const int node : mesh.cells[c]) {
        if (first[node] < 0) first[node] = int(c);
        join(int(c), first[node]);
      }
  }
  if (!mesh.ties.empty()) {
    std::vector<int> cell_of(mesh.nodes.size(), -1);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (const int node : mesh.cells[c]) cell_of[node] = int(c);
    for (const HexahedralMesh::Tie& tie : mesh.ties) join(cell_of[tie.node], cell_of[tie.to.front().first]);
  }
  std::vector<int> number(mesh.cells.size(), -1), piece;
  int count = 0;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    int& mine = number[root(int(c))];
    if (mine < 0) mine = count++;
    piece.push_back(mine);
  }
  return piece;
}

double distance_to_triangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ax = x - a;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0 && d2 <= 0) return ax.norm();
  const Vec3 bx = x - b;
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0 && d4 <= d3) return bx.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (x - (a + d1 / (d1 - d3) * ab)).norm();
  const Vec3 cx = x - c;
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0 && d5 <= d6) return cx.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (x - (a + d2 / (d2 - d6) * ac)).norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (x - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b))).norm();
  const double sum = va + vb + vc;
  return (x - (a + vb / sum * ab + vc / sum * ac)).norm();
}

struct MeshDistance::Trees {
  BoxTree faces, cells;
};

namespace {

template <class Items, class Nodes>
std::vector<Bounds> boxes_of(const std::vector<Vec3>& nodes, const Items& items, const Nodes& nodes_of) {
  std::vector<Bounds> boxes(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    for (const int node : nodes_of(items[i])) boxes[i].include(nodes[node]);
  return boxes;
}

}  // namespace

MeshDistance::MeshDistance(std::shared_ptr<const HexahedralMesh> mesh) : mesh_(std::move(mesh)) {
  const auto of_face = [](const HexahedralMesh::Face& face) -> const auto& { return face.nodes; };
  const auto of_cell = [](const std::array<int, 8>& cell) -> const auto& { return cell; };
  trees_.reset(new Trees{.faces = BoxTree(boxes_of(mesh_->nodes, mesh_->faces, of_face)),
                         .cells = BoxTree(boxes_of(mesh_->nodes, mesh_->cells, of_cell))});
}
MeshDistance::~MeshDistance() = default;
MeshDistance::MeshDistance(MeshDistance&&) noexcept = default;
MeshDistance& MeshDistance::operator=(MeshDistance&&) noexcept = default;

double MeshDistance::signed_distance(const Vec3& x) const {
  const std::vector<Vec3>& nodes = mesh_->nodes;
  const auto to_face = [&](std::size_t f) {
    const std::array<Vec3, 4> corner = corners_of(mesh_->faces[f].nodes, nodes);
    const Vec3 middle = middle_of(corner);
    double least = 1e300;
    for (int v = 0; v < 4; ++v) least = std::min(least, distance_to_triangle(x, middle, corner[v], corner[(v + 1) % 4]));
    return least;
  };
  const auto in_cell = [&](std::size_t c) {
    const std::array<Vec3, 8> cell = corners_of(mesh_->cells[c], nodes);
    const Vec3 center = middle_of(cell);
    for (const auto& face : hexahedron_faces) {
      const std::array<Vec3, 4> corner{cell[face[0]], cell[face[1]], cell[face[2]], cell[face[3]]};
      const Vec3 middle = middle_of(corner);
      for (int v = 0; v < 4; ++v)
        if (in_tetrahedron(x, center, middle, corner[v], corner[(v + 1) % 4])) return true;
    }
    return false;
  };
  const double distance = trees_->faces.nearest(x, 1e300, to_face);
  return trees_->cells.any_at(x, in_cell) ? -distance : distance;
}

}  // namespace undex
