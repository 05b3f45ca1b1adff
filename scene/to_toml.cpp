// The resolved scene: every key with its value, units as comments.
#include <cassert>
#include <cmath>

#include "scene/scene.hpp"
#include "scene/schema.hpp"
#include "scene/toml_values.hpp"

namespace undex::scene {
namespace {

using namespace materials;

class Writer {
 public:
  explicit Writer(int dimension) : values_(dimension) {}
  const std::string& text() const { return text_; }

  /// Starts a table: header as written, and its kind in the schema.
  void table(const std::string& header, const std::string& section_name) {
    if (!text_.empty()) text_ += '\n';
    text_ += header + '\n';
    section_ = &section(section_name);
  }
  void top() { section_ = &section(""); }

  /// A key of the present table.
  template <class Value>
  void put(const char* key, const Value& value) {
    line(key, values_.text(value));
  }
  /// Every parameter of a record; of those that do not count in it only where `all` are wanted.
  template <Described Record>
  void fields(const Record& record, bool all = true) {
    for_each_field(record, [&](const auto& member, const Key& key) {
      if (all || key.used) line(key.name, values_.text(key, member));
    });
  }
  void shape(const Primitive& of) {
    values_.for_each_shape_key(of, [&](const char* key, const std::string& value) { line(key, value); });
  }
  int dimension() const { return values_.dimension(); }
  void set_dimension(int dimension) { values_ = TomlValues(dimension); }

 private:
  void line(const char* key, const std::string& value) {
    if (value.empty()) return;
    const Key* known = section_->find(key);
    assert(known);
    const std::string unit = known->unit;
    text_ += std::string(key) + " = " + value + (unit.empty() ? "" : "  # [" + unit + "]") + '\n';
  }

  std::string text_;
  const Section* section_ = &section("");
  TomlValues values_;
};

void put_shape(Writer& writer, const std::string& header, const Primitive& shape) {
  const auto* placed = std::get_if<Placed>(&shape);
  writer.table(header, std::string("shape.") + name_of(placed ? placed->shape[0] : shape));
  writer.shape(shape);
}

void put_fluid_material(Writer& writer, const std::string& header, const Fluid& fluid) {
  const std::string law = name_of(fluid.law);
  writer.table(header, "material." + law);
  writer.fields(fluid);
  writer.put("law", law);
  std::visit([&](const auto& each) { writer.fields(each.parameters()); }, fluid.law);
}

template <class Law>
void put_law(Writer& writer, const std::string& header, const char* key, const Law& law) {
  writer.table("[" + header + "." + key + "]", std::string(key) + "." + law.name);
  writer.put("law", law.name);
  writer.fields(law);
}

void put_solid_material(Writer& writer, const std::string& header, const Solid& solid) {
  writer.table("[" + header + "]", "material.solid");
  writer.fields(solid);
  std::visit([&](const auto& law) { put_law(writer, header, "pressure", law); }, solid.pressure);
  std::visit([&](const auto& law) { put_law(writer, header, "flow", law); }, solid.flow);
  if (solid.spall) {
    writer.table("[" + header + ".spall]", "spall");
    writer.fields(*solid.spall);
  }
  if (solid.damage) {
    writer.table("[" + header + ".damage]", "damage");
    writer.fields(*solid.damage);
  }
}

void put_supports(Writer& writer, const std::string& owner, const std::vector<Support>& supports) {
  for (const Support& support : supports) {
    writer.table("[[" + owner + ".supports]]", "supports");
    writer.fields(support);
  }
}

void put_radial(Writer& writer, const std::string& owner, const std::optional<RadialMotion>& motion) {
  if (!motion) return;
  writer.table("[" + owner + ".radial]", "radial");
  writer.fields(*motion);
}

void put_body(Writer& writer, const sph::Body& body) {
  writer.table("[[bodies]]", "bodies");
  writer.fields(body);
  put_shape(writer, "[bodies.shape]", body.shape.base);
  put_radial(writer, "bodies", body.radial);
  put_fluid_material(writer, "[bodies.material]", body.material);
  if (!std::holds_alternative<Jwl>(body.material.law)) return;
  writer.table("[bodies.burn]", "burn");
  writer.put("model", body.burn ? "programmed" : "instantaneous");
  if (body.burn) writer.fields(*body.burn);
}

void put_wall(Writer& writer, const sph::Wall& wall) {
  writer.table("[[walls]]", "walls");
  writer.fields(wall);
  put_shape(writer, "[walls.shape]", wall.container);
  writer.table("[walls.faces]", std::string("faces.") + name_of(wall.container));
  for (const auto& [face, condition] : wall.faces) writer.put(face.c_str(), condition);
}

template <class Type>
void put_mesh(Writer& writer, const std::string& owner, const Type& mesh) {
  writer.table("[" + owner + ".shape]", std::string("structure.") + mesh.name);
  writer.put("type", mesh.name);
  writer.fields(mesh);
  if constexpr (Described<fem::Cells<Type>>) {
    writer.table("[" + owner + ".cells]", std::string("cells.") + mesh.name);
    writer.fields(fem::Cells<Type>{mesh});
  }
}

void put_structure(Writer& writer, const fem::Settings& structure, bool listed) {
  const std::string owner = listed ? "structures" : "structure";
  writer.table(listed ? "[[structures]]" : "[structure]", "structure");
  writer.fields(structure);
  std::visit([&](const auto& mesh) { put_mesh(writer, owner, mesh); }, structure.mesh);
  put_radial(writer, owner, structure.radial);
  put_solid_material(writer, owner + ".material", structure.material);
  for (const fem::Part& part : structure.parts) {
    writer.table("[[" + owner + ".parts]]", "parts");
    writer.fields(part);
    if (part.offset) writer.put("offset", *part.offset);
    if (part.material) put_solid_material(writer, owner + ".parts.material", *part.material);
  }
  put_supports(writer, owner, structure.supports);
  for (const fem::PressureLoad& load : structure.loads) {
    writer.table("[[" + owner + ".loads]]", "loads");
    writer.fields(load);
  }
}

void put_solid(Writer& writer, const solid::Body& solid) {
  writer.table("[[solids]]", "solids");
  writer.fields(solid);
  put_shape(writer, "[solids.shape]", solid.shape.base);
  put_radial(writer, "solids", solid.radial);
  put_supports(writer, "solids", solid.supports);
  put_solid_material(writer, "solids.material", solid.material);
}

void put_solids(Writer& writer, const solid::Settings& solids, bool line) {
  if (!line) {
    writer.table("[solid_scheme]", "solid_scheme");
    writer.fields(solids.numerics);
  }
  for (const solid::Body& solid : solids.bodies) put_solid(writer, solid);
}

void put_planes(Writer& writer, const std::vector<RigidPlane>& planes) {
  for (const RigidPlane& plane : planes) {
    writer.table("[[planes]]", "planes");
    writer.fields(plane);
  }
}

/// On a line without what is of particles.
void put_fluid(Writer& writer, const sph::Settings& fluid, bool line) {
  writer.table("[resolution]", "resolution");
  if (line) writer.put("spacing", fluid.lattice.spacing);
  else writer.fields(fluid.lattice, false);
  writer.table("[symmetry]", "symmetry");
  writer.fields(fluid.symmetry);
  writer.table("[surroundings]", "surroundings");
  writer.fields(fluid.surroundings);
  if (!line) {
    writer.table("[scheme]", "scheme");
    writer.fields(fluid.numerics, false);
  }
  for (const sph::Body& body : fluid.bodies) put_body(writer, body);
  for (const sph::Wall& wall : fluid.walls) put_wall(writer, wall);
}

}  // namespace

std::string to_toml(const Scene& scene) {
  const int dimension = scene.fluid.dimension;
  const bool line = on_a_line(scene.geometry);
  Writer writer(dimension);
  writer.top();
  writer.fields(scene);
  put_fluid(writer, scene.fluid, line);
  writer.set_dimension(3);
  for (const fem::Settings& structure : scene.structures) put_structure(writer, structure, scene.structures_listed);
  writer.set_dimension(dimension);
  if (!scene.solids.bodies.empty()) put_solids(writer, scene.solids, line);
  put_planes(writer, scene.solids.planes);
  if (!line && (!scene.structures.empty() || !scene.solids.bodies.empty())) {
    writer.table("[coupling]", "coupling");
    writer.fields(scene.coupling);
  }
  for (const coupling::Obstacle& obstacle : scene.obstacles) {
    writer.table("[[obstacles]]", "obstacles");
    writer.fields(obstacle, false);
    put_shape(writer, "[obstacles.shape]", obstacle.shape);
  }
  if (!scene.fluid.bodies.empty()) {
    writer.table("[start]", "start");
    writer.fields(scene.start, false);
  }
  for (const Probe& probe : scene.probes) {
    writer.table("[[probes]]", "probes");
    writer.fields(probe);
  }
  for (const ProfileLine& each : scene.lines) {
    writer.table("[[lines]]", "lines");
    writer.fields(each);
  }
  writer.table("[output]", "output");
  writer.fields(scene.output);
  writer.table("[comparison]", "comparison");
  writer.put("kind", scene.comparison.kind);
  writer.put("probe", scene.comparison.probe);
  writer.put("reference", scene.comparison.reference);
  if (scene.comparison.solution) writer.put("solution", solution_name(*scene.comparison.solution));
  const Similitude& similitude = scene.comparison.similitude;
  if (!similitude.explosive.empty()) writer.put("explosive", similitude.explosive);
  if (similitude.charge_mass) writer.put("charge_mass", *similitude.charge_mass);
  for (const auto& [key, law] : {std::pair{"peak", &similitude.peak},
                                 {"decay", &similitude.decay},
                                 {"impulse", &similitude.impulse},
                                 {"energy_flux", &similitude.energy_flux}})
    if (!law->empty()) writer.put(key, *law);
  if (std::isfinite(scene.comparison.window_low))
    writer.put("window", std::vector<double>{scene.comparison.window_low, scene.comparison.window_high});
  writer.put("core", scene.comparison.core);
  return writer.text();
}

}  // namespace undex::scene
