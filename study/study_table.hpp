// The result of a study: a row per run, observed orders, Pareto fronts; as CSV and as text.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "output/run_record.hpp"

namespace undex::study {

struct StudyRow {
  std::string name;                                     ///< of the run and of its folder
  std::vector<std::string> values;                      ///< its label on each axis
  std::string curve;                                    ///< what it has in common with the runs that differ in resolution alone
  std::string problem;                                  ///< errors of different problems are not compared
  double h = std::numeric_limits<double>::quiet_NaN();  ///< its length on the axis of resolution
  std::string status;  ///< "done", "stopped", "limit", "interrupted", "refused", "failed", "not run"
  std::string message;
  output::RunRecord record;                   ///< as far as known
  std::vector<double> cpu_times, wall_times;  ///< [s] of each repetition; the least counts
  std::vector<double> errors;                 ///< magnitudes, NaN where unknown; of runs that are done
};

struct StudyTable {
  std::string title;
  std::vector<std::string> axes;    ///< their names
  std::string resolution;           ///< name of the axis of resolution; may be empty
  std::vector<std::string> errors;  ///< their labels
  std::vector<StudyRow> rows;
};

/// Of one error along one curve.
struct ObservedOrders {
  std::string error, curve;
  std::vector<double> h, errors;  ///< of the runs that have it, from coarse to fine
  std::vector<double> between;    ///< orders between neighbours: one fewer
  double fitted;                  ///< least squares through all of them
};

/// Curves with two points at least, by error. Empty without an axis of resolution.
std::vector<ObservedOrders> observed_orders(const StudyTable& table);

/// For each error, whether each row is on the front of CPU time and error among the runs of its problem.
std::vector<std::vector<bool>> pareto_fronts(const StudyTable& table);

/// study.csv: values, status, errors, fronts (1 or 0; empty where the run has no error), cost, ledger errors, clamps, all
/// metrics.
std::string study_csv(const StudyTable& table);
/// order.csv: a line per pair of neighbours and one "least squares" per curve.
std::string order_csv(const std::vector<ObservedOrders>& orders);
/// study.json: what a reader of the two needs to know of the axes and errors.
std::string study_json(const StudyTable& table);

/// The table for a terminal; a star marks runs on a front.
std::string study_text(const StudyTable& table);
std::string order_text(const std::vector<ObservedOrders>& orders);

}  // namespace undex::study
