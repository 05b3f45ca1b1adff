// The lattice, and gravity across symmetry planes.
#include "scene/validator.hpp"

namespace undex::scene {

void Validator::gravity() {
  if (fluid_.gravity.isZero()) return;
  // A plane that cuts nothing is a wall; there the image may fall the other way.
  const auto cut = [&](int a) {
    for (const Structure& each : structures_)
      if (each.shape && each.shape->extent().low[a] < -tolerance()) return true;
    for (const Part& part : parts_)
      if (part.shape_good && bounds(*part.shape, dimension_).low[a] < -tolerance()) return true;
    return false;
  };
  for (int a = 0; a < 3; ++a)
    if (fluid_.symmetry.axis[a] && fluid_.gravity[a] != 0 && cut(a))
      complain(draft_.root, "gravity",
               std::string("gravity is not its own mirror image across the symmetry plane ") + "xyz"[a] +
                   " = 0, which cuts a body; leave that plane out, or that component of gravity");
}

void Validator::lattice() {
  const sph::Lattice& lattice = fluid_.lattice;
  if (const Node* scheme = draft_.root.find("scheme");
      scheme && fluid_.numerics.precision == sph::Precision::mixed && draft_.spacing_good && lattice.spacing < 2e-5)
    complain(*scheme, "precision",
             "scheme.precision = \"mixed\" needs a resolution.spacing of at least 2e-05 m: finer lengths leave the range of "
             "single precision; take \"full\"");
  const Node* node = draft_.root.find("resolution");
  if (!node) return;
  const bool rings = lattice.type == sph::LatticeType::rings;
  if (!lattice.rotation.isZero() && (rings || !lattice.fit.empty() || dimension_ == 1) && draft_.dimension_good)
    complain(*node, "rotation",
             std::string("resolution.rotation turns a Cartesian lattice that is not fitted, in 2D and 3D; leave out ") +
                 (dimension_ == 1 ? "rotation"
                  : rings         ? "lattice = \"rings\""
                                  : "fit") +
                 " or rotation");
  if (rings && dimension_ == 1 && draft_.dimension_good)
    complain(*node, "lattice", "resolution.lattice = \"rings\" needs dimension = 2 or 3; take \"cartesian\"");
  if (lattice.fit.empty()) {
    if (rings)
      complain(*node, "lattice", "resolution.lattice = \"rings\" needs a round body or wall to fit; add fit = \"its name\"");
    return;
  }
  std::vector<std::string> known;
  const Primitive* fitted = nullptr;
  for (const sph::Body& body : fluid_.bodies) {
    known.push_back(body.name);
    if (body.name == lattice.fit) fitted = &body.shape.base;
  }
  for (const sph::Wall& wall : fluid_.walls) {
    known.push_back(wall.name);
    if (wall.name == lattice.fit) fitted = &wall.container;
  }
  if (!fitted) {
    complain(*node, "fit", "resolution.fit: no body or wall '" + lattice.fit + "'" + suggestion(lattice.fit, known));
  } else if (rings && !std::holds_alternative<Cylinder>(*fitted) && !std::holds_alternative<TubeShape>(*fitted) &&
             !std::holds_alternative<Sphere>(*fitted)) {
    complain(*node, "fit",
             "resolution.fit: rings need something round, and '" + lattice.fit +
                 "' is not a cylinder, tube or sphere; take lattice = \"cartesian\"");
  }
}

}  // namespace undex::scene
