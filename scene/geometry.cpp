#include "scene/geometry.hpp"

#include <cmath>
#include <filesystem>

#include "core/triangle_surface.hpp"
#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

/// Moves x along the gradient of a depth until it is `target` deep; exact for the smooth parts of a distance.
Vec3 moved_to(const Depth& depth, const Vec3& x, double at_x, double target, double probe, int dimension) {
  const Vec3 way = gradient(depth, x, probe, dimension);
  const double length = way.norm();
  return length > 0.1 ? Vec3(x + (target - at_x) / length * way / length) : x;
}

bool within(const Bounds& window, const Vec3& x, int dimension) {
  for (int a = 0; a < dimension; ++a)
    if (x[a] < window.low[a] || x[a] > window.high[a]) return false;
  return true;
}

}  // namespace

Vec3 gradient(const Depth& depth, const Vec3& x, double step, int dimension) {
  Vec3 slope = Vec3::Zero();
  for (int a = 0; a < dimension; ++a) slope[a] = (depth(x + step * Vec3::Unit(a)) - depth(x - step * Vec3::Unit(a))) / (2 * step);
  return slope;
}

NearDepth inside(const Shape& shape, int dimension) {
  return [&shape, dimension](const Vec3& x, double beyond) { return -signed_distance(shape, x, dimension, beyond); };
}
NearDepth outside(const Shape& shape, int dimension) {
  return [&shape, dimension](const Vec3& x, double beyond) { return signed_distance(shape, x, dimension, beyond); };
}

Bounds common(const Bounds& a, const Bounds& b) { return {a.low.cwiseMax(b.low), a.high.cwiseMin(b.high)}; }

Bounds kept_part(const std::array<bool, 3>& symmetric) {
  Bounds part{Vec3::Constant(-1e300), Vec3::Constant(1e300)};
  for (int a = 0; a < 3; ++a)
    if (symmetric[a]) part.low[a] = 0;
  return part;
}

std::optional<Vec3> find_in_both(const NearDepth& first, const NearDepth& second, const Bounds& window, double depth,
                                 int dimension) {
  Vec3 size = Vec3::Zero();
  for (int axis = 0; axis < dimension; ++axis) {
    size[axis] = window.high[axis] - window.low[axis];
    if (!(size[axis] > 0) || !(size[axis] < 1e100)) return std::nullopt;
  }
  const int along = dimension == 1 ? 2001 : dimension == 2 ? 121 : 25;  // odd: the middle is among them
  const int count[3] = {along, dimension > 1 ? along : 1, dimension > 2 ? along : 1};
  const double cell = size.norm() / along;
  const double probe = 1e-3 * cell, beyond = 2.1 * cell + 2.1 * depth;
  const auto a = [&](const Vec3& x) { return first(x, beyond); };
  const auto b = [&](const Vec3& x) { return second(x, beyond); };
  for (int i = 0; i < count[0]; ++i)
    for (int j = 0; j < count[1]; ++j)
      for (int k = 0; k < count[2]; ++k) {
        const int at[3] = {i, j, k};
        Vec3 x = Vec3::Zero();
        for (int axis = 0; axis < dimension; ++axis) x[axis] = window.low[axis] + (at[axis] + 0.5) / along * size[axis];
        const double in_a = a(x), in_b = b(x);
        if (in_a > depth && in_b > depth) return x;
        if (std::abs(in_a) < 2 * cell && in_b > -2 * cell) {
          const Vec3 under = moved_to(a, x, in_a, 2 * depth, probe, dimension);
          if (within(window, under, dimension) && a(under) > depth && b(under) > depth) return under;
        }
        if (std::abs(in_b) < 2 * cell && in_a > -2 * cell) {
          const Vec3 under = moved_to(b, x, in_b, 2 * depth, probe, dimension);
          if (within(window, under, dimension) && a(under) > depth && b(under) > depth) return under;
        }
      }
  return std::nullopt;
}

double longest(const Bounds& box, int dimension) {
  double most = 0;
  for (int a = 0; a < dimension; ++a) most = std::max(most, box.high[a] - box.low[a]);
  return most;
}

namespace {

/// The longest of the surfaces from files without a scale in a shape; null: none.
const Stl* unscaled(const Primitive& shape) {
  const Stl* found = nullptr;
  const auto look = [&](const std::vector<Primitive>& parts) {
    for (const Primitive& part : parts)
      if (const Stl* stl = unscaled(part); stl && (!found || longest(stl->read->bounds(), 3) > longest(found->read->bounds(), 3)))
        found = stl;
  };
  std::visit(
      [&]<class Type>(const Type& each) {
        if constexpr (std::is_same_v<Type, Stl>) found = each.read && each.scale == 1 ? &each : nullptr;
        else if constexpr (std::is_same_v<Type, Placed>) look(each.shape);
        else if constexpr (requires { each.shapes; }) look(each.shapes);
      },
      shape);
  return found;
}

}  // namespace

std::string in_millimetres(const Primitive& shape, double usual) {
  const Stl* stl = unscaled(shape);
  const double size = stl ? longest(stl->read->bounds(), 3) : 0.0;
  if (!(size > usual)) return "";
  return "; '" + std::filesystem::path(stl->file).filename().string() + "' is " + rounded(size) +
         " m long: is it in millimetres? Then write scale = 1e-3";
}

}  // namespace undex::scene
