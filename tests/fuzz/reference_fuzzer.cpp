// References are read and can be used, or refused with FileError; histories of a killed run likewise.
#include <cmath>

#include "core/errors.hpp"
#include "judge/reference.hpp"
#include "tests/fuzz/input.hpp"

using namespace undex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = fuzz::written("reference.csv", fuzz::text_of(data, size));
  try {
    const judge::Reference reference = judge::read_reference(path);
    if (reference.table) {
      output::NamedNumbers metrics;
      for (const auto& row : reference.table->rows) metrics.emplace_back(row.metric, 1.5);
      judge::format_comparison(metrics, *reference.table, 100);
    }
    for (const output::HistoryColumn& column : reference.history) {
      output::require_valid(column.series);
      if (column.series.empty()) continue;
      const double begin = column.series.t.front(), end = column.series.t.back();
      output::value_at(column.series, 0.5 * begin + 0.5 * end);
      output::integral(column.series, begin, end);
      output::difference_norms(column.series, column.series, begin, end);
      output::first_rise(column.series, 0.5, begin, end);
      output::first_below(column.series, 0.5, begin, end);
      output::maximum(column.series, begin, end);
    }
  } catch (const FileError&) {
  }
  try {
    output::read_history(path, true);
  } catch (const FileError&) {
  }
  return 0;
}
