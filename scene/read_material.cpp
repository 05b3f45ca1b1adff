// Materials: a name of the scene's [materials] or of the library, or a table {law = ..., parameters} or
// {base = "name", changed parameters}.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "scene/draft.hpp"
#include "scene/material_fields.hpp"
#include "scene/numbers.hpp"
#include "scene/suggestion.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {
namespace {

using namespace materials;

const std::vector<std::string> fluid_laws{"tait", "barotropic_gas", "ideal_gas", "stiffened_gas", "jwl", "mie_gruneisen"};
constexpr int deepest_base = 8;

std::vector<std::string> with_own(std::vector<std::string> names, const Draft& draft) {
  if (const Node* own = draft.root.find("materials"))
    for (const Entry& entry : own->entries) names.push_back(entry.key);
  return names;
}

const Node* own_material(const Draft& draft, const std::string& name) {
  const Node* own = draft.root.find("materials");
  return own && own->kind == Node::Kind::table ? own->find(name) : nullptr;
}

void unknown_material(const Node& node, const std::string& path, const std::string& name, const char* other_kind,
                      const std::vector<std::string>& known, Report& report) {
  report.add(node, other_kind ? path + ": '" + name + "' is " + other_kind + "; known here: " + listed(known)
                              : path + ": unknown material '" + name + "'" + suggestion(name, known) +
                                    " ('undex materials' lists them)");
}

/// Reads the fields of a law; without a base those in `needed` have to be there.
template <class Parameters>
void read_fields(const TableReader& table, Parameters& parameters, bool all_needed) {
  each_field(parameters, [&](const char* key, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Cavitation>) {
      table.read_choice<Cavitation>(key, value,
                                    {{"none", Cavitation::none},
                                     {"cutoff", Cavitation::cutoff},
                                     {"schmidt", Cavitation::schmidt},
                                     {"isentropic", Cavitation::isentropic}});
    } else {
      if (all_needed && !has_default(parameters, key) && !table.need(key, "a law without 'base' needs all its parameters"))
        return;
      table.read(key, value);
    }
  });
}

template <class Law>
bool rebuild(const TableReader& table, typename Law::Parameters parameters, bool all_needed, Fluid& into) {
  const std::size_t before = table.report().size();
  read_fields(table, parameters, all_needed);
  if (table.report().size() != before) return false;
  try {
    into.law = Law(parameters);
  } catch (const std::exception& error) {
    table.report().add(table.node(), table.path() + ": " + error.what());
    return false;
  }
  into.rho0 = parameters.rho0;
  return true;
}

bool read_fluid_at(const Node& node, const std::string& path, Draft& draft, int depth, Fluid& into);

bool fluid_by_name(const Node& at, const std::string& path, const std::string& name, Draft& draft, int depth, Fluid& into) {
  if (depth > deepest_base) {
    draft.report.add(at, path + ": the materials are based on each other in a circle; base one of them on the library");
    return false;
  }
  if (const Node* own = own_material(draft, name)) {
    const bool good = read_fluid_at(*own, "materials." + name, draft, depth + 1, into);
    if (good && !own->find("name")) into.name = name;
    return good;
  }
  if (const auto found = find_fluid(name)) {
    into = *found;
    return true;
  }
  unknown_material(at, path, name, find_solid(name) ? "a solid, not a fluid" : nullptr, with_own(fluid_names(), draft),
                   draft.report);
  return false;
}

bool read_fluid_at(const Node& node, const std::string& path, Draft& draft, int depth, Fluid& into) {
  Report& report = draft.report;
  if (node.kind == Node::Kind::text) return fluid_by_name(node, path, node.text, draft, depth, into);
  if (node.kind != Node::Kind::table) {
    report.add(node, path + " must be a material's name or a table, not " + node.described());
    return false;
  }
  const Node* base = node.find("base");
  const Node* law = node.find("law");
  if (base) {
    if (base->kind != Node::Kind::text) {
      report.add(*base, path + ".base must be a material's name in quotes, not " + base->described());
      return false;
    }
    if (!fluid_by_name(*base, path + ".base", base->text, draft, depth + 1, into)) return false;
  }
  if (!base && !law) {
    report.add(node, path + " needs 'law' or 'base'; law = one of " + listed(fluid_laws));
    return false;
  }
  const std::string base_law = std::visit([](const auto& each) { return std::string(law_name(each)); }, into.law);
  std::string name = base_law;
  if (law) {
    if (law->kind != Node::Kind::text || std::find(fluid_laws.begin(), fluid_laws.end(), law->text) == fluid_laws.end()) {
      report.add(*law, path + ".law must be one of " + listed(fluid_laws) + ", not " + law->described() +
                           (nearest(law->text, fluid_laws).empty() ? "" : suggestion(law->text, fluid_laws)));
      return false;
    }
    name = law->text;
    if (base && name != base_law) {
      report.add(*law, path + ".law = \"" + name + "\", but the base '" + into.name + "' is of law \"" + base_law +
                           "\"; leave out one of them");
      return false;
    }
  }
  const std::size_t before = report.size();
  const TableReader table(node, path, "material." + name, draft.scene.fluid.dimension, report);
  if (base) {
    into.name += "-changed";
    into.source += "; changed in the scene file";
  } else {
    into.name = name;
    into.source = "the scene file";
  }
  table.read("name", into.name);
  table.read("source", into.source);
  bool good = true;
  const auto parameters_of = [&]<class Law>(typename Law::Parameters otherwise) {
    const Law* known = base ? std::get_if<Law>(&into.law) : nullptr;
    return known ? known->parameters() : otherwise;
  };
  if (name == "tait") good = rebuild<TaitWater>(table, parameters_of.operator()<TaitWater>({}), false, into);
  else if (name == "mie_gruneisen")
    good = rebuild<MieGruneisenWater>(table, parameters_of.operator()<MieGruneisenWater>({}), false, into);
  else if (name == "barotropic_gas")
    good = rebuild<BarotropicGas>(table, parameters_of.operator()<BarotropicGas>({}), !base, into);
  else if (name == "ideal_gas") good = rebuild<IdealGas>(table, parameters_of.operator()<IdealGas>({}), !base, into);
  else if (name == "stiffened_gas") good = rebuild<StiffenedGas>(table, parameters_of.operator()<StiffenedGas>({}), !base, into);
  else good = rebuild<Jwl>(table, parameters_of.operator()<Jwl>({}), !base, into);
  return good && report.size() == before;
}

bool read_solid_at(const Node& node, const std::string& path, Draft& draft, int depth, Solid& into);

bool solid_by_name(const Node& at, const std::string& path, const std::string& name, Draft& draft, int depth, Solid& into) {
  if (depth > deepest_base) {
    draft.report.add(at, path + ": the materials are based on each other in a circle; base one of them on the library");
    return false;
  }
  if (const Node* own = own_material(draft, name)) {
    const bool good = read_solid_at(*own, "materials." + name, draft, depth + 1, into);
    if (good && !own->find("name")) into.name = name;
    return good;
  }
  if (const auto found = find_solid(name)) {
    into = *found;
    return true;
  }
  unknown_material(at, path, name, find_fluid(name) ? "a fluid, not a solid" : nullptr, with_own(solid_names(), draft),
                   draft.report);
  return false;
}

/// A sub-table {law = ..., parameters} of a variant of laws; without a law the present alternative is changed.
template <class Variant, class... Laws>
void read_law(const TableReader& solid, const char* key, const char* section_prefix, Variant& into,
              std::type_identity<std::variant<Laws...>>) {
  const Node* node = solid.table(key);
  if (!node) return;
  Report& report = solid.report();
  const std::string path = solid.path_of(key);
  const std::vector<std::string> names{law_name(Laws{})...};
  bool fresh = !solid.has("base");  // then all parameters have to be there
  if (fresh && !node->find("law")) {
    report.add(*node, path + ".law is missing; one of " + listed(names));
    return;
  }
  if (const Node* law = node->find("law")) {
    if (law->kind != Node::Kind::text || std::find(names.begin(), names.end(), law->text) == names.end()) {
      report.add(*law, path + ".law must be one of " + listed(names) + ", not " + law->described() +
                           (nearest(law->text, names).empty() ? "" : suggestion(law->text, names)));
      return;
    }
    const auto take = [&]<class Law>(Law empty) {
      if (law->text != law_name(empty) || std::holds_alternative<Law>(into)) return;
      into = empty;
      fresh = true;
    };
    (take(Laws{}), ...);
  }
  std::visit(
      [&](auto& law) {
        const TableReader table(*node, path, section_prefix + std::string(law_name(law)), solid.dimension(), report);
        read_fields(table, law, fresh);
      },
      into);
}

void read_spall(const TableReader& solid, Solid& into) {
  const Node* node = solid.table("spall");
  if (!node) return;
  const TableReader table(*node, solid.path_of("spall"), "spall", solid.dimension(), solid.report());
  if (!into.spall) {
    into.spall.emplace();
    table.need("strength", "give the tension in Pa at which the material parts, e.g. strength = 1e9");
  }
  table.read("strength", into.spall->strength);
  table.read_choice<Spall::Mode>("mode", into.spall->mode, {{"cutoff", Spall::Mode::cutoff}, {"fail", Spall::Mode::fail}});
}

/// Melting point, reference rate and room temperature are those of a Johnson-Cook flow stress unless named here.
void read_damage(const TableReader& solid, Solid& into) {
  const Node* node = solid.table("damage");
  if (!node) return;
  const TableReader table(*node, solid.path_of("damage"), "damage", solid.dimension(), solid.report());
  if (!into.damage) {
    into.damage.emplace();
    for (const char* key : {"D1", "D2", "D3", "D4", "D5"})
      table.need(key, "Johnson and Cook's fracture strain needs D1 to D5; write 0 for a term that it does not have");
    if (const auto* flow = std::get_if<JohnsonCook>(&into.flow)) {
      into.damage->T_melt = flow->T_melt;
      into.damage->rate0 = flow->rate0;
      into.damage->T_room = flow->T_room;
    } else {
      table.need("T_melt", "give the melting temperature in K: only a flow stress of law \"johnson_cook\" brings one");
    }
  }
  read_fields(table, *into.damage, false);
}

/// What is in range by itself but not together.
void check_together(const TableReader& solid, const Solid& of) {
  const auto check_melting = [&](const char* key, double T_melt, double T_room) {
    if (T_melt > T_room) return;
    solid.complain(key, solid.path_of(key) + ".T_melt = " + shortest(T_melt) +
                            " [K] must be greater than its T_room = " + shortest(T_room) + " [K]");
  };
  if (const auto* flow = std::get_if<JohnsonCook>(&of.flow)) check_melting("flow", flow->T_melt, flow->T_room);
  if (const auto* flow = std::get_if<ZerilliArmstrong>(&of.flow); flow && flow->C0 + flow->C1 <= 0)
    solid.complain("flow", solid.path_of("flow") +
                               ".C0 and C1 are both 0: nothing would resist the first strain; one of "
                               "them must be greater than 0");
  if (!of.damage) return;
  check_melting("damage", of.damage->T_melt, of.damage->T_room);
  const double least = of.damage->D1 + of.damage->D2 * std::exp(1.5 * of.damage->D3);
  if (least <= 0)
    solid.complain("damage", solid.path_of("damage") + ": D1 + D2 exp(1.5 D3) = " + shortest(least) +
                                 " must be greater than 0: it is the fracture strain in the highest tension that counts");
}

/// Does an own material describe a solid? Told by its keys or by what it is based on.
bool looks_solid(const Node& node, const Draft& draft, int depth) {
  for (const char* key :
       {"flow", "shear_modulus", "young_modulus", "pressure", "heat_capacity", "taylor_quinney", "spall", "damage"})
    if (node.find(key)) return true;
  const Node* base = node.kind == Node::Kind::text ? &node : node.find("base");
  if (!base || base->kind != Node::Kind::text || depth > deepest_base) return false;
  if (const Node* own = own_material(draft, base->text)) return looks_solid(*own, draft, depth + 1);
  return find_solid(base->text).has_value();
}

bool read_solid_at(const Node& node, const std::string& path, Draft& draft, int depth, Solid& into) {
  Report& report = draft.report;
  if (node.kind == Node::Kind::text) return solid_by_name(node, path, node.text, draft, depth, into);
  if (node.kind != Node::Kind::table) {
    report.add(node, path + " must be a material's name or a table, not " + node.described());
    return false;
  }
  const std::size_t before = report.size();
  const TableReader table(node, path, "material.solid", draft.scene.fluid.dimension, report);
  if (const Node* base = table.find("base")) {
    std::string name;
    if (!table.read("base", name) || !solid_by_name(*base, path + ".base", name, draft, depth + 1, into)) return false;
    into.name += "-changed";
    into.source += "; changed in the scene file";
  } else {
    into = Solid{};
    into.name = "solid";
    into.source = "the scene file";
    into.flow = Elastic{};
    table.need("rho0", "give the density in kg/m^3");
    if (!table.has("young_modulus") && !table.has("shear_modulus"))
      report.add(node, path + ".young_modulus is missing; give it with poisson_ratio, or give shear_modulus and pressure");
    if (!table.has("young_modulus") && !table.has("pressure"))
      report.add(node, path + ".pressure is missing; e.g. pressure = {law = \"linear\", bulk_modulus = 70e9}");
    table.need("flow", "e.g. flow = {law = \"elastic\"}");
  }
  table.read("name", into.name);
  table.read("source", into.source);
  table.read("rho0", into.rho0);
  if (table.has("young_modulus") != table.has("poisson_ratio")) {
    table.need("young_modulus", "poisson_ratio and young_modulus go together");
    table.need("poisson_ratio", "young_modulus and poisson_ratio go together");
  } else if (table.has("young_modulus")) {
    if (table.has("shear_modulus"))
      table.complain("shear_modulus", path + ".shear_modulus follows from young_modulus and poisson_ratio; leave it out");
    double E = 0, nu = 0;
    if (table.read("young_modulus", E) & table.read("poisson_ratio", nu)) {
      into.shear_modulus = E / (2 * (1 + nu));
      if (!table.has("pressure")) into.pressure = LinearPressure{E / (3 * (1 - 2 * nu))};
    }
  } else {
    table.read("shear_modulus", into.shear_modulus);
  }
  read_law(table, "pressure", "pressure.", into.pressure, std::type_identity<SolidPressure>{});
  read_law(table, "flow", "flow.", into.flow, std::type_identity<FlowStress>{});
  read_spall(table, into);
  read_damage(table, into);
  table.read("heat_capacity", into.heat_capacity);
  table.read("taylor_quinney", into.taylor_quinney);
  table.read("T_room", into.T_room);
  if (report.size() == before) check_together(table, into);
  return report.size() == before;
}

}  // namespace

bool read_fluid_material(const Node& node, const std::string& path, Draft& draft, Fluid& into) {
  return read_fluid_at(node, path, draft, 0, into);
}
bool read_solid_material(const Node& node, const std::string& path, Draft& draft, Solid& into) {
  return read_solid_at(node, path, draft, 0, into);
}

// Also those that nobody uses, so that their mistakes are found; what is found twice is reported once.
void read_own_materials(Draft& draft) {
  const Node* own = draft.root.find("materials");
  if (!own) return;
  if (own->kind != Node::Kind::table) {
    draft.report.add(*own, "materials must be tables, [materials.my-water], not " + own->described());
    return;
  }
  for (const Entry& entry : own->entries) {
    const std::string path = "materials." + entry.key;
    if (find_fluid(entry.key) || find_solid(entry.key))
      draft.report.add(entry, path + ": the library has a material of that name; choose another one");
    Fluid fluid{"", "", TaitWater({}), 0};
    Solid solid{};
    if (looks_solid(entry.node, draft, 0)) read_solid_at(entry.node, path, draft, 0, solid);
    else read_fluid_at(entry.node, path, draft, 0, fluid);
  }
}

}  // namespace undex::scene
