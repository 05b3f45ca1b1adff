// A study as a job array of Slurm (https://slurm.schedmd.com/job_array.html): a task a shard.
#pragma once

#include <filesystem>
#include <string>

#include "scene/study.hpp"

namespace undex::study {

/// The batch script: each task is `undex study ... --shard K/shards`, ended in time by a signal, so that its runs leave
/// checkpoints and the same script, submitted again, goes on. Paths in it are absolute.
std::string slurm_script(const scene::Study& study, const std::filesystem::path& folder, int shards);

}  // namespace undex::study
