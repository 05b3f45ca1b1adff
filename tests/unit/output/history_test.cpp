#include "output/history.hpp"

#include <gtest/gtest.h>

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
