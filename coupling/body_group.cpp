#include "coupling/body_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/errors.hpp"

namespace undex::coupling {
namespace {

/// Of the thinnest cell: as far in each other bodies have met; bodies nearer than that are looked at about as often.
constexpr double met = 0.05;

double shortest_edge(const HexahedralMesh& mesh) {
  constexpr int edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  double least = 1e300;
  for (const auto& cell : mesh.cells)
    for (const auto& [a, b] : edges)
      if (cell[a] != cell[b]) least = std::min(least, (mesh.nodes[cell[a]] - mesh.nodes[cell[b]]).norm());
  return least;
}

double distance_between(const Bounds& one, const Bounds& other) {
  return (one.low - other.high).cwiseMax(other.low - one.high).cwiseMax(0.0).norm();
}

double longest_way(std::span<const Vec3> from, std::span<const Vec3> to) {
  double most = 0;
  for (std::size_t i = 0; i < from.size(); ++i) most = std::max(most, (to[i] - from[i]).squaredNorm());
  return std::sqrt(most);
}

}  // namespace

BodyGroup::BodyGroup(std::vector<Member> members)
    : members_(std::move(members)), before_(members_.size()), received_(members_.size(), Vec3::Zero()) {
  for (const Member& member : members_) {
    const DeformableBody& body = *member.body;
    const WetSurface& wet = body.wet_surface();
    const int first = static_cast<int>(surface_.nodes.size());
    first_.push_back(surface_.nodes.size());
    surface_.nodes.insert(surface_.nodes.end(), wet.nodes.begin(), wet.nodes.end());
    for (const NamedFaces& named : body.wet_faces())
      faces_.push_back({member.name + "." + named.name, surface_.faces.size() + named.first, surface_.faces.size() + named.last});
    for (std::array<int, 4> face : wet.faces) {
      for (int& node : face) node += first;
      surface_.faces.push_back(face);
    }
    mass_.insert(mass_.end(), body.wet_masses().begin(), body.wet_masses().end());

    auto mesh = std::make_shared<HexahedralMesh>();
    mesh->nodes.assign(body.positions().begin(), body.positions().end());
    mesh->cells = body.snapshot({}).cells;
    mesh->faces = outer_faces(*mesh);
    thinnest_.push_back(shortest_edge(*mesh));
    meshes_.push_back(std::move(mesh));
  }
  first_.push_back(surface_.nodes.size());
  for (auto* field : {&position_, &velocity_, &acceleration_}) field->resize(surface_.nodes.size());
  show_wet_motion();
  for (std::size_t i = 0; i < members_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      Pair pair{k, i, 0, 0};
      const double distance = gap_between(pair).distance;
      pair.least = std::min(0.0, distance) - met * std::min(thinnest_[k], thinnest_[i]);
      ask_again_after(pair, distance);
      pairs_.push_back(pair);
    }
}

long BodyGroup::steps() const {
  long most = 0;
  for (const Member& member : members_) most = std::max(most, member.body->steps());
  return most;
}

const BodyGroup::Member& BodyGroup::shortest() const {
  return *std::min_element(members_.begin(), members_.end(),
                           [](const Member& a, const Member& b) { return a.body->stable_step() < b.body->stable_step(); });
}
double BodyGroup::stable_step() const { return shortest().body->stable_step(); }
std::string BodyGroup::stable_step_owner() const { return shortest().body->stable_step_owner(); }

void BodyGroup::advance(double t_end, std::span<const Vec3> impulse) {
  for (std::size_t m = 0; m < members_.size(); ++m) {
    DeformableBody& body = *members_[m].body;
    before_[m].assign(body.positions().begin(), body.positions().end());
    const auto own = impulse.empty() ? impulse : impulse.subspan(first_[m], first_[m + 1] - first_[m]);
    body.advance(t_end, own);
    received_[m] = std::accumulate(own.begin(), own.end(), received_[m]);
  }
  show_wet_motion();
  expect_room();
}

void BodyGroup::show_wet_motion() {
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const DeformableBody& body = *members_[m].body;
    const auto put = [&](std::span<const Vec3> from, std::vector<Vec3>& to) {
      std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(first_[m]));
    };
    put(body.wet_positions(), position_);
    put(body.wet_velocities(), velocity_);
    put(body.wet_accelerations(), acceleration_);
  }
}

BodyLedger BodyGroup::ledger() const {
  BodyLedger sum;
  for (const Member& member : members_) sum += member.body->ledger();
  return sum;
}

void BodyGroup::visit_state(StateVisitor& state) {
  state("received", received_);
  for (std::size_t k = 0; k < pairs_.size(); ++k) state("margin " + std::to_string(k), pairs_[k].margin);
  if (state.restores()) show_wet_motion();
}

/// By the nodes and the middles of the faces of either and the surface of the other.
BodyGroup::Gap BodyGroup::gap_between(const Pair& pair) const {
  for (const std::size_t m : {pair.one, pair.other})
    meshes_[m]->nodes.assign(members_[m].body->positions().begin(), members_[m].body->positions().end());
  const double apart = distance_between(bounds(*meshes_[pair.one]), bounds(*meshes_[pair.other]));
  if (apart > std::min(thinnest_[pair.one], thinnest_[pair.other])) return {apart, {}};
  Gap least;
  const auto look = [&](const HexahedralMesh& from, const std::shared_ptr<HexahedralMesh>& to) {
    const MeshDistance distance(to);
    const auto at = [&](const Vec3& x) {
      if (const double here = distance.signed_distance(x); here < least.distance) least = {here, x};
    };
    std::vector<bool> seen(from.nodes.size());
    for (const auto& face : from.faces) {
      Vec3 middle = Vec3::Zero();
      for (const int node : face.nodes) {
        middle += 0.25 * from.nodes[static_cast<std::size_t>(node)];
        if (!seen[static_cast<std::size_t>(node)]) at(from.nodes[static_cast<std::size_t>(node)]);
        seen[static_cast<std::size_t>(node)] = true;
      }
      at(middle);
    }
  };
  look(*meshes_[pair.one], meshes_[pair.other]);
  look(*meshes_[pair.other], meshes_[pair.one]);
  return least;
}

void BodyGroup::ask_again_after(Pair& pair, double distance) const {
  pair.margin = std::max(0.5 * distance, met * std::min(thinnest_[pair.one], thinnest_[pair.other]));
}

void BodyGroup::expect_room() {
  std::vector<double> way;
  for (std::size_t m = 0; m < members_.size(); ++m) way.push_back(longest_way(before_[m], members_[m].body->positions()));
  for (Pair& pair : pairs_) {
    pair.margin -= way[pair.one] + way[pair.other];
    if (pair.margin > 0) continue;
    const Gap gap = gap_between(pair);
    ask_again_after(pair, gap.distance);
    if (gap.distance >= pair.least) continue;
    char text[600];
    std::snprintf(
        text, sizeof text,
        "time %.6g s: structures '%s' and '%s' have met at (%.5g, %.5g, %.5g) m; contact of structures is not built: end "
        "the run before (end_time), or give them more room",
        time(), members_[pair.one].name.c_str(), members_[pair.other].name.c_str(), gap.at[0], gap.at[1], gap.at[2]);
    throw NumericalStop(text);
  }
}

}  // namespace undex::coupling
