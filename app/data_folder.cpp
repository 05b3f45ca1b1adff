#include "app/data_folder.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

#include "core/errors.hpp"

namespace undex::app {
namespace fs = std::filesystem;

fs::path data_folder() {
  std::error_code error;
  const auto holds_scenes = [&](const fs::path& folder) { return fs::is_directory(folder / "cases", error); };
  if (const char* given = std::getenv("UNDEX_DATA"); given && *given) {
    if (!holds_scenes(given))
      throw FileError(std::string("UNDEX_DATA names ") + given +
                      ", which has no folder cases; name the folder share/undex of an "
                      "installed program, or the project's source tree");
    return given;
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (const fs::path installed = program.parent_path().parent_path() / "share" / "undex"; holds_scenes(installed))
    return installed;
  if (const fs::path source = UNDEX_SOURCE_FOLDER; holds_scenes(source)) return source;
  throw FileError("what the program carries (cases, docs, post) is neither in share/undex beside " +
                  program.parent_path().string() +
                  " nor in " UNDEX_SOURCE_FOLDER "; name its folder by the environment variable UNDEX_DATA");
}

}  // namespace undex::app
