#include "app/shell_words.hpp"

#include <sstream>
#include <vector>

#include "core/errors.hpp"
#include "scene/suggestion.hpp"

namespace undex::app {
namespace {

/// Options with a name; positional words have none.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  return command.get_options(
      [](const CLI::Option* option) { return !option->get_lnames().empty() || !option->get_snames().empty(); });
}

/// "--output -o".
std::string names_of(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : " --") + name;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : " -") + name;
  return names;
}

std::string bash_script(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(program)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    std::string options;
    for (const CLI::Option* option : options_of(*command)) options += (options.empty() ? "" : " ") + names_of(*option);
    cases += "    " + command->get_name() + ") options=\"" + options + "\" ;;\n";
  }
  return "# Completion of undex for bash; zsh loads it by bashcompinit.\n"
         "_undex() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} options=\n"
         "  if ((COMP_CWORD == 1)); then\n"
         "    COMPREPLY=($(compgen -W \"" +
         commands +
         " --help\" -- \"$word\"))\n"
         "    return\n"
         "  fi\n"
         "  case ${COMP_WORDS[1]} in\n" +
         cases +
         "  esac\n"
         "  if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
         "  elif [[ ${COMP_WORDS[1]} == help && $COMP_CWORD == 2 ]]; then COMPREPLY=($(compgen -W \"" +
         commands +
         "\" -- \"$word\"))\n"
         "  else COMPREPLY=($(compgen -f -- \"$word\")); compopt -o filenames 2>/dev/null\n"
         "  fi\n"
         "}\n"
         "complete -F _undex undex\n";
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("\\'") : std::string(1, c);
  return result + "'";
}

std::string fish_script(const CLI::App& program) {
  std::string text = "# Completion of undex for fish.\n";
  for (const CLI::App* command : commands_of(program)) {
    text += "complete -c undex -n __fish_use_subcommand -f -a " + command->get_name() + " -d " +
            quoted(command->get_description()) + "\n";
    for (const CLI::Option* option : options_of(*command)) {
      text += "complete -c undex -n '__fish_seen_subcommand_from " + command->get_name() + "'";
      for (const std::string& name : option->get_lnames()) text += " -l " + name;
      for (const std::string& name : option->get_snames()) text += " -s " + name;
      text += std::string(option->get_items_expected_max() > 0 ? " -r" : "") + " -d " + quoted(option->get_description()) + "\n";
    }
  }
  return text;
}

/// Text of troff: hyphens that are typed, no line that begins with a control character.
std::string troff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '-') result += "\\-";
    else if (c == '\\') result += "\\e";
    else if ((c == '.' || c == '\'') && (result.empty() || result.back() == '\n')) result += std::string("\\&") + c;
    else result += c;
  }
  return result;
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string completion_script(const CLI::App& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  if (shell == "zsh") return "#compdef undex\nautoload -U +X bashcompinit && bashcompinit\n" + bash_script(program);
  if (shell == "fish") return fish_script(program);
  throw UsageError("no completion for the shell '" + shell + "'" + scene::suggestion(shell, {"bash", "zsh", "fish"}));
}

std::string man_page(const CLI::App& program, const std::string& version) {
  std::string text = ".TH UNDEX 1 \"\" \"undex " + troff(version) + "\" \"User commands\"\n";
  text += ".SH NAME\nundex \\- " + troff(program.get_description()) + "\n";
  text += ".SH SYNOPSIS\n.B undex\n.I command\n[options]\n.SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) {
    std::string usage;
    for (const CLI::Option* word : command->get_options([](const CLI::Option* option) { return option->get_positional(); }))
      usage += " " + word->get_name(true);
    text += ".SS undex " + troff(command->get_name() + usage) + "\n" + troff(command->get_description()) + "\n";
    for (const CLI::Option* option : options_of(*command)) {
      if (names_of(*option).find("--help") != std::string::npos) continue;
      text += ".TP\n.B " + troff(names_of(*option)) + "\n" + troff(option->get_description()) + "\n";
    }
    if (const std::string& more = command->get_footer(); !more.empty()) text += ".PP\n.nf\n" + troff(more) + "\n.fi\n";
  }
  text +=
      ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nan internal error, or a file\n.TP\n2\na wrong command line or scene\n.TP\n3\n"
      "the numerics stopped the run\n.TP\n4\na run cannot be gone on with\n.TP\n128 + n\nended by signal n; what was computed is "
      "kept\n";
  text +=
      ".SH ENVIRONMENT\n.TP\nOMP_NUM_THREADS\nthreads, where neither the scene nor \\-j "
      "says\n.TP\nUNDEX_CPU_LEVEL\nx86\\-64\\-v2, "
      "\\-v3 or \\-v4: an instruction set below the machine's\n.TP\nUNDEX_CASES\na folder with scenes for undex "
      "list\n.TP\nUNDEX_DATA\nthe "
      "folder of what the program carries\n.TP\nNO_COLOR\nno colours\n";
  return text + ".SH SEE ALSO\nundex help, and the pages that it lists\n";
}

}  // namespace undex::app
