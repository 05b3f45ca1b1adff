// Flow stress of Zerilli and Armstrong, from the motion of dislocations past obstacles. SI units.
#pragma once

#include <algorithm>

#include "materials/flow_law.hpp"

namespace undex::materials {

/// C0 + (C1 + C2 sqrt(eps_p)) exp(-C3 T + C4 T ln(rate)) + C5 eps_p^n, the rate in 1/s, clamped at rate0 (Zerilli and
/// Armstrong 1987, doi 10.1063/1.338024). Body-centred metals have C2 = 0, face-centred ones C1 = C5 = 0. All >= 0.
struct ZerilliArmstrong {
  static constexpr const char* name = "zerilli_armstrong";
  static constexpr const char* summary =
      "C0 + (C1 + C2 sqrt(eps)) exp(-C3 T + C4 T ln(rate)) + C5 eps^n, the rate in 1/s; body-centred metals have no C2, "
      "face-centred ones no C1 and C5";
  double C0;                  ///< [Pa]
  double C1 = 0.0, C2 = 0.0;  ///< [Pa]
  double C3, C4;              ///< [1/K]
  double C5 = 0.0;            ///< [Pa]
  double n = 1.0;             ///< [-]
  double rate0 = 1e-3;        ///< the rate of a tensile test [1/s]: the law itself falls to C0 at rest
};

template <class Visit>
void describe(ZerilliArmstrong& law, Visit&& visit) {
  visit(law.C0, {.name = "C0",
                 .unit = "Pa",
                 .range = Range::at_least(0),
                 .needed = true,
                 .meaning = "what heat does not soften; C0 and C1 must not both be 0"});
  visit(law.C1, {.name = "C1", .unit = "Pa", .range = Range::at_least(0), .meaning = "thermal stress of body-centred metals"});
  visit(law.C2, {.name = "C2", .unit = "Pa", .range = Range::at_least(0), .meaning = "thermal hardening of face-centred metals"});
  visit(law.C3, {.name = "C3", .unit = "1/K", .range = Range::at_least(0), .needed = true, .meaning = "softening by heat"});
  visit(law.C4, {.name = "C4", .unit = "1/K", .range = Range::at_least(0), .needed = true, .meaning = "hardening by the rate"});
  visit(law.C5, {.name = "C5", .unit = "Pa", .range = Range::at_least(0), .meaning = "hardening of body-centred metals"});
  visit(law.n, {.name = "n", .range = Range::above(0, 10), .meaning = "its exponent"});
  visit(law.rate0, {.name = "rate0", .unit = "1/s", .range = Range::positive(), .meaning = "rates below it count as it"});
}

template <>
struct Isotherm<ZerilliArmstrong> {
  const ZerilliArmstrong& law;
  double temperature;
  Isotherm(const ZerilliArmstrong& of, double at_temperature) : law(of), temperature(at_temperature) {}
  double least() const { return law.C0; }
  double at_rest(double strain) const { return at(strain, 0.0).stress; }
  Flow at(double strain, double rate) const {
    const double thermal = std::exp(temperature * (law.C4 * std::log(std::max(rate, law.rate0)) - law.C3));
    const double root = law.C2 > 0.0 ? law.C2 * std::sqrt(strain) : 0.0;
    const double power = law.C5 > 0.0 ? power_of(strain, law.C5, law.n) : 0.0;
    const double activated = (law.C1 + root) * thermal;
    return {law.C0 + activated + power, (0.5 * root * thermal + law.n * power) / strain,
            rate > law.rate0 ? activated * law.C4 * temperature / rate : 0.0};
  }
  double kink() const { return law.rate0; }
};

}  // namespace undex::materials
