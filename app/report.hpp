// What runs leave behind, drawn and written up by the Python package undex_post.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace undex::app {

struct ReportArguments {
  std::vector<std::filesystem::path> folders;  ///< of runs, or of one study
  std::filesystem::path output;  ///< the .html; empty: report.html in the folder, of several runs in the present one
};

struct PlotArguments {
  std::vector<std::filesystem::path> folders;  ///< of runs, studies, comparisons
  std::string times;                           ///< of the mid-plane's pictures [us], "15,30"; empty: those usual
  int dpi = 0;                                 ///< 0: the package's own
};

/// Become the package, in place of this program: they do not return where it can be started.
/// @throws FileError where Python or the package is missing, with the remedy.
int write_report(const ReportArguments& arguments);
int draw_plots(const PlotArguments& arguments);

}  // namespace undex::app
