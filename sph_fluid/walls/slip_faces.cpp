#include "sph_fluid/walls/slip_faces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "sph_fluid/walls/reflection.hpp"

namespace undex::sph {

SlipFaces slip_faces(const Settings& settings) {
  SlipFaces result;
  if (!mirrors_fluid(settings.numerics.scheme)) return result;
  for (const Wall& wall : settings.walls) {
    const auto slips = [&](const std::string& face) {
      const auto found = wall.faces.find(face);
      return found == wall.faces.end() || found->second == FaceCondition::free_slip;
    };
    const Bounds window = bounds(wall.container, settings.dimension);
    const auto add = [&](int axis, const std::string& low, const std::string& high) {
      // A symmetry plane stands in for what it cuts off.
      const bool cut = settings.symmetry.axis[axis] && window.low[axis] <= 0.0;
      const bool with_low = slips(low) && !cut, with_high = slips(high);
      if (!with_low && !with_high) return;
      const double low_at = cut ? 0.0 : with_low ? window.low[axis] : -1e300;
      const double high_at = with_high ? window.high[axis] : 1e300;
      result.plane.push_back({.axis = axis, .low = low_at, .high = high_at, .symmetric = cut, .window = window});
    };
    if (const auto* cylinder = std::get_if<Cylinder>(&wall.container)) {
      const bool ends = settings.dimension == 3;  // in the plane it has none
      if (slips("side"))
        result.round.push_back({.center = cylinder->center,
                                .radius = cylinder->radius,
                                .axis = cylinder->axis,
                                .low = ends ? cylinder->low : -1e300,
                                .high = ends ? cylinder->high : 1e300});
      if (ends) add(cylinder->axis, "low", "high");
    } else if (const auto* sphere = std::get_if<Sphere>(&wall.container)) {
      if (slips("side")) result.round.push_back({.center = sphere->center, .radius = sphere->radius});
    } else {
      for (int a = 0; a < settings.dimension; ++a) {
        const std::string name(1, "xyz"[a]);
        add(a, name + "_low", name + "_high");
      }
    }
  }
  return result;
}

double clearance(const SlipFaces& faces, const Bounds& box) {
  double least = 1e300;
  for (const SlipFaces::Pair& pair : faces.plane)
    least = std::min({least, pair.symmetric ? 1e300 : box.low[pair.axis] - pair.low, pair.high - box.high[pair.axis]});
  for (const SlipFaces::Round& wall : faces.round) {
    Vec3 away = (box.low - wall.center).cwiseAbs().cwiseMax((box.high - wall.center).cwiseAbs());
    if (wall.axis >= 0) away[wall.axis] = 0.0;
    least = std::min(least, wall.radius - away.norm());
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

std::optional<Reflection> image_in(const SlipFaces::Round& wall, const Vec3& x, double depth, int dimension) {
  if (!wall.is_beside(x, depth)) return {};
  const Vec3 away = wall.away(x);
  const double r = away.norm();
  if (r <= wall.radius - depth || r > wall.radius) return {};
  Reflection image;
  image.normal = away / r;
  const double behind = 2.0 * wall.radius - r;
  image.place = x + (behind - r) * image.normal;
  const double wider = behind / r;
  image.stretch = image_volume(wall.axis < 0 && dimension == 3 ? wider * wider : wider);
  return image;
}

std::optional<Crossing> crossing(const SlipFaces::Round& wall, const Vec3& x, double far) {
  if (!wall.is_beside(x, far)) return {};
  const Vec3 away = wall.away(x);
  const double r = away.norm();
  if (r <= wall.radius || r > wall.radius + far) return {};
  const Vec3 normal = away / r, foot = x - (r - wall.radius) * normal;
  return Crossing{foot - (r - wall.radius) * normal, normal, foot};
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
