// A scene computed by a program of one's own: scene FILE OUTPUT.
#include <cstdio>
#include <exception>

#include "output/folder_lock.hpp"
#include "run/run.hpp"
#include "scene/scene.hpp"

int main(int count, char** words) try {
  if (count != 3) return 2;
  const undex::output::FolderLock lock(words[2], "scene");
  const undex::run::Result result =
      undex::run::compute(undex::scene::read(words[1], {}), {.output = words[2], .threads = 1, .verbosity = -1});
  std::printf("status %s\ntime %.6e\nparticles %lld\ncells %lld\nenergy error %.2e\n", result.record.status.c_str(),
              result.record.time_s, static_cast<long long>(result.record.particles), static_cast<long long>(result.record.cells),
              result.record.energy_error);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
