// Walls thinner than the water's kernel reaches that do not hide what is behind them: rigid ones between two containers, and
// structures and solids with a dry face that has water before it. (Wet faces and obstacles hide it: sph_fluid/walls/sight.hpp.)
#include "scene/validator.hpp"

namespace undex::scene {
namespace {

constexpr std::size_t most_points = 4000;

/// The way from a point on a solid's surface straight through it [m], nothing where it is longer than `most`.
std::optional<double> way_through(const Depth& solid, const Vec3& x, const Vec3& inward, double most) {
  const double least = 1e-4 * most;
  double way = 10 * least;
  if (solid(x + way * inward) <= 0) return std::nullopt;
  while (way < most) {
    const double depth = solid(x + way * inward);
    if (depth <= 0) return way + depth;
    way += std::max(depth, least);
  }
  return std::nullopt;
}

}  // namespace

/// With the support R of the kernel and images in both faces, a particle before one face meets images of those before the other
/// up to a thickness of 2 R less a spacing (half a one for either).
void Validator::thin_walls() {
  if (fluid_.bodies.empty() || !draft_.spacing_good || !all_usable()) return;
  const auto mirrored = [&](Vec3 x) {
    for (int a = 0; a < dimension_; ++a)
      if (fluid_.symmetry.axis[a]) x[a] = std::abs(x[a]);
    return x;
  };
  const double support = sph::with_kernel(fluid_.numerics.kernel, [](auto kernel) { return double(kernel.support); });
  /// Spacing of the water at a point; nothing where there is none.
  const auto water_at = [&](const Vec3& x) -> std::optional<double> {
    std::optional<double> spacing;
    for (const sph::Body& body : fluid_.bodies) {
      const double own = body.spacing.value_or(fluid_.lattice.spacing);
      if (signed_distance(body.shape, x, dimension_) <= 0.25 * own) spacing = std::max(own, spacing.value_or(0));
    }
    return spacing;
  };
  double coarsest = fluid_.lattice.spacing;
  for (const sph::Body& body : fluid_.bodies) coarsest = std::max(coarsest, body.spacing.value_or(0));

  const auto look = [&](const Depth& solid, const std::vector<Vec3>& points, const std::string& who, const Node& node,
                        const std::string& remedy = {}) {
    const double reach = support * fluid_.numerics.eta, times = 2 * reach;  // in spacings
    const auto in_solid = [&](const Vec3& x) { return solid(mirrored(x)); };
    const std::size_t stride = 1 + points.size() / most_points;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      const Vec3& x = points[i];
      if (!in_kept_part(x)) continue;
      const Vec3 inward = gradient(in_solid, x, 1e-3 * coarsest, dimension_);
      if (std::abs(inward.norm() - 1) > 0.05) continue;  // an edge
      const auto way = way_through(in_solid, x, inward, times * coarsest);
      if (!way) continue;
      const auto before = water_at(mirrored(x - 0.5 * coarsest * inward));
      const auto behind = water_at(mirrored(x + (*way + 0.5 * coarsest) * inward));
      if (!before || !behind) continue;
      const double spacing = std::max(*before, *behind);
      if (*way >= times * spacing * (1 - 1e-3)) continue;
      const bool passes = *way < (times - 1) * spacing * (1 - 1e-3);
      const std::string message = who + " is " + rounded(*way) + " m thick at " + text(x, dimension_) +
                                  " m with water on both sides: the water's kernel reaches " + rounded(reach * spacing) +
                                  " m, so pressure " + (passes ? "passes" : "may pass") + " through it; " + remedy + "it needs " +
                                  rounded((times - 1) * spacing) + " m at least, better " + rounded(times * spacing) +
                                  " m, or a spacing of at most " + rounded(*way / (times - 1)) + " m";
      if (passes) complain(node, "shape", message);
      else warn(node, "shape", message);
      return;
    }
  };

  const auto is_dry = [](const std::vector<std::string>& wet, const std::string& face) {
    return !wet.empty() && std::find(wet.begin(), wet.end(), face) == wet.end();
  };
  for (const Structure& each : structures_) {
    if (!each.shape || dimension_ != 3) continue;
    for (const std::string& face : each.shape->faces({false, false, false}))
      if (is_dry(each.settings->wet_faces, face))
        look(each.depth(), each.shape->face_points(face), each.path, *each.node,
             "add its face '" + face + "' to " + each.path + ".wet; else ");
  }
  for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
    const auto& solid = scene_.solids.bodies[i];
    for (const std::string& face : shape_faces(solid.shape.base, dimension_, {false, false, false}))
      if (is_dry(solid.wet, face))
        look([&](const Vec3& x) { return -signed_distance(solid.shape, x, dimension_); }, face_points(solid.shape.base, face),
             "solids." + solid.name, *draft_.solid_nodes[i], "add its face '" + face + "' to wet; else ");
  }
  if (fluid_.walls.size() < 2 ||
      std::find(draft_.wall_shape_good.begin(), draft_.wall_shape_good.end(), false) != draft_.wall_shape_good.end())
    return;
  const Depth between = [&](const Vec3& x) {
    double least = 1e300;
    for (const sph::Wall& wall : fluid_.walls) least = std::min(least, signed_distance(wall.container, x, dimension_));
    return least;
  };
  for (std::size_t w = 0; w < fluid_.walls.size(); ++w) {
    const sph::Wall& wall = fluid_.walls[w];
    std::vector<Vec3> points;
    for (const auto& [face, condition] : wall.faces)
      if (condition != sph::FaceCondition::open)
        for (const Vec3& x : face_points(wall.container, face)) points.push_back(x);
    look(between, points, "the rigid wall beside walls." + wall.name, *draft_.wall_nodes[w]);
  }
}

}  // namespace undex::scene
