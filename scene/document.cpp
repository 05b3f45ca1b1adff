#include "scene/document.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "core/toml.hpp"
#include "scene/numbers.hpp"

namespace undex::scene {
namespace {

Where place(const toml::source_region& source) {
  return {static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

/// Length of the UTF-8 sequence that begins the text; 0 where there is none (RFC 3629: no surrogates, nothing overlong).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const auto follows = [&](std::size_t k, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(k) >= low && byte(k) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF)
    return follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && follows(2) ? 3 : 0;
  if (first >= 0xF0 && first <= 0xF4)
    return follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

std::string hexadecimal(char c) {
  const char* digits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(c);
  return std::string("0x") + digits[code >> 4] + digits[code & 15];
}

/// Finds what no TOML file has, before the parser sees it: bytes that are no text, and keys of very many parts, each of which
/// is a table within the one before. Throws SceneError with the place.
void expect_text(std::string_view text, const std::string& file) {
  constexpr int most_parts = 32;
  Where at{1, 1};
  int parts = 1;   // of the key that may be under way
  char quote = 0;  // that opened the string under way
  bool comment = false;
  const auto refuse = [&](const std::string& why) { throw SceneError(file, {{at, "not TOML: " + why}}); };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t length = sequence_length(text.substr(i));
    if (length == 0) refuse("the byte " + hexadecimal(c) + " is no UTF-8 text; save the file as UTF-8");
    const bool mark = length == 3 && text.substr(i, 3) == "\xEF\xBB\xBF" && i == 0;
    const bool line_end = c == '\n';
    if ((static_cast<unsigned char>(c) < 0x20 && c != '\t' && !line_end && !(c == '\r' && text.substr(i, 2) == "\r\n")) ||
        c == 0x7f)
      refuse("the control character " + hexadecimal(c) + "; remove it");
    if (line_end) quote = 0, comment = false;
    else if (comment) parts = 1;
    else if (quote == '"' && text.substr(i, 2) == "\\\"") ++i, ++at.column;
    else if (quote == '"' && text.substr(i, 2) == "\\\\") ++i, ++at.column;
    else if (quote != 0) quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'') quote = c;
    else if (c == '#') comment = true;
    else if (c == '.' && ++parts > most_parts) refuse("a key of more than " + std::to_string(most_parts) + " parts");
    if (line_end || (quote == 0 && (c == '=' || c == ',' || c == '[' || c == ']' || c == '{' || c == '}'))) parts = 1;
    at = line_end ? Where{at.line + 1, 1} : Where{at.line, at.column + (mark ? 0 : 1)};
    i += length;
  }
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
  expect_text(text, file);
  // toml++ reads numbers through a stream, which swallows that memory has run out: then the number is none. A mistake of the
  // text is one twice. Given the file's name, it would keep it where it may not throw.
  const auto parsed = [&] { return toml::parse(text); };
  const auto parsed_surely = [&] {
    try {
      return parsed();
    } catch (const toml::parse_error&) {
      return parsed();
    }
  };
  try {
    Node root = converted(parsed_surely());
    root.where = {1, 1};
    return root;
  } catch (const toml::parse_error& error) {
    throw SceneError(file, {{place(error.source()), "not TOML: " + std::string(error.description())}});
  } catch (const std::logic_error& error) {
    throw SceneError(file, {{{}, "not TOML: " + std::string(error.what())}});
  }
}

}  // namespace undex::scene
