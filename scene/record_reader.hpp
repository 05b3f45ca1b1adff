// Records read from a table of a scene: every parameter by its key, as its form says.
#pragma once

#include "core/shapes.hpp"
#include "scene/dimension.hpp"
#include "scene/table_reader.hpp"

namespace undex::scene {

/// The words of an enumeration.
template <Worded Enum>
Choices<Enum> choices() {
  const auto known = words(Enum{});
  return {known.begin(), known.end()};
}

namespace by_form {

template <class Type>
bool read(const TableReader& table, const Key& key, Type& into) {
  if constexpr (Worded<Type>) return table.read_choice(key.name, into, choices<Type>());
  else return table.read(key.name, into);
}
inline bool read(const TableReader&, const Key&, ByHand&) { return true; }
inline bool read(const TableReader&, const Key&, std::vector<Primitive>&) { return true; }  // read_shape, read_subtractions
bool read(const TableReader& table, const Key& key, Polygon& into);
inline bool read(const TableReader& table, const Key& key, std::optional<Vec3>& into) {
  Vec3 value = Vec3::Zero();
  if (key.form == Form::height && table.has(key.name) && table.find(key.name)->kind != Node::Kind::array)
    return true;  // read_level
  if (!table.read(key.name, value)) return false;
  into = value;
  return true;
}
inline bool read(const TableReader& table, const Key& key, std::optional<std::string>& into) {
  std::string value;
  if (!table.read(key.name, value)) return false;
  into = value;
  return true;
}
inline bool read(const TableReader& table, const Key& key, std::string& into) {
  return key.form == Form::name ? table.read_name(key.name, into) : table.read(key.name, into);
}
inline bool read(const TableReader& table, const Key& key, bool& into) {
  if (!*key.no) return table.read(key.name, into);
  return table.read_choice<bool>(key.name, into, {{key.yes, true}, {key.no, false}});
}
bool read(const TableReader& table, const Key& key, int& into);
bool read(const TableReader& table, const Key& key, double& into);
bool read(const TableReader& table, const Key& key, Vec3& into);
bool read(const TableReader& table, const Key& key, std::array<bool, 3>& into);
bool read(const TableReader& table, const Key& key, Dimension& into);

inline void check_greater(const TableReader&, const Key&, const auto&, const auto&) {}
void check_greater(const TableReader& table, const Key& key, double high, double low);
void check_greater(const TableReader& table, const Key& key, const Vec3& high, const Vec3& low);

}  // namespace by_form

/// Reads the parameters that the table names. With `complete` those without a default have to be there; `remedy` says what to
/// write where a key does not.
template <Described Record>
void read_fields(const TableReader& table, Record& record, bool complete = true, const char* remedy = "") {
  const std::size_t before = table.report().size();
  for_each_field(record, [&](auto&& member, const Key& key) {
    const bool without = key.form == Form::along && key.axis >= table.dimension();
    if (complete && key.needed && key.used && !without && !table.need(key.name, key.remedy ? key.remedy : remedy)) return;
    by_form::read(table, key, member);
  });
  if (table.report().size() != before) return;
  for_each_field(record, [&](const auto& high, const Key& key) {
    if (!key.greater) return;
    for_each_field(record, [&](const auto& low, const Key& other) {
      if (std::string_view(key.greater) == other.name) by_form::check_greater(table, key, high, low);
    });
  });
}

/// Is the node the name of an alternative? Otherwise reports what it must be. `path` is the user's name of the key.
bool is_alternative(const Node& node, const std::string& path, const std::vector<std::string>& names, Report& report);

}  // namespace undex::scene
