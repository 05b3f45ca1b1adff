// Every key of a scene file, with its unit and range: the reader, the writer, the suggestions and the test of
// docs/scene-file.md all take it from here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace undex::scene {

struct Key {
  std::string name;
  std::string unit;                 ///< empty: none
  double low = -1e30, high = 1e30;  ///< of a number, or of each component of a vector
  bool above_low = false;           ///< must be greater than `low`, not merely at least
};

/// A kind of table: "" is the top of the file, "shape.box" a shape of type "box".
struct Section {
  std::string name;
  std::vector<Key> keys;

  const Key* find(std::string_view key) const;
  std::vector<std::string> key_names() const;
};

const std::vector<Section>& schema();

/// The section of that name, of a scene or of a study; it must exist.
const Section& section(std::string_view name);

/// The same of a study file (docs/studies.md): "study" is its top.
const std::vector<Section>& study_schema();

/// "greater than 0", "from 0 to 1", "at least 0".
std::string range_in_words(const Key& key);

}  // namespace undex::scene
