#include "exact/plane_wave.hpp"

#include <sstream>

#include "exact/isentrope.hpp"

namespace undex::exact {
namespace {

void require(bool holds, const char* what, double value) {
  if (holds) return;
  std::ostringstream text;
  text << "PlaneWave: " << what << ", got " << value;
  throw std::invalid_argument(text.str());
}

}  // namespace

PlaneWave::PlaneWave(const materials::FluidLaw& law, double density, double energy, double peak, double decay)
    : law_(law), peak_(peak), with_energy_(materials::uses_energy(law)) {
  require(density > 0, "the density at rest [kg/m^3] must be positive", density);
  require(peak > 0, "the peak [Pa] must be positive", peak);
  require(decay > 0, "the decay time [s] must be positive", decay);
  const double voids = std::visit([&](const auto& each) { return each.void_fraction(density, energy); }, law);
  require(voids < 1e-9, "the fluid at rest must not be cavitated; its void fraction must be 0", voids);  // round-off at the limit
  const materials::PressureSound state = true_pressure_sound(law, density, energy);
  rest_ = {density, 0.0, energy, state.pressure};
  sound_ = state.sound_speed;
  length_ = sound_ * decay;
  const double impedance = density * sound_;
  points_ =
      integrate<3>([this](double p, const OdeState<3>& y) { return slope(p, y); }, rest_.pressure, rest_.pressure + peak,
                   {density, 0.0, energy}, {density, peak / impedance, peak * peak / (impedance * impedance)}, 1e-12, 0.1 * peak);
}

OdeState<3> PlaneWave::slope(double p, const OdeState<3>& y) const {
  const double sound = true_pressure_sound(law_, y[0], y[2]).sound_speed, impedance = y[0] * sound;
  return {1.0 / (sound * sound), 1.0 / impedance, with_energy_ ? p / (impedance * impedance) : 0.0};
}

PlaneWaveState PlaneWave::at(double behind) const {
  if (behind < 0) return rest_;
  const double p = rest_.pressure + peak_ * std::exp(-behind / length_);
  const auto above =
      std::upper_bound(points_.begin(), points_.end(), p, [](double value, const OdePoint<3>& point) { return value < point.s; });
  const OdePoint<3>& from = above == points_.begin() ? *above : *(above - 1);
  OdeState<3> error;
  const OdeState<3> y =
      runge_kutta_step([this](double q, const OdeState<3>& z) { return slope(q, z); }, from.s, from.y, p - from.s, error);
  return {y[0], y[1], y[2], p};
}

PlaneWaveState PlaneWave::mean(double from, double to) const {
  double mass = 0, momentum = 0, energy = 0, pressure = 0;
  const auto add = [&](double width, const PlaneWaveState& state) {
    mass += width * state.density;
    momentum += width * state.density * state.velocity;
    energy += width * state.density * (state.energy + 0.5 * state.velocity * state.velocity);
    pressure += width * state.pressure;
  };
  if (from < 0) add(std::min(to, 0.0) - from, rest_);
  if (to > 0) {
    // Gauss's three points: exact to the sixth order of a cell over the wave's length.
    const double begin = std::max(from, 0.0), half = 0.5 * (to - begin), middle = begin + half;
    add(half * 8.0 / 9.0, at(middle));
    for (const double side : {-1.0, 1.0}) add(half * 5.0 / 9.0, at(middle + side * std::sqrt(0.6) * half));
  }
  const double width = to - from, velocity = momentum / mass;
  return {mass / width, velocity, with_energy_ ? energy / mass - 0.5 * velocity * velocity : rest_.energy, pressure / width};
}

}  // namespace undex::exact
