#include "output/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <memory>
#include <optional>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

TEST(FolderLock, ASecondIsToldWhoHoldsIt) {
  const TemporaryFolder here;
  const FolderLock first(here.path, "undex run");
  const std::string message = message_of<UsageError>([&] { FolderLock(here.path, "undex judge"); });
  EXPECT_NE(message.find(here.path.string() + " is in use by undex run, process " + std::to_string(getpid())), std::string::npos)
      << message;
  EXPECT_NE(message.find("-o"), std::string::npos) << message;
}

TEST(FolderLock, LeavesNothingBehind) {
  const TemporaryFolder here;
  { const FolderLock lock(here.path / "out" / "deep", "undex run"); }
  EXPECT_EQ(here.files(), 0u) << "folders that it has made and that are empty go";
  {
    const FolderLock lock(here.path / "out" / "deep", "undex run");
    require_unused_folder(here.path / "out" / "deep", false);
    std::ofstream(here.path / "out" / "deep" / "result") << "1";
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(here.path / "out" / "deep"), {}), 1);
  const FolderLock again(here.path / "out" / "deep", "undex run");
}

TEST(FolderLock, GoesWithAProcessThatIsKilled) {
  const TemporaryFolder here;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(here.path, "undex run");
    if (write(ready[1], "x", 1) != 1) _exit(1);
    for (;;) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  EXPECT_THROW(FolderLock(here.path, "undex run"), UsageError);
  kill(child, SIGKILL);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(here.files(), 1u);
  require_unused_folder(here.path, false);  // its file alone is nothing
  const FolderLock lock(here.path, "undex run");
  close(ready[0]);
  close(ready[1]);
}

TEST(FolderLock, OneAtATimeOfMany) {
  const TemporaryFolder here;
  const auto counter = here.path / "counter";
  constexpr int processes = 4, times = 50;
  for (int p = 0; p < processes; ++p)
    if (fork() == 0) {
      for (int done = 0; done < times;) try {
          const FolderLock lock(here.path / "out", "undex run");
          const int before = text_of(counter) ? std::stoi(*text_of(counter)) : 0;
          std::ofstream(counter) << before + 1;
          ++done;
        } catch (const UsageError&) {  // another has it
        }
      _exit(0);
    }
  while (wait(nullptr) > 0) {
  }
  EXPECT_EQ(read_text(counter), std::to_string(processes * times));
}

TEST(FolderLock, IsNotMadeInAFile) {
  const TemporaryFolder here;
  std::ofstream(here.path / "out") << "a file";
  EXPECT_THROW(FolderLock(here.path / "out", "undex run"), UsageError);
  EXPECT_THROW(FolderLock(here.path / "out" / "deeper", "undex run"), FileError);
}

}  // namespace
}  // namespace undex::output
