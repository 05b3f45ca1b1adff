// A deforming body, of finite elements or of particles, as all others see it: it is advanced in time under impulses on its wet
// surface, it shows that surface, it finds and reads material points, and it keeps a ledger. Who couples, probes, records or
// writes it need not know what it is made of.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/largest.hpp"
#include "core/point_values.hpp"
#include "core/state.hpp"
#include "core/surface.hpp"
#include "core/timers.hpp"

namespace undex {

/// Energy [J], momentum and mass of the computed part of a body (an octant, say), booked since the start.
struct BodyLedger {
  double kinetic = 0;
  double elastic = 0;   ///< stored, hourglass energy included
  double plastic = 0;   ///< plastic work
  double viscous = 0;   ///< by viscosity, and what contact between bodies has taken
  double impact = 0;    ///< kinetic energy of nodes lost as they hit rigid planes (vanishes with their mass)
  double received = 0;  ///< work of the impulses that others gave: water, across the interface
  double external = 0;  ///< work of prescribed loads, and of rigid planes on particles (never positive)
  double gravity = 0;   ///< work of gravity
  /// What the time integrator has held back or made, a term of second order in the step that is known exactly: central
  /// differences conserve energy with the product of the two half-step velocities in place of the square of the mean,
  /// and lose or gain as much whenever the step or a force jumps. Zero at the start.
  double integrator = 0;
  double mass = 0;                       ///< [kg]
  Vec3 momentum = Vec3::Zero();          ///< [kg m/s]
  Vec3 impulse = Vec3::Zero();           ///< of prescribed loads and rigid planes [N s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin [kg m^2/s]

  BodyLedger& operator+=(const BodyLedger& other);

  /// Stays at its first value, but for what finite strain within a step leaves.
  double balance() const { return kinetic + integrator + elastic + plastic + viscous + impact - received - external - gravity; }
};

/// A material point of a body, found once and read at any time: means of what carries the body, by weights whose sum is 1.
struct BodyPoint {
  struct Share {
    std::uint32_t carrier;
    double weight;
    unsigned image = 0;  ///< mirrored across which planes (bit a: axis a)
  };
  std::vector<Share> motion;  ///< of nodes, or particles
  std::vector<Share> state;   ///< of quadrature points, for stress and temperature; empty: those of the motion
  double distance = 0;        ///< from the asked-for place to the body, or to its nearest particle [m]
};

/// Adds what acts on a point to what acts on each of its nodes or particles, by the weights of its motion.
void scatter_to_carriers(const BodyPoint& point, const Vec3& given, std::vector<Vec3>& to);

/// How many of what a body is made of.
struct BodySize {
  std::size_t particles = 0, cells = 0, nodes = 0;
};

/// A body's fields at one time. Without cells its points are particles.
struct BodySnapshot {
  struct Field {
    std::string name;
    int components;  ///< per point or cell, interleaved
    std::vector<double> values;
  };
  std::vector<Vec3> position;             ///< of nodes or particles [m]
  std::vector<std::array<int, 8>> cells;  ///< nodes in VTK's order, of hexahedra or of a meridian (core/hexahedral_mesh.hpp)
  std::vector<Field> of_points, of_cells;
};

/// What moves under impulses on its wet surface: one body, or several as one (coupling/body_group.hpp).
class WetBody {
 public:
  virtual ~WetBody() = default;

  virtual double time() const = 0;  ///< [s]
  virtual long steps() const = 0;
  /// Largest stable step [s] of the present state times a Courant number, and in words the cell or particle that sets it.
  virtual double stable_step() const = 0;
  virtual std::string stable_step_owner() const = 0;
  /// Advances to t_end [s] in steps none of which is longer than stable_step(), while the nodes of wet_surface() receive exactly
  /// `impulse` [N s] each (may be empty), spread evenly. Throws NumericalStop (core/errors.hpp) naming step, time and place when
  /// a step cannot be taken; positions and velocities are finite then.
  virtual void advance(double t_end, std::span<const Vec3> impulse = {}) = 0;

  /// The faces that water touches; none where the body is not coupled by faces.
  virtual const WetSurface& wet_surface() const = 0;
  /// Its faces by name; what is not named is in none.
  virtual std::vector<NamedFaces> wet_faces() const { return {}; }
  /// Where the nodes of each wall begin that it is for the water, which share no face, and the count of all.
  virtual std::vector<std::size_t> wet_walls() const { return {0, wet_surface().nodes.size()}; }
  /// Of its nodes, in its order, at time(): [m], [m/s], [m/s^2]. Accelerations still hold the impulse of the last advance().
  virtual std::span<const Vec3> wet_positions() const = 0;
  virtual std::span<const Vec3> wet_velocities() const = 0;
  virtual std::span<const Vec3> wet_accelerations() const = 0;
  /// Mass [kg] that the water must move to move each of them, at the start.
  virtual std::span<const double> wet_masses() const = 0;

  virtual BodyLedger ledger() const = 0;

 protected:
  WetBody() = default;
  WetBody(WetBody&&) = default;
  WetBody& operator=(WetBody&&) = default;
};

class DeformableBody : public WetBody {
 public:
  /// The material point at a place [m] of the start (the nearest to it), and what it is now.
  virtual BodyPoint locate(const Vec3& reference_position) const = 0;
  virtual MaterialPoint read(const BodyPoint& point) const = 0;
  /// Where the point of the surface is [m], whenever asked, that lies nearest to a place at the start; empty where none lies
  /// within `reach` [m]. Valid as long as the body is. Here: on the wet faces.
  virtual std::function<Vec3()> follow_surface(const Vec3& reference_position, double reach) const;

  /// What the next step goes on from, and what others read until then.
  virtual void visit_state(StateVisitor& state) = 0;

  virtual std::span<const Vec3> positions() const = 0;  ///< of nodes or particles [m]
  virtual std::span<const double> masses() const = 0;   ///< of the same [kg]
  /// Largest values now, of each of the parts it is made of: of particles also the pressure.
  virtual std::vector<LargestOf> largest() const { return {}; }
  virtual double maximum_pressure() const { return 0.0; }  ///< of particles [Pa]
  /// Position and fields. Of particles those that are named; elements give all that they have.
  virtual BodySnapshot snapshot(std::span<const std::string> fields) const = 0;

  virtual BodySize size() const = 0;
  /// What it is made of, in whole lines.
  virtual std::string description() const = 0;
  virtual std::size_t memory_bytes() const = 0;
  virtual const PassTimers& timers() const = 0;
};

}  // namespace undex
