#include "study/curves.hpp"

#include <cmath>
#include <cstdio>
#include <set>

#include "judge/metric_names.hpp"

namespace undex::study {
namespace {

using output::Series;

/// The lines of curves.csv of one curve.
std::string curve_lines(const Compared& curve, const std::string& label, const Series& series) {
  const Quantity& quantity = curve.quantity;
  std::string head = csv_row({quantity.probe, curve.kind, quantity.name, quantity.unit, label});
  head.back() = ',';  // the line goes on
  std::string text;
  char numbers[64];
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    std::snprintf(numbers, sizeof numbers, "%.9g,%.9g\n", series.t[i], series.y[i]);
    text += head;
    text += numbers;
  }
  return text;
}

}  // namespace

std::string curves_csv(const std::vector<Compared>& all, const std::vector<std::string>& labels,
                       const std::optional<judge::ReferenceTable>& table) {
  std::string text = "probe,kind,quantity,unit,run,time [s],value\n";
  const auto add = [&](const Compared& each) {
    for (std::size_t r = 0; r < labels.size(); ++r) text += curve_lines(each, labels[r], each.quantity.runs[r]);
    text += curve_lines(each, "reference", each.quantity.reference);
  };
  std::set<std::string> met;
  for (const Compared& each : all) {
    if (each.quantity.count() < 2) continue;
    add(each);
    if (each.is_pressure())
      for (const Compared& more : derived(each)) add(more);
    const bool motion = each.quantity.name == "radial displacement" || each.quantity.name == "radial velocity";
    if (!table || !motion || !met.insert(each.quantity.name).second) continue;  // only of the first probe: the compared one
    for (std::size_t s = 0; s < table->sources.size(); ++s) {
      Series points;
      for (const judge::ReferenceTable::Row& row : table->rows) {
        const double time = judge::time_of_metric(row.metric, each.column == "velocity" ? "wall_velocity" : "displacement");
        if (!std::isnan(time) && !std::isnan(row.values[s].value)) points.append(time, row.values[s].value / row.scale);
      }
      text += curve_lines(each, table->sources[s], points);
    }
  }
  return text;
}

}  // namespace undex::study
