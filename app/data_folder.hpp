// Where the program finds what it carries beside itself: the scenes shipped, the documentation, the Python package of reports.
#pragma once

#include <filesystem>

namespace undex::app {

/// The folder with cases/, docs/ and post/: $UNDEX_DATA where that is set, share/undex beside the folder of the program (an
/// installed one), or the source tree that the program was built from.
/// @throws FileError where none of these is there, with what was tried and the remedy.
std::filesystem::path data_folder();

}  // namespace undex::app
