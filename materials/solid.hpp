// Constitutive law of solids: pressure law, flow stress and one radial return, shared by every
// discretisation. Chen, Peng, Lien, Zhao 2019, doi 10.1007/s40571-019-00230-7, eqs 14-23. Cauchy stress,
// positive in tension; pressure positive in compression; SI units. Everything is compiled once, in solid.cpp,
// and not inlined: two discretisations that ask the same question must get the same bits, whatever compiler
// flags their own loops use. Where a loop knows its law, the overloads for the single laws save the dispatch.
#pragma once

#include <string>
#include <variant>

namespace undex::materials {

/// p = K (rho/rho0 - 1).
struct LinearPressure {
  double bulk_modulus;  ///< [Pa]
};
/// Mie-Grueneisen with a Hugoniot cubic in eta = rho/rho0 - 1 (eqs 21-23):
/// p = (1 - Gamma eta/2) p_H + Gamma rho e, with p_H linear in tension.
struct MieGruneisenPressure {
  double C;      ///< bulk sound speed at rest [m/s]
  double S;      ///< slope of shock speed over particle speed [-]
  double Gamma;  ///< [-]
};
using SolidPressure = std::variant<LinearPressure, MieGruneisenPressure>;

struct Elastic {};  ///< never yields
/// sigma_Y = Y0 + H eps_p, H >= 0; perfectly plastic with H = 0.
struct LinearHardening {
  double Y0, H;  ///< [Pa]
};
/// (A + B eps_p^n)(1 + C ln(rate/rate0))(1 - T*^m) (eqs 16, 17); rate clamped at rate0, T* to [0, 1]. B, n, C
/// >= 0.
struct JohnsonCook {
  double A, B;            ///< [Pa]
  double n, C, m;         ///< [-]; m is the paper's k
  double T_melt;          ///< [K]
  double rate0 = 1.0;     ///< [1/s]
  double T_room = 293.0;  ///< [K]
};
using FlowStress = std::variant<Elastic, LinearHardening, JohnsonCook>;

struct Solid {
  std::string name, source;
  double rho0;           ///< [kg/m^3]
  double shear_modulus;  ///< [Pa]
  SolidPressure pressure;
  FlowStress flow;
  double heat_capacity = 900.0;  ///< [J/kg/K]
  double taylor_quinney = 0.9;   ///< share of the plastic work that heats
  double T_room = 293.0;         ///< temperature at the start [K]
};

/// Flow stress [Pa] at plastic strain [-], plastic strain rate [1/s] and temperature [K]; infinite for
/// Elastic.
double flow_stress(const FlowStress& law, double plastic_strain, double rate, double temperature);
double flow_stress(const LinearHardening& law, double plastic_strain, double rate, double temperature);
double flow_stress(const JohnsonCook& law, double plastic_strain, double rate, double temperature);
/// Its derivative with respect to plastic strain [Pa] at fixed rate and temperature; 0 for Elastic. Where n <
/// 1 the slope of Johnson-Cook's law is infinite at zero strain: below a strain of 1e-6 its value at 1e-6 is
/// returned.
double hardening(const FlowStress& law, double plastic_strain, double rate, double temperature);

/// p [Pa] and bulk sound speed [m/s].
struct SolidPressureSound {
  double pressure, bulk_sound;
};
/// At density rho [kg/m^3] and specific internal energy e [J/kg], counted from zero at rest at room
/// temperature. Bulk sound is the isentropic dp/drho of the pressure law alone (no shear), at least a tenth
/// of C for Mie-Grueneisen.
SolidPressureSound evaluate(const SolidPressure& law, double rho0, double rho, double energy);
SolidPressureSound evaluate(const LinearPressure& law, double rho0, double rho, double energy);
SolidPressureSound evaluate(const MieGruneisenPressure& law, double rho0, double rho, double energy);

/// Result of a radial return: S = scale * S_trial.
struct PlasticStep {
  double scale;           ///< in [0, 1]; 0 only where the flow stress is (molten)
  double plastic_strain;  ///< increment of equivalent plastic strain, >= 0
  double work;  ///< plastic work per volume [J/m^3]: flow stress at the end of the step times the increment
};
/// Radial return of a trial von Mises stress `trial` [Pa] over a step dt [s] (eqs 14, 15, 20), consistent
/// with the flow stress at the END of the step: trial - 3 G d_eps = sigma_Y(eps_p + d_eps, d_eps/dt, T),
/// solved to round-off. (Eq. 20 divides by 3G the excess over a flow stress known beforehand: the same thing
/// for perfect plasticity.) Temperature [K] is held over the step. dt must be positive where the law depends
/// on the rate.
PlasticStep radial_return(const Solid& solid, double trial, double plastic_strain, double temperature,
                          double dt);
PlasticStep radial_return(const LinearHardening& law, double shear_modulus, double trial,
                          double plastic_strain);
PlasticStep radial_return(const JohnsonCook& law, double shear_modulus, double trial, double plastic_strain,
                          double temperature, double dt);

/// Bulk modulus at rest [Pa].
double bulk_modulus(const Solid& solid);
/// Longitudinal (dilatational) elastic wave speed at rest [m/s].
double wave_speed(const Solid& solid);

}  // namespace undex::materials
