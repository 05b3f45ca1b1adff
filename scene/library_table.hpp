// The library's sets as a table of docs/reference/scene-file.md.
#pragma once

#include <string>

namespace undex::scene {

/// A row a set: name, kind, law, grade, pressures, and the state of detonation of explosives.
std::string library_table();

}  // namespace undex::scene
