// Power hardening through yield and the necking point.
#include "materials/tensile_test.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace undex::materials {

PowerHardening hardening_from(const TensileTest& test) {
  const double strain = std::log1p(test.uniform_elongation);
  const double stress = test.ultimate * (1.0 + test.uniform_elongation);
  if (!(test.yield > 0 && test.yield < stress && strain > 0)) {
    std::ostringstream text;
    text << "tensile test must have 0 < yield < true stress at the largest load and a positive elongation, "
            "got yield "
         << test.yield << " Pa, ultimate " << test.ultimate << " Pa, elongation " << test.uniform_elongation;
    throw std::invalid_argument(text.str());
  }
  PowerHardening hardening{};
  hardening.A = test.yield;
  hardening.n = strain * stress / (stress - test.yield);
  hardening.B = (stress - test.yield) / std::pow(strain, hardening.n);
  return hardening;
}

}  // namespace undex::materials
