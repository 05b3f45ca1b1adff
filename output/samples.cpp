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

void write_history(const std::filesystem::path& path, const Samples& samples) {
  History file(path, samples.columns);
  std::vector<double> row(samples.columns.size());
  for (std::size_t r = 0; r < samples.rows(); ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) row[c] = samples.values[c][r];
    file.append(row);
  }
  file.close();
}

}  // namespace undex::output
