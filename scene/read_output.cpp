// [start], [[probes]], [[lines]] and [output].
#include <algorithm>
#include <limits>

#include "core/point_values.hpp"
#include "scene/draft.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_values.hpp"

namespace undex::scene {
namespace {

const std::vector<std::string> known_particle_fields{"pressure",         "density",  "velocity",    "void_fraction", "energy",
                                                     "smoothing_length", "material", "sound_speed", "mass"};
const std::vector<std::string> known_solid_fields{"pressure", "velocity",    "von_mises",    "plastic_strain",
                                                  "density",  "temperature", "displacement", "energy",
                                                  "damage",   "material",    "sound_speed",  "mass"};

const std::vector<std::string> known_histories{"bodies", "largest", "forces", "one_dimensional"};

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
  probe.kind = draft.root.find("bodies") ? Probe::Kind::fluid : Probe::Kind::structure;
  probe.point.setConstant(std::numeric_limits<double>::quiet_NaN());
  read_fields(table, probe);
  const bool in_structure = probe.kind == Probe::Kind::structure;
  const std::vector<std::string> known = in_structure ? names_of(material_quantities) : names_of(fluid_quantities);
  if (probe.quantities.empty()) {
    const Node* none = table.find("quantities");
    if (none && none->kind == Node::Kind::array && none->items.empty())
      table.complain("quantities", table.path_of("quantities") + " is empty; name some of " + listed(known));
    probe.quantities = known;
  }
  check_words(table, "quantities", probe.quantities, known);
  draft.scene.probes.push_back(probe);
  draft.probe_nodes.push_back(&node);
  draft.probe_good.push_back(probe.point.allFinite());
}

void read_line(const Node& node, const std::string& path, Draft& draft) {
  const TableReader table(node, path, "lines", draft.scene.fluid.dimension, draft.report);
  ProfileLine line;
  line.name = std::to_string(draft.line_nodes.size());
  read_fields(table, line);
  const std::vector<std::string> known = names_of(fluid_quantities);
  if (line.quantities.empty()) line.quantities = known;
  check_words(table, "quantities", line.quantities, known);
  std::sort(line.times.begin(), line.times.end());
  if (table.has("from") && table.has("to") && line.from == line.to)
    table.complain("to", table.path_of("to") + " is the point `from` as well; give the line another end");
  if (line.interval == 0 && line.times.empty())
    table.complain("interval",
                   path + " has neither an interval nor times, and no profile would be written; give one of the two [s]");
  if (!draft.root.find("bodies"))
    table.complain("name", path + " runs through the fluid, but the scene has no [[bodies]]; leave it out");
  draft.scene.lines.push_back(line);
  draft.line_nodes.push_back(&node);
}

void read_output_table(const TableReader& top, Draft& draft) {
  const Node* node = top.table("output");
  if (!node) return;
  Output& output = draft.scene.output;
  const TableReader table(*node, "output", "output", top.dimension(), draft.report);
  read_fields(table, output);
  std::sort(output.field_times.begin(), output.field_times.end());
  check_words(table, "histories", output.histories, known_histories);
  check_words(table, "particle_fields", output.particle_fields, known_particle_fields);
  check_words(table, "solid_fields", output.solid_fields, known_solid_fields);
}

/// A plane wave; only the checks that need no geometry of others.
void check_wave(const TableReader& table, const TableReader& top, Draft& draft) {
  const Start& start = draft.scene.start;
  const Start::Wave& wave = start.wave;
  const bool asked = start.kind == Start::Kind::plane_wave;
  for (const char* key : {"axis", "towards", "front", "peak", "decay"})
    if (!asked && table.has(key))
      table.complain(key, table.path_of(key) + " is of start.kind = \"plane_wave\"; leave it out or set the kind");
  if (!asked) return;
  if (table.has("time")) table.complain("time", "start.time is of start.kind = \"spherical\" and \"run\"; leave it out");
  const Node* axis = table.find("axis");
  const bool axis_good = axis && axis->text == axis_name(wave.axis);
  if (axis_good && wave.axis >= top.dimension())
    table.complain("axis", "start.axis: the scene has dimension = " + std::to_string(top.dimension()) + " and no such axis");
  else if (axis_good && draft.scene.fluid.symmetry.axis[wave.axis])
    table.complain("axis",
                   "start.axis: the wave would run through a symmetry plane, where its mirror image comes to meet it; leave "
                   "the plane out, or let the wave run along another axis");
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
    if ((body.name == start.body || start.body.empty()) && (body.moves() || body.burn))
      table.complain("body", "start.kind = \"plane_wave\": bodies." + body.name + " must be at rest and not burn");
}

/// A scene or a run's folder to begin from, given relative to the scene file. Whether it is there is asked when it is wanted: a
/// run that is gone on with needs it no more.
void check_donor(const TableReader& table, Draft& draft) {
  Start& start = draft.scene.start;
  if (start.kind != Start::Kind::run) {
    if (table.has("from")) table.complain("from", "start.from is of start.kind = \"run\"; leave it out or set the kind");
    return;
  }
  if (draft.scene.fluid.bodies.empty())
    table.complain("kind", "start.kind = \"run\" lays the state of one fluid on another, and the scene has no [[bodies]]");
  if (table.has("body"))
    table.complain("body", "start.body is not of start.kind = \"run\", which takes all bodies; leave it out");
  if (start.from.empty()) return;
  start.from = std::filesystem::absolute(draft.scene.file.parent_path() / start.from).lexically_normal().string();
}

void read_start(const TableReader& top, Draft& draft) {
  Start& start = draft.scene.start;
  const Node* node = top.table("start");
  if (!node) return;
  const TableReader table(*node, "start", "start", top.dimension(), draft.report);
  read_fields(table, start);
  if (!start.body.empty()) {
    std::vector<std::string> names;
    for (const sph::Body& body : draft.scene.fluid.bodies) names.push_back(body.name);
    if (std::find(names.begin(), names.end(), start.body) == names.end())
      table.complain("body", "start.body: no body '" + start.body + "'" + suggestion(start.body, names));
  }
  if (start.kind == Start::Kind::spherical && top.dimension() != 3)
    table.complain("kind", "start.kind = \"spherical\" needs dimension = 3");
  check_donor(table, draft);
  check_wave(table, top, draft);
}

}  // namespace

void read_output(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  const auto probes = top.tables("probes");
  for (std::size_t i = 0; i < probes.size(); ++i) read_probe(*probes[i], element_path("probes", *probes[i], i), draft);
  const auto lines = top.tables("lines");
  for (std::size_t i = 0; i < lines.size(); ++i) read_line(*lines[i], element_path("lines", *lines[i], i), draft);
  read_output_table(top, draft);
  read_start(top, draft);
}

}  // namespace undex::scene
