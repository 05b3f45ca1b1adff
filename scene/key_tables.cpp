#include "scene/key_tables.hpp"

#include <cmath>

#include "core/errors.hpp"
#include "core/point_values.hpp"
#include "scene/library_table.hpp"
#include "scene/suggestion.hpp"
#include "scene/tables.hpp"
#include "scene/toml_values.hpp"

namespace undex::scene {
namespace {

/// The text in a cell: "|" would end it.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

/// 1e-5, not 1e-05.
std::string number_text(double value) {
  std::string text = shortest(value);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  if (text[exponent + 1] == '+') text.erase(exponent + 1, 1);
  const auto digits = text.find_first_of("0123456789", exponent);
  if (text[digits] == '0') text.erase(digits, 1);
  return text;
}

std::string in_words(const Range& range) {
  const bool low = range.low > -Range::farthest, high = range.high < Range::farthest;
  if (low && high && range.above_low) return "above " + number_text(range.low) + ", to " + number_text(range.high);
  if (low && high) return number_text(range.low) + " to " + number_text(range.high);
  if (low && range.above_low) return "above " + number_text(range.low);
  return low ? number_text(range.low) + " or more" : "number";
}

/// What a parameter may be, by its type.
std::string values_of(const Key&, const auto&) { return ""; }
template <Worded Enum>
std::string values_of(const Key&, const Enum& value) {
  std::string all;
  for (const Word<Enum>& each : words(value)) all += (all.empty() ? "" : ", ") + quoted(each.word);
  return all;
}
std::string values_of(const Key& key, const bool&) { return *key.no ? quoted(key.yes) + ", " + quoted(key.no) : "true, false"; }
std::string values_of(const Key& key, const int&) {
  if (key.form != Form::plain) return "\"x\", \"y\", \"z\"";
  const std::string multiple = key.multiple.of > 1 ? "; a multiple of " + std::to_string(key.multiple.of) : "";
  return in_words(key.range) + multiple;
}
std::string values_of(const Key& key, const double&) { return in_words(key.range); }
std::string values_of(const Key& key, const Vec3&) {
  if (key.form == Form::height) return "position; a number: along `gravity`";
  if (key.form == Form::turn) return "vector; in 2D a number, about z";
  return key.range.is_endless() ? "vector" : "position";
}
std::string values_of(const Key& key, const std::string&) { return key.form == Form::name ? "a name" : "text"; }
std::string values_of(const Key&, const std::vector<std::string>&) { return "list"; }
std::string values_of(const Key&, const std::array<bool, 3>&) { return "list of \"x\", \"y\", \"z\""; }
std::string values_of(const Key& key, const ByHand&) { return in_words(key.range); }
template <class Value>
std::string values_of(const Key& key, const std::optional<Value>&) {
  return values_of(key, Value{});
}

/// The value that a scene gets which does not name the key.
std::string default_of(const Key& key, const auto& member) {
  if (key.needed) return "required";
  if (key.rule) return key.rule;
  const std::string text = TomlValues(3, number_text).text(key, member);
  return text.empty() ? "none" : text;
}
std::string default_of(const Key& key, const std::vector<Primitive>&) {
  return key.needed ? "required" : key.rule ? key.rule : "[]";
}

std::string row(const Key& key, const auto& member) {
  std::string values = key.values    ? key.values
                       : key.greater ? "above `" + std::string(key.greater) + "`"
                                     : values_of(key, member);
  return std::string("| `") + key.name + "` | " + (*key.unit ? key.unit : "-") + " | " + cell(default_of(key, member)) + " | " +
         cell(values) + " | " + cell(key.meaning) + (*key.meaning ? " |\n" : "|\n");
}

const char* const head = "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";

/// The keys of a record; none for tables that have tables of their own.
std::string table_of(const auto& record) {
  std::string rows;
  for_each_field(record, [&](const auto& member, const Key& key) {
    const bool is_table = std::is_same_v<std::decay_t<decltype(member)>, ByHand> && !key.values && !*key.meaning;
    if (!is_table) rows += row(key, member);
  });
  return rows.empty() ? "" : head + rows;
}

/// The table of that name, "library" for the named materials; of a mark "tables:", all that begin with it and say what they are.
std::string text_for(const std::string& name, bool group) {
  if (name == "library") return library_table();
  std::string text;
  for_each_table([&](const std::string& each, const char* summary, const auto& record, const char*) {
    if (!group && each == (name == "top" ? "" : name)) text = table_of(record);
    if (!group || !each.starts_with(name + '.') || !*summary) return;
    const std::string table = table_of(record);
    text += (text.empty() ? "" : "\n") + quoted(each.substr(name.size() + 1)) + ": " + summary + "\n" +
            (table.empty() ? "" : "\n" + table);
  });
  return text;
}

}  // namespace

const char* quantities_in_words() {
  const auto quoted_names = [](const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + quoted(name);
    return all;
  };
  static const std::string words =
      "fluid, wall: " + quoted_names(names_of(fluid_quantities)) + "; structure: " + quoted_names(names_of(material_quantities));
  return words.c_str();
}

std::string key_table(const std::string& name) { return name == "library" ? "" : text_for(name, false); }

std::vector<std::string> key_table_names() {
  std::vector<std::string> names;
  for_each_table([&](const std::string& each, const char*, const auto& record, const char*) {
    if (!table_of(record).empty()) names.push_back(each.empty() ? "top" : each);
  });
  return names;
}

std::string with_key_tables(const std::string& page, const std::string& file) {
  static const std::string open = "<!-- table", close = " -->\n", end = "<!-- end -->";
  std::string text;
  std::size_t done = 0;
  for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, done)) {
    const std::size_t colon = page.find(": ", at), mark_end = page.find(close, at), last = page.find(end, at);
    if (colon == std::string::npos || mark_end == std::string::npos || last == std::string::npos || colon > mark_end ||
        mark_end > last)
      throw FileError(file + ": the mark '" + page.substr(at, 30) + "' must be <!-- table: name --> on a line of its own, with " +
                      end + " after it; mend the page");
    const std::string name = page.substr(colon + 2, mark_end - colon - 2);
    const std::string tables = text_for(name, page[at + open.size()] == 's');
    if (tables.empty()) throw FileError(file + ": there is no table '" + name + "' of keys; mend the mark");
    text += page.substr(done, mark_end + close.size() - done) + tables;
    done = last;
  }
  return text + page.substr(done);
}

}  // namespace undex::scene
