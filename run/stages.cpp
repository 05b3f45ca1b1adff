#include "run/stages.hpp"

#include <cstdio>

#include "output/text_table.hpp"

namespace undex::run {
namespace {

constexpr std::size_t name_columns = 16, result_columns = 84;

}  // namespace

std::string short_time(double seconds) { return seconds < 9.95 ? output::print("%.1f s", seconds) : output::duration(seconds); }

void Stages::begin(const std::string& name) {
  if (quiet_) return;
  name_ = name;
  since_ = std::chrono::steady_clock::now();
  next_ = output::on_terminal() ? 0.5 : 10.0;
}

double Stages::elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count(); }

bool Stages::due() const { return !quiet_ && elapsed() >= next_; }

void Stages::say(const std::string& words) {
  const std::string line = "  " + output::padded_right(name_, name_columns) + "  " + words;
  if (output::on_terminal()) live_.show(line);
  else std::printf("%s ...\n", line.c_str());
  std::fflush(stdout);
  next_ = elapsed() + (output::on_terminal() ? 0.2 : 10.0);
}

void Stages::end(const std::string& result) {
  if (quiet_) return;
  live_.clear();
  std::printf("  %s  %s  %s\n", output::padded_right(name_, name_columns).c_str(),
              output::padded_right(result, result_columns).c_str(),
              output::inked(output::padded_left(short_time(elapsed()), 8), output::Ink::dim).c_str());
  std::fflush(stdout);
}

}  // namespace undex::run
