// Flow stress of Johnson and Cook: hardening by strain and rate, softening by heat. SI units.
#pragma once

#include "materials/flow_law.hpp"

namespace undex::materials {

/// (A + B eps_p^n)(1 + C ln(rate/rate0))(1 - T*^m), T* = (T - T_room)/(T_melt - T_room) (Johnson and Cook 1983; Chen et
/// al. 2019, doi 10.1007/s40571-019-00230-7, eqs 16, 17); rate clamped at rate0, T* to [0, 1]. B, n, C >= 0.
struct JohnsonCook {
  static constexpr const char* name = "johnson_cook";
  static constexpr const char* summary = "(A + B eps^n)(1 + C ln(rate/rate0))(1 - T*^m), T* = (T - T_room)/(T_melt - T_room)";
  double A, B;            ///< [Pa]
  double n, C, m;         ///< [-]; m is the k of Chen et al.
  double T_melt;          ///< [K]
  double rate0 = 1.0;     ///< [1/s]
  double T_room = 293.0;  ///< [K]
};

template <class Visit>
void describe(JohnsonCook& law, Visit&& visit) {
  visit(law.A, {.name = "A", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "yield stress"});
  visit(law.B, {.name = "B", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "hardening"});
  visit(law.n, {.name = "n", .range = Range::above(0, 10), .needed = true, .meaning = "its exponent"});
  visit(law.C, {.name = "C", .range = Range::at_least(0), .needed = true, .meaning = "hardening by the rate"});
  visit(law.m, {.name = "m", .range = Range::positive(), .needed = true, .meaning = "exponent of the softening"});
  visit(law.T_melt, {.name = "T_melt",
                     .unit = "K",
                     .range = Range::positive(),
                     .needed = true,
                     .values = "above `T_room`",
                     .meaning = "where no stress is left"});
  visit(law.rate0, {.name = "rate0", .unit = "1/s", .range = Range::positive(), .meaning = "rates below it count as it"});
  visit(law.T_room, {.name = "T_room", .unit = "K", .range = Range::above(0, 1e4), .meaning = "where softening begins"});
}

template <>
struct Isotherm<JohnsonCook> {
  const JohnsonCook& law;
  double thermal;  ///< 1 - T*^m
  Isotherm(const JohnsonCook& of, double temperature) : law(of), thermal(1.0) {
    if (temperature <= law.T_room) return;
    const double homologous = (temperature - law.T_room) / (law.T_melt - law.T_room);
    thermal = temperature >= law.T_melt ? 0.0 : 1.0 - (law.m == 1.0 ? homologous : std::pow(homologous, law.m));
  }
  double least() const { return law.A * thermal; }
  double at_rest(double strain) const { return (law.A + power_of(strain, law.B, law.n)) * thermal; }
  Flow at(double strain, double rate) const {
    const double power = power_of(strain, law.B, law.n);
    double rate_factor = 1.0, rate_slope = 0.0;
    if (rate > law.rate0 && law.C > 0.0) {
      rate_factor += law.C * std::log(rate / law.rate0);
      rate_slope = law.C / rate;
    }
    return {(law.A + power) * rate_factor * thermal, thermal * rate_factor * law.n * power / strain,
            thermal * rate_slope * (law.A + power)};
  }
  double kink() const { return law.rate0; }
};

}  // namespace undex::materials
