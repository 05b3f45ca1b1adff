#include "core/errors.hpp"

#include <algorithm>

namespace undex {
namespace {

/// A message of a line or two, whatever was written in the file.
std::string shortened(const std::string& message) {
  constexpr std::size_t most = 2000;
  return message.size() > most ? message.substr(0, most) + "..." : message;
}

std::string joined(const std::string& file, const std::vector<Finding>& findings) {
  constexpr std::size_t most = 100;  // more than anybody mends at once
  std::string text;
  for (std::size_t f = 0; f < findings.size(); ++f) {
    const Finding& finding = findings[f];
    if (!text.empty()) text += '\n';
    if (f == most) return text + file + ": and " + std::to_string(findings.size() - most) + " more; mend these first";
    text += file;
    if (finding.where.line > 0) text += ':' + std::to_string(finding.where.line) + ':' + std::to_string(finding.where.column);
    text += ": " + shortened(finding.message);
  }
  return text;
}

std::vector<Finding> in_order(std::vector<Finding> findings) {
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return a.where.line != b.where.line ? a.where.line < b.where.line : a.where.column < b.where.column;
  });
  return findings;
}

}  // namespace

SceneError::SceneError(std::string file, std::vector<Finding> findings)
    : std::runtime_error(joined(file, in_order(findings))), file_(std::move(file)), findings_(in_order(std::move(findings))) {}

}  // namespace undex
