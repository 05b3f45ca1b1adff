#include "materials/solid.hpp"

#include <cmath>

namespace undex::materials {

double bulk_modulus(const Solid& solid) { return bulk_modulus(solid.pressure, solid.rho0); }

double wave_speed(const Solid& solid) { return std::sqrt((bulk_modulus(solid) + 4.0 / 3.0 * solid.shear_modulus) / solid.rho0); }

}  // namespace undex::materials
