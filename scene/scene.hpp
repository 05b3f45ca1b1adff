// A scene: everything that a run needs, as plain data, read from one TOML file.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/meridian.hpp"
#include "core/record.hpp"
#include "coupling/settings.hpp"
#include "fem_structure/settings.hpp"
#include "scene/dimension.hpp"
#include "scene/places.hpp"
#include "scene/solution.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_solid/settings.hpp"

namespace undex::scene {

/// How the run begins.
struct Start {
  /// plain: every body uniform at time zero. spherical: until the wave from a spherical charge (or bubble) nears the first
  /// obstacle, the flow is one-dimensional: it is computed on a fine one-dimensional mesh and laid on the particles then.
  /// plane_wave: one body carries a plane wave at time zero. run: from the state that the run of another scene has come to.
  enum class Kind { plain, spherical, plane_wave, run };
  friend constexpr auto words(Kind) {
    return std::to_array<Word<Kind>>(
        {{"plain", Kind::plain}, {"spherical", Kind::spherical}, {"plane_wave", Kind::plane_wave}, {"run", Kind::run}});
  }
  Kind kind = Kind::plain;
  std::string body;            ///< the charge, or the body that carries the wave; default: all spherical bodies of gas or
                               ///< products, the only body
  std::string from;            ///< of kind run: the scene file, or a run's folder
  std::optional<double> time;  ///< [s] when particles take over; default: when the front is a kernel's reach from the obstacle
  struct Wave {
    int axis = 2;        ///< along which it runs
    bool upward = true;  ///< to larger coordinates?
    double front = 0;    ///< where its front is [m]
    double peak = 0;     ///< above the pressure at rest [Pa]
    double decay = 0;    ///< [s]
  };
  Wave wave;  ///< of kind plane_wave
};
template <class Visit>
void describe(Start& start, Visit&& visit) {
  visit(start.kind,
        {.name = "kind",
         .meaning = "uniform bodies; spherical charges computed on a radius first; a plane wave; or the state of a simpler run"});
  const bool wave = start.kind == Start::Kind::plane_wave, run = start.kind == Start::Kind::run;
  visit(start.body, {.name = "body",
                     .rule = "all spherical gas and charges; the only body",
                     .values = "a body",
                     .used = !start.body.empty(),
                     .meaning = "the charge, the body round it is the medium; or the body that carries the wave"});
  visit(start.from, {.name = "from",
                     .needed = true,
                     .remedy = "name the scene, or the folder of a run, that it begins from, relative to this file",
                     .values = "a scene (file or folder) or a run's folder",
                     .used = run,
                     .meaning = "\"run\": whose state it begins from"});
  visit(start.time, {.name = "time",
                     .unit = "s",
                     .range = Range::above(0, 1e3),
                     .rule = "when the front is a kernel's reach from the obstacle",
                     .meaning = "\"spherical\", \"run\": when the particles take over"});
  visit(start.wave.axis, {.name = "axis",
                          .needed = true,
                          .remedy = "name the axis along which the wave runs",
                          .form = Form::axis,
                          .used = wave,
                          .meaning = "\"plane_wave\": along which it runs"});
  visit(start.wave.upward, {.name = "towards",
                            .yes = "high",
                            .no = "low",
                            .used = wave,
                            .meaning = "\"plane_wave\": to larger or to smaller coordinates"});
  visit(start.wave.front, {.name = "front",
                           .unit = "m",
                           .range = Range::position(),
                           .needed = true,
                           .remedy = "give the position of the wave's front along its axis in m",
                           .used = wave,
                           .meaning = "\"plane_wave\": position of its front along the axis"});
  visit(start.wave.peak, {.name = "peak",
                          .unit = "Pa",
                          .range = Range::positive(),
                          .needed = true,
                          .remedy = "give the wave's largest pressure above that at rest in Pa",
                          .used = wave,
                          .meaning = "\"plane_wave\": largest pressure above that of the body at rest, just behind the front"});
  visit(start.wave.decay, {.name = "decay",
                           .unit = "s",
                           .range = Range::above(0, 1e3),
                           .needed = true,
                           .remedy = "give the time in s over which the wave falls by e",
                           .used = wave,
                           .meaning = "\"plane_wave\": it falls by e over this time's way at the speed of sound at rest"});
}

/// A point whose values are written as a history.
struct Probe {
  enum class Kind {
    fluid,      ///< Shepard average of the fluid at a fixed point
    wall,       ///< the same at a point of a rigid wall or of the (moving) wet face or solid nearest to it
    structure,  ///< a material point of the structure or of a solid in particles
  };
  friend constexpr auto words(Kind) {
    return std::to_array<Word<Kind>>({{"fluid", Kind::fluid}, {"wall", Kind::wall}, {"structure", Kind::structure}});
  }
  std::string name;
  Kind kind = Kind::fluid;
  std::optional<std::string> structure;  ///< by its name; nothing: the only one, or a solid
  Vec3 point = Vec3::Zero();             ///< [m]
  std::vector<std::string> quantities;   ///< of the lists in core/point_values.hpp
};

/// The quantities that a probe may ask of, for docs/reference/scene-file.md.
const char* quantities_in_words();
template <class Visit>
void describe(Probe& probe, Visit&& visit) {
  visit(probe.name, {.name = "name",
                     .needed = true,
                     .remedy = "every probe has a name",
                     .form = Form::name,
                     .meaning = "of the history's file"});
  visit(probe.kind,
        {.name = "kind",
         .rule = "\"fluid\"; \"structure\" without bodies",
         .meaning = "a fixed point of the fluid; a place on a wall or wet face; a material point of a structure or solid"});
  visit(probe.structure, {.name = "structure",
                          .rule = "the only one",
                          .values = "a name",
                          .meaning = "\"structure\": the one of [[structures]] that it is a point of"});
  visit(probe.point, {.name = "point",
                      .unit = "m",
                      .range = Range::position(),
                      .needed = true,
                      .remedy = "give its position in m",
                      .meaning = "at the start"});
  visit(probe.quantities, {.name = "quantities", .rule = "all", .meaning = quantities_in_words()});
}

/// A straight line through the fluid, along which profiles are written.
struct ProfileLine {
  std::string name;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< its ends [m]
  int points = 101;                             ///< evenly spaced, both ends among them
  std::vector<std::string> quantities;          ///< of fluid_quantities in core/point_values.hpp
  double interval = 0;                          ///< [s] between profiles; 0: none
  std::vector<double> times;                    ///< [s] further profiles
};
template <class Visit>
void describe(ProfileLine& line, Visit&& visit) {
  visit(line.name, {.name = "name",
                    .needed = true,
                    .remedy = "every line has a name",
                    .form = Form::name,
                    .meaning = "of its file, lines/<name>.csv"});
  visit(line.from, {.name = "from",
                    .unit = "m",
                    .range = Range::position(),
                    .needed = true,
                    .remedy = "give the line's first point in m",
                    .meaning = "its first point"});
  visit(line.to, {.name = "to",
                  .unit = "m",
                  .range = Range::position(),
                  .needed = true,
                  .remedy = "give the line's last point in m",
                  .meaning = "its last point"});
  visit(line.points, {.name = "points", .range = Range::between(2, 100000), .meaning = "evenly spaced, both ends among them"});
  visit(line.quantities,
        {.name = "quantities", .rule = "all", .values = "list", .meaning = "those of a probe of kind \"fluid\""});
  visit(line.interval, {.name = "interval",
                        .unit = "s",
                        .range = Range::between(0, 1e3),
                        .meaning = "between profiles, each of the first step at or after its time; 0: none"});
  visit(line.times, {.name = "times",
                     .unit = "s",
                     .range = Range::between(0, 1e3),
                     .values = "list, 0 to 1000",
                     .meaning = "further profiles"});
}

/// What is written, and how often. Zero interval: never.
struct Output {
  double history_interval = 0;                              ///< [s]; 0: every step
  std::vector<std::string> histories{"bodies", "largest"};  ///< beside those of probes, obstacles and energies
  double checkpoint_interval = 600;                         ///< [s] of wall time; 0: none
  double field_interval = 0;                                ///< [s] between field snapshots
  std::vector<double> field_times;                          ///< [s] further snapshots at these times
  std::vector<std::string> particle_fields{"pressure", "density", "velocity", "void_fraction"};
  ///< also: energy, smoothing_length, material, sound_speed, mass
  bool structure_fields = true;
  std::vector<std::string> solid_fields{"pressure", "velocity", "von_mises", "plastic_strain"};
  ///< also: density, temperature, displacement, energy, damage, material,
  ///< sound_speed, mass

  bool wants(std::string_view history) const { return std::find(histories.begin(), histories.end(), history) != histories.end(); }
};

template <class Visit>
void describe(Output& output, Visit&& visit) {
  visit(output.history_interval, {.name = "history_interval",
                                  .unit = "s",
                                  .range = Range::between(0, 1e3),
                                  .meaning = "between rows of histories; 0: every step"});
  visit(output.histories, {.name = "histories",
                           .values = "list of \"bodies\", \"largest\", \"forces\", \"one_dimensional\"",
                           .meaning = "what is written beside probes, obstacles and energies"});
  visit(output.checkpoint_interval, {.name = "checkpoint_interval",
                                     .unit = "s",
                                     .range = Range::between(0, 1e9),
                                     .meaning = "wall time between checkpoints, from which `undex resume` continues; 0: none"});
  visit(output.field_interval, {.name = "field_interval",
                                .unit = "s",
                                .range = Range::between(0, 1e3),
                                .meaning = "between snapshots of the fields; 0: none"});
  visit(output.field_times, {.name = "field_times",
                             .unit = "s",
                             .range = Range::between(0, 1e3),
                             .values = "list, 0 to 1000",
                             .meaning = "further snapshots"});
  visit(output.particle_fields, {.name = "particle_fields",
                                 .values = "also \"energy\", \"smoothing_length\", \"material\", \"sound_speed\", \"mass\"",
                                 .meaning = "in the particles' snapshots"});
  visit(output.structure_fields, {.name = "structure_fields", .meaning = "snapshots of the structure"});
  visit(output.solid_fields, {.name = "solid_fields",
                              .values = "also \"density\", \"temperature\", \"displacement\", \"energy\", \"damage\", "
                                        "\"material\", \"sound_speed\", \"mass\"",
                              .meaning = "in the solids' snapshots; [] leaves the positions"});
}

/// The laws of similitude of an explosive, each a factor and an exponent (empty: the named explosive's). With W [kg], R [m] and
/// s = W^(1/3): p = K (s/R)^a [Pa], theta = k s (s/R)^b [s], I = K s (s/R)^a [Pa s], E = K s (s/R)^a [J/m^2].
struct Similitude {
  std::string explosive;              ///< one of the named; empty: none
  std::optional<double> charge_mass;  ///< W [kg]; else that of the scene's charge
  std::vector<double> peak, decay, impulse, energy_flux;
};

/// A reference history or table that a run is compared with by the named comparison.
struct Comparison {
  std::string kind;                  ///< "none", or that of a ComparisonKind
  std::string probe;                 ///< the probe it reads
  std::string reference;             ///< CSV path, relative to the scene file; may be empty
  std::optional<Solution> solution;  ///< of a profile
  /// Of a profile: least and largest coordinate that is compared [m].
  double window_low = -std::numeric_limits<double>::infinity(), window_high = std::numeric_limits<double>::infinity();
  std::optional<double> core;  ///< of a Riemann problem: least |y| and |z| that is left out [m]
  Similitude similitude;
};

class TableReader;
struct Scene;

/// What the reader must know of a kind of comparison: it judges nothing itself.
struct ComparisonKind {
  std::string name;                    ///< comparison.kind
  bool needs_probe = false;            ///< must comparison.probe be given?
  std::vector<std::string> keys = {};  ///< of [comparison] that belong to this kind alone
  /// Complains of what the comparison needs and the scene, which has been read so far, does not have. May be null.
  void (*check)(const TableReader& table, const Scene& scene) = nullptr;
};

struct Scene {
  std::string name, title;
  std::filesystem::path file;  ///< where it was read from
  double end_time = 0;         ///< [s]
  Geometry geometry = Geometry::cartesian;
  int axis = 2;                      ///< of revolution, of an axisymmetric scene
  std::optional<Meridian> meridian;  ///< of an axisymmetric scene: places are in space, solvers compute in it
  sph::Settings fluid;               ///< and what all particles share; without bodies where there is no fluid
  solid::Settings solids;            ///< solids in particles; rigid planes for structures too
  std::vector<fem::Settings> structures;
  bool structures_listed = false;  ///< written as [[structures]], not as [structure]
  coupling::Settings coupling;
  std::vector<coupling::Obstacle> obstacles;  ///< rigid bodies in the fluid; subtracted from its shapes
  Start start;
  std::vector<Probe> probes;
  std::vector<ProfileLine> lines;
  Output output;
  Comparison comparison;
  Places places;                      ///< of its keys in the file
  std::vector<std::string> warnings;  ///< "file:line:column: what is probably not meant"

  /// The table of a structure in the file: "structure", or "structures.NAME".
  std::string path_of(const fem::Settings& structure) const {
    return structures_listed ? "structures." + structure.name : "structure";
  }
  /// The structure of a scene that has one alone; else null.
  const fem::Settings* only_structure() const { return structures.size() == 1 ? &structures.front() : nullptr; }
};

template <class Visit>
void describe(Scene& scene, Visit&& visit) {
  visit(scene.name, {.name = "name",
                     .rule = "the file's or its folder's name",
                     .form = Form::name,
                     .meaning = "names the run and its default output folder"});
  visit(scene.title, {.name = "title", .rule = "the name", .meaning = "one line for plots and lists"});
  Dimension dimension{scene.fluid.dimension, scene.geometry};
  visit(dimension, {.name = "dimension",
                    .range = Range::between(1, 3),
                    .values = "1, 2, 3, \"axisymmetric\", \"spherical\", \"plane\"",
                    .meaning = "number of coordinates, or a symmetry that leaves fewer than the scene is written in"});
  visit(scene.axis, {.name = "axis",
                     .rule = "that about which all is of revolution",
                     .form = Form::axis,
                     .used = scene.geometry == Geometry::axisymmetric,
                     .meaning = "\"axisymmetric\": along which the axis of revolution runs"});
  visit(scene.end_time, {.name = "end_time",
                         .unit = "s",
                         .range = Range::above(0, 1e3),
                         .needed = true,
                         .remedy = "give it in s, e.g. end_time = 1e-4",
                         .meaning = "when the run ends"});
  visit(scene.fluid.numerics.threads, {.name = "threads", .range = Range::between(0, 4096), .meaning = "0: all the machine has"});
  visit(scene.fluid.gravity, {.name = "gravity",
                              .unit = "m/s^2",
                              .meaning = "acts on fluid, structure, solids and free obstacles; along symmetry planes only"});
  for (const char* table :
       {"resolution", "symmetry", "surroundings", "scheme", "start", "materials", "bodies", "walls", "structure", "structures",
        "solids", "solid_scheme", "planes", "coupling", "obstacles", "probes", "lines", "output", "comparison"})
    visit(ByHand{}, {.name = table});
}

/// An override from the command line: dotted key and TOML value text, e.g. {"resolution.spacing", "0.001"}.
struct Override {
  std::string key, value;
};

/// Reads and validates a scene (a .toml file, or a folder with case.toml), which may name one of the `kinds` of comparisons.
/// Throws SceneError with every mistake found, FileError when the file cannot be read.
Scene read(const std::filesystem::path& path, const std::vector<ComparisonKind>& kinds,
           const std::vector<Override>& overrides = {});

/// The scene as TOML with every default filled in (resolved.toml); reading it back gives the same scene.
std::string to_toml(const Scene& scene);

}  // namespace undex::scene
