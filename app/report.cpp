#include "app/report.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "app/data_folder.hpp"
#include "core/errors.hpp"

namespace undex::app {
namespace {
namespace fs = std::filesystem;

const char* const python = "/usr/bin/python3";  // Debian's own, which has Debian's NumPy, h5py and Matplotlib

/// Starts the package by its name with these arguments, without a shell, in place of this program.
int become_package(const std::vector<std::string>& arguments) {
  const fs::path folder = data_folder() / "post";
  std::error_code error;
  if (!fs::is_regular_file(folder / "undex_post" / "__main__.py", error))
    throw FileError((folder / "undex_post").string() + ": the Python package of reports is missing; install the program again");
  if (access(python, X_OK) != 0)
    throw FileError(std::string(python) + " is missing; reports and pictures need it: apt-get install python3 python3-numpy " +
                    "python3-h5py python3-matplotlib libjs-dygraphs");
  std::string path = folder.string();
  if (const char* given = std::getenv("PYTHONPATH"); given && *given) path += std::string(":") + given;
  setenv("PYTHONPATH", path.c_str(), 1);
  // -P: modules of the present folder do not count; -B: nothing is written beside the package.
  std::vector<std::string> words{python, "-P", "-B", "-m", "undex_post"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  std::fflush(nullptr);
  execv(python, pointers.data());
  throw FileError(std::string(python) + " cannot be started: " + std::strerror(errno));
}

void add_folders(std::vector<std::string>& words, const std::vector<fs::path>& folders) {
  words.emplace_back("--");  // a folder may begin with a hyphen
  for (const fs::path& folder : folders) words.push_back(folder.string());
}

}  // namespace

int write_report(const ReportArguments& arguments) {
  std::error_code error;
  std::vector<std::string> words{"report", "--undex", fs::read_symlink("/proc/self/exe", error).string()};
  if (!arguments.output.empty()) words.insert(words.end(), {"-o", arguments.output.string()});
  add_folders(words, arguments.folders);
  return become_package(words);
}

int draw_plots(const PlotArguments& arguments) {
  std::vector<std::string> words{"plot"};
  if (!arguments.times.empty()) words.insert(words.end(), {"--times", arguments.times});
  if (arguments.dpi > 0) words.insert(words.end(), {"--dpi", std::to_string(arguments.dpi)});
  add_folders(words, arguments.folders);
  return become_package(words);
}

}  // namespace undex::app
