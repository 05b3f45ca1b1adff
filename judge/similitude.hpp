// comparison.kind = "similitude": pressures of a charge in open water beside the laws of similitude of its explosive. SI units.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/series.hpp"

namespace undex::judge {

/// factor, exponent of X = factor (s/R)^exponent, times s but for the peak, with s = W^(1/3), W [kg], R [m].
struct PowerLaw {
  double factor, exponent;
};

/// What is known of an explosive; a law that is not known is empty.
struct SimilitudeLaws {
  std::string name, source;
  std::optional<PowerLaw> peak, decay, impulse, energy_flux;  ///< [Pa], [s], [Pa s], [J/m^2]
};

/// Explosives by name.
const std::vector<SimilitudeLaws>& known_similitude();

/// Marks of a shock wave at a point, above the pressure before it; NaN where the history does not show one to its end.
struct ShockWave {
  double peak;         ///< largest [Pa]
  double decay;        ///< from the peak until the pressure has fallen to 1/e of it [s]
  double impulse;      ///< until 6.7 decays after the peak (R. H. Cole, Underwater Explosions, 1948) [Pa s]
  double energy_flux;  ///< integral of p^2/(rho c) over the same time [J/m^2]
};

/// `impedance`: rho c of the water at rest [Pa s/m]. Throws std::invalid_argument on a series that is not one.
ShockWave shock_wave(const output::Series& pressure, double impedance);

}  // namespace undex::judge
