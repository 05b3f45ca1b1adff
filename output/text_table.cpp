#include "output/text_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace undex::output {

std::string print(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string number(double value, const std::string& unit) {
  if (std::isnan(value)) return "-";
  if (unit == "us") return print("%.2f", value);
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (unit.empty() && size < 1e9 && value == std::floor(value)) return print("%.0f", value);  // a count
  if (size >= 1e5 || (size > 0 && size < 1e-3)) return print("%.3e", value);
  return print(size >= 100 ? "%.1f" : size >= 10 ? "%.2f" : size >= 0.1 ? "%.3f" : size >= 0.01 ? "%.4f" : "%.5f", value);
}

double difference(double mine, double theirs, const std::string& unit) {
  if (unit == "us") return mine - theirs;
  return theirs == 0 ? std::numeric_limits<double>::quiet_NaN() : 100 * (mine - theirs) / std::abs(theirs);
}

std::string difference_text(double difference, const std::string& unit) {
  if (std::isnan(difference)) return "";
  const double least = unit == "us" ? 0.005 : 0.05;  // what would be printed as -0.0
  if (std::abs(difference) < least) difference = 0;
  if (unit == "us") return print("%+.2f", difference);
  if (std::abs(difference) >= 1000) return difference > 0 ? ">999%" : "<-999%";
  return print(std::abs(difference) >= 99.95 ? "%+.0f%%" : "%+.1f%%", difference);
}

std::string grouped(std::int64_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t k = 0; k < digits.size(); ++k) {
    const std::size_t left = digits.size() - k;
    if (k > 0 && left % 3 == 0 && digits[k - 1] != '-') text += ',';
    text += digits[k];
  }
  return text;
}

std::string with_unit(double value, const std::string& unit) {
  struct Prefix {
    double factor;
    const char* letter;
  };
  constexpr Prefix prefixes[] = {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}};
  if (value == 0 || !std::isfinite(value)) return print("%g ", value) + unit;
  if (unit == "m" && std::abs(value) >= 1e-5 && std::abs(value) < 1) return print("%.4g mm", value * 1e3);  // as engineers count
  for (const Prefix& prefix : prefixes)
    if (std::abs(value) >= 0.99995 * prefix.factor && !(prefix.factor > 1 && (unit == "s" || unit == "m" || unit == "m/s")))
      return print("%.4g ", value / prefix.factor) + prefix.letter + unit;
  return print("%.3g ", value) + unit;
}

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded_left(const std::string& text, std::size_t columns) {
  return std::string(columns - std::min(columns, width(text)), ' ') + text;
}

std::string padded_right(const std::string& text, std::size_t columns) {
  return text + std::string(columns - std::min(columns, width(text)), ' ');
}

std::string aligned(const std::vector<std::vector<std::string>>& lines, std::size_t left) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()), 0);
    for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], width(line[c]));
  }
  std::string text;
  for (const auto& cells : lines) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c)
      line += (c > 0 ? "   " : "") + (c < left ? padded_right(cells[c], widths[c]) : padded_left(cells[c], widths[c]));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string duration(double seconds) {
  char text[40];
  if (seconds < 100) std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 6000)
    std::snprintf(text, sizeof text, "%.0f min %02.0f s", std::floor(seconds / 60),
                  std::floor(seconds - 60 * std::floor(seconds / 60)));
  else std::snprintf(text, sizeof text, "%.1f h", seconds / 3600);
  return text;
}

}  // namespace undex::output
