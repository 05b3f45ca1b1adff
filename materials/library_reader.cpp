// The library's text made into sets: the keys are those of a scene's materials, read from the records that describe them.
#include "materials/library_reader.hpp"

#include <limits>
#include <new>
#include <set>
#include <stdexcept>
#include <type_traits>

#include "core/toml.hpp"
#include "materials/jwl_isentrope.hpp"

namespace undex::materials {
namespace {

/// A table of a set, which remembers what has been asked for.
class Table {
 public:
  Table(const toml::table& table, std::string path) : table_(table), path_(std::move(path)) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  [[noreturn]] void complain(std::string_view key, const char* what) const {
    throw std::logic_error("materials/data: " + path_ + '.' + std::string(key) + ": " + what);
  }
  /// The value of a key, or nothing where it is not there.
  template <class Value>
  std::optional<Value> find(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    asked_.insert(std::string(key));
    const std::optional<Value> value = table_[key].template value<Value>();
    if (!value) complain(key, "has another type");
    return value;
  }
  template <class Value>
  Value get(std::string_view key) const {
    if (!has(key)) complain(key, "is missing");
    return *find<Value>(key);
  }
  std::optional<Table> table(std::string_view key) const {
    if (!has(key)) return std::nullopt;
    asked_.insert(std::string(key));
    if (!table_[key].is_table()) complain(key, "is no table");
    return Table(*table_[key].as_table(), path_ + '.' + std::string(key));
  }
  /// Numbers of an array of two.
  std::pair<double, double> pair(std::string_view key) const {
    asked_.insert(std::string(key));
    const toml::array* both = table_[key].as_array();
    if (!both || both->size() != 2) complain(key, "is no pair");
    const auto number = [&](std::size_t k) {
      const std::optional<double> value = (*both)[k].value<double>();
      if (!value) complain(key, "is no pair of numbers");
      return *value;
    };
    return {number(0), number(1)};
  }
  void expect_all_asked() const {
    for (const auto& [key, value] : table_)
      if (!asked_.contains(std::string(key.str()))) complain(key.str(), "is not known");
  }

 private:
  const toml::table& table_;
  std::string path_;
  mutable std::set<std::string, std::less<>> asked_;
};

template <class Member>
void read_member(const Table& table, const Key& key, Member& into) {
  if constexpr (Worded<Member>) {
    const std::string word = table.get<std::string>(key.name);
    for (const Word<Member>& each : words(Member{})) {
      if (word != each.word) continue;
      into = each.value;
      return;
    }
    table.complain(key.name, "has another word");
  } else if constexpr (!std::is_same_v<Member, ByHand>) {
    into = table.get<Member>(key.name);
  }
}

/// The members that the table names; with `complete` those without a default have to be there.
template <Described Record>
void read_record(const Table& table, Record& record, bool complete) {
  for_each_field(record, [&](auto&& member, const Key& key) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(member)>, ByHand>) {
      if (table.has(key.name)) read_member(table, key, member);
      else if (complete && key.needed) table.complain(key.name, "is missing");
    }
  });
}

/// What of a law's parameters the set does not give and the others say.
template <class Parameters>
void complete(const Table&, Parameters&) {}

void complete(const Table& set, Jwl::Parameters& p) {
  const std::optional<double> C = set.find<double>("C");
  if (C && set.has("E0")) set.complain("C", "stands in place of E0");
  if (!C && !set.has("E0")) set.complain("E0", "is missing");
  fill_in(p, C);
}

template <class Law>
bool read_if_named(const Table& set, const std::string& name, Fluid& into) {
  if (name != Law::name) return false;
  typename Law::Parameters parameters{};
  read_record(set, parameters, true);
  complete(set, parameters);
  into.law = Law(parameters);
  into.rho0 = parameters.rho0;
  return true;
}

template <class... Laws>
void read_law(const Table& set, Fluid& into, std::type_identity<std::variant<Laws...>>) {
  const std::string name = set.get<std::string>("law");
  if (!(read_if_named<Laws>(set, name, into) || ...)) set.complain("law", "is not known");
}

/// A law of a solid; without a name that of the base is changed.
template <class... Laws>
void read_law(const Table& set, const char* key, std::variant<Laws...>& into) {
  const std::optional<Table> table = set.table(key);
  if (!table) return;
  const std::optional<std::string> name = table->find<std::string>("law");
  if (name && !((*name == Laws::name && (into = Laws{}, true)) || ...)) table->complain("law", "is not known");
  std::visit([&](auto& law) { read_record(*table, law, name.has_value()); }, into);
  table->expect_all_asked();
}

void read_damage(const Table& set, Solid& into) {
  const std::optional<Table> table = set.table("damage");
  if (!table) return;
  const auto* flow = std::get_if<JohnsonCook>(&into.flow);
  if (!flow) set.complain("damage", "needs a flow stress of Johnson and Cook");
  JohnsonCookDamage damage{};
  damage.T_melt = flow->T_melt;
  damage.rate0 = flow->rate0;
  damage.T_room = flow->T_room;
  read_record(*table, damage, true);
  table->expect_all_asked();
  into.damage = damage;
}

Solid read_solid(const Table& set, const Solid* base) {
  Solid solid = base ? *base : Solid{};
  if (const std::optional<double> E = set.find<double>("young_modulus")) {
    const double nu = set.get<double>("poisson_ratio");
    solid.shear_modulus = *E / (2.0 * (1.0 + nu));
    solid.pressure = LinearPressure{*E / (3.0 * (1.0 - 2.0 * nu))};
  } else if (!base && !(set.has("shear_modulus") && set.has("pressure"))) {
    set.complain("shear_modulus", "and a pressure law, or young_modulus and poisson_ratio, are missing");
  }
  if (!base && !set.has("flow")) set.complain("flow", "is missing");
  read_record(set, solid, !base);
  read_law(set, "pressure", solid.pressure);
  read_law(set, "flow", solid.flow);
  read_damage(set, solid);
  return solid;
}

template <class Set>
const Set* named(const std::vector<Set>& sets, std::string_view name) {
  for (const Set& set : sets)
    if (set.name == name) return &set;
  return nullptr;
}

/// `base`: that of the set which this one is based on.
Pedigree read_pedigree(const Table& set, const std::string& kind, const Pedigree* base) {
  Pedigree pedigree = base ? *base : Pedigree{};
  pedigree.name = set.get<std::string>("name");
  pedigree.kind = kind;
  pedigree.grade = set.get<std::string>("grade");
  pedigree.checked = set.get<std::string>("checked");
  if (!base || set.has("valid")) std::tie(pedigree.valid_from, pedigree.valid_to) = set.pair("valid");
  pedigree.listed_D = set.find<double>("D");
  pedigree.listed_p_cj = set.find<double>("p_cj");
  if (const std::optional<Table> listed = set.table("listed")) {
    if (const auto D = listed->find<double>("D")) pedigree.listed_D = D;
    if (const auto p_cj = listed->find<double>("p_cj")) pedigree.listed_p_cj = p_cj;
    listed->expect_all_asked();
  }
  return pedigree;
}

void read_set(const Table& set, const std::string& kind, Sets& into) {
  const std::optional<std::string> base = set.find<std::string>("base");
  const Pedigree* origin = base ? named(into.pedigrees, *base) : nullptr;
  const Solid* solid = base ? named(into.solids, *base) : nullptr;
  if (base && !solid) set.complain("base", "is no solid before it");
  const Pedigree pedigree = read_pedigree(set, kind, origin);
  if (named(into.pedigrees, pedigree.name)) set.complain("name", "is that of another set");
  if (set.has("law")) {
    Fluid fluid;
    read_record(set, fluid, true);
    read_law(set, fluid, std::type_identity<FluidLaw>{});
    into.fluids.push_back(fluid);
  } else {
    into.solids.push_back(read_solid(set, solid));
  }
  set.expect_all_asked();
  into.pedigrees.push_back(pedigree);
}

/// The text is known to be good: where it is not, memory has run out, which the parser's stream of numbers swallows.
toml::table parsed(std::string_view text) {
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const auto again = [&] { return toml::parse(text); };
    try {
      return again();
    } catch (const toml::parse_error& twice) {
      throw std::logic_error("materials/data: line " + std::to_string(twice.source().begin.line) + ": " +
                             std::string(twice.description()));
    }
  }
}

}  // namespace

Sets read_sets(const std::vector<std::string_view>& texts) {
  Sets sets;
  for (const std::string_view text : texts) {
    const toml::table family = parsed(text);
    const std::string kind = family["kind"].value_or(std::string());
    const toml::array* members = family["set"].as_array();
    if (kind.empty() || !members) throw std::logic_error("materials/data: a family needs its kind and [[set]]");
    for (const toml::node& member : *members)
      read_set(Table(*member.as_table(), (*member.as_table())["name"].value_or(std::string("a set"))), kind, sets);
  }
  return sets;
}

}  // namespace undex::materials
