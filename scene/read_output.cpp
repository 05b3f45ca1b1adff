// [start], [[probes]] and [output].
#include <algorithm>

#include "core/point_values.hpp"
#include "scene/draft.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

const std::vector<std::string> known_particle_fields{"pressure",         "density",  "velocity",    "void_fraction", "energy",
                                                     "smoothing_length", "material", "sound_speed", "mass"};
const std::vector<std::string> known_solid_fields{"pressure", "velocity",    "von_mises",    "plastic_strain",
                                                  "density",  "temperature", "displacement", "energy",
                                                  "damage",   "material",    "sound_speed",  "mass"};

/// Reports every word that is not known, and every repetition.
void check_words(const TableReader& table, const char* key, const std::vector<std::string>& words,
                 const std::vector<std::string>& known) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (std::find(known.begin(), known.end(), words[i]) == known.end()) table.unknown_word(key, words[i], known);
    if (std::find(words.begin(), words.begin() + static_cast<long>(i), words[i]) != words.begin() + static_cast<long>(i))
      table.complain(key, table.path_of(key) + " names '" + words[i] + "' twice; name it once");
  }
}

void read_probe(const Node& node, const std::string& path, Draft& draft) {
  const TableReader table(node, path, "probes", draft.scene.fluid.dimension, draft.report);
  Probe probe;
  probe.name = std::to_string(draft.probe_nodes.size());
  table.need("name", "every probe has a name");
  table.read_name("name", probe.name);
  if (!table.has("kind")) {
    probe.kind = draft.root.find("bodies") ? Probe::Kind::fluid : Probe::Kind::structure;
  } else {
    table.read_choice<Probe::Kind>(
        "kind", probe.kind, {{"fluid", Probe::Kind::fluid}, {"wall", Probe::Kind::wall}, {"structure", Probe::Kind::structure}});
  }
  table.need("point", "give its position in m");
  const bool placed = table.read("point", probe.point);
  const bool in_structure = probe.kind == Probe::Kind::structure;
  const std::vector<std::string> known = in_structure ? names_of(material_quantities) : names_of(fluid_quantities);
  probe.quantities = known;
  table.read("quantities", probe.quantities);
  if (probe.quantities.empty())
    table.complain("quantities", table.path_of("quantities") + " is empty; name some of " + listed(known));
  check_words(table, "quantities", probe.quantities, known);
  draft.scene.probes.push_back(probe);
  draft.probe_nodes.push_back(&node);
  draft.probe_good.push_back(placed);
}

void read_output_table(const TableReader& top, Draft& draft) {
  const Node* node = top.table("output");
  if (!node) return;
  Output& output = draft.scene.output;
  const TableReader table(*node, "output", "output", top.dimension(), draft.report);
  table.read("history_interval", output.history_interval);
  table.read("field_interval", output.field_interval);
  if (table.read("field_times", output.field_times)) std::sort(output.field_times.begin(), output.field_times.end());
  if (table.read("particle_fields", output.particle_fields))
    check_words(table, "particle_fields", output.particle_fields, known_particle_fields);
  table.read("structure_fields", output.structure_fields);
  if (table.read("solid_fields", output.solid_fields))
    check_words(table, "solid_fields", output.solid_fields, known_solid_fields);
}

/// The keys of a plane wave; only the checks that need no geometry of others.
void read_wave(const TableReader& table, const TableReader& top, Draft& draft) {
  Start& start = draft.scene.start;
  Start::Wave& wave = start.wave;
  const bool asked = start.kind == Start::Kind::plane_wave;
  for (const char* key : {"axis", "towards", "front", "peak", "decay"})
    if (!asked && table.has(key))
      table.complain(key, table.path_of(key) + " is of start.kind = \"plane_wave\"; leave it out or set the kind");
  if (!asked) return;
  if (table.has("time")) table.complain("time", "start.time is of start.kind = \"spherical\"; leave it out");
  table.need("axis", "name the axis along which the wave runs");
  table.need("front", "give the position of the wave's front along its axis in m");
  table.need("peak", "give the wave's largest pressure above that at rest in Pa");
  table.need("decay", "give the time in s over which the wave falls by e");
  table.read("front", wave.front);
  table.read("peak", wave.peak);
  table.read("decay", wave.decay);
  table.read_choice<bool>("towards", wave.upward, {{"high", true}, {"low", false}});
  if (table.read_axis("axis", wave.axis)) {
    if (wave.axis >= top.dimension())
      table.complain("axis", "start.axis: the scene has dimension = " + std::to_string(top.dimension()) + " and no such axis");
    else if (draft.scene.fluid.symmetry.axis[wave.axis])
      table.complain("axis",
                     "start.axis: the wave would run through a symmetry plane, where its mirror image comes to meet it; leave "
                     "the plane out, or let the wave run along another axis");
  }
  const auto& bodies = draft.scene.fluid.bodies;
  if (bodies.empty()) {
    table.complain("kind", "start.kind = \"plane_wave\" needs one of [[bodies]] to run in; there is none");
    return;
  }
  if (start.body.empty() && bodies.size() > 1) {
    table.complain("body",
                   "start.kind = \"plane_wave\": the scene has several bodies; name the one that carries the wave by start.body");
    return;
  }
  for (const sph::Body& body : bodies)
    if ((body.name == start.body || start.body.empty()) && (body.velocity.norm() > 0 || body.burn))
      table.complain("body", "start.kind = \"plane_wave\": bodies." + body.name + " must be at rest and not burn");
}

void read_start(const TableReader& top, Draft& draft) {
  Start& start = draft.scene.start;
  const Node* node = top.table("start");
  if (!node) return;
  const TableReader table(*node, "start", "start", top.dimension(), draft.report);
  table.read_choice<Start::Kind>(
      "kind", start.kind,
      {{"plain", Start::Kind::plain}, {"spherical", Start::Kind::spherical}, {"plane_wave", Start::Kind::plane_wave}});
  if (table.read("body", start.body) && !start.body.empty()) {
    std::vector<std::string> names;
    for (const sph::Body& body : draft.scene.fluid.bodies) names.push_back(body.name);
    if (std::find(names.begin(), names.end(), start.body) == names.end())
      table.complain("body", "start.body: no body '" + start.body + "'" + suggestion(start.body, names));
  }
  if (double time; table.read("time", time)) start.time = time;
  if (start.kind == Start::Kind::spherical && top.dimension() != 3)
    table.complain("kind", "start.kind = \"spherical\" needs dimension = 3");
  read_wave(table, top, draft);
}

}  // namespace

void read_output(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  const auto probes = top.tables("probes");
  for (std::size_t i = 0; i < probes.size(); ++i) read_probe(*probes[i], element_path("probes", *probes[i], i), draft);
  read_output_table(top, draft);
  read_start(top, draft);
}

}  // namespace undex::scene
