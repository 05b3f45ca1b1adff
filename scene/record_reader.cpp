#include "scene/record_reader.hpp"

#include <algorithm>

#include "scene/numbers.hpp"
#include "scene/suggestion.hpp"

namespace undex::scene {
namespace by_form {
namespace {

std::string no_such_axis(const TableReader& table, const Key& key) {
  return table.path_of(key.name) + ": the scene has dimension = " + std::to_string(table.dimension()) + ", so no such axis";
}

bool read_turn(const TableReader& table, const Key& key, Vec3& into) {
  const Node* node = table.find(key.name);
  if (!node) return false;
  if (table.dimension() == 3) return table.read(key.name, into);
  if (node->kind != Node::Kind::array) return table.read(key.name, into[2]);
  const std::string unit = std::string_view(key.unit) == "deg" ? "degrees" : key.unit;
  table.complain(key.name,
                 table.path_of(key.name) + " must be a number in " + unit + " in two dimensions: only z is left to turn about");
  return false;
}

bool read_count(const TableReader& table, const Key& key, int& into) {
  if (!table.read(key.name, into)) return false;
  const auto& [divisor, because] = key.multiple;
  if (into % divisor == 0) return true;
  table.complain(key.name, table.path_of(key.name) + " = " + std::to_string(into) + " must be a multiple of " +
                               std::to_string(divisor) + because + "; e.g. " + std::to_string(key.multiple.next(into)));
  return false;
}

}  // namespace

bool read(const TableReader& table, const Key& key, int& into) {
  if (key.form == Form::plain) return read_count(table, key, into);
  if (!table.read_axis(key.name, into)) return false;
  if (key.form == Form::axis || into < table.dimension()) return true;
  table.complain(key.name, no_such_axis(table, key));
  into = 0;
  return false;
}

bool read(const TableReader& table, const Key& key, double& into) {
  double ignored = 0;
  return table.read(key.name, key.form == Form::along && key.axis >= table.dimension() ? ignored : into);
}

bool read(const TableReader& table, const Key& key, Vec3& into) {
  if (key.form == Form::turn) return read_turn(table, key, into);
  const bool good = table.read(key.name, into);
  if (key.form == Form::across) into[key.axis] = 0;
  return good;
}

bool read(const TableReader& table, const Key& key, Polygon& into) {
  const Node* list = table.find(key.name);
  if (!list) return false;
  const std::string path = table.path_of(key.name);
  constexpr std::size_t most = 10000;
  if (list->kind != Node::Kind::array || list->items.size() > most) {
    table.complain(key.name,
                   path + " must be a list of up to " + std::to_string(most) + " pairs [r, z] in " + key.unit + ", not " +
                       (list->kind == Node::Kind::array ? std::to_string(list->items.size()) + " of them" : list->described()));
    return false;
  }
  Polygon points;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const Node& item = list->items[i];
    const bool pair = item.kind == Node::Kind::array && item.items.size() == 2 && item.items[0].is_number() &&
                      item.items[1].is_number() && key.range.holds(item.items[0].number) && key.range.holds(item.items[1].number);
    if (!pair) {
      table.report().add(item, path + '.' + std::to_string(i) + " must be a pair [r, z] of numbers " + range_in_words(key.range) +
                                   " " + key.unit + ", not " + item.described());
      return false;
    }
    points.push_back({item.items[0].number, item.items[1].number});
  }
  into = points;
  return true;
}

bool read(const TableReader& table, const Key& key, std::array<bool, 3>& into) {
  std::vector<int> axes;
  if (!table.read_axes(key.name, axes)) return false;
  into = {false, false, false};
  for (const int axis : axes) into[static_cast<std::size_t>(axis)] = true;
  return true;
}

bool read(const TableReader& table, const Key& key, Dimension& into) {
  const Node* node = table.find(key.name);
  if (!node || node->kind != Node::Kind::text) return table.read(key.name, into.coordinates);
  if (!table.read_choice(key.name, into.geometry, choices<Geometry>())) return false;
  into.coordinates = coordinates_of(into.geometry);
  return true;
}

void check_greater(const TableReader& table, const Key& key, double high, double low) {
  if (low < high) return;
  table.complain(key.name, table.path_of(key.name) + " = " + shortest(high) + " must be greater than " + key.greater + " = " +
                               shortest(low));
}

void check_greater(const TableReader& table, const Key& key, const Vec3& high, const Vec3& low) {
  for (int a = 0; a < table.dimension(); ++a)
    if (!(low[a] < high[a])) {
      table.complain(key.name, table.path_of(key.name) + ": along " + "xyz"[a] + ", " + key.name + " = " + shortest(high[a]) +
                                   " must be greater than " + key.greater + " = " + shortest(low[a]));
      return;
    }
}

}  // namespace by_form

bool is_alternative(const Node& node, const std::string& path, const std::vector<std::string>& names, Report& report) {
  if (node.kind == Node::Kind::text && std::find(names.begin(), names.end(), node.text) != names.end()) return true;
  report.add(node, path + " must be one of " + listed(names) + ", not " + node.described() +
                       (nearest(node.text, names).empty() ? "" : suggestion(node.text, names)));
  return false;
}

}  // namespace undex::scene
