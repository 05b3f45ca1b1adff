// Rigid bodies keep clear of walls, of each other and of deforming bodies: contact is not modelled, so a run ends where one comes
// about.
#pragma once

#include <vector>

#include "core/deformable_body.hpp"
#include "coupling/obstacle.hpp"

namespace undex::coupling {

class Contacts {
 public:
  /// Throws std::invalid_argument, which opens with "obstacles.<name>", where two overlap.
  Contacts(const std::vector<RigidObstacle>& obstacles, const sph::Settings& fluid);

  /// Bodies that deform must keep clear too. It must outlive this.
  void watch(const DeformableBody& body, const std::vector<RigidObstacle>& obstacles);

  /// Throws NumericalStop where one has come nearer than half a spacing to something that it did not touch at the start.
  void expect_room(const std::vector<RigidObstacle>& obstacles, const sph::Settings& fluid, double time) const;

 private:
  struct Pair {
    std::size_t one, other;
    double least;  ///< distance that it may have [m]
  };
  struct Watched {
    const DeformableBody* body;
    std::vector<double> least;  // per obstacle
  };
  double spacing_;
  std::vector<std::vector<double>> least_depth_;  // in the walls, per obstacle and node [m]
  std::vector<Pair> pairs_;
  std::vector<Watched> bodies_;
};

}  // namespace undex::coupling
