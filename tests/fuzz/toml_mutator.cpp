#include "tests/fuzz/toml_mutator.hpp"

#include <algorithm>
#include <cstring>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/input.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace undex::fuzz {
namespace {

constexpr const char* values[] = {"0",
                                  "-1",
                                  "1",
                                  "2",
                                  "0.5",
                                  "-0.0",
                                  "1e-300",
                                  "1e300",
                                  "-1e300",
                                  "inf",
                                  "nan",
                                  "-inf",
                                  "1e9",
                                  "1e-9",
                                  "2147483648",
                                  "4294967296",
                                  "0x10",
                                  "true",
                                  "false",
                                  "\"\"",
                                  "\"word\"",
                                  "[]",
                                  "{}",
                                  "[[]]",
                                  "[0]",
                                  "[0, 0]",
                                  "[1, 2, 3]",
                                  "[1e308, -1e308, 0]",
                                  "[{}]",
                                  "\"../case.toml\"",
                                  "{low = [0, 0, 0], high = [1, 1, 1]}",
                                  "{type = \"sphere\", center = [0, 0, 0], radius = 1}",
                                  "9223372036854775807",
                                  "1979-05-27",
                                  "{base = \"petn\"}",
                                  "[\"x\", \"y\", \"z\"]"};

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

std::size_t put(const std::vector<std::string>& lines, std::uint8_t* out, std::size_t most) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  if (!text.empty()) text.pop_back();
  const std::size_t size = std::min(text.size(), most);
  std::memcpy(out, text.data(), size);
  return size;
}

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

 private:
  std::minstd_rand random_;
};

/// The value of a line, from behind its '=' on; npos where it has none.
std::size_t value_of(const std::string& line) {
  const std::size_t at = line.find('=');
  return at == std::string::npos || line.starts_with("#") ? std::string::npos : at + 1;
}

/// One number of a line becomes another.
void change_number(std::string& line, Chance& chance) {
  std::vector<std::size_t> starts;
  const std::string marks = " [,=-";
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] >= '0' && line[i] <= '9' && marks.find(line[i - 1]) != std::string::npos) starts.push_back(i);
  if (starts.empty()) return;
  const std::size_t at = starts[chance.below(starts.size())];
  const std::size_t end = std::min(line.find_first_not_of("0123456789.e-+", at), line.size());
  const std::string number = line.substr(at, end - at);
  const char* factors[] = {"e1", "e-1", "e3", "e-3", "e6", "e-6"};
  if (chance.below(2) && number.find('e') == std::string::npos) line.insert(end, factors[chance.below(std::size(factors))]);
  else line.replace(at, end - at, values[chance.below(21)]);
}

void change(std::vector<std::string>& lines, Chance& chance) {
  const std::size_t k = chance.below(lines.size()), other = chance.below(lines.size());
  switch (chance.below(8)) {
    case 0: lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(k)); break;
    case 1: {
      const std::string copy = lines[other];
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(k), copy);
      break;
    }
    case 2: std::swap(lines[k], lines[other]); break;
    case 3:
      if (const std::size_t at = value_of(lines[k]); at != std::string::npos)
        lines[k].replace(at, std::string::npos, std::string(1, ' ') + values[chance.below(std::size(values))]);
      break;
    case 4:  // the value of another key
      if (const std::size_t at = value_of(lines[k]), from = value_of(lines[other]);
          at != std::string::npos && from != std::string::npos)
        lines[k] = lines[k].substr(0, at) + lines[other].substr(from);
      break;
    case 5:  // the key of another value
      if (const std::size_t at = value_of(lines[k]), from = value_of(lines[other]);
          at != std::string::npos && from != std::string::npos)
        lines[k] = lines[other].substr(0, from) + lines[k].substr(at);
      break;
    default: change_number(lines[k], chance);
  }
}

}  // namespace

std::size_t mutate_toml(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Chance chance(seed);
  if (size == 0 || chance.below(2)) return LLVMFuzzerMutate(data, size, most);
  std::vector<std::string> lines = lines_of(text_of(data, size));
  for (std::size_t n = 1 + chance.below(3); n > 0 && !lines.empty(); --n) change(lines, chance);
  return put(lines, data, most);
}

std::size_t cross_toml(const std::uint8_t* one, std::size_t one_size, const std::uint8_t* other, std::size_t other_size,
                       std::uint8_t* out, std::size_t most, unsigned seed) {
  Chance chance(seed);
  std::vector<std::string> lines = lines_of(text_of(one, one_size));
  const std::vector<std::string> more = lines_of(text_of(other, other_size));
  const std::size_t begin = chance.below(more.size()), count = 1 + chance.below(std::min<std::size_t>(more.size() - begin, 12));
  const auto at = lines.begin() + static_cast<std::ptrdiff_t>(chance.below(lines.size() + 1));
  const auto first = more.begin() + static_cast<std::ptrdiff_t>(begin);
  lines.insert(at, first, first + static_cast<std::ptrdiff_t>(count));
  return put(lines, out, most);
}

}  // namespace undex::fuzz
