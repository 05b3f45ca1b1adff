// Which program this is.
#pragma once

#include <string>

namespace undex::app {

/// One line: version, commit where known, compiler, build type, instruction set of the pair loops.
std::string version_line();
/// The same as a JSON object.
std::string version_json();

}  // namespace undex::app
