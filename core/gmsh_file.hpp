// Meshes of hexahedra in gmsh's format: .msh 2 (2.0 to 2.2) and 4.1, ASCII (Gmsh reference manual, section "MSH file format").
#pragma once

#include <string>
#include <string_view>

#include "core/hexahedral_mesh.hpp"

namespace undex {

/// Nodes that no hexahedron has are left out; points and lines are passed over. Throws std::invalid_argument with a message
/// "path:line: what is wrong; remedy" for everything that is not a sound mesh: a file cut off, counts that do not fit, unknown
/// or repeated tags, other elements than hexahedra and quadrangles, numbers out of range, nodes at one place, cells that are
/// flat, turned inside out or not joined face to face, and quadrangles that are not outer faces.
HexahedralMesh read_gmsh(const std::string& path);
/// The same of the file's text; `path` is for messages.
HexahedralMesh parse_gmsh(std::string_view text, const std::string& path);

}  // namespace undex
