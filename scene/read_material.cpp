// Materials: a name of the scene's [materials] or of the library, or a table {law = ..., parameters} or
// {base = "name", changed parameters}.
#include <cmath>
#include <stdexcept>

#include "materials/jwl_isentrope.hpp"
#include "materials/pedigree.hpp"
#include "scene/alternatives.hpp"
#include "scene/draft.hpp"
#include "scene/numbers.hpp"
#include "scene/plausible.hpp"
#include "scene/record_reader.hpp"
#include "scene/suggestion.hpp"
#include "scene/usual_units.hpp"

namespace undex::scene {
namespace {

using namespace materials;

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
  const std::string near = nearest(name, known);
  const std::string remedy = other_kind     ? "; take one that is"
                             : near.empty() ? "; the names most like it: " + listed(nearest_few(name, known))
                                            : "; did you mean '" + near + "'?";
  report.add(node, path + ": " + (other_kind ? "'" + name + "' is " + other_kind : "unknown material '" + name + "'") + remedy +
                       " ('undex materials' lists them)");
}

/// Warns of a set of the library that is not to be relied on.
void warn_of_grade(const Node& at, const std::string& path, const std::string& name, Report& warnings) {
  const std::optional<Pedigree> pedigree = find_pedigree(name);
  if (pedigree && pedigree->grade == "D")
    warnings.add(at, path + ": '" + name + "' is of grade D, without a reference or contradicting itself (" + pedigree->checked +
                         "); take another set, or a better source");
}

void warn_of_set(const Node& at, const std::string& path, const Fluid& fluid, Report& warnings) {
  warn_of_grade(at, path, fluid.name, warnings);
  const auto* products = std::get_if<Jwl>(&fluid.law);
  const std::optional<Pedigree> pedigree = find_pedigree(fluid.name);
  if (!products || !pedigree) return;
  const ChapmanJouguet own = chapman_jouguet(*products);
  if (!is_verified(*pedigree, own))
    warnings.add(at, path + ": '" + fluid.name +
                         "' is unverified: its source lists another detonation speed or pressure than the " + "set's own " +
                         rounded(own.detonation_speed) + " m/s and " + rounded(own.pressure * 1e-9) +
                         " GPa; take another set, or compare with a second source");
}

const char* const all_of_a_law = "a law without 'base' needs all its parameters";

/// What of a law's parameters the table leaves to the others; false where that cannot be.
template <class Parameters>
bool fill_in(const TableReader&, bool, Parameters&) {
  return true;
}

bool fill_in(const TableReader& table, bool based, Jwl::Parameters& p) {
  const std::size_t before = table.report().size();
  std::optional<double> C;
  table.read("C", C);
  if (C && table.has("E0")) table.complain("C", table.path_of("C") + " stands in place of E0; leave out one of them");
  if (!C && !table.has("E0") && !based)
    table.complain("E0", table.path() + " needs E0, the detonation energy per mass, or C of its isentrope in its place");
  if (table.report().size() != before) return false;
  try {
    materials::fill_in(p, C);
    if (C && !explosive_energy.holds(p.E0))
      table.complain("C", table.path_of("C") + " = " + shortest(*C) + " [Pa] makes a detonation energy of " + rounded(p.E0) +
                              " J/kg, which no explosive has; is it in Pa?");
    return table.report().size() == before;
  } catch (const std::domain_error& none) {
    table.complain("C", table.path() + ": " + none.what() + ": such products do not detonate; check the set, or give D and p_cj");
    return false;
  }
}

/// Makes the law anew from the parameters that the table names, and from those of the base or the law's own for the rest.
template <class Law>
bool rebuild(const TableReader& table, bool based, Draft& draft, Fluid& into) {
  typename Law::Parameters parameters{};
  if (based) parameters = std::get<Law>(into.law).parameters();
  const std::size_t before = table.report().size();
  read_fields(table, parameters, !based, all_of_a_law);
  if (table.report().size() == before) expect_usual_units(table, parameters);
  if (table.report().size() != before || !fill_in(table, based, parameters)) return false;
  try {
    into.law = Law(parameters);
    expect_plausible(table, into.law, draft.warnings);
    if (table.report().size() != before) return false;
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
    warn_of_set(at, path, into, draft.warnings);
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
  using Laws = Alternatives<FluidLaw>;
  if (!base && !law) {
    report.add(node, path + " needs 'law' or 'base'; law = one of " + listed(Laws::names()));
    return false;
  }
  const std::string base_law = name_of(into.law);
  if (law && !is_alternative(*law, path + ".law", Laws::names(), report)) return false;
  const std::string name = law ? law->text : base_law;
  if (base && name != base_law) {
    report.add(*law, path + ".law = \"" + name + "\", but the base '" + into.name + "' is of law \"" + base_law +
                         "\"; leave out one of them");
    return false;
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
  Laws::with(name, [&]<class Law>(std::type_identity<Law>) { good = rebuild<Law>(table, base, draft, into); });
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
    warn_of_grade(at, path, name, draft.warnings);
    return true;
  }
  unknown_material(at, path, name, find_fluid(name) ? "a fluid, not a solid" : nullptr, with_own(solid_names(), draft),
                   draft.report);
  return false;
}

/// A sub-table {law = ..., parameters} of a variant of laws; without a law the present alternative is changed.
template <class Variant>
void read_law(const TableReader& solid, const char* key, Variant& into) {
  using Laws = Alternatives<Variant>;
  const Node* node = solid.table(key);
  if (!node) return;
  const std::string path = solid.path_of(key);
  const Node* law = node->find("law");
  bool fresh = !solid.has("base");  // then all parameters have to be there
  if (fresh && !law) {
    solid.report().add(*node, path + ".law is missing; one of " + listed(Laws::names()));
    return;
  }
  if (law) {
    if (!is_alternative(*law, path + ".law", Laws::names(), solid.report())) return;
    Laws::with(law->text, [&]<class Law>(std::type_identity<Law>) {
      if (std::holds_alternative<Law>(into)) return;
      into = Law{};
      fresh = true;
    });
  }
  const TableReader table(*node, path, std::string(key) + '.' + name_of(into), solid.dimension(), solid.report());
  std::visit([&](auto& each) { read_fields(table, each, fresh, all_of_a_law); }, into);
}

void read_spall(const TableReader& solid, Solid& into) {
  const Node* node = solid.table("spall");
  if (!node) return;
  const TableReader table(*node, solid.path_of("spall"), "spall", solid.dimension(), solid.report());
  const bool fresh = !into.spall;
  if (fresh) into.spall.emplace();
  read_fields(table, *into.spall, fresh);
}

/// Melting point, reference rate and room temperature are those of a Johnson-Cook flow stress unless named here.
void read_damage(const TableReader& solid, Solid& into) {
  const Node* node = solid.table("damage");
  if (!node) return;
  const TableReader table(*node, solid.path_of("damage"), "damage", solid.dimension(), solid.report());
  const bool fresh = !into.damage;
  if (fresh) {
    into.damage.emplace();
    if (const auto* flow = std::get_if<JohnsonCook>(&into.flow)) {
      into.damage->T_melt = flow->T_melt;
      into.damage->rate0 = flow->rate0;
      into.damage->T_room = flow->T_room;
    } else {
      table.need("T_melt", "give the melting temperature in K: only a flow stress of law \"johnson_cook\" brings one");
    }
  }
  read_fields(table, *into.damage, fresh);
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
  const auto check_start = [&](const char* key, double T_melt) {
    if (of.T_room < T_melt) return;
    solid.complain(solid.has("T_room") ? "T_room" : key,
                   solid.path_of("T_room") + " = " + shortest(of.T_room) +
                       " [K], the temperature at the start, must lie below the melting point, " + key +
                       ".T_melt = " + shortest(T_melt) + " [K]: the solid would be molten");
  };
  if (const auto* flow = std::get_if<JohnsonCook>(&of.flow)) check_start("flow", flow->T_melt);
  if (!of.damage) return;
  check_start("damage", of.damage->T_melt);
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

/// What no base brings has to be there, in one spelling or the other.
void need_elasticity(const TableReader& table) {
  if (table.has("young_modulus")) return;
  if (!table.has("shear_modulus")) table.need("young_modulus", "give it with poisson_ratio, or give shear_modulus and pressure");
  table.need("pressure", "e.g. pressure = {law = \"linear\", bulk_modulus = 70e9}");
}

/// Young's modulus E and Poisson's ratio nu in place of shear and bulk modulus: G = E/(2 (1 + nu)), K = E/(3 (1 - 2 nu)).
void read_young(const TableReader& table, Solid& into) {
  if (table.has("young_modulus") != table.has("poisson_ratio")) {
    table.need("young_modulus", "poisson_ratio and young_modulus go together");
    table.need("poisson_ratio", "young_modulus and poisson_ratio go together");
    return;
  }
  if (!table.has("young_modulus")) return;
  if (table.has("shear_modulus"))
    table.complain("shear_modulus",
                   table.path_of("shear_modulus") + " follows from young_modulus and poisson_ratio; leave it out");
  double E = 0, nu = 0;
  if (!(table.read("young_modulus", E) & table.read("poisson_ratio", nu))) return;
  into.shear_modulus = E / (2 * (1 + nu));
  if (!table.has("pressure")) into.pressure = LinearPressure{E / (3 * (1 - 2 * nu))};
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
    need_elasticity(table);
  }
  read_fields(table, into, !table.has("base"));
  read_young(table, into);
  read_law(table, "pressure", into.pressure);
  read_law(table, "flow", into.flow);
  read_spall(table, into);
  read_damage(table, into);
  if (report.size() == before) check_together(table, into);
  if (report.size() == before) expect_plausible(table, into, draft.warnings);
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
      draft.warnings.add(entry, path + " hides the library's material of that name; another one would be clearer");
    Fluid fluid;
    Solid solid{};
    if (looks_solid(entry.node, draft, 0)) read_solid_at(entry.node, path, draft, 0, solid);
    else read_fluid_at(entry.node, path, draft, 0, fluid);
  }
}

}  // namespace undex::scene
