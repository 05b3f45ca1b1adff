#include "sph_fluid/walls/slip_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sph_fluid/walls/reflection.hpp"

namespace undex::sph {
namespace {

SlipFaces::Round side_of(const Cone& cone, bool has_ends) {
  const double wider = cone.high_radius - cone.low_radius, length = std::hypot(wider, cone.high - cone.low);
  return {.center = cone.center,
          .radius = cone.low_radius,
          .axis = cone.axis,
          .low = has_ends ? cone.low : -1e300,
          .high = has_ends ? cone.high : 1e300,
          .origin = cone.low,
          .sine = wider / length,
          .cosine = wider == 0.0 ? 1.0 : (cone.high - cone.low) / length};
}

/// A place beside a round wall: along the wall's normal the distance from the middle of a sphere, from the line through a cone's
/// axis at `origin`; the wall lies at `wall`.
struct Beside {
  Vec3 away;
  double r, across, along, wall;  ///< [m]; r: distance from the axis or the middle
};
Beside beside(const SlipFaces::Round& wall, const Vec3& x) {
  const Vec3 away = wall.away(x);
  const double r = away.norm(), past = wall.axis < 0 ? 0.0 : x[wall.axis] - wall.origin;
  return {.away = away,
          .r = r,
          .across = r * wall.cosine - past * wall.sine,
          .along = r * wall.sine + past * wall.cosine,
          .wall = wall.radius * wall.cosine};
}
/// The wall's, where r is not 0.
Vec3 normal_at(const SlipFaces::Round& wall, const Beside& place) {
  Vec3 normal = place.away / place.r * wall.cosine;
  if (wall.axis >= 0) normal[wall.axis] = -wall.sine;
  return normal;
}

/// The box of a container, without end where its faces radiate: they move, and the others go with them.
Bounds beyond_radiating(const Wall& wall, Bounds box) {
  const auto radiates = [&](const std::string& face) {
    const auto found = wall.faces.find(face);
    return found != wall.faces.end() && found->second == FaceCondition::radiating;
  };
  const auto* cylinder = std::get_if<Cylinder>(&wall.container);
  for (int a = 0; a < 3; ++a) {
    const std::string axis(1, "xyz"[a]), low = cylinder ? "low" : axis + "_low", high = cylinder ? "high" : axis + "_high";
    const bool side = cylinder && a != cylinder->axis;
    if (radiates(side ? "side" : low)) box.low[a] = -1e300;
    if (radiates(side ? "side" : high)) box.high[a] = 1e300;
  }
  return box;
}

/// In how many directions the wall is curved, as a scene of that dimension sees it.
int curved(const SlipFaces::Round& wall, int dimension) { return dimension - 1 - (wall.axis >= 0 && wall.axis < dimension); }

/// The faces whose condition is one of those.
SlipFaces faces_of(const Settings& settings, std::initializer_list<FaceCondition> conditions) {
  SlipFaces result;
  for (const Wall& wall : settings.walls) {
    const auto wanted = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      const FaceCondition condition = found == wall.faces.end() ? FaceCondition::free_slip : found->second;
      return std::find(conditions.begin(), conditions.end(), condition) != conditions.end();
    };
    const Bounds box = bounds(wall.container, settings.dimension), window = beyond_radiating(wall, box);
    const auto is_cut = [&](int axis) { return settings.symmetry.axis[axis] && box.low[axis] <= 0.0; };
    const auto add = [&](int axis, const std::string& low, const std::string& high) {
      // A symmetry plane stands in for what it cuts off.
      const bool cut = is_cut(axis), with_low = wanted(low) && !cut, with_high = wanted(high);
      if (!with_low && !with_high) return;
      const double low_at = cut ? 0.0 : with_low ? box.low[axis] : -1e300;
      const double high_at = with_high ? box.high[axis] : 1e300;
      result.plane.push_back({.axis = axis, .low = low_at, .high = high_at, .symmetric = cut, .window = window});
    };
    const auto add_cone = [&](const Cone& cone) {
      const bool ends = cone.axis < settings.dimension;  // in a plane across its axis it has none
      const bool sides = settings.dimension > 1 || !ends;
      const std::size_t before = result.plane.size();
      if (ends) add(cone.axis, "low", "high");
      if (!sides || !wanted("side")) return;
      result.round.push_back(side_of(cone, ends));
      SlipFaces::Round& side = result.round.back();
      if (ends) side.low = window.low[cone.axis], side.high = window.high[cone.axis];
      if (side.sine == 0.0 || result.plane.size() == before) return;
      side.ends = int(before);
      result.plane.back().of_cone = true;
      if (wanted("low") && !is_cut(cone.axis))
        side.edges.push_back({{cone.low_radius, cone.low}, {side.sine + 1.0, side.cosine}});
      if (wanted("high")) side.edges.push_back({{cone.high_radius, cone.high}, {1.0 - side.sine, -side.cosine}});
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&wall.container)) {
      add_cone({.axis = cylinder->axis,
                .center = cylinder->center,
                .low_radius = cylinder->radius,
                .high_radius = cylinder->radius,
                .low = cylinder->low,
                .high = cylinder->high});
    } else if (const auto* cone = std::get_if<Cone>(&wall.container)) {
      add_cone(*cone);
    } else if (const auto* sphere = std::get_if<Sphere>(&wall.container)) {
      if (wanted("side")) result.round.push_back({.center = sphere->center, .radius = sphere->radius});
    } else {
      for (int a = 0; a < settings.dimension; ++a) {
        const std::string name(1, "xyz"[a]);
        add(a, name + "_low", name + "_high");
      }
    }
  }
  return result;
}

}  // namespace

SlipFaces slip_faces(const Settings& settings) {
  if (!mirrors_fluid(settings.numerics.scheme)) return {};
  return faces_of(settings, {FaceCondition::free_slip});
}

SlipFaces lined_faces(const Settings& settings) {
  if (mirrors_fluid(settings.numerics.scheme)) return faces_of(settings, {FaceCondition::no_slip});
  return fixed_faces(settings);
}

SlipFaces fixed_faces(const Settings& settings) { return faces_of(settings, {FaceCondition::free_slip, FaceCondition::no_slip}); }

SlipFaces radiating_faces(const Settings& settings) {
  SlipFaces faces = faces_of(settings, {FaceCondition::radiating});
  for (SlipFaces::Pair& pair : faces.plane)
    if (pair.symmetric) pair.low = -1e300;  // nothing radiates at a symmetry plane
  return faces;
}

double clearance(const SlipFaces& faces, const Bounds& box) {
  double least = 1e300;
  for (const SlipFaces::Pair& pair : faces.plane)
    least = std::min({least, pair.symmetric ? 1e300 : box.low[pair.axis] - pair.low, pair.high - box.high[pair.axis]});
  for (const SlipFaces::Round& wall : faces.round) {
    Vec3 away = (box.low - wall.center).cwiseAbs().cwiseMax((box.high - wall.center).cwiseAbs());
    double narrower = 0.0;
    if (wall.axis >= 0) {
      away[wall.axis] = 0.0;
      narrower = std::min((box.low[wall.axis] - wall.origin) * wall.sine, (box.high[wall.axis] - wall.origin) * wall.sine);
    }
    least = std::min(least, wall.radius * wall.cosine - (away.norm() * wall.cosine - narrower));
  }
  return std::max(least, 0.0);
}

Vec3 SlipFaces::Round::away(const Vec3& x) const {
  Vec3 result = x - center;
  if (axis >= 0) result[axis] = 0.0;
  return result;
}

bool SlipFaces::Round::is_beside(const Vec3& x, double beyond) const {
  return axis < 0 || (x[axis] >= low - beyond && x[axis] <= high + beyond);
}

bool SlipFaces::Round::shows(const Vec3& x) const {
  const Eigen::Vector2d place(away(x).norm(), axis < 0 ? 0.0 : x[axis]);
  return std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) { return (place - edge.at).dot(edge.side) > 0.0; });
}

bool SlipFaces::end_before(const Vec3& x, double far, int dimension) const {
  return std::any_of(plane.begin(), plane.end(),
                     [&](const Pair& pair) { return crossing(pair, x, far, dimension).has_value(); }) ||
         std::any_of(round.begin(), round.end(), [&](const Round& wall) { return crossing(wall, x, far).has_value(); });
}

bool SlipFaces::hold(const Vec3& a, const Vec3& b, double tolerance) const {
  const auto in_plane = [&](int axis, double at) { return std::max(std::abs(a[axis] - at), std::abs(b[axis] - at)) < tolerance; };
  const auto beyond = [](const Round& wall, const Vec3& x) {
    const Beside place = beside(wall, x);
    return std::abs(place.across - place.wall);
  };
  return std::any_of(plane.begin(), plane.end(),
                     [&](const Pair& pair) { return in_plane(pair.axis, pair.low) || in_plane(pair.axis, pair.high); }) ||
         std::any_of(round.begin(), round.end(),
                     [&](const Round& wall) { return std::max(beyond(wall, a), beyond(wall, b)) < tolerance; });
}

std::optional<Reflection> image_in(const SlipFaces::Round& wall, const Vec3& x, double depth, int dimension) {
  if (!wall.is_beside(x, depth)) return {};
  const Beside here = beside(wall, x);
  if (here.across <= here.wall - depth || here.across > here.wall || here.r <= 0.0) return {};
  const double behind = 2.0 * here.wall - here.across;
  Reflection image;
  image.normal = normal_at(wall, here);
  image.place = x + (behind - here.across) * image.normal;
  const double wider = (behind * wall.cosine + here.along * wall.sine) / here.r;
  const int times = curved(wall, dimension);
  if (times > 0) image.stretch = image_volume(times == 2 ? wider * wider : wider);
  return image;
}

std::optional<Crossing> crossing(const SlipFaces::Round& wall, const Vec3& x, double far) {
  if (!wall.is_beside(x, far)) return {};
  const Beside here = beside(wall, x);
  const double beyond = here.across - here.wall;
  if (beyond <= 0.0 || beyond > far || here.r <= 0.0) return {};
  const Vec3 normal = normal_at(wall, here), foot = x - beyond * normal;
  return Crossing{foot - beyond * normal, normal, foot};
}

std::optional<Crossing> crossing(const SlipFaces::Pair& faces, const Vec3& x, double far, int dimension) {
  const double at = x[faces.axis];
  if (!is_beyond(faces, x)) return {};
  for (int a = 0; a < dimension; ++a)
    if (a != faces.axis && (x[a] < faces.window.low[a] - far || x[a] > faces.window.high[a] + far)) return {};
  const double face = at < faces.low ? faces.low : faces.high;
  if (std::abs(at - face) > far) return {};
  Crossing crossed{x, Vec3::Zero(), x};
  crossed.place[faces.axis] = 2.0 * face - at;
  crossed.normal[faces.axis] = 1.0;
  crossed.foot[faces.axis] = face;
  return crossed;
}

}  // namespace undex::sph
