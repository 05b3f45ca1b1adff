// Flow stress of Cowper and Symonds: linear hardening, raised by a power of the rate. SI units.
#pragma once

#include <limits>

#include "materials/flow_law.hpp"

namespace undex::materials {

/// (Y0 + H eps_p)(1 + (rate/D)^(1/q)) (Cowper and Symonds 1957). H >= 0; D, q > 0.
struct CowperSymonds {
  static constexpr const char* name = "cowper_symonds";
  static constexpr const char* summary = "(Y0 + H eps)(1 + (rate/D)^(1/q))";
  double Y0, H;  ///< [Pa]
  double D;      ///< rate at which the stress has doubled [1/s]
  double q;      ///< [-]
};

template <class Visit>
void describe(CowperSymonds& law, Visit&& visit) {
  visit(law.Y0, {.name = "Y0", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "yield stress"});
  visit(law.H, {.name = "H", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "slope of the hardening"});
  visit(law.D, {.name = "D",
                .unit = "1/s",
                .range = Range::positive(),
                .needed = true,
                .meaning = "rate at which the stress has doubled"});
  visit(law.q, {.name = "q", .range = Range::above(0, 100), .needed = true, .meaning = "the rate's exponent is 1/q"});
}

template <>
struct Isotherm<CowperSymonds> {
  const CowperSymonds& law;
  Isotherm(const CowperSymonds& of, double) : law(of) {}
  double least() const { return law.Y0; }
  double at_rest(double strain) const { return law.Y0 + law.H * strain; }
  Flow at(double strain, double rate) const {
    const double power = rate > 0.0 ? std::pow(rate / law.D, 1.0 / law.q) : 0.0;
    const double still = at_rest(strain);
    return {still * (1.0 + power), law.H * (1.0 + power),
            rate > 0.0 ? still * power / (law.q * rate) : std::numeric_limits<double>::infinity()};
  }
  double kink() const { return 0.0; }
};

}  // namespace undex::materials
