// Structures and solids in particles: wet faces, halves, motion at symmetry planes, rigid planes.
#include "scene/validator.hpp"

namespace undex::scene {

void Validator::structure() {
  if (!draft_.structure_node || dimension_ != 3) return;
  const Node& node = *draft_.structure_node;
  const fem::Settings& structure = *scene_.structure;
  if (solid_ && solid_->built_in()) halved("structure", node, *solid_->built_in());
  if (solid_ && solid_->mesh()) pieces();
  const bool fluid = !fluid_.bodies.empty();
  if (fluid && structure.wet_faces.empty())
    complain(node, "wet",
             "structure.wet is empty, so the water does not see the structure; name the faces that it touches, "
             "e.g. wet = [\"" +
                 (solid_ && solid_->mesh() ? solid_->faces(fluid_.symmetry.axis).back() : std::string("inner")) + "\"]");
  if (draft_.body_nodes.empty() && !structure.wet_faces.empty())
    complain(node, "wet", "structure.wet names faces, but the scene has no [[bodies]]; add the water or leave out wet");
  if (fluid && solid_ && draft_.spacing_good && all_usable())
    for (const std::string& face : structure.wet_faces) wet_face("structure", node, solid_->face_points(face), face);
}

/// Pieces of a gmsh mesh that share no face move by themselves; nothing keeps them from passing through each other.
void Validator::pieces() {
  const HexahedralMesh& mesh = *solid_->mesh();
  const Node& node = *draft_.structure_node;
  const std::vector<int> piece = undex::pieces(mesh, JoinedBy::nodes);
  const int count = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
  if (count < 2) {
    const std::vector<int> parts = undex::pieces(mesh, JoinedBy::faces);
    if (const int most = *std::max_element(parts.begin(), parts.end()); most > 0)
      warn(node, "shape",
           "structure.shape: the mesh falls into " + std::to_string(most + 1) +
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
  const double thickness = solid_->thickness();
  const std::string what = "structure.shape: the mesh is in " + std::to_string(count) +
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
  const std::string what = path == "structure" ? "structure" : "solid";
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
                 rounded(high) + " m); centre the whole " + (path == "structure" ? "structure" : "solid") + " on the plane");
  }
}

}  // namespace undex::scene
