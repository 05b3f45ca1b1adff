// What a study says while it runs: a line for every run that ends, and a bar where somebody is watching a terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "study/study_table.hpp"
#include "scene/study.hpp"

namespace undex::study {

/// Expected wall times of runs [s]: time ~ h^-(dimension + 1) along a curve, with the factor of its finest run that is known;
/// where none of the curve is, the median factor of all; NaN where nothing is known.
class RunTimes {
 public:
  RunTimes(const scene::Study& study, const std::vector<StudyRow>& rows);
  double expected(std::size_t run) const;

 private:
  std::vector<double> weights_;  ///< h^-(dimension + 1); 1 without a resolution
  std::vector<double> factors_;  ///< by run: that of its curve, or NaN
  double median_;
};

class StudyProgress {
 public:
  StudyProgress(std::size_t to_compute, bool quiet);
  /// A run has ended.
  void line(const StudyRow& row, const std::vector<std::string>& errors, double seconds_left);
  /// Where somebody is watching, a few times a second.
  bool bar_is_due() const;
  /// With the runs under way.
  void bar(const std::vector<std::string>& running, double seconds_left);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string counted() const;  ///< "[3/12] "
  std::size_t ended_ = 0, total_;
  bool quiet_, terminal_, shown_ = false;
  Clock::time_point start_, last_;
};

}  // namespace undex::study
