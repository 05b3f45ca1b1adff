// One-dimensional Lagrangian hydrodynamics in planar, cylindrical or spherical symmetry: runs of scenes that need one coordinate,
// converged solutions for tests and comparisons, and the state from which a run with a spherical start begins. SI units.
//
// Staggered mesh: radius r and velocity u live on nodes, density, specific energy e and pressure p in cells
// of fixed mass m. With A the area of a node's face, P = p + q and M a node's mass (half of each neighbour's),
//   M du/dt = A (P_inside - P_outside) + M g,   m de/dt = -P dV/dt,   dr/dt = u      (g: gravity, planar alone).
// The energy of a cell is changed by the very forces that move its two nodes, over the mean of their old and
// new velocities; so kinetic plus internal energy keeps its value to round-off, whatever the step (the
// "compatible" form of E. J. Caramana, D. E. Burton, M. J. Shashkov, P. P. Whalen, J. Comput. Phys. 146,
// 1998). Time: predictor and corrector, second order; for small waves stable up to a Courant number of one.
// Shocks: artificial pressure q = (1 - psi) rho |du| (a1 c + a2 |du|) in cells that shrink (von Neumann and
// Richtmyer's square, Landshoff's linear part), where psi, a limiter on the ratios of neighbouring velocity
// gradients, takes it out of smooth compression (R. B. Christensen's form).
//
// Solids, in planar and spherical symmetry: the deviator of the stress is s along the radius and -s/2 across it, by the update
// that all discretisations share (materials/stress_update.hpp). With V a cell's volume and r1, r2, u1, u2 its nodes, it works
// at the rate
//   V s ((u2 - u1)/(r2 - r1) - (u1 + u2)/(r1 + r2))     (planar: the first term alone),
// whose derivatives with respect to u1 and u2 are the forces on the two nodes: energy is conserved as above.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/state.hpp"
#include "materials/burn.hpp"
#include "materials/equation_of_state.hpp"
#include "materials/solid.hpp"

namespace undex::exact {

/// State at the start of one point of a layer.
struct StartPoint {
  double density, velocity, energy;  ///< [kg/m^3], outward [m/s], specific [J/kg]
};

/// A layer of one fluid or solid, uniform at the start unless `start` says otherwise. Solids begin without a deviator.
struct Layer {
  std::variant<materials::FluidLaw, materials::Solid> law;
  double inner = 0.0, outer = 0.0;  ///< radii (planar: positions) of its ends [m]
  int cells = 0;                    ///< at least one
  double ratio = 1.0;               ///< width of a cell over that of its inner neighbour
  double density = 0.0;             ///< [kg/m^3]
  /// Specific energy [J/kg]; not used with barotropic laws, whose layers start at their compression energy.
  double energy = 0.0;
  double velocity = 0.0;  ///< outward [m/s]
  /// Burn of an explosive whose products follow `law`, which must be Jwl; the burn's points are (r, 0, 0)
  /// with r the initial radius of the cell's middle. Front widths of three cells or more keep the front
  /// smooth.
  std::optional<materials::ProgrammedBurn> burn = {};
  /// A start that is not uniform, in place of density, energy and velocity above: asked for at the cells' middles (the
  /// velocity: at the nodes).
  std::function<StartPoint(double radius)> start = {};
  /// Ends of its cells but the first and the last, from the inside out [m]: as many as `cells` needs; empty: as `ratio` says.
  std::vector<double> places = {};
};

/// Ratio of neighbouring widths with which `cells` cells fill `length` [m], the first being `first` [m] wide.
/// Throws std::invalid_argument unless 0 < first < length and cells >= 2.
double grading(double length, int cells, double first);

enum class Boundary {
  rigid,  ///< does not move; also the centre and a plane of symmetry
  free,   ///< pressure held at the given value, zero unless told otherwise
  /// Lets simple waves of any strength out into the same fluid, at rest and without end; in a sphere with their afterflow w:
  /// u = q + w, q = 2 (p - p_start)/(Z + Z_start), dw/dt = k (h + u^2/2)/r - 2 k w u/r, h = 2 (p - p_start)/(rho + rho_start),
  /// k = 1 (1/2 in a cylinder, 0 in a plane). An inner end has no afterflow.
  radiating,
  transmitting,  ///< lets normal sound waves of the last cell out: p = p_start + rho c (u - u_start)
};

/// Numbers of the scheme, with defaults that suit gases, water and detonation products.
struct Lagrangian1DOptions {
  double linear_viscosity = 0.25, quadratic_viscosity = 1.5;  ///< a1, a2 [-]
  bool limiter = true;                                        ///< psi; without it q acts in every compression
  double courant = 0.7;                                       ///< [-], below 1
  double inner_pressure = 0.0, outer_pressure = 0.0;          ///< outside of a free boundary [Pa]
  /// Mass per area [kg/m^2] that rides on a free boundary: a rigid plate, at rest at the start, with the outside pressure
  /// (zero: vacuum) behind it.
  double inner_mass = 0.0, outer_mass = 0.0;
  /// What acts on a free outer end beside `outer_pressure`, on its plate say, over time [Pa].
  std::function<double(double time)> outer_load = {};
  double gravity = 0.0;  ///< outward, on everything [m/s^2]; planar alone
  /// The surroundings' pressure: what solids are without stress under [Pa].
  double ambient = 0.0;
  /// Set: the first wave's front in a uniform fluid at rest is followed as a discontinuity (fitted_front.cpp), and cells begin at
  /// it with that width [m]. Empty: it is smeared over some cells, as every other shock.
  std::function<double(double radius)> front_width = {};
  /// With `front_width`: pressures on the two sides of a contact that differ by no more do not move it until a wave comes [Pa].
  double held_pressure = 0.0;
};

/// State at a point.
struct PointState {
  double density;   ///< [kg/m^3]
  double velocity;  ///< outward [m/s]
  double energy;    ///< specific internal energy [J/kg], see Lagrangian1D::energy
  double pressure;  ///< [Pa], without the artificial part
  int layer;        ///< index of the layer
};

/// Integrals over an interval of radius; per area [m^2] in planar, per length [m] in cylindrical symmetry.
struct IntervalIntegral {
  double volume = 0.0;           ///< [m^3]
  double mass = 0.0;             ///< [kg]
  double momentum = 0.0;         ///< sum of mass times OUTWARD velocity [kg m/s]; in a sphere not a vector sum
  double kinetic_energy = 0.0;   ///< [J]
  double internal_energy = 0.0;  ///< [J]
  double pressure_volume = 0.0;  ///< integral of the pressure over the volume [J]

  double density() const { return mass / volume; }              ///< mean [kg/m^3]
  double velocity() const { return momentum / mass; }           ///< mean by mass [m/s]
  double energy() const { return internal_energy / mass; }      ///< mean by mass [J/kg]
  double pressure() const { return pressure_volume / volume; }  ///< mean by volume [Pa]
  /// Specific energy [J/kg] which, together with the kinetic energy of the mean velocity, holds all the
  /// energy of the interval: the internal energy to give to one body that replaces it.
  double energy_with_lost_motion() const { return (internal_energy + kinetic_energy) / mass - 0.5 * velocity() * velocity(); }
};

/// State of cells of solids; of others zero.
struct SolidCells {
  std::vector<double> deviator;        ///< s of the stress along the radius, tension positive [Pa]
  std::vector<double> plastic_strain;  ///< [-]
  std::vector<double> temperature;     ///< [K]
  std::vector<double> damage;          ///< [-], failed at 1
  std::vector<double> plastic_energy;  ///< plastic work so far [J]

  /// Each array with its name.
  void for_each(auto&& visit) {
    visit("deviator", deviator);
    visit("plastic strain", plastic_strain);
    visit("temperature", temperature);
    visit("damage", damage);
    visit("plastic energy", plastic_energy);
  }
};

class Lagrangian1D {
 public:
  /// dimension: 1 planar, 2 cylindrical, 3 spherical. The layers touch one another, from the inside out. A
  /// node between layers of different velocity starts with their mean by mass. Throws std::invalid_argument
  /// with the values on layers that do not fit.
  Lagrangian1D(int dimension, std::vector<Layer> layers, Boundary inner = Boundary::rigid, Boundary outer = Boundary::rigid,
               const Lagrangian1DOptions& options = {});

  /// Steps until exactly t_end [s]; does nothing when t_end has passed. Throws NumericalStop
  /// (core/errors.hpp) naming cell and time when a cell turns inside out or a state is not finite.
  void advance(double t_end);
  /// One stable step, not beyond t_end [s]; returns its size [s]. Throws as `advance`.
  double step_towards(double t_end);

  /// What the next step goes on from.
  void visit_state(StateVisitor& state);

  /// Charges that have burned are products from now on: the sound speed of what burns, which is at least D/2, limits the step.
  void end_burns();

  /// Merges neighbouring cells of a layer where the two together are no wider than `width` [m]: an outgoing wave grows longer and
  /// asks for less. Mass, momentum (but at a rigid end) and the sum of kinetic and internal energy stay what they are; what the
  /// node between two cells had of motion beyond its neighbours becomes their heat. Cells that nothing has reached, and layers
  /// that still burn, are left alone, and no layer keeps fewer than `least` cells.
  void coarsen(double width, int least = 1) {
    coarsen([width](double) { return width; }, least);
  }
  /// The same with a width for each place [m].
  void coarsen(const std::function<double(double place)>& width, int least = 1);

  double time() const { return time_; }
  long steps() const { return steps_; }
  int dimension() const { return dimension_; }
  int cells() const { return static_cast<int>(cell_mass_.size()); }
  int layers() const { return static_cast<int>(layers_.size()); }
  std::span<const double> node_radius() const { return r_; }     ///< [cells + 1], [m]
  std::span<const double> node_velocity() const { return u_; }   ///< [cells + 1], outward [m/s]
  std::span<const double> cell_density() const { return rho_; }  ///< [cells], [kg/m^3]
  /// [cells], specific internal energy [J/kg]. In barotropic cells compression energy plus the heat that
  /// shocks have left, which does not act back on their pressure.
  std::span<const double> cell_energy() const { return e_; }
  std::span<const double> cell_pressure() const { return p_; }  ///< [cells], without the artificial part [Pa]
  std::span<const double> cell_sound() const { return c_; }     ///< [cells], [m/s]
  /// [cells], [kg]; per area [m^2] in planar, per length [m] in cylindrical symmetry, as all sums below.
  std::span<const double> cell_mass() const { return cell_mass_; }
  std::span<const int> cell_layer() const { return cell_layer_; }   ///< [cells]
  std::span<const double> node_mass() const { return node_mass_; }  ///< [cells + 1], plates included [kg]
  const Layer& layer(int k) const { return layers_.at(k); }
  int first_cell(int layer) const { return blocks_.at(layer).begin; }
  const SolidCells& solids() const { return solids_; }  ///< [cells]; empty where there is no solid
  double interface_radius(int layer) const;             ///< outer end of that layer, now [m]

  double kinetic_energy() const;   ///< [J]
  double internal_energy() const;  ///< [J]
  /// Kinetic (plates included) plus internal [J]. total_energy() + boundary_work() is conserved to round-off.
  double total_energy() const { return kinetic_energy() + internal_energy(); }
  /// Work done on what lies outside of free and transmitting boundaries, and against gravity, since the start [J].
  double boundary_work() const { return boundary_work_; }
  /// What of it gravity has done, as work on the mesh [J].
  double gravity_work() const { return gravity_work_; }
  /// Share of the internal energy that is heat left by shocks in barotropic layers [J].
  double barotropic_heat() const;

  /// State at `radius` [m]: velocity linear between nodes, the rest linear between the middles of cells of
  /// one layer, never across a contact. Throws std::out_of_range outside of the mesh.
  PointState at(double radius) const;

  /// Exact integrals of the discrete state over [from, to] [m], only of that layer if one is named (>= 0).
  /// Density and energy are uniform in a cell, and each half of a cell's mass moves with its own node, so
  /// that intervals which tile the mesh add up to the mass, momentum and energy of the whole. Parts outside
  /// the mesh are empty.
  IntervalIntegral integral(double from, double to, int layer = -1) const;

  /// Outermost radius [m] at which the pressure exceeds that of the outermost cell at the start by
  /// `threshold` [Pa], linear between the middles of cells; the radius of the inner end where there is none.
  double shock_front(double threshold) const;

  /// Outermost radius [m] up to `limit` [m] at which the density is other than at the start by more than that share; that of the
  /// inner end where there is none.
  double front(double share, double limit) const;

  /// Is the first wave's front followed as a discontinuity now?
  bool front_is_fitted() const { return front_cell_ >= 0; }
  /// Where it is [m] and how fast it runs [m/s]; only where it is followed.
  double front_radius() const { return r_[front_cell_ + 1]; }
  double front_speed() const { return front_.speed; }
  /// Has anything reached the outer end?
  bool reached_outer_end() const { return active_ + 1 >= cells(); }
  /// Velocity [m/s] with which the inner half of a cell's mass moves: its inner node's, but at rest ahead of the front.
  double inner_velocity(int cell) const { return front_cell_ >= 0 && cell == front_cell_ + 1 ? 0.0 : u_[cell]; }

 private:
  /// State behind the followed front, which runs at `speed` into fluid at rest.
  struct Front {
    double speed, pressure, density, energy;
  };
  struct Block {
    int begin, end;         // cells
    double stiffest_sound;  // of the liquid, where the law gives that of its bubbly mixture [m/s]
  };
  double volume_to(double radius) const;           // enclosed [m^3]
  double mean_area(double from, double to) const;  // swept volume over distance [m^2]
  double middle(int cell) const;                   // radius that halves the cell's volume [m]
  double outside_pressure(bool outer, double u, double rho, double sound, double time) const {
    return outside_pressure(outer, u, rho, sound, time, flow_);
  }
  /// `flow`: the afterflow at a radiating outer end [m/s], then.
  double outside_pressure(bool outer, double u, double rho, double sound, double time, double flow) const;
  /// dw/dt of it [m/s^2].
  double flow_rate(double r, double u, double rho, double sound, double flow) const;
  /// Pressure and artificial pressure of the cells from `begin` to below `end`.
  void pressures(int begin, int end, double time, const std::vector<double>& r, const std::vector<double>& u,
                 const std::vector<double>& rho, const std::vector<double>& e, std::vector<double>& p, std::vector<double>& q);
  /// The same of solids; damage of what spalls is set.
  void solid_pressures(const materials::Solid& solid, int begin, int end, const std::vector<double>& rho,
                       const std::vector<double>& e, std::vector<double>& p);
  /// What the deviators of solids give to the nodes of each cell below `end`, with that share of the new ones, at mean places.
  void deviator_forces(int end, double share, const std::vector<double>& r);
  /// Deviators and what goes with them at the end of a step whose new places and velocities are there.
  void advance_deviators(int end, double dt);
  /// Temperature of solids by compression and shocks, before the step's last pressures.
  void warm(int end);
  double stable_step() const;
  void step(double dt);
  void update_active();
  void fill_new();  // all cells of the coming state are those of the present one until a step has reached them
  bool still_burns(int layer) const;
  /// Puts what solids have in one cell, or in that and its neighbour, into the cell `into` at or before them.
  void merge_solids(int one, int other, int into);
  /// Adds a mass [kg] of that velocity to a node; returns the kinetic energy [J] that is lost.
  double add_to_node(int node, double mass, double velocity);

  /// Drops the node between a cell and the next, of those masses [kg]: where velocity is linear over the mass, what is left of it
  /// stays. Returns the kinetic energy [J] that is lost, or with a minus gained.
  double drop_node(int cell, double inner, double outer);

  // The followed front: fitted_front.cpp.
  bool can_follow_in(int layer) const;
  int next_followed_layer() const;  // the first one ahead whose front will be followed; the number of layers without one
  bool still_waits(int layer) const;
  void start_following();
  Front front_at(double velocity) const;
  void move_front(double dt, double speed, double total);
  void fill_front_cell(double dt, double total);
  void keep_front_cell();
  void tend_front();
  void split_front_cell();
  void end_following();
  double step_to_layers_end() const;

  std::vector<std::vector<double>*> cell_arrays();  // all with a value a cell
  std::vector<std::vector<double>*> node_arrays();  // all with a value a node
  void insert_cell(int cell);
  void erase_cell(int cell);
  void count_blocks(int layer, int more);

  int dimension_;
  double area_factor_;  // area of a unit radius: 1, 2 pi, 4 pi
  std::vector<Layer> layers_;
  std::vector<Block> blocks_;
  Boundary inner_, outer_;
  Lagrangian1DOptions options_;

  // State.
  double time_ = 0.0, last_step_ = 0.0, boundary_work_ = 0.0, gravity_work_ = 0.0;
  long steps_ = 0;
  std::vector<double> r_, u_, e_;
  SolidCells solids_;
  // Fixed at the start.
  std::vector<double> cell_mass_, node_mass_, start_volume_, start_density_, start_middle_;
  std::vector<int> cell_layer_;
  double inner_start_pressure_ = 0.0, outer_start_pressure_ = 0.0;
  double inner_start_density_ = 0.0, outer_start_density_ = 0.0, inner_start_sound_ = 0.0, outer_start_sound_ = 0.0;
  double flow_ = 0.0;  // w [m/s]
  double inner_start_velocity_ = 0.0, outer_start_velocity_ = 0.0;
  // Follows from the state.
  std::vector<double> rho_, p_, q_, c_, viscous_sound_;
  int active_ = 0;  // nodes beyond it are at rest and in balance
  // Of the followed front: the cell that it fills; its outer node is the front, and the next cell is what is left at rest of one.
  int front_cell_ = -1;
  Front front_{};
  double front_volume_ = 0.0;  // that it sweeps in the present step [m^3]
  // Scratch of a step.
  std::vector<double> r_new_, u_new_, rho_new_, e_new_, p_new_, q_new_, area_, slope_;
  SolidCells solids_new_;
  std::vector<double> push_in_, push_out_;  // of the deviator, on a cell's inner and outer node [N]
};

}  // namespace undex::exact
