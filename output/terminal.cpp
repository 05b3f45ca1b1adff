#include "output/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "output/text_table.hpp"

namespace undex::output {
namespace {

const char* code_of(Ink ink) {
  switch (ink) {
    case Ink::bold: return "\033[1m";
    case Ink::dim: return "\033[2m";
    case Ink::good: return "\033[32m";
    case Ink::notice: return "\033[33m";
    case Ink::bad: return "\033[1;31m";
  }
  return "";
}

}  // namespace

bool on_terminal() {
  static const bool is = isatty(STDOUT_FILENO) != 0;
  return is;
}

int terminal_width() {
  winsize size{};
  return on_terminal() && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 100;
}

bool in_colour() {
  static const bool is = [] {
    const char *refused = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
    return on_terminal() && !(refused && *refused) && kind && *kind && std::string_view(kind) != "dumb";
  }();
  return is;
}

std::string inked(const std::string& text, Ink ink) { return in_colour() ? code_of(ink) + text + "\033[0m" : text; }

void LiveLine::show(const std::string& text) {
  if (!on_terminal()) return;
  std::string cut = text;
  while (!cut.empty() && int(width(cut)) >= terminal_width()) cut.pop_back();
  std::printf("\r\033[K%s", cut.c_str());
  std::fflush(stdout);
  shown_ = true;
}

void LiveLine::clear() {
  if (shown_) std::printf("\r\033[K");
  shown_ = false;
}

}  // namespace undex::output
