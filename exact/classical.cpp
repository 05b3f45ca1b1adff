// Closed forms, and Sedov's equations by integration.
#include "exact/classical.hpp"

#include <numbers>
#include <string>

namespace undex::exact {

double Noh::shock_radius(double t) const { return 0.5 * (gamma - 1.0) * speed * t; }

GasSample Noh::sample(double r, double t) const {
  if (r >= shock_radius(t)) {
    const double squeeze = std::pow(1.0 + speed * t / r, dimension - 1);
    return {density * squeeze, -speed, 0.0, 0.0};
  }
  const double behind = density * std::pow((gamma + 1.0) / (gamma - 1.0), dimension);
  const double energy = 0.5 * speed * speed;
  return {behind, 0.0, (gamma - 1.0) * behind * energy, energy};
}

namespace {
double unit_sphere(int dimension) { return dimension == 1 ? 1.0 : (dimension == 2 ? 2.0 : 4.0) * std::numbers::pi; }
}  // namespace

Sedov::Sedov(int dimension, double gamma, double density, double energy)
    : dimension_(dimension), gamma_(gamma), density_(density), energy_(energy) {
  if (dimension < 1 || dimension > 3)
    throw std::invalid_argument("Sedov: dimension must be 1, 2 or 3, got " + std::to_string(dimension));
  if (!(gamma > 1 && density > 0 && energy > 0))
    throw std::invalid_argument("Sedov: needs gamma > 1, density > 0 and energy > 0");
  const OdeState<4> front{2.0 / (gamma + 1.0), std::log((gamma + 1.0) / (gamma - 1.0)), std::log(2.0 / (gamma + 1.0)), 0.0};
  const auto f = [this](double s, const OdeState<4>& y) { return slope(s, y); };
  // Inward an error of U/lambda, which tends to 1/gamma, grows as lambda^-d. The integration ends at lambda^d
  // = e^-12, where pressure is uniform to many digits; the energy within is added below.
  points_ = integrate<4>(f, 0.0, -12.0 / dimension, front, {1.0, 1.0, 1.0, 1.0}, 1e-13, 0.05);
  const double innermost = std::exp(points_.back().s);
  const double rest = std::exp(points_.back().y[2]) / (gamma - 1.0) * std::pow(innermost, dimension) / dimension;
  const double integral = unit_sphere(dimension) * (-points_.back().y[3] + rest);
  const double exponent = 2.0 / (dimension + 2.0);
  alpha_ = integral * exponent * exponent;
}

OdeState<4> Sedov::slope(double s, const OdeState<4>& y) const {
  // With V = U/lambda: U' = V + dV/ds, G' lambda = G dlnG/ds, P' lambda = P dlnP/ds.
  const double lambda = std::exp(s), V = y[0], G = std::exp(y[1]), P = std::exp(y[2]);
  const double d = dimension_, relative = V - 1.0;
  const double Q = P / (G * lambda * lambda);
  // relative lnG' + U' = -(d - 1) V;  relative U' + Q lnP' = d V/2;  relative (lnP' - gamma lnG') = d.
  const double U = (relative * (0.5 * d * V) - Q * d + gamma_ * Q * (d - 1.0) * V) / (relative * relative - gamma_ * Q);
  const double lnG = (-(d - 1.0) * V - U) / relative;
  const double lnP = d / relative + gamma_ * lnG;
  const double kinetic = 0.5 * G * V * V * lambda * lambda, internal = P / (gamma_ - 1.0);
  return {U - V, lnG, lnP, (kinetic + internal) * std::pow(lambda, d)};
}

double Sedov::shock_radius(double t) const { return std::pow(energy_ * t * t / (alpha_ * density_), 1.0 / (dimension_ + 2.0)); }

GasSample Sedov::sample(double r, double t) const {
  const double front = shock_radius(t), lambda = r / front;
  if (lambda > 1.0) return {density_, 0.0, 0.0, 0.0};
  const double speed = 2.0 / (dimension_ + 2.0) * front / t;
  const double s = std::max(std::log(std::max(lambda, 1e-300)), points_.back().s);
  const auto after =
      std::lower_bound(points_.begin(), points_.end(), s, [](const OdePoint<4>& p, double value) { return p.s > value; });
  const OdePoint<4>& from = after == points_.begin() ? *after : *(after - 1);
  OdeState<4> error;
  const auto f = [this](double x, const OdeState<4>& state) { return slope(x, state); };
  const OdeState<4> y = runge_kutta_step(f, from.s, from.y, s - from.s, error);
  // Inside of the innermost point density goes on as the power of the radius that it has reached.
  const double power = dimension_ / (gamma_ - 1.0);
  const double inside = lambda > 0.0 ? std::pow(lambda / std::exp(s), power) : 0.0;
  const double rho = density_ * std::exp(y[1]) * inside, p = density_ * speed * speed * std::exp(y[2]);
  return {rho, speed * y[0] * lambda, p, p / ((gamma_ - 1.0) * rho)};  // energy is infinite at r = 0
}

double TaylorPlate::velocity(double t) const {
  const double z = ratio(), a = t / decay;
  const double scale = 2.0 * peak * decay / plate_mass;
  // (exp(-a) - exp(-z a))/(z - 1), also at z = 1.
  const double share = z == 1.0 ? a * std::exp(-a) : -std::exp(-a) * std::expm1((1.0 - z) * a) / (z - 1.0);
  return scale * share;
}

double TaylorPlate::wall_pressure(double t) const { return 2.0 * peak * std::exp(-t / decay) - impedance * velocity(t); }

double TaylorPlate::cavitation_time() const {
  const double z = ratio();
  return z == 1.0 ? decay : decay * std::log(z) / (z - 1.0);
}

double TaylorPlate::impulse() const { return plate_mass * velocity(cavitation_time()); }

double bar_wave_speed(double young, double density) { return std::sqrt(young / density); }

double bulk_wave_speed(double young, double poisson, double density) {
  return std::sqrt(young * (1.0 - poisson) / (density * (1.0 + poisson) * (1.0 - 2.0 * poisson)));
}

double shear_wave_speed(double young, double poisson, double density) {
  return std::sqrt(young / (2.0 * (1.0 + poisson) * density));
}

double ring_breathing_period(double young, double density, double mean_radius) {
  return 2.0 * std::numbers::pi * mean_radius / bar_wave_speed(young, density);
}

double tube_breathing_period(double young, double poisson, double density, double mean_radius) {
  return ring_breathing_period(young / (1.0 - poisson * poisson), density, mean_radius);
}

ElasticBarImpact::Sample ElasticBarImpact::sample(double x, double t) const {
  const double c = bar_wave_speed(young, density), travelled = c * t;
  // Until L/c the wave of compression stops the bar from the wall on; then the free end throws it back.
  if (travelled <= length) {
    if (x < travelled) return {0.0, -density * c * speed};
    return {-speed, 0.0};
  }
  if (x < 2.0 * length - travelled) return {0.0, -density * c * speed};
  return {speed, 0.0};
}

}  // namespace undex::exact
