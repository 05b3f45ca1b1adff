// A TOML text as a plain tree that remembers where everything was written. The only reader of toml++ is document.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/errors.hpp"

namespace undex::scene {

struct Entry;

/// A value of a TOML document.
struct Node {
  enum class Kind { boolean, integer, number, text, array, table, other };
  Kind kind = Kind::table;
  bool boolean = false;
  long long integer = 0;
  double number = 0;  ///< also set for integers
  std::string text;
  std::vector<Node> items;     ///< of an array
  std::vector<Entry> entries;  ///< of a table
  Where where;                 ///< of the value in the file
  std::string origin;          ///< "-P key" where the command line gave it, else empty

  bool is_number() const { return kind == Kind::integer || kind == Kind::number; }
  const Node* find(std::string_view key) const;
  Node* find(std::string_view key);
  /// What it is, in a user's words: "text \"2mm\"", "the number 3", "a table".
  std::string described() const;
};

/// A key of a table and its value.
struct Entry {
  std::string key;
  Where where;  ///< of the key
  Node node;
};

/// A table's entries as they were written: the tree holds them by the alphabet.
std::vector<const Entry*> in_file_order(const Node& table);

/// Text in quotes, as TOML wants it.
std::string quoted(const std::string& text);

/// The value as TOML on one line. Dates and times, which nothing here has, are empty.
std::string toml_value(const Node& node);

/// Parses TOML. Throws SceneError with the place of a syntax error.
Node parse_toml(std::string_view text, const std::string& file);

}  // namespace undex::scene
