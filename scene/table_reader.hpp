// Typed access to one table of a scene. Every mistake (unknown key, wrong type, value out of range, missing key) goes to
// the report, and the value read into keeps what it had, so that reading goes on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.hpp"
#include "scene/document.hpp"
#include "scene/report.hpp"
#include "scene/schema.hpp"

namespace undex::scene {

template <class Enum>
using Choices = std::vector<Word<Enum>>;

class TableReader {
 public:
  /// `path` is how the user would name the table ("bodies.water"), `section_name` its kind in the schema. Unknown keys
  /// are reported here.
  TableReader(const Node& node, std::string path, std::string_view section_name, int dimension, Report& report);

  // Each returns whether the key was there and good.
  bool read(const char* key, double& into) const;
  bool read(const char* key, std::optional<double>& into) const;
  bool read(const char* key, int& into) const;
  bool read(const char* key, bool& into) const;
  bool read(const char* key, std::string& into) const;
  bool read(const char* key, std::vector<double>& into) const;
  bool read(const char* key, std::vector<std::string>& into) const;
  /// A position or velocity: as many numbers as the scene has dimensions, or three; in one dimension also a bare number.
  bool read(const char* key, Vec3& into) const;
  /// A name of letters, digits, '_', '-': fit for file names and dotted paths.
  bool read_name(const char* key, std::string& into) const;
  /// "x", "y" or "z".
  bool read_axis(const char* key, int& into) const;
  /// A list of different axes.
  bool read_axes(const char* key, std::vector<int>& into) const;
  template <class Enum>
  bool read_choice(const char* key, Enum& into, const Choices<Enum>& choices) const {
    std::string word;
    if (!read(key, word)) return false;
    for (const auto& [name, value] : choices)
      if (word == name) {
        into = value;
        return true;
      }
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.word);
    unknown_word(key, word, names);
    return false;
  }

  bool has(const char* key) const { return node_.find(key) != nullptr; }
  /// The value of the key as it stands, or null.
  const Node* find(const char* key) const;
  /// Reports the key as missing where it is; `remedy` says what to write. Returns whether it is there.
  bool need(const char* key, const std::string& remedy) const;
  /// Elements of an array of tables; anything else is reported.
  std::vector<const Node*> tables(const char* key) const;
  /// A sub-table, or null; anything else is reported.
  const Node* table(const char* key) const;

  /// Reports at the key's value, or at the table where the key is absent.
  void complain(const char* key, const std::string& message) const;
  void unknown_word(const char* key, const std::string& word, const std::vector<std::string>& known) const;
  std::string path_of(const char* key) const { return path_.empty() ? key : path_ + '.' + key; }
  const std::string& path() const { return path_; }
  const Node& node() const { return node_; }
  Report& report() const { return report_; }
  int dimension() const { return dimension_; }

 private:
  void wrong_type(const char* key, const Node& found, const std::string& wanted) const;
  bool in_range(const char* key, const Node& at, double value) const;
  /// A number, or a text of a number with a unit in that of the key; else a complaint.
  std::optional<double> number(const char* key, const Node& at, const std::string& wanted) const;

  const Node& node_;
  std::string path_;
  const Section& section_;
  int dimension_;
  Report& report_;
};

/// Reports the keys of `node` that the section does not know.
void report_unknown_keys(const Node& node, const std::string& path, const Section& known, Report& report);

}  // namespace undex::scene
