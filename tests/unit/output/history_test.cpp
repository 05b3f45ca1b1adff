#include "output/history.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include "core/errors.hpp"
#include "output/series.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

TEST(History, HeaderAndRowsAsWritten) {
  const TemporaryFolder folder;
  History history(folder.path / "wall.csv", {{"time", "s"}, {"pressure", "Pa"}, {"void_fraction", ""}});
  history.append({0.0, 101325.0, 0.0});
  history.append({1.23456789e-5, 7.22e8, 2.75e-4});
  history.close();
  EXPECT_EQ(history.rows(), 2u);
  EXPECT_EQ(read_text(folder.path / "wall.csv"),
            "time [s],pressure [Pa],void_fraction [-]\n0,101325,0\n1.23456789e-05,722000000,0.000275\n");
}

TEST(History, HeaderIsOnDiskAtOnceAndRowsAfterFlush) {
  const TemporaryFolder folder;
  History history(folder.path / "a.csv", {{"time", "s"}, {"x", "m"}});
  EXPECT_EQ(read_text(folder.path / "a.csv"), "time [s],x [m]\n");
  history.append({1.0, 2.0});
  history.flush();
  EXPECT_EQ(read_text(folder.path / "a.csv"), "time [s],x [m]\n1,2\n");
}

TEST(History, IsReadBackAsSeries) {
  const TemporaryFolder folder;
  History history(folder.path / "a.csv", {{"time", "s"}, {"pressure", "Pa"}, {"velocity_x", "m/s"}});
  history.append({1e-6, 5.0, -3.0});
  history.append({2e-6, 6.0, -4.0});
  history.close();
  const std::vector<HistoryColumn> columns = read_history(folder.path / "a.csv");
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns[1].name, "velocity_x");
  const Series& velocity = columns[1].series;
  EXPECT_EQ(velocity.t, (std::vector<double>{1e-6, 2e-6}));
  EXPECT_EQ(velocity.y, (std::vector<double>{-3.0, -4.0}));
}

TEST(History, OnlyWholeRowsReachTheFile) {
  const TemporaryFolder folder;
  const auto path = folder.path / "a.csv";
  History history(path, {{"time", "s"}, {"x", "m"}});
  const std::string header = read_text(path);
  for (int row = 1; row <= 20000; ++row) history.append({row * 1e-7, row * -1.23456789e-5});
  EXPECT_EQ(read_text(path), header) << "no part of a row before all of them";
  history.flush();
  EXPECT_EQ(read_history(path).front().series.t.size(), 20000u);
}

TEST(History, AFullDiskLeavesWholeRows) {
  const TemporaryFolder folder;
  const auto path = folder.path / "a.csv";
  History history(path, {{"time", "s"}, {"x", "m"}});
  struct rlimit before {};
  getrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_IGN);
  const struct rlimit little { 1000, before.rlim_max };
  setrlimit(RLIMIT_FSIZE, &little);
  for (int row = 0; row < 100; ++row) history.append({row * 1e-7, -1.23456789e-5});
  EXPECT_THROW(history.flush(), FileError);
  setrlimit(RLIMIT_FSIZE, &before);
  const std::string text = read_text(path);
  EXPECT_GT(text.size(), 950u);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(read_history(path).front().series.y.back(), -1.23456789e-5);
}

TEST(History, ARowThatIsCutOffIsLeftOut) {
  const TemporaryFolder folder;
  const auto path = folder.path / "a.csv";
  const std::string whole = "time [s],x [m]\n1,2.5\n2,3.5\n";
  for (std::size_t length = whole.find("2,3.5"); length < whole.size(); ++length) {
    std::ofstream(path) << whole.substr(0, length);
    EXPECT_EQ(read_history(path, true).front().series.y, std::vector<double>{2.5}) << length;
  }
  std::ofstream(path) << whole.substr(0, whole.size() - 1);
  EXPECT_EQ(read_history(path).front().series.y, (std::vector<double>{2.5, 3.5})) << "somebody's own table may end so";
}

TEST(History, APipeInItsPlaceIsAnError) {
  const TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder.path / "a.csv").c_str(), 0600), 0);
  EXPECT_THROW(History(folder.path / "a.csv", {{"time", "s"}}), FileError);
}

TEST(History, WrongUseIsOurDefect) {
  const TemporaryFolder folder;
  History history(folder.path / "a.csv", {{"time", "s"}, {"x", "m"}});
  EXPECT_THROW(history.append({1.0}), std::invalid_argument);
  history.close();
  EXPECT_THROW(history.append({1.0, 2.0}), std::logic_error);
  EXPECT_THROW(History(folder.path / "b.csv", {}), std::invalid_argument);
  EXPECT_THROW(History(folder.path / "b.csv", {{"a,b", "m"}}), std::invalid_argument);
}

TEST(History, MissingFolderNamesPathReasonAndRemedy) {
  const TemporaryFolder folder;
  const auto path = folder.path / "none" / "a.csv";
  const std::string message = message_of<FileError>([&] { History(path, {{"time", "s"}}); });
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_NE(message.find("No such file or directory"), std::string::npos) << message;
  EXPECT_NE(message.find("-o"), std::string::npos) << message;
}

TEST(History, FullDiskThrows) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string message = message_of<FileError>([] { History("/dev/full", {{"time", "s"}}); });
  EXPECT_NE(message.find("No space left on device"), std::string::npos) << message;
  EXPECT_NE(message.find("free some space"), std::string::npos) << message;
}

}  // namespace
}  // namespace undex::output
