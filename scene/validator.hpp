// The checks of one scene against itself. Each group of them is a file, validate_*.cpp; validate.cpp calls them in turn.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scene/draft.hpp"
#include "scene/faces.hpp"
#include "scene/geometry.hpp"
#include "scene/line.hpp"
#include "scene/numbers.hpp"
#include "scene/structure_shape.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {

/// A place in a message: "[0.1, 0.2]".
std::string text(const Vec3& x, int dimension);

class Validator {
 public:
  explicit Validator(Draft& draft);
  void run();

 private:
  /// A body of fluid or a solid in particles: geometry treats them alike. The bodies come first.
  struct Part {
    std::string list, name;
    const Shape* shape;
    std::optional<double> spacing;
    const Node* node;
    bool shape_good;

    std::string path() const { return list + '.' + name; }
  };

  /// A body of finite elements.
  struct Structure {
    std::string path;
    const fem::Settings* settings;
    const Node* node;
    std::optional<StructureShape> shape;  ///< nothing where it was not good

    /// In a sentence.
    std::string named() const { return path == "structure" ? "the structure" : path; }
    Depth depth() const {
      return [this](const Vec3& x) { return -shape->signed_distance(x); };
    }
  };

  // validate.cpp
  void names();
  void parts();
  void collect();
  void complain(const Node& node, const char* key, const std::string& message);
  void warn(const Node& node, const char* key, const std::string& message);
  bool all_usable() const;
  bool is_fluid(std::size_t part) const { return part < fluid_.bodies.size(); }
  /// Overlaps and gaps below this count as none.
  double tolerance() const;
  double near() const { return 2 * fluid_.lattice.spacing; }
  /// To the nearest body of fluid [m].
  double distance_to_water(const Vec3& x) const;
  bool in_kept_part(const Vec3& x) const;

  // validate_lattice.cpp
  void gravity();
  void lattice();

  // validate_geometry.cpp
  /// Checks of one body or solid by itself; returns whether its geometry can be compared with others'.
  bool part(const Part& one);
  void overlaps();
  void walls();
  void conical(const Cone& cone, const std::string& path, const Node& node);

  // validate_radiating.cpp
  void radiating();
  void radiating(const sph::Wall& wall, const Node& node);

  // validate_structure.cpp
  void structures();
  void structure(const Structure& one);
  std::string faces_at_water(const StructureShape& shape) const;
  void faces_water(const Structure& one, const std::string& face);
  void apart(const Structure& first, const Structure& later);
  void pieces(const Structure& one);
  void wet_face(const std::string& path, const Node& node, const std::vector<Vec3>& points, const std::string& face);
  void solids();
  void planes();
  void halved(const std::string& path, const Node& node, const Primitive& shape);

  // validate_symmetry.cpp
  void mirrors();
  void mirrored(const Part& one, bool fluid, const sph::Body* body);
  void mirrored(const Structure& one);
  void mirrored_burn(const sph::Body& body, const Node& node);

  // validate_motion.cpp
  void motions();
  void motion(const RadialMotion& motion, const std::string& path, const Node& node, const Depth& solid, const Bounds& extent);

  // validate_obstacles.cpp
  void obstacles();
  bool has_size_of_water(const coupling::Obstacle& one, const Node& node);
  void obstacle(const coupling::Obstacle& one, const Node& node);
  void driven(const coupling::Obstacle& one, const Node& node, const std::string& path);
  void weight(const coupling::Obstacle& one, const Node& node, const std::string& path);
  void room_for(std::size_t index);

  // validate_sizes.cpp
  void sizes();
  void size_of(const Structure& one, double of_bodies);
  void size_of_walls(double of_bodies);
  void counts();

  // validate_times.cpp
  void times();
  void unwritten();
  void start_time();

  // validate_thin_walls.cpp
  void thin_walls();

  // validate_line.cpp
  void line();
  void off_the_line(const std::string& words);
  void cells_of(const Line& line);
  void burns_on(const Line& line, const std::string& words);
  void probe_on(const Line& line, const Probe& probe, const Node& node);
  void of_particles(const std::string& words);

  // validate_probes.cpp
  double distance_to_solids(const Vec3& x) const;
  void on_structure(const Probe& probe, const Node& node);
  void probe(const Probe& probe, const Node& node);
  void one_dimensional();

  Draft& draft_;
  Scene& scene_;
  sph::Settings& fluid_;
  int dimension_;
  Bounds kept_;
  std::vector<Structure> structures_;
  std::vector<Part> parts_;
  std::vector<bool> usable_;  // beside parts_: can it be compared with others?
};

}  // namespace undex::scene
