#include "output/run_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "output/history.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

RunRecord record() {
  RunRecord r;
  r.scene = "tube";
  r.status = "stopped";
  r.message = "a cell is inside out";
  r.time_s = 3.3e-5;
  r.steps = 1234;
  r.cpu_time_s = 4.5;
  r.particles = 1000;
  r.particle_updates = 1234000;
  r.peak_memory_bytes = 5'000'000'000;
  r.solver_memory_bytes = 250'000;
  r.mass_error = 1e-16;
  r.momentum_error = std::nan("");
  r.interface_impulse_error = 2e-9;
  r.clamps = {{"density", 3}};
  r.passes = {{"pairs", 1.5}};
  r.metrics = {{"arrival_s", 1.6e-5}, {"closure_s", std::nan("")}};
  return r;
}

/// A folder as a run leaves it.
void fill(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "history");
  write_summary(folder / "summary.json", record());
  std::ofstream(folder / "resolved.toml") << "name = \"tube\"\n";
  History(folder / "energy.csv", {{"time", "s"}, {"kinetic", "J"}, {"error", ""}}).append({0, 2, 0});
  History wall(folder / "history" / "wall.csv", {{"time", "s"}, {"pressure", "Pa"}, {"void_fraction", ""}});
  wall.append({0, 1e5, 0});
  wall.append({1e-6, 2e5, std::nan("")});
}

TEST(RunFolder, ReadsWhatARunWrote) {
  const TemporaryFolder folder;
  fill(folder.path);
  const RunFolder run = read_run_folder(folder.path);
  EXPECT_EQ(to_json(run.record), to_json(record()));
  EXPECT_TRUE(std::isnan(run.record.momentum_error));
  EXPECT_FALSE(run.record.interface_energy_error.has_value());
  EXPECT_EQ(run.settings, "name = \"tube\"\n");
  ASSERT_EQ(run.energies.size(), 2u);
  EXPECT_EQ(run.energies[0].name, "kinetic");
  EXPECT_EQ(run.energies[0].unit, "J");
  EXPECT_EQ(run.energies[1].unit, "-");
  const auto& wall = run.probes.at("wall");
  EXPECT_EQ(wall[0].series.y, (std::vector<double>{1e5, 2e5}));
  EXPECT_EQ(wall[1].series.y, (std::vector<double>{0})) << "a history ends before what is no number";
}

TEST(RunFolder, SaysWhyAFolderIsNoFinishedRun) {
  const TemporaryFolder folder;
  const auto read = [&] { read_run_folder(folder.path); };
  EXPECT_NE(message_of<FileError>([&] { read_run_folder(folder.path / "none"); }).find("no such folder"), std::string::npos);
  EXPECT_NE(message_of<FileError>(read).find("not the folder of a run"), std::string::npos);
  fill(folder.path);
  std::filesystem::remove(folder.path / "summary.json");
  EXPECT_NE(message_of<FileError>(read).find("not finished (no summary.json)"), std::string::npos);
}

TEST(RunFolder, EveryMistakeAtOnce) {
  const TemporaryFolder folder;
  fill(folder.path);
  std::ofstream(folder.path / "summary.json") << "{\"steps\": ";
  std::ofstream(folder.path / "energy.csv") << "time [s],kinetic [J]\n0,1\n1e-6\n";
  std::ofstream(folder.path / "history" / "wall.csv") << "time [s],pressure [Pa]\n1,1\n0,1\n";
  const std::string message = message_of<FileError>([&] { read_run_folder(folder.path); });
  EXPECT_NE(message.find("summary.json: not the summary of a run"), std::string::npos) << message;
  EXPECT_NE(message.find("energy.csv:3"), std::string::npos) << message;
  EXPECT_NE(message.find("wall.csv: its times go back"), std::string::npos) << message;
}

TEST(RunFolder, SummariesOfOtherProgramsAreReadAsFarAsTheyGo) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "summary.json")
      << R"({"scene": "x", "status": "done", "new": {"a": [1]}, "steps": "many", "metrics": {"a_s": null, "b": 2, "c": "d"}})";
  const RunRecord r = read_summary(folder.path / "summary.json");
  EXPECT_EQ(r.status, "done");
  EXPECT_EQ(r.steps, 0);
  EXPECT_TRUE(std::isnan(r.energy_error)) << "not known";
  ASSERT_EQ(r.metrics.size(), 2u);
  EXPECT_TRUE(std::isnan(r.metrics[0].second));
}

}  // namespace
}  // namespace undex::output
