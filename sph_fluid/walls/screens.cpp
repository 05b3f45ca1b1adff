#include "sph_fluid/walls/screens.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "core/surface.hpp"

namespace undex::sph {
namespace {

constexpr double soft = 0.1;  // in spacings: so far beside an edge a way is partly free

/// From the inside of the way a-b to the edge p-q [m], if that is less than `most`.
std::optional<double> distance_between(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& along, double most) {
  const Vec3 d = b - a, r = a - p;
  const Vec3 both = d.cross(along);
  const double apart = both.dot(r);
  if (apart * apart > most * most * both.squaredNorm()) return std::nullopt;  // so far their lines are apart
  const double dd = d.squaredNorm(), ee = along.squaredNorm(), de = d.dot(along), dr = d.dot(r), er = along.dot(r);
  const double determinant = dd * ee - de * de;
  double t = determinant > 1e-12 * dd * ee ? (de * er - dr * ee) / determinant : 0.0;
  double s = (er + t * de) / ee;
  if (s < 0.0 || s > 1.0) {
    s = std::clamp(s, 0.0, 1.0);
    t = (s * de - dr) / dd;
  }
  constexpr double end = 1e-4;  // a way that turns at a mirror may do so at an edge
  if (!(t > -end && t < 1.0 + end)) return std::nullopt;
  const double distance = (r + t * d - s * along).norm();
  return distance < most ? std::optional(distance) : std::nullopt;
}

/// Calls visit(triangle) for both halves of a face: corner, along, across.
template <class Visit>
void halve(const std::array<Vec3, 4>& x, Visit visit) {
  visit(x[0], Vec3(x[1] - x[0]), Vec3(x[2] - x[0]));
  visit(x[0], Vec3(x[2] - x[0]), Vec3(x[3] - x[0]));
}

template <class T>
std::size_t bytes_of(const std::vector<T>& array) {
  return array.capacity() * sizeof(T);
}

}  // namespace

bool Way::is_free() const {
  const Crossing* entered = nullptr;
  for (const Crossing& crossing : crossings) {
    if (crossing.entering == (entered != nullptr)) return false;
    if (crossing.entering) {
      entered = &crossing;
    } else {
      if (entered->normal.dot(crossing.normal) < alike) return false;
      entered = nullptr;
    }
  }
  return entered == nullptr;
}

bool Way::enters(const Vec3& normal) const {
  return first_wall([&](const Crossing& crossing) { return crossing.normal.dot(normal) > alike; });
}

double Way::graze(int sheet) const {
  double most = 0.0;
  for (const Graze& graze : grazed)
    if (sheet < 0 || graze.sheet == sheet) most = std::max(most, graze.share);
  return most;
}

double Way::beside(int but) const {
  double least = 1.0;
  for (const Crossing& crossing : crossings)
    if (crossing.sheet != but) least = std::min(least, graze(crossing.sheet));
  return least;
}

void Screens::build(const std::vector<MirrorWall>& walls, const ThinWalls& thin, const SlipFaces& faces, const Settings& settings,
                    double reach) {
  clear();
  reach_ = reach;
  spacing_ = settings.lattice.spacing;
  for (int w = 0; w < int(walls.size()); ++w)
    for (int f = 0; f < int(walls[w].faces.size()) && thin.contain(w); ++f) {
      const auto corner = corners_of(walls[w].faces[f], walls[w].position);
      add_face(corner, thin.sheet(w, f), thin.open(w, f), faces, settings);
      if (thin.goes_on(w, f)) add_beyond(corner, thin.sheet(w, f), thin.open(w, f), thin.goes_on(w, f), faces, settings);
    }
  sort_by_plane();
  sort_by_place(settings.dimension);
}

void Screens::clear() {
  triangles_.clear();
  edges_.clear();
  start_.clear();
  member_.clear();
}

void Screens::add_face(const std::array<Vec3, 4>& corner, int sheet, unsigned open, const SlipFaces& faces,
                       const Settings& settings) {
  for (const FaceCopy& copy : copies_of(corner, faces, settings, reach_)) add_copy(copy, sheet, open);
}

void Screens::add_beyond(const std::array<Vec3, 4>& corner, int sheet, unsigned open, unsigned edges, const SlipFaces& faces,
                         const Settings& settings) {
  const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
  std::array<Vec3, 4> outward;
  for (int e = 0; e < 4; ++e) {
    outward[e].setZero();
    if (!(edges >> e & 1)) continue;
    const Vec3 along = (corner[(e + 1) % 4] - corner[e]).normalized(), away = corner[e] - middle;
    outward[e] = 2.0 * reach_ * (away - away.dot(along) * along).normalized();
  }
  for (int e = 0; e < 4; ++e) {
    if (!(edges >> e & 1)) continue;
    const int before = (e + 3) % 4, after = (e + 1) % 4;
    const Vec3 &a = corner[e], &b = corner[after];
    const unsigned sides = (open >> before & 1) << 1 | (open >> after & 1) << 3;
    add_face({b, a, a + outward[e] + outward[before], b + outward[e] + outward[after]}, sheet, sides, faces, settings);
  }
}

void Screens::add_copy(const FaceCopy& copy, int sheet, unsigned open) {
  const std::array<Vec3, 4>& x = copy.corner;
  halve(x, [&](const Vec3& corner, const Vec3& along, const Vec3& across) {
    const Vec3 normal = along.cross(across);
    const double area = normal.norm();
    if (!(area > 1e-12 * spacing_ * spacing_)) return;
    const double uu = along.squaredNorm(), uv = along.dot(across), vv = across.squaredNorm(), squared = area * area;
    triangles_.push_back({.corner = corner,
                          .along = along,
                          .across = across,
                          .normal = normal / area,
                          .u = (vv * along - uv * across) / squared,
                          .v = (uu * across - uv * along) / squared,
                          .offset = normal.dot(corner) / area,
                          .size = std::max(along.norm(), across.norm()),
                          .sheet = sheet,
                          .plane = 0});
  });
  for (int e = 0; e < 4; ++e)
    if (open >> (copy.turned ? 3 - e : e) & 1) edges_.push_back({x[e], x[(e + 1) % 4] - x[e], sheet});
}

/// Triangles of one plane stand together: a way that does not meet the plane meets none of them.
void Screens::sort_by_plane() {
  using Key = std::tuple<double, double, double, double>;
  std::vector<std::pair<Key, std::uint32_t>> order;
  const double fine = 1e-7 * spacing_;
  for (std::uint32_t k = 0; k < triangles_.size(); ++k) {
    const Triangle& t = triangles_[k];
    const auto rounded = [](double a) { return std::round(1e9 * a); };
    order.push_back({{rounded(t.normal[0]), rounded(t.normal[1]), rounded(t.normal[2]), std::round(t.offset / fine)}, k});
  }
  std::sort(order.begin(), order.end());
  std::vector<Triangle> sorted;
  sorted.reserve(triangles_.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.push_back(triangles_[order[k].second]);
    if (k > 0) sorted[k].plane = sorted[k - 1].plane + (order[k].first != order[k - 1].first);
  }
  triangles_ = std::move(sorted);
}

void Screens::sort_by_place(int dimension) {
  const auto box_of = [&](std::size_t k) {
    Bounds box;
    if (k < triangles_.size()) {
      const Triangle& t = triangles_[k];
      box.include(t.corner);
      box.include(Vec3(t.corner + t.along));
      box.include(Vec3(t.corner + t.across));
    } else {
      const Edge& e = edges_[k - triangles_.size()];
      box.include(e.from);
      box.include(Vec3(e.from + e.along));
    }
    return box;
  };
  const std::size_t all = triangles_.size() + edges_.size();
  box_ = {};
  for (std::size_t k = 0; k < all; ++k) box_.include(box_of(k));
  constexpr double most = 1 << 18;
  cell_ = 2.0 * reach_;
  for (;; cell_ *= 2.0) {
    double cells = 1.0;
    for (int a = 0; a < 3; ++a) {
      const double wide = a < dimension ? (box_.high[a] - box_.low[a]) / cell_ : 0.0;
      count_[a] = wide < most ? 1 + int(wide) : int(most);
      cells *= count_[a];
    }
    if (cells <= most) break;
  }
  const std::size_t cells = std::size_t(count_[0]) * count_[1] * count_[2];
  start_.assign(cells + 1, 0);
  for (std::size_t k = 0; k < all; ++k) for_each_cell(box_of(k), [&](std::size_t c) { ++start_[c + 1]; });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  member_.resize(start_[cells]);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t k = 0; k < all; ++k) for_each_cell(box_of(k), [&](std::size_t c) { member_[next[c]++] = std::uint32_t(k); });
}

template <class Visit>
void Screens::for_each_cell(const Bounds& box, Visit visit) const {
  int first[3], last[3];
  for (int a = 0; a < 3; ++a) {
    if (!(box.low[a] <= box_.high[a] && box.high[a] >= box_.low[a])) return;
    first[a] = std::clamp(int((box.low[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
    last[a] = std::clamp(int((box.high[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
  }
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) visit((std::size_t(z) * count_[1] + y) * count_[0] + x);
}

void Screens::Near::clear() {
  triangles_.clear();
  edges_.clear();
  for (auto* a : {&x_, &y_, &z_, &offset_}) a->clear();
  begin_.clear();
}

void Screens::Near::add(const Triangle& t) {
  if (triangles_.empty() || triangles_.back()->plane != t.plane) {
    x_.push_back(t.normal[0]), y_.push_back(t.normal[1]), z_.push_back(t.normal[2]), offset_.push_back(t.offset);
    begin_.push_back(std::uint32_t(triangles_.size()));
  }
  triangles_.push_back(&t);
}

void Screens::find(const Bounds& box, Near& near) const {
  near.clear();
  if (start_.empty()) return;
  std::vector<std::uint32_t>& found = near.found_;
  found.clear();
  for_each_cell(box,
                [&](std::size_t c) { found.insert(found.end(), member_.begin() + start_[c], member_.begin() + start_[c + 1]); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const std::uint32_t k : found) {
    if (k < triangles_.size()) near.add(triangles_[k]);
    else near.edges_.push_back(&edges_[k - triangles_.size()]);
  }
}

void Screens::find(const Near& all, const Vec3& from, double reach, Near& near) const {
  near.clear();
  const auto within = [&](const Vec3& corner, double size) {
    return (corner - from).squaredNorm() < (reach + size) * (reach + size);
  };
  for (const Triangle* t : all.triangles_)
    if (std::abs(t->normal.dot(from) - t->offset) < reach && within(t->corner, t->size)) near.add(*t);
  for (const Edge* e : all.edges_)
    if (within(e->from, e->along.norm())) near.edges_.push_back(e);
}

namespace {

void tidy(std::vector<Way::Crossing>& crossings) {
  if (crossings.size() < 2) return;
  std::sort(crossings.begin(), crossings.end(), [](const Way::Crossing& p, const Way::Crossing& q) { return p.at < q.at; });
  // On the line between two triangles both have it.
  const auto last = std::unique(crossings.begin(), crossings.end(), [](const Way::Crossing& p, const Way::Crossing& q) {
    return q.at - p.at < Way::same && p.entering == q.entering && p.normal.dot(q.normal) > alike;
  });
  crossings.erase(last, crossings.end());
}

}  // namespace

bool Screens::Triangle::holds(const Vec3& x) const {
  constexpr double rim = 1e-9;
  const double along_it = (x - corner).dot(u), across_it = (x - corner).dot(v);
  return along_it >= -rim && across_it >= -rim && along_it + across_it <= 1.0 + rim;
}

void Screens::follow(const Vec3& a, const Vec3& b, const Near& near, Way& way) const {
  way.crossings.clear();
  way.grazed.clear();
  for (const Edge* e : near.edges_)
    if (const auto distance = distance_between(a, b, e->from, e->along, 0.5 * soft * spacing_))
      way.grazed.push_back({e->sheet, 0.5 - *distance / (soft * spacing_)});
  const double nearest = 0.02 * spacing_;  // a particle may lie behind the triangles that stand in for a face
  const std::size_t planes = near.begin_.size();
  for (std::size_t k = 0; k < planes; ++k) {
    const double before = near.x_[k] * a[0] + near.y_[k] * a[1] + near.z_[k] * a[2] - near.offset_[k];
    const double after = near.x_[k] * b[0] + near.y_[k] * b[1] + near.z_[k] * b[2] - near.offset_[k];
    if ((before < 0.0) == (after < 0.0) || (before >= 0.0 && before < nearest)) continue;
    const double at = before / (before - after);
    const Vec3 x = a + at * (b - a);
    const std::size_t end = k + 1 < planes ? near.begin_[k + 1] : near.triangles_.size();
    for (std::size_t t = near.begin_[k]; t < end; ++t) {
      const Triangle& triangle = *near.triangles_[t];
      if (triangle.holds(x)) way.crossings.push_back({at, before < 0.0, triangle.normal, triangle.offset, triangle.sheet});
    }
  }
  tidy(way.crossings);
}

std::size_t Screens::memory_bytes() const {
  return bytes_of(triangles_) + bytes_of(edges_) + bytes_of(start_) + bytes_of(member_);
}

}  // namespace undex::sph
