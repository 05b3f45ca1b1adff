#include "study/study_outcome.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "output/files.hpp"

namespace undex::study {

void write_outcome(const std::filesystem::path& path, const StudyOutcome& outcome) {
  const nlohmann::ordered_json json{{"status", outcome.status},           {"message", outcome.message},
                                    {"cpu_times_s", outcome.cpu_times_s}, {"wall_times_s", outcome.wall_times_s},
                                    {"cpu_limit_s", outcome.cpu_limit_s}, {"wall_limit_s", outcome.wall_limit_s}};
  output::write_text_atomically(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::optional<StudyOutcome> read_outcome(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  try {
    const auto json = nlohmann::ordered_json::parse(file);
    return StudyOutcome{.status = json.at("status"),
                        .message = json.at("message"),
                        .cpu_times_s = json.at("cpu_times_s"),
                        .wall_times_s = json.at("wall_times_s"),
                        .cpu_limit_s = json.at("cpu_limit_s"),
                        .wall_limit_s = json.at("wall_limit_s")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

}  // namespace undex::study
