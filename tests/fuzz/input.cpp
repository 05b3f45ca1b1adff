#include "tests/fuzz/input.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace undex::fuzz {

namespace fs = std::filesystem;

const fs::path& scratch() {
  static const struct Folder {
    fs::path path = (fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                    ("undex_fuzz_" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  } folder;
  return folder.path;
}

fs::path written(const std::string& name, std::string_view text) {
  const fs::path path = scratch() / name;
  std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
  return path;
}

const std::vector<fs::path>& shipped_scenes() {
  static const std::vector<fs::path> scenes = [] {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(UNDEX_ROOT) / "cases"))
      if (entry.path().extension() == ".toml" && entry.path().filename() != "study.toml") found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }();
  return scenes;
}

void require(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", claim);
  std::abort();
}

}  // namespace undex::fuzz
