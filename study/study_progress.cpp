#include "study/study_progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/constants.hpp"
#include "output/text_table.hpp"

namespace undex::study {
namespace {

std::string left_text(double seconds) { return std::isnan(seconds) ? "" : "about " + output::duration(seconds) + " left"; }

std::size_t terminal_width() {
  winsize size{};
  return ioctl(fileno(stdout), TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

RunTimes::RunTimes(const scene::Study& study, const std::vector<StudyRow>& rows) {
  struct Known {
    double h, factor;
  };
  std::map<std::string, Known> curves;
  std::vector<double> all;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    weights_.push_back(std::isnan(rows[r].h) ? 1.0 : std::pow(rows[r].h, -(study.runs[r].dimension + 1)));
    if (rows[r].wall_times.empty() || rows[r].status != "done") continue;
    const double factor = *std::min_element(rows[r].wall_times.begin(), rows[r].wall_times.end()) / weights_[r];
    all.push_back(factor);
    const auto [known, fresh] = curves.emplace(rows[r].curve, Known{rows[r].h, factor});
    if (!fresh && !(rows[r].h >= known->second.h)) known->second = {rows[r].h, factor};
  }
  for (const StudyRow& row : rows) {
    const auto known = curves.find(row.curve);
    factors_.push_back(known == curves.end() ? nan : known->second.factor);
  }
  std::sort(all.begin(), all.end());
  median_ = all.empty() ? nan : all[all.size() / 2];
}

double RunTimes::expected(std::size_t run) const { return weights_[run] * (std::isnan(factors_[run]) ? median_ : factors_[run]); }

StudyProgress::StudyProgress(std::size_t to_compute, bool quiet)
    : total_(to_compute), quiet_(quiet), terminal_(isatty(fileno(stdout)) != 0), start_(Clock::now()), last_(start_) {}

void StudyProgress::line(const StudyRow& row, const std::vector<std::string>& errors, double seconds_left) {
  ++ended_;
  if (quiet_) return;
  clear();
  std::string text = counted() + row.name + ": " + row.status;
  if (!row.cpu_times.empty())
    text += ", " + output::print("%.4g", *std::min_element(row.cpu_times.begin(), row.cpu_times.end())) + " s CPU";
  const auto known = std::find_if(row.errors.begin(), row.errors.end(), [](double error) { return !std::isnan(error); });
  if (known != row.errors.end())
    text += ", " + errors[std::size_t(known - row.errors.begin())] + " " + output::print("%.3g", *known);
  if (row.status != "done") text += ": " + row.message;
  if (ended_ < total_ && !std::isnan(seconds_left)) text += "; " + left_text(seconds_left);
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

bool StudyProgress::bar_is_due() const {
  return !quiet_ && terminal_ && std::chrono::duration<double>(Clock::now() - last_).count() > 0.2;
}

void StudyProgress::bar(const std::vector<std::string>& running, double seconds_left) {
  const Clock::time_point now = Clock::now();
  last_ = now;
  std::string text = counted() + output::duration(std::chrono::duration<double>(now - start_).count());
  if (const std::string left = left_text(seconds_left); !left.empty()) text += ", " + left;
  for (std::size_t i = 0; i < running.size(); ++i) text += (i == 0 ? ": " : ", ") + running[i];
  const std::size_t columns = terminal_width() - 1;
  if (text.size() > columns) text = text.substr(0, columns - 3) + "...";
  std::printf("\r\033[K%s", text.c_str());
  std::fflush(stdout);
  shown_ = true;
}

std::string StudyProgress::counted() const {
  std::string text(1, '[');
  return text.append(std::to_string(ended_)).append("/").append(std::to_string(total_)).append("] ");
}

void StudyProgress::clear() {
  if (shown_) std::printf("\r\033[K");
  shown_ = false;
}

}  // namespace undex::study
