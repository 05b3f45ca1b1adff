// undex help: what the documentation says of a topic, on the terminal.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace undex::app {

/// Prints what is known of `topic`: a command's usage, the keys of a table ("scheme", "resolution"), one key ("scheme.kernel"),
/// or a page of the documentation ("tutorial", "plate", "outputs"). Empty: the topics. Returns the exit code.
/// @throws UsageError where nothing of that name is known.
int print_help(const CLI::App& program, const std::string& topic);

}  // namespace undex::app
