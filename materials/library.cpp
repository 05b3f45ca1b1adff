// The named material sets and their sources. "Recalled, not read" marks values from memory of the literature,
// which nobody has checked against the page they come from; "read" marks those seen in a public code or data
// file.
#include "materials/library.hpp"

#include <type_traits>

namespace undex::materials {

namespace {

#define UNDEX_PAPER "Chen, Peng, Lien, Zhao 2019, doi 10.1007/s40571-019-00230-7"

/// Shear and bulk modulus [Pa] from Young's modulus [Pa] and Poisson's ratio.
constexpr double shear_from(double E, double nu) { return E / (2.0 * (1.0 + nu)); }
constexpr double bulk_from(double E, double nu) { return E / (3.0 * (1.0 - 2.0 * nu)); }

template <class Set>
std::optional<Set> find(const std::vector<Set>& sets, std::string_view name) {
  for (const Set& set : sets)
    if (set.name == name) return set;
  return std::nullopt;
}

template <class Law>
Fluid fluid(const char* name, const char* source, const Law& law) {
  Fluid set;
  set.name = name;
  set.source = source;
  set.law = law;
  set.rho0 = law.parameters().rho0;
  return set;
}

std::vector<Fluid> make_fluids() {
  std::vector<Fluid> sets;
  sets.push_back(fluid("water-tait",
                       UNDEX_PAPER ", eqs 28-33 and the constants printed with them; the mixture starts at the Tait "
                                   "density of p_sat, where the printed eq. 32 would jump",
                       TaitWater()));

  TaitWater::Parameters cutoff;
  cutoff.cavitation = Cavitation::cutoff;
  sets.push_back(fluid("water-tait-cutoff",
                       UNDEX_PAPER ", eq. 28 with its constants; plain cut-off at p_floor in place of the mixture",
                       TaitWater(cutoff)));

  TaitWater::Parameters isentropic;
  isentropic.cavitation = Cavitation::isentropic;
  isentropic.mixture.density_ratio = 2.31e-5;
  sets.push_back(fluid("water-tait-isentropic",
                       "Liquid: " UNDEX_PAPER
                       ", eq. 28 with its constants; mixture: Liu, Khoo, Xie 2004, J. Comput. Phys. 201, 80; saturated steam of "
                       "25 C, 0.0231 kg/m^3 and gamma 1.33, recalled, not read; initial_void is a choice of ours",
                       TaitWater(isentropic)));

  const MieGruneisenWater::Parameters steinberg;
  sets.push_back(fluid("water-steinberg",
                       "Form: " UNDEX_PAPER ", eq. 27; coefficients after Steinberg 1987, recalled, not read; supported by a "
                       "cubic pressure fit read in a public code (2.19, 9.224, 8.767 GPa), 2-4 % off at mu = 0.1 and 0.2",
                       MieGruneisenWater(steinberg)));

  MieGruneisenWater::Parameters printed;
  printed.S2 = 1.986;
  printed.S3 = 1.2286;
  printed.alpha = 0.0;
  sets.push_back(fluid("water-paper-mg",
                       UNDEX_PAPER ", table 4 to the letter. S2 and S3 look like misprints of Steinberg's -1.986 and 0.2268: "
                                   "at mu = 0.2 this set gives 1332 MPa where his gives 847",
                       MieGruneisenWater(printed)));

  const Jwl::Parameters petn{.rho0 = 1770.0,
                             .A = 617e9,
                             .B = 16.926e9,
                             .R1 = 4.4,
                             .R2 = 1.2,
                             .omega = 0.25,
                             .E0 = 10.1e9 / 1770.0,
                             .D = 8300.0,
                             .p_cj = 33.5e9};
  sets.push_back(fluid("petn",
                       "PETN of 1770 kg/m^3, as read in public hydrocode data; stands for the lost table 1 of " UNDEX_PAPER
                       ". Self-consistent: its own Chapman-Jouguet state is 33.51 GPa at 8301 m/s",
                       Jwl(petn)));

  sets.push_back(fluid("bubble-gas", UNDEX_PAPER ", eq. 25 and section 4.1: the explosive gas bubble in the rigid cylinder",
                       BarotropicGas({.rho0 = 1770.0, .p0 = 2e9, .gamma = 2.0})));
  sets.push_back(fluid("sjogreen-gas",
                       UNDEX_PAPER ", eq. 34, the state of the Sjogreen problem (dimensionless there); gamma 1.4 is "
                                   "the value that gives the figure of the paper",
                       BarotropicGas({.rho0 = 1.0, .p0 = 0.4, .gamma = 1.4})));
  sets.push_back(fluid("sjogreen-gas-gamma2",
                       UNDEX_PAPER ", eq. 34 with the gamma printed beside eq. 25; the exact solution then has a "
                                   "vacuum in the middle, unlike the figure",
                       BarotropicGas({.rho0 = 1.0, .p0 = 0.4, .gamma = 2.0})));
  const IdealGas::Parameters air{.rho0 = 1.204, .gamma = 1.4};
  sets.push_back(
      fluid("air", "Dry air at 20 C and 101325 Pa as an ideal gas; handbook values, recalled, not read", IdealGas(air)));
  return sets;
}

Solid solid(const char* name, const char* source, double rho0, double shear_modulus, SolidPressure pressure, FlowStress flow,
            double heat_capacity) {
  Solid s;
  s.name = name;
  s.source = source;
  s.rho0 = rho0;
  s.shear_modulus = shear_modulus;
  s.pressure = pressure;
  s.flow = flow;
  s.heat_capacity = heat_capacity;
  return s;
}

std::vector<Solid> make_solids() {
  constexpr double E_5xxx = 71e9, nu_5xxx = 0.33;
  constexpr double G_5xxx = shear_from(E_5xxx, nu_5xxx);
  const LinearPressure linear_5xxx{bulk_from(E_5xxx, nu_5xxx)};
  std::vector<Solid> sets;
  sets.push_back(solid("al-impact-table2",
                       UNDEX_PAPER ", table 2: the impact of an aluminium sphere, elastic and perfectly plastic; heat "
                                   "capacity is a handbook value, recalled, not read",
                       2710.0, 27.6e9, MieGruneisenPressure{.C = 5300.0, .S = 1.5, .Gamma = 1.7},
                       LinearHardening{.Y0 = 550e6, .H = 0.0}, 900.0));
  sets.push_back(solid("al-2024-t351",
                       "Johnson and Cook 1983, recalled, not read: the likeliest content of the lost table 3 of " UNDEX_PAPER
                       " (same shear modulus); density and Mie-Grueneisen constants of 2024 after "
                       "Steinberg's compendium, recalled, not read",
                       2785.0, 27.6e9, MieGruneisenPressure{.C = 5328.0, .S = 1.338, .Gamma = 2.0},
                       JohnsonCook{.A = 265e6, .B = 426e6, .n = 0.34, .C = 0.015, .m = 1.0, .T_melt = 775.0}, 875.0));
  sets.push_back(solid("al-6061-t6",
                       "Johnson-Cook constants and heat capacity as read in public data files; density, shear modulus "
                       "and Mie-Grueneisen constants after Steinberg's compendium, recalled, not read",
                       2703.0, 27.6e9, MieGruneisenPressure{.C = 5240.0, .S = 1.40, .Gamma = 1.97},
                       JohnsonCook{.A = 324e6, .B = 114e6, .n = 0.42, .C = 0.002, .m = 1.34, .T_melt = 925.0}, 896.0));
  JohnsonCook h116{.A = 167e6, .B = 596e6, .n = 0.551, .C = 0.001, .m = 1.0, .T_melt = 893.0};
  sets.push_back(solid("al-5083-h116",
                       "Johnson-Cook constants published for 5083-H116 plate, recalled, not read, with softening "
                       "exponent 1.0; E 71 GPa, nu 0.33. The nearest published set to the tube's 5086",
                       2700.0, G_5xxx, linear_5xxx, h116, 910.0));
  h116.m = 0.859;
  sets.push_back(solid("al-5083-h116-m0859",
                       "As al-5083-h116 with the other softening exponent in circulation, 0.859; recalled, not read", 2700.0,
                       G_5xxx, linear_5xxx, h116, 910.0));
  sets.push_back(solid("al-5086-o",
                       "Annealed 5086, the tube's likely temper. A, B, n by Considere's condition from handbook tensile "
                       "values, recalled, not read: yield 117 MPa, ultimate 262 MPa, elongation 22 % (taken as uniform): "
                       "true stress 319.6 MPa at strain 0.1989, where the slope equals the stress. C and m assumed; "
                       "E 71 GPa, nu 0.33. Built from tensile data alone, not from the tube",
                       2700.0, G_5xxx, linear_5xxx,
                       JohnsonCook{.A = 117e6, .B = 336e6, .n = 0.314, .C = 0.001, .m = 1.0, .T_melt = 893.0}, 900.0));
  sets.push_back(solid("al-5086-h116",
                       "A, B, n by Considere's condition from handbook tensile values, recalled, not read: yield 207 MPa, "
                       "ultimate 290 MPa, elongation 12 % (taken as uniform): true stress 324.8 MPa at strain 0.1133, "
                       "where the slope equals the stress. C and m assumed; E 71 GPa, nu 0.33. Built from tensile data "
                       "alone, not from the tube",
                       2700.0, G_5xxx, linear_5xxx,
                       JohnsonCook{.A = 207e6, .B = 233e6, .n = 0.312, .C = 0.001, .m = 1.0, .T_melt = 893.0}, 900.0));
  sets.push_back(solid(
      "al-5086-za",
      "Zerilli-Armstrong constants, shear modulus and Mie-Grueneisen constants of 5086 as read in a public code for this very "
      "tube; heat capacity is a handbook value, recalled, not read",
      2700.0, 26.4e9, MieGruneisenPressure{.C = 5240.0, .S = 1.49, .Gamma = 1.97},
      ZerilliArmstrong{.C0 = 234e6, .C2 = 1283e6, .C3 = 0.00371, .C4 = 0.000153}, 900.0));
  sets.push_back(solid("armco-iron", "Johnson-Cook constants, moduli and heat capacity as read in public data files", 7890.0,
                       80e9, LinearPressure{164e9},
                       JohnsonCook{.A = 175e6, .B = 380e6, .n = 0.32, .C = 0.06, .m = 0.55, .T_melt = 1811.0}, 452.0));
  sets.push_back(solid("copper-ofhc", "Johnson and Cook 1983, in part as read in public data files, in part recalled, not read",
                       8960.0, 46e9, LinearPressure{129e9},
                       JohnsonCook{.A = 90e6, .B = 292e6, .n = 0.31, .C = 0.025, .m = 1.09, .T_melt = 1356.0}, 383.0));
  sets.push_back(solid("steel-4340",
                       "Johnson and Cook 1983, 4340 steel of Rockwell C-30; E 200 GPa, nu 0.29; all recalled, not read", 7830.0,
                       shear_from(200e9, 0.29), LinearPressure{bulk_from(200e9, 0.29)},
                       JohnsonCook{.A = 792e6, .B = 510e6, .n = 0.26, .C = 0.014, .m = 1.03, .T_melt = 1793.0}, 477.0));

  const auto add_zerilli_armstrong = [&](const char* of, const ZerilliArmstrong& flow, const char* source) {
    Solid changed = *find(sets, of);
    changed.name += "-za";
    changed.source = std::string(source) + ". The rest as " + of;
    changed.flow = flow;
    sets.push_back(changed);
  };
  add_zerilli_armstrong("armco-iron", {.C0 = 65e6, .C1 = 1033e6, .C3 = 0.00698, .C4 = 0.000415, .C5 = 266e6, .n = 0.289},
                        "Zerilli and Armstrong 1987, Armco iron (body-centred), recalled, not read");
  add_zerilli_armstrong("copper-ofhc", {.C0 = 65e6, .C2 = 890e6, .C3 = 0.0028, .C4 = 0.000115},
                        "Zerilli and Armstrong 1987, OFHC copper (face-centred), recalled, not read");

  const auto add_damaged = [&](const char* of, double D1, double D2, double D3, double D4, double D5) {
    Solid changed = *find(sets, of);
    changed.name += "-damage";
    changed.source = std::string("As ") + of + " (" + changed.source +
                     "), with the damage constants of Johnson and Cook 1985, recalled, not read";
    changed.damage =
        JohnsonCookDamage{.D1 = D1, .D2 = D2, .D3 = D3, .D4 = D4, .D5 = D5, .T_melt = std::get<JohnsonCook>(changed.flow).T_melt};
    sets.push_back(changed);
  };
  add_damaged("armco-iron", -2.20, 5.43, -0.47, 0.016, 0.63);
  add_damaged("copper-ofhc", 0.54, 4.89, -3.03, 0.014, 1.12);
  add_damaged("steel-4340", 0.05, 3.44, -2.12, 0.002, 0.61);
  return sets;
}

#undef UNDEX_PAPER

const std::vector<Fluid>& fluids() {
  static const std::vector<Fluid> sets = make_fluids();
  return sets;
}

const std::vector<Solid>& solids() {
  static const std::vector<Solid> sets = make_solids();
  return sets;
}

template <class Set>
std::vector<std::string> names(const std::vector<Set>& sets) {
  std::vector<std::string> all;
  for (const Set& set : sets) all.push_back(set.name);
  return all;
}

using Table = std::vector<std::pair<std::string, double>>;

/// The numbers of a record that count, each under the name that it has in a scene file.
template <class Record>
void append(Table& table, const std::string& prefix, const Record& record) {
  for_each_field(record, [&](const auto& value, const Key& key) {
    if constexpr (std::is_same_v<decltype(value), const double&>)
      if (key.used) table.emplace_back(prefix + key.name + " [" + (*key.unit ? key.unit : "-") + "]", value);
  });
}

}  // namespace

std::optional<Fluid> find_fluid(std::string_view name) { return find(fluids(), name); }
std::optional<Solid> find_solid(std::string_view name) { return find(solids(), name); }
std::vector<std::string> fluid_names() { return names(fluids()); }
std::vector<std::string> solid_names() { return names(solids()); }

std::vector<std::pair<std::string, double>> parameters(const Fluid& fluid) {
  Table table;
  std::visit([&](const auto& law) { append(table, "", law.parameters()); }, fluid.law);
  return table;
}

std::vector<std::pair<std::string, double>> parameters(const Solid& solid) {
  Table table;
  append(table, "", solid);
  std::visit([&](const auto& law) { append(table, "pressure.", law); }, solid.pressure);
  std::visit([&](const auto& law) { append(table, "flow.", law); }, solid.flow);
  if (solid.spall) append(table, "spall.", *solid.spall);
  if (solid.damage) append(table, "damage.", *solid.damage);
  return table;
}

}  // namespace undex::materials
