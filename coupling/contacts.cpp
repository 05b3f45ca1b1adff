#include "coupling/contacts.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "core/errors.hpp"
#include "coupling/wall_depth.hpp"

namespace undex::coupling {
namespace {

constexpr double near = 0.5, slack = 0.01;  // of a spacing

/// What a distance may come down to, having been `first` at the start.
double least_of(double first, double spacing) { return std::min(first, near * spacing) - slack * spacing; }

/// From points to an obstacle.
double nearest(std::span<const Vec3> points, const RigidObstacle& obstacle) {
  double least = 1e300;
  for (const Vec3& x : points) least = std::min(least, obstacle.signed_distance(x));
  return least;
}
double between(const RigidObstacle& one, const RigidObstacle& other) {
  return std::min(nearest(one.places(), other), nearest(other.places(), one));
}

[[noreturn]] void stop(double time, const std::string& who, const std::string& what) {
  char text[600];
  std::snprintf(
      text, sizeof text,
      "time %.6g s: obstacle '%s' has come to %s; contact of rigid bodies is not built: end the run before (end_time), or "
      "give them more room",
      time, who.c_str(), what.c_str());
  throw NumericalStop(text);
}

}  // namespace

Contacts::Contacts(const std::vector<RigidObstacle>& obstacles, const sph::Settings& fluid) : spacing_(fluid.lattice.spacing) {
  for (const RigidObstacle& obstacle : obstacles) {
    std::vector<double>& least = least_depth_.emplace_back();
    for (const Vec3& x : obstacle.places()) least.push_back(least_of(depth_in_walls(x, fluid), spacing_));
  }
  for (std::size_t i = 0; i < obstacles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double distance = between(obstacles[i], obstacles[k]);
      const auto path = [&](std::size_t n) { return "obstacles." + obstacles[n].given().name; };
      if (distance < -slack * spacing_)
        throw std::invalid_argument(path(i) + ".shape: it overlaps " + path(k) + "; move one of them");
      if (obstacles[i].moves() || obstacles[k].moves()) pairs_.push_back({i, k, least_of(distance, spacing_)});
    }
}

void Contacts::watch(const DeformableBody& body, const std::vector<RigidObstacle>& obstacles) {
  Watched watched{&body, {}};
  for (const RigidObstacle& obstacle : obstacles) {
    const double distance = nearest(body.positions(), obstacle);
    if (distance < -slack * spacing_)
      throw std::invalid_argument("obstacles." + obstacle.given().name +
                                  ".shape: it overlaps a deforming body; move one of them");
    watched.least.push_back(least_of(distance, spacing_));
  }
  if (!obstacles.empty()) bodies_.push_back(std::move(watched));
}

void Contacts::expect_room(const std::vector<RigidObstacle>& obstacles, const sph::Settings& fluid, double time) const {
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].moves()) continue;
    const std::vector<Vec3> places = obstacles[i].places();
    for (std::size_t n = 0; n < places.size(); ++n) {
      if (depth_in_walls(places[n], fluid) < least_depth_[i][n]) stop(time, obstacles[i].given().name, "a wall");
      for (int a = 0; a < 3; ++a)
        if (fluid.symmetry.axis[a] && !(fluid.axisymmetric && a == 0) && places[n][a] < -slack * spacing_)
          stop(time, obstacles[i].given().name, std::string("the symmetry plane ") + "xyz"[a] + " = 0");
    }
  }
  for (const Pair& pair : pairs_)
    if (between(obstacles[pair.one], obstacles[pair.other]) < pair.least)
      stop(time, obstacles[pair.one].given().name, "obstacle '" + obstacles[pair.other].given().name + "'");
  for (const Watched& watched : bodies_)
    for (std::size_t i = 0; i < obstacles.size(); ++i)
      if (nearest(watched.body->positions(), obstacles[i]) < watched.least[i])
        stop(time, obstacles[i].given().name, "a deforming body");
}

}  // namespace undex::coupling
