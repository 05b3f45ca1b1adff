#include "study/run_labels.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "output/text_table.hpp"

namespace undex::study {

namespace {

using output::print;

const std::string* find(const RunSettings& settings, const std::string& key) {
  for (const auto& [name, value] : settings)
    if (name == key) return &value;
  return nullptr;
}

/// What a setting says about a run, by its key: the smaller the rank, the more. The first line that fits counts.
struct Telling {
  enum { whole, end, begin, inside } where;  ///< of the key the words stand; an end begins after a dot
  const char* words;
  int rank;
};
constexpr int silent = -1;  // said about a run, not computed by it
constexpr Telling tellings[] = {
    {Telling::whole, "title", silent},
    {Telling::whole, "probes", silent},
    {Telling::whole, "output", silent},
    {Telling::whole, "comparison", silent},
    {Telling::whole, "threads", silent},
    {Telling::end, "source", silent},
    {Telling::whole, "name", 0},
    {Telling::end, "method", 1},
    {Telling::end, "element", 1},
    {Telling::end, "description", 1},
    {Telling::whole, "resolution.spacing", 2},
    {Telling::end, "spacing", 3},
    {Telling::end, "cells", 4},
    {Telling::end, "material.name", 5},
    {Telling::whole, "scheme.name", 6},
    {Telling::begin, "scheme.", 7},
    {Telling::inside, ".material.", 9},
};

int rank(const std::string& key) {
  for (const auto& [where, words, rank] : tellings) {
    const bool fits = key == words              ? where != Telling::begin && where != Telling::inside
                      : where == Telling::end   ? key.ends_with(std::string(".") + words)
                      : where == Telling::begin ? key.starts_with(words)
                                                : where == Telling::inside && key.find(words) != std::string::npos;
    if (fits) return rank;
  }
  return 8;
}

bool in_all(const DifferingSetting& setting) {
  return std::find(setting.values.begin(), setting.values.end(), "") == setting.values.end();
}

// A value as part of a label.
std::string spoken(const std::string& key, const std::string& value) {
  if (value.empty()) return "";
  const std::string last = key.substr(key.rfind('.') + 1);
  if (last == "cells") return value + " cells";
  if (value == "true") return last;
  if (value == "false") return "no " + last;
  char* end = nullptr;
  const double amount = std::strtod(value.c_str(), &end);
  if (*end != '\0') return rank(key) < 8 ? value : last + " " + value;  // "gaussian", but "planes x y"
  return last == "spacing" ? print("%g mm", 1e3 * amount) : last + " " + print("%g", amount);
}

}  // namespace

bool is_silent(const std::string& key) { return rank(key) == silent; }

std::vector<DifferingSetting> differing_settings(const std::vector<RunSettings>& runs) {
  std::vector<DifferingSetting> result;
  std::set<std::string> seen;
  for (const RunSettings& run : runs)
    for (const auto& [key, ignored] : run) {
      if (!seen.insert(key).second) continue;
      DifferingSetting setting{key, {}};
      for (const RunSettings& other : runs) {
        const std::string* value = find(other, key);
        setting.values.push_back(value ? *value : "");
      }
      if (std::set(setting.values.begin(), setting.values.end()).size() > 1) result.push_back(std::move(setting));
    }
  std::stable_sort(result.begin(), result.end(), [](const DifferingSetting& a, const DifferingSetting& b) {
    return std::pair(!in_all(a), rank(a.key)) < std::pair(!in_all(b), rank(b.key));
  });
  return result;
}

std::vector<std::string> run_labels(const std::vector<DifferingSetting>& settings, const std::vector<std::string>& names) {
  std::vector<std::string> labels(names.size());
  const auto append = [](std::string& label, const std::string& part) {
    if (!part.empty()) label += (label.empty() ? "" : " ") + part;
  };
  const auto count = [](const std::vector<std::string>& texts) { return std::set(texts.begin(), texts.end()).size(); };
  for (const DifferingSetting& setting : settings) {
    std::vector<std::string> longer = labels;
    for (std::size_t r = 0; r < labels.size(); ++r) append(longer[r], spoken(setting.key, setting.values[r]));
    if (count(longer) > count(labels)) labels = std::move(longer);
  }
  std::map<std::string, int> uses;
  for (const std::string& label : labels) ++uses[label];
  for (std::size_t r = 0; r < labels.size(); ++r)
    if (uses[labels[r]] > 1 || labels[r].empty()) append(labels[r], names[r]);
  return labels;
}

}  // namespace undex::study
