// [start], [[probes]], [output] and [comparison].
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

/// A plate that a plane wave meets head-on.
void check_taylor_plate(const TableReader& table, const Draft& draft) {
  const Scene& scene = draft.scene;
  const Start::Wave& wave = scene.start.wave;
  const auto* plate = scene.structure ? std::get_if<fem::PlateMesh>(&scene.structure->mesh) : nullptr;
  const std::string face = std::string(1, "xyz"[wave.axis]) + (wave.upward ? "_low" : "_high");
  if (scene.start.kind != Start::Kind::plane_wave || !plate)
    table.complain("kind",
                   "comparison.kind = \"taylor_plate\" needs start.kind = \"plane_wave\" and a [structure] of type \"plate\"");
  else if (scene.structure->wet_faces != std::vector<std::string>{face})
    table.complain("kind", "comparison.kind = \"taylor_plate\": the wave runs onto the plate's face '" + face +
                               "'; write structure.wet = [\"" + face + "\"]");
  const auto reads_water = [&](const Probe& probe) {
    return probe.name == scene.comparison.probe && probe.kind != Probe::Kind::structure;
  };
  if (std::any_of(scene.probes.begin(), scene.probes.end(), reads_water))
    table.complain("probe", "comparison.probe must be a structure probe: the plate's velocity is compared");
}

/// A spherical charge in one medium, and probes in it.
void check_free_field(const TableReader& table, const Draft& draft) {
  const auto& bodies = draft.scene.fluid.bodies;
  const auto is_charge = [](const sph::Body& body) {
    return body.variable_h && body.shape.removed.empty() && std::holds_alternative<Sphere>(body.shape.base);
  };
  const auto charges = std::count_if(bodies.begin(), bodies.end(), is_charge);
  if (draft.scene.fluid.dimension != 3 || bodies.size() != 2 || charges != 1)
    table.complain("kind",
                   "comparison.kind = \"free_field\" needs dimension = 3 and two bodies: a \"sphere\" of gas or of a charge, and "
                   "the medium from which it is subtracted");
  if (std::none_of(draft.scene.probes.begin(), draft.scene.probes.end(),
                   [](const Probe& p) { return p.kind == Probe::Kind::fluid; }))
    table.complain("kind", "comparison.kind = \"free_field\" compares the pressures of fluid probes; add [[probes]]");
}

/// Keys of kind = "profile", and whether the bodies pose such a problem.
void read_profile(const TableReader& table, Draft& draft) {
  Comparison& comparison = draft.scene.comparison;
  if (comparison.kind != "profile") {
    for (const char* key : {"solution", "window", "core"})
      if (table.has(key)) table.complain(key, table.path_of(key) + " belongs to kind = \"profile\"; leave it out");
    return;
  }
  std::vector<double> window;
  if (table.read("window", window)) {
    if (window.size() == 2 && window[0] < window[1]) {
      comparison.window_low = window[0];
      comparison.window_high = window[1];
    } else {
      table.complain("window", table.path_of("window") + " must be [least, largest] coordinate in m, the first below the second");
    }
  }
  Solution solution{};
  Choices<Solution> choices;
  for (const Solution each : {Solution::riemann, Solution::taylor_wave, Solution::sedov, Solution::noh})
    choices.emplace_back(solution_name(each), each);
  if (!table.need("solution", "name the exact solution, e.g. solution = \"riemann\"") ||
      !table.read_choice<Solution>("solution", solution, choices))
    return;
  comparison.solution = solution;
  table.read("core", comparison.core);
  if (comparison.core && solution != Solution::riemann)
    table.complain("core", table.path_of("core") + " is for solution = \"riemann\": round flows have no axis; leave it out");
  if (!draft.report.empty()) return;  // bodies that are not sound pose nothing
  try {
    profile_problem(draft.scene.fluid, solution);
  } catch (const std::exception& misfit) {
    table.complain("solution", table.path_of("solution") + ": " + misfit.what());
  }
}

void read_comparison(const TableReader& top, Draft& draft) {
  Comparison& comparison = draft.scene.comparison;
  comparison.kind = "none";
  const Node* node = top.table("comparison");
  if (!node) return;
  const TableReader table(*node, "comparison", "comparison", top.dimension(), draft.report);
  table.read_choice<std::string>("kind", comparison.kind,
                                 {{"none", "none"},
                                  {"rigid_cylinder", "rigid_cylinder"},
                                  {"tube", "tube"},
                                  {"taylor_bar", "taylor_bar"},
                                  {"taylor_plate", "taylor_plate"},
                                  {"free_field", "free_field"},
                                  {"profile", "profile"}});
  read_profile(table, draft);
  if (table.read("probe", comparison.probe) && !comparison.probe.empty()) {
    std::vector<std::string> names;
    for (const Probe& probe : draft.scene.probes) names.push_back(probe.name);
    if (std::find(names.begin(), names.end(), comparison.probe) == names.end())
      table.complain("probe", "comparison.probe: no probe '" + comparison.probe + "'" + suggestion(comparison.probe, names));
  }
  if (comparison.kind == "taylor_bar") {
    const auto& solids = draft.scene.solids.bodies;
    const bool rod = draft.scene.structure ? std::holds_alternative<fem::RodMesh>(draft.scene.structure->mesh)
                                           : !solids.empty() && std::holds_alternative<Cylinder>(solids[0].shape.base);
    if (!rod)
      table.complain("kind",
                     "comparison.kind = \"taylor_bar\" compares the shape of a [structure] of type \"rod\", or of the first "
                     "of [[solids]], a cylinder; there is none");
  } else if (comparison.kind == "free_field") {
    check_free_field(table, draft);
  } else if (comparison.kind != "none" && comparison.kind != "profile") {
    table.need("probe", "name the probe that is compared");
    if (comparison.kind == "taylor_plate") check_taylor_plate(table, draft);
  }
  if (std::string reference; table.read("reference", reference) && !reference.empty()) {
    const std::filesystem::path full = draft.scene.file.parent_path() / reference;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(full, ignored))
      table.complain("reference", "comparison.reference: no file '" + full.string() + "'; give it relative to the scene file");
    comparison.reference = std::filesystem::absolute(full).lexically_normal().string();
  }
}

}  // namespace

void read_output(Draft& draft) {
  const TableReader top(draft.root, "", "", draft.scene.fluid.dimension, draft.report);
  const auto probes = top.tables("probes");
  for (std::size_t i = 0; i < probes.size(); ++i) read_probe(*probes[i], element_path("probes", *probes[i], i), draft);
  read_output_table(top, draft);
  read_start(top, draft);
  read_comparison(top, draft);
}

}  // namespace undex::scene
