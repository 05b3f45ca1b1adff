// A scene while it is being read: the values so far, and which of them are sound enough to be checked against each other.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/alternatives.hpp"
#include "scene/document.hpp"
#include "scene/report.hpp"
#include "scene/scene.hpp"

namespace undex::scene {

class TableReader;

struct Draft {
  Scene scene;
  Node root;  ///< the document, overrides applied
  Report report;
  Report warnings;  ///< what may be meant, and probably is not
  bool dimension_good = true, spacing_good = false;
  std::vector<const Node*> body_nodes, solid_nodes, wall_nodes, plane_nodes, obstacle_nodes, structure_nodes, probe_nodes,
      line_nodes;  ///< into root, beside the scene's own vectors
  std::vector<bool> body_shape_good, solid_shape_good, wall_shape_good, structure_shape_good, obstacle_good, probe_good;
  struct NamedSubtraction {
    const Node* name;  ///< as written
    std::size_t from;  ///< of which body; solids count on after the bodies
  };
  std::vector<NamedSubtraction> named_subtractions;
};

/// The file itself, or the one of the usual name in a folder. Throws FileError, which ends in the hint, where there is none.
std::filesystem::path found_file(const std::filesystem::path& path, const char* kind, const char* usual_name,
                                 const std::string& hint);
/// Throws FileError.
std::string file_text(const std::filesystem::path& file);
/// The folder of a file of the usual name, else the file without its ending; only what a name may hold.
std::string name_of(const std::filesystem::path& file, const char* usual_name);

void read_fluid(Draft& draft);  // read_fluid.cpp: [resolution], [symmetry], [scheme], [[bodies]], [[walls]]
/// read_obstacles.cpp: [[obstacles]], which are taken out of the bodies of fluid.
void read_obstacles(Draft& draft);
/// Of scenes on the one-dimensional mesh: defaults that need all bodies.
void complete_line(Draft& draft);
void read_solids(Draft& draft);      // read_solids.cpp: [[solids]], [solid_scheme], [[planes]]
void read_structures(Draft& draft);  // read_structure.cpp: [structure], [[structures]], [coupling]
void read_output(Draft& draft);      // read_output.cpp: [[probes]], [[lines]], [output], [start]
void read_comparison(Draft& draft, const std::vector<ComparisonKind>& kinds);  // read_comparison.cpp: [comparison]
/// validate_revolution.cpp: finds the axis of an axisymmetric scene, complains of what is not of revolution about it, and leaves
/// out planes of symmetry through it.
void settle_revolution(Draft& draft);
void validate(Draft& draft);  // validate.cpp: what single keys cannot tell

/// The name of a table element in messages: "bodies.water", or "bodies.0" where it has no usable name.
std::string element_path(const char* list, const Node& element, std::size_t index);

/// The material of a fluid body or of the structure: a name of the scene or of the library, or a table. Returns whether
/// it was good.
bool read_fluid_material(const Node& node, const std::string& path, Draft& draft, materials::Fluid& into);
bool read_solid_material(const Node& node, const std::string& path, Draft& draft, materials::Solid& into);
/// radial = {...} of a body, a solid or the structure.
void read_supports(const TableReader& table, const std::vector<std::string>& faces, std::vector<Support>& into);
void read_radial(const TableReader& table, std::optional<RadialMotion>& into);
/// All of [materials], used or not.
void read_own_materials(Draft& draft);

/// subtract = [shape, or name of a body or solid, ...]: shapes go to `into`, names to the draft until all bodies are known.
void read_subtractions(const TableReader& table, Draft& draft, std::size_t from, std::vector<Primitive>& into);
/// Puts the shapes of named bodies and solids where `subtract` names them.
void resolve_subtractions(Draft& draft);

/// For what a shape is used: bodies that have to end somewhere, rigid containers, or anything.
enum class ShapeUse { any, bounded };
/// A shape table: a type with its keys, and those of a placement. Returns whether it was good.
bool read_shape(const Node& node, const std::string& path, Draft& draft, ShapeUse use, Primitive& into);

}  // namespace undex::scene
