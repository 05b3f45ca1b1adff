// Crossing of the two wave curves, and sampling of the fan.
#include "exact/riemann.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace undex::exact {

namespace {
/// Sign of the direction into which the waves of a side run.
constexpr double outward(int side) { return side == 0 ? -1.0 : 1.0; }

[[noreturn]] void refuse(const char* what, double value, const char* remedy = "") {
  std::ostringstream text;
  text << what << value << remedy;
  throw std::domain_error(text.str());
}
}  // namespace

RiemannSolution::Reached RiemannSolution::reach(int k, double pressure) const {
  if (pressure > start_pressure_[k]) {
    const ShockState s = shock_to(side_[k].law, side_[k].density, start_energy_[k], pressure);
    return {(pressure - start_pressure_[k]) / s.mass_flux, s.density, s.energy};
  }
  if (pressure == start_pressure_[k]) return {0.0, side_[k].density, start_energy_[k]};
  const IsentropeState s = isentrope_[k]->at_pressure(pressure);
  return {s.riemann, s.density, s.energy};
}

RiemannSolution::RiemannSolution(const RiemannSide& left, const RiemannSide& right) : side_{left, right} {
  double lowest[2];
  for (const int k : {0, 1}) {
    if (!(side_[k].density > 0) || !std::isfinite(side_[k].density))
      throw std::invalid_argument("RiemannSolution: densities [kg/m^3] must be positive, got " +
                                  std::to_string(side_[k].density));
    if (!std::isfinite(side_[k].velocity)) throw std::invalid_argument("RiemannSolution: velocities [m/s] must be finite");
    isentrope_[k].emplace(side_[k].law, side_[k].density, side_[k].energy);
    start_pressure_[k] = isentrope_[k]->start().pressure;
    start_energy_[k] = isentrope_[k]->start().energy;
    lowest[k] = isentrope_[k]->end().pressure;
  }
  const double apart = right.velocity - left.velocity;
  // Speed by which the two wave curves miss each other at a pressure; rises with the pressure.
  const auto excess = [&](double p) { return reach(0, p).velocity_change + reach(1, p).velocity_change + apart; };

  double low = std::max(lowest[0], lowest[1]);
  // What each side gains on its way to an opening, whose pressure is that of the side which cannot go lower. In a vacuum gases go on
  // to nothing; all else stays at the opening's pressure.
  const Isentrope& last = *isentrope_[lowest[0] < lowest[1]];
  double escape[2];
  bool to_nothing[2];
  for (const int k : {0, 1}) {
    const bool gas = !isentrope_[k]->ends_on_floor() && !isentrope_[k]->ends_before_a_void();
    to_nothing[k] = gas && !last.ends_on_floor();
    escape[k] = to_nothing[k] ? isentrope_[k]->riemann_limit() : reach(k, low).velocity_change;
  }
  cavity_ = escape[0] + escape[1] + apart > 0.0 && excess(low) > 0.0;
  if (cavity_) {
    pressure_ = low;
    if (last.ends_before_a_void())
      refuse("the fluids are pulled apart by more than their laws can carry, ", low,
             " Pa; a law that cavitates has a solution, e.g. with cavitation = \"cutoff\"");
  } else {
    pressure_ = crossing(excess, low);
  }
  expect_convex();

  for (const int k : {0, 1}) {
    const double sign = outward(k);
    const Reached r = reach(k, std::max(pressure_, lowest[k]));
    const double gained = cavity_ ? escape[k] : r.velocity_change;
    star_[k] = {r.density, side_[k].velocity + sign * gained, pressure_, r.energy, k};
    wave_[k].shock = pressure_ > start_pressure_[k];
    if (wave_[k].shock) {
      const double flux = shock_to(side_[k].law, side_[k].density, start_energy_[k], pressure_).mass_flux;
      wave_[k].head = wave_[k].tail = side_[k].velocity + sign * flux / side_[k].density;
    } else {
      const IsentropeState end = isentrope_[k]->at_density(r.density);
      // Where a gas expands into a vacuum the tail of the fan is its edge.
      const bool vacuum = cavity_ && to_nothing[k];
      wave_[k].head = side_[k].velocity + sign * isentrope_[k]->start().sound;
      wave_[k].tail = vacuum ? star_[k].velocity : star_[k].velocity + sign * end.sound;
      if (pressure_ == start_pressure_[k]) wave_[k].tail = wave_[k].head;
    }
  }
  if (!cavity_) {
    const double common = 0.5 * (star_[0].velocity + star_[1].velocity);
    star_[0].velocity = star_[1].velocity = common;
  }
}

/// Where a function that rises with the pressure passes zero, above `low` [Pa].
template <class Rising>
double RiemannSolution::crossing(const Rising& excess, double low) const {
  double high = std::max({start_pressure_[0], start_pressure_[1], low});
  const double rho_c = std::max(side_[0].density * isentrope_[0]->start().sound, side_[1].density * isentrope_[1]->start().sound);
  const double apart = std::abs(side_[1].velocity - side_[0].velocity);
  double add = rho_c * apart + 1e-6 * std::abs(high) + 1e-300;
  while (excess(high) < 0.0) {
    low = high;
    high += add;
    add *= 2.0;
    if (!std::isfinite(high)) refuse("no pressure stops fluids that meet at ", apart, " m/s");
  }
  if (!(excess(high) >= 0.0)) refuse("the laws give no velocity behind a wave of ", high, " Pa");
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (excess(middle) < 0.0 ? low : high) = middle;
  return high;
}

/// Fans whose u + c falls towards the contact, and shocks none of whose weaker ones is faster (Liu's condition), are the solution.
void RiemannSolution::expect_convex() const {
  constexpr int samples = 64;
  for (const int k : {0, 1}) {
    const double start = start_pressure_[k];
    if (pressure_ <= start) {
      if (!isentrope_[k]->is_convex_down_to(reach(k, std::max(pressure_, isentrope_[k]->end().pressure)).density))
        refuse("the law is not convex on its isentrope down to ", pressure_, " Pa: the wave is not a simple fan");
      continue;
    }
    const double flux = shock_to(side_[k].law, side_[k].density, start_energy_[k], pressure_).mass_flux;
    for (int m = 1; m < samples; ++m) {
      const double rise = (pressure_ - start) * m / samples;
      const double round_off = 1e-13 * std::pow(isentrope_[k]->start().sound, 2) * side_[k].density / rise;
      if (shock_to(side_[k].law, side_[k].density, start_energy_[k], start + rise).mass_flux > flux * (1.0 + 1e-6 + round_off))
        refuse("the law is not convex between its state and ", pressure_, " Pa: the wave is not a single shock");
    }
  }
}

RiemannSample RiemannSolution::sample(double xi) const {
  if (cavity_ && xi > star_[0].velocity && xi < star_[1].velocity) return {0.0, xi, pressure_, 0.0, -1};
  const int k = xi < velocity() ? 0 : 1;
  const double sign = outward(k);
  if (sign * (xi - wave_[k].head) >= 0.0) return {side_[k].density, side_[k].velocity, start_pressure_[k], start_energy_[k], k};
  if (sign * (xi - wave_[k].tail) <= 0.0) return star_[k];
  // In the fan: x/t = u + sign c with u = u_start + sign w.
  const IsentropeState s =
      isentrope_[k]->find([](const IsentropeState& f) { return f.riemann + f.sound; }, sign * (xi - side_[k].velocity));
  return {s.density, side_[k].velocity + sign * s.riemann, s.pressure, s.energy, k};
}

}  // namespace undex::exact
