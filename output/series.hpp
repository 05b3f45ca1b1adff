// A sampled function of time, and the few operations from which results are made. Between samples it is linear, before
// the first and after the last it is unknown: asked for there, the answer is NaN.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace undex::output {

/// Samples y(t), t not decreasing [s].
struct Series {
  std::vector<double> t, y;

  bool empty() const { return t.empty(); }
  void append(double time, double value) {
    t.push_back(time);
    y.push_back(value);
  }
};

/// Throws std::invalid_argument unless t and y have one length, t does not decrease and both are finite.
void require_valid(const Series& series);

/// Does the series cover a..b? The first and the last step of a run may be missing: up to 2 % of b at either end.
bool covers(const Series& series, double a, double b);

/// y at time t. At a covered end that lies a little beyond the samples: the nearest sample.
double value_at(const Series& series, double t);

/// y at time t, the first and last sample held beyond the ends. The series must not be empty.
double value_held(const Series& series, double t);

/// Integral of y over a..b (where covers(a, b), else NaN); where the samples end early the last value is kept.
double integral(const Series& series, double a, double b);

/// Mean of y over the window centred at each sample time, the window cut off at the ends of the series.
Series moving_average(const Series& series, double window);

struct Extremum {
  double t, y;
};
/// Largest value among samples with a <= t <= b; NaN where there are none.
Extremum maximum(const Series& series, double a, double b);

/// First time in a..b at which y comes from below `level` (or starts there) and reaches it; NaN if it never does.
double first_rise(const Series& series, double level, double a, double b);
/// First time in a..b at which y is below `level`; NaN if it never is.
double first_below(const Series& series, double level, double a, double b);

/// Integral of y from the first sample on, at each sample.
Series running_integral(const Series& series);

struct Norms {
  double l1, l2;
};
/// Mean and root-mean-square of series - base over a..b, the differences of piecewise linear functions integrated exactly,
/// as a share of the largest |base| there. NaN where one of the two does not reach over a..b, or base is zero.
Norms difference_norms(const Series& series, const Series& base, double a, double b);

/// One column of a CSV history over its time column.
struct HistoryColumn {
  std::string name, unit;  ///< "pressure", "Pa"; a pure number's unit is "-"
  Series series;
};

/// Every column after the time of a CSV history (header row "time [s],name [unit]...", lines beginning with # are
/// skipped). Values that are not finite are kept. Of a file that `may_be_cut`, its writer having been killed, what comes after
/// the last end of line is left out. Throws FileError with the line when the file cannot be read or understood.
std::vector<HistoryColumn> read_history(const std::filesystem::path& path, bool may_be_cut = false);

}  // namespace undex::output
