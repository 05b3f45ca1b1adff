// The fluid's particles. State is what a restart needs; rates are what the last evaluation gave; the rest is scratch.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "sph_fluid/pairs/pair_loop.hpp"

namespace undex::sph {

/// Rates one evaluation earlier, for the predictor; they only shape a correction, so single precision serves.
struct EarlierRates {
  float ax = 0, ay = 0, az = 0;  ///< [m/s^2]
  float compression = 0;         ///< [1/s]
};

/// State at the beginning of a step, for stages to refer to and for a step that is not taken to go back to.
struct StepStart {
  double x, y, z, vx, vy, vz, rho, energy;
};

/// Rates that a set of particles holds beside those it advances by (local_steps.cpp).
struct OtherRates {
  SumRow rate;
  EarlierRates earlier;
};

struct Particles {
  // State, a structure of arrays.
  std::vector<double> x, y, z;     ///< [m]
  std::vector<double> vx, vy, vz;  ///< [m/s]
  std::vector<double> rho;         ///< [kg/m^3]
  std::vector<double> mass;        ///< [kg]
  std::vector<double> energy;      ///< specific internal energy [J/kg]; empty where all laws are barotropic
  std::vector<std::uint32_t> id;   ///< place at the start

  /// Rates. The pair loop sums forces per volume; after the evaluation fx, fy, fz are the acceleration [m/s^2] and `heat` is
  /// the viscous heating, or the whole rate of `energy` where that is a field [W/kg].
  std::vector<SumRow> rate;
  std::vector<EarlierRates> earlier;  ///< of the leapfrog
  std::vector<StepStart> start;       ///< of the Runge-Kutta method and of local steps, as the next
  std::vector<ViscosityRow> start_viscosity;
  /// Of local steps: in the whole set the rates from pairs with a fast particle, in the set near the fast ones those from slow
  /// pairs.
  std::vector<OtherRates> other;
  std::vector<std::uint32_t> place;  ///< of a part: index in the whole

  /// The state that rates are evaluated at (see Fluid's step) and what follows from it. While the particles are sorted its
  /// memory serves as scratch.
  std::vector<FluidRow> predicted;
  // Of schemes that have a use for them, as the next: what pairs read beside `predicted`.
  std::vector<GradientRow> gradient;
  std::vector<CorrectedRow> corrected;
  std::vector<ViscosityRow> viscosity;  ///< a state

  std::size_t size() const { return x.size(); }

  /// State for n particles.
  void resize(std::size_t n, bool with_energy) {
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass}) a->assign(n, 0.0);
    if (with_energy) energy.assign(n, 0.0);
    id.resize(n);
  }

  /// Room for the rest, once the state is there: until then set-up needs memory of its own. Coefficients of viscosity start
  /// from `alpha`.
  void make_room(SecondRow second, double alpha, bool of_stages) {
    const std::size_t n = size();
    rate.assign(n, SumRow{});
    if (of_stages) start.resize(n);
    else earlier.assign(n, EarlierRates{});
    predicted.resize(n);
    if (second == SecondRow::gradient) gradient.resize(n);
    if (second == SecondRow::corrected) corrected.resize(n);
    if (second == SecondRow::viscosity) viscosity.assign(n, {alpha});
  }

  /// Puts the particles of first .. first + order.size() into the order given by their present indices.
  void permute(std::uint32_t first, const std::vector<std::uint32_t>& order) {
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy}) reorder(*a, first, order);
    reorder(id, first, order);
    reorder(rate, first, order);
    reorder(earlier, first, order);
    reorder(viscosity, first, order);
    reorder(start, first, order);
    reorder(start_viscosity, first, order);
    reorder(other, first, order);
    reorder(place, first, order);
    if (place.empty()) return;
    reorder(gradient, first, order);  // those of slow particles are kept
    reorder(corrected, first, order);
  }

  /// The present state becomes that at the beginning of the step.
  void keep_start() {
    start.resize(size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < size(); ++i)
      start[i] = {x[i], y[i], z[i], vx[i], vy[i], vz[i], rho[i], energy.empty() ? 0.0 : energy[i]};
    start_viscosity = viscosity;
  }

  /// And back to that.
  void restore_start() {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < size(); ++i) {
      const StepStart& s = start[i];
      x[i] = s.x, y[i] = s.y, z[i] = s.z;
      vx[i] = s.vx, vy[i] = s.vy, vz[i] = s.vz;
      rho[i] = s.rho;
      if (!energy.empty()) energy[i] = s.energy;
    }
    viscosity = start_viscosity;
  }

  /// The rates of the last evaluation become those before it; new ones are summed up from zero.
  void turn_rates() {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < size(); ++i) {
      const SumRow& r = rate[i];
      if (!earlier.empty()) earlier[i] = {float(r.fx), float(r.fy), float(r.fz), float(r.compression)};
      rate[i] = SumRow{};
    }
  }

  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy}) bytes += a->capacity() * sizeof(double);
    bytes += other.capacity() * sizeof(OtherRates) + place.capacity() * sizeof(std::uint32_t);
    return bytes + id.capacity() * sizeof(std::uint32_t) + rate.capacity() * sizeof(SumRow) +
           earlier.capacity() * sizeof(EarlierRates) + start.capacity() * sizeof(StepStart) +
           predicted.capacity() * sizeof(FluidRow) + gradient.capacity() * sizeof(GradientRow) +
           corrected.capacity() * sizeof(CorrectedRow) +
           (viscosity.capacity() + start_viscosity.capacity()) * sizeof(ViscosityRow);
  }

 private:
  template <class T>
  void reorder(std::vector<T>& a, std::uint32_t first, const std::vector<std::uint32_t>& order) {
    static_assert(sizeof(T) <= sizeof(FluidRow));
    if (a.empty()) return;
    T* data = a.data();
    T* spare = reinterpret_cast<T*>(predicted.data());
    const std::size_t n = order.size();
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < n; ++k) spare[k] = data[order[k]];
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < n; ++k) data[first + k] = spare[k];
    }
  }
};

/// Calls visit(array of one, array of the other) for all that changes in a step.
template <class One, class Other, class Visit>
void for_each_state(One& one, Other& other, Visit visit) {
  visit(one.x, other.x), visit(one.y, other.y), visit(one.z, other.z);
  visit(one.vx, other.vx), visit(one.vy, other.vy), visit(one.vz, other.vz);
  visit(one.rho, other.rho), visit(one.energy, other.energy), visit(one.viscosity, other.viscosity);
}

}  // namespace undex::sph
