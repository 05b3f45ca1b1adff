#include "sph_fluid/walls/sight.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/surface.hpp"
#include "sph_fluid/pairs/cell_list.hpp"

namespace undex::sph {
namespace {

constexpr double alike = 0.3;  // cosine between normals of faces that look the same way

/// A face's middle, unit normal and the radius of the ball about it [m].
struct FaceBall {
  Vec3 middle, normal;
  double radius;
};

FaceBall ball_of(const std::array<Vec3, 4>& x, bool segment) {
  FaceBall ball{
      .middle = 0.25 * (x[0] + x[1] + x[2] + x[3]), .normal = (x[2] - x[0]).cross(x[3] - x[1]).normalized(), .radius = 0};
  for (Vec3 corner : x) {
    if (segment) corner[2] = ball.middle[2];
    ball.radius = std::max(ball.radius, (corner - ball.middle).norm());
  }
  return ball;
}

constexpr double soft = 0.1;  // in spacings: so far beside an edge a way is partly free

/// From the inside of the way a-b to the edge p-q [m]; infinite where an end of the way is nearest.
double distance_between(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const Vec3 d = b - a, e = q - p, r = a - p;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  const double determinant = dd * ee - de * de;
  double t = determinant > 1e-12 * dd * ee ? (de * er - dr * ee) / determinant : 0.0;
  double s = (er + t * de) / ee;
  if (s < 0.0 || s > 1.0) {
    s = std::clamp(s, 0.0, 1.0);
    t = (s * de - dr) / dd;
  }
  if (!(t > 0.0 && t < 1.0)) return std::numeric_limits<double>::infinity();
  return (r + t * d - s * e).norm();
}

/// Is x within `tolerance` [m] of a face?
bool lies_on(const Vec3& x, const std::array<Vec3, 4>& face, double tolerance) {
  const Vec3 normal = (face[2] - face[0]).cross(face[3] - face[1]).normalized();
  bool inside = std::abs((x - face[0]).dot(normal)) < tolerance;
  for (int c = 0; c < 4 && inside; ++c) {
    const Vec3 side = face[(c + 1) % 4] - face[c];
    inside = normal.dot(side.cross(x - face[c])) > -tolerance * side.norm();
  }
  return inside;
}

double distance_to_edge(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((x - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (x - a - t * along).norm();
}

}  // namespace

void Sight::look(const std::vector<MirrorWall>& walls, const std::vector<Sheets>& sheets, double reach, double spacing) {
  const double margin = 0.5 * spacing;
  bool moved = looked_at_.size() != walls.size();
  for (std::size_t w = 0; w < walls.size() && !moved; ++w) {
    if (walls[w].radiates()) continue;
    for (std::size_t n = 0; n < walls[w].position.size() && !moved; ++n)
      moved = !((walls[w].position[n] - looked_at_[w][n]).squaredNorm() < 0.25 * margin * margin);
  }
  if (!moved) return;
  spacing_ = spacing;
  looked_at_.clear();
  plain_.clear();
  sheet_.clear();
  open_.clear();
  thin_ = false;
  thin_wall_.clear();

  struct Seat {
    int wall, face;
  };
  std::vector<Seat> seats;
  std::vector<FaceBall> balls;
  std::vector<double> place[3];
  double largest = 0.0;
  int sheet_count = 1;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const MirrorWall& wall = walls[w];
    looked_at_.push_back(wall.position);
    plain_.emplace_back(wall.faces.size(), true);
    sheet_.emplace_back();
    open_.emplace_back();
    for (std::size_t f = 0; f < wall.faces.size(); ++f) {
      sheet_[w].push_back(sheet_count + sheets[w].sheet(int(f)));
      open_[w].push_back(sheets[w].open(int(f)));
      if (wall.radiates()) continue;
      seats.push_back({int(w), int(f)});
      balls.push_back(ball_of(corners_of(wall.faces[f], wall.position), is_segment(wall.faces[f])));
      largest = std::max(largest, balls.back().radius);
      for (int a = 0; a < 3; ++a) place[a].push_back(balls.back().middle[a]);
    }
    sheet_count += sheets[w].count();
  }
  if (seats.empty()) return;
  CellList cells;
  cells.build(place[0].data(), place[1].data(), place[2].data(), 0, std::uint32_t(seats.size()), std::max(2.0 * reach, largest));
  const auto for_each_face_near = [&](const Vec3& x, double radius, auto visit) {
    const Vec3 low = x - Vec3::Constant(radius), high = x + Vec3::Constant(radius);
    for_each_in_cells(cells.view(), low.data(), high.data(), [&](std::uint32_t s) { visit(cells.order()[s]); });
  };
  // Of two that meet through a wall one is an image, half a spacing less than a reach behind its mirror; the other stands half a
  // spacing before the wall's other face.
  const double through = 2.0 * reach - spacing, beside = reach + margin;
  // A wall is thin where a face has another behind it that looks the other way, or is beside an edge behind which the wall goes
  // on.
  const int faces = int(seats.size());
  std::vector<char> hides(walls.size(), 0);
#pragma omp parallel for schedule(dynamic, 64)
  for (int k = 0; k < faces; ++k) {
    const FaceBall& me = balls[k];
    bool thin = false;
    if (hides[seats[k].wall] != 0) continue;
    for_each_face_near(me.middle, through + me.radius + largest, [&](std::uint32_t j) {
      if (thin) return;
      const Vec3 way = balls[j].middle - me.middle;
      const double behind = way.dot(me.normal), aside = (way - behind * me.normal).norm();
      if (balls[j].normal.dot(me.normal) < -alike && behind > 0.0 && behind < through &&
          aside < me.radius + balls[j].radius + beside)
        thin = true;
      const MirrorWall& wall = walls[seats[j].wall];
      const unsigned sharp = sheets[seats[j].wall].sharp(seats[j].face);
      for (int e = 0; e < 4 && sharp != 0 && !thin; ++e)
        if (sharp >> e & 1) {
          const auto& nodes = wall.faces[seats[j].face];
          thin = distance_to_edge(me.middle, wall.position[nodes[e]], wall.position[nodes[(e + 1) % 4]]) < me.radius + beside;
        }
    });
    if (!thin) continue;
#pragma omp atomic write
    hides[seats[k].wall] = 1;
  }
  thin_wall_.assign(hides.begin(), hides.end());
  // Not plain are faces that lie near an open edge, or from which another sheet can be seen.
#pragma omp parallel for schedule(dynamic, 64)
  for (int k = 0; k < faces; ++k) {
    if (!thin_wall_[seats[k].wall]) continue;
    const FaceBall& me = balls[k];
    const int sheet = sheet_[seats[k].wall][seats[k].face];
    bool plain = true;
    for_each_face_near(me.middle, through + me.radius + largest, [&](std::uint32_t j) {
      if (!plain) return;
      const Vec3 way = balls[j].middle - me.middle;
      if (way.norm() - me.radius - balls[j].radius > through) return;
      const double turned = balls[j].normal.dot(me.normal);
      const bool same = sheet_[seats[j].wall][seats[j].face] == sheet;
      if (same ? turned < alike : !(turned < -alike && way.dot(me.normal) > 0.0)) plain = false;
      const unsigned open = sheets[seats[j].wall].open(seats[j].face);
      const auto& nodes = walls[seats[j].wall].faces[seats[j].face];
      for (int e = 0; e < 4 && open != 0 && plain; ++e)
        if (open >> e & 1) {
          const auto& x = walls[seats[j].wall].position;
          plain = distance_to_edge(me.middle, x[nodes[e]], x[nodes[(e + 1) % 4]]) > me.radius + beside;
        }
    });
    plain_[seats[k].wall][seats[k].face] = plain;
  }
  // An edge that stands on another wall is not open.
  for (int k = 0; k < faces && walls.size() > 1; ++k) {
    const auto [w, f] = seats[k];
    for (int e = 0; e < 4; ++e) {
      if (!thin_wall_[w] || !(open_[w][f] >> e & 1)) continue;
      const std::array<Vec3, 4> x = corners_of(walls[w].faces[f], walls[w].position);
      const Vec3 middle = 0.5 * (x[e] + x[(e + 1) % 4]);
      for_each_face_near(middle, largest + spacing, [&](std::uint32_t j) {
        if (seats[j].wall == w) return;
        const MirrorWall& other = walls[seats[j].wall];
        if (lies_on(middle, corners_of(other.faces[seats[j].face], other.position), 1e-3 * spacing)) open_[w][f] &= ~(1u << e);
      });
    }
  }
  for (const bool thin : thin_wall_) thin_ = thin_ || thin;
}

Sight::Code Sight::code_of(int wall, int face) const {
  if (!thin_wall_[wall]) return 0;
  const Code sheet = Code(std::min(sheet_[wall][face], int(many)));
  return plain_[wall][face] ? sheet : Code(sheet | edge);
}

void Sight::see(double reach, const std::vector<MirrorWall>& walls, const SlipFaces& faces, const Settings& settings,
                std::span<const WallFoot> feet, std::size_t particles, std::span<const SeenImage> images,
                std::span<const SeenImage::Glass> glasses) {
  forget();
  if (!thin_) return;
  reach_ = reach;
  dimension_ = settings.dimension;
  if (!lined_) lined_ = lined_faces(settings);
  for (std::size_t w = 0; w < walls.size(); ++w)
    for (std::size_t f = 0; f < walls[w].faces.size(); ++f)
      if (thin_wall_[w])
        add_face(corners_of(walls[w].faces[f], walls[w].position), sheet_[w][f], open_[w][f], faces, settings.symmetry.axis);
  sort_pieces();
  const auto with = [](Code a, Code b) -> Code {
    if (a == 0 || b == 0) return Code(a | b);
    const Code ends = Code((a | b) & edge);
    return (a & many) == (b & many) ? Code((a & many) | ends) : Code(many | edge);
  };
  particle_.assign(particles, 0);
  for (const WallFoot& foot : feet)
    if (foot.at.distance > 0.0) particle_[foot.particle] = with(particle_[foot.particle], code_of(foot.wall, foot.face));
  images_ = images;
  glasses_ = glasses;
  image_.resize(images.size());
  for (std::size_t k = 0; k < images.size(); ++k) {
    const Code owner = particle_[images[k].owner];
    const SeenImage::Glass* glass = images[k].first < images[k].last ? &glasses[images[k].first] : nullptr;
    const Code mirror = glass ? code_of(glass->wall, glass->face) : Code(0);
    image_[k] = mirror == 0 ? owner : Code(mirror | (owner & edge));
  }
}

void Sight::add_face(std::array<Vec3, 4> corner, int sheet, unsigned open, const SlipFaces& faces,
                     const std::array<bool, 3>& symmetry) {
  std::vector<std::array<Vec3, 4>> copies{corner};
  std::vector<bool> turned{false};
  const auto mirror_all = [&](auto image) {
    for (std::size_t k = 0, count = copies.size(); k < count; ++k)
      if (const auto copy = image(copies[k])) {
        copies.push_back(*copy);
        turned.push_back(!turned[k]);
      }
  };
  const auto in_plane = [&](int axis, double at) {
    mirror_all([&](std::array<Vec3, 4> x) -> std::optional<std::array<Vec3, 4>> {
      double nearest = 1e300, farthest = 0;
      for (Vec3& c : x) {
        nearest = std::min(nearest, std::abs(c[axis] - at));
        farthest = std::max(farthest, std::abs(c[axis] - at));
        c[axis] = 2.0 * at - c[axis];
      }
      if (nearest > reach_ || farthest < 1e-9 * spacing_) return std::nullopt;
      std::swap(x[1], x[3]);
      return x;
    });
  };
  for (const SlipFaces::Round& wall : faces.round)
    mirror_all([&](std::array<Vec3, 4> x) -> std::optional<std::array<Vec3, 4>> {
      for (Vec3& c : x) {
        const auto image = image_in(wall, c, 2.0 * reach_, dimension_);
        if (!image) return std::nullopt;
        c = image->place;
      }
      std::swap(x[1], x[3]);
      return x;
    });
  for (const SlipFaces::Pair& pair : faces.plane) {
    if (pair.low > -1e299 && !pair.symmetric) in_plane(pair.axis, pair.low);
    if (pair.high < 1e299) in_plane(pair.axis, pair.high);
  }
  for (int a = 0; a < 3; ++a)
    if (symmetry[a]) in_plane(a, 0.0);
  // Copies have their corners the other way round, so that their normals are right: 0, 3, 2, 1.
  for (std::size_t copy = 0; copy < copies.size(); ++copy) {
    const std::array<Vec3, 4>& x = copies[copy];
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      Piece triangle{.corner = x[i], .along = x[j] - x[i], .across = x[k] - x[i], .normal = Vec3::Zero(), .sheet = sheet};
      triangle.normal = triangle.along.cross(triangle.across);
      if (!(triangle.normal.norm() > 1e-12 * spacing_ * spacing_)) continue;
      triangle.normal.normalize();
      triangle.offset = triangle.normal.dot(triangle.corner);
      pieces_.push_back(triangle);
    }
    for (int e = 0; e < 4; ++e) {
      const int own = turned[copy] ? 3 - e : e;
      if (open >> own & 1)
        pieces_.push_back(
            {.corner = x[e], .along = x[(e + 1) % 4] - x[e], .across = Vec3::Zero(), .normal = Vec3::Zero(), .sheet = sheet});
    }
  }
}

namespace {

template <class Piece>
Bounds box_of(const Piece& t) {
  Bounds box;
  box.include(t.corner);
  box.include(Vec3(t.corner + t.along));
  box.include(Vec3(t.corner + t.across));
  return box;
}

}  // namespace

void Sight::sort_pieces() {
  box_ = {};
  for (const Piece& t : pieces_) box_.include(box_of(t));
  constexpr double most = 1 << 18;
  cell_ = 2.0 * reach_;
  for (;; cell_ *= 2.0) {
    double cells = 1.0;
    for (int a = 0; a < 3; ++a) {
      const double wide = a < dimension_ ? (box_.high[a] - box_.low[a]) / cell_ : 0.0;
      count_[a] = wide < most ? 1 + int(wide) : int(most);
      cells *= count_[a];
    }
    if (cells <= most) break;
  }
  const std::size_t cells = std::size_t(count_[0]) * count_[1] * count_[2];
  start_.assign(cells + 1, 0);
  const auto for_each_cell = [&](const Bounds& box, auto visit) {
    int first[3], last[3];
    for (int a = 0; a < 3; ++a) {
      first[a] = std::clamp(int((box.low[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
      last[a] = std::clamp(int((box.high[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) visit((std::size_t(z) * count_[1] + y) * count_[0] + x);
  };
  for (const Piece& t : pieces_) for_each_cell(box_of(t), [&](std::size_t c) { ++start_[c + 1]; });
  for (std::size_t c = 0; c < cells; ++c) start_[c + 1] += start_[c];
  member_.resize(start_[cells]);
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t k = 0; k < pieces_.size(); ++k)
    for_each_cell(box_of(pieces_[k]), [&](std::size_t c) { member_[next[c]++] = std::uint32_t(k); });
}

template <class Visit>
void Sight::for_each_near(const Bounds& box, Visit visit) const {
  if (pieces_.empty()) return;
  int first[3], last[3];
  for (int a = 0; a < 3; ++a) {
    if (box.low[a] > box_.high[a] || box.high[a] < box_.low[a]) return;
    first[a] = std::clamp(int((box.low[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
    last[a] = std::clamp(int((box.high[a] - box_.low[a]) / cell_), 0, count_[a] - 1);
  }
  std::vector<std::uint32_t> found;
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) {
        const std::size_t c = (std::size_t(z) * count_[1] + y) * count_[0] + x;
        found.insert(found.end(), member_.begin() + start_[c], member_.begin() + start_[c + 1]);
      }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (const std::uint32_t k : found) visit(pieces_[k]);
}

void Sight::follow(const Vec3& a, const Vec3& b, std::span<const Piece> pieces, Way& way) const {
  way.crossings.clear();
  way.grazed.clear();
  constexpr double rim = 1e-9;
  const double nearest = 0.02 * spacing_;  // a particle may lie behind the triangles that stand in for a face
  for (const Piece& t : pieces) {
    if (t.is_edge()) {
      const double distance = distance_between(a, b, t.corner, t.corner + t.along);
      if (distance < 0.5 * soft * spacing_) way.grazed.push_back({t.sheet, 0.5 - distance / (soft * spacing_)});
      continue;
    }
    const double before = t.normal.dot(a) - t.offset, after = t.normal.dot(b) - t.offset;
    if ((before < 0.0) == (after < 0.0)) continue;
    const double at = before / (before - after);
    const Vec3 x = a + at * (b - a) - t.corner;
    const double uu = t.along.squaredNorm(), uv = t.along.dot(t.across), vv = t.across.squaredNorm();
    const double xu = x.dot(t.along), xv = x.dot(t.across), inverse = 1.0 / (uu * vv - uv * uv);
    const double u = (vv * xu - uv * xv) * inverse, v = (uu * xv - uv * xu) * inverse;
    if (u < -rim || v < -rim || u + v > 1.0 + rim) continue;
    if (std::abs(before) < nearest && before >= 0.0) continue;
    way.crossings.push_back({at, before < 0.0, t.normal, t.offset, t.sheet});
  }
  std::sort(way.crossings.begin(), way.crossings.end(), [](const Crossing& p, const Crossing& q) { return p.at < q.at; });
  // On the line between two triangles both have it.
  way.crossings.erase(std::unique(way.crossings.begin(), way.crossings.end(),
                                  [](const Crossing& p, const Crossing& q) {
                                    return q.at - p.at < 1e-9 && p.entering == q.entering && p.normal.dot(q.normal) > alike;
                                  }),
                      way.crossings.end());
}

/// A wall that bulges into the way, and looks the same way where the way leaves it, hides nothing: its images stand as if it were
/// plane.
bool Sight::Way::is_free() const {
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

double Sight::Way::graze(int sheet) const {
  double most = 0.0;
  for (const Graze& graze : grazed)
    if (sheet < 0 || graze.sheet == sheet) most = std::max(most, graze.share);
  return most;
}

/// What of the way would be free if the walls that it meets ended a little earlier.
double Sight::Way::beside(int but) const {
  double least = 1.0;
  for (const Crossing& crossing : crossings)
    if (crossing.sheet != but) least = std::min(least, graze(crossing.sheet));
  return least;
}

bool Sight::Way::enters(const Vec3& normal) const {
  return !crossings.empty() && crossings[0].entering && crossings[0].normal.dot(normal) > alike;
}

double Sight::Way::free_share() const { return is_free() ? 1.0 - graze(-1) : beside(-1); }

void Sight::answer(const PairInput& in, const SightQuestion& question) const {
  static thread_local std::vector<Piece> near, nearer;
  static thread_local Way way;
  const auto place = [&](int l) {
    const std::uint32_t i = question.begin + l;
    return Vec3(in.x[i], in.y[i], in.z[i]);
  };
  Bounds box;
  for (int l = 0; l < question.count; ++l) box.include(place(l));
  box.low -= Vec3::Constant(reach_), box.high += Vec3::Constant(reach_);
  bool gathered = false;
  for (int l = 0; l < question.count; ++l) {
    const Vec3 from = place(l);
    const Code mine = particle_[question.begin + l];
    float* row = question.share + std::size_t(l) * question.row;
    bool chosen = false;
    const auto about = [&]() -> std::span<const Piece> {
      if (!gathered) {
        near.clear();
        for_each_near(box, [&](const Piece& t) { near.push_back(t); });
        gathered = true;
      }
      if (!chosen) {
        nearer.clear();
        for (const Piece& t : near) {
          const double size = std::max(t.along.norm(), t.across.norm());
          if (std::abs(t.normal.dot(from) - t.offset) < reach_ && (t.corner - from).norm() < reach_ + size) nearer.push_back(t);
        }
        chosen = true;
      }
      return nearer;
    };
    for (std::uint32_t c = question.first; c < question.last; ++c) {
      const Vec3 at = mirrored(Vec3(question.x[c], question.y[c], question.z[c]), unsigned(question.mirror));
      row[c] = share(from, mine, at, question, question.index[c], in, about, way);
    }
  }
}

template <class Pieces>
float Sight::share(const Vec3& from, Code mine, const Vec3& at, const SightQuestion& question, std::uint32_t j,
                   const PairInput& in, Pieces about, Way& way) const {
  const bool images = question.what == SightOf::images, dummies = question.what == SightOf::dummies;
  bool mirror = false;
  if (images)
    for (std::uint32_t g = images_[j].first; g < images_[j].last; ++g) mirror = mirror || is_thin(glasses_[g].wall);
  const Code its = dummies ? Code(many | edge) : images ? image_[j] : particle_[j];
  if (mine == 0 || its == 0) return mirror ? 0.0f : 1.0f;
  const Code a = mine & many, b = its & many;
  if ((mine & its & edge) == 0 && a != many && b != many) return a == b ? 1.0f : 0.0f;
  if ((at - from).squaredNorm() > reach_ * reach_) return 0.0f;
  const unsigned axes = unsigned(question.mirror);
  if (images && images_[j].first < images_[j].last) return float(mirrored_share(from, at, j, axes, about(), way));
  follow(from, at, about(), way);
  if (!dummies) return float(way.free_share());
  if (j >= behind_surface_.size() || behind_surface_[j] == 0) return sees_container(at, way) ? 1.0f : 0.0f;
  const WallRow& row = in.wall[j];
  return way.enters(mirrored(Vec3(row.nx, row.ny, row.nz), axes)) ? 1.0f : 0.0f;
}

bool Sight::sees_container(const Vec3& at, const Way& way) const {
  if (way.is_free()) return true;
  const auto first = std::find_if(way.crossings.begin(), way.crossings.end(), [](const Crossing& c) { return c.entering; });
  if (first == way.crossings.end()) return false;
  const Vec3 shown = at - 2.0 * (first->normal.dot(at) - first->offset) * first->normal;
  return lined_->end_before(shown, reach_, dimension_);
}

double Sight::mirrored_share(Vec3 from, Vec3 at, std::uint32_t j, unsigned axes, std::span<const Piece> pieces, Way& way) const {
  struct Mirror {
    int sheet;
    bool thick;
    Vec3 normal, shown;
  };
  const auto mirror_of = [&](std::uint32_t g) -> Mirror {
    const SeenImage::Glass& glass = glasses_[g];
    return {sheet_[glass.wall][glass.face], !is_thin(glass.wall), mirrored(glass.normal, axes), mirrored(glass.shown, axes)};
  };
  const std::uint32_t last = images_[j].last;
  Mirror next = mirror_of(images_[j].first);
  double share = 1.0;
  for (std::uint32_t g = images_[j].first; g < last; ++g) {
    Mirror mirror = next;
    if (g + 1 < last) next = mirror_of(g + 1);
    follow(from, at, pieces, way);
    bool through = way.enters(mirror.normal);
    if (!through && g + 1 < last && way.enters(next.normal) && std::abs(mirror.normal.dot(next.normal)) < alike) {
      // Where walls meet at a right angle the image is the same in either order.
      const Vec3 object = next.shown;
      const double across = (at - 0.5 * (mirror.shown + object)).dot(next.normal);
      std::swap(mirror, next);
      mirror.shown = at - 2.0 * across * mirror.normal;
      next.shown = object;
      through = true;
    }
    const double grazed = way.graze(mirror.sheet);
    share = std::min(share, through        ? 1.0 - grazed
                            : mirror.thick ? way.free_share()
                                           : std::min(grazed, way.beside(mirror.sheet)));
    if (share <= 0.0) return 0.0;
    // Beside an edge the mirror's plane lies halfway between the image and what it shows.
    const double depth = (at - from).dot(mirror.normal), before = (0.5 * (at + mirror.shown) - from).dot(mirror.normal);
    const double reached = through ? way.crossings[0].at : depth > 0.0 ? std::clamp(before / depth, 0.0, 1.0) : 0.0;
    from += (reached - 1e-6) * (at - from) - 1e-6 * spacing_ * mirror.normal;
    at = mirror.shown;
  }
  follow(from, at, pieces, way);
  return way.is_free() ? share : 0.0;
}

void Sight::weigh(const void* self, const PairInput& in, const SightQuestion& question) {
  static_cast<const Sight*>(self)->answer(in, question);
}

void Sight::describe(PairInput& in) const {
  in.sight = {};
  if (thin_) in.sight = {.self = this, .particles = particle_.data(), .answer = &weigh};
}

bool Sight::sees(const Vec3& a, const Vec3& b) const {
  if (!thin_) return true;
  std::vector<Piece> near;
  Bounds box;
  box.include(a);
  box.include(b);
  for_each_near(box, [&](const Piece& t) { near.push_back(t); });
  Way way;
  follow(a, b, near, way);
  return way.is_free();
}

void Sight::forget() {
  pieces_.clear();
  start_.clear();
  member_.clear();
  particle_.clear();
  image_.clear();
  images_ = {};
  glasses_ = {};
}

std::size_t Sight::memory_bytes() const {
  std::size_t bytes = pieces_.capacity() * sizeof(Piece) + (start_.capacity() + member_.capacity()) * sizeof(std::uint32_t) +
                      (particle_.capacity() + image_.capacity()) * sizeof(Code);
  for (const auto& faces : plain_) bytes += faces.capacity() * (2 * sizeof(int) + sizeof(Vec3));
  return bytes;
}

}  // namespace undex::sph
