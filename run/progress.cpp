#include "run/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "output/text_table.hpp"

namespace undex::run {
namespace {

constexpr double line_interval = 5.0, line_interval_on_terminal = 30.0;  // [s] of wall time
constexpr double bar_interval = 0.2;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string percent(double share) { return output::print("%+.2g %%", 100 * share); }

}  // namespace

Progress::Progress(double start_time, double end_time, int verbosity)
    : start_time_(start_time),
      end_time_(end_time),
      verbosity_(verbosity),
      start_(Clock::now()),
      last_line_(start_),
      last_bar_(start_) {}

void Progress::report(const Simulation& simulation) {
  if (verbosity_ < 0) return;
  if (first_steps_ < 0) first_steps_ = last_steps_ = simulation.steps() - 1;
  const Clock::time_point now = Clock::now();
  if (verbosity_ > 0 || seconds(now - last_line_) >= (output::on_terminal() ? line_interval_on_terminal : line_interval)) {
    live_.clear();
    line(simulation);
  }
  if (output::on_terminal() && seconds(now - last_bar_) >= bar_interval) {
    last_bar_ = now;
    live_.show(bar(simulation));
  }
}

void Progress::finish(const Simulation& simulation) {
  if (verbosity_ < 0) return;
  live_.clear();
  if (last_steps_ != simulation.steps()) line(simulation);
}

double Progress::share(const Simulation& simulation) const {
  return (simulation.time() - start_time_) / (end_time_ - start_time_);
}

std::string Progress::left(const Simulation& simulation) const {
  const double done = share(simulation);
  return done > 0 ? output::duration(seconds(Clock::now() - start_) * (1 - done) / done) : "?";
}

void Progress::line(const Simulation& simulation) {
  if (!header_shown_) {
    char header[160];
    std::snprintf(header, sizeof header, "\n%8s  %-10s  %-10s  %-36s  %12s  %12s  %8s  %10s", "step", "time", "step size",
                  "set by", "energy error", "largest p", "steps/s", "left");
    std::printf("%s\n", output::inked(header, output::Ink::dim).c_str());
    header_shown_ = true;
  }
  const Clock::time_point now = Clock::now();
  const double since = std::max(1e-9, seconds(now - last_line_));
  std::printf("%8ld  %-10s  %-10s  %-36.36s  %12s  %12s  %8.1f  %10s\n", simulation.steps(),
              output::with_unit(simulation.time(), "s").c_str(), output::with_unit(simulation.last_step_size(), "s").c_str(),
              simulation.last_step().c_str(), percent(simulation.energy().error()).c_str(),
              output::with_unit(simulation.maximum_pressure(), "Pa").c_str(), (simulation.steps() - last_steps_) / since,
              left(simulation).c_str());
  std::fflush(stdout);
  last_line_ = now;
  last_steps_ = simulation.steps();
}

std::string Progress::bar(const Simulation& simulation) {
  constexpr int length = 16;
  const double done = share(simulation), since = std::max(1e-9, seconds(Clock::now() - start_));
  const int filled = std::clamp(int(done * length), 0, length);
  char text[400];
  std::snprintf(text, sizeof text, "[%s%s] %3.0f %%  %s left  energy %s  %.4g/s  step %s at %s  dt %s by %s",
                std::string(std::size_t(filled), '#').c_str(), std::string(std::size_t(length - filled), '.').c_str(), 100 * done,
                left(simulation).c_str(), percent(simulation.energy().error()).c_str(),
                double(simulation.steps() - first_steps_) / since, output::grouped(simulation.steps()).c_str(),
                output::with_unit(simulation.time(), "s").c_str(), output::with_unit(simulation.last_step_size(), "s").c_str(),
                simulation.last_step().c_str());
  return text;
}

}  // namespace undex::run
