// Failure of solids: how much tension they stand, and damage by plastic strain. SI units; pressure positive in compression.
#pragma once

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
/// Equivalent plastic strain to fracture [-] at constant stress triaxiality sigma* [-] (finite), plastic strain rate [1/s]
/// and temperature [K]; never below 1e-9, infinite where compression keeps everything together.
double fracture_strain(const JohnsonCookDamage& law, double triaxiality, double rate, double temperature);

}  // namespace undex::materials
