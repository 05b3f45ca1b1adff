#include "study/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>

#include "core/errors.hpp"
#include "output/files.hpp"

namespace undex::study {

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log)
    : start_(std::chrono::steady_clock::now()) {
  std::vector<char*> texts{const_cast<char*>("undex")};
  for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
  texts.push_back(nullptr);
  const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (output < 0) output::throw_file_error("write", log, errno);
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {  // only what is safe between fork and exec
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(exit_internal);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    dup2(input, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execv("/proc/self/exe", texts.data());
    _exit(exit_internal);
  }
  const int error = errno;
  close(output);
  if (input >= 0) close(input);
  if (process_ < 0)
    throw FileError(std::string("cannot start another process: ") + std::strerror(error) + "; end some, or raise ulimit -u");
}

std::optional<ChildProcess::End> ChildProcess::ended() {
  int status = 0;
  struct rusage usage {};
  if (wait4(process_, &status, WNOHANG, &usage) != process_) return std::nullopt;
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  End end;
  end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.cpu_time_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.wall_time_s = wall_time();
  return end;
}

void ChildProcess::send(int signal) const { kill(process_, signal); }

double ChildProcess::cpu_time() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

double ChildProcess::wall_time() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace undex::study
