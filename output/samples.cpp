#include "output/samples.hpp"

#include <stdexcept>

namespace undex::output {

void Samples::append(std::span<const double> row) {
  if (row.size() != values.size())
    throw std::invalid_argument("samples: " + std::to_string(row.size()) + " values for " + std::to_string(values.size()) +
                                " columns");
  for (std::size_t c = 0; c < row.size(); ++c) values[c].push_back(row[c]);
}

Series Samples::series(const std::string& column) const {
  for (std::size_t c = 1; c < columns.size(); ++c)
    if (columns[c].name == column) return {values.front(), values[c]};
  return {};
}

void Samples::visit_state(StateVisitor& state) {
  for (std::size_t c = 0; c < columns.size(); ++c) state(columns[c].name, values[c]);
}

void write_history(const std::filesystem::path& path, const Samples& samples) { History::continued(path, samples).close(); }

}  // namespace undex::output
