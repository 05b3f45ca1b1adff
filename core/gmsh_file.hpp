// Meshes of hexahedra, of quadrangles in a meridian or of quadrangles as a surface in space, in gmsh's format: .msh 2 (2.0 to
// 2.2) and 4.1, ASCII (Gmsh reference manual, section "MSH file format").
#pragma once

#include <string>
#include <string_view>

#include "core/hexahedral_mesh.hpp"
#include "core/quadrangle_surface.hpp"

namespace undex {

/// What a mesh is made of: hexahedra; or, for a body of revolution, quadrangles in the plane z = 0 with x the distance from the
/// axis and y along it. Their outer sides are the faces (those on the axis are none), named by lines as faces by quadrangles.
enum class GmshCells { hexahedra, quadrangles };

/// Nodes that no cell has are left out; points are passed over, lines too but for those that name sides. Of cells of the second
/// order the corners are taken, which is remarked. Names of physical groups are those of $PhysicalNames, of cells and faces each
/// by themselves. Throws std::invalid_argument with a message
/// "path:line: what is wrong; remedy" for everything that is not a sound mesh: a file cut off, counts that do not fit, unknown
/// or repeated tags, other elements than the cells and their faces, numbers out of range, nodes at one place, cells that are
/// flat, turned inside out or not joined face to face, faces that are not outer ones, two groups of one name, and
/// of a meridian nodes off its plane or beyond the axis. Nodes within 1e-9 of the mesh's extent are put on plane and axis.
/// The file's lengths times `scale` are metres.
HexahedralMesh read_gmsh(const std::string& path, GmshCells cells = GmshCells::hexahedra, double scale = 1);
/// The same of the file's text, whose lengths are metres; `path` is for messages.
HexahedralMesh parse_gmsh(std::string_view text, const std::string& path, GmshCells cells = GmshCells::hexahedra);

/// Quadrangles in space, whose lines name edges. Refuses as read_gmsh does; any number of quadrangles may meet at an edge.
QuadrangleSurface read_gmsh_surface(const std::string& path, double scale = 1);
QuadrangleSurface parse_gmsh_surface(std::string_view text, const std::string& path);

}  // namespace undex
