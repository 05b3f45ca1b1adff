// Isentropes by integration of the law, and shock states by bisection.
#include "exact/isentrope.hpp"

#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>

namespace undex::exact {

namespace {

constexpr double tolerance = 1e-13;

double barotropic_energy(const materials::FluidLaw& law, double density, double otherwise) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (std::remove_cvref_t<decltype(l)>::uses_energy) return otherwise;
        else return l.barotropic_energy(density);
      },
      law);
}

/// What a stiffened gas has beside its pressure [Pa]; 0 of other laws.
double inner_pressure(const materials::FluidLaw& law) {
  const auto* liquid = std::get_if<materials::StiffenedGas>(&law);
  return liquid != nullptr ? liquid->parameters().p_inf : 0.0;
}

/// Has the law come to its end: is its sound speed [m/s] held at a guard, since its own is not real, or has its Grueneisen
/// parameter fallen to zero in tension?
bool is_beyond(const materials::FluidLaw& law, double density, double sound) {
  if (const auto* polynomial = std::get_if<materials::PolynomialWater>(&law))
    return sound * sound <= 0.01 * polynomial->parameters().A / polynomial->parameters().rho0 * (1.0 + 1e-12);
  const auto* water = std::get_if<materials::MieGruneisenWater>(&law);
  if (water == nullptr) return false;
  const auto& p = water->parameters();
  const double mu = density / p.rho0 - 1.0;
  return sound <= 0.1 * p.C0 * (1.0 + 1e-12) || (mu < 0.0 && p.gamma0 > 0.0 && p.gamma0 + p.alpha * mu <= 0.0);
}

/// Lowest pressure of a law that cavitates; minus infinity of others.
double floor_pressure(const materials::FluidLaw& law) {
  if (const auto* tait = std::get_if<materials::TaitWater>(&law))
    if (tait->parameters().cavitation != materials::Cavitation::none) return tait->evaluate(tait->floor_density(), 0.0).pressure;
  return std::visit(
      [](const auto& water) {
        constexpr double none = -std::numeric_limits<double>::infinity();
        if constexpr (requires { water.cutoff_density(0.0); })
          return water.parameters().cavitation != materials::Cavitation::none ? water.parameters().p_floor : none;
        else return none;
      },
      law);
}

}  // namespace

materials::PressureSound true_pressure_sound(const materials::FluidLaw& law, double density, double energy) {
  materials::PressureSound s = std::visit([&](const auto& l) { return l.evaluate(density, energy); }, law);
  double gamma = 0.0;
  if (const auto* gas = std::get_if<materials::BarotropicGas>(&law)) gamma = gas->parameters().gamma;
  if (const auto* gas = std::get_if<materials::IdealGas>(&law)) gamma = gas->parameters().gamma;
  double inner = 0.0, free = 1.0;
  if (const auto* liquid = std::get_if<materials::StiffenedGas>(&law)) {
    gamma = liquid->parameters().gamma;
    inner = liquid->parameters().p_inf;
    free = liquid->free_share(density);
  }
  if (gamma > 0.0) s.sound_speed = std::sqrt(gamma * std::max(s.pressure + inner, 0.0) / (density * free));
  return s;
}

Isentrope::Isentrope(const materials::FluidLaw& law, double density, double energy)
    : law_(law), density_(density), energy_(barotropic_energy(law, density, energy)) {
  const double floor = floor_pressure(law_);
  const auto first = true_pressure_sound(law_, density_, energy_);
  const double first_sound = first.sound_speed;
  if (!std::isfinite(first.pressure) || !std::isfinite(first_sound) || !std::isfinite(energy_) ||
      (first_sound <= 0.0 && first.pressure < 0.0)) {
    std::ostringstream message;
    message << "the law gives no pressure or sound speed at density " << density_ << " kg/m^3 and energy " << energy_ << " J/kg";
    throw std::domain_error(message.str());
  }
  double end = -150.0;  // ln(rho/rho_start), far beyond the end by sound speed of every gas in use
  std::vector<double> stops;
  if (const auto* tait = std::get_if<materials::TaitWater>(&law_)) {
    if (tait->liquid_limit() > 0.0) stops.push_back(std::log(tait->liquid_limit() / density_));
    if (tait->floor_density() > 0.0) {
      end = std::log(tait->floor_density() / density_);
      on_floor_ = true;
    }
  }
  points_.push_back({0.0, {0.0, energy_}});
  if (end >= 0.0 || state(points_.back()).pressure <= floor) {
    on_floor_ = true;  // it lies on the floor already
    return;
  }
  stops.push_back(end);
  if (!(first_sound > 0.0)) return;  // a cold gas does not expand
  if (is_beyond(law_, density_, first_sound)) {
    torn_ = true;
    return;
  }

  // Near -p_inf the sound speed of a stiffened gas is a difference of large numbers, and no longer known.
  const double inner = inner_pressure(law_), least_inner = inner > 0.0 ? 1e-6 * (first.pressure + inner) : -1e300;
  const auto f = [this](double s, const OdeState<2>& y) { return slope(s, y); };
  bool finished = false;
  for (const double stop : stops) {
    if (finished || stop >= points_.back().s) continue;
    const bool tait_floor = on_floor_;
    const auto ended = [&](const Point& point) {
      const IsentropeState s = state(point);
      return s.sound < 1e-7 * first_sound || s.pressure + inner < least_inner || is_beyond(law_, s.density, s.sound) ||
             (!tait_floor && s.pressure <= floor);
    };
    const Point from = points_.back();
    const auto part = integrate<2>(f, from.s, stop, from.y, {first_sound, 1e-30}, tolerance, 0.5, ended);
    points_.insert(points_.end(), part.begin() + 1, part.end());
    finished = ended(points_.back());
  }
  if (on_floor_) return;
  const IsentropeState last = state(points_.back());
  if (last.pressure <= floor) {
    // The floor was crossed in the last step: the longest step that stays above it.
    on_floor_ = true;
    const double crossed = points_.back().s;
    points_.pop_back();
    const Point from = points_.back();
    double high = from.s, low = crossed;
    for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
      (state_after(from, middle).pressure > floor ? high : low) = middle;
    OdeState<2> error;
    points_.push_back({high, runge_kutta_step(f, from.s, from.y, high - from.s, error)});
    return;
  }
  const bool beyond = is_beyond(law_, last.density, last.sound);
  if (beyond) points_.pop_back();
  torn_ = beyond || last.pressure < -1e-12 * density_ * first_sound * first_sound;
}

bool Isentrope::is_convex_down_to(double density) const {
  const double slack = 1e-9 * start().sound;
  double last = start().riemann + start().sound;
  for (const Point& point : points_) {
    const IsentropeState s = state(point);
    if (s.density < density) break;
    if (s.riemann + s.sound > last + slack) return false;
    last = s.riemann + s.sound;
  }
  return true;
}

OdeState<2> Isentrope::slope(double s, const OdeState<2>& y) const {
  const double rho = density_ * std::exp(s);
  const auto local = true_pressure_sound(law_, rho, y[1]);
  return {local.sound_speed, local.pressure / rho};
}

IsentropeState Isentrope::state(const Point& point) const {
  const double rho = point.s == 0.0 ? density_ : density_ * std::exp(point.s);
  const double energy = barotropic_energy(law_, rho, point.y[1]);
  const auto local = true_pressure_sound(law_, rho, energy);
  return {rho, local.pressure, local.sound_speed, energy, point.y[0]};
}

IsentropeState Isentrope::state_after(const Point& from, double s) const {
  OdeState<2> error;
  const auto f = [this](double x, const OdeState<2>& y) { return slope(x, y); };
  return state({s, runge_kutta_step(f, from.s, from.y, s - from.s, error)});
}

double Isentrope::riemann_limit() const {
  const IsentropeState last = end();
  const double pressure = last.pressure + inner_pressure(law_);
  if (on_floor_ || !(pressure > 0.0)) return last.riemann;
  const double exponent = last.density * last.sound * last.sound / pressure;
  return exponent > 1.0 ? last.riemann - 2.0 * last.sound / (exponent - 1.0) : last.riemann;
}

IsentropeState Isentrope::at_density(double density) const {
  return find([](const IsentropeState& s) { return s.density; }, density);
}

IsentropeState Isentrope::at_pressure(double pressure) const {
  return find([](const IsentropeState& s) { return s.pressure; }, pressure);
}

ShockState shock_to(const materials::FluidLaw& law, double density, double energy, double pressure) {
  const double start = true_pressure_sound(law, density, energy).pressure;
  const bool with_energy = materials::uses_energy(law);
  const auto energy_at = [&](double rho) {
    return with_energy ? energy + 0.5 * (pressure + start) * (1.0 / density - 1.0 / rho) : barotropic_energy(law, rho, 0.0);
  };
  const auto too_thin = [&](double rho) { return true_pressure_sound(law, rho, energy_at(rho)).pressure < pressure; };
  double low = density, high = density;
  while (too_thin(high)) {
    low = high;
    high *= 1.02;
    // A void that closes may start from next to nothing.
    if (high > 1e3 * std::max(density, 1e3)) {
      std::ostringstream message;
      message << "the law has no shock to " << pressure << " Pa from density " << density << " kg/m^3 and energy " << energy
              << " J/kg";
      throw std::domain_error(message.str());
    }
  }
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (too_thin(middle) ? low : high) = middle;
  const double volume_change = 1.0 / density - 1.0 / high;
  const double flux = volume_change > 0.0 ? std::sqrt((pressure - start) / volume_change)
                                          : density * true_pressure_sound(law, density, energy).sound_speed;
  return {high, energy_at(high), flux};
}

}  // namespace undex::exact
