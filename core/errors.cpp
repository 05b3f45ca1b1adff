#include "core/errors.hpp"

#include <algorithm>

namespace undex {
namespace {

std::string joined(const std::string& file, const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    if (!text.empty()) text += '\n';
    text += file;
    if (finding.where.line > 0) text += ':' + std::to_string(finding.where.line) + ':' + std::to_string(finding.where.column);
    text += ": " + finding.message;
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
