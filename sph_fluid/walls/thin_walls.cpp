#include "sph_fluid/walls/thin_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "core/surface.hpp"
#include "sph_fluid/pairs/cell_list.hpp"
#include "sph_fluid/walls/face_copies.hpp"

namespace undex::sph {
namespace {

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

/// The faces of all walls that do not radiate, found by place.
class ThinWalls::Search {
 public:
  struct Face {
    int wall, face, sheet;
    std::array<Vec3, 4> corner;  // [m]
    Vec3 middle, normal;
    double radius;  // of the ball about it [m]
    unsigned open, sharp, goes_on;
    bool copy = false;  // across a symmetry plane or a container's face
  };

  Search(const std::vector<MirrorWall>& walls, const std::vector<Sheets>& sheets, std::span<const Vec3> position,
         const SlipFaces& mirrors, const Settings& settings, double reach)
      : through_(2.0 * reach - settings.lattice.spacing),
        reach_(reach),
        beside_(reach + 0.5 * settings.lattice.spacing),
        spacing_(settings.lattice.spacing) {
    int sheet_count = 1;
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const auto nodes = position.subspan(0, walls[w].position.size());
      position = position.subspan(nodes.size());
      for (int f = 0; f < int(walls[w].faces.size()) && !walls[w].radiates(); ++f) {
        const bool segment = is_segment(walls[w].faces[f]);
        const std::vector<FaceCopy> copies = copies_of(corners_of(walls[w].faces[f], nodes), mirrors, settings, 3.0 * reach);
        for (const FaceCopy& copy : copies) {
          const auto& corner = copy.corner;
          Face face{.wall = int(w),
                    .face = f,
                    .sheet = sheet_count + sheets[w].sheet(f),
                    .corner = corner,
                    .middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]),
                    .normal = (corner[2] - corner[0]).cross(corner[3] - corner[1]).normalized(),
                    .radius = 0,
                    .open = sheets[w].open(f),
                    .sharp = sheets[w].sharp(f),
                    .goes_on = sheets[w].goes_on(f),
                    .copy = &copy != &copies.front()};
          for (Vec3 x : corner) {
            if (segment) x[2] = face.middle[2];
            face.radius = std::max(face.radius, (x - face.middle).norm());
          }
          largest_ = std::max(largest_, face.radius);
          faces_.push_back(face);
        }
      }
      sheet_count += sheets[w].count();
    }
    if (faces_.empty()) return;
    std::vector<double> place[3];
    for (int a = 0; a < 3; ++a)
      for (const Face& face : faces_) place[a].push_back(face.middle[a]);
    cells_.build(place[0].data(), place[1].data(), place[2].data(), 0, std::uint32_t(faces_.size()),
                 std::max(2.0 * reach, largest_));
  }

  std::span<const Face> faces() const { return faces_; }

  /// Has the face another behind it that looks the other way, or is it beside an edge behind which the wall goes on?
  bool is_thin(const Face& me) const {
    return any_near(me.middle, through_ + me.radius + largest_, [&](const Face& it) {
      const Vec3 way = it.middle - me.middle;
      const double behind = way.dot(me.normal), aside = (way - behind * me.normal).norm();
      return (it.normal.dot(me.normal) < -alike && behind > 0.0 && behind < through_ &&
              aside < me.radius + it.radius + beside_) ||
             is_beside(me, it, it.sharp);
    });
  }

  /// Is it far from open edges, and do particles that have their foot on it see none that has its on another sheet only?
  bool is_plain(const Face& me) const {
    const double apart = 3.0 * reach_;
    return !any_near(me.middle, apart + me.radius + largest_, [&](const Face& it) {
      const Vec3 way = it.middle - me.middle;
      if (way.norm() - me.radius - it.radius > apart) return false;
      // Behind a copy of its own stand particles of its own number.
      const double turned = it.normal.dot(me.normal);
      const bool behind = turned < -alike && way.dot(me.normal) > 0.0;
      return (it.sheet == me.sheet ? turned < alike : !behind) || (!it.copy && is_beside(me, it, it.open));
    });
  }

  /// Does edge e stand on another wall?
  bool is_held(const Face& me, int e) const {
    const Vec3 middle = 0.5 * (me.corner[e] + me.corner[(e + 1) % 4]);
    return any_near(middle, largest_ + spacing_, [&](const Face& it) {
      return it.wall != me.wall && !it.copy && lies_on(middle, it.corner, 1e-3 * spacing_);
    });
  }

 private:
  template <class Test>
  bool any_near(const Vec3& x, double radius, Test test) const {
    const Vec3 low = x - Vec3::Constant(radius), high = x + Vec3::Constant(radius);
    bool found = false;
    for_each_in_cells(cells_.view(), low.data(), high.data(),
                      [&](std::uint32_t s) { found = found || test(faces_[cells_.order()[s]]); });
    return found;
  }

  bool is_beside(const Face& me, const Face& it, unsigned edges) const {
    for (int e = 0; e < 4 && edges != 0; ++e)
      if (edges >> e & 1 && distance_to_edge(me.middle, it.corner[e], it.corner[(e + 1) % 4]) <= me.radius + beside_) return true;
    return false;
  }

  // Of two that meet through a wall one is an image, half a spacing less than a reach behind its mirror; the other stands half a
  // spacing before the wall's other face.
  double through_, reach_, beside_, spacing_, largest_ = 0;
  std::vector<Face> faces_;
  CellList cells_;
};

bool ThinWalls::have_moved(const std::vector<MirrorWall>& walls, double far) const {
  auto at = looked_at_.begin();
  for (const MirrorWall& wall : walls)
    for (const Vec3& x : wall.position) {
      if (at == looked_at_.end()) return true;
      const Vec3& before = *at++;
      if (!wall.radiates() && !((x - before).squaredNorm() < far * far)) return true;
    }
  return at != looked_at_.end();
}

void ThinWalls::look(const std::vector<MirrorWall>& walls, const std::vector<Sheets>& sheets, const SlipFaces& mirrors,
                     const Settings& settings, double reach) {
  const bool moved = have_moved(walls, 0.25 * settings.lattice.spacing);
  if (!moved && sought_) return;
  sought_ = true;
  if (moved) {
    looked_at_.clear();
    for (const MirrorWall& wall : walls) looked_at_.insert(looked_at_.end(), wall.position.begin(), wall.position.end());
  }
  const Search search(walls, sheets, looked_at_, mirrors, settings, reach);
  const std::span<const Search::Face> faces = search.faces();
  const int count = int(faces.size());

  std::vector<char> thin(walls.size(), 0);
#pragma omp parallel for schedule(dynamic, 64)
  for (int k = 0; k < count; ++k) {
    if (faces[k].copy) continue;
    char& mine = thin[faces[k].wall];
    char known;
#pragma omp atomic read
    known = mine;
    if (known != 0 || !search.is_thin(faces[k])) continue;
#pragma omp atomic write
    mine = 1;
  }
  thin_.assign(thin.begin(), thin.end());
  any_ = std::find(thin.begin(), thin.end(), 1) != thin.end();

  plain_.clear();
  for (const MirrorWall& wall : walls) plain_.emplace_back(wall.faces.size(), true);
  sheet_.resize(walls.size());
  open_.resize(walls.size());
  goes_on_.resize(walls.size());
  for (std::size_t w = 0; w < walls.size(); ++w) {
    sheet_[w].assign(walls[w].faces.size(), 0);
    open_[w].assign(walls[w].faces.size(), 0u);
    goes_on_[w].assign(walls[w].faces.size(), 0u);
  }
#pragma omp parallel for schedule(dynamic, 64)
  for (int k = 0; k < count; ++k) {
    const Search::Face& face = faces[k];
    if (face.copy || !thin_[face.wall]) continue;
    plain_[face.wall][face.face] = search.is_plain(face);
    sheet_[face.wall][face.face] = face.sheet;
    goes_on_[face.wall][face.face] = face.goes_on;
    unsigned& open = open_[face.wall][face.face] = face.open;
    for (int e = 0; e < 4 && walls.size() > 1; ++e)
      if (open >> e & 1 && search.is_held(face, e)) open &= ~(1u << e);
  }
}

void ThinWalls::visit_state(StateVisitor& state) {
  state("looked_at", looked_at_);
  sought_ = false;
}

std::size_t ThinWalls::memory_bytes() const {
  std::size_t bytes = looked_at_.capacity() * sizeof(Vec3);
  for (const auto& faces : plain_) bytes += faces.capacity() * (1 + sizeof(int) + 2 * sizeof(unsigned));
  return bytes;
}

}  // namespace undex::sph
