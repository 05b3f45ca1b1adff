// Faces through which waves leave. Each is a wall without mass that moves with the fluid (walls/radiating_mesh.hpp), with the
// velocity and the pressure that the same medium, at rest and without end behind it, gives it:
//   v . n = (u + (q + w) cos a)/2,   p = p0 + (Z + Z0)/2 (q + u/cos a - w)/2,   q = 2 (p - p0)/(Z + Z0),   Z = rho c,
// u, p and Z on the right being the fluid's before the face (u along its normal n), p0 and Z0 those at rest. An outgoing simple
// wave has u = (q + w) cos a, so that nothing comes back; the means are the Riemann problem of the face, and take in what does
// not fit. Spherical waves from a source at the distance r leave an afterflow w behind,
//   dw/dt = k (h + v^2/2)/r - 2 k w v/r,   h = 2 (p - p0)/(rho + rho0),   k = 1 (1/2 of cylindrical ones, in a plane),
// v being the velocity away from the source: exact for sound, and for incompressible flow at any speed. The angle a of the wave
// to the normal is known from the source; without one the motion along the face shows it, sin^2 a = <u_t^2>/<q^2>.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/state.hpp"
#include "sph_fluid/walls/mirror_feet.hpp"
#include "sph_fluid/walls/radiating_mesh.hpp"
#include "sph_fluid/water/particle_set.hpp"

namespace undex::sph {

class RadiatingFaces {
 public:
  /// Its meshes become the first mirrors of `walls`.
  RadiatingFaces(const Settings& settings, MovingWalls& walls);

  bool empty() const { return faces_.empty(); }

  /// Velocities of the faces at `time` [s] from the state that is predicted of the particles at `feet`.
  void see(const ParticleSet& set, std::span<const WallFoot> feet, double time);
  /// Moves the faces on by dt [s]. Throws NumericalStop where a face cannot go on; nothing has moved then.
  void advance(double dt);

  /// Begins anew: faces at their first places, before a fluid that they have not seen.
  void begin_anew();
  std::size_t count() const { return faces_.size(); }

  /// Momentum that has left through the faces [kg m/s].
  Vec3 momentum() const;

  /// What outlasts a step beside the walls' motion; per face and node, but for the last two.
  struct State {
    PointLoads velocity_before;                                ///< [m/s]
    std::vector<std::vector<double>> flow, rate, rate_before;  ///< w [m/s], dw/dt [m/s^2]
    std::vector<std::vector<double>> wave, along;              ///< q^2, u_t^2 at the last evaluation [m^2/s^2]
    std::vector<std::vector<double>> mean_wave, mean_along;    ///< and their means over the last few spacings' way of sound
    double last_step = 0, reached = 0;                         ///< [s]; the time for which the faces stand
  };
  const State& state() const { return state_; }
  void go_back_to(const State& state) { state_ = state; }
  void visit_state(StateVisitor& state);

 private:
  /// What a node sees of the fluid before it.
  struct Seen {
    double weight = 0, foreign = 0;  ///< of the medium that stood there at the start, and of others
    double wave = 0, enthalpy = 0;   ///< q [m/s], h [m^2/s^2]
    double impedance = 0;            ///< (Z + Z0)/2 [Pa s/m]
    Vec3 velocity = Vec3::Zero();    ///< [m/s]
    /// Weights of the layers before the face and their pressures over that at rest [Pa].
    std::array<double, seen_depths> in_layer{}, over{};
  };
  using SeenByNodes = std::vector<std::vector<Seen>>;
  /// A body at rest.
  struct Rest {
    double pressure, density, sound;
    std::optional<materials::HydrostaticColumn> column;

    double pressure_at(const Vec3& x, const Settings& settings, const Body& body) const;
  };

  MirrorWall& wall(std::size_t face) { return walls_.mirrors[face]; }
  const MirrorWall& wall(std::size_t face) const { return walls_.mirrors[face]; }
  void begin(const ParticleSet& set, std::span<const WallFoot> feet);
  SeenByNodes look(const ParticleSet& set, std::span<const WallFoot> feet) const;
  void watch_strangers(const ParticleSet& set, const SeenByNodes& seen);
  /// An outgoing wave at a face.
  struct Outgoing {
    double flow, cosine;  ///< w [m/s], cos a
  };
  Outgoing spherical(std::size_t face, std::size_t node, const Seen& seen, double time);
  Outgoing plane(std::size_t face, std::size_t node) const;
  /// Speed of a face's nodes along their normals [m/s], and their pressures.
  std::vector<double> answer(std::size_t face, const std::vector<Seen>& seen, double time);
  std::size_t body_of(std::size_t face, std::size_t node) const { return std::size_t(std::max(0, body_[face][node])); }
  void require_mesh(std::size_t face, const std::vector<Vec3>& moved) const;

  const Settings& settings_;
  MovingWalls& walls_;
  std::vector<RadiatingMesh> faces_;  ///< their walls are in `walls_`
  std::vector<SharedNode> shared_;
  std::vector<Rest> rest_;                  ///< per body; empty before the first evaluation
  std::vector<std::vector<int>> body_;      ///< most of what stood before the nodes at the start; -1: nothing
  std::vector<std::vector<int>> medium_;    ///< and its medium's number (Group::material)
  std::vector<std::vector<double>> whole_;  ///< weight that they saw at the start
  State state_;
  std::string trouble_;
};

}  // namespace undex::sph
