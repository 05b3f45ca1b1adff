// Classical exact solutions: Noh's implosion, Sedov's point explosion, Taylor's air-backed plate, elastic
// bars and rings. SI units.
#pragma once

#include "exact/ode.hpp"

namespace undex::exact {

/// State of an ideal gas.
struct GasSample {
  double density, velocity, pressure, energy;  ///< [kg/m^3], outward [m/s], [Pa], specific [J/kg]
};

/// W. F. Noh, J. Comput. Phys. 72, 1987: a cold ideal gas falls everywhere with the same speed on a plane, an
/// axis or a point and stops in a shock that runs outward.
struct Noh {
  int dimension = 3;                    ///< 1, 2, 3
  double gamma = 5. / 3;                ///< [-]
  double density = 1.0;                 ///< at the start [kg/m^3]
  double speed = 1.0;                   ///< inward [m/s], positive
  double shock_radius(double t) const;  ///< [m]
  GasSample sample(double r, double t) const;
};

/// L. I. Sedov, Similarity and Dimensional Methods in Mechanics: energy set free at t = 0 on a plane, an axis
/// or at a point of a cold uniform ideal gas. With lambda = r/R, D = dR/dt, u = D U, rho = rho0 G, p = rho0
/// D^2 P the equations of mass, momentum and entropy are ordinary ones,
///   (U - l) G' + G U' + (d - 1) G U/l = 0,  (U - l) U' - d U/2 + P'/G = 0,  (U - l)(P'/P - g G'/G) = d,
/// integrated here from the strong shock inward.
class Sedov {
 public:
  /// energy [J], per length [m] when dimension = 2, and per area [m^2] of ONE side (r > 0) when dimension
  /// = 1. Throws std::invalid_argument unless all are positive, gamma > 1 and dimension is 1, 2 or 3.
  Sedov(int dimension, double gamma, double density, double energy);
  /// alpha in R = (E t^2/(alpha rho0))^(1/(d + 2)).
  double energy_integral() const { return alpha_; }
  double shock_radius(double t) const;  ///< [m]
  GasSample sample(double r, double t) const;

 private:
  OdeState<4> slope(double s, const OdeState<4>& y) const;
  int dimension_;
  double gamma_, density_, energy_, alpha_ = 0.0;
  std::vector<OdePoint<4>> points_;  // s = ln lambda; U/lambda, ln G, ln P, energy integral from the front
};

/// G. I. Taylor's plate: a plane acoustic wave p0 exp(-t/theta) meets at t = 0 a free rigid plate with vacuum
/// behind, up to the moment at which the water would have to pull. Small pressures only: waves are linear.
struct TaylorPlate {
  double peak = 0.0;                                               ///< of the incident wave, p0 [Pa]
  double decay = 0.0;                                              ///< theta [s]
  double impedance = 0.0;                                          ///< of the water, rho c [kg/(m^2 s)]
  double plate_mass = 0.0;                                         ///< per area [kg/m^2]
  double ratio() const { return impedance * decay / plate_mass; }  ///< z [-]
  double wall_pressure(double t) const;                            ///< total, on the plate [Pa]
  double velocity(double t) const;                                 ///< of the plate [m/s]
  double cavitation_time() const;  ///< at which the wall's pressure is zero: theta ln z/(z - 1) [s]
  double impulse() const;          ///< up to then [Pa s]: 2 p0 theta z^(z/(1 - z))
};

/// Speed of longitudinal waves [m/s] in a thin bar (free sides).
double bar_wave_speed(double young, double density);
/// Speed of plane longitudinal waves [m/s] in the bulk (no lateral strain).
double bulk_wave_speed(double young, double poisson, double density);
/// Speed of shear waves [m/s].
double shear_wave_speed(double young, double poisson, double density);
/// Period [s] of the radial breathing of a thin ring of mean radius [m]; of a long tube held in its axial
/// direction (plane strain) with the last argument.
double ring_breathing_period(double young, double density, double mean_radius);
double tube_breathing_period(double young, double poisson, double density, double mean_radius);

/// A uniform elastic bar that hits a rigid wall (x = 0) with its face at t = 0: the wave of d'Alembert. It
/// lifts off after 2 L/c with its speed reversed.
struct ElasticBarImpact {
  double length, speed, young, density;  ///< [m], towards the wall [m/s], [Pa], [kg/m^3]
  double contact_time() const { return 2.0 * length / bar_wave_speed(young, density); }  ///< [s]
  struct Sample {
    double velocity;  ///< away from the wall [m/s]
    double stress;    ///< tension positive [Pa]
  };
  /// At x in [0, length] of the undeformed bar and 0 <= t <= contact_time().
  Sample sample(double x, double t) const;
};

}  // namespace undex::exact
