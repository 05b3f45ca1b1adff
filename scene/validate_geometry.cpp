// Geometry of bodies, solids and walls: extents, subtractions, overlaps, containers.
#include "scene/opened.hpp"
#include "scene/validator.hpp"

namespace undex::scene {

/// Checks of one body or solid by itself; returns whether its geometry can be compared with others'.
bool Validator::part(const Part& one) {
  if (!one.shape_good) return false;
  const Shape& shape = *one.shape;
  const Node& node = *one.node;
  const std::string path = one.path();
  const Bounds extent = bounds(shape, dimension_);
  for (int a = 0; a < dimension_; ++a) {
    if (!(extent.high[a] - extent.low[a] < 1e200)) {
      complain(
          node, "shape",
          path + " has no end along " + "xyz"[a] + "; take a box" +
              (std::holds_alternative<Slab>(shape.base) ? " instead of a slab" : ", or cut one with it by \"intersection\""));
      return false;
    }
    if (fluid_.symmetry.axis[a] && extent.high[a] <= 0) {
      complain(node, "shape",
               path + " lies wholly at " + "xyz"[a] +
                   " <= 0, in the part that the symmetry plane leaves out; "
                   "move it to the other side");
      return false;
    }
  }
  if (draft_.spacing_good || one.spacing) {
    const double spacing = one.spacing.value_or(fluid_.lattice.spacing);
    const double thinnest = thickness(shape.base, dimension_);
    if (thinnest < spacing)
      complain(node, one.spacing ? "spacing" : "shape",
               path + " is " + rounded(thinnest) + " m at its thinnest, less than the spacing " + rounded(spacing) +
                   " m; make the spacing smaller or the body larger" +
                   (spacing > longest(extent, dimension_) ? " (is the spacing in mm?)" : ""));
  }
  const Bounds window = common(kept_, extent);
  const Shape base{shape.base, {}};
  for (std::size_t k = 0; k < shape.removed.size(); ++k) {
    const Shape removed{shape.removed[k], {}};
    if (!find_in_both(inside(base, dimension_), inside(removed, dimension_), window, 0, dimension_))
      complain(node, "subtract",
               path + ".subtract: the shape number " + std::to_string(k) +
                   " (from 0) does not meet the body, it removes nothing; correct it or leave it out" +
                   in_millimetres(shape.removed[k], longest(extent, dimension_)));
  }
  const NearDepth within = inside(shape, dimension_);
  if (!shape.removed.empty() && !find_in_both(within, within, window, 0, dimension_)) {
    std::string hint;
    for (std::size_t k = 0; k < shape.removed.size() && hint.empty(); ++k)
      hint = in_millimetres(shape.removed[k], longest(bounds(base, dimension_), dimension_));
    complain(node, "subtract", path + ": its subtractions leave nothing of it; make them smaller" + hint);
    return false;
  }
  return true;
}

void Validator::overlaps() {
  for (std::size_t j = 0; j < parts_.size(); ++j) {
    if (!usable_[j]) continue;
    const Part& later = parts_[j];
    const Bounds extent = common(kept_, bounds(*later.shape, dimension_));
    for (std::size_t i = 0; i < j; ++i) {
      if (!usable_[i]) continue;
      const Part& first = parts_[i];
      const Bounds window = common(extent, bounds(*first.shape, dimension_));
      if (const auto at =
              find_in_both(inside(*first.shape, dimension_), inside(*later.shape, dimension_), window, tolerance(), dimension_))
        complain(*later.node, "shape",
                 later.path() + " overlaps " + first.path() + ", e.g. at " + text(*at, dimension_) +
                     " m; move one, or write subtract = [\"" + later.name + "\"] in " + first.path());
    }
    for (const Structure& structure : structures_) {
      if (!structure.shape || dimension_ != 3) continue;
      const Bounds window = common(extent, structure.shape->extent());
      if (const auto at = find_in_both(structure.depth(), inside(*later.shape, 3), window, tolerance(), 3))
        complain(*later.node, "shape",
                 later.path() + " overlaps " + structure.named() + ", e.g. at " + text(*at, 3) +
                     " m; make it end at the structure's face, or take the structure's shape out of it (subtract)");
    }
  }
}

/// Where the images in a cone's side are not those of an exact mirror: at a symmetry plane that it meets, in its tip.
void Validator::conical(const Cone& cone, const std::string& path, const Node& node) {
  if (fluid_.symmetry.axis[static_cast<std::size_t>(cone.axis)] && cone.low <= 0)
    complain(node, "shape",
             path + ": the cone's side meets the symmetry plane " + "xyz"[cone.axis] +
                 " = 0 at a slant, where the images in both are not each other's; leave that plane out");
  if (!draft_.spacing_good) return;
  const double support = sph::with_kernel(fluid_.numerics.kernel, [](auto kernel) { return double(kernel.support); });
  const double reach = support * fluid_.numerics.eta * fluid_.lattice.spacing,
               narrow = std::min(cone.low_radius, cone.high_radius);
  if (narrow < reach * (1 - 1e-9))
    warn(
        node, "shape",
        path + ": the cone narrows to a radius of " + rounded(narrow) + " m, and the water's kernel reaches " + rounded(reach) +
            " m: in its tip water meets images across the axis, its pressure is off, and a slender tip may stop the run; end the "
            "cone where it is wider, or make the spacing smaller");
}

void Validator::walls() {
  for (std::size_t w = 0; w < fluid_.walls.size(); ++w)
    if (!draft_.wall_shape_good[w]) return;
  if (fluid_.walls.empty()) return;
  for (std::size_t w = 0; w < fluid_.walls.size(); ++w)
    if (const auto* cone = std::get_if<Cone>(&fluid_.walls[w].container); cone && cone->low_radius != cone->high_radius)
      conical(*cone, "walls." + fluid_.walls[w].name, *draft_.wall_nodes[w]);
  for (std::size_t i = 0; i < fluid_.bodies.size(); ++i) {
    if (!usable_[i]) continue;
    const sph::Body& body = fluid_.bodies[i];
    const Bounds window = common(kept_, bounds(body.shape, dimension_));
    std::optional<Vec3> out;
    bool contained = false;
    for (const sph::Wall& wall : fluid_.walls) {
      const auto open = [&](const std::string& face) {
        const auto found = wall.faces.find(face);
        return found != wall.faces.end() && found->second == sph::FaceCondition::open;
      };
      const Shape container{opened(wall.container, open), {}};
      const auto at =
          find_in_both(inside(body.shape, dimension_), outside(container, dimension_), window, tolerance(), dimension_);
      if (!at) contained = true;
      else if (!out) out = at;
    }
    if (contained) continue;
    std::vector<std::string> containers;
    for (const sph::Wall& wall : fluid_.walls) containers.push_back("'" + wall.name + "'");
    complain(*draft_.body_nodes[i], "shape",
             "bodies." + body.name + " reaches outside the wall " + listed(containers) + ", e.g. at " + text(*out, dimension_) +
                 " m; make it smaller or the wall larger");
  }
}

}  // namespace undex::scene
