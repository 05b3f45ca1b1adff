// What a flow stress law is made of: a struct with its constants, its description, and an isotherm. One law a header. SI units.
#pragma once

#include <cmath>
#include <concepts>

#include "core/record.hpp"

namespace undex::materials {

/// Flow stress with its slopes.
struct Flow {
  double stress;      ///< [Pa]
  double hardening;   ///< d stress/d plastic strain at fixed rate and temperature [Pa]
  double rate_slope;  ///< d stress/d rate at fixed plastic strain and temperature [Pa s]
};

/// A law at one temperature [K]; every law whose return is not closed specialises it.
template <class Law>
struct Isotherm;

/// A law that the shared Newton return of flow_stress.cpp takes: it has a name, described constants, and an isotherm.
template <class Law>
concept HasIsotherm = Described<Law> &&
    requires(const Law& law, const Isotherm<Law>& at, double temperature, double strain, double rate) {
  { Law::name } -> std::convertible_to<const char*>;     // in a scene file
  { Law::summary } -> std::convertible_to<const char*>;  // its formula, for docs/reference/scene-file.md
  Isotherm<Law>(law, temperature);
  { at.least() } -> std::same_as<double>;  // what the flow stress never falls below, without a transcendental function [Pa]
  { at.at_rest(strain) } -> std::same_as<double>;  // flow stress at zero rate [Pa]
  { at.at(strain, rate) } -> std::same_as<Flow>;   // with its slopes; strain > 0 where a power needs it
  { at.kink() } -> std::same_as<double>;           // rate up to which the rate does not count [1/s]
};

/// factor strain^exponent, 0 at zero strain.
inline double power_of(double strain, double factor, double exponent) {
  return strain > 0.0 ? factor * std::pow(strain, exponent) : 0.0;
}

}  // namespace undex::materials
