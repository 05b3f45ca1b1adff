#include "scene/schema.hpp"

#include <cassert>

#include "scene/numbers.hpp"
#include "scene/tables.hpp"

namespace undex::scene {
namespace {

constexpr double endless = Range::endless;

Key word(const char* name) { return {.name = name}; }
Key position(const char* name) { return {.name = name, .unit = "m", .range = Range::position()}; }
Key length(const char* name) { return {.name = name, .unit = "m", .range = Range::length()}; }
Key between(const char* name, double low, double high, const char* unit = "") {
  return {.name = name, .unit = unit, .range = Range::between(low, high)};
}
Key above(const char* name, double low, double high, const char* unit = "") {
  return {.name = name, .unit = unit, .range = Range::above(low, high)};
}

std::vector<Section> make_schema() {
  std::vector<Section> sections{
      {"faces.box", {word("x_low"), word("x_high"), word("y_low"), word("y_high"), word("z_low"), word("z_high")}},
      {"faces.cylinder", {word("side"), word("low"), word("high")}},
      {"faces.cone", {word("side"), word("low"), word("high")}},
      {"faces.sphere", {word("side")}},
      {"comparison",
       {word("kind"),
        word("probe"),
        word("reference"),
        word("solution"),
        position("window"),
        length("core"),
        word("explosive"),
        {.name = "charge_mass", .unit = "kg", .range = Range::positive()},
        word("peak"),
        word("decay"),
        word("impulse"),
        word("energy_flux")}},
  };
  for_each_table([&](const std::string& name, const char* summary, const auto& record, const char* kind) {
    std::vector<Key> keys;
    if (*kind) keys.push_back(word(kind));
    const auto take = [&](const auto&, const Key& key) { keys.push_back(key); };
    if (name.starts_with("material.") && *summary) for_each_field(materials::Fluid{}, take);
    for_each_field(record, take);
    if (name.starts_with("shape.")) for_each_field(Placement{}, take);
    sections.push_back({name, keys});
  });
  return sections;
}

}  // namespace

const Key* Section::find(std::string_view key) const {
  for (const Key& each : keys)
    if (key == each.name) return &each;
  return nullptr;
}

std::vector<std::string> Section::key_names() const {
  std::vector<std::string> names;
  for (const Key& key : keys) names.emplace_back(key.name);
  return names;
}

const std::vector<Section>& schema() {
  static const std::vector<Section> sections = make_schema();
  return sections;
}

const std::vector<Section>& study_schema() {
  static const std::vector<Section> sections{
      {"study",
       {word("title"), word("scene"), word("scenes"), word("output"), word("settings"), word("axes"), word("exclude"),
        word("resolution"), word("errors"), between("repeats", 1, 100), between("threads", 1, 4096),
        above("cpu_limit", 0, 1e8, "s"), above("wall_limit", 0, 1e8, "s")}},
      {"study.axes", {word("name"), word("key"), word("values"), word("labels"), word("variants"), word("problem")}},
      {"study.errors", {word("metric"), word("source"), word("label")}},
  };
  return sections;
}

const Section& section(std::string_view name) {
  for (const std::vector<Section>* sections : {&schema(), &study_schema()})
    for (const Section& each : *sections)
      if (each.name == name) return each;
  assert(!"no such section in the schema");
  return schema().front();
}

std::string range_in_words(const Range& range) {
  const bool low = range.low > -endless, high = range.high < endless;
  if (low && high && range.above_low) return "greater than " + shortest(range.low) + " and at most " + shortest(range.high);
  if (low && high) return "from " + shortest(range.low) + " to " + shortest(range.high);
  if (low) return (range.above_low ? "greater than " : "at least ") + shortest(range.low);
  return "a finite number";
}

}  // namespace undex::scene
