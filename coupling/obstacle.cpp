#include "coupling/obstacle.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/closed_surface.hpp"
#include "core/mass_properties.hpp"
#include "coupling/liquid_layers.hpp"
#include "coupling/wall_depth.hpp"

namespace undex::coupling {
namespace {

[[noreturn]] void refuse(const Obstacle& obstacle, const char* key, const std::string& why) {
  throw std::invalid_argument("obstacles." + obstacle.name + "." + key + ": " + why);
}

/// A history linear between its times, constant before and after.
double value_at(const std::vector<double>& time, const std::vector<double>& value, double at) {
  if (value.empty()) return 0.0;
  const std::size_t k = std::size_t(std::upper_bound(time.begin(), time.end(), at) - time.begin());
  if (k == 0) return value.front();
  if (k == time.size()) return value.back();
  const double share = (at - time[k - 1]) / (time[k] - time[k - 1]);
  return value[k - 1] + share * (value[k] - value[k - 1]);
}

/// Its integral from the first of its times on.
double integral_to(const std::vector<double>& time, const std::vector<double>& value, double at) {
  if (value.empty()) return 0.0;
  if (at <= time.front()) return (at - time.front()) * value.front();
  double sum = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool last = k + 1 == time.size() || at < time[k + 1];
    const double end = last ? at : time[k + 1];
    sum += 0.5 * (value[k] + value_at(time, value, end)) * (end - time[k]);
    if (last) break;
  }
  return sum;
}

/// Which symmetry planes cut it.
std::array<bool, 3> cut_by(const Obstacle& obstacle, const sph::Settings& fluid) {
  const Bounds extent = bounds(obstacle.shape, fluid.dimension);
  std::array<bool, 3> cut{};
  for (int a = 0; a < fluid.dimension; ++a) {
    if (!fluid.symmetry.axis[a] || (fluid.axisymmetric && a == 0)) continue;
    const double low = extent.low[a], high = extent.high[a], near = 1e-6 * fluid.lattice.spacing;
    cut[a] = low < -near;
    if (cut[a] && (std::abs(low + high) > near || !is_mirrored(obstacle.shape, a, 0.0, fluid.dimension)))
      refuse(obstacle, "shape",
             std::string("the symmetry plane ") + "xyz"[a] +
                 " = 0 cuts it, and not through its middle; put its middle on the plane, or leave the plane out");
  }
  return cut;
}

/// Motions along x, y, z and about them that dimension, symmetry and `fixed` leave.
std::array<bool, 6> free_motions(const Obstacle& obstacle, const sph::Settings& fluid, const std::array<bool, 3>& cut) {
  std::array<bool, 6> free{};
  if (obstacle.motion != Motion::free) return free;
  if (fluid.axisymmetric) free = {false, true, false, false, false, false};
  else if (fluid.dimension == 1) free = {true, false, false, false, false, false};
  else if (fluid.dimension == 2) free = {true, true, false, false, false, true};
  else free.fill(true);
  for (int a = 0; a < 3; ++a) {
    if (!cut[a]) continue;
    free[a] = false;  // a mirror turns motion across it, and about lines within it, round
    for (int b = 0; b < 3; ++b)
      if (b != a) free[b + 3] = false;
  }
  constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
  for (const std::string& held : obstacle.fixed)
    for (int k = 0; k < 6; ++k)
      if (held == names[k]) free[std::size_t(k)] = false;
  return free;
}

RigidBody body_of(const Obstacle& obstacle, const sph::Settings& fluid, const std::array<bool, 6>& free, double share) {
  const MassProperties uniform = mass_properties(obstacle.shape, fluid.dimension, fluid.axisymmetric);
  const double mass = obstacle.mass ? *obstacle.mass : obstacle.density.value_or(1.0) * uniform.volume;
  Mat3 inertia = mass / uniform.volume * uniform.inertia;
  const std::vector<double>& given = obstacle.inertia;
  if (given.size() == 1) inertia(2, 2) = given[0];
  else if (given.size() >= 3) {
    inertia = Vec3(given[0], given[1], given[2]).asDiagonal();
    if (given.size() == 6) {
      inertia(0, 1) = inertia(1, 0) = given[3];
      inertia(1, 2) = inertia(2, 1) = given[4];
      inertia(2, 0) = inertia(0, 2) = given[5];
    }
  }
  return {share * mass, share * inertia, uniform.centroid, free};
}

/// May a place of the body move along n, as its free or led motion goes about `center`?
bool can_move(const Obstacle& obstacle, const std::array<bool, 6>& free, const Vec3& center, const Vec3& x, const Vec3& n) {
  if (obstacle.motion == Motion::prescribed) return std::abs(obstacle.direction.normalized().dot(n)) > 1e-6;
  const Vec3 arm = (x - center).cross(n);
  const double length = 1e-6 * (x - center).norm();
  for (std::size_t a = 0; a < 3; ++a)
    if ((free[a] && std::abs(n[Eigen::Index(a)]) > 1e-6) || (free[a + 3] && std::abs(arm[Eigen::Index(a)]) > length)) return true;
  return false;
}

/// Faces of a closed surface that is the box about the obstacle, where all fluid is within: a wall drawn as a box with a hole.
std::vector<bool> outside_of_all(const WetSurface& whole, const Obstacle& obstacle, const sph::Settings& fluid) {
  const double near = 1e-6 * fluid.lattice.spacing;
  const Bounds box = bounds(obstacle.shape, fluid.dimension);
  std::vector<int> group(whole.nodes.size());
  std::iota(group.begin(), group.end(), 0);
  const auto first_of = [&](int n) {
    while (group[std::size_t(n)] != n) n = group[std::size_t(n)] = group[std::size_t(group[std::size_t(n)])];
    return n;
  };
  for (const auto& face : whole.faces)
    for (int n : face) group[std::size_t(first_of(n))] = first_of(face[0]);
  std::vector<bool> on_box(whole.nodes.size(), true);  // of the first of a group
  for (int n = 0; n < int(whole.nodes.size()); ++n) {
    bool touches = false;
    for (int a = 0; a < fluid.dimension; ++a)
      for (double side : {box.low[a], box.high[a]}) touches = touches || std::abs(whole.nodes[std::size_t(n)][a] - side) < near;
    if (!touches) on_box[std::size_t(first_of(n))] = false;
  }
  bool all_within = true;
  for (const sph::Body& body : fluid.bodies) {
    const Bounds extent = bounds(body.shape, fluid.dimension);
    for (int a = 0; a < fluid.dimension; ++a)
      all_within =
          all_within && (fluid.symmetry.axis[a] || extent.low[a] > box.low[a] - near) && extent.high[a] < box.high[a] + near;
  }
  std::vector<bool> outside;
  for (const auto& face : whole.faces) outside.push_back(all_within && on_box[std::size_t(first_of(face[0]))]);
  return outside;
}

/// The wet part: without what no fluid comes to, what lies beyond symmetry planes, or in a plane or wall that it cannot part
/// from.
WetSurface wet_surface(const Obstacle& obstacle, const sph::Settings& fluid, const std::array<bool, 3>& cut,
                       const std::array<bool, 6>& free) {
  const double spacing = fluid.lattice.spacing, near = 1e-6 * spacing;
  std::optional<WetSurface> whole = closed_surface(obstacle.shape, spacing, fluid.dimension);
  if (!whole)
    refuse(obstacle, "shape",
           "its surface cannot be meshed in the scene's dimension with faces of a spacing; take another shape, or a "
           "smaller spacing");
  for (Vec3& x : whole->nodes)
    for (int a = 0; a < fluid.dimension; ++a)
      if (fluid.symmetry.axis[a] && std::abs(x[a]) < near) x[a] = 0.0;
  const auto is_kept = [&](const Vec3& x) {
    for (int a = 0; a < fluid.dimension; ++a)
      if (fluid.symmetry.axis[a] && x[a] < 0.0) return false;
    return true;
  };
  for (const Vec3& x : whole->nodes)
    if (is_kept(x) && depth_in_walls(x, fluid) < -0.01 * spacing) {
      char place[120];
      std::snprintf(place, sizeof place, "(%.6g, %.6g, %.6g) m", x[0], x[1], x[2]);
      refuse(obstacle, "shape",
             std::string("it reaches beyond the walls, e.g. at ") + place +
                 "; move it inside, or let one of its flat faces lie in the wall");
    }
  const auto all = [&](const std::array<int, 4>& face, auto holds) {
    return std::all_of(face.begin(), face.end(), [&](int n) { return holds(whole->nodes[std::size_t(n)]); });
  };
  const Vec3 center = mass_properties(obstacle.shape, fluid.dimension, fluid.axisymmetric).centroid;
  std::vector<bool> dry = outside_of_all(*whole, obstacle, fluid);
  for (std::size_t f = 0; f < whole->faces.size(); ++f) {
    const auto& face = whole->faces[f];
    bool beyond = false, touches = all(face, [&](const Vec3&x) { return depth_in_walls(x, fluid) <= near; });
    for (int a = 0; a < fluid.dimension; ++a) {
      if (!fluid.symmetry.axis[a] || !all(face, [&](const Vec3& x) { return x[a] <= 0.0; })) continue;
      const bool axis = fluid.axisymmetric && a == 0;
      (cut[a] || axis ? beyond : touches) = true;
    }
    const std::array<Vec3, 4> corner = corners_of(face, whole->nodes);
    const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const Vec3 normal = (corner[2] - corner[0]).cross(corner[3] - corner[1]).normalized();
    const bool parts = touches && !beyond && can_move(obstacle, free, center, middle, normal);
    if (parts)
      for (const sph::Body& body : fluid.bodies)
        if (signed_distance(body.shape, middle, fluid.dimension) < 2.0 * spacing)
          refuse(obstacle, obstacle.motion == Motion::free ? "fixed" : "direction",
                 "it touches a wall or symmetry plane beside the water and may part from it, where contact is not built; let it "
                 "stand two spacings off, or hold it there (fixed)");
    dry[f] = dry[f] || beyond || (touches && !parts);
  }
  WetSurface wet = without(*whole, dry);
  if (wet.faces.empty()) refuse(obstacle, "shape", "nothing of it stands within the walls and symmetry planes; move it");
  return wet;
}

}  // namespace

RigidObstacle::RigidObstacle(const Obstacle& given, const sph::Settings& fluid)
    : given_(given),
      gravity_(fluid.gravity),
      dimension_(fluid.dimension),
      axisymmetric_(fluid.axisymmetric),
      cut_(cut_by(given, fluid)),
      free_(free_motions(given, fluid, cut_)),
      share_(std::pow(0.5, std::count(cut_.begin(), cut_.end(), true))),
      surface_(wet_surface(given, fluid, cut_, free_)),
      body_(body_of(given, fluid, free_, share_)) {
  if (given_.motion == Motion::free) {
    body_.set_motion(given_.velocity, given_.spin);
    ledger_.mass = body_.mass();
    start_momentum_ = body_.mass() * body_.velocity();
    find_stable_step(fluid);
  }
  if (given_.direction.norm() > 0) given_.direction.normalize();
  if (given_.motion == Motion::prescribed) lead(fluid.start_time);
}

/// The largest frequency of the body on the layer of water about it: of M q'' + (sum over faces of k A g g^T) q = 0 with g =
/// (n, (x - X) x n), by the body's free motions.
void RigidObstacle::find_stable_step(const sph::Settings& fluid) {
  const LiquidLayers liquids(fluid);
  std::vector<int> motions;
  for (int k = 0; k < 6; ++k)
    if (free_[std::size_t(k)]) motions.push_back(k);
  if (liquids.empty() || motions.empty()) return;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Matrix6 stiffness = Matrix6::Zero();
  double stiffest = 0;
  for (const auto& face : surface_.faces) {
    const std::array<Vec3, 4> corner = corners_of(face, surface_.nodes);
    const Vec3 middle = 0.25 * (corner[0] + corner[1] + corner[2] + corner[3]);
    const Vec3 normal = (corner[2] - corner[0]).cross(corner[3] - corner[1]).normalized();
    const double round = axisymmetric_ ? 2.0 * std::numbers::pi * middle[0] : 1.0;
    Eigen::Matrix<double, 6, 1> g;
    g << normal, (middle - body_.center()).cross(normal);
    const LiquidLayers::Layer& layer = liquids.nearest(middle);
    stiffness += layer.stiffness * round * face_area(face, surface_.nodes) * g * g.transpose();
    if (layer.stiffness > stiffest) {
      stiffest = layer.stiffness;
      liquid_ = layer.body->name;
    }
  }
  Matrix6 inertia = Matrix6::Identity() * body_.mass();
  inertia.bottomRightCorner<3, 3>() = body_.inertia();
  const Eigen::Index count = Eigen::Index(motions.size());
  Eigen::MatrixXd k(count, count), m(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      k(i, j) = stiffness(motions[std::size_t(i)], motions[std::size_t(j)]);
      m(i, j) = inertia(motions[std::size_t(i)], motions[std::size_t(j)]);
    }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m, Eigen::EigenvaluesOnly);
  const double fastest = modes.eigenvalues().maxCoeff();
  if (fastest > 0) stable_step_ = added_mass_share / std::sqrt(fastest);
}

sph::MirrorWall RigidObstacle::wall() const {
  sph::MirrorWall wall;
  wall.faces = surface_.faces;
  wall.rigid = true;
  show(body_, wall);
  return wall;
}

void RigidObstacle::show(const RigidBody& body, sph::MirrorWall& wall) const {
  wall.position.resize(surface_.nodes.size());
  wall.velocity.resize(surface_.nodes.size());
  const bool turns = !body.spin().isZero(0.0) || !body.rotation().isZero(0.0);
  const Vec3 shift = body.center() - body.start();
  for (std::size_t n = 0; n < surface_.nodes.size(); ++n) {
    wall.position[n] = turns ? body.place(surface_.nodes[n]) : Vec3(surface_.nodes[n] + shift);
    wall.velocity[n] = turns ? body.velocity_at(wall.position[n]) : body.velocity();
  }
}

void RigidObstacle::lead(double time) {
  body_.lead(body_.start() + integral_to(given_.time, given_.speed, time) * given_.direction -
                 integral_to(given_.time, given_.speed, 0.0) * given_.direction,
             value_at(given_.time, given_.speed, time) * given_.direction);
}

void RigidObstacle::kick(double time, double dt, const Vec3& impulse, const Vec3& moment) {
  const Vec3 weight = dt * body_.mass() * gravity_;
  const Vec3 force = dt * share_ * value_at(given_.time, given_.force, time) * given_.direction;
  const Vec3 velocity = body_.velocity(), spin = body_.spin();
  body_.kick(impulse + weight + force, moment);
  const Vec3 mean_velocity = 0.5 * (velocity + body_.velocity()), mean_spin = 0.5 * (spin + body_.spin());
  ledger_.work_received += impulse.dot(mean_velocity) + moment.dot(mean_spin);
  ledger_.gravity += weight.dot(mean_velocity);
  ledger_.external += force.dot(mean_velocity);
}

void RigidObstacle::set_out(double time, double dt, std::span<const Vec3> force, sph::MirrorWall& wall) {
  first_half_.resize(force.size());
  Vec3 impulse = Vec3::Zero();
  first_moment_.setZero();
  for (std::size_t n = 0; n < force.size(); ++n) {
    first_half_[n] = 0.5 * dt * force[n];
    impulse += first_half_[n];
    first_moment_ += (wall.position[n] - body_.center()).cross(first_half_[n]);
  }
  if (given_.motion == Motion::free) {
    kick(time, 0.5 * dt, impulse, first_moment_);
    body_.drift(dt);
    RigidBody ahead = body_;  // kicked as before once more
    ahead.kick(impulse + 0.5 * dt * body_.mass() * gravity_ +
                   0.5 * dt * share_ * value_at(given_.time, given_.force, time + dt) * given_.direction,
               first_moment_);
    show(ahead, wall);
  } else if (given_.motion == Motion::prescribed) {
    const double work = impulse.dot(body_.velocity());
    ledger_.work_received += work;
    ledger_.external -= work;
    lead(time + dt);
    show(body_, wall);
  }
}

void RigidObstacle::arrive(double time, double dt, sph::MirrorWall& wall) {
  Vec3 all = Vec3::Zero(), rest = Vec3::Zero(), moment = Vec3::Zero();
  for (std::size_t n = 0; n < wall.impulse.size(); ++n) {
    const Vec3 given = std::exchange(wall.impulse[n], Vec3::Zero()), late = given - first_half_[n];
    all += given;
    ledger_.exchanged += given.norm();
    rest += late;
    moment += (wall.position[n] - body_.center()).cross(late);
  }
  ledger_.received += all;
  ledger_.turning += first_moment_ + moment;
  last_force_ = all / dt;
  last_moment_ = (first_moment_ + moment) / dt;
  if (given_.motion == Motion::free) {
    kick(time, 0.5 * dt, rest, moment);
  } else if (given_.motion == Motion::prescribed) {
    const double work = rest.dot(body_.velocity());
    ledger_.work_received += work;
    ledger_.external -= work;
  }
}

double RigidObstacle::signed_distance(const Vec3& x) const {
  return undex::signed_distance(given_.shape, body_.place_at_start(x), dimension_);
}

std::vector<Vec3> RigidObstacle::places() const {
  std::vector<Vec3> all;
  for (const Vec3& x : surface_.nodes) all.push_back(body_.place(x));
  return all;
}

ObstacleLedger RigidObstacle::ledger() const {
  ObstacleLedger now = ledger_;
  if (given_.motion == Motion::free) {
    now.momentum = body_.mass() * body_.velocity();
    now.kinetic = body_.kinetic_energy();
  }
  now.outside = now.momentum - start_momentum_ - now.received;
  return now;
}

ObstacleState RigidObstacle::state() const {
  ObstacleState now{.mass = {},
                    .displacement = body_.center() - body_.start(),
                    .position = body_.center(),
                    .velocity = body_.velocity(),
                    .rotation = body_.rotation(),
                    .spin = body_.spin(),
                    .force = last_force_ / share_,
                    .moment = last_moment_ / share_,
                    .impulse = ledger_.received / share_};
  if (given_.motion == Motion::free) now.mass = body_.mass() / share_;
  for (int a = 0; a < 3; ++a) {
    const bool balanced = cut_[a] || (axisymmetric_ ? a != 1 : a >= dimension_);
    if (balanced) now.force[a] = now.impulse[a] = 0.0;
    bool turned = axisymmetric_ || dimension_ == 1 || (dimension_ == 2 && a != 2);
    for (int b = 0; b < 3; ++b) turned = turned || (b != a && cut_[b]);
    if (turned) now.moment[a] = 0.0;
  }
  return now;
}

std::string RigidObstacle::description() const {
  std::string text =
      "obstacle " + given_.name + ": " + std::to_string(surface_.faces.size()) + " faces, " + word_of(given_.motion);
  if (given_.motion == Motion::free) {
    char numbers[120];
    std::snprintf(numbers, sizeof numbers, ", %.6g kg%s", body_.mass() / share_,
                  axisymmetric_ || dimension_ == 3 ? ""
                  : dimension_ == 2                ? "/m"
                                                   : "/m^2");
    text += numbers;
    constexpr const char* names[] = {"x", "y", "z", "rx", "ry", "rz"};
    std::string moves;
    for (int k = 0; k < 6; ++k)
      if (free_[std::size_t(k)]) moves += std::string(moves.empty() ? "" : " ") + names[k];
    text += moves.empty() ? ", held" : ", free along " + moves;
    if (axisymmetric_) text.replace(text.rfind('y'), 1, "the axis");
  }
  return text + "\n";
}

void RigidObstacle::visit_state(StateVisitor& state) {
  state.part("body", [&] { body_.visit_state(state); });
  state("received", ledger_.received);
  state("turning", ledger_.turning);
  state("exchanged", ledger_.exchanged);
  state("work received", ledger_.work_received);
  state("external", ledger_.external);
  state("gravity", ledger_.gravity);
  state("last force", last_force_);
  state("last moment", last_moment_);
}

}  // namespace undex::coupling
