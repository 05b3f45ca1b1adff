// What every pressure law of a fluid answers, and what liquid water does when it is stretched.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/record.hpp"

namespace undex::materials {

struct PressureSound {
  double pressure;     ///< [Pa]
  double sound_speed;  ///< [m/s], always > 0
};

/// What happens where liquid water is stretched below its saturation pressure.
enum class Cavitation {
  none,        ///< tension allowed
  cutoff,      ///< pressure held at `p_floor`
  schmidt,     ///< modified Schmidt mixture (Chen et al. 2019, eqs 31-33), made continuous with the liquid law
               ///< at p_sat
  isentropic,  ///< liquid and vapour in equilibrium of pressure, each on its isentrope (isentropic_mixture.hpp)
};
constexpr auto words(Cavitation) {
  return std::to_array<Word<Cavitation>>({{"none", Cavitation::none},
                                          {"cutoff", Cavitation::cutoff},
                                          {"schmidt", Cavitation::schmidt},
                                          {"isentropic", Cavitation::isentropic}});
}

/// Square root of a squared sound speed [m^2/s^2], held at or above 1 mm/s. Time steps and impedances divide
/// by the sound speed, and a state outside a law's physical range (no energy left, unstable compression) may
/// give none.
inline double guarded_sound_speed(double sound_squared) { return std::sqrt(std::max(sound_squared, 1e-6)); }

}  // namespace undex::materials
