// The named material sets: looked up, and listed. Their constants and sources are in materials/data.
#include "materials/library.hpp"

#include <cmath>
#include <type_traits>

#include "materials/library_reader.hpp"

namespace undex::materials {

namespace {

const Sets& sets() {
  static const Sets all = read_sets(library_texts());
  return all;
}

template <class Set>
std::optional<Set> find(const std::vector<Set>& of, std::string_view name) {
  for (const Set& set : of)
    if (set.name == name) return set;
  return std::nullopt;
}

template <class Set>
std::vector<std::string> names(const std::vector<Set>& of) {
  std::vector<std::string> all;
  for (const Set& set : of) all.push_back(set.name);
  return all;
}

using NamedValues = std::vector<std::pair<std::string, double>>;

/// The numbers of a record that count, each under the name that it has in a scene file.
template <class Record>
void append(NamedValues& table, const std::string& prefix, const Record& record) {
  for_each_field(record, [&](const auto& value, const Key& key) {
    if constexpr (std::is_same_v<decltype(value), const double&>)
      if (key.used) table.emplace_back(prefix + key.name + " [" + (*key.unit ? key.unit : "-") + "]", value);
  });
}

}  // namespace

std::optional<Fluid> find_fluid(std::string_view name) { return find(sets().fluids, name); }
std::optional<Solid> find_solid(std::string_view name) { return find(sets().solids, name); }
std::optional<Pedigree> find_pedigree(std::string_view name) { return find(sets().pedigrees, name); }
std::vector<std::string> fluid_names() { return names(sets().fluids); }
std::vector<std::string> solid_names() { return names(sets().solids); }

bool is_verified(const Pedigree& pedigree, const ChapmanJouguet& own) {
  const auto agrees = [](const std::optional<double>& listed, double has) {
    return !listed || std::abs(*listed / has - 1) <= agreement;
  };
  return agrees(pedigree.listed_D, own.detonation_speed) && agrees(pedigree.listed_p_cj, own.pressure);
}

std::vector<std::pair<std::string, double>> parameters(const Fluid& fluid) {
  NamedValues table;
  std::visit([&](const auto& law) { append(table, "", law.parameters()); }, fluid.law);
  return table;
}

std::vector<std::pair<std::string, double>> parameters(const Solid& solid) {
  NamedValues table;
  append(table, "", solid);
  std::visit([&](const auto& law) { append(table, "pressure.", law); }, solid.pressure);
  std::visit([&](const auto& law) { append(table, "flow.", law); }, solid.flow);
  if (solid.spall) append(table, "spall.", *solid.spall);
  if (solid.damage) append(table, "damage.", *solid.damage);
  return table;
}

}  // namespace undex::materials
