// Flow stress laws of metals and the radial return that all of them share. SI units. Compiled once, in flow_stress.cpp,
// and not inlined: two discretisations that ask the same question must get the same bits.
#pragma once

#include <variant>

#include "materials/cowper_symonds.hpp"
#include "materials/flow_law.hpp"
#include "materials/johnson_cook.hpp"
#include "materials/power_hardening.hpp"
#include "materials/zerilli_armstrong.hpp"

namespace undex::materials {

/// Never yields.
struct Elastic {
  static constexpr const char* name = "elastic";
  static constexpr const char* summary = "never yields";
};
template <class Visit>
void describe(Elastic&, Visit&&) {}

/// sigma_Y = Y0 + H eps_p, H >= 0; perfectly plastic with H = 0.
struct LinearHardening {
  static constexpr const char* name = "linear_hardening";
  static constexpr const char* summary = "Y0 + H eps; perfectly plastic with H = 0";
  double Y0, H;  ///< [Pa]
};
template <class Visit>
void describe(LinearHardening& law, Visit&& visit) {
  visit(law.Y0, {.name = "Y0", .unit = "Pa", .range = Range::positive(), .needed = true, .meaning = "yield stress"});
  visit(law.H, {.name = "H", .unit = "Pa", .range = Range::at_least(0), .needed = true, .meaning = "its slope"});
}

/// A law with a closed return; all others have an isotherm.
template <class Law>
inline constexpr bool has_closed_return = std::same_as<Law, Elastic> || std::same_as<Law, LinearHardening>;
template <class... Laws>
requires((has_closed_return<Laws> || HasIsotherm<Laws>)&&...) using FlowStresses = std::variant<Laws...>;

using FlowStress = FlowStresses<Elastic, LinearHardening, JohnsonCook, PowerHardening, CowperSymonds, ZerilliArmstrong>;

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
