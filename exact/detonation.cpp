// Taylor wave by the products' isentrope and, with divergence, one ordinary differential equation.
#include "exact/detonation.hpp"

#include <stdexcept>

namespace undex::exact {

TaylorWave::TaylorWave(const materials::Jwl& products, int dimension)
    : products_(products),
      dimension_(dimension),
      front_(materials::chapman_jouguet(products)),
      isentrope_(products, front_.density, front_.energy),
      core_{} {
  if (dimension < 1 || dimension > 3)
    throw std::invalid_argument("TaylorWave: dimension must be 1, 2 or 3, got " + std::to_string(dimension));
  if (dimension == 1) {
    core_ = isentrope_.find([](const IsentropeState& s) { return s.riemann; }, -front_.particle_speed);
    return;
  }
  const auto f = [this](double u, const OdeState<2>& y) { return slope(u, y); };
  // Next to the core u falls as its distance over a logarithm: a velocity of 1e-9 of the first is the core's
  // edge.
  const double last = 1e-9 * front_.particle_speed;
  points_ = integrate<2>(f, front_.particle_speed, last, {front_.detonation_speed, std::log(front_.density)},
                         {front_.detonation_speed, 1.0}, 1e-11, 0.01 * front_.particle_speed, 100'000);
  core_ = isentrope_.at_density(std::exp(points_.back().y[1]));
}

OdeState<2> TaylorWave::slope(double u, const OdeState<2>& y) const {
  const double c = isentrope_.at_density(std::exp(y[1])).sound, relative = y[0] - u;
  const double squared = c * c;
  return {y[0] * (relative * relative / squared - 1.0) / ((dimension_ - 1) * u), relative / squared};
}

TaylorWave::Sample TaylorWave::sample(double r, double t) const {
  const double x = r / t;
  if (!(x <= front_.detonation_speed)) {
    const auto& p = products_.parameters();
    return {p.rho0, 0.0, 0.0, p.E0, false};
  }
  const auto made = [](const IsentropeState& s, double u) { return Sample{s.density, u, s.pressure, s.energy, true}; };
  if (dimension_ == 1) {
    if (x <= core_.sound) return made(core_, 0.0);
    const IsentropeState s =
        isentrope_.find([](const IsentropeState& f) { return f.riemann + f.sound; }, x - front_.particle_speed);
    return made(s, front_.particle_speed + s.riemann);
  }
  if (x <= points_.back().y[0]) return made(core_, 0.0);
  std::size_t above = 0, below = points_.size() - 1;
  while (below - above > 1) {
    const std::size_t middle = (above + below) / 2;
    (points_[middle].y[0] > x ? above : below) = middle;
  }
  const auto f = [this](double u, const OdeState<2>& y) { return slope(u, y); };
  const OdePoint<2>& from = points_[above];
  OdeState<2> y = from.y, error;
  double high = from.s, low = points_[below].s;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    y = runge_kutta_step(f, from.s, from.y, middle - from.s, error);
    (y[0] > x ? high : low) = middle;
  }
  return made(isentrope_.at_density(std::exp(y[1])), low);
}

}  // namespace undex::exact
