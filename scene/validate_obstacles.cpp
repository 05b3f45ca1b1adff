// Rigid bodies in the water: what they are given, and where they stand.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/closed_surface.hpp"
#include "core/mass_properties.hpp"
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

using coupling::Motion;
using coupling::Obstacle;

constexpr double lightest = 0.01;  // of the water's density

std::string path_of(const Obstacle& obstacle) { return "obstacles." + obstacle.name; }

}  // namespace

void Validator::obstacles() {
  const auto& all = scene_.obstacles;
  if (all.empty()) return;
  if (draft_.body_nodes.empty()) {
    draft_.report.add(*draft_.obstacle_nodes[0],
                      "obstacles without [[bodies]]: add the water that they stand in, or remove them");
    return;
  }
  if (fluid_.numerics.scheme == sph::SchemeName::paper)
    draft_.report.add(*draft_.obstacle_nodes[0],
                      "[[obstacles]] are seen as mirrors, and scheme.name = \"paper\" has none; take another scheme");
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const Probe& probe : scene_.probes)
      if (probe.name == all[i].name)
        complain(*draft_.obstacle_nodes[i], "name",
                 path_of(all[i]) + ": a probe has the same name, and both would write history/" + probe.name +
                     ".csv; choose another name");
    if (draft_.obstacle_good[i]) draft_.obstacle_good[i] = has_size_of_water(all[i], *draft_.obstacle_nodes[i]);
    if (draft_.obstacle_good[i]) obstacle(all[i], *draft_.obstacle_nodes[i]);
  }
  if (!draft_.spacing_good || !all_usable()) return;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (draft_.obstacle_good[i]) room_for(i);
}

/// One far larger than all bodies of water together is in other units, and its mesh without end.
bool Validator::has_size_of_water(const Obstacle& one, const Node& node) {
  Bounds water;
  for (std::size_t i = 0; i < fluid_.bodies.size(); ++i)
    if (usable_[i]) water.include(bounds(fluid_.bodies[i].shape, dimension_));
  if (water.empty()) return true;
  const Bounds extent = bounds(one.shape, dimension_);
  const double size = longest(extent, dimension_), of_water = longest(water, dimension_);
  if (size <= most_lengths_of_water * of_water) return true;
  std::string remedy = in_millimetres(one.shape, of_water);
  if (remedy.empty()) remedy = ": is it in millimetres?";
  complain(node, "shape",
           path_of(one) + " is " + rounded(size) + " m long, " + rounded(std::round(size / of_water)) +
               " times as long as all bodies of fluid together" + remedy + (remedy.ends_with('?') ? "" : ".") +
               " Else cut it where the water cannot get to");
  return false;
}

/// What one is given, against itself.
void Validator::obstacle(const Obstacle& one, const Node& node) {
  const std::string path = path_of(one);
  if (one.condition == coupling::Skin::no_slip)
    complain(node, "condition",
             path + ".condition = \"no_slip\" is not built for obstacles, along which the water slips; take \"free_slip\"");
  driven(one, node, path);
  if (one.motion == Motion::free) weight(one, node, path);
  const Bounds extent = bounds(one.shape, dimension_);
  for (int a = 0; a < dimension_; ++a) {
    if (!fluid_.symmetry.axis[a]) continue;
    const std::string plane = std::string("the symmetry plane ") + "xyz"[a] + " = 0";
    const bool through_axis = scene_.meridian && a != scene_.meridian->axis;
    if (through_axis) continue;
    if (extent.high[a] <= 0) {
      complain(node, "shape", path + " lies wholly beyond " + plane + "; move it to the other side");
    } else if (extent.low[a] < -tolerance()) {
      Vec3 turn = one.spin;
      turn[a] = 0;
      if (one.velocity[a] != 0 || turn.norm() > 0)
        complain(node, one.velocity[a] != 0 ? "velocity" : "spin",
                 path + ": its motion is not its own mirror image across " + plane +
                     ", which cuts it; change it or leave the plane out");
      const bool told = one.motion == Motion::prescribed || !one.force.empty();
      if (told && one.direction[a] != 0)
        complain(node, "direction",
                 path + ".direction has a component across " + plane + ", which cuts it; leave out that component or the plane");
    } else if (extent.low[a] > tolerance()) {
      warn(node, "shape",
           path + " lies off " + plane + ": the whole scene has a mirror image of it; leave the plane out if one is meant");
    }
  }
}

/// Histories of speed and force, and motions that are held.
void Validator::driven(const Obstacle& one, const Node& node, const std::string& path) {
  const bool told = one.motion == Motion::prescribed;
  const std::vector<double>& values = told ? one.speed : one.force;
  const char* key = told ? "speed" : "force";
  if (told && values.empty())
    complain(
        node, "motion",
        path +
            ".motion = \"prescribed\" needs speed, time and direction, e.g. time = [0.0], speed = [10.0], direction = [1, 0, 0]");
  if (!values.empty() || !one.time.empty()) {
    if (values.size() != one.time.size())
      complain(node, key,
               path + ": time has " + std::to_string(one.time.size()) + " values and " + key + " " +
                   std::to_string(values.size()) + "; give as many of each");
    for (std::size_t k = 1; k < one.time.size(); ++k)
      if (!(one.time[k - 1] < one.time[k])) {
        complain(node, "time", path + ".time must increase: " + shortest(one.time[k]) + " follows " + shortest(one.time[k - 1]));
        break;
      }
    if (!(one.direction.head(dimension_).norm() > 0))
      complain(node, "direction", path + ".direction is needed with " + key + ", e.g. direction = [1, 0, 0]");
  }
  const std::vector<std::string> known{"x", "y", "z", "rx", "ry", "rz"};
  for (const std::string& word : one.fixed)
    if (std::find(known.begin(), known.end(), word) == known.end())
      complain(node, "fixed", path + ".fixed: '" + word + "' is none of " + listed(known));
  const auto held = [&](const std::string& word) {
    return std::find(one.fixed.begin(), one.fixed.end(), word) != one.fixed.end();
  };
  for (int a = 0; a < 3; ++a) {
    const std::string letter(1, "xyz"[a]);
    if (held(letter) && one.velocity[a] != 0)
      complain(node, "velocity", path + ".velocity has a component along " + letter + ", which `fixed` holds; leave one out");
    if (held("r" + letter) && one.spin[a] != 0)
      complain(node, "spin", path + ".spin has a component about " + letter + ", which `fixed` holds; leave one out");
  }
}

/// Mass and moments of inertia of a free body.
void Validator::weight(const Obstacle& one, const Node& node, const std::string& path) {
  if (one.mass.has_value() == one.density.has_value()) {
    complain(node, one.mass ? "mass" : "motion",
             path + ": a free body needs its density or its mass, one of them; e.g. density = 7800");
    return;
  }
  const double volume = mass_properties(one.shape, dimension_).volume;
  const double density = one.density ? *one.density : *one.mass / volume;
  for (const sph::Body& body : fluid_.bodies) {
    if (body.variable_h) continue;
    double water = 0;
    try {
      water = sph::start_density(body);
    } catch (const std::exception&) {
      continue;  // another check says why
    }
    if (density < lightest * water) {
      complain(node, one.mass ? "mass" : "density",
               path + " has a density of " + rounded(density) + " kg/m^3, less than a hundredth of that of bodies." + body.name +
                   " (" + rounded(water) + "): its steps would be tiny; make it heavier, or leave its place empty (subtract)");
      return;
    }
  }
  if (one.inertia.empty()) return;
  const std::size_t count = one.inertia.size();
  if (dimension_ == 2 ? count != 1 : count != 3 && count != 6) {
    complain(node, "inertia",
             path + ".inertia has " + std::to_string(count) + " values; it needs " +
                 (dimension_ == 2 ? "one, about z" : "three, [xx, yy, zz], or six, [xx, yy, zz, xy, yz, zx]"));
    return;
  }
  Mat3 tensor = Mat3::Identity();
  if (dimension_ == 2) tensor(2, 2) = one.inertia[0];
  else {
    for (int a = 0; a < 3; ++a) tensor(a, a) = one.inertia[std::size_t(a)];
    if (count == 6) {
      tensor(0, 1) = tensor(1, 0) = one.inertia[3];
      tensor(1, 2) = tensor(2, 1) = one.inertia[4];
      tensor(2, 0) = tensor(0, 2) = one.inertia[5];
    }
  }
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  const bool possible = dimension_ == 2 || principal[2] <= (principal[0] + principal[1]) * (1 + 1e-9);
  if (!(principal[0] > 0) || !possible)
    complain(node, "inertia",
             path +
                 ".inertia: no body has these moments; the principal ones must be positive, and none larger than the sum of the "
                 "other two");
}

/// Beside water, clear of solids and structure, and ahead of a plane wave.
void Validator::room_for(std::size_t index) {
  const Obstacle& one = scene_.obstacles[index];
  const Node& node = *draft_.obstacle_nodes[index];
  const std::string path = path_of(one);
  const Shape shape{one.shape, {}};
  const Bounds extent = bounds(shape, dimension_), window = common(kept_, extent);

  double nearest = 1e300;
  const auto look = [&](const Vec3& x) {
    if (in_kept_part(x)) nearest = std::min(nearest, distance_to_water(x));
  };
  const std::optional<WetSurface> surface = closed_surface(one.shape, fluid_.lattice.spacing, dimension_);
  if (!surface) {
    complain(node, "shape",
             path + ": " +
                 (has_one_face(one.shape) && dimension_ > 1
                      ? "its surface cannot be meshed with faces of a spacing: a part of it is thinner, or two are nearer "
                        "to each other; make the spacing smaller"
                      : std::string("a ") + name_of(one.shape) + " has no closed surface in " + std::to_string(dimension_) +
                            " dimensions; take another shape"));
    return;
  }
  for (const Vec3& x : surface->nodes) look(x);
  if (nearest > near())
    complain(
        node, "shape",
        path + " touches no water: no body comes within two spacings (" + rounded(near()) + " m) of it; move it or leave it out");

  for (std::size_t i = fluid_.bodies.size(); i < parts_.size(); ++i)
    if (const auto at =
            find_in_both(inside(*parts_[i].shape, dimension_), inside(shape, dimension_), window, tolerance(), dimension_))
      complain(node, "shape",
               path + " overlaps " + parts_[i].path() + ", e.g. at " + text(*at, dimension_) + " m; move one of them");
  for (const Structure& each : structures_) {
    if (!each.shape || dimension_ != 3) continue;
    if (const auto at = find_in_both(each.depth(), inside(shape, 3), common(window, each.shape->extent()), tolerance(), 3))
      complain(node, "shape", path + " overlaps " + each.named() + ", e.g. at " + text(*at, 3) + " m; move one of them");
  }
  if (scene_.start.kind == Start::Kind::plane_wave) {
    const Start::Wave& wave = scene_.start.wave;
    const double ahead = wave.upward ? extent.low[wave.axis] - wave.front : wave.front - extent.high[wave.axis];
    if (ahead < -tolerance())
      complain(node, "shape",
               path + " reaches " + rounded(-ahead) +
                   " m behind start.front: the wave would have passed it without meeting it; move the front or the obstacle");
  }
}

}  // namespace undex::scene
