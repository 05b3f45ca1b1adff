// Failure of solids: how much tension they stand, and damage by plastic strain. SI units; pressure positive in compression.
#pragma once

#include "core/record.hpp"

namespace undex::materials {

/// Tensile strength of the pressure: it never falls below -strength (spall).
struct Spall {
  enum class Mode {
    cutoff,  ///< the pressure is limited; a point that closes again is as before
    fail,    ///< a point whose pressure has reached -strength has failed for good
  };
  double strength = 0.0;  ///< [Pa]
  Mode mode = Mode::cutoff;
};
constexpr auto words(Spall::Mode) {
  return std::to_array<Word<Spall::Mode>>({{"cutoff", Spall::Mode::cutoff}, {"fail", Spall::Mode::fail}});
}
template <class Visit>
void describe(Spall& spall, Visit&& visit) {
  visit(spall.strength, {.name = "strength",
                         .unit = "Pa",
                         .range = Range::positive(),
                         .needed = true,
                         .remedy = "give the tension in Pa at which the material parts, e.g. strength = 1e9",
                         .meaning = "the pressure never falls below -strength"});
  visit(spall.mode,
        {.name = "mode", .meaning = "the pressure is just limited; or what has reached the limit has failed for good"});
}

/// Fracture strain (D1 + D2 exp(D3 sigma*))(1 + D4 ln(rate/rate0))(1 + D5 T*) of Johnson and Cook 1985, doi
/// 10.1016/0013-7944(85)90052-9: sigma* = mean stress over von Mises stress, T* and rate clamped as in their flow stress.
/// D2 >= 0, D3 <= 0: tension breaks sooner. Above sigma* = 1.5, the end of the equation's range, its value at 1.5 is taken;
/// the paper's second branch, down to a spall stress, is left to `Spall`.
struct JohnsonCookDamage {
  double D1, D2, D3, D4, D5;  ///< [-]
  double T_melt;              ///< [K]
  double rate0 = 1.0;         ///< [1/s]
  double T_room = 293.0;      ///< [K]
};
template <class Visit>
void describe(JohnsonCookDamage& law, Visit&& visit) {
  constexpr const char* all = "Johnson and Cook's fracture strain needs D1 to D5; write 0 for a term that it does not have";
  visit(law.D1, {.name = "D1",
                 .needed = true,
                 .remedy = all,
                 .meaning = "fracture strain without the next two; D1 + D2 exp(1.5 D3) "
                            "must be positive"});
  visit(law.D2, {.name = "D2", .range = Range::at_least(0), .needed = true, .remedy = all, .meaning = "what tension takes away"});
  visit(law.D3, {.name = "D3", .range = Range::between(-100, 0), .needed = true, .remedy = all, .meaning = "and how fast"});
  visit(law.D4, {.name = "D4", .needed = true, .remedy = all, .meaning = "influence of the rate"});
  visit(law.D5, {.name = "D5", .needed = true, .remedy = all, .meaning = "and of heat"});
  visit(law.T_melt, {.name = "T_melt",
                     .unit = "K",
                     .range = Range::positive(),
                     .rule = "that of flow \"johnson_cook\", else required",
                     .values = "above `T_room`",
                     .meaning = "as that of the flow stress"});
  visit(law.rate0, {.name = "rate0",
                    .unit = "1/s",
                    .range = Range::positive(),
                    .rule = "that of flow \"johnson_cook\", else 1",
                    .meaning = "rates below it count as it"});
  visit(law.T_room, {.name = "T_room",
                     .unit = "K",
                     .range = Range::above(0, 1e4),
                     .rule = "that of flow \"johnson_cook\", else 293",
                     .meaning = "as that of the flow stress"});
}
/// Equivalent plastic strain to fracture [-] at constant stress triaxiality sigma* [-] (finite), plastic strain rate [1/s]
/// and temperature [K]; never below 1e-9, infinite where compression keeps everything together.
double fracture_strain(const JohnsonCookDamage& law, double triaxiality, double rate, double temperature);

}  // namespace undex::materials
