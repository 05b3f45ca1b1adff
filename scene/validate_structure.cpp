// Structures and solids in particles: wet faces, halves, motion at symmetry planes, rigid planes.
#include "scene/validator.hpp"

namespace undex::scene {

void Validator::structures() {
  if (dimension_ != 3) return;
  for (const Structure& each : structures_) structure(each);
  for (std::size_t later = 0; later < structures_.size(); ++later)
    for (std::size_t first = 0; first < later; ++first) apart(structures_[first], structures_[later]);
}

void Validator::structure(const Structure& one) {
  const Node& node = *one.node;
  const std::optional<StructureShape>& shape = one.shape;
  if (shape && shape->built_in()) halved(one.path, node, *shape->built_in());
  if (shape && shape->mesh()) pieces(one);
  const bool fluid = !fluid_.bodies.empty();
  if (fluid && one.settings->wet_faces.empty())
    complain(node, "wet",
             one.path + ".wet is empty, so the water does not see the structure; name the faces that it touches" +
                 (shape ? faces_at_water(*shape) : std::string()));
  if (draft_.body_nodes.empty() && !one.settings->wet_faces.empty())
    complain(node, "wet", one.path + ".wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
  if (fluid && shape && draft_.spacing_good && all_usable())
    for (const std::string& face : one.settings->wet_faces) {
      wet_face(one.path, node, shape->face_points(face), face);
      faces_water(one, face);
    }
}

/// ", e.g. ...": the faces that lie at the water for the most part, or all that there are.
std::string Validator::faces_at_water(const StructureShape& shape) const {
  const std::vector<std::string> all = shape.faces(fluid_.symmetry.axis);
  std::string near_water;
  for (const std::string& face : all) {
    const std::vector<Vec3> points = shape.face_points(face);
    if (!draft_.spacing_good || !all_usable()) continue;
    // A face that meets the water at an edge alone is beside it.
    std::size_t kept = 0, wet = 0;
    for (const Vec3& x : points) {
      if (!in_kept_part(x)) continue;
      ++kept;
      if (distance_to_water(x) < 0.5 * fluid_.lattice.spacing) ++wet;
    }
    const bool touches = 2 * wet > kept;
    if (touches) near_water += (near_water.empty() ? "" : ", ") + quoted(face);
  }
  return near_water.empty() ? "; its faces are " + listed(all) : ", e.g. wet = [" + near_water + "]";
}

/// Has a wet face its water behind it, on the other side of a thin wall?
void Validator::faces_water(const Structure& one, const std::string& face) {
  const std::vector<Vec3> points = one.shape->face_points(face);
  const double step = 0.1 * std::min(one.shape->thickness(), fluid_.lattice.spacing);
  constexpr std::size_t most = 60;
  bool behind = false;
  for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / most) {
    const Vec3& x = points[k];
    if (!in_kept_part(x) || distance_to_water(x) > near()) continue;
    const Vec3 out = -gradient(one.depth(), x, 0.1 * step, 3);
    if (!(out.norm() > 0.5)) continue;  // on an edge
    if (distance_to_water(x + step * out.normalized()) < distance_to_water(x - step * out.normalized())) return;
    behind = true;
  }
  if (behind)
    complain(*one.node, "wet",
             one.path + ".wet: the face '" + face +
                 "' looks away from the water, which lies behind it; name the face on the other side of the wall");
}

/// Structures do not overlap, and nothing holds those together that touch.
void Validator::apart(const Structure& first, const Structure& later) {
  if (!first.shape || !later.shape) return;
  const double thinnest = std::min(first.shape->thickness(), later.shape->thickness()), touching = 1e-3 * thinnest;
  const Bounds beside = later.shape->extent();
  const Bounds window = common(common(kept_, first.shape->extent()), beside);
  if (const auto at = find_in_both(first.depth(), later.depth(), window, touching, 3)) {
    complain(*later.node, "shape", later.path + " overlaps " + first.path + ", e.g. at " + text(*at, 3) + " m; move one of them");
    return;
  }
  const auto touches = [&](const Structure& one, const Structure& other) -> std::optional<Vec3> {
    const Depth depth = other.depth();
    for (const std::string& face : one.shape->faces({false, false, false}))
      for (const Vec3& x : one.shape->face_points(face))
        if (in_kept_part(x) && std::abs(depth(x)) < touching) return x;
    return std::nullopt;
  };
  std::optional<Vec3> at = touches(first, later);
  if (!at) at = touches(later, first);
  if (at)
    warn(*later.node, "shape",
         later.path + " touches " + first.path + ", e.g. at " + text(*at, 3) +
             " m, and nothing holds them together or keeps them from passing through each other; leave a gap, or write them as "
             "one mesh");
}

/// Pieces of a gmsh mesh that share no face move by themselves; nothing keeps them from passing through each other.
void Validator::pieces(const Structure& one) {
  const HexahedralMesh& mesh = *one.shape->mesh();
  const Node& node = *one.node;
  const std::vector<int> piece = undex::pieces(mesh, JoinedBy::nodes);
  const int count = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
  if (count < 2) {
    const std::vector<int> parts = undex::pieces(mesh, JoinedBy::faces);
    if (const int most = *std::max_element(parts.begin(), parts.end()); most > 0)
      warn(node, "shape",
           one.path + ".shape: the mesh falls into " + std::to_string(most + 1) +
               " parts that hang together by edges or corners only, as by hinges; join them by faces if that is not meant");
    return;
  }
  // The gap between the first piece and what is nearest to it, from the nodes of the others.
  auto first = std::make_shared<HexahedralMesh>();
  first->nodes = mesh.nodes;
  std::vector<int> of_node(mesh.nodes.size(), -1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    for (const int corner : mesh.cells[c]) of_node[static_cast<std::size_t>(corner)] = piece[c];
    if (piece[c] == 0) first->cells.push_back(mesh.cells[c]);
  }
  for (const auto& face : mesh.faces)
    if (of_node[static_cast<std::size_t>(face.nodes[0])] == 0) first->faces.push_back(face);
  const MeshDistance distance(first);
  double gap = 1e300;
  Vec3 at = Vec3::Zero();
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (of_node[i] != 0)
      if (const double here = distance.signed_distance(mesh.nodes[i]); here < gap) {
        gap = here;
        at = mesh.nodes[i];
      }
  const double thickness = one.shape->thickness();
  const std::string what = one.path + ".shape: the mesh is in " + std::to_string(count) +
                           " pieces that share no node; the first and the next are " + rounded(std::max(gap, 0.0)) +
                           " m apart at " + text(at, 3) + " m";
  if (gap < 0.01 * thickness)
    complain(node, "shape",
             what +
                 " and touch or overlap, but nothing holds them together: join them in the mesh (gmsh: "
                 "Coherence, or fragments before meshing)");
  else warn(node, "shape", what + ": each moves by itself, and nothing keeps them from passing through each other");
}

void Validator::wet_face(const std::string& path, const Node& node, const std::vector<Vec3>& points, const std::string& face) {
  double nearest = points.empty() ? 0.0 : 1e300;
  for (const Vec3& x : points)
    if (in_kept_part(x)) nearest = std::min(nearest, distance_to_water(x));
  const std::string what = path.starts_with("structure") ? "structure" : "solid";
  if (nearest > near())
    complain(node, "wet",
             path + ".wet: the face '" + face + "' touches no water: no body comes within two spacings (" + rounded(near()) +
                 " m) of it, the nearest is " + rounded(nearest) + " m away; move the water or the " + what +
                 ", or leave the face out");
  else if (nearest > 0.5 * near())
    warn(node, "wet",
         path + ".wet: the water begins " + rounded(nearest) + " m from the face '" + face + "', more than a spacing (" +
             rounded(fluid_.lattice.spacing) + " m): the gap is closed by a slam; let them touch");
}

void Validator::solids() {
  const bool fluid = !draft_.body_nodes.empty();
  for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
    if (!usable_[fluid_.bodies.size() + i]) continue;
    const solid::Body& solid = scene_.solids.bodies[i];
    const Node& node = *draft_.solid_nodes[i];
    const std::string path = "solids." + solid.name;
    halved(path, node, solid.shape.base);
    const Bounds extent = bounds(solid.shape, dimension_);
    for (int a = 0; a < dimension_; ++a) {
      if (!fluid_.symmetry.axis[a] || extent.low[a] >= 0) continue;
      Vec3 mirrored = solid.spin;  // mirrors turn a spin about any other axis round
      mirrored[a] = 0;
      if (solid.velocity[a] != 0 || mirrored.norm() > 0) {
        complain(node, solid.velocity[a] != 0 ? "velocity" : "spin",
                 path + ": its motion is not its own mirror image across the symmetry plane " + "xyz"[a] +
                     " = 0; change the motion or leave the plane out");
      }
    }
    if (!solid.wet.empty() && !fluid)
      complain(node, "wet", path + ".wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
    if (fluid && solid.description == solid::Description::updated_lagrangian && (solid.material.spall || solid.material.damage))
      warn(node, "description", path + ": it may tear, but its wet faces do not: the water stays before them");
    const bool drawn = dimension_ == 3 || is_round(solid.shape.base, dimension_) || std::holds_alternative<Box>(solid.shape.base);
    if (fluid && drawn && draft_.spacing_good && all_usable())
      for (const std::string& face : solid.wet) wet_face(path, node, face_points(solid.shape.base, face), face);
  }
}

/// No solid may start beyond a rigid plane.
void Validator::planes() {
  for (std::size_t k = 0; k < scene_.solids.planes.size(); ++k) {
    const RigidPlane& plane = scene_.solids.planes[k];
    if (plane.axis >= dimension_) continue;
    for (std::size_t i = 0; i < scene_.solids.bodies.size(); ++i) {
      if (!usable_[fluid_.bodies.size() + i]) continue;
      const Bounds extent = common(kept_, bounds(scene_.solids.bodies[i].shape, dimension_));
      const double beyond = plane.body_above ? plane.position - extent.low[plane.axis] : extent.high[plane.axis] - plane.position;
      if (beyond > tolerance())
        complain(*draft_.plane_nodes[k], "position",
                 "planes." + std::to_string(k) + ": solids." + scene_.solids.bodies[i].name + " starts " + rounded(beyond) +
                     " m beyond the plane " + "xyz"[plane.axis] + " = " + rounded(plane.position) + ", whose free side is " +
                     (plane.body_above ? "above" : "below") + "; move one of them");
    }
  }
}

/// A symmetry plane that meets a structure or a solid must halve it.
void Validator::halved(const std::string& path, const Node& node, const Primitive& shape) {
  const Bounds extent = bounds(shape, dimension_);
  for (int axis = 0; axis < dimension_; ++axis) {
    const double low = extent.low[axis], high = extent.high[axis];
    const auto* cone = std::get_if<Cone>(&shape);
    const bool halves = !cone || cone->axis != axis || cone->low_radius == cone->high_radius;
    if (!fluid_.symmetry.axis[axis] || low >= 0 || (halves && std::abs(low + high) <= 1e-9 * (high - low))) continue;
    complain(node, "shape",
             path + ": the symmetry plane " + "xyz"[axis] + " = 0 does not halve it (it runs from " + rounded(low) + " to " +
                 rounded(high) + " m); centre the whole " + (path.starts_with("structure") ? "structure" : "solid") +
                 " on the plane");
  }
}

}  // namespace undex::scene
