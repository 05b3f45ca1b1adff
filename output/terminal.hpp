// What the program shows where somebody watches: colours, and lines that replace themselves. In a file or a pipe neither appears.
#pragma once

#include <string>

namespace undex::output {

enum class Ink { bold, dim, good, notice, bad };

/// Is stdout a terminal?
bool on_terminal();
/// Columns of it; 100 where it does not say.
int terminal_width();
/// Are colours shown? On a terminal, unless NO_COLOR is set (no-color.org) or TERM is "dumb".
bool in_colour();
/// The text in that ink where colours are shown; else the text.
std::string inked(const std::string& text, Ink ink);

/// A line at the bottom of a terminal that replaces the one before; nothing where stdout is none.
class LiveLine {
 public:
  /// Cut to the width of the terminal.
  void show(const std::string& text);
  /// Takes it away, before anything else is printed.
  void clear();

 private:
  bool shown_ = false;
};

}  // namespace undex::output
