#include "materials/hydrostatic.hpp"

#include <algorithm>
#include <cmath>

namespace undex::materials {

HydrostaticColumn::HydrostaticColumn(const FluidLaw& law, double energy, double pressure, double gravity, double low, double high)
    : law_(law), energy_(energy), gravity_(gravity), low_(low) {
  constexpr int intervals = 256;
  step_ = (high - low) / intervals;
  pressure_.push_back(pressure);
  for (int k = 0; k < intervals; ++k) pressure_[0] = advanced(pressure_[0], low / intervals);
  for (int k = 0; k < intervals; ++k) pressure_.push_back(advanced(pressure_.back(), step_));
}

double HydrostaticColumn::advanced(double pressure, double step) const {
  const auto rise = [&](double p) { return step * gravity_ * density_at(law_, p, energy_); };
  const double a = rise(pressure), b = rise(pressure + 0.5 * a), c = rise(pressure + 0.5 * b), d = rise(pressure + c);
  return pressure + (a + 2.0 * b + 2.0 * c + d) / 6.0;
}

double HydrostaticColumn::pressure(double depth) const {
  if (!(step_ > 0.0)) return pressure_.front();
  const auto k = std::clamp(std::lround((depth - low_) / step_), 0l, long(pressure_.size()) - 1);
  return advanced(pressure_[k], depth - low_ - k * step_);
}

double HydrostaticColumn::density(double depth) const { return density_at(law_, pressure(depth), energy_); }

}  // namespace undex::materials
