#include "scene/schema.hpp"

#include <cassert>

#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

constexpr double farthest = 1e5;  // [m]
constexpr double endless = 1e30;

Key word(std::string name) { return {std::move(name), "", -endless, endless, false}; }
Key any(std::string name, std::string unit) { return {std::move(name), std::move(unit), -endless, endless, false}; }
Key position(std::string name) { return {std::move(name), "m", -farthest, farthest, false}; }
Key length(std::string name) { return {std::move(name), "m", 0, farthest, true}; }
Key positive(std::string name, std::string unit) { return {std::move(name), std::move(unit), 0, endless, true}; }
Key at_least_zero(std::string name, std::string unit) { return {std::move(name), std::move(unit), 0, endless, false}; }
Key between(std::string name, double low, double high, std::string unit = "") {
  return {std::move(name), std::move(unit), low, high, false};
}
Key above(std::string name, double low, double high, std::string unit = "") {
  return {std::move(name), std::move(unit), low, high, true};
}

std::vector<Section> make_schema() {
  const Key speed = any("velocity", "m/s");
  return {
      {"",
       {word("name"),
        word("title"),
        between("dimension", 1, 3),
        above("end_time", 0, 1e3, "s"),
        between("threads", 0, 4096),
        any("gravity", "m/s^2"),
        word("resolution"),
        word("symmetry"),
        word("scheme"),
        word("start"),
        word("materials"),
        word("bodies"),
        word("walls"),
        word("structure"),
        word("solids"),
        word("solid_scheme"),
        word("planes"),
        word("coupling"),
        word("probes"),
        word("output"),
        word("comparison")}},
      {"resolution",
       {length("spacing"), word("lattice"), word("fit"), position("origin"), any("rotation", "deg"), between("jitter", 0, 0.5)}},
      {"symmetry", {word("planes")}},
      {"scheme",
       {word("name"), word("kernel"), word("precision"), between("eta", 0.8, 3), between("alpha", 0, 100),
        between("beta", 0, 1000), between("alpha_min", 0, 100), word("integrator"), above("courant", 0, 2),
        above("fixed_step", 0, 1, "s"), word("local_steps"), between("signal", 0, 0.1), between("h_low", 0.1, 1),
        between("h_high", 1, 20)}},

      {"start",
       {word("kind"), word("body"), above("time", 0, 1e3, "s"), word("axis"), word("towards"), position("front"),
        positive("peak", "Pa"), above("decay", 0, 1e3, "s")}},
      {"bodies",
       {word("name"), word("shape"), word("subtract"), word("material"), length("spacing"), speed, any("radial_velocity", "m/s"),
        any("pressure", "Pa"), position("level"), positive("density", "kg/m^3"), any("energy", "J/kg"), word("burn"),
        word("variable_h")}},
      {"burn",
       {word("model"), position("initiation"), positive("speed", "m/s"), between("width", 0, farthest, "m"),
        between("cj_compression", 0, 5)}},
      {"shape.box", {word("type"), position("low"), position("high")}},
      {"shape.slab", {word("type"), word("axis"), position("low"), position("high")}},
      {"shape.sphere", {word("type"), position("center"), length("radius")}},
      {"shape.cylinder", {word("type"), word("axis"), position("center"), length("radius"), position("low"), position("high")}},
      {"shape.tube",
       {word("type"), word("axis"), position("center"), length("inner_radius"), length("outer_radius"), position("low"),
        position("high")}},
      {"walls", {word("name"), word("shape"), word("condition"), word("faces")}},
      {"faces.box", {word("x_low"), word("x_high"), word("y_low"), word("y_high"), word("z_low"), word("z_high")}},
      {"faces.cylinder", {word("side"), word("low"), word("high")}},

      {"material.tait",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), positive("B", "Pa"),
        above("N", 1, 100), any("A", "Pa"), word("cavitation"), above("density_ratio", 0, 1), positive("vapour_sound", "m/s"),
        positive("liquid_sound", "m/s"), positive("p_sat", "Pa"), any("p_floor", "Pa"), above("vapour_gamma", 1, 100),
        above("initial_void", 0, 1)}},
      {"material.barotropic_gas",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), positive("p0", "Pa"),
        above("gamma", 1, 100)}},
      {"material.ideal_gas",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), above("gamma", 1, 100)}},
      {"material.stiffened_gas",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), above("gamma", 1, 100),
        at_least_zero("p_inf", "Pa")}},
      {"material.jwl",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), any("A", "Pa"), any("B", "Pa"),
        positive("R1", ""), positive("R2", ""), positive("omega", ""), positive("E0", "J/kg"), positive("D", "m/s"),
        positive("p_cj", "Pa")}},
      {"material.mie_gruneisen",
       {word("base"), word("name"), word("source"), word("law"), positive("rho0", "kg/m^3"), positive("C0", "m/s"), any("S1", ""),
        any("S2", ""), any("S3", ""), any("gamma0", ""), any("alpha", ""), word("cavitation"), any("p_floor", "Pa")}},
      {"material.solid",
       {word("base"), word("name"), word("source"), positive("rho0", "kg/m^3"), positive("young_modulus", "Pa"),
        above("poisson_ratio", -1, 0.4999), positive("shear_modulus", "Pa"), word("pressure"), word("flow"), word("spall"),
        word("damage"), positive("heat_capacity", "J/kg/K"), between("taylor_quinney", 0, 1), above("T_room", 0, 1e4, "K")}},
      {"pressure.linear", {word("law"), positive("bulk_modulus", "Pa")}},
      {"pressure.mie_gruneisen", {word("law"), positive("C", "m/s"), at_least_zero("S", ""), at_least_zero("Gamma", "")}},
      {"flow.elastic", {word("law")}},
      {"flow.linear_hardening", {word("law"), positive("Y0", "Pa"), at_least_zero("H", "Pa")}},
      {"flow.johnson_cook",
       {word("law"), positive("A", "Pa"), at_least_zero("B", "Pa"), above("n", 0, 10), at_least_zero("C", ""), positive("m", ""),
        positive("T_melt", "K"), positive("rate0", "1/s"), above("T_room", 0, 1e4, "K")}},
      {"flow.power_hardening", {word("law"), positive("A", "Pa"), at_least_zero("B", "Pa"), above("n", 0, 10)}},
      {"flow.cowper_symonds",
       {word("law"), positive("Y0", "Pa"), at_least_zero("H", "Pa"), positive("D", "1/s"), above("q", 0, 100)}},
      {"flow.zerilli_armstrong",
       {word("law"), at_least_zero("C0", "Pa"), at_least_zero("C1", "Pa"), at_least_zero("C2", "Pa"), at_least_zero("C3", "1/K"),
        at_least_zero("C4", "1/K"), at_least_zero("C5", "Pa"), above("n", 0, 10), positive("rate0", "1/s")}},
      {"spall", {positive("strength", "Pa"), word("mode")}},
      {"damage",
       {any("D1", ""), at_least_zero("D2", ""), between("D3", -100, 0), any("D4", ""), any("D5", ""), positive("T_melt", "K"),
        positive("rate0", "1/s"), above("T_room", 0, 1e4, "K")}},

      {"structure",
       {word("name"), word("shape"), word("cells"), length("cell_size"), word("element"), between("points_through", 2, 10),
        word("material"), word("supports"), word("wet"), word("loads"), speed, above("courant", 0, 1),
        between("linear_viscosity", 0, 10), between("quadratic_viscosity", 0, 100)}},
      {"structure.tube",
       {word("type"), word("axis"), position("center"), length("inner_radius"), length("outer_radius"), position("low"),
        position("high")}},
      {"structure.plate", {word("type"), position("low"), position("high")}},
      {"structure.rod", {word("type"), word("axis"), position("center"), length("radius"), position("low"), position("high")}},
      {"structure.gmsh", {word("type"), word("path")}},
      {"cells.tube", {between("through", 1, 1000), between("around", 8, 100000), between("along", 1, 100000)}},
      {"cells.rod", {between("radial", 2, 1000), between("along", 1, 100000)}},
      {"cells.plate", {between("x", 1, 100000), between("y", 1, 100000), between("z", 1, 100000)}},
      {"supports", {word("face"), word("fixed")}},
      {"loads", {word("face"), any("time", "s"), any("pressure", "Pa")}},
      {"solids",
       {word("name"), word("shape"), word("subtract"), word("material"), word("description"), length("spacing"), word("lattice"),
        speed, any("spin", "rad/s"), any("residual_stress", "Pa"), word("wet")}},
      {"solid_scheme",
       {between("eta", 0.8, 3), above("courant", 0, 1), between("linear_viscosity", 0, 10),
        between("quadratic_viscosity", 0, 100), between("hourglass", 0, 10), between("alpha", 0, 100), between("beta", 0, 1000),
        between("artificial_stress", 0, 1)}},
      {"planes", {word("axis"), position("position"), word("free_side")}},
      {"coupling", {word("slip"), between("window", 0.01, 100), word("solids")}},

      {"probes", {word("name"), word("kind"), position("point"), word("quantities")}},
      {"output",
       {between("history_interval", 0, 1e3, "s"), between("field_interval", 0, 1e3, "s"), between("field_times", 0, 1e3, "s"),
        word("particle_fields"), word("structure_fields"), word("solid_fields")}},
      {"comparison", {word("kind"), word("probe"), word("reference"), word("solution"), position("window"), length("core")}},
  };
}

}  // namespace

const Key* Section::find(std::string_view key) const {
  for (const Key& each : keys)
    if (each.name == key) return &each;
  return nullptr;
}

std::vector<std::string> Section::key_names() const {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

const std::vector<Section>& schema() {
  static const std::vector<Section> sections = make_schema();
  return sections;
}

const std::vector<Section>& study_schema() {
  static const std::vector<Section> sections{
      {"study",
       {word("title"), word("scene"), word("scenes"), word("output"), word("settings"), word("axes"), word("exclude"),
        word("resolution"), word("errors"), between("repeats", 1, 100), between("threads", 1, 4096),
        above("cpu_limit", 0, 1e8, "s"), above("wall_limit", 0, 1e8, "s")}},
      {"study.axes", {word("name"), word("key"), word("values"), word("labels"), word("variants"), word("problem")}},
      {"study.errors", {word("metric"), word("source"), word("label")}},
  };
  return sections;
}

const Section& section(std::string_view name) {
  for (const std::vector<Section>* sections : {&schema(), &study_schema()})
    for (const Section& each : *sections)
      if (each.name == name) return each;
  assert(!"no such section in the schema");
  return schema().front();
}

std::string range_in_words(const Key& key) {
  const bool low = key.low > -endless, high = key.high < endless;
  if (low && high && key.above_low) return "greater than " + shortest(key.low) + " and at most " + shortest(key.high);
  if (low && high) return "from " + shortest(key.low) + " to " + shortest(key.high);
  if (low) return (key.above_low ? "greater than " : "at least ") + shortest(key.low);
  return "a finite number";
}

}  // namespace undex::scene
