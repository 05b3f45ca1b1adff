// Flow stress laws of metals and the radial return that all of them share. SI units. Compiled once, in flow_stress.cpp,
// and not inlined: two discretisations that ask the same question must get the same bits.
#pragma once

#include <variant>

namespace undex::materials {

struct Elastic {};  ///< never yields
/// sigma_Y = Y0 + H eps_p, H >= 0; perfectly plastic with H = 0.
struct LinearHardening {
  double Y0, H;  ///< [Pa]
};
/// A + B eps_p^n (Ludwik 1909). B, n >= 0.
struct PowerHardening {
  double A, B;  ///< [Pa]
  double n;     ///< [-]
};
/// (A + B eps_p^n)(1 + C ln(rate/rate0))(1 - T*^m), T* = (T - T_room)/(T_melt - T_room) (Johnson and Cook 1983; Chen et
/// al. 2019, doi 10.1007/s40571-019-00230-7, eqs 16, 17); rate clamped at rate0, T* to [0, 1]. B, n, C >= 0.
struct JohnsonCook {
  double A, B;            ///< [Pa]
  double n, C, m;         ///< [-]; m is the k of Chen et al.
  double T_melt;          ///< [K]
  double rate0 = 1.0;     ///< [1/s]
  double T_room = 293.0;  ///< [K]
};
/// (Y0 + H eps_p)(1 + (rate/D)^(1/q)) (Cowper and Symonds 1957). H >= 0; D, q > 0.
struct CowperSymonds {
  double Y0, H;  ///< [Pa]
  double D;      ///< rate at which the stress has doubled [1/s]
  double q;      ///< [-]
};
/// C0 + (C1 + C2 sqrt(eps_p)) exp(-C3 T + C4 T ln(rate)) + C5 eps_p^n, the rate in 1/s, clamped at rate0 (Zerilli and
/// Armstrong 1987, doi 10.1063/1.338024). Body-centred metals have C2 = 0, face-centred ones C1 = C5 = 0. All >= 0.
struct ZerilliArmstrong {
  double C0;                  ///< [Pa]
  double C1 = 0.0, C2 = 0.0;  ///< [Pa]
  double C3, C4;              ///< [1/K]
  double C5 = 0.0;            ///< [Pa]
  double n = 1.0;             ///< [-]
  double rate0 = 1e-3;        ///< the rate of a tensile test [1/s]: the law itself falls to C0 at rest
};
using FlowStress = std::variant<Elastic, LinearHardening, JohnsonCook, PowerHardening, CowperSymonds, ZerilliArmstrong>;

/// Flow stress with its slopes.
struct Flow {
  double stress;      ///< [Pa]
  double hardening;   ///< d stress/d plastic strain at fixed rate and temperature [Pa]
  double rate_slope;  ///< d stress/d rate at fixed plastic strain and temperature [Pa s]
};
/// At plastic strain [-], plastic strain rate [1/s] and temperature [K]; {infinite, 0, 0} for Elastic. Where a power of
/// the strain makes the hardening infinite at zero strain, its value at a strain of 1e-6 is returned below that. The rate
/// slope of Cowper and Symonds is infinite at rest.
Flow flow(const FlowStress& law, double plastic_strain, double rate, double temperature);
double flow_stress(const FlowStress& law, double plastic_strain, double rate, double temperature);  ///< [Pa]
double hardening(const FlowStress& law, double plastic_strain, double rate, double temperature);    ///< [Pa]

/// Result of a radial return: S = scale * S_trial.
struct PlasticStep {
  double scale;           ///< in [0, 1]; 0 only where the flow stress is (molten)
  double plastic_strain;  ///< increment of equivalent plastic strain, >= 0
  double work;            ///< plastic work per volume [J/m^3]: flow stress at the end of the step times the increment
};
/// Radial return of a trial von Mises stress `trial` [Pa] over a step dt [s] (Chen et al. 2019, eqs 14, 15, 20), consistent
/// with the flow stress at the END of the step: trial - 3 G d_eps = sigma_Y(eps_p + d_eps, d_eps/dt, T), solved to
/// round-off. (Eq. 20 divides by 3G the excess over a flow stress known beforehand: the same thing for perfect
/// plasticity.) Temperature [K] is held over the step. dt must be positive where the law depends on the rate.
PlasticStep radial_return(const FlowStress& law, double shear_modulus, double trial, double plastic_strain, double temperature,
                          double dt);

}  // namespace undex::materials
