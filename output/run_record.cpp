#include "output/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "core/constants.hpp"
#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::output {

namespace {

// A number that is not finite becomes null: JSON has no NaN, and no event must look like an event at zero.
nlohmann::ordered_json object(const NamedNumbers& numbers) {
  auto result = nlohmann::ordered_json::object();
  for (const auto& [name, value] : numbers) result[name] = value;
  return result;
}

void put_metrics(nlohmann::ordered_json& json, const NamedNumbers& metrics, const Reasons& missing) {
  json["metrics"] = object(metrics);
  json.erase("missing");
  for (const auto& [name, reason] : missing) json["missing"][name] = reason;
}

nlohmann::ordered_json object(const StructureRecord& structure) {
  nlohmann::ordered_json json;
  json["name"] = structure.name;
  json["cells"] = structure.cells;
  json["steps"] = structure.steps;
  json["kinetic_j"] = structure.kinetic;
  json["elastic_j"] = structure.elastic;
  json["plastic_j"] = structure.plastic;
  json["viscous_j"] = structure.viscous;
  json["interface_work_received_j"] = structure.received;
  json["external_j"] = structure.external;
  json["energy_error"] = structure.energy_error;
  json["impulse_n_s"] = structure.impulse;
  return json;
}

nlohmann::ordered_json object(const ObstacleRecord& obstacle) {
  nlohmann::ordered_json json;
  json["name"] = obstacle.name;
  json["motion"] = obstacle.motion;
  if (obstacle.mass) json["mass_kg"] = *obstacle.mass;
  json["displacement_m"] = obstacle.displacement;
  json["rotation_rad"] = obstacle.rotation;
  json["velocity_m_s"] = obstacle.velocity;
  json["spin_rad_s"] = obstacle.spin;
  json["impulse_n_s"] = obstacle.impulse;
  return json;
}

constexpr std::pair<const char*, const char*> keys_of_quantities[] = {{"pressure", "pressure_pa"},
                                                                      {"speed", "speed_m_s"},
                                                                      {"plastic_strain", "plastic_strain"},
                                                                      {"damage", "damage"},
                                                                      {"temperature", "temperature_k"}};

nlohmann::ordered_json object(const std::vector<LargestRecord>& all) {
  nlohmann::ordered_json json;
  for (const auto& [quantity, key] : keys_of_quantities)
    for (const LargestRecord& each : all)
      if (each.quantity == quantity)
        json[key][each.part] = {{"value", each.value}, {"place_m", each.place}, {"time_s", each.time_s}};
  return json;
}

nlohmann::ordered_json object(const BubbleRecord& bubble) {
  nlohmann::ordered_json json;
  json["body"] = bubble.body;
  json["largest_radius_m"] = bubble.largest_radius_m;
  json["largest_radius_time_s"] = bubble.largest_radius_time_s;
  json["least_radius_m"] = bubble.least_radius_m;
  json["period_s"] = bubble.period_s;
  if (!bubble.missing.empty()) json["missing"] = bubble.missing;
  return json;
}

// The value at `key`, null as NaN; `value` stays as it is where there is no such key, or it holds something else.
template <class Number>
void get(const nlohmann::ordered_json& json, const char* key, Number& value) {
  const auto found = json.find(key);
  if (found == json.end()) return;
  if (found->is_number()) value = found->template get<Number>();
  if constexpr (std::is_floating_point_v<Number>)
    if (found->is_null()) value = nan;
}

/// Text from outside (a scene's name, a message) may not be UTF-8: replaced rather than to lose the record of the run.
std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string text(const nlohmann::ordered_json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

NamedNumbers numbers(const nlohmann::ordered_json& json, const char* key) {
  NamedNumbers result;
  if (const auto found = json.find(key); found != json.end() && found->is_object())
    for (const auto& [name, value] : found->items())
      if (value.is_number() || value.is_null()) result.emplace_back(name, value.is_null() ? nan : value.get<double>());
  return result;
}

std::vector<double> list(const nlohmann::ordered_json& json, const char* key) {
  std::vector<double> values;
  if (const auto found = json.find(key); found != json.end() && found->is_array())
    for (const auto& value : *found) values.push_back(value.is_number() ? value.get<double>() : nan);
  return values;
}

StructureRecord structure(const nlohmann::ordered_json& json) {
  StructureRecord structure;
  structure.name = text(json, "name");
  get(json, "cells", structure.cells);
  get(json, "steps", structure.steps);
  get(json, "kinetic_j", structure.kinetic);
  get(json, "elastic_j", structure.elastic);
  get(json, "plastic_j", structure.plastic);
  get(json, "viscous_j", structure.viscous);
  get(json, "interface_work_received_j", structure.received);
  get(json, "external_j", structure.external);
  get(json, "energy_error", structure.energy_error);
  structure.impulse = list(json, "impulse_n_s");
  return structure;
}

ObstacleRecord obstacle(const nlohmann::ordered_json& json) {
  ObstacleRecord obstacle;
  obstacle.name = text(json, "name");
  obstacle.motion = text(json, "motion");
  if (json.contains("mass_kg")) get(json, "mass_kg", obstacle.mass.emplace(nan));
  obstacle.displacement = list(json, "displacement_m");
  obstacle.rotation = list(json, "rotation_rad");
  obstacle.velocity = list(json, "velocity_m_s");
  obstacle.spin = list(json, "spin_rad_s");
  obstacle.impulse = list(json, "impulse_n_s");
  return obstacle;
}

std::vector<LargestRecord> largest(const nlohmann::ordered_json& json) {
  std::vector<LargestRecord> all;
  for (const auto& [quantity, key] : keys_of_quantities) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_object()) continue;
    for (const auto& [part, each] : found->items()) {
      if (!each.is_object()) continue;
      LargestRecord& record = all.emplace_back(LargestRecord{.part = part, .quantity = quantity, .place = list(each, "place_m")});
      get(each, "value", record.value);
      get(each, "time_s", record.time_s);
    }
  }
  return all;
}

constexpr const char* trust_words[] = {"good", "notice", "bad"};

/// A level that this program does not know counts as bad.
TrustRecord trust(const nlohmann::ordered_json& json) {
  const std::string level = text(json, "level");
  const auto word = std::find(std::begin(trust_words), std::end(trust_words), level);
  return {text(json, "about"), word == std::end(trust_words) ? Trust::bad : Trust(word - std::begin(trust_words)),
          text(json, "text")};
}

BubbleRecord bubble(const nlohmann::ordered_json& json) {
  BubbleRecord bubble;
  bubble.body = text(json, "body");
  get(json, "largest_radius_m", bubble.largest_radius_m);
  get(json, "largest_radius_time_s", bubble.largest_radius_time_s);
  get(json, "least_radius_m", bubble.least_radius_m);
  get(json, "period_s", bubble.period_s);
  bubble.missing = text(json, "missing");
  return bubble;
}

SplitRecord split(const nlohmann::ordered_json& json) {
  SplitRecord split;
  split.body = text(json, "body");
  get(json, "particles_at_start", split.particles_at_start);
  get(json, "particles", split.particles);
  return split;
}

nlohmann::ordered_json summary_at(const std::filesystem::path& path) {
  require_file(path);
  std::ifstream file(path);
  if (!file) throw FileError(path.string() + ": cannot be read; check that it is there and yours to read");
  auto json = nlohmann::ordered_json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || text(json, "status").empty())
    throw FileError(path.string() + ": not the summary of a run (no JSON object with a status); run the scene again");
  return json;
}

}  // namespace

const double* find_number(const NamedNumbers& numbers, const std::string& name) {
  for (const auto& [key, value] : numbers)
    if (key == name) return &value;
  return nullptr;
}

std::string to_json(const RunRecord& record) {
  nlohmann::ordered_json json;
  json["scene"] = record.scene;
  json["status"] = record.status;
  if (!record.message.empty()) json["message"] = record.message;
  if (!record.warnings.empty()) json["warnings"] = record.warnings;
  if (!record.program.empty()) json["program"] = record.program;
  json["time_s"] = record.time_s;
  json["steps"] = record.steps;
  json["fluid_substeps"] = record.fluid_substeps;
  json["wall_time_s"] = record.wall_time_s;
  json["cpu_time_s"] = record.cpu_time_s;
  json["threads"] = record.threads;
  json["particles"] = record.particles;
  json["wall_particles"] = record.wall_particles;
  json["cells"] = record.cells;
  json["particle_updates"] = record.particle_updates;
  json["neighbour_interactions"] = record.neighbour_interactions;
  json["peak_memory_bytes"] = record.peak_memory_bytes;
  json["solver_memory_bytes"] = record.solver_memory_bytes;
  json["mass_error"] = record.mass_error;
  json["momentum_error"] = record.momentum_error;
  if (record.angular_momentum_error) json["angular_momentum_error"] = *record.angular_momentum_error;
  json["energy_error"] = record.energy_error;
  if (record.interface_energy_error) json["interface_energy_error"] = *record.interface_energy_error;
  if (record.interface_impulse_error) json["interface_impulse_error"] = *record.interface_impulse_error;
  for (const StructureRecord& structure : record.structures) json["structures"].push_back(object(structure));
  for (const ObstacleRecord& obstacle : record.obstacles) json["obstacles"].push_back(object(obstacle));
  if (!record.largest.empty()) json["largest"] = object(record.largest);
  for (const BubbleRecord& each : record.bubbles) json["bubbles"].push_back(object(each));
  for (const SplitRecord& each : record.splits)
    json["splits"].push_back(
        {{"body", each.body}, {"particles_at_start", each.particles_at_start}, {"particles", each.particles}});
  json["clamps"] = nlohmann::ordered_json::object();
  for (const auto& [name, count] : record.clamps) json["clamps"][name] = count;
  for (const auto& [name, count] : record.step_limits) json["step_limits"][name] = count;
  for (const TrustRecord& each : record.trust)
    json["trust"].push_back({{"about", each.about}, {"level", trust_words[int(each.level)]}, {"text", each.text}});
  json["passes"] = object(record.passes);
  put_metrics(json, record.metrics, record.missing);
  return json_text(json);
}

void write_summary(const std::filesystem::path& path, const RunRecord& record) { write_text_atomically(path, to_json(record)); }

void replace_metrics(const std::filesystem::path& path, const NamedNumbers& metrics, const Reasons& missing) {
  nlohmann::ordered_json json = summary_at(path);
  put_metrics(json, metrics, missing);
  write_text_atomically(path, json_text(json));
}

RunRecord read_summary(const std::filesystem::path& path) {
  const nlohmann::ordered_json json = summary_at(path);
  RunRecord record;
  record.scene = text(json, "scene");
  record.status = text(json, "status");
  record.message = text(json, "message");
  if (const auto found = json.find("warnings"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_string()) record.warnings.push_back(each.get<std::string>());
  record.program = text(json, "program");
  get(json, "time_s", record.time_s);
  get(json, "steps", record.steps);
  get(json, "fluid_substeps", record.fluid_substeps);
  get(json, "wall_time_s", record.wall_time_s);
  get(json, "cpu_time_s", record.cpu_time_s);
  get(json, "threads", record.threads);
  get(json, "particles", record.particles);
  get(json, "wall_particles", record.wall_particles);
  get(json, "cells", record.cells);
  get(json, "particle_updates", record.particle_updates);
  get(json, "neighbour_interactions", record.neighbour_interactions);
  get(json, "peak_memory_bytes", record.peak_memory_bytes);
  get(json, "solver_memory_bytes", record.solver_memory_bytes);
  record.mass_error = record.momentum_error = record.energy_error = nan;
  get(json, "mass_error", record.mass_error);
  get(json, "momentum_error", record.momentum_error);
  get(json, "energy_error", record.energy_error);
  const auto optional = [&](const char* key, std::optional<double>& value) {
    if (!json.contains(key)) return;
    value = nan;
    get(json, key, *value);
  };
  optional("interface_energy_error", record.interface_energy_error);
  optional("interface_impulse_error", record.interface_impulse_error);
  if (const auto found = json.find("structures"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_object()) record.structures.push_back(structure(each));
  if (const auto found = json.find("obstacles"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_object()) record.obstacles.push_back(obstacle(each));
  if (const auto found = json.find("largest"); found != json.end() && found->is_object()) record.largest = largest(*found);
  if (const auto found = json.find("bubbles"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_object()) record.bubbles.push_back(bubble(each));
  if (const auto found = json.find("splits"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_object()) record.splits.push_back(split(each));
  for (const auto& [name, count] : numbers(json, "clamps"))
    if (!std::isnan(count)) record.clamps.emplace_back(name, static_cast<std::int64_t>(count));
  for (const auto& [name, count] : numbers(json, "step_limits"))
    if (!std::isnan(count)) record.step_limits.emplace_back(name, static_cast<std::int64_t>(count));
  if (const auto found = json.find("trust"); found != json.end() && found->is_array())
    for (const auto& each : *found)
      if (each.is_object()) record.trust.push_back(trust(each));
  record.passes = numbers(json, "passes");
  record.metrics = numbers(json, "metrics");
  if (const auto found = json.find("missing"); found != json.end() && found->is_object())
    for (const auto& [name, reason] : found->items())
      if (reason.is_string()) record.missing.emplace_back(name, reason.get<std::string>());
  return record;
}

std::int64_t peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoll(line.substr(6)) * 1024;
  return 0;
}

double cpu_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace undex::output
