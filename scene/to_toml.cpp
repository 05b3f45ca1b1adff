// The resolved scene: every key with its value, units as comments.
#include <cassert>
#include <cmath>
#include <type_traits>

#include "scene/document.hpp"
#include "scene/material_fields.hpp"
#include "scene/numbers.hpp"
#include "scene/scene.hpp"
#include "scene/schema.hpp"

namespace undex::scene {
namespace {

using namespace materials;

std::string number(double value) {
  std::string text = shortest(value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

template <class Range, class Write>
std::string array(const Range& values, Write write) {
  std::string text = "[";
  for (const auto& value : values) text += (text.size() > 1 ? ", " : "") + write(value);
  return text + "]";
}

std::string axis_name(int axis) { return std::string(1, "xyz"[axis]); }

class Writer {
 public:
  explicit Writer(int dimension) : dimension_(dimension) {}
  const std::string& text() const { return text_; }

  /// Starts a table: header as written, and its kind in the schema.
  void table(const std::string& header, const char* section_name) {
    if (!text_.empty()) text_ += '\n';
    text_ += header + '\n';
    section_ = &section(section_name);
  }
  void top() { section_ = &section(""); }

  void put(const char* key, double value) { line(key, number(value)); }
  void put(const char* key, int value) { line(key, std::to_string(value)); }
  void put(const char* key, bool value) { line(key, value ? "true" : "false"); }
  void put(const char* key, const std::string& value) { line(key, quoted(value)); }
  void put(const char* key, const char* value) { line(key, quoted(value)); }
  void put(const char* key, const std::optional<double>& value) {
    if (value) put(key, *value);
  }
  void put(const char* key, Cavitation value) { put(key, cavitation_name(value)); }
  void put(const char* key, const Vec3& value) { line(key, vector(value)); }
  void put(const char* key, const std::vector<double>& values) { line(key, array(values, number)); }
  void put(const char* key, const std::vector<std::string>& values) { line(key, array(values, quoted)); }
  void axis(const char* key, int value) { put(key, axis_name(value)); }
  void axes(const char* key, const std::array<bool, 3>& marked) {
    std::vector<std::string> names;
    for (int a = 0; a < 3; ++a)
      if (marked[a]) names.push_back(axis_name(a));
    put(key, names);
  }
  /// A value that is written already.
  void line(const char* key, const std::string& value) {
    const Key* known = section_->find(key);
    assert(known);
    text_ += std::string(key) + " = " + value + (known->unit.empty() ? "" : "  # [" + known->unit + "]") + '\n';
  }
  std::string vector(const Vec3& value) const {
    return array(std::vector<double>(value.data(), value.data() + dimension_), number);
  }
  int dimension() const { return dimension_; }
  void set_dimension(int dimension) { dimension_ = dimension; }

 private:
  std::string text_;
  const Section* section_ = &section("");
  int dimension_;
};

/// Keys and values of a shape, in the order in which they are written.
using Pairs = std::vector<std::pair<const char*, std::string>>;

Pairs shape_pairs(const Primitive& shape, const Writer& writer) {
  struct Visitor {
    const Writer& writer;
    Pairs operator()(const Box& box) const {
      return {{"type", quoted("box")}, {"low", writer.vector(box.low)}, {"high", writer.vector(box.high)}};
    }
    Pairs operator()(const Slab& slab) const {
      return {{"type", quoted("slab")},
              {"axis", quoted(axis_name(slab.axis))},
              {"low", number(slab.low)},
              {"high", number(slab.high)}};
    }
    Pairs operator()(const Sphere& sphere) const {
      return {{"type", quoted("sphere")}, {"center", writer.vector(sphere.center)}, {"radius", number(sphere.radius)}};
    }
    Pairs operator()(const Cylinder& c) const {
      return {{"type", quoted("cylinder")},
              {"axis", quoted(axis_name(c.axis))},
              {"center", writer.vector(c.center)},
              {"radius", number(c.radius)},
              {"low", number(c.low)},
              {"high", number(c.high)}};
    }
    Pairs operator()(const TubeShape& t) const {
      return {{"type", quoted("tube")},          {"axis", quoted(axis_name(t.axis))}, {"center", writer.vector(t.center)},
              {"inner_radius", number(t.inner)}, {"outer_radius", number(t.outer)},   {"low", number(t.low)},
              {"high", number(t.high)}};
    }
  };
  return std::visit(Visitor{writer}, shape);
}

std::string inline_table(const Pairs& pairs) {
  std::string text = "{";
  for (const auto& [key, value] : pairs) text += (text.size() > 1 ? ", " : "") + std::string(key) + " = " + value;
  return text + "}";
}

void put_shape(Writer& writer, const std::string& header, const Primitive& shape) {
  static const char* const sections[] = {"shape.box", "shape.slab", "shape.sphere", "shape.cylinder", "shape.tube"};
  writer.table(header, sections[shape.index()]);
  for (const auto& [key, value] : shape_pairs(shape, writer)) writer.line(key, value);
}

void put_fluid_material(Writer& writer, const std::string& header, const Fluid& fluid) {
  std::visit(
      [&](const auto& law) {
        const std::string kind = law_name(law);
        writer.table(header, ("material." + kind).c_str());
        writer.put("name", fluid.name);
        writer.put("source", fluid.source);
        writer.put("law", kind);
        auto parameters = law.parameters();
        each_field(parameters, [&](const char* key, const auto& value) { writer.put(key, value); });
      },
      fluid.law);
}

void put_solid_material(Writer& writer, const std::string& header, const Solid& solid) {
  writer.table("[" + header + "]", "material.solid");
  writer.put("name", solid.name);
  writer.put("source", solid.source);
  writer.put("rho0", solid.rho0);
  writer.put("shear_modulus", solid.shear_modulus);
  writer.put("heat_capacity", solid.heat_capacity);
  writer.put("taylor_quinney", solid.taylor_quinney);
  writer.put("T_room", solid.T_room);
  const auto put_law = [&](const char* key, auto law) {
    const std::string kind = law_name(law);
    writer.table("[" + header + "." + key + "]", (std::string(key) + "." + kind).c_str());
    writer.put("law", kind);
    each_field(law, [&](const char* field, double value) { writer.put(field, value); });
  };
  std::visit([&](const auto& law) { put_law("pressure", law); }, solid.pressure);
  std::visit([&](const auto& law) { put_law("flow", law); }, solid.flow);
  if (solid.spall) {
    writer.table("[" + header + ".spall]", "spall");
    writer.put("strength", solid.spall->strength);
    writer.put("mode", spall_mode_name(solid.spall->mode));
  }
  if (auto damage = solid.damage) {
    writer.table("[" + header + ".damage]", "damage");
    each_field(*damage, [&](const char* field, double value) { writer.put(field, value); });
  }
}

void put_body(Writer& writer, const sph::Body& body) {
  writer.table("[[bodies]]", "bodies");
  writer.put("name", body.name);
  if (!body.shape.removed.empty())
    writer.line("subtract",
                array(body.shape.removed, [&](const Primitive& shape) { return inline_table(shape_pairs(shape, writer)); }));
  writer.put("spacing", body.spacing);
  writer.put("velocity", body.velocity);
  writer.put("radial_velocity", body.radial_velocity);
  writer.put("pressure", body.pressure);
  if (body.level) writer.put("level", *body.level);
  writer.put("density", body.density);
  writer.put("energy", body.energy);
  writer.put("variable_h", body.variable_h);
  put_shape(writer, "[bodies.shape]", body.shape.base);
  put_fluid_material(writer, "[bodies.material]", body.material);
  if (!std::holds_alternative<Jwl>(body.material.law)) return;
  writer.table("[bodies.burn]", "burn");
  writer.put("model", body.burn ? "programmed" : "instantaneous");
  if (!body.burn) return;
  writer.put("initiation", body.burn->origin);
  writer.put("speed", body.burn->D);
  writer.put("width", body.burn->width);
  writer.put("cj_compression", body.burn->cj_compression);
}

const char* condition_name(sph::FaceCondition condition) {
  switch (condition) {
    case sph::FaceCondition::no_slip: return "no_slip";
    case sph::FaceCondition::free_slip: return "free_slip";
    case sph::FaceCondition::open: break;
  }
  return "open";
}

void put_wall(Writer& writer, const sph::Wall& wall) {
  writer.table("[[walls]]", "walls");
  writer.put("name", wall.name);
  put_shape(writer, "[walls.shape]", wall.container);
  writer.table("[walls.faces]", std::holds_alternative<Cylinder>(wall.container) ? "faces.cylinder" : "faces.box");
  for (const auto& [face, condition] : wall.faces) writer.put(face.c_str(), condition_name(condition));
}

void put_mesh(Writer& writer, const fem::Mesh& mesh) {
  struct Visitor {
    Writer& writer;
    void operator()(const fem::TubeMesh& tube) const {
      writer.table("[structure.shape]", "structure.tube");
      writer.put("type", "tube");
      writer.axis("axis", tube.axis);
      writer.put("center", tube.center);
      writer.put("inner_radius", tube.inner_radius);
      writer.put("outer_radius", tube.outer_radius);
      writer.put("low", tube.low);
      writer.put("high", tube.high);
      writer.table("[structure.cells]", "cells.tube");
      writer.put("through", tube.cells_through);
      writer.put("around", tube.cells_around);
      writer.put("along", tube.cells_along);
    }
    void operator()(const fem::RodMesh& rod) const {
      writer.table("[structure.shape]", "structure.rod");
      writer.put("type", "rod");
      writer.axis("axis", rod.axis);
      writer.put("center", rod.center);
      writer.put("radius", rod.radius);
      writer.put("low", rod.low);
      writer.put("high", rod.high);
      writer.table("[structure.cells]", "cells.rod");
      writer.put("radial", rod.cells_radial);
      writer.put("along", rod.cells_along);
    }
    void operator()(const fem::PlateMesh& plate) const {
      writer.table("[structure.shape]", "structure.plate");
      writer.put("type", "plate");
      writer.put("low", plate.low);
      writer.put("high", plate.high);
      writer.table("[structure.cells]", "cells.plate");
      writer.put("x", plate.cells[0]);
      writer.put("y", plate.cells[1]);
      writer.put("z", plate.cells[2]);
    }
    void operator()(const fem::GmshMesh& gmsh) const {
      writer.table("[structure.shape]", "structure.gmsh");
      writer.put("type", "gmsh");
      writer.put("path", gmsh.path);
    }
  };
  std::visit(Visitor{writer}, mesh);
}

void put_structure(Writer& writer, const fem::Settings& structure) {
  writer.table("[structure]", "structure");
  writer.put("name", structure.name);
  writer.put("element", structure.element == fem::ElementKind::shell ? "shell" : "hexahedron");
  writer.put("points_through", structure.points_through);
  writer.put("wet", structure.wet_faces);
  writer.put("velocity", structure.initial_velocity);
  writer.put("courant", structure.courant);
  writer.put("linear_viscosity", structure.linear_viscosity);
  writer.put("quadratic_viscosity", structure.quadratic_viscosity);
  put_mesh(writer, structure.mesh);
  put_solid_material(writer, "structure.material", structure.material);
  for (const fem::Support& support : structure.supports) {
    writer.table("[[structure.supports]]", "supports");
    writer.put("face", support.face);
    writer.axes("fixed", support.fixed);
  }
  for (const fem::PressureLoad& load : structure.loads) {
    writer.table("[[structure.loads]]", "loads");
    writer.put("face", load.face);
    writer.put("time", load.time);
    writer.put("pressure", load.pressure);
  }
}

void put_solid(Writer& writer, const solid::Body& solid) {
  writer.table("[[solids]]", "solids");
  writer.put("name", solid.name);
  if (!solid.shape.removed.empty())
    writer.line("subtract",
                array(solid.shape.removed, [&](const Primitive& shape) { return inline_table(shape_pairs(shape, writer)); }));
  writer.put("description",
             solid.description == solid::Description::total_lagrangian ? "total_lagrangian" : "updated_lagrangian");
  writer.put("spacing", solid.spacing);
  writer.put("lattice", solid.lattice == sph::LatticeType::rings ? "rings" : "cartesian");
  writer.put("velocity", solid.velocity);
  if (writer.dimension() == 3) writer.put("spin", solid.spin);
  else writer.put("spin", solid.spin[2]);
  writer.put("residual_stress", solid.residual_stress);
  writer.put("wet", solid.wet);
  put_shape(writer, "[solids.shape]", solid.shape.base);
  put_solid_material(writer, "solids.material", solid.material);
}

void put_solids(Writer& writer, const solid::Settings& solids) {
  writer.table("[solid_scheme]", "solid_scheme");
  const solid::Numerics& numerics = solids.numerics;
  writer.put("eta", numerics.eta);
  writer.put("courant", numerics.courant);
  writer.put("linear_viscosity", numerics.linear_viscosity);
  writer.put("quadratic_viscosity", numerics.quadratic_viscosity);
  writer.put("hourglass", numerics.hourglass);
  writer.put("alpha", numerics.alpha);
  writer.put("beta", numerics.beta);
  writer.put("artificial_stress", numerics.artificial_stress);
  for (const solid::Body& solid : solids.bodies) put_solid(writer, solid);
}

void put_planes(Writer& writer, const std::vector<RigidPlane>& planes) {
  for (const RigidPlane& plane : planes) {
    writer.table("[[planes]]", "planes");
    writer.axis("axis", plane.axis);
    writer.put("position", plane.position);
    writer.put("free_side", plane.body_above ? "above" : "below");
  }
}

void put_fluid(Writer& writer, const sph::Settings& fluid) {
  writer.table("[resolution]", "resolution");
  if (fluid.lattice.spacing > 0) writer.put("spacing", fluid.lattice.spacing);
  writer.put("lattice", fluid.lattice.type == sph::LatticeType::rings ? "rings" : "cartesian");
  writer.put("fit", fluid.lattice.fit);
  writer.put("origin", fluid.lattice.origin);
  if (writer.dimension() == 3) writer.put("rotation", fluid.lattice.rotation);
  if (writer.dimension() == 2) writer.put("rotation", fluid.lattice.rotation[2]);
  writer.put("jitter", fluid.lattice.jitter);
  writer.table("[symmetry]", "symmetry");
  writer.axes("planes", fluid.symmetry.axis);
  writer.table("[scheme]", "scheme");
  const sph::Numerics& numerics = fluid.numerics;
  for (const auto& [name, scheme] : sph::scheme_names)
    if (scheme == numerics.scheme) writer.put("name", name);
  writer.put("kernel", sph::with_kernel(numerics.kernel, [](auto kernel) { return kernel.name; }));
  writer.put("precision", numerics.precision == sph::Precision::mixed ? "mixed" : "full");
  writer.put("eta", numerics.eta);
  writer.put("alpha", numerics.alpha);
  writer.put("beta", numerics.beta);
  writer.put("alpha_min", numerics.alpha_min);
  writer.put("integrator", numerics.integrator == sph::Integrator::ssp_rk3 ? "ssp_rk3" : "leapfrog");
  writer.put("courant", numerics.courant);
  writer.put("fixed_step", numerics.fixed_step);
  if (numerics.integrator == sph::Integrator::leapfrog) writer.put("local_steps", numerics.local_steps);
  writer.put("signal", numerics.signal);
  writer.put("h_low", numerics.h_low);
  writer.put("h_high", numerics.h_high);
  for (const sph::Body& body : fluid.bodies) put_body(writer, body);
  for (const sph::Wall& wall : fluid.walls) put_wall(writer, wall);
}

void put_start(Writer& writer, const Start& start) {
  const bool wave = start.kind == Start::Kind::plane_wave;
  writer.put("kind", wave ? "plane_wave" : start.kind == Start::Kind::spherical ? "spherical" : "plain");
  if (!start.body.empty()) writer.put("body", start.body);
  if (start.time) writer.put("time", *start.time);
  if (!wave) return;
  writer.axis("axis", start.wave.axis);
  writer.put("towards", start.wave.upward ? "high" : "low");
  writer.put("front", start.wave.front);
  writer.put("peak", start.wave.peak);
  writer.put("decay", start.wave.decay);
}

const char* kind_name(Probe::Kind kind) {
  switch (kind) {
    case Probe::Kind::fluid: return "fluid";
    case Probe::Kind::wall: return "wall";
    case Probe::Kind::structure: break;
  }
  return "structure";
}

}  // namespace

std::string to_toml(const Scene& scene) {
  const int dimension = scene.fluid.dimension;
  Writer writer(dimension);
  writer.top();
  writer.put("name", scene.name);
  writer.put("title", scene.title);
  writer.put("dimension", dimension);
  writer.put("end_time", scene.end_time);
  writer.put("threads", scene.fluid.numerics.threads);
  writer.put("gravity", scene.fluid.gravity);
  put_fluid(writer, scene.fluid);
  if (scene.structure) {
    writer.set_dimension(3);
    put_structure(writer, *scene.structure);
    writer.set_dimension(dimension);
  }
  if (!scene.solids.bodies.empty()) put_solids(writer, scene.solids);
  put_planes(writer, scene.solids.planes);
  if (scene.structure || !scene.solids.bodies.empty()) {
    writer.table("[coupling]", "coupling");
    writer.put("slip", scene.coupling.free_slip);
    writer.put("window", scene.coupling.window);
    writer.put("solids", scene.coupling.solids == coupling::SolidContact::surface ? "surface" : "particles");
  }
  if (!scene.fluid.bodies.empty()) {
    writer.table("[start]", "start");
    put_start(writer, scene.start);
  }
  for (const Probe& probe : scene.probes) {
    writer.table("[[probes]]", "probes");
    writer.put("name", probe.name);
    writer.put("kind", kind_name(probe.kind));
    writer.put("point", probe.point);
    writer.put("quantities", probe.quantities);
  }
  writer.table("[output]", "output");
  writer.put("history_interval", scene.output.history_interval);
  writer.put("field_interval", scene.output.field_interval);
  writer.put("field_times", scene.output.field_times);
  writer.put("particle_fields", scene.output.particle_fields);
  writer.put("structure_fields", scene.output.structure_fields);
  writer.put("solid_fields", scene.output.solid_fields);
  writer.table("[comparison]", "comparison");
  writer.put("kind", scene.comparison.kind);
  writer.put("probe", scene.comparison.probe);
  writer.put("reference", scene.comparison.reference);
  if (scene.comparison.solution) writer.put("solution", solution_name(*scene.comparison.solution));
  if (std::isfinite(scene.comparison.window_low))
    writer.put("window", std::vector<double>{scene.comparison.window_low, scene.comparison.window_high});
  writer.put("core", scene.comparison.core);
  return writer.text();
}

}  // namespace undex::scene
