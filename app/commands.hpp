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

struct CompareArguments {
  std::vector<std::string> runs;  ///< folders of two runs or more
  std::string reference;          ///< CSV; may be empty
  std::string times;              ///< "20,40,60" [us]; empty: chosen
  std::string labels;             ///< "FEM,SPH", one per run; empty: made from what differs
  std::string output = "out/compare";
  bool force = false;
};

struct StudyArguments {
  std::filesystem::path study;
  std::string output;             ///< empty: the study's own choice
  std::vector<std::string> only;  ///< parts of names, or patterns with * and ?; empty: all runs
  int jobs = 1;                   ///< runs at a time
  bool list = false;              ///< say what would be done, and do nothing
  bool again = false;             ///< also what is there
  bool quiet = false;
};

int run_scene(const RunArguments& arguments);
int check_scene(const SceneArguments& arguments);
int compare_runs(const CompareArguments& arguments);
int run_study(const StudyArguments& arguments);
int print_materials();
int list_scenes();
int print_version(bool json);

}  // namespace undex::app
