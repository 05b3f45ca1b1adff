// What each command of the program does. Each returns the exit code; mistakes are thrown.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace undex::app {

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::string> overrides;  ///< "key=value"
  int threads = 0;
};

struct RunArguments : SceneArguments {
  std::string output;  ///< empty: out/<scene name>
  int verbosity = 0;
  bool force = false;  ///< an output folder that is not empty may be overwritten
};

/// The path as it is; or, where there is nothing and it is a bare name, the shipped scene of that name.
std::filesystem::path shipped_or_own(const std::filesystem::path& named);

int run_scene(const RunArguments& arguments);
struct ResumeArguments {
  std::filesystem::path folder;
  std::vector<std::string> overrides;
  int threads = 0, verbosity = 0;
};

int resume_run(const ResumeArguments& arguments);
struct CheckArguments : SceneArguments {
  std::filesystem::path picture;  ///< an .svg to draw the scene in; empty: none
};
int check_scene(const CheckArguments& arguments);

struct MaterialsArguments {
  std::string name, kind;  ///< of the sets that are shown; empty: of any
  bool json = false;
};

int print_materials(const MaterialsArguments& arguments);
int write_keys(const std::filesystem::path& page);
int list_scenes();
int print_version(bool json);

}  // namespace undex::app
