#include "scene/overrides.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "scene/suggestion.hpp"

namespace undex::scene {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts{""};
  for (const char c : path) {
    if (c == '.') parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

/// A bare word is text, so that nobody has to quote twice in a shell.
bool is_bare_word(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '/' || c == '+';
  });
}

/// A number, and after it what may be a unit: "1 ms", "1.63 g/cm3", "2 kg*m^-3".
bool has_a_unit(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [unit, error] = std::from_chars(text.data() + (text.starts_with('+') ? 1 : 0), end, number);
  return error == std::errc() && unit != end && std::all_of(unit, end, [](unsigned char c) {
           return std::isalnum(c) || c >= 0x80 || std::string_view(" _-+./*^%").find(char(c)) != std::string_view::npos;
         });
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

bool parse_value(const std::string& text, Node& into);

/// [1 cm, 0, 0]: a list of numbers some of which have a unit.
bool parse_quantities(const std::string& text, Node& into) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']' || text.find_first_of("\"'[]{}=\n", 1) != text.size() - 1)
    return false;
  Node list;
  list.kind = Node::Kind::array;
  for (std::size_t from = 1, to = 0; from < text.size(); from = to + 1) {
    to = std::min(text.find(',', from), text.size() - 1);
    if (!parse_value(trimmed(text.substr(from, to - from)), list.items.emplace_back())) return false;
  }
  into = std::move(list);
  return true;
}

void mark(Node& node, const std::string& origin) {
  node.where = {};
  node.origin = origin;
  for (Node& item : node.items) mark(item, origin);
  for (Entry& entry : node.entries) {
    entry.where = {};
    mark(entry.node, origin);
  }
}

bool parse_value(const std::string& text, Node& into) {
  try {
    Node document = parse_toml("value = " + text + "\n", "");
    if (document.entries.size() != 1) return false;  // a value that smuggles in another key
    into = document.entries.front().node;
    return true;
  } catch (const SceneError&) {
    if (parse_quantities(text, into)) return true;
    if (!is_bare_word(text) && !has_a_unit(text)) return false;
    into.kind = Node::Kind::text;
    into.text = text;
    return true;
  }
}

/// The element of an array of tables that `part` names.
Node* element(Node& array, const std::string& part, const std::string& path, const std::string& origin, Report& report) {
  std::vector<std::string> names;
  for (Node& item : array.items) {
    const Node* name = item.find("name");
    if (!name || name->kind != Node::Kind::text) continue;
    if (name->text == part) return &item;
    names.push_back(name->text);
  }
  std::size_t index = 0;
  const auto end = part.data() + part.size();
  if (const auto [stop, error] = std::from_chars(part.data(), end, index); error == std::errc() && stop == end) {
    if (index < array.items.size()) return &array.items[index];
    report.add(Where{}, origin + ": " + path + " has " + std::to_string(array.items.size()) + " elements, counted from 0");
    return nullptr;
  }
  report.add(Where{}, origin + ": nothing in " + path + " is named '" + part + "'" + suggestion(part, names));
  return nullptr;
}

void apply_one(const Override& given, Node& root, Report& report) {
  const std::string origin = "-P " + given.key;
  const std::vector<std::string> parts = split(given.key);
  if (std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); })) {
    report.add(Where{}, origin + ": not a dotted path; write e.g. resolution.spacing=0.001");
    return;
  }
  Node value;
  if (!parse_value(given.value, value)) {
    report.add(Where{},
               origin + ": cannot read the value '" + given.value + "'; write a number, true, \"text\", [list] or {key = value}");
    return;
  }
  mark(value, origin);

  Node* at = &root;
  std::string path;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool last = i + 1 == parts.size();
    if (at->kind == Node::Kind::text && path.ends_with(".material")) {  // "petn" -> {base = "petn"}
      Node table;
      table.where = at->where;
      table.origin = at->origin;
      table.entries.push_back({"base", at->where, *at});
      *at = table;
    }
    if (at->kind == Node::Kind::array) {
      Node* found = element(*at, parts[i], path, origin, report);
      if (!found) return;
      if (last) *found = value;
      at = found;
    } else if (at->kind == Node::Kind::table) {
      Node* found = at->find(parts[i]);
      if (!found) {
        Node table;
        table.origin = origin;
        at->entries.push_back({parts[i], {}, table});
        found = &at->entries.back().node;
      }
      if (last) *found = value;
      at = found;
    } else {
      report.add(Where{}, origin + ": " + path + " is " + at->described() + ", it has no '" + parts[i] + "'");
      return;
    }
    path += (path.empty() ? "" : ".") + parts[i];
  }
}

}  // namespace

void apply(const std::vector<Override>& overrides, Node& root, Report& report) {
  for (const Override& each : overrides) apply_one(each, root, report);
}

}  // namespace undex::scene
