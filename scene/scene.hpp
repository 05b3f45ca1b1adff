// A scene: everything that a run needs, as plain data, read from one TOML file.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupling/settings.hpp"
#include "fem_structure/settings.hpp"
#include "scene/solution.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_solid/settings.hpp"

namespace undex::scene {

/// How the run begins.
struct Start {
  /// plain: every body uniform at time zero. spherical: until the wave from a spherical charge (or bubble) nears the first
  /// obstacle, the flow is one-dimensional: it is computed on a fine one-dimensional mesh and laid on the particles then.
  /// plane_wave: one body carries a plane wave at time zero.
  enum class Kind { plain, spherical, plane_wave };
  Kind kind = Kind::plain;
  std::string body;            ///< the charge, or the body that carries the wave; default: the only spherical body of gas or
                               ///< products, the only body
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

/// A point whose values are written as a history.
struct Probe {
  enum class Kind {
    fluid,      ///< Shepard average of the fluid at a fixed point
    wall,       ///< the same at a point of a rigid wall or of the (moving) wet face or solid nearest to it
    structure,  ///< a material point of the structure or of a solid in particles
  };
  std::string name;
  Kind kind = Kind::fluid;
  Vec3 point = Vec3::Zero();            ///< [m]
  std::vector<std::string> quantities;  ///< of the lists in core/point_values.hpp
};

/// What is written, and how often. Zero interval: never.
struct Output {
  double history_interval = 0;      ///< [s]; 0: every step
  double field_interval = 0;        ///< [s] between field snapshots
  std::vector<double> field_times;  ///< [s] further snapshots at these times
  std::vector<std::string> particle_fields{"pressure", "density", "velocity", "void_fraction"};
  ///< also: energy, smoothing_length, material, sound_speed, mass
  bool structure_fields = true;
  std::vector<std::string> solid_fields{"pressure", "velocity", "von_mises", "plastic_strain"};
  ///< also: density, temperature, displacement, energy, damage, material,
  ///< sound_speed, mass
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
  sph::Settings fluid;         ///< and what all particles share; without bodies where there is no fluid
  solid::Settings solids;      ///< solids in particles; rigid planes for structures too
  std::optional<fem::Settings> structure;
  coupling::Settings coupling;
  Start start;
  std::vector<Probe> probes;
  Output output;
  Comparison comparison;
};

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
