// Flow stress of a metal that hardens by a power of its plastic strain. SI units.
#pragma once

#include "materials/flow_law.hpp"

namespace undex::materials {

/// A + B eps_p^n (Ludwik 1909). B, n >= 0.
struct PowerHardening {
  static constexpr const char* name = "power_hardening";
  static constexpr const char* summary = "A + B eps^n";
  double A, B;  ///< [Pa]
  double n;     ///< [-]
};

template <class Visit>
void describe(PowerHardening& law, Visit&& visit) {
  visit(law.A, {.name = "A", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "yield stress"});
  visit(law.B, {.name = "B", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "hardening"});
  visit(law.n, {.name = "n", .range = Range::above(0, 10), .needed = true, .meaning = "its exponent"});
}

template <>
struct Isotherm<PowerHardening> {
  const PowerHardening& law;
  Isotherm(const PowerHardening& of, double) : law(of) {}
  double least() const { return law.A; }
  double at_rest(double strain) const { return law.A + power_of(strain, law.B, law.n); }
  Flow at(double strain, double) const {
    const double power = power_of(strain, law.B, law.n);
    return {law.A + power, law.n * power / strain, 0.0};
  }
  double kink() const { return 0.0; }
};

}  // namespace undex::materials
