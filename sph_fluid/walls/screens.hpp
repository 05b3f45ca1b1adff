// The faces of thin walls as straight ways meet them: triangles and open edges, with their copies across symmetry planes and
// containers' faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/shapes.hpp"
#include "core/vector.hpp"
#include "sph_fluid/settings.hpp"
#include "sph_fluid/walls/face_copies.hpp"
#include "sph_fluid/walls/moving_walls.hpp"
#include "sph_fluid/walls/slip_faces.hpp"
#include "sph_fluid/walls/thin_walls.hpp"

namespace undex::sph {

/// What a straight way meets.
struct Way {
  static constexpr double same = 1e-9;  ///< share of a way within which it meets walls at one place

  struct Crossing {
    double at;  ///< share of the way
    bool entering;
    Vec3 normal;
    double offset;  ///< of the wall's plane [m]
    int sheet;
  };
  struct Graze {
    int sheet;
    double share;  ///< 1/2 through the open edge itself, 0 half a width beside it
  };
  std::vector<Crossing> crossings;  ///< in order
  std::vector<Graze> grazed;

  /// A wall that bulges into the way, and looks the same way where the way leaves it, hides nothing: its images stand as if it
  /// were plane.
  bool is_free() const;
  /// Does the first wall on the way, or through an edge one of the first, pass the test?
  template <class Test>
  bool first_wall(Test test) const {
    for (const Crossing& crossing : crossings) {
      if (crossing.at - crossings[0].at >= same) break;
      if (crossing.entering && test(crossing)) return true;
    }
    return false;
  }
  /// Is it one that looks as `normal` does?
  bool enters(const Vec3& normal) const;
  /// Of the open edges of a sheet, or of all (-1).
  double graze(int sheet) const;
  /// What of the way would be free if the walls that it meets, but for sheet `but`, ended a little earlier.
  double beside(int but) const;
  double free_share() const { return is_free() ? 1.0 - graze(-1) : beside(-1); }
};

class Screens {
  struct Triangle {
    Vec3 corner, along, across, normal;
    Vec3 u, v;      // a point x of the plane is (x - corner).u and (x - corner).v along and across
    double offset;  // of its plane [m]
    double size;    // [m]
    int sheet;
    std::uint32_t plane;  // shared by triangles of equal planes

    bool holds(const Vec3& x) const;
  };
  struct Edge {
    Vec3 from, along;
    int sheet;
  };

 public:
  /// Of thin walls where they are now; `reach` [m] of pairs.
  void build(const std::vector<MirrorWall>& walls, const ThinWalls& thin, const SlipFaces& faces, const Settings& settings,
             double reach);
  void clear();

  /// Those that ways from places in a box may meet.
  class Near {
    friend class Screens;
    void clear();
    void add(const Triangle& triangle);

    std::vector<const Triangle*> triangles_;  // of one plane after another
    std::vector<const Edge*> edges_;
    // Per plane: its equation, and where its triangles begin.
    std::vector<double> x_, y_, z_, offset_;
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> found_;
  };
  void find(const Bounds& box, Near& near) const;
  /// Those of them within reach of a place [m].
  void find(const Near& all, const Vec3& from, double reach, Near& near) const;

  /// What the straight way from a to b [m] meets.
  void follow(const Vec3& a, const Vec3& b, const Near& near, Way& way) const;
  std::size_t memory_bytes() const;

 private:
  void add_face(const std::array<Vec3, 4>& corner, int sheet, unsigned open, const SlipFaces& faces, const Settings& settings);
  /// Adds what goes on beyond edges of a face.
  void add_beyond(const std::array<Vec3, 4>& corner, int sheet, unsigned open, unsigned edges, const SlipFaces& faces,
                  const Settings& settings);
  void add_copy(const FaceCopy& copy, int sheet, unsigned open);
  void sort_by_plane();
  void sort_by_place(int dimension);
  template <class Visit>
  void for_each_cell(const Bounds& box, Visit visit) const;

  double reach_ = 0, spacing_ = 0;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  // Cells, and what may lie in them: numbers of triangles, then of edges.
  Bounds box_;
  double cell_ = 1;
  int count_[3] = {1, 1, 1};
  std::vector<std::uint32_t> start_, member_;
};

}  // namespace undex::sph
