// Every key of a scene file: a view of the records of all that a scene sets, and the keys of tables that have none. The reader,
// the writer, the suggestions and the tables of docs/reference/scene-file.md take it from here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/record.hpp"

namespace undex::scene {

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

/// The same of a study file (docs/reference/studies.md): "study" is its top.
const std::vector<Section>& study_schema();

/// "greater than 0", "from 0 to 1", "at least 0".
std::string range_in_words(const Range& range);

}  // namespace undex::scene
