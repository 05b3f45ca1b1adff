#include "sph_fluid/walls/wall_images.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/walls/reflection.hpp"

namespace undex::sph {
namespace {

Vec3 place_of(const Particles& p, std::size_t i) { return {p.x[i], p.y[i], p.z[i]}; }

/// Particle i changes places with its image in a wall of that velocity [m/s]: all of its vectors are reflected.
void turn(Particles& particles, std::size_t i, const Crossing& wall, const Vec3& wall_velocity) {
  const double speed = wall_velocity.dot(wall.normal);
  for_each_vector(particles, i, [&](Vector kind, auto& a, auto& b, auto& c) {
    const double offset = kind == Vector::place ? wall.foot.dot(wall.normal) : kind == Vector::velocity ? speed : 0.0;
    const Vec3 image = reflected(Vec3(a, b, c), wall.normal) + 2.0 * offset * wall.normal;
    using Number = std::remove_reference_t<decltype(a)>;
    a = Number(image[0]), b = Number(image[1]), c = Number(image[2]);
  });
  particles.x[i] = wall.place[0], particles.y[i] = wall.place[1], particles.z[i] = wall.place[2];
}

template <class T>
std::vector<T> joined(std::vector<T> a, const std::vector<T>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Of pairs of particles that keep their smoothing length [m].
double reach_of_liquid(const Settings& settings) {
  double spacing = settings.lattice.spacing;
  for (const Body& body : settings.bodies)
    if (!body.variable_h) spacing = std::max(spacing, body.spacing.value_or(0.0));
  return kernel_support(settings.numerics.kernel) * smoothing_length(settings, spacing);
}

Sheets sheets_of(const MirrorWall& wall, const Settings& settings) {
  return {wall.faces,
          wall.position,
          {.symmetry = settings.symmetry.axis,
           .fixed = fixed_faces(settings),
           .radiating = radiating_faces(settings),
           .tolerance = 1e-3 * settings.lattice.spacing}};
}

PointLoads unloaded(const std::vector<MirrorWall>& walls) {
  PointLoads loads;
  for (const MirrorWall& wall : walls) loads.emplace_back(wall.position.size(), Vec3::Zero());
  return loads;
}

}  // namespace

void WallImages::build(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls,
                       const Particles& particles, std::span<const ParticleRange> ranges, double reach,
                       const std::function<void(std::span<const WallFoot>)>& on_feet) {
  see_first_places(settings, walls);
  SeenMirrors seen(walls, footprints_, sheets_, settings.symmetry.axis, settings.lattice.spacing);
  look(settings, faces, walls);
  feet_ = find_feet(walls, seen, particles, ranges, 0.5 * settings.lattice.spacing,
                    [&](int wall, int face) { return open_edges(wall, face, sheets_[wall]); });
  if (on_feet) {
    on_feet(feet_);
    seen.see_velocities(footprints_);
  }
  images_.clear();
  begin_.assign(1, 0);
  cells_.resize(ranges.size());
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    const std::uint32_t start = std::uint32_t(images_.size());
    add_range(ranges[r], particles, seen, faces, walls, settings);
    sort_from(start, ranges[r].width, cells_[r]);
    begin_.push_back(std::uint32_t(images_.size()));
  }
  if (!sight_.empty()) see_past_walls(settings, faces, walls, particles, ranges, reach);
}

void WallImages::see_linings(const std::vector<LinedWall>& walls, std::span<const char> behind_surface) {
  sight_.see_dummies(behind_surface);
  std::size_t count = 0;
  for (const LinedWall& wall : walls) {
    if (wall.faces.empty()) continue;
    if (linings_.size() == count) linings_.emplace_back();
    linings_[count].faces = wall.faces;
    linings_[count].position = wall.node;
    linings_[count++].velocity.assign(wall.node.size(), Vec3::Zero());
  }
}

void WallImages::look(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls) {
  const double reach = reach_of_liquid(settings);
  if (linings_.empty()) {
    sight_.walls().look(walls, sheets_, faces, settings, reach);
    return;
  }
  while (lining_sheets_.size() < linings_.size()) {
    const MirrorWall& wall = linings_[lining_sheets_.size()];
    lining_sheets_.push_back(sheets_of(wall, settings));
  }
  sight_.walls().look(joined(walls, linings_), joined(sheets_, lining_sheets_), faces, settings, reach);
}

void WallImages::see_past_walls(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls,
                                const Particles& particles, std::span<const ParticleRange> ranges, double reach) {
  find_shown(particles);
  if (linings_.empty()) {
    sight_.see(reach, walls, faces, settings, feet_, particles.size(), shown_, glasses_);
    return;
  }
  const std::vector<Footprint> alone = [&] {
    std::vector<Footprint> all;
    for (const MirrorWall& wall : linings_) all.emplace_back(wall.position.size());
    return all;
  }();
  const SeenMirrors seen(linings_, alone, lining_sheets_, settings.symmetry.axis, settings.lattice.spacing);
  const int first = int(walls.size());
  std::vector<ParticleRange> near(ranges.begin(), ranges.end());
  for (ParticleRange& range : near) range.depth = reach;
  std::vector<WallFoot> feet =
      find_feet(linings_, seen, particles, near, 0.5 * settings.lattice.spacing,
                [&](int wall, int face) { return open_edges(first + wall, face, lining_sheets_[wall]); });
  for (WallFoot& foot : feet) foot.wall += first;
  feet.insert(feet.end(), feet_.begin(), feet_.end());
  sight_.see(reach, joined(walls, linings_), faces, settings, feet, particles.size(), shown_, glasses_);
}

unsigned WallImages::open_edges(int wall, int face, const Sheets& sheets) const {
  return (sight_.is_thin(wall) ? sheets.open(face) : 0u) | sheets.goes_on(face);
}

void WallImages::find_shown(const Particles& particles) {
  shown_.resize(images_.size());
  glasses_.clear();
  std::vector<SeenImage::Glass> chain;
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    chain.clear();
    Vec3 before = place_of(particles, images_[c].owner);  // where the next mirror's object stands
    for_each_mirror(c, [&](const Image& image) {
      if (image.foot >= 0) {
        chain.push_back({feet_[image.foot].wall, feet_[image.foot].face, before, image.normal});
      } else {
        for (SeenImage::Glass& glass : chain)
          if (image.normal.isZero()) {
            glass.shown += image.place - before;
          } else {
            glass.shown = reflected(glass.shown, image.normal) + (image.place + before).dot(image.normal) * image.normal;
            glass.normal = reflected(glass.normal, image.normal);
          }
      }
      before = image.place;
    });
    const std::uint32_t first = std::uint32_t(glasses_.size());
    glasses_.insert(glasses_.end(), chain.rbegin(), chain.rend());
    shown_[slot_[c]] = {images_[c].owner, first, std::uint32_t(glasses_.size())};
  }
}

void WallImages::see_first_places(const Settings& settings, const std::vector<MirrorWall>& walls) {
  while (footprints_.size() < walls.size()) {
    const MirrorWall& wall = walls[footprints_.size()];
    const double width = smoothing_length(settings, settings.lattice.spacing);
    if (wall.radiates()) footprints_.emplace_back(wall.position.size());
    else if (wall.rigid) footprints_.emplace_back();
    else footprints_.emplace_back(wall.faces, wall.position, width, settings.symmetry.axis, settings.axisymmetric);
    sheets_.push_back(wall.radiates() ? Sheets() : sheets_of(wall, settings));
  }
}

void WallImages::add_range(const ParticleRange& range, const Particles& particles, const SeenMirrors& seen,
                           const SlipFaces& faces, const std::vector<MirrorWall>& walls, const Settings& settings) {
  if ((feet_.empty() && faces.empty()) || range.depth <= 0.0) return;
  found_.resize(std::size_t(omp_get_max_threads()));
  for (std::vector<Image>& part : found_) part.clear();
#pragma omp parallel
  {
    std::vector<Image>& mine = found_[omp_get_thread_num()];
#pragma omp for schedule(static)
    for (std::uint32_t i = range.first; i < range.last; ++i)
      add_images_of(i, particles, seen, faces, walls, range.depth, settings, mine);
  }
  for (std::vector<Image>& part : found_) {
    const int before = int(images_.size());
    if (before == 0) images_.swap(part);
    else
      for (Image image : part) {
        if (image.parent >= 0) image.parent += before;
        images_.push_back(image);
      }
  }
}

namespace {
/// The face across an axis behind which a place has its image.
int face_behind(int axis, const Vec3& place, const Vec3& image) { return 2 * axis + (image[axis] > place[axis]); }
}  // namespace

void WallImages::add_images_of(std::uint32_t i, const Particles& particles, const SeenMirrors& seen, const SlipFaces& faces,
                               const std::vector<MirrorWall>& walls, double depth, const Settings& settings,
                               std::vector<Image>& images) const {
  const Vec3 x = place_of(particles, i);
  const auto first =
      std::lower_bound(feet_.begin(), feet_.end(), i, [](const WallFoot& a, std::uint32_t k) { return a.particle < k; });
  if ((first == feet_.end() || first->particle != i) && !may_show(faces, x, depth)) return;
  const std::size_t mark = images.size();
  const auto each = [&](auto visit) {  // the particle and the images that it has so far
    const std::size_t count = images.size();
    visit(x, -1);
    for (std::size_t k = mark; k < count; ++k) visit(Vec3(images[k].place), int(k));
  };
  // A ring's volume is also as its radius.
  const auto further = [&](const Vec3& place, const Vec3& from) { return settings.axisymmetric ? place[0] / from[0] : 1.0; };
  const auto add = [&](const Reflection& image, const Vec3& from, int parent, int face) {
    images.push_back({.owner = i,
                      .parent = parent,
                      .foot = -1,
                      .stretch = image.stretch * further(image.place, from),
                      .place = image.place,
                      .normal = image.normal,
                      .wall_velocity = Vec3::Zero(),
                      .face = face});
  };
  const auto add_feet = [&](bool radiating) {
    for (auto foot = first; foot != feet_.end() && foot->particle == i; ++foot) {
      if (foot->at.distance <= 0.0 || walls[foot->wall].radiates() != radiating) continue;
      const WallPoint wall = seen.point(*foot);
      const Vec3 place = wall.foot + foot->at.distance * wall.normal;
      if (radiating) mirror_in_radiating(*foot, wall, settings, mark, images);
      images.push_back({.owner = i,
                        .parent = -1,
                        .foot = int(foot - feet_.begin()),
                        .stretch = wall.stretch * further(place, x),
                        .place = place,
                        .normal = wall.normal,
                        .wall_velocity = wall.velocity,
                        .radiating = radiating,
                        .lead = wall.lead});
    }
  };
  add_feet(false);
  add_images_between(seen, depth, settings, mark, images);
  add_feet(true);
  for (const SlipFaces::Round& wall : faces.round)
    each([&](const Vec3& at, int parent) {
      if (wall.ends >= 0)
        images_about(wall, faces.plane[wall.ends], at, depth, settings.dimension,
                     [&](const Reflection& image, const Vec3& from, int of) {
                       const int axis = faces.plane[wall.ends].axis;
                       const bool in_end = std::abs(image.normal[axis]) == 1.0;
                       add(image, from, of < 0 ? parent : of, in_end ? face_behind(axis, from, image.place) : round_face);
                       return int(images.size()) - 1;
                     });
      else if (const auto image = image_in(wall, at, depth, settings.dimension)) add(*image, at, parent, round_face);
    });
  for (const SlipFaces::Pair& pair : faces.plane)
    if (!pair.of_cone)
      each([&](const Vec3& at, int parent) {
        images_in(pair, at, depth, settings.dimension,
                  [&](const Reflection& image) { add(image, at, parent, face_behind(pair.axis, at, image.place)); });
      });
}

void WallImages::add_images_between(const SeenMirrors& seen, double depth, const Settings& settings, std::size_t mark,
                                    std::vector<Image>& images) const {
  const std::size_t single = images.size();
  if (single < mark + 2) return;
  constexpr int most = 4;  // further mirrors, one after the other
  const auto add = [&](std::size_t parent, const Image& mirror) {
    Image image = mirror;
    const Vec3 place = images[parent].place;
    const double distance = (seen.point(feet_[mirror.foot]).foot - place).dot(mirror.normal);
    if (distance <= 0.0 || distance >= depth) return false;
    image.parent = int(parent);
    image.place = place + 2.0 * distance * mirror.normal;
    image.stretch = settings.axisymmetric ? image.place[0] / place[0] : 1.0;
    images.push_back(image);
    return true;
  };
  for (std::size_t a = mark; a < single; ++a)
    for (std::size_t b = mark; b < single; ++b) {
      const Image first = images[a], second = images[b];
      if (first.foot < 0 || second.foot < 0) continue;
      const WallFoot &foot = feet_[first.foot], &other = feet_[second.foot];
      if (foot.wall == other.wall && sheets_[foot.wall].sheet(foot.face) == sheets_[foot.wall].sheet(other.face)) continue;
      const double turned = first.normal.dot(second.normal);
      if (turned < -0.5) {
        std::size_t last = a;
        for (int k = 0; k < most && add(last, k % 2 == 0 ? second : first); ++k) last = images.size() - 1;
      } else if (turned < 0.5 && a < b && (foot.wall != other.wall || seen.face_each_other(foot, other))) {
        add(a, second);
      }
    }
}

void WallImages::mirror_in_radiating(const WallFoot& foot, const WallPoint& face, const Settings& settings, std::size_t mark,
                                     std::vector<Image>& images) const {
  for (std::size_t k = mark, count = images.size(); k < count; ++k) {
    bool meets = true;
    for (int c = int(k); c >= 0 && meets; c = images[c].parent)
      meets = feet_[images[c].foot].wall != foot.wall && std::abs(images[c].normal.dot(face.normal)) < 0.5;
    if (!meets) continue;
    Image image = images[k];
    image.parent = int(k);
    image.foot = int(&foot - feet_.data());
    image.place += 2.0 * foot.at.distance * face.normal;
    image.stretch = face.stretch * (settings.axisymmetric ? image.place[0] / images[k].place[0] : 1.0);
    image.normal = face.normal;
    image.wall_velocity = face.velocity;
    image.radiating = true;
    image.lead = face.lead;
    images.push_back(image);
  }
}

void WallImages::sort_from(std::uint32_t start, double width, CellList& cells) {
  const std::uint32_t end = std::uint32_t(images_.size());
  std::vector<double> place[3];
  for (int a = 0; a < 3; ++a) {
    place[a].resize(end);
    for (std::uint32_t k = start; k < end; ++k) place[a][k] = images_[k].place[a];
  }
  cells.build(place[0].data(), place[1].data(), place[2].data(), start, end, width);
  slot_.resize(end);
  for (auto* a : {&x_, &y_, &z_}) a->resize(end);
  for (std::uint32_t s = start; s < end; ++s) {
    const std::uint32_t c = cells.order()[s - start];
    slot_[c] = s;
    x_[s] = place[0][c], y_[s] = place[1][c], z_[s] = place[2][c];
  }
}

namespace {

/// Is a foot past one of these edges of its face?
bool is_past(const PatchPoint& at, unsigned edges) {
  return (edges & 1u && at.v < 0.0) || (edges & 2u && at.u > 1.0) || (edges & 4u && at.v > 1.0) || (edges & 8u && at.u < 0.0);
}

}  // namespace

WallShare WallImages::put_back(const Settings& settings, const SlipFaces& faces, const std::vector<MirrorWall>& walls,
                               Particles& particles, PointLoads& received) const {
  WallShare work = put_back_from_mirrors(settings, walls, particles, received);
  if (faces.empty()) return work;
  const double far = 3.0 * settings.lattice.spacing;
  struct Turned {
    std::size_t particle;
    int face;
    Vec3 lost;  // of its momentum [N s]
  };
  std::vector<Turned> all_turned;
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto turn_back = [&](const std::optional<Crossing>& crossed, int face) {
      if (!crossed) return;
      const Vec3 before(particles.vx[i], particles.vy[i], particles.vz[i]);
      turn(particles, i, *crossed, Vec3::Zero());
      const Vec3 lost = particles.mass[i] * (before - Vec3(particles.vx[i], particles.vy[i], particles.vz[i]));
#pragma omp critical
      all_turned.push_back({i, face, lost});
    };
    for (const SlipFaces::Round& wall : faces.round) turn_back(crossing(wall, place_of(particles, i), far), round_face);
    for (const SlipFaces::Pair& pair : faces.plane)
      if (is_beyond(pair, place_of(particles, i))) {
        const bool low = place_of(particles, i)[pair.axis] < pair.low;
        turn_back(crossing(pair, place_of(particles, i), far, settings.dimension), 2 * pair.axis + !low);
      }
  }
  std::stable_sort(all_turned.begin(), all_turned.end(),
                   [](const Turned& a, const Turned& b) { return a.particle < b.particle; });
  for (const Turned& each : all_turned) work.fixed[std::size_t(each.face)] += each.lost;
  return work;
}

WallShare WallImages::put_back_from_mirrors(const Settings& settings, const std::vector<MirrorWall>& walls, Particles& particles,
                                            PointLoads& received) const {
  if (feet_.empty()) return {};
  const SeenMirrors seen(walls, footprints_, sheets_, settings.symmetry.axis,
                         settings.lattice.spacing);  // walls may have moved since
  const double far = settings.lattice.spacing;
  PointLoads given = unloaded(walls);
  WallShare work;
  for (WallFoot foot : feet_) {
    const std::uint32_t i = foot.particle;
    if (foot.at.distance > far) continue;                                // farther than a step can take it
    if (foot.at.distance <= 0.0 && sight_.is_thin(foot.wall)) continue;  // it stands on the other side
    if (!seen.patch(foot.wall, foot.face).project(place_of(particles, i), far, foot.at) || foot.at.distance >= 0.0) continue;
    if (is_past(foot.at, sight_.is_thin(foot.wall) ? sheets_[foot.wall].open(foot.face) : 0u)) continue;  // beside the wall
    const WallPoint wall = seen.point(foot);
    const Vec3 before(particles.vx[i], particles.vy[i], particles.vz[i]);
    turn(particles, i, {wall.foot + foot.at.distance * wall.normal, wall.normal, wall.foot}, wall.velocity);
    const Vec3 lost = particles.mass[i] * (before - Vec3(particles.vx[i], particles.vy[i], particles.vz[i]));
    work.add(walls[foot.wall], lost.dot(wall.velocity));
    add_at(foot, walls, lost, given);
  }
  for (std::size_t w = 0; w < walls.size(); ++w) footprints_[w].spread(given[w], received[w]);
  return work;
}

void WallImages::forget() {
  feet_.clear();
  images_.clear();
  begin_.clear();
  shown_.clear();
  sight_.forget();
}

template <class Visit>
void WallImages::for_each_mirror(std::uint32_t c, Visit visit) const {
  int chain[longest_chain], length = 0;
  for (int k = int(c); k >= 0 && length < longest_chain; k = images_[k].parent) chain[length++] = k;
  while (length-- > 0) visit(images_[chain[length]]);
}

namespace {
/// How many images ahead rows are fetched that lie sorted by cell.
constexpr std::uint32_t ahead = 12;
}  // namespace

void WallImages::reflect_rows(const Particles& particles, const Vec3& gravity, const RingKernel* rings) {
  rows_.resize(images_.size());
  viscosity_.resize(particles.viscosity.empty() ? 0 : images_.size());
  gradients_.resize(particles.gradient.empty() ? 0 : images_.size());
  corrected_.resize(particles.corrected.empty() ? 0 : images_.size());
  ring_.resize(rings ? images_.size() : 0);
  sums_.assign(images_.size(), SumRow{});
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    if (c + ahead < images_.size()) __builtin_prefetch(&rows_[slot_[c + ahead]], 1);
    FluidRow row = particles.predicted[images_[c].owner];
    for_each_mirror(c, [&](const Image& image) {
      reflect(row, image.normal, image.wall_velocity, image.stretch);
      row.p += 2.0 * image.lead;
    });
    if (rings) ring_[slot_[c]] = ring_of(c, particles, *rings, row);
    row.p += row.rho * gravity.dot(images_[c].place - place_of(particles, images_[c].owner));
    rows_[slot_[c]] = row;
    if (!viscosity_.empty()) viscosity_[slot_[c]] = particles.viscosity[images_[c].owner];
  }
}

RingRow WallImages::ring_of(std::uint32_t c, const Particles& particles, const RingKernel& rings, FluidRow& row) const {
  const Image& image = images_[c];
  RingRow ring = particles.ring[image.owner];
  double r = particles.x[image.owner];
  for_each_mirror(c, [&](const Image& mirror) {
    // Of a wall's normal the part along the axis keeps the hoop; two mirrors that make a shift keep it where r stays.
    const double along = mirror.normal[1] * mirror.normal[1];
    ring.share *= mirror.normal.isZero() ? (mirror.place[0] == r ? 1.0 : 0.0) : along;
    r = mirror.place[0];
  });
  ring.slope *= ring.share;
  if (r != particles.x[image.owner]) {
    // The area as the volume, but for the radius.
    const FluidRow& owner = particles.predicted[image.owner];
    row.vz = owner.vz * (row.volume / owner.volume) * (particles.x[image.owner] / std::abs(r));
    ring.a = rings.at(r, row.h).a;
  }
  return ring;
}

void WallImages::reflect_gradients(const Particles& particles, const Vec3& gravity) {
  if (gradients_.empty() && corrected_.empty()) return;
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    const std::uint32_t owner = images_[c].owner;
    const Vec3 weight = particles.predicted[owner].rho * gravity;
    // What the weight makes of the pressure's slope is the same on both sides.
    const auto add_weight = [&](GradientRow& row, double sign) {
      for (int a = 0; a < 3; ++a) row.pressure[a] = float(row.pressure[a] + sign * weight[a]);
    };
    const auto through = [&](auto row, auto gradient) {
      add_weight(gradient(row), -1.0);
      for_each_mirror(
          c, [&](const Image& image) { image.radiating ? continue_through(row, image.normal) : reflect(row, image.normal); });
      add_weight(gradient(row), 1.0);
      return row;
    };
    if (!gradients_.empty())
      gradients_[slot_[c]] = through(particles.gradient[owner], [](GradientRow& row) -> GradientRow& { return row; });
    if (!corrected_.empty())
      corrected_[slot_[c]] = through(particles.corrected[owner], [](CorrectedRow& row) -> GradientRow& { return row.gradient; });
  }
}

WallShare WallImages::scatter(Particles& particles, const std::vector<MirrorWall>& walls, PointLoads& force) {
  std::vector<Left> on_wall(images_.size());
#pragma omp parallel for schedule(static)
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    if (c + ahead < images_.size()) {
      __builtin_prefetch(&sums_[slot_[c + ahead]]);
      __builtin_prefetch(&rows_[slot_[c + ahead]]);
    }
    // One thread takes all images of a particle, the images of images first.
    const std::uint32_t owner = images_[c].owner;
    if (c > 0 && images_[c - 1].owner == owner) continue;
    std::uint32_t end = c + 1;
    while (end < images_.size() && images_[end].owner == owner) ++end;
    for (std::uint32_t k = end; k-- > c;) on_wall[k] = scatter_one(k, particles);
  }
  WallShare power;
  PointLoads given = unloaded(walls);
  for (std::uint32_t c = 0; c < images_.size(); ++c) {
    power.radiating += on_wall[c].power;
    if (images_[c].foot < 0) {
      if (images_[c].face >= 0) power.fixed[std::size_t(images_[c].face)] += on_wall[c].force;
      continue;
    }
    const WallFoot& foot = feet_[images_[c].foot];
    add_at(foot, walls, on_wall[c].force, given);
    power.add(walls[foot.wall], on_wall[c].force.dot(images_[c].wall_velocity));
  }
  for (std::size_t w = 0; w < walls.size(); ++w) footprints_[w].spread(given[w], force[w]);
  return power;
}

WallImages::Left WallImages::scatter_one(std::uint32_t k, Particles& particles) {
  const Image& image = images_[k];
  const SumRow& given = sums_[slot_[k]];
  const Vec3 f(given.fx, given.fy, given.fz), back = image.stretch * reflected(f, image.normal);
  SumRow& to = image.parent < 0 ? particles.rate[image.owner] : sums_[slot_[image.parent]];
  to.fx += back[0], to.fy += back[1], to.fz += back[2];
  // The energy that compression takes up is that at the pressure of whom it shows.
  const double shown = image.parent < 0 ? particles.predicted[image.owner].p : rows_[slot_[image.parent]].p;
  to.compression += image.stretch * given.compression;
  to.heat += image.stretch * (given.heat + (rows_[slot_[k]].p - 2.0 * image.lead - shown) * given.compression);
  to.closing = std::max(to.closing, given.closing);
  const FluidRow& row = rows_[slot_[k]];
  return {row.volume * 2.0 * f.dot(image.normal) * image.normal, row.volume * given.compression * 2.0 * image.lead};
}

void WallImages::describe(PairInput& in) const {
  const void* second = viscosity_.data();
  if (!gradients_.empty()) second = gradients_.data();
  if (!corrected_.empty()) second = corrected_.data();
  in.images = {.x = x_.data(), .y = y_.data(), .z = z_.data(), .fluid = rows_.data(), .second = second, .rings = ring_.data()};
}

std::size_t WallImages::memory_bytes() const {
  std::size_t bytes = feet_.capacity() * sizeof(WallFoot) + images_.capacity() * sizeof(Image) +
                      slot_.capacity() * sizeof(slot_[0]) + (x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(double) +
                      rows_.capacity() * sizeof(FluidRow) + gradients_.capacity() * sizeof(GradientRow) +
                      corrected_.capacity() * sizeof(CorrectedRow) + viscosity_.capacity() * sizeof(ViscosityRow) +
                      ring_.capacity() * sizeof(RingRow) + sums_.capacity() * sizeof(SumRow);
  for (const CellList& cells : cells_) bytes += cells.memory_bytes();
  for (const std::vector<Image>& part : found_) bytes += part.capacity() * sizeof(Image);
  return bytes;
}

}  // namespace undex::sph
