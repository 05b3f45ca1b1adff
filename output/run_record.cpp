#include "output/run_record.hpp"

#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "output/files.hpp"

namespace undex::output {

namespace {

// A number that is not finite becomes null: JSON has no NaN, and no event must look like an event at zero.
nlohmann::ordered_json object(const NamedNumbers& numbers) {
  auto result = nlohmann::ordered_json::object();
  for (const auto& [name, value] : numbers) result[name] = value;
  return result;
}

}  // namespace

std::string to_json(const RunRecord& record) {
  nlohmann::ordered_json json;
  json["scene"] = record.scene;
  json["status"] = record.status;
  if (!record.message.empty()) json["message"] = record.message;
  if (!record.program.empty()) json["program"] = record.program;
  json["time_s"] = record.time_s;
  json["steps"] = record.steps;
  json["wall_time_s"] = record.wall_time_s;
  json["cpu_time_s"] = record.cpu_time_s;
  json["threads"] = record.threads;
  json["particles"] = record.particles;
  json["wall_particles"] = record.wall_particles;
  json["cells"] = record.cells;
  json["particle_updates"] = record.particle_updates;
  json["neighbour_interactions"] = record.neighbour_interactions;
  json["peak_memory_bytes"] = record.peak_memory_bytes;
  json["mass_error"] = record.mass_error;
  json["momentum_error"] = record.momentum_error;
  json["energy_error"] = record.energy_error;
  if (record.interface_energy_error) json["interface_energy_error"] = *record.interface_energy_error;
  if (record.interface_impulse_error) json["interface_impulse_error"] = *record.interface_impulse_error;
  json["clamps"] = nlohmann::ordered_json::object();
  for (const auto& [name, count] : record.clamps) json["clamps"][name] = count;
  json["passes"] = object(record.passes);
  json["metrics"] = object(record.metrics);
  // Text from outside (a scene's name, a message) may not be UTF-8: replace rather than lose the record of the run.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& path, const RunRecord& record) {
  write_text_atomically(path, to_json(record));
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
