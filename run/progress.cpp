#include "run/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "output/text_table.hpp"

namespace undex::run {
namespace {

constexpr double line_interval = 5.0;  // [s] of wall time
constexpr double bar_interval = 0.2;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

Progress::Progress(double start_time, double end_time, int verbosity)
    : start_time_(start_time),
      end_time_(end_time),
      verbosity_(verbosity),
      terminal_(isatty(fileno(stdout)) != 0),
      start_(Clock::now()),
      last_line_(start_),
      last_bar_(start_) {}

void Progress::report(const Simulation& simulation) {
  if (verbosity_ < 0) return;
  const Clock::time_point now = Clock::now();
  if (verbosity_ > 0 || seconds(now - last_line_) >= line_interval) {
    clear_bar();
    line(simulation);
  }
  if (terminal_ && seconds(now - last_bar_) >= bar_interval) {
    last_bar_ = now;
    const double share = (simulation.time() - start_time_) / (end_time_ - start_time_);
    bar(share, share > 0 ? seconds(now - start_) * (1 - share) / share : 0.0);
  }
}

void Progress::finish(const Simulation& simulation) {
  if (verbosity_ < 0) return;
  clear_bar();
  if (last_steps_ != simulation.steps()) line(simulation);
}

void Progress::line(const Simulation& simulation) {
  if (!header_shown_) {
    std::printf("%7s %11s %10s  %-34s %10s %12s %9s %10s\n", "step", "time [us]", "dt [us]", "set by", "energy err",
                "p max [GPa]", "steps/s", "left");
    header_shown_ = true;
  }
  const Clock::time_point now = Clock::now();
  const double elapsed = seconds(now - start_);
  const double share = (simulation.time() - start_time_) / (end_time_ - start_time_);
  const double since = std::max(1e-9, seconds(now - last_line_));
  std::printf("%7ld %11.4f %10.5f  %-34.34s %+10.2e %12.4f %9.1f %10s\n", simulation.steps(), simulation.time() * 1e6,
              simulation.last_step_size() * 1e6, simulation.last_step().c_str(), simulation.energy().error(),
              simulation.maximum_pressure() * 1e-9, (simulation.steps() - last_steps_) / since,
              share > 0 ? output::duration(elapsed * (1 - share) / share).c_str() : "?");
  std::fflush(stdout);
  last_line_ = now;
  last_steps_ = simulation.steps();
}

void Progress::bar(double share, double seconds_left) {
  constexpr int width = 40;
  const int filled = std::clamp(int(share * width), 0, width);
  std::printf("\r[%s%s] %5.1f %%, %s left   ", std::string(filled, '#').c_str(), std::string(width - filled, ' ').c_str(),
              100 * share, output::duration(seconds_left).c_str());
  std::fflush(stdout);
  bar_shown_ = true;
}

void Progress::clear_bar() {
  if (bar_shown_) std::printf("\r%80s\r", "");
  bar_shown_ = false;
}

}  // namespace undex::run
