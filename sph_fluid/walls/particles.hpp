// The fluid's particles: every array of theirs, listed once (state_arrays, further_arrays). Sorting, keeping and restoring,
// reflecting, copying to a set of some and back, counting memory and output go through the lists; an array that is in none does
// not compile.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/state.hpp"
#include "sph_fluid/pairs/rows.hpp"

namespace undex::sph {

/// Rates one evaluation earlier, for the predictor; they only shape a correction, so single precision serves.
struct EarlierRates {
  float ax = 0, ay = 0, az = 0;  ///< [m/s^2]
  float compression = 0;         ///< [1/s]
};

/// Rates that a set of particles holds beside those it advances by (local_steps.hpp).
struct OtherRates {
  SumRow rate;
  EarlierRates earlier;
};

/// What changes in a step.
struct ParticleState {
  std::vector<double> x, y, z;          ///< [m]
  std::vector<double> vx, vy, vz;       ///< [m/s]
  std::vector<double> rho;              ///< [kg/m^3]
  std::vector<double> energy;           ///< specific internal energy [J/kg]; empty where all laws are barotropic
  std::vector<ViscosityRow> viscosity;  ///< of a scheme with a switch; else empty
};

struct Particles : ParticleState {
  std::vector<double> mass;            ///< [kg]
  std::vector<std::uint32_t> id;       ///< place at the start
  std::vector<std::uint8_t> halvings;  ///< how often what was laid has split to become this particle (water/split.hpp)

  /// Rates. The pair loop sums forces per volume; after the evaluation fx, fy, fz are the acceleration [m/s^2] and `heat` is
  /// the viscous heating, or the whole rate of `energy` where that is a field [W/kg].
  std::vector<SumRow> rate;
  std::vector<EarlierRates> earlier;  ///< of the leapfrog
  /// Of local steps: in the whole set the rates from pairs with a fast particle, in the set near the fast ones those from slow
  /// pairs.
  std::vector<OtherRates> other;
  /// At the beginning of a step, for stages to refer to and for a step that is not taken to go back to. Of the Runge-Kutta method
  /// and of local steps.
  ParticleState start;
  std::vector<std::uint32_t> place;  ///< of a part: index in the whole

  /// The state that rates are evaluated at (see Fluid's step) and what follows from it. While the particles are sorted its
  /// memory serves as scratch.
  std::vector<FluidRow> predicted;
  // What pairs read beside `predicted`: of schemes that reconstruct, and of rings.
  std::vector<GradientRow> gradient;
  std::vector<CorrectedRow> corrected;
  std::vector<RingRow> ring;

  std::size_t size() const { return x.size(); }

  /// State for n particles.
  void resize(std::size_t n, bool with_energy);
  /// Room for the rest, once the state is there: until then set-up needs memory of its own. Coefficients of viscosity start
  /// from `alpha`.
  void make_room(SecondRow second, double alpha, bool of_stages, bool rings = false);
  /// Puts the particles of first .. first + order.size() into the order given by their present indices.
  void permute(std::uint32_t first, const std::vector<std::uint32_t>& order);
  /// Behind each of these, given in rising order, comes a copy of it.
  void insert_after(const std::vector<std::uint32_t>& places);
  /// The present state becomes that at the beginning of the step.
  void keep_start();
  /// And back to that.
  void restore_start();
  /// The rates of the last evaluation become those before it; new ones are summed up from zero.
  void turn_rates();
  /// Of a part: copies of the particles of `whole` that `place` names, whose rates and other rates change places; and back again.
  void gather(const Particles& whole);
  void scatter(Particles& whole) const;
  /// Copies the array of that name, vectors interleaved; false where there is none.
  bool copy(std::string_view name, std::vector<double>& out) const;
  /// The rows of a scheme that pairs read beside `predicted`; null where there are none.
  void* second_rows();
  std::size_t memory_bytes() const;
  /// All arrays that the next step reads, each in the order of the particles' numbers (id), and where in memory each lies.
  /// `with_evaluated`: are those of Role::evaluated among them?
  void visit_state(StateVisitor& state, bool with_evaluated);

 private:
  template <class T>
  void reorder(std::vector<T>& a, std::uint32_t first, const std::vector<std::uint32_t>& order);
};

/// What becomes of an array.
enum class Role {
  constant,   ///< as the start has made it
  state,      ///< changes in a step
  start,      ///< of the state at the step's beginning
  rate,       ///< of the last evaluations
  evaluated,  ///< of the last evaluation, which alone reads it; but a part keeps what the whole has found of slow particles
  scratch,    ///< written anew in every evaluation; the stable step and outputs read it until then
  index,      ///< of a part
};

/// What a reflection does to the three numbers of a vector: in a plane through `foot`, with the unit normal n and the velocity u,
/// each becomes a - 2 (a . n) n + 2 o n with o = foot . n of a place, u . n of a velocity, 0 of others.
enum class Vector { place, velocity, other };

/// An array of an `Owner`, or the three of a vector's components.
template <class Owner, class Element, std::size_t count>
struct ArrayOf {
  std::string_view name;
  Role role;
  std::array<std::vector<Element> Owner::*, count> member;
  Vector kind = Vector::other;  ///< of a vector
};

inline constexpr auto state_arrays = [] {
  using S = ParticleState;
  return std::tuple(
      ArrayOf<S, double, 3>{.name = "position", .role = Role::state, .member = {&S::x, &S::y, &S::z}, .kind = Vector::place},
      ArrayOf<S, double, 3>{
          .name = "velocity", .role = Role::state, .member = {&S::vx, &S::vy, &S::vz}, .kind = Vector::velocity},
      ArrayOf<S, double, 1>{"density", Role::state, {&S::rho}}, ArrayOf<S, double, 1>{"energy", Role::state, {&S::energy}},
      ArrayOf<S, ViscosityRow, 1>{"viscosity", Role::state, {&S::viscosity}});
}();

inline constexpr auto further_arrays = [] {
  using P = Particles;
  return std::tuple(ArrayOf<P, double, 1>{"mass", Role::constant, {&P::mass}},
                    ArrayOf<P, std::uint32_t, 1>{"id", Role::constant, {&P::id}},
                    ArrayOf<P, std::uint8_t, 1>{"halvings", Role::constant, {&P::halvings}},
                    ArrayOf<P, SumRow, 1>{"rate", Role::rate, {&P::rate}},
                    ArrayOf<P, EarlierRates, 1>{"earlier rate", Role::rate, {&P::earlier}},
                    ArrayOf<P, OtherRates, 1>{"other rates", Role::rate, {&P::other}},
                    ArrayOf<P, std::uint32_t, 1>{"place", Role::index, {&P::place}},
                    ArrayOf<P, FluidRow, 1>{"predicted state", Role::scratch, {&P::predicted}},
                    ArrayOf<P, GradientRow, 1>{"gradient", Role::evaluated, {&P::gradient}},
                    ArrayOf<P, CorrectedRow, 1>{"corrected gradient", Role::evaluated, {&P::corrected}},
                    ArrayOf<P, RingRow, 1>{"ring", Role::scratch, {&P::ring}});
}();

/// How many arrays a list holds.
template <class... Owner, class... Element, std::size_t... count>
constexpr std::size_t listed(const std::tuple<ArrayOf<Owner, Element, count>...>&) {
  return (count + ... + 0);
}
/// Have all arrays of a list that role?
template <class... Owner, class... Element, std::size_t... count>
constexpr bool all_are(Role role, const std::tuple<ArrayOf<Owner, Element, count>...>& list) {
  return std::apply([&](const auto&... array) { return ((array.role == role) && ...); }, list);
}
static_assert(all_are(Role::state, state_arrays), "an array of ParticleState is state");
static_assert(sizeof(ParticleState) == listed(state_arrays) * sizeof(std::vector<double>), "state_arrays lacks an array");
static_assert(sizeof(Particles) == 2 * sizeof(ParticleState) + listed(further_arrays) * sizeof(std::vector<double>),
              "further_arrays lacks an array");

/// Calls visit(array of the first owner, of the second ...) for every array of a list.
template <class List, class Visit, class... Owners>
void for_each_array(const List& list, Visit visit, Owners&... owners) {
  const auto each = [&](const auto& array) {
    for (const auto member : array.member) visit(array.role, (owners.*member)...);
  };
  std::apply([&](const auto&... array) { (each(array), ...); }, list);
}

/// Calls visit(role, array) for every array that particles have.
template <class Visit>
void for_each_array(Particles& p, Visit visit) {
  for_each_array(state_arrays, visit, p);
  for_each_array(further_arrays, visit, p);
  for_each_array(
      state_arrays, [&](Role, auto& array) { visit(Role::start, array); }, p.start);
}

// The vectors in an entry of an array.
template <class Visit>
void vectors_in(SumRow& rate, Visit visit) {
  visit(Vector::other, rate.fx, rate.fy, rate.fz);
}
template <class Visit>
void vectors_in(EarlierRates& rate, Visit visit) {
  visit(Vector::other, rate.ax, rate.ay, rate.az);
}
template <class Visit>
void vectors_in(OtherRates& rates, Visit visit) {
  vectors_in(rates.rate, visit);
  vectors_in(rates.earlier, visit);
}

/// Calls visit(Vector, a, b, c) for every vector of particle i that outlasts an evaluation.
template <class Visit>
void for_each_vector(Particles& p, std::size_t i, Visit visit) {
  const auto of_state = [&](ParticleState& state) {
    const auto each = [&](const auto& array) {
      if constexpr (std::tuple_size_v<decltype(array.member)> == 3)
        visit(array.kind, (state.*array.member[0])[i], (state.*array.member[1])[i], (state.*array.member[2])[i]);
    };
    std::apply([&](const auto&... array) { (each(array), ...); }, state_arrays);
  };
  of_state(p);
  if (!p.start.x.empty()) of_state(p.start);
  if (!p.rate.empty()) vectors_in(p.rate[i], visit);
  if (!p.earlier.empty()) vectors_in(p.earlier[i], visit);
  if (!p.other.empty()) vectors_in(p.other[i], visit);
}

}  // namespace undex::sph
