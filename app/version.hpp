// Which program this is.
#pragma once

#include <string>

namespace undex::app {

/// "0.2.0".
std::string version_number();
/// One line: version, commit where known, compiler, build type, instruction set of the pair loops.
std::string version_line();
/// The same as a JSON object.
std::string version_json();

/// What the digits of a run depend on beside its scene: the version of the numerics, compiler, build type and instruction set.
std::string numerics_line();

}  // namespace undex::app
