// The parameters of every material law under their names in a scene file: one list, for reading and for writing.
#pragma once

#include <string_view>

#include "materials/library.hpp"

namespace undex::scene {

template <class F>
void each_field(materials::TaitWater::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("B", p.B), field("N", p.N), field("A", p.A);
  field("cavitation", p.cavitation);
  field("density_ratio", p.mixture.density_ratio), field("vapour_sound", p.mixture.vapour_sound);
  field("liquid_sound", p.mixture.liquid_sound), field("p_sat", p.mixture.p_sat), field("p_floor", p.p_floor);
  field("vapour_gamma", p.vapour_gamma), field("initial_void", p.initial_void);
}
template <class F>
void each_field(materials::BarotropicGas::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("p0", p.p0), field("gamma", p.gamma);
}
template <class F>
void each_field(materials::IdealGas::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("gamma", p.gamma);
}
template <class F>
void each_field(materials::StiffenedGas::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("gamma", p.gamma), field("p_inf", p.p_inf);
}
template <class F>
void each_field(materials::Jwl::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("A", p.A), field("B", p.B), field("R1", p.R1), field("R2", p.R2);
  field("omega", p.omega), field("E0", p.E0), field("D", p.D), field("p_cj", p.p_cj);
}
template <class F>
void each_field(materials::MieGruneisenWater::Parameters& p, F&& field) {
  field("rho0", p.rho0), field("C0", p.C0), field("S1", p.S1), field("S2", p.S2), field("S3", p.S3);
  field("gamma0", p.gamma0), field("alpha", p.alpha), field("cavitation", p.cavitation), field("p_floor", p.p_floor);
}

template <class F>
void each_field(materials::LinearPressure& p, F&& field) {
  field("bulk_modulus", p.bulk_modulus);
}
template <class F>
void each_field(materials::MieGruneisenPressure& p, F&& field) {
  field("C", p.C), field("S", p.S), field("Gamma", p.Gamma);
}
template <class F>
void each_field(materials::Elastic&, F&&) {}
template <class F>
void each_field(materials::LinearHardening& p, F&& field) {
  field("Y0", p.Y0), field("H", p.H);
}
template <class F>
void each_field(materials::JohnsonCook& p, F&& field) {
  field("A", p.A), field("B", p.B), field("n", p.n), field("C", p.C), field("m", p.m), field("T_melt", p.T_melt);
  field("rate0", p.rate0), field("T_room", p.T_room);
}
template <class F>
void each_field(materials::PowerHardening& p, F&& field) {
  field("A", p.A), field("B", p.B), field("n", p.n);
}
template <class F>
void each_field(materials::CowperSymonds& p, F&& field) {
  field("Y0", p.Y0), field("H", p.H), field("D", p.D), field("q", p.q);
}
template <class F>
void each_field(materials::ZerilliArmstrong& p, F&& field) {
  field("C0", p.C0), field("C1", p.C1), field("C2", p.C2), field("C3", p.C3), field("C4", p.C4), field("C5", p.C5);
  field("n", p.n), field("rate0", p.rate0);
}
template <class F>
void each_field(materials::JohnsonCookDamage& p, F&& field) {
  field("D1", p.D1), field("D2", p.D2), field("D3", p.D3), field("D4", p.D4), field("D5", p.D5);
  field("T_melt", p.T_melt), field("rate0", p.rate0), field("T_room", p.T_room);
}

/// Has the parameter a value where a scene does not name it? The room temperature and the reference rate have their usual
/// ones everywhere; terms that a law need not have are zero.
template <class Law>
bool has_default(const Law&, std::string_view key) {
  return key == "rate0" || key == "T_room";
}
inline bool has_default(const materials::ZerilliArmstrong&, std::string_view key) {
  return key == "rate0" || key == "C1" || key == "C2" || key == "C5" || key == "n";
}

inline const char* law_name(const materials::TaitWater&) { return "tait"; }
inline const char* law_name(const materials::BarotropicGas&) { return "barotropic_gas"; }
inline const char* law_name(const materials::IdealGas&) { return "ideal_gas"; }
inline const char* law_name(const materials::StiffenedGas&) { return "stiffened_gas"; }
inline const char* law_name(const materials::Jwl&) { return "jwl"; }
inline const char* law_name(const materials::MieGruneisenWater&) { return "mie_gruneisen"; }
inline const char* law_name(const materials::LinearPressure&) { return "linear"; }
inline const char* law_name(const materials::MieGruneisenPressure&) { return "mie_gruneisen"; }
inline const char* law_name(const materials::Elastic&) { return "elastic"; }
inline const char* law_name(const materials::LinearHardening&) { return "linear_hardening"; }
inline const char* law_name(const materials::JohnsonCook&) { return "johnson_cook"; }
inline const char* law_name(const materials::PowerHardening&) { return "power_hardening"; }
inline const char* law_name(const materials::CowperSymonds&) { return "cowper_symonds"; }
inline const char* law_name(const materials::ZerilliArmstrong&) { return "zerilli_armstrong"; }

inline const char* spall_mode_name(materials::Spall::Mode mode) {
  return mode == materials::Spall::Mode::fail ? "fail" : "cutoff";
}

inline const char* cavitation_name(materials::Cavitation cavitation) {
  switch (cavitation) {
    case materials::Cavitation::none: return "none";
    case materials::Cavitation::cutoff: return "cutoff";
    case materials::Cavitation::isentropic: return "isentropic";
    case materials::Cavitation::schmidt: break;
  }
  return "schmidt";
}

}  // namespace undex::scene
