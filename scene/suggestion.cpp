#include "scene/suggestion.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace undex::scene {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
bool is_separator(char c) { return c == '_' || c == '-' || c == ' '; }

/// Edits (insert, delete, replace, swap of neighbours) from a to b; case and the kind of separator count nothing.
std::size_t edits(std::string_view a, std::string_view b) {
  const auto same = [](char x, char y) { return lower(x) == lower(y) || (is_separator(x) && is_separator(y)); };
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

bool contains(std::string_view whole, std::string_view part) {
  return std::search(whole.begin(), whole.end(), part.begin(), part.end(), [](char x, char y) { return lower(x) == lower(y); }) !=
         whole.end();
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > 64) return "";
  const std::string* best = nullptr;
  std::size_t fewest = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates)
    // One letter for another is no mistake of spelling.
    if (const std::size_t n = edits(word, candidate); n < (std::min(word.size(), candidate.size()) < 2 ? 1 : fewest)) {
      fewest = n;
      best = &candidate;
    }
  if (best) return *best;
  // "plane" for "planes_of_symmetry", "density0" for "density"; or a shortened word
  for (const std::string& candidate : candidates)
    if (word.size() >= 4 && candidate.size() >= 4 && (contains(candidate, word) || contains(word, candidate))) return candidate;
  return "";
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  if (const std::string near = nearest(word, candidates); !near.empty()) return "; did you mean '" + near + "'?";
  return candidates.empty() ? "" : "; known: " + listed(candidates);
}

std::vector<std::string> nearest_few(std::string_view word, std::vector<std::string> candidates) {
  constexpr std::size_t few = 5;
  const std::string_view begin = word.substr(0, 64);
  std::stable_sort(candidates.begin(), candidates.end(), [&](const std::string& a, const std::string& b) {
    const auto rank = [&](const std::string& name) { return std::pair(!contains(name, begin), edits(begin, name)); };
    return rank(a) < rank(b);
  });
  candidates.resize(std::min(few, candidates.size()));
  return candidates;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace undex::scene
