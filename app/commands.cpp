#include "app/commands.hpp"

#include <omp.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "app/data_folder.hpp"
#include "app/version.hpp"
#include "core/errors.hpp"
#include "judge/judge.hpp"
#include "output/files.hpp"
#include "output/folder_lock.hpp"
#include "output/run_folder.hpp"
#include "output/terminal.hpp"
#include "output/text_table.hpp"
#include "run/describe.hpp"
#include "run/resume.hpp"
#include "run/run.hpp"
#include "run/trust.hpp"
#include "scene/key_tables.hpp"
#include "scene/scene.hpp"

namespace undex::app {
namespace {

namespace fs = std::filesystem;

std::vector<scene::Override> parsed(const std::vector<std::string>& texts) {
  std::vector<scene::Override> overrides;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw UsageError("-P " + text + ": write key=value, e.g. -P resolution.spacing=0.001");
    const auto trimmed = [](std::string part) {
      const auto first = part.find_first_not_of(" \t");
      if (first == std::string::npos) return std::string();
      return part.substr(first, part.find_last_not_of(" \t") - first + 1);
    };
    overrides.push_back({trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))});
  }
  return overrides;
}

/// Folders that may hold scenes, the nearest first.
std::vector<fs::path> case_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("UNDEX_CASES"); given && *given) folders.emplace_back(given);
  folders.emplace_back("cases");
  try {
    folders.push_back(data_folder() / "cases");
  } catch (const FileError&) {  // a program on its own, without what it carries
  }
  return folders;
}

scene::Scene read_scene(const SceneArguments& arguments) {
  scene::Scene scene = scene::read(shipped_or_own(arguments.scene), judge::comparison_kinds(), parsed(arguments.overrides));
  if (arguments.threads > 0) scene.fluid.numerics.threads = arguments.threads;
  if (scene.fluid.numerics.threads > 0) omp_set_num_threads(scene.fluid.numerics.threads);
  return scene;
}

std::string whole_text(const fs::path& file) {
  if (const auto text = output::text_of(file)) return *text;
  throw FileError(file.string() + ": cannot be read any more; check the file");
}

/// The verdict, its metrics in the record. Where it cannot be had the run has failed, and `undex judge` may try again.
judge::Verdict verdict_of(const judge::Judge& judge, run::Result& result) {
  judge::Verdict verdict;
  if (result.failure) return verdict;
  try {
    verdict = judge.verdict(result.evidence);
  } catch (const std::exception& error) {
    result.failure = std::current_exception();
    result.record.status = "failed";
    result.record.message +=
        (result.record.message.empty() ? "" : "; ") + std::string("computed, but not judged: ") + error.what();
  }
  result.record.metrics = verdict.metrics;
  result.record.missing = verdict.missing;
  return verdict;
}

run::RunOptions options_for(const scene::Scene& scene, const judge::Judge& judge, const fs::path& folder, int verbosity) {
  run::RunOptions options;
  options.output = folder;
  options.threads = scene.fluid.numerics.threads;
  options.verbosity = verbosity;
  options.program = version_line();
  options.numerics = numerics_line();
  options.last_fields = judge.last_fields();
  return options;
}

/// What is computed, from where and to where.
void say_what(const scene::Scene& scene, const run::RunOptions& options) {
  if (options.verbosity < 0) return;
  std::string space = std::to_string(scene.fluid.dimension) + "D";
  if (scene.meridian) space = "about an axis";
  if (scene.geometry == scene::Geometry::spherical) space = "along a radius";
  const int threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  std::printf("%s\n", output::inked(scene.title, output::Ink::bold).c_str());
  std::printf("  %s, to %s, %d thread%s; %s -> %s\n\n", space.c_str(), output::with_unit(scene.end_time, "s").c_str(), threads,
              threads == 1 ? "" : "s", scene.file.c_str(), options.output.c_str());
}

int compute_and_judge(const scene::Scene& scene, const judge::Judge& judge, const run::RunOptions& options) {
  say_what(scene, options);
  run::Result result = run::compute(scene, options);
  const judge::Verdict verdict = verdict_of(judge, result);
  output::write_summary(options.output / "summary.json", result.record);  // first: a full disk must not cost the record
  judge::write_tables(options.output, verdict);
  if (options.verbosity >= 0)
    std::printf("%s%s%s%s%s", run::cost_text(result.record).c_str(), judge.table(verdict.metrics).c_str(),
                judge::missing_text(verdict.missing).c_str(), run::largest_text(result.record).c_str(),
                run::trust_text(result.record.trust).c_str());
  if (result.failure) std::rethrow_exception(result.failure);  // the record is kept all the same
  if (!result.not_saved.empty()) throw FileError(result.not_saved);
  if (result.record.status == "stopped") throw NumericalStop(result.record.message);
  if (result.signal == 0) return exit_done;
  std::fprintf(stderr, "interrupted by %s; to go on: undex resume %s\n", result.record.message.c_str(), options.output.c_str());
  return 128 + result.signal;
}

}  // namespace

fs::path shipped_or_own(const fs::path& named) {
  std::error_code error;
  if (named.empty() || fs::exists(named, error) || named.has_parent_path()) return named;
  for (const fs::path& folder : case_folders())
    if (fs::is_directory(folder / named, error)) return folder / named;
  return named;
}

int run_scene(const RunArguments& arguments) {
  const scene::Scene scene = read_scene(arguments);
  const judge::Judge judge(scene);  // a reference that cannot be read is found now
  const fs::path folder = arguments.output.empty() ? fs::path("out") / scene.name : fs::path(arguments.output);
  run::RunOptions options = options_for(scene, judge, folder, arguments.verbosity);
  if (fs::is_regular_file(scene.file)) options.scene_text = whole_text(scene.file);  // of a pipe nothing is left
  const output::FolderLock lock(folder, "undex run");
  if (!arguments.force && output::is_unfinished_run(folder))
    throw UsageError(folder.string() + " holds an unfinished run: undex resume " + folder.string() +
                     " goes on with it; --force begins anew, and -o names another folder");
  output::require_unused_folder(folder, arguments.force);
  return compute_and_judge(scene, judge, options);
}

int resume_run(const ResumeArguments& arguments) {
  const fs::path& folder = arguments.folder;
  if (std::error_code ignored; !fs::is_directory(folder, ignored))
    throw UsageError(folder.string() + ": no such folder; name the output folder of a run");
  const output::FolderLock lock(folder, "undex resume");
  const run::Continued continued = run::find_checkpoint(folder, numerics_line());
  for (const std::string& warning : continued.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const scene::Scene scene =
      read_scene({.scene = folder / "resolved.toml", .overrides = arguments.overrides, .threads = arguments.threads});
  run::require_same_scene(continued, scene);
  if (run::is_done(folder, continued, scene)) {
    std::printf("%s: done at %s; --tend T goes on to a later end\n", folder.c_str(),
                output::with_unit(continued.checkpoint->title().time, "s").c_str());
    return exit_done;
  }
  const judge::Judge judge(scene);
  run::RunOptions options = options_for(scene, judge, folder, arguments.verbosity);
  options.scene_text = output::text_of(folder / "scene.toml").value_or(scene::to_toml(scene));
  if (continued.checkpoint) options.checkpoint = &*continued.checkpoint;
  if (arguments.verbosity >= 0) std::printf("%s\n", continued.words.c_str());
  return compute_and_judge(scene, judge, options);
}

int check_scene(const CheckArguments& arguments) {
  const scene::Scene scene = read_scene(arguments);
  const judge::Judge needs_its_reference(scene);
  const fs::path& picture = arguments.picture;
  std::string drawing;
  if (!picture.empty() && picture.extension() != ".svg")
    throw FileError(picture.string() + ": pictures are drawn as .svg, which browsers show; name a file with that ending");
  if (!picture.empty() && scene::on_a_line(scene.geometry))
    throw FileError(picture.string() + ": a scene of one coordinate has no plane to draw; leave --picture out");
  std::printf("%s", run::describe(scene, picture.empty() ? nullptr : &drawing).c_str());
  if (picture.empty()) return exit_done;
  std::ofstream file(picture, std::ios::binary);
  if (!(file << drawing).flush()) throw FileError(picture.string() + ": cannot be written; check that you may write it");
  std::printf("picture: %s\n", picture.c_str());
  return exit_done;
}

int write_keys(const fs::path& page) {
  const std::string before = whole_text(page), after = scene::with_key_tables(before, page.string());
  if (after == before) return exit_done;
  std::ofstream file(page, std::ios::binary);
  if (!(file << after).flush()) throw FileError(page.string() + ": cannot be written; check that you may write it");
  return exit_done;
}

int list_scenes() {
  std::map<std::string, std::string> lines;
  for (const fs::path& folder : case_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (!fs::is_regular_file(entry.path() / "case.toml", error)) continue;
      const std::string name = entry.path().filename().string();
      if (lines.contains(name)) continue;
      std::string title;
      try {
        title = scene::read(entry.path(), judge::comparison_kinds()).title;
      } catch (const std::exception&) {
        title = "(cannot be read: undex check says why)";
      }
      char line[400];
      std::snprintf(line, sizeof line, "%-22s %s\n%-22s %s\n", name.c_str(), title.c_str(), "",
                    entry.path().lexically_normal().c_str());
      lines[name] = line;
    }
  }
  if (lines.empty()) throw UsageError("no scenes found; set UNDEX_CASES to the folder that holds them");
  for (const auto& [name, line] : lines) std::printf("%s", line.c_str());
  return exit_done;
}

int print_version(bool json) {
  std::printf("%s\n", (json ? version_json() : version_line()).c_str());
  return exit_done;
}

}  // namespace undex::app
