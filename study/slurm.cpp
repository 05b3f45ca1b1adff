#include "study/slurm.hpp"

#include <algorithm>
#include <cstdlib>

#include "study/shell.hpp"

namespace undex::study {

namespace {

/// The most threads that a run of the study has.
int threads_of(const scene::Study& study) {
  int most = 1;
  for (const scene::StudyRun& run : study.runs)
    for (const scene::Override& setting : run.settings)
      if (setting.key == "threads") most = std::max(most, std::atoi(setting.value.c_str()));
  return most;
}

}  // namespace

std::string slurm_script(const scene::Study& study, const std::filesystem::path& folder, int shards) {
  namespace fs = std::filesystem;
  const std::string program = quoted_for_shell(fs::read_symlink("/proc/self/exe").string());
  const std::string file = quoted_for_shell(fs::absolute(study.file).lexically_normal().string());
  const std::string output = quoted_for_shell(fs::absolute(folder).lexically_normal().string());
  std::string text = "#!/bin/bash\n";
  text += "# The study " + study.name + " as a job array. Submit it with the time that a task may take:\n";
  text += "#   sbatch --time=4:00:00 " + output + "/study.slurm\n";
  text += "# Tasks that run out of time leave checkpoints: submit the same script again, and it goes on. When all have ended:\n";
  text += "#   " + program + " study " + file + " -o " + output + " --table\n";
  text += "#SBATCH --job-name=undex_" + study.name + "\n";
  text += "#SBATCH --array=1-" + std::to_string(shards) + "\n";
  text += "#SBATCH --ntasks=1\n";
  text += "#SBATCH --cpus-per-task=" + std::to_string(threads_of(study)) + "\n";
  text += "#SBATCH --output=" + fs::absolute(folder).lexically_normal().string() + "/shards/slurm_%A_%a.txt\n";
  text += "#SBATCH --signal=B:TERM@120\n";  // two minutes before the end: a run ends after its present step
  text += "#SBATCH --open-mode=append\n\n";
  text += "export OMP_PROC_BIND=close\n";
  // In place of the shell, so that the signal reaches it.
  text += "exec " + program + " study " + file + " -o " + output + " --shard \"$SLURM_ARRAY_TASK_ID/" + std::to_string(shards) +
          "\" -j 1\n";
  return text;
}

}  // namespace undex::study
