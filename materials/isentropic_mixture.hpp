// Cavitating water as one barotropic fluid of two phases that move, and change pressure, together: liquid after Tait and
// vapour (or gas) on its isentrope, in the proportion that they have where cavitation begins.
// Liu, Khoo, Xie 2004, J. Comput. Phys. 201, 80 (isentropic one-fluid model). SI units.
//   1/rho = (L(p) + k y(p))/(rho_l + k rho_g),   k = a/(1 - a)
//   L = (P/P_sat)^(-1/N), P = p + B - A;   y = (p/p_sat)^(-1/gamma)
// rho_l and rho_g are the phases' densities at p_sat and a the void fraction there. With every phase's own mass constant,
// p d(1/rho) is the work of both, and the sound speed is Wood's, 1/(rho c^2) = (1 - alpha)/(N P) + alpha/(gamma p).
#pragma once

namespace undex::materials {

class IsentropicMixture {
 public:
  struct Constants {
    double p_sat;                  ///< [Pa]
    double liquid_density, N;      ///< of the liquid at p_sat [kg/m^3], and its exponent
    double stiffness;              ///< B - A [Pa]
    double vapour_density, gamma;  ///< of the vapour at p_sat [kg/m^3], and its exponent
    double initial_void;           ///< void fraction where the liquid begins to cavitate
  };

  IsentropicMixture() = default;
  explicit IsentropicMixture(const Constants& constants);

  /// Density [kg/m^3] at 0 < p <= p_sat [Pa], and its inverse for 0 < rho <= density(p_sat).
  double density(double p) const;
  double pressure(double rho) const;
  /// Volume fraction of vapour, and the square of Wood's sound speed [m^2/s^2], at p.
  double void_fraction(double p) const;
  double sound_squared(double p) const;
  /// Specific energy [J/kg] above that at p_sat: de = p drho/rho^2 with both phases on their isentropes.
  double energy(double p) const;

 private:
  double liquid_stretch(double p) const;  ///< L(p) - 1
  double vapour_stretch(double p) const;  ///< y(p)

  Constants c_{};
  double k_ = 0, mass_ = 0;  ///< [-], rho_l + k rho_g [kg/m^3]
};

}  // namespace undex::materials
