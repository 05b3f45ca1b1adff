// What a scene says about a structure: geometry, mesh density, material, supports, wet faces. SI units.
#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/radial_motion.hpp"
#include "core/record.hpp"
#include "core/rigid_plane.hpp"
#include "core/support.hpp"
#include "core/vector.hpp"
#include "fem_structure/meshes.hpp"
#include "materials/solid.hpp"

namespace undex::fem {

/// Uniform pressure history on a face, piecewise linear in time (a structure alone under a prescribed load).
struct PressureLoad {
  std::string face;
  std::vector<double> time;      ///< [s], increasing
  std::vector<double> pressure;  ///< [Pa]; held constant outside the table
};
template <class Visit>
void describe(PressureLoad& load, Visit&& visit) {
  visit(load.face, {.name = "face", .needed = true, .remedy = "name the loaded face", .values = "a face"});
  visit(load.time, {.name = "time", .unit = "s", .needed = true, .remedy = "give the times in s", .values = "increasing list"});
  visit(load.pressure, {.name = "pressure",
                        .unit = "Pa",
                        .needed = true,
                        .remedy = "give the pressures in Pa",
                        .values = "list, as many",
                        .meaning = "linear between the times, constant outside them"});
}

/// What a physical group of a gmsh mesh is made of, where that is not what the whole structure is.
struct Part {
  std::string group;
  std::optional<materials::Solid> material;  ///< none: the structure's
  std::optional<double> thickness;           ///< of shells [m]; none: the mesh's
  std::optional<ShellOffset> offset;         ///< of shells; none: the mesh's
};
template <class Visit>
void describe(Part& part, Visit&& visit) {
  visit(part.group, {.name = "group",
                     .needed = true,
                     .remedy = "name a physical group of volumes, of shells one of surfaces",
                     .values = "a group",
                     .meaning = "a physical group of the mesh: of volumes, of shells one of surfaces"});
  visit(ByHand{}, {.name = "material", .rule = "the structure's", .values = "a solid", .meaning = "see [materials](#materials)"});
  visit(part.thickness,
        {.name = "thickness", .unit = "m", .range = Range::length(), .rule = "that of `shape`", .meaning = "of shells"});
  visit(ByHand{}, {.name = "offset",
                   .rule = "that of `shape`",
                   .values = "\"mid\", \"top\", \"bottom\"",
                   .meaning = "of shells: where they lie from the quadrangles"});
}

struct Settings {
  std::string name = "structure";
  /// A body of revolution, computed in its meridian: positions and vectors are (distance from the axis, along the axis, 0), the
  /// axis of shapes and planes and the only symmetry axis is 1. Meshes are then rectangles of the meridian: a tube's counts
  /// through and along, a rod's radial and along; or gmsh's quadrangles (core/gmsh_file.hpp). Masses, forces and energies are
  /// those of whole rings. Said by the scene's dimension.
  bool axisymmetric = false;
  Mesh mesh;
  ElementKind element = ElementKind::hexahedron;
  int points_through = 3;     ///< of shells: Gauss points through the thickness of a cell, 2 to 10
  materials::Solid material;  ///< of all that `parts` do not name
  std::vector<Part> parts;    ///< of a gmsh mesh
  std::vector<Support> supports;
  std::vector<int> symmetry_axes;      ///< planes through the origin; the part with x[axis] >= 0 is kept (a mesh
                                       ///< from gmsh must already be that part)
  std::vector<std::string> wet_faces;  ///< faces that touch water
  std::vector<PressureLoad> loads;
  std::vector<RigidPlane> planes;
  Vec3 initial_velocity = Vec3::Zero();  ///< [m/s]
  std::optional<RadialMotion> radial;    ///< added to it
  Vec3 spin = Vec3::Zero();              ///< added too, about the middle of the mesh's extent [rad/s]
  bool moves() const { return !initial_velocity.isZero(0.0) || !spin.isZero(0.0) || radial; }
  Vec3 gravity = Vec3::Zero();     ///< [m/s^2]
  double start_time = 0;           ///< [s] when it begins to move
  double courant = 0.8;            ///< share of the computed stable step that is used, in (0, 1]
  double linear_viscosity = 0.06;  ///< bulk viscosity against ringing of shocks, on compression only
  double quadratic_viscosity = 1.2;
};
template <class Visit>
void describe(Settings& structure, Visit&& visit) {
  visit(structure.name, {.name = "name",
                         .rule = "\"structure\"; of one of several its number, from 0",
                         .form = Form::name,
                         .meaning = "in messages; of one of several in results too"});
  visit(ByHand{}, {.name = "shape",
                   .needed = true,
                   .remedy = "e.g. shape = {type = \"tube\", inner_radius = 0.04, outer_radius = 0.05, low = -0.1, high = 0.1}",
                   .values = "see below",
                   .meaning = "geometry, of the whole body"});
  visit(ByHand{},
        {.name = "cells", .rule = "from `cell_size`", .values = "see below", .meaning = "counts of cells, of the whole body"});
  visit(ByHand{}, {.name = "cell_size",
                   .unit = "m",
                   .range = Range::length(),
                   .rule = "half the thickness, a shell's whole; a sixth of a rod's radius",
                   .meaning = "largest size of a cell, in place of `cells`; of shells not through the wall"});
  visit(structure.element, {.name = "element", .meaning = "\"shell\": solid shells, one cell through a thin wall"});
  visit(structure.points_through, {.name = "points_through",
                                   .range = Range::between(2, 10),
                                   .meaning = "of shells: Gauss points through the thickness; 5 where plastic bending counts"});
  visit(ByHand{}, {.name = "material",
                   .needed = structure.parts.empty(),
                   .remedy = "e.g. material = \"al-5083-h116\" ('undex materials' lists them)",
                   .values = "a solid",
                   .meaning = "see [materials](#materials); not needed where `parts` name all groups of a mesh"});
  visit(ByHand{}, {.name = "parts",
                   .rule = "[]",
                   .values = "list of tables",
                   .meaning = "groups of a gmsh mesh with a material, or a thickness, of their own"});
  visit(ByHand{}, {.name = "supports", .rule = "[]", .values = "list of tables", .meaning = "held faces"});
  visit(structure.wet_faces,
        {.name = "wet", .values = "list of faces", .meaning = "those that the water touches; needed where there are bodies"});
  visit(ByHand{}, {.name = "loads", .rule = "[]", .values = "list of tables", .meaning = "pressure histories on faces"});
  visit(structure.initial_velocity, {.name = "velocity", .unit = "m/s", .meaning = "at the start"});
  visit(structure.spin, {.name = "spin",
                         .unit = "rad/s",
                         .form = Form::turn,
                         .meaning = "at the start, about the middle of its extent; added to `velocity`"});
  visit(ByHand{}, {.name = "radial",
                   .rule = "none",
                   .values = "a [table](#radial-motion)",
                   .meaning = "at the start, towards or away from a point or an axis; added to `velocity`"});
  visit(structure.courant, {.name = "courant", .range = Range::above(0, 1), .meaning = "share of the computed stable step"});
  visit(structure.linear_viscosity,
        {.name = "linear_viscosity", .range = Range::between(0, 10), .meaning = "bulk viscosity against ringing"});
  visit(structure.quadratic_viscosity,
        {.name = "quadratic_viscosity", .range = Range::between(0, 100), .meaning = "and its quadratic term"});
}

/// The layer of hexahedra that shells on a surface of quadrangles are. Throws std::invalid_argument that begins with the mesh's
/// path where a group has no thickness, and where thickened() does.
inline HexahedralMesh shells_on(const QuadrangleSurface& surface, const GmshMesh& mesh, const std::vector<Part>& parts,
                                const std::vector<int>& symmetry_axes) {
  const auto layer_of = [&](int group) {
    const std::string name = surface.group_names.of(group);
    std::optional<double> thickness = mesh.thickness;
    Layer layer{0, mesh.offset};
    for (const Part& part : parts) {
      if (surface.group_names.meant_by(part.group) != name) continue;
      if (part.thickness) thickness = part.thickness;
      if (part.offset) layer.offset = *part.offset;
    }
    if (!thickness)
      throw std::invalid_argument(mesh.path + ": the shells of the group '" + name +
                                  "' have no thickness; give shape.thickness, or a part {group = \"" + name +
                                  "\", thickness = ...}");
    layer.thickness = *thickness;
    return layer;
  };
  return thickened(surface, layer_of, symmetry_axes, mesh.path);
}

}  // namespace undex::fem
