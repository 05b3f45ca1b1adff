#include "scene/table_reader.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "scene/numbers.hpp"
#include "scene/suggestion.hpp"
#include "scene/units.hpp"

namespace undex::scene {
namespace {

/// Where a key that is misplaced would belong: "[scheme]".
std::string home_of(const std::string& key) {
  for (const char* name : {"resolution", "symmetry", "scheme", "coupling", "output", "comparison", "structure", "solid_scheme"})
    if (section(name).find(key)) return std::string("[") + name + "]";
  for (const char* name : {"bodies", "solids", "walls", "planes", "probes", "lines"})
    if (section(name).find(key)) return std::string("[[") + name + "]]";
  return section("").find(key) ? "the top of the file, before the first [table]" : "";
}

/// Of what must be greater than 0: squares of less vanish, of a density [kg/m^3] in single precision.
double smallest(const Key& key) { return std::string_view(key.unit) == "kg/m^3" ? 1e-9 : 1e-30; }

std::string table_name(const std::string& path) { return path.empty() ? "at the top of the file" : "in " + path; }

}  // namespace

void report_unknown_keys(const Node& node, const std::string& path, const Section& known, Report& report) {
  constexpr int most_remedies = 100;  // in one table
  int unknown = 0;
  const std::vector<std::string> names = known.key_names();
  for (const Entry& entry : node.entries) {
    if (known.find(entry.key)) continue;
    if (++unknown > most_remedies) {
      report.add(entry, "unknown key");
      continue;
    }
    std::string remedy;
    if (const std::string near = nearest(entry.key, names); !near.empty()) remedy = "did you mean '" + near + "'?";
    else if (const std::string home = known.name.starts_with("study") ? "" : home_of(entry.key); !home.empty())
      remedy = "it belongs to " + home;
    else remedy = "known: " + listed(names);
    report.add(entry, "unknown key '" + entry.key + "' " + table_name(path) + "; " + remedy);
  }
}

TableReader::TableReader(const Node& node, std::string path, std::string_view section_name, int dimension, Report& report)
    : node_(node), path_(std::move(path)), section_(section(section_name)), dimension_(dimension), report_(report) {
  report_unknown_keys(node_, path_, section_, report_);
}

const Node* TableReader::find(const char* key) const {
  assert(section_.find(key));
  return node_.find(key);
}

void TableReader::complain(const char* key, const std::string& message) const {
  const Node* found = find(key);
  report_.add(found ? *found : node_, message);
}

void TableReader::unknown_word(const char* key, const std::string& word, const std::vector<std::string>& known) const {
  complain(key, path_of(key) + ": unknown '" + word + "'" + suggestion(word, known));
}

void TableReader::wrong_type(const char* key, const Node& found, const std::string& wanted) const {
  report_.add(found, path_of(key) + " must be " + wanted + ", not " + found.described());
}

bool TableReader::need(const char* key, const std::string& remedy) const {
  if (find(key)) return true;
  report_.add(node_, path_of(key) + " is missing; " + remedy);
  return false;
}

bool TableReader::in_range(const char* key, const Node& at, double value) const {
  const Range& range = section_.find(key)->range;
  const bool finite = std::isfinite(value), held = finite && range.holds(value);
  const double least = smallest(*section_.find(key));
  const bool vanishes = held && range.above_low && range.low == 0 && value < least;
  if (held && !vanishes) return true;
  const std::string unit = section_.find(key)->unit;
  std::string wanted = "must be " + range_in_words(range);
  if (vanishes) wanted = "is too small to compute with: it must be at least " + shortest(least);
  else if (finite && std::abs(value) > Range::endless && (value > 0 ? range.high : -range.low) >= Range::endless)
    wanted = "is too large to compute with: it must be at most " + shortest(Range::endless) + " in size";
  report_.add(at, path_of(key) + " = " + shortest(value) + (unit.empty() ? "" : " [" + unit + "]") + ' ' + wanted);
  return false;
}

std::optional<double> TableReader::number(const char* key, const Node& at, const std::string& wanted) const {
  std::optional<double> value;
  if (at.is_number()) {
    value = at.number;
  } else if (at.kind == Node::Kind::text) {
    const Converted converted = in_unit(at.text, section_.find(key)->unit);
    if (!converted.value) report_.add(at, path_of(key) + " = \"" + at.text.substr(0, 60) + "\" " + converted.flaw);
    value = converted.value;
    if (!value) return {};
  } else {
    wrong_type(key, at, wanted);
    return {};
  }
  if (!in_range(key, at, *value)) return {};
  return value;
}

bool TableReader::read(const char* key, double& into) const {
  const Node* found = find(key);
  if (!found) return false;
  const std::string unit = section_.find(key)->unit;
  const auto value = number(key, *found, "a number" + (unit.empty() ? "" : " in " + unit));
  if (value) into = *value;
  return value.has_value();
}

bool TableReader::read(const char* key, std::optional<double>& into) const {
  double value = 0;
  if (!read(key, value)) return false;
  into = value;
  return true;
}

bool TableReader::read(const char* key, int& into) const {
  const Node* found = find(key);
  if (!found) return false;
  const bool whole = found->is_number() && std::floor(found->number) == found->number;
  if (!whole) {
    wrong_type(key, *found, "a whole number");
    return false;
  }
  assert(section_.find(key)->range.high < 2e9);
  if (!in_range(key, *found, found->number)) return false;
  into = static_cast<int>(found->number);
  return true;
}

bool TableReader::read(const char* key, bool& into) const {
  const Node* found = find(key);
  if (!found) return false;
  if (found->kind != Node::Kind::boolean) {
    wrong_type(key, *found, "true or false");
    return false;
  }
  into = found->boolean;
  return true;
}

bool TableReader::read(const char* key, std::string& into) const {
  const Node* found = find(key);
  if (!found) return false;
  if (found->kind != Node::Kind::text) {
    wrong_type(key, *found, "text in quotes");
    return false;
  }
  into = found->text;
  return true;
}

bool TableReader::read(const char* key, std::vector<double>& into) const {
  const Node* found = find(key);
  if (!found) return false;
  if (found->kind != Node::Kind::array) {
    wrong_type(key, *found, "an array of numbers");
    return false;
  }
  std::vector<double> values;
  for (const Node& item : found->items) {
    const auto value = number(key, item, "an array of numbers");
    if (!value) return false;
    values.push_back(*value);
  }
  into = values;
  return true;
}

bool TableReader::read(const char* key, std::vector<std::string>& into) const {
  const Node* found = find(key);
  if (!found) return false;
  if (found->kind != Node::Kind::array) {
    wrong_type(key, *found, "an array of texts in quotes");
    return false;
  }
  std::vector<std::string> values;
  for (const Node& item : found->items) {
    if (item.kind != Node::Kind::text) {
      wrong_type(key, item, "an array of texts in quotes");
      return false;
    }
    values.push_back(item.text);
  }
  into = values;
  return true;
}

bool TableReader::read(const char* key, Vec3& into) const {
  const Node* found = find(key);
  if (!found) return false;
  if (dimension_ == 1 && found->kind != Node::Kind::array) {
    const auto value = number(key, *found, "a number, or an array of 1 (or 3)");
    if (value) into = Vec3(*value, 0, 0);
    return value.has_value();
  }
  const std::string wanted = dimension_ == 3
                                 ? "an array of 3 numbers"
                                 : "an array of " + std::to_string(dimension_) + " (or 3) numbers, as the scene has " +
                                       "dimension = " + std::to_string(dimension_);
  if (found->kind != Node::Kind::array ||
      (found->items.size() != static_cast<std::size_t>(dimension_) && found->items.size() != 3)) {
    wrong_type(key, *found, wanted);
    return false;
  }
  Vec3 value = Vec3::Zero();
  for (std::size_t a = 0; a < found->items.size(); ++a) {
    const Node& item = found->items[a];
    const auto component = number(key, item, wanted);
    if (!component) return false;
    if (static_cast<int>(a) < dimension_) value[static_cast<Eigen::Index>(a)] = *component;
  }
  into = value;
  return true;
}

bool TableReader::read_name(const char* key, std::string& into) const {
  std::string word;
  if (!read(key, word)) return false;
  const bool good = !word.empty() && word.size() <= 100 && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '_' || c == '-');
  });
  if (!good) {
    complain(key, path_of(key) + " = \"" + word.substr(0, 100) + "\" must be 1 to 100 letters, digits, '_' or '-'");
    return false;
  }
  into = word;
  return true;
}

bool TableReader::read_axis(const char* key, int& into) const {
  return read_choice<int>(key, into, {{"x", 0}, {"y", 1}, {"z", 2}});
}

bool TableReader::read_axes(const char* key, std::vector<int>& into) const {
  std::vector<std::string> words;
  if (!read(key, words)) return false;
  std::vector<int> axes;
  for (const std::string& word : words) {
    const int axis = word == "x" ? 0 : word == "y" ? 1 : word == "z" ? 2 : -1;
    if (axis < 0) {
      unknown_word(key, word, {"x", "y", "z"});
      return false;
    }
    if (std::find(axes.begin(), axes.end(), axis) != axes.end()) {
      complain(key, path_of(key) + " names '" + word + "' twice; name each axis once");
      return false;
    }
    axes.push_back(axis);
  }
  std::sort(axes.begin(), axes.end());
  into = axes;
  return true;
}

std::vector<const Node*> TableReader::tables(const char* key) const {
  std::vector<const Node*> result;
  const Node* found = find(key);
  if (!found) return result;
  if (found->kind != Node::Kind::array) {
    wrong_type(key, *found, path_.empty() ? "written as [[" + std::string(key) + "]]" : "an array of tables");
    return result;
  }
  for (const Node& item : found->items) {
    if (item.kind == Node::Kind::table) result.push_back(&item);
    else wrong_type(key, item, "an array of tables");
  }
  return result;
}

const Node* TableReader::table(const char* key) const {
  const Node* found = find(key);
  if (!found) return nullptr;
  if (found->kind == Node::Kind::table) return found;
  wrong_type(key, *found, path_.empty() ? "a table, [" + std::string(key) + "]" : "a table, {key = value, ...}");
  return nullptr;
}

}  // namespace undex::scene
