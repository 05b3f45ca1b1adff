// What shells and man know of the program, made from its own description of its command line, so that neither can go stale.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace undex::app {

/// The commands that the program tells of.
std::vector<const CLI::App*> commands_of(const CLI::App& program);

/// A script that completes commands, options, scenes and files, for "bash", "zsh" or "fish". Throws UsageError for another shell.
std::string completion_script(const CLI::App& program, const std::string& shell);

/// The man page undex(1) in troff, with every command and option.
std::string man_page(const CLI::App& program, const std::string& version);

}  // namespace undex::app
