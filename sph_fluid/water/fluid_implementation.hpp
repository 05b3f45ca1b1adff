// What a Fluid is made of: the water, its integrators, set-up (start.cpp) and what others ask (queries.cpp).
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "sph_fluid/lattice.hpp"
#include "sph_fluid/water/local_steps.hpp"
#include "sph_fluid/water/water.hpp"

namespace undex::sph {

struct Fluid::Implementation : Water {
  LocalSteps local_steps;
  double lifted = 0;          // fall() at the start [J]
  double filled = 0;          // volume() at the start [m^3]
  bool limits_known = false;  // has step_limit been asked since the last step?

  explicit Implementation(const Settings& settings);

  // Set-up: start.cpp.
  /// All but the walls as at the start, with particles in these places.
  void begin(std::vector<BodyParticles> bodies);
  void settle(const SettleNews& news);
  /// Returns the largest |g| h left.
  double settle_in_place(std::vector<BodyParticles>& bodies, const SettleNews& news);
  /// Areas fill the meridian as particles fill a plane: it is settled as one, and the rings' volumes follow, but for their sum.
  void settle_section(std::vector<BodyParticles>& bodies, double goal, const SettleNews& news) const;
  void fill(std::vector<BodyParticles> bodies);
  /// The particles become those that are laid already.
  void take(const LaidParticles& laid, const Group& group);
  /// Replaces a body's uniform start; mass, kinetic energy and (with an energy field) internal energy become exact.
  void lay_on(const StartField& start, Group& group);
  /// The same of a start that is exact: all masses become `heavier`.
  void make_exact(const StartField& start, const Group& group, double heavier);
  /// Adds the pressure of a column at rest, beyond the rest that the state was computed for, to a body's state; volumes stay.
  void weigh_down(const Group& group, const materials::HydrostaticColumn& column, double rest_pressure);
  /// Sum of m g . x [J]: what it has grown by is gravity's work.
  double fall() const;
  /// Sum of m/rho [m^3], where surroundings press on it; else 0.
  double volume() const;

  // The step: step.cpp.
  void step(double dt);
  /// A step of several evaluations. Where one goes wrong, all is put back to the step's beginning and has no rates.
  template <class Step>
  void step_or_stay(double dt, Step step);
  /// A wall has joined: rates are no longer those of the scene.
  void expect_walls();

  // The state between two steps: state.cpp.
  void visit_state(StateVisitor& state);
  void find_rates_anew();

  // What others ask: queries.cpp.
  StepLimit step_limit();
  Ledger ledger() const;
  std::vector<BodyTotals> totals() const;
  std::vector<LargestOf> largest_of_bodies() const;
  /// Calls visit(index, distance, group, image) for every particle, images included, within `radius_over_h` of its own h of the
  /// point.
  template <class Visit>
  void around(const Vec3& point, double radius_over_h, Visit visit) const;
  /// Shepard average with Wendland's kernel at h = 1.2 spacings, whatever the scheme's own.
  FluidPoint at(const Vec3& point) const;
  std::vector<double> field(std::string_view name) const;
  template <class F>
  double largest(F f) const {
    double result = 0;
#pragma omp parallel for schedule(static) reduction(max : result)
    for (std::size_t i = 0; i < all.particles.size(); ++i) result = std::max(result, f(i));
    return result;
  }
};

}  // namespace undex::sph
