// What a study says beside its tables.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/study.hpp"
#include "study/study_table.hpp"

namespace undex::study {

/// "1 run", "3 runs".
std::string count_of(std::size_t number, const std::string& thing);

/// "spacing (4) x scheme (3)".
std::string axes_text(const scene::Study& study);

/// Errors that runs do not have though they are done: one note.
std::string missing_metrics(const scene::Study& study, const StudyTable& table);

/// Runs that another program than this one computed.
std::string other_programs(const StudyTable& table, const std::string& program);

/// Folders of runs that the study no longer has.
std::string left_over_text(const std::vector<std::filesystem::path>& folders);

}  // namespace undex::study
