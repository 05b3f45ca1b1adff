// What a scene says about a structure: geometry, mesh density, material, supports, wet faces. SI units.
#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "core/rigid_plane.hpp"
#include "core/vector.hpp"
#include "materials/solid.hpp"

namespace undex::fem {

/// Tube (or ring) about an axis. Every count is that of the full body: with symmetry planes that cut it, only the kept
/// part is meshed, with its share of the cells. Faces: "inner", "outer", "low", "high"; a face that a symmetry plane
/// cuts away has no name left.
struct TubeMesh {
  int axis = 2;
  Vec3 center = Vec3::Zero();                                    ///< a point on the axis [m]
  double inner_radius = 0, outer_radius = 0, low = 0, high = 0;  ///< [m]
  int cells_through = 2, cells_around = 64, cells_along = 64;
};
/// Solid round bar about an axis, a square core of cells inside rings. `cells_radial` counts the cells from the axis to
/// the rim (at least 2; the full turn then has 4 cells per core cell side). Faces: "side", "low", "high".
struct RodMesh {
  int axis = 2;
  Vec3 center = Vec3::Zero();            ///< a point on the axis [m]
  double radius = 0, low = 0, high = 0;  ///< [m]
  int cells_radial = 6, cells_along = 32;
};
/// Box of cells. Faces: "x_low", "x_high", "y_low", ...
struct PlateMesh {
  Vec3 low, high;  ///< [m]
  std::array<int, 3> cells{1, 1, 1};
};
/// Hexahedral mesh read by gmsh's .msh; faces are named by their physical (boundary) id as text: "1", "2", ...
struct GmshMesh {
  std::string path;
};
using Mesh = std::variant<TubeMesh, PlateMesh, GmshMesh, RodMesh>;

/// Nodes of a named face whose marked velocity components stay zero.
struct Support {
  std::string face;
  std::array<bool, 3> fixed{true, true, true};
};

/// Uniform pressure history on a face, piecewise linear in time (a structure alone under a prescribed load).
struct PressureLoad {
  std::string face;
  std::vector<double> time;      ///< [s], increasing
  std::vector<double> pressure;  ///< [Pa]; held constant outside the table
};

enum class ElementKind {
  hexahedron,  ///< full integration, one pressure a cell: for solid bodies
  shell        ///< solid shell for thin walls, one cell through them (tube or plate)
};

struct Settings {
  std::string name = "structure";
  Mesh mesh;
  ElementKind element = ElementKind::hexahedron;
  int points_through = 3;  ///< of shells: Gauss points through the thickness of a cell, 2 to 10
  materials::Solid material;
  std::vector<Support> supports;
  std::vector<int> symmetry_axes;      ///< planes through the origin; the part with x[axis] >= 0 is kept (a mesh
                                       ///< from gmsh must already be that part)
  std::vector<std::string> wet_faces;  ///< faces that touch water
  std::vector<PressureLoad> loads;
  std::vector<RigidPlane> planes;
  Vec3 initial_velocity = Vec3::Zero();  ///< [m/s]
  Vec3 gravity = Vec3::Zero();           ///< [m/s^2]
  double courant = 0.8;                  ///< share of the computed stable step that is used, in (0, 1]
  double linear_viscosity = 0.06;        ///< bulk viscosity against ringing of shocks, on compression only
  double quadratic_viscosity = 1.2;
};

}  // namespace undex::fem
