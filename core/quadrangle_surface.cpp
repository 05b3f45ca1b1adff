#include "core/quadrangle_surface.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "core/bilinear_patch.hpp"

namespace undex {
namespace {

// Cosines of the angles between two sheets at an edge: nearer than this they are folded onto each other.
constexpr double folded = 0.87;
// Of three or more sheets two must go on in one another at least so straight.
constexpr double straight = -0.5;
// Normals that differ by more than this cosine are met each by itself, by a mitre.
constexpr double one_normal = 0.94;
// Rounds of neighbours among which the face under a tied node is sought.
constexpr int most_rounds = 12;

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  return text.str();
}

class Thickening {
 public:
  Thickening(const QuadrangleSurface& surface, const std::function<Layer(int)>& layer_of, const std::vector<int>& symmetry_axes,
             const std::string& path)
      : surface_(surface), axes_(symmetry_axes), path_(path), cells_(surface.cells) {
    Bounds box;
    for (const Vec3& x : surface.nodes) box.include(x);
    near_ = 1e-9 * std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    for (const int group : surface.groups) {
      const Layer layer = layer_of(group);
      const double below = layer.offset == ShellOffset::mid ? 0.5 : layer.offset == ShellOffset::bottom ? 1.0 : 0.0;
      reach_.push_back({-below * layer.thickness, (1.0 - below) * layer.thickness});
    }
  }

  HexahedralMesh mesh() {
    find_edges();
    orient();
    find_fans();
    place_fans();
    attach_sheets();
    fill_cells();
    name_faces();
    mesh_.is_shell = true;
    mesh_.groups = surface_.groups;
    mesh_.group_names = surface_.group_names;
    mesh_.remarks.insert(mesh_.remarks.begin(), surface_.remarks.begin(), surface_.remarks.end());
    return std::move(mesh_);
  }

 private:
  /// The quadrangles at an edge. The first two go on in one another; where there is one it is the first.
  struct Edge {
    std::array<int, 2> nodes;
    std::vector<int> cells;
    int id = 0;
  };
  /// Cells round a node that are one layer there: its two nodes of the mesh are 2 f and 2 f + 1.
  struct Fan {
    int node = -1;
    std::vector<std::pair<int, int>> corners;  // cell and its corner
    std::vector<Vec3> normals;                 // of the corners, mirrored ones too
    std::vector<int> seats;                    // into seats_
    int rank = -1;                             // 0: attached to none
  };
  /// A fan begins at the face of another one, the bottom (0) or top (1) of its cells.
  struct Seat {
    int fan, on, cell, side;
    Vec3 normal;
    double height;  // of the face over the surface [m]
  };

  [[noreturn]] void fail(const std::string& what, const Vec3& at, const std::string& remedy) const {
    throw std::invalid_argument(path_ + ": " + what + " near " + place(at) + "; " + remedy);
  }
  const Vec3& corner(int cell, int v) const { return surface_.nodes[cells_[cell][v & 3]]; }
  Vec3 middle(int cell) const { return 0.25 * (corner(cell, 0) + corner(cell, 1) + corner(cell, 2) + corner(cell, 3)); }
  Vec3 normal(int cell) const {
    return (corner(cell, 2) - corner(cell, 0)).cross(corner(cell, 3) - corner(cell, 1)).normalized();
  }
  Vec3 corner_normal(int cell, int v) const {
    return (corner(cell, v + 1) - corner(cell, v)).cross(corner(cell, v + 3) - corner(cell, v)).normalized();
  }
  int corner_of(int cell, int node) const {
    return int(std::find(cells_[cell].begin(), cells_[cell].end(), node) - cells_[cell].begin());
  }
  bool on_plane(const Vec3& x, int axis) const { return std::abs(x[axis]) <= near_; }

  /// From an edge into a cell, across the edge, of unit length.
  Vec3 into(int cell, const Edge& edge) const {
    const Vec3 &a = surface_.nodes[edge.nodes[0]], &b = surface_.nodes[edge.nodes[1]];
    const Vec3 along = (b - a).normalized(), out = middle(cell) - 0.5 * (a + b);
    return (out - out.dot(along) * along).normalized();
  }

  void find_edges() {
    std::map<std::array<int, 2>, int> number;
    for (std::size_t c = 0; c < cells_.size(); ++c)
      for (int v = 0; v < 4; ++v) {
        std::array<int, 2> key{cells_[c][v], cells_[c][(v + 1) % 4]};
        if (key[0] > key[1]) std::swap(key[0], key[1]);
        const auto [found, fresh] = number.emplace(key, int(edges_.size()));
        if (fresh) edges_.push_back({key, {}});
        edges_[std::size_t(found->second)].cells.push_back(int(c));
      }
    for (const QuadrangleSurface::Edge& named : surface_.edges) {
      if (named.id == 0) continue;
      const auto found = number.find({std::min(named.nodes[0], named.nodes[1]), std::max(named.nodes[0], named.nodes[1])});
      if (found == number.end()) continue;
      Edge& edge = edges_[std::size_t(found->second)];
      if (edge.id != 0 && edge.id != named.id)
        fail("an edge belongs to the groups '" + surface_.edge_names.of(edge.id) + "' and '" + surface_.edge_names.of(named.id) +
                 "', but has one name,",
             surface_.nodes[edge.nodes[0]], "leave it in one of them");
      edge.id = named.id;
    }
    for (Edge& edge : edges_) pair(edge);
  }

  /// Puts the two cells first that go on in one another.
  void pair(Edge& edge) const {
    const std::size_t n = edge.cells.size();
    if (n < 2) return;
    if (n > 8) fail("more than eight quadrangles meet at an edge", surface_.nodes[edge.nodes[0]], "repair the mesh there");
    std::vector<Vec3> out;
    for (const int cell : edge.cells) out.push_back(into(cell, edge));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (!(out[i].dot(out[j]) < folded))
          fail("two quadrangles lie upon each other, or at less than 30 degrees,", surface_.nodes[edge.nodes[0]],
               "mesh the solid with hexahedra there, or leave one of them out");
    if (n == 2) return;
    // Straightest; then thickest; then along the axis that comes first, so that the choice is one all along a line.
    const auto merit = [&](std::size_t i, std::size_t j) {
      const Vec3 along = (out[i] - out[j]).normalized().cwiseAbs();
      const auto rounded = [](double value, double unit) { return std::round(value / unit); };
      const auto thickness = [&](int cell) { return reach_[std::size_t(cell)][1] - reach_[std::size_t(cell)][0]; };
      return std::array<double, 5>{-rounded(out[i].dot(out[j]), 0.01), thickness(edge.cells[i]) + thickness(edge.cells[j]),
                                   rounded(along[0], 0.01), rounded(along[1], 0.01), rounded(along[2], 0.01)};
    };
    std::size_t first = 0, second = 1;
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < j; ++i)
        if (merit(i, j) > merit(first, second)) first = i, second = j;
    if (!(out[first].dot(out[second]) <= straight))
      fail(std::to_string(n) + " quadrangles meet at an edge, of which no two go on in one another,",
           surface_.nodes[edge.nodes[0]], "mesh this joint with hexahedra, or let two of its plates go straight on");
    std::swap(edge.cells[0], edge.cells[first]);
    std::swap(edge.cells[1], edge.cells[second]);
  }

  /// Turns cells over so that those of a layer have their tops on one side.
  void orient() {
    const std::size_t n = cells_.size();
    std::vector<std::vector<std::pair<int, bool>>> next(n);  // neighbours, and are they turned the same way?
    for (const Edge& edge : edges_) {
      if (edge.cells.size() < 2) continue;
      const auto forth = [&](int cell) { return cells_[cell][(corner_of(cell, edge.nodes[0]) + 1) % 4] == edge.nodes[1]; };
      const int a = edge.cells[0], b = edge.cells[1];
      const bool same = forth(a) != forth(b);
      next[a].emplace_back(b, same);
      next[b].emplace_back(a, same);
    }
    std::vector<int> turned(n, -1);
    long count = 0;
    for (std::size_t first = 0; first < n; ++first) {
      if (turned[first] >= 0) continue;
      std::vector<int> layer{int(first)};
      turned[first] = 0;
      for (std::size_t k = 0; k < layer.size(); ++k)
        for (const auto& [other, same] : next[layer[k]]) {
          const int wanted = same ? turned[layer[k]] : 1 - turned[layer[k]];
          if (turned[other] < 0) {
            turned[other] = wanted;
            layer.push_back(other);
          } else if (turned[other] != wanted) {
            fail("the surface has one side only, as a Moebius strip,", middle(other), "cut it, or mesh it with hexahedra");
          }
        }
      const auto is_turned = [&](int cell) { return turned[cell] == 1; };
      const long of_layer = std::count_if(layer.begin(), layer.end(), is_turned);
      const bool most = 2 * of_layer > long(layer.size());
      count += most ? long(layer.size()) - of_layer : of_layer;
      for (const int cell : layer)
        if (is_turned(cell) != most) std::reverse(cells_[cell].begin(), cells_[cell].end());
    }
    if (count > 0)
      mesh_.remarks.push_back(std::to_string(count) +
                              " of the quadrangles are listed the other way round than their neighbours; they were turned over");
  }

  void find_fans() {
    std::vector<int> parent(4 * cells_.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int c) {
      while (parent[c] != c) c = parent[c] = parent[parent[c]];
      return c;
    };
    for (const Edge& edge : edges_)
      if (edge.cells.size() > 1)
        for (const int node : edge.nodes) {
          const int a = root(4 * edge.cells[0] + corner_of(edge.cells[0], node));
          const int b = root(4 * edge.cells[1] + corner_of(edge.cells[1], node));
          parent[std::max(a, b)] = std::min(a, b);
        }
    fan_.assign(4 * cells_.size(), -1);
    for (int k = 0; k < int(fan_.size()); ++k) {
      int& fan = fan_[std::size_t(root(k))];
      if (fan < 0) {
        fan = int(fans_.size());
        fans_.emplace_back().node = cells_[k / 4][k % 4];
      }
      fan_[std::size_t(k)] = fan;
      fans_[std::size_t(fan)].corners.emplace_back(k / 4, k % 4);
    }
  }
  int fan_at(int cell, int node) const { return fan_[std::size_t(4 * cell + corner_of(cell, node))]; }

  /// The place over a node where planes along its normals, each at its reach, meet; or nearest to it.
  Vec3 raised(const std::vector<Vec3>& normals, const std::vector<double>& weights, const std::vector<double>& reach,
              const Vec3& at) const {
    Vec3 sum = Vec3::Zero();
    double weight = 0.0;
    for (std::size_t k = 0; k < normals.size(); ++k) sum += weights[k] * normals[k], weight += weights[k];
    if (!(sum.norm() > 0.4 * weight)) fail("the surface is folded", at, "mesh the solid with hexahedra there");
    const Vec3 mean = sum.normalized();
    double along = 0.0, height = 0.0, least = 1.0;
    for (std::size_t k = 0; k < normals.size(); ++k) {
      along += weights[k] / weight * normals[k].dot(mean);
      height += weights[k] / weight * reach[k];
      for (const Vec3& other : normals) least = std::min(least, other.dot(normals[k]));
    }
    Vec3 x = height / along * mean;
    if (least > one_normal) return x;
    Mat3 matrix = 1e-9 * weight * Mat3::Identity();
    Vec3 right = Vec3::Zero();
    for (std::size_t k = 0; k < normals.size(); ++k) {
      matrix += weights[k] * normals[k] * normals[k].transpose();
      right += weights[k] * (reach[k] - normals[k].dot(x)) * normals[k];
    }
    return x + matrix.ldlt().solve(right);
  }

  void place_fans() {
    mesh_.nodes.resize(2 * fans_.size());
    for (std::size_t f = 0; f < fans_.size(); ++f) {
      Fan& fan = fans_[f];
      const Vec3& at = surface_.nodes[fan.node];
      std::vector<double> weights, reach[2];
      for (const auto& [cell, v] : fan.corners) {
        const Vec3 a = (corner(cell, v + 1) - at).normalized(), b = (corner(cell, v + 3) - at).normalized();
        fan.normals.push_back(corner_normal(cell, v));
        weights.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
        for (int side = 0; side < 2; ++side) reach[side].push_back(reach_[std::size_t(cell)][side]);
      }
      for (const int axis : axes_) {
        if (!on_plane(at, axis)) continue;
        const std::size_t count = fan.normals.size();
        for (std::size_t k = 0; k < count; ++k) {
          if (lies_in(fan.corners[k % fan.corners.size()].first, axis)) continue;
          Vec3 mirrored = fan.normals[k];
          mirrored[axis] *= -1.0;
          fan.normals.push_back(mirrored);
          weights.push_back(weights[k]);
          for (auto& each : reach) each.push_back(each[k]);
        }
      }
      for (int side = 0; side < 2; ++side) {
        Vec3& x = mesh_.nodes[2 * f + std::size_t(side)];
        x = at + raised(fan.normals, weights, reach[side], at);
        for (const int axis : axes_)
          if (on_plane(at, axis) && std::abs(x[axis]) <= 1e-6 * std::abs(reach[side][0]) + near_) x[axis] = at[axis];
      }
    }
  }
  bool lies_in(int cell, int axis) const {
    return on_plane(corner(cell, 0), axis) && on_plane(corner(cell, 1), axis) && on_plane(corner(cell, 2), axis) &&
           on_plane(corner(cell, 3), axis);
  }

  /// Where three or more cells meet, all but two begin at the face of these.
  void attach_sheets() {
    for (const Edge& edge : edges_)
      for (std::size_t k = 2; k < edge.cells.size(); ++k)
        for (const int node : edge.nodes) take_seat(edge, edge.cells[k], node);
    note_touching();
    if (seats_.empty()) return;
    find_neighbours();
    std::vector<int> order;
    for (std::size_t f = 0; f < fans_.size(); ++f) {
      find_rank(int(f), 0);
      if (fans_[f].rank > 0) order.push_back(int(f));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return fans_[a].rank < fans_[b].rank; });
    for (const int f : order)
      for (int side = 0; side < 2; ++side) seat_on_.emplace(2 * f + side, tie(f, 2 * f + side));
    for (const int f : order)
      for (int side = 0; side < 2; ++side) {
        const int node = 2 * f + side;
        std::map<int, double> sum;
        add_free(node, 1.0, 0, sum);
        mesh_.ties.push_back({node, {sum.begin(), sum.end()}});
      }
    for (const HexahedralMesh::Tie& tie : mesh_.ties) {
      Vec3& x = mesh_.nodes[std::size_t(tie.node)];
      x.setZero();
      for (const auto& [node, weight] : tie.to) x += weight * mesh_.nodes[std::size_t(node)];
    }
  }

  /// The nodes tied to none that a node's place follows from, with their weights.
  void add_free(int node, double weight, int depth, std::map<int, double>& sum) const {
    const auto found = seat_on_.find(node);
    if (found == seat_on_.end()) {
      sum[node] += weight;
      return;
    }
    if (depth > 8)
      fail("plates stand on each other in a ring", surface_.nodes[fans_[std::size_t(node / 2)].node],
           "let one of them go straight on, or mesh this joint with hexahedra");
    for (const auto& [to, share] : found->second)
      if (share > 0.0) add_free(to, weight * share, depth + 1, sum);
  }

  void take_seat(const Edge& edge, int cell, int node) {
    const int a = edge.cells[0], b = edge.cells[1], fan = fan_at(cell, node), on = fan_at(a, node);
    if (fan == on)
      fail("a plate meets itself at an edge of three quadrangles", surface_.nodes[node],
           "let another plate go straight on there, or mesh this joint with hexahedra");
    const Vec3 normal_of_both = (normal(a) + normal(b)).normalized();
    const int side = normal_of_both.dot(into(cell, edge)) > 0.0 ? 1 : 0;
    const double height = 0.5 * (reach_[std::size_t(a)][side] + reach_[std::size_t(b)][side]);
    fans_[std::size_t(fan)].seats.push_back(int(seats_.size()));
    seats_.push_back({fan, on, a, side, normal_of_both, height});
  }

  /// Layers that have a node in common, but no edge, are not joined there.
  void note_touching() {
    std::vector<std::vector<int>> of_node(surface_.nodes.size());
    for (std::size_t f = 0; f < fans_.size(); ++f) of_node[std::size_t(fans_[f].node)].push_back(int(f));
    long count = 0;
    int at = -1;
    for (std::size_t node = 0; node < of_node.size(); ++node) {
      if (of_node[node].size() < 2) continue;
      std::vector<int> joined{of_node[node][0]};
      for (std::size_t k = 0; k < joined.size(); ++k)
        for (const Seat& seat : seats_of(of_node[node])) {
          const int other = seat.fan == joined[k] ? seat.on : seat.on == joined[k] ? seat.fan : -1;
          if (other >= 0 && std::find(joined.begin(), joined.end(), other) == joined.end()) joined.push_back(other);
        }
      if (joined.size() == of_node[node].size()) continue;
      ++count;
      at = int(node);
    }
    if (count > 0)
      mesh_.remarks.push_back("plates meet in a node without a common edge at " + std::to_string(count) +
                              " places, one of them " + place(surface_.nodes[std::size_t(at)]) + ", and are not joined there");
  }
  std::vector<Seat> seats_of(const std::vector<int>& fans) const {
    std::vector<Seat> found;
    for (const int f : fans)
      for (const int s : fans_[std::size_t(f)].seats) found.push_back(seats_[std::size_t(s)]);
    return found;
  }

  int find_rank(int f, int depth) {
    Fan& fan = fans_[std::size_t(f)];
    if (fan.rank >= 0) return fan.rank;
    if (depth > 8)
      fail("plates stand on each other in a ring", surface_.nodes[fan.node],
           "let one of them go straight on, or mesh this joint with hexahedra");
    int rank = 0;
    for (const int s : fan.seats) rank = std::max(rank, 1 + find_rank(seats_[std::size_t(s)].on, depth + 1));
    return fan.rank = rank;
  }

  void find_neighbours() {
    neighbours_.resize(cells_.size());
    for (const Edge& edge : edges_)
      if (edge.cells.size() > 1) {
        neighbours_[std::size_t(edge.cells[0])].push_back(edge.cells[1]);
        neighbours_[std::size_t(edge.cells[1])].push_back(edge.cells[0]);
      }
  }

  /// Moves a node within its layer to the faces that it is seated on, and finds the nodes of the lowest with their weights.
  std::array<std::pair<int, double>, 4> tie(int f, int node) {
    const Fan& fan = fans_[std::size_t(f)];
    const Vec3 at = surface_.nodes[fan.node];
    Vec3& x = mesh_.nodes[std::size_t(node)];
    Mat3 matrix = 1e-9 * Mat3::Identity();
    Vec3 right = Vec3::Zero();
    for (const Vec3& n : fan.normals) matrix += n * n.transpose();
    const Seat* lowest = nullptr;
    for (const int s : fan.seats) {
      const Seat& seat = seats_[std::size_t(s)];
      matrix += seat.normal * seat.normal.transpose();
      right += (seat.height - seat.normal.dot(x - at)) * seat.normal;
      if (!lowest || fans_[std::size_t(seat.on)].rank < fans_[std::size_t(lowest->on)].rank) lowest = &seat;
    }
    x += matrix.ldlt().solve(right);
    const auto [cell, u, v, distance] = foot(*lowest, x);
    const auto& reach = reach_[std::size_t(lowest->cell)];
    if (!(distance <= 0.25 * (reach[1] - reach[0])))
      fail("a plate does not meet the face of the one that it stands on", at,
           "let its thickness be less than the cells there, or mesh this joint with hexahedra");
    const std::array<double, 4> weight = bilinear_weights(u, v);
    std::array<std::pair<int, double>, 4> to;
    x.setZero();
    for (int k = 0; k < 4; ++k) {
      to[k] = {2 * fan_[std::size_t(4 * cell + k)] + lowest->side, weight[k]};
      x += weight[k] * mesh_.nodes[std::size_t(to[k].first)];
    }
    return to;
  }

  struct Foot {
    int cell = -1;
    double u = 0, v = 0, distance = 1e300;
  };
  /// The nearest point of the layer's face, sought among the cells round the seat.
  Foot foot(const Seat& seat, const Vec3& x) const {
    std::vector<int> known;
    for (const auto& [cell, v] : fans_[std::size_t(seat.on)].corners) known.push_back(cell);
    Foot best;
    std::size_t from = 0;
    for (int round = 0; round < most_rounds; ++round) {
      const std::size_t to = known.size();
      const double before = best.distance;
      for (std::size_t k = from; k < to; ++k)
        if (const Foot here = foot_on(known[k], seat.side, x); here.distance < best.distance) best = here;
      if (from == to || (round > 0 && best.distance >= before)) break;
      for (std::size_t k = from; k < to; ++k)
        for (const int other : neighbours_[std::size_t(known[k])])
          if (std::find(known.begin(), known.end(), other) == known.end()) known.push_back(other);
      from = to;
    }
    return best;
  }
  Foot foot_on(int cell, int side, const Vec3& x) const {
    BilinearPatch patch;
    for (int k = 0; k < 4; ++k) {
      patch.corner[k] = mesh_.nodes[std::size_t(2 * fan_[std::size_t(4 * cell + k)] + side)];
      patch.normal[k] = normal(cell);
    }
    Foot found{.cell = cell};
    PatchPoint at;
    const double size = (patch.corner[2] - patch.corner[0]).norm();
    if (!patch.project(x, size, at, 20.0)) return found;
    const auto snapped = [](double t) { return t < 1e-9 ? 0.0 : t > 1.0 - 1e-9 ? 1.0 : t; };
    found.u = snapped(at.u);
    found.v = snapped(at.v);
    found.distance = (x - blended(bilinear_weights(found.u, found.v), patch.corner)).norm();
    if (!std::isfinite(found.distance)) found.distance = 1e300;
    return found;
  }

  void fill_cells() {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      std::array<int, 8> cell;
      for (int k = 0; k < 8; ++k) cell[k] = 2 * fan_[4 * c + std::size_t(k % 4)] + k / 4;
      const auto volumes = corner_volumes(mesh_.nodes, cell);
      const double longest = std::max((corner(int(c), 2) - corner(int(c), 0)).norm(), reach_[c][1] - reach_[c][0]);
      if (!(*std::min_element(volumes.begin(), volumes.end()) > 1e-12 * longest * longest * longest))
        fail("the layer is too thick for its cells or its curvature", middle(int(c)),
             "make the thickness less or the cells larger than it, or mesh the solid with hexahedra");
      mesh_.cells.push_back(cell);
    }
  }

  void name_faces() {
    int last = 0;
    for (const auto& [id, name] : surface_.edge_names.given) last = std::max(last, id);
    for (const Edge& edge : edges_) last = std::max(last, edge.id);
    mesh_.face_names = surface_.edge_names;
    std::map<int, std::array<int, 3>> sides;
    for (const int group : surface_.groups)
      if (sides.try_emplace(group).second)
        for (int side = 0; side < 3; ++side) {
          constexpr const char* called[3] = {".bottom", ".top", ".root"};
          const std::string name = surface_.group_names.of(group) + called[side];
          for (const auto& [id, known] : surface_.edge_names.given)
            if (known == name)
              throw std::invalid_argument(path_ + ": the curves '" + name + "' are called like a side of the group '" +
                                          surface_.group_names.of(group) + "'; rename one of them");
          if (last > 2000000000)
            throw std::invalid_argument(path_ + ": the numbers of groups of curves are too large; renumber them");
          mesh_.face_names.given[++last] = name;
          sides[group][side] = last;
        }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto& cell = mesh_.cells[c];
      mesh_.faces.push_back({{cell[0], cell[3], cell[2], cell[1]}, sides[surface_.groups[c]][0]});
      mesh_.faces.push_back({{cell[4], cell[5], cell[6], cell[7]}, sides[surface_.groups[c]][1]});
    }
    for (const Edge& edge : edges_) {
      const std::size_t first = edge.cells.size() == 1 ? 0 : 2;
      for (std::size_t k = first; k < edge.cells.size(); ++k) {
        const int cell = edge.cells[k], a = corner_of(cell, edge.nodes[0]), b = corner_of(cell, edge.nodes[1]);
        const int v = (a + 1) % 4 == b ? a : b, w = (v + 1) % 4;
        const auto& nodes = mesh_.cells[std::size_t(cell)];
        mesh_.faces.push_back({{nodes[v], nodes[w], nodes[w + 4], nodes[v + 4]},
                               first == 0 ? edge.id : sides[surface_.groups[std::size_t(cell)]][2]});
      }
    }
  }

  const QuadrangleSurface& surface_;
  std::vector<int> axes_;
  std::string path_;
  std::vector<std::array<int, 4>> cells_;     // turned over where need be
  std::vector<std::array<double, 2>> reach_;  // of a cell's bottom and top along its normal [m]
  double near_ = 0;
  std::vector<Edge> edges_;
  std::vector<Fan> fans_;
  std::vector<int> fan_;  // of each corner of each cell
  std::vector<Seat> seats_;
  std::map<int, std::array<std::pair<int, double>, 4>> seat_on_;  // of tied nodes: those of the face, tied ones too
  std::vector<std::vector<int>> neighbours_;
  HexahedralMesh mesh_;
};

}  // namespace

HexahedralMesh thickened(const QuadrangleSurface& surface, const std::function<Layer(int)>& layer_of,
                         const std::vector<int>& symmetry_axes, const std::string& path) {
  return Thickening(surface, layer_of, symmetry_axes, path).mesh();
}

}  // namespace undex
