#include "scene/document.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "scene/numbers.hpp"

// The parser's own assertions fail on some damaged files: a mistake of the file, not of this program.
#define TOML_ASSERT(condition) static_cast<void>((condition) || (throw std::domain_error("unexpected characters"), false))
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wterminate"
#include <toml++/toml.h>
#pragma GCC diagnostic pop

namespace undex::scene {
namespace {

Where place(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Node converted(const toml::node& from) {
  Node node;
  node.where = place(from.source());
  if (const auto* value = from.as_boolean()) {
    node.kind = Node::Kind::boolean;
    node.boolean = value->get();
  } else if (const auto* integer = from.as_integer()) {
    node.kind = Node::Kind::integer;
    node.integer = integer->get();
    node.number = static_cast<double>(node.integer);
  } else if (const auto* number = from.as_floating_point()) {
    node.kind = Node::Kind::number;
    node.number = number->get();
  } else if (const auto* text = from.as_string()) {
    node.kind = Node::Kind::text;
    node.text = text->get();
  } else if (const auto* array = from.as_array()) {
    node.kind = Node::Kind::array;
    for (const toml::node& item : *array) node.items.push_back(converted(item));
  } else if (const auto* table = from.as_table()) {
    node.kind = Node::Kind::table;
    for (const auto& [key, each] : *table) node.entries.push_back({std::string(key.str()), place(key.source()), converted(each)});
  } else {
    node.kind = Node::Kind::other;
  }
  return node;
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry.node;
  return nullptr;
}
Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string Node::described() const {
  switch (kind) {
    case Kind::boolean: return boolean ? "true" : "false";
    case Kind::integer: return "the number " + std::to_string(integer);
    case Kind::number: {
      char buffer[32];
      const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
      return "the number " + std::string(buffer, end);
    }
    case Kind::text: return "the text \"" + (text.size() > 60 ? text.substr(0, 57) + "..." : text) + '"';
    case Kind::array: return "an array of " + std::to_string(items.size());
    case Kind::table: return "a table";
    case Kind::other: break;
  }
  return "a date or time";
}

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      const char* digits = "0123456789abcdef";
      result += "\\u00";
      result += digits[code >> 4];
      result += digits[code & 15];
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::vector<const Entry*> in_file_order(const Node& table) {
  std::vector<const Entry*> entries;
  for (const Entry& entry : table.entries) entries.push_back(&entry);
  std::sort(entries.begin(), entries.end(), [](const Entry* a, const Entry* b) {
    return std::pair(a->where.line, a->where.column) < std::pair(b->where.line, b->where.column);
  });
  return entries;
}

std::string toml_value(const Node& node) {
  std::string text;
  const auto append = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  switch (node.kind) {
    case Node::Kind::boolean: return node.boolean ? "true" : "false";
    case Node::Kind::integer: return std::to_string(node.integer);
    case Node::Kind::number: return shortest(node.number);
    case Node::Kind::text: return quoted(node.text);
    case Node::Kind::array:
      for (const Node& item : node.items) append(toml_value(item));
      return '[' + text + ']';
    case Node::Kind::table:
      for (const Entry* entry : in_file_order(node)) append(quoted(entry->key) + " = " + toml_value(entry->node));
      return '{' + text + '}';
    case Node::Kind::other: break;
  }
  return "";
}

Node parse_toml(std::string_view text, const std::string& file) {
  try {
    Node root = converted(toml::parse(text, std::string_view(file)));
    root.where = {1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    throw SceneError(file, {{place(error.source()), "not TOML: " + std::string(error.description())}});
  } catch (const std::domain_error& error) {
    throw SceneError(file, {{{}, "not TOML: " + std::string(error.what())}});
  }
}

}  // namespace undex::scene
