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

// The smaller, the more a setting says about a run.
int rank(const std::string& key) {
  const auto is = [&](const char* end) { return key == end || key.ends_with(std::string(".") + end); };
  if (key == "name") return 0;
  if (is("method") || is("element") || is("description")) return 1;
  if (key == "resolution.spacing") return 2;
  if (is("spacing")) return 3;
  if (is("cells")) return 4;
  if (is("material.name")) return 5;
  if (key == "scheme.name") return 6;
  if (key.starts_with("scheme.")) return 7;
  return key.find(".material.") == std::string::npos ? 8 : 9;
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
