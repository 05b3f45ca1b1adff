// Numbers with a name that many files use.
#pragma once

#include <limits>
#include <numbers>

namespace undex {

inline constexpr double pi = std::numbers::pi;
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();  ///< of a value that is not there
inline constexpr double forever = std::numeric_limits<double>::infinity();
inline constexpr double us = 1e-6;  ///< [s]

}  // namespace undex
