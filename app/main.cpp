// The command-line program: arguments in, exit code out, every mistake reported in one place.
#include <CLI/CLI.hpp>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "app/commands.hpp"
#include "app/help.hpp"
#include "app/new_scene.hpp"
#include "app/report.hpp"
#include "app/shell_words.hpp"
#include "app/version.hpp"
#include "core/errors.hpp"
#include "core/last_words.hpp"
#include "judge/rejudge.hpp"
#include "run/run.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"
#include "study/compare_runs.hpp"
#include "study/study.hpp"

namespace {

using namespace undex;
using namespace undex::app;

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("scene", arguments.scene, "scene file (.toml), a folder with case.toml, or the name of a shipped scene")
      ->required();
  command
      .add_option_function<std::string>(
          "-P,--set", [&](const std::string& text) { arguments.overrides.push_back(text); },
          "key=value: override a key of the scene by its dotted path; may be repeated")
      ->trigger_on_parse();
  command
      .add_option_function<std::string>(
          "--tend", [&](const std::string& text) { arguments.overrides.push_back("end_time=" + text); }, "end time [s]")
      ->trigger_on_parse();
  command.add_option("-j,--threads", arguments.threads, "threads; 0: the scene's choice, or all the machine has")
      ->check(CLI::Range(0, 4096));
}

int print_text(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return exit_done;
}

int dispatch(int argc, char** argv) {
  CLI::App program("Close-in underwater explosions: SPH water coupled to a deforming structure", "undex");
  program.require_subcommand(1);

  RunArguments run_arguments;
  CLI::App* run = program.add_subcommand("run", "compute a scene");
  add_scene_arguments(*run, run_arguments);
  run->add_option("-o,--output", run_arguments.output, "output folder; default: out/<scene name>");
  CLI::Option* quiet = run->add_flag_callback(
      "-q,--quiet", [&] { run_arguments.verbosity = -1; }, "print nothing but errors");
  run->add_flag_callback(
         "-v,--verbose", [&] { run_arguments.verbosity = 1; }, "print every step")
      ->excludes(quiet);
  run->add_flag("--force", run_arguments.force, "write into an output folder that is not empty");
  run->footer(
      "Examples:\n"
      "  undex run cases/rigid_cylinder\n"
      "  undex run my_tube -o out/fine -P resolution.spacing=\"0.5 mm\"\n"
      "  undex run my_tube --tend \"60 us\" -j 4");

  ResumeArguments resume_arguments;
  CLI::App* resume =
      program.add_subcommand("resume", "go on with a run that was cut, from its newest checkpoint, to the same bits");
  resume->add_option("run", resume_arguments.folder, "output folder of the run")->required()->type_name("RUN");
  resume
      ->add_option_function<std::string>(
          "-P,--set", [&](const std::string& text) { resume_arguments.overrides.push_back(text); },
          "key=value: what does not touch the state may change: output, comparison, threads, end_time, new probes")
      ->trigger_on_parse();
  resume
      ->add_option_function<std::string>(
          "--tend", [&](const std::string& text) { resume_arguments.overrides.push_back("end_time=" + text); },
          "a later end time [s]")
      ->trigger_on_parse();
  resume->add_option("-j,--threads", resume_arguments.threads, "threads; 0: the scene's choice, or all the machine has")
      ->check(CLI::Range(0, 4096));
  CLI::Option* quiet_resume = resume->add_flag_callback(
      "-q,--quiet", [&] { resume_arguments.verbosity = -1; }, "print nothing but errors");
  resume
      ->add_flag_callback(
          "-v,--verbose", [&] { resume_arguments.verbosity = 1; }, "print every step")
      ->excludes(quiet_resume);
  resume->footer(
      "Exit code 4: the checkpoints do not fit (damaged, another program or machine, a changed scene): undex help outputs.\n"
      "Example:\n  undex resume out/fine --tend \"200 us\"");

  CheckArguments check_arguments;
  CLI::App* check = program.add_subcommand(
      "check", "read a scene and say what its run would be; write nothing but a picture that is asked for");
  add_scene_arguments(*check, check_arguments);
  check->add_option("--picture", check_arguments.picture, "draw the scene at its start in this .svg")->type_name("FILE");
  check->footer("Example:\n  undex check my_tube --picture scene.svg -P resolution.spacing=\"2 mm\"");

  judge::RejudgeOptions judge_options;
  CLI::App* judgement = program.add_subcommand(
      "judge", "judge a finished run again from what it has left: a changed definition or reference needs no new run");
  judgement->add_option("run", judge_options.run, "output folder of the run")->required()->type_name("RUN");
  judgement->add_option("--reference", judge_options.reference,
                        "CSV in place of the scene's reference: a table of metrics, or a reference history");
  judgement->add_flag("-q,--quiet", judge_options.quiet, "print nothing but errors");
  judgement->footer(
      "Rewrites the metrics in summary.json (and profile.csv); nothing else changes. Definitions: undex help outputs");

  study::CompareOptions compare_options;
  CLI::App* comparison = program.add_subcommand(
      "compare",
      "finished runs beside each other: histories at common times, energies, errors, cost, and how far each is from the first");
  comparison
      ->add_option("runs", compare_options.runs,
                   "output folders of two runs or more; the first is what the others are compared with")
      ->required()
      ->expected(2, -1)
      ->type_name("RUN");
  comparison->add_option("--reference", compare_options.reference,
                         "CSV: a table of metrics (cases/*/reference), or a history with the header time [s],pressure [Pa],...");
  comparison->add_option("--at", compare_options.times,
                         "times of the table's rows [us], such as 20,40,60; default: the reference table's, else round ones");
  comparison->add_option("--label", compare_options.labels,
                         "names of the runs, such as FEM,SPH; default: the settings that tell them apart");
  comparison->add_option("-o,--output", compare_options.output, "output folder; default: out/compare");
  comparison->add_flag("--force", compare_options.force, "write into an output folder that is not empty");
  comparison->footer(
      "Writes comparison.csv (the table) and curves.csv, which undex plot DIR draws. What is compared, and "
      "how: undex help outputs");

  study::StudyOptions study_options;
  CLI::App* study_command = program.add_subcommand(
      "study", "a grid of runs from one study file: errors, observed orders and cost in one table; goes on where it was ended");
  study_command->add_option("study", study_options.study, "study file (.toml), or a folder with study.toml")->required();
  study_command->add_option("-o,--output", study_options.output, "output folder; default: the study's, else out/study_<name>");
  study_command->add_option("-j,--jobs", study_options.jobs, "runs at a time (each with the study's threads, by default one)")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  study_command
      ->add_option("--only", study_options.only, "only runs whose name has this in it, or matches it (* and ?); may be repeated")
      ->type_name("PATTERN")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  study_command->add_flag("--list", study_options.list,
                          "say which runs there are, which are there and which would be run; write nothing");
  study_command->add_flag("--again", study_options.again, "run also what is there");
  CLI::Option* table = study_command->add_flag("--table", study_options.table, "write the tables of what is there; run nothing");
  CLI::Option* shard =
      study_command
          ->add_option_function<std::string>(
              "--shard", [&](const std::string& text) { study_options.shard = study::shard_of(text); },
              "only the I-th of N shares of the runs; others compute theirs in the same folder, at the same time")
          ->type_name("I/N")
          ->excludes(table);
  study_command
      ->add_option_function<int>(
          "--slurm", [&](int shards) { study_options.slurm = shards; },
          "write study.slurm, a job array of N shards (0: one for each run that is not there), and run nothing")
      ->type_name("N")
      ->check(CLI::Range(0, 100000))
      ->excludes(table)
      ->excludes(shard);
  study_command->add_flag("-q,--quiet", study_options.quiet, "print nothing but errors");
  study_command->footer(
      "Writes study.csv (a row a run), order.csv (observed orders) and a folder a run, of which undex report DIR makes a page. "
      "The study file: undex help studies");

  ReportArguments report_arguments;
  CLI::App* report =
      program.add_subcommand("report", "write one HTML file about a run, about several beside each other, or about a study");
  report->add_option("folders", report_arguments.folders, "output folders of runs, or of one study")
      ->required()
      ->type_name("RUN");
  report->add_option("-o,--output", report_arguments.output, "the file; default: report.html in the folder, of several runs here")
      ->type_name("FILE");
  report->footer(
      "Needs python3-numpy, python3-h5py, python3-matplotlib and libjs-dygraphs. What it shows: docs/reference/report.md");

  PlotArguments plot_arguments;
  CLI::App* plot = program.add_subcommand("plot", "draw pictures/*.png of a run, a study or a comparison into its folder");
  plot->add_option("folders", plot_arguments.folders, "output folders of runs, studies and comparisons")
      ->required()
      ->type_name("RUN");
  plot->add_option("--times", plot_arguments.times, "times of the mid-plane's pictures [us], such as 15,30");
  plot->add_option("--dpi", plot_arguments.dpi, "resolution of the pictures")->check(CLI::Range(30, 600));

  MaterialsArguments materials_arguments;
  CLI::App* materials = program.add_subcommand(
      "materials", "the named material sets: values in SI units, source, grade, where they may be used, states of detonation");
  materials->add_option("name", materials_arguments.name, "only this set")->type_name("NAME");
  materials->add_option("--kind", materials_arguments.kind, "only those of a kind: water, explosive, gas or metal");
  materials->add_flag("--json", materials_arguments.json, "as a JSON array of objects");
  materials->footer(
      "Grades: A read in an established code, data file or paper with its citation; B in an established code without one; C a "
      "community's set, or recalled from a named paper; D without reference, assumed in part, or contradicting itself. An "
      "explosive is unverified where a listed speed or pressure of detonation is over 2 % off its own Chapman-Jouguet state.");
  std::string page;
  CLI::App* keys =
      program.add_subcommand("keys", "write the tables of a scene's keys into a page, docs/reference/scene-file.md")->group("");
  keys->add_option("page", page, "the page; its marks say which table goes where")->required();
  std::string topic;
  CLI::App* help = program.add_subcommand("help", "what the documentation says of a command, a page, or a key of a scene");
  help->add_option("topic", topic, "such as run, tutorial, scheme or scheme.kernel; none: the topics")->type_name("TOPIC");
  help->footer("Examples:\n  undex help\n  undex help plate\n  undex help resolution.spacing");
  std::string template_name;
  std::filesystem::path new_folder;
  CLI::App* new_command = program.add_subcommand("new", "copy a scene that works into a folder, to begin from");
  new_command->add_option("template", template_name, "such as plate or rigid_cylinder; none: which there are")->type_name("NAME");
  new_command->add_option("folder", new_folder, "the new folder; default: the template's name")->type_name("FOLDER");
  new_command->footer("Example:\n  undex new tube my_tube && undex check my_tube");
  std::string shell;
  CLI::App* completion = program.add_subcommand("completion", "print the script with which bash, zsh or fish completes undex");
  completion->add_option("shell", shell, "bash, zsh or fish")->required()->type_name("SHELL");
  completion->footer("Example:\n  source <(undex completion bash)");
  CLI::App* manual = program.add_subcommand("manual", "print the man page, in troff")->group("");
  CLI::App* list = program.add_subcommand("list", "the scenes shipped");
  CLI::App* version = program.add_subcommand("version", "version, compiler, instruction set");
  bool json = false;
  version->add_flag("--json", json, "as a JSON object");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? exit_done : exit_usage;  // prints help or what is wrong
  }
  if (const std::string wrong = sph::wrong_cpu_level(); !wrong.empty()) throw UsageError(wrong);
  if (*run) return run_scene(run_arguments);
  if (*resume) return resume_run(resume_arguments);
  if (*check) return check_scene(check_arguments);
  if (*judgement) {
    judge::rejudge(judge_options);
    return exit_done;
  }
  if (*comparison) {
    study::compare_runs(compare_options);
    return exit_done;
  }
  if (*study_command) {
    study_options.program = version_line();
    study_options.study = shipped_or_own(study_options.study);
    return study::run_study(study_options);
  }
  if (*report) return write_report(report_arguments);
  if (*plot) return draw_plots(plot_arguments);
  if (*materials) return print_materials(materials_arguments);
  if (*keys) return write_keys(page);
  if (*list) return list_scenes();
  if (*help) return print_help(program, topic);
  if (*new_command) return new_scene(template_name, new_folder);
  if (*completion) return print_text(completion_script(program, shell));
  if (*manual) return print_text(man_page(program, version_number()));
  if (*version) return print_version(json);
  return exit_usage;
}

int failed(ExitCode code, const char* message) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s\n", message);
  return code;
}

/// Memory may run out where no exception can pass: on one of the threads of a loop, or in what a library does to tidy up. The
/// end is that of any lack of it, with the record of the run. (Out of a loop of threads the exception comes without its name.)
[[noreturn]] void end_where_no_exception_passes() {
  static std::atomic_flag ending;
  while (ending.test_and_set()) pause();  // another thread sees to it
  const char* why = "out of memory, or an internal error where no exception may pass; take a larger spacing, or symmetry planes";
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    why = run::out_of_memory;
  } catch (const std::exception& error) {
    static char text[500];
    std::snprintf(text, sizeof text, "internal error: %s", error.what());
    why = text;
  } catch (...) {
  }
  say_last_words(why);
  failed(exit_internal, why);
  std::_Exit(exit_internal);
}

}  // namespace

int main(int argc, char** argv) {
  // A file that may not grow and a reader of stdout that has left are errors of a write, not ends of the program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::set_terminate(end_where_no_exception_passes);
  try {
    return dispatch(argc, argv);
  } catch (const SceneError& error) {
    return failed(exit_usage, error.what());
  } catch (const UsageError& error) {
    return failed(exit_usage, error.what());
  } catch (const NumericalStop& error) {
    return failed(exit_numerics, (std::string("the numerics stopped the run: ") + error.what()).c_str());
  } catch (const RestartError& error) {
    return failed(exit_restart, error.what());
  } catch (const FileError& error) {
    return failed(exit_internal, error.what());
  } catch (const std::bad_alloc&) {
    failed(exit_internal, run::out_of_memory);
    std::_Exit(exit_internal);  // libraries that tidy up at the end take memory for it
  } catch (const std::exception& error) {
    return failed(exit_internal, (std::string("internal error: ") + error.what()).c_str());
  }
}
