#include "output/run_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <set>

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

/// Names of everything in a folder and below it; a link is not followed.
std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (!entry.is_directory() || entry.is_symlink()) names.insert(entry.path().lexically_relative(folder).string());
  return names;
}

void touch(const std::filesystem::path& path, const std::string& text = "x") {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(RunFolder, ANewRunStandsAlone) {
  const TemporaryFolder here;
  const auto folder = here.path / "run";
  fill(folder);
  for (const char* name : {"scene.toml",
                           "evidence.h5",
                           "checkpoint.h5",
                           "checkpoint_00012.h5",
                           "profile.csv",
                           "profile_exact.csv",
                           "comparison.csv",
                           "curves.csv",
                           "outcome.json",
                           ".energy.csv.123.part",
                           "fields/particles.h5part",
                           "fields/solids.h5part",
                           "fields/solids2.h5part",
                           "fields/structure_00000.hdf",
                           "fields/structure_front_00007.hdf",
                           "fields/structure.hdf.series",
                           "fields/structure_front.hdf.series",
                           "pictures/energy.png",
                           "pictures/solids_speed.png",
                           "history/empty.csv"})
    touch(folder / name, std::string(name) == "history/empty.csv" ? "" : "x");
  const std::set<std::string> mine{"thesis.txt",        "log.txt",          "history/notes.txt",
                                   "history/table.csv", "fields/mine.pvsm", "pictures/mine.png",
                                   "sub/energy.csv",    "energy.csv.bak",   "fields/solids_my.h5part"};
  for (const std::string& name : mine) touch(folder / name, "number,name\n");
  begin_run_folder(folder, "given", "resolved");
  std::set<std::string> expected = mine;
  expected.insert({"scene.toml", "resolved.toml"});
  EXPECT_EQ(names_in(folder), expected);
  EXPECT_EQ(read_text(folder / "scene.toml"), "given");
  EXPECT_EQ(read_text(folder / "resolved.toml"), "resolved");
}

TEST(RunFolder, ANewRunFollowsNoLink) {
  const TemporaryFolder here;
  const auto folder = here.path / "run", other = here.path / "other";
  for (const char* name : {"fields/particles.h5part", "history/wall.csv", "energy.csv"}) touch(other / name);
  std::filesystem::create_directories(folder);
  for (const char* name : {"fields", "history", "energy.csv"}) std::filesystem::create_symlink(other / name, folder / name);
  std::filesystem::create_symlink(here.path / "nowhere", folder / "pictures");
  begin_run_folder(folder, "", "");
  EXPECT_EQ(names_in(folder), (std::set<std::string>{"scene.toml", "resolved.toml"}));
  EXPECT_EQ(names_in(other), (std::set<std::string>{"fields/particles.h5part", "history/wall.csv", "energy.csv"}));
}

TEST(RunFolder, WhatIsNoFileStandsInTheWay) {
  for (const char* name : {"summary.json", "energy.csv", "evidence.h5", "history/wall.csv", "fields/particles.h5part"}) {
    for (const bool pipe : {false, true}) {
      const TemporaryFolder here;
      fill(here.path);
      std::filesystem::remove(here.path / name);
      std::filesystem::create_directories((here.path / name).parent_path());
      if (pipe) ASSERT_EQ(mkfifo((here.path / name).c_str(), 0600), 0);
      else std::filesystem::create_directories(here.path / name);
      const std::set<std::string> before = names_in(here.path);
      const std::string message = message_of<UsageError>([&] { begin_run_folder(here.path, "", ""); });
      EXPECT_NE(message.find((here.path / name).string() + " is no file"), std::string::npos) << message;
      EXPECT_EQ(names_in(here.path), before) << "nothing is lost";
    }
  }
  const TemporaryFolder here;
  touch(here.path / "history");
  EXPECT_NE(message_of<UsageError>([&] { begin_run_folder(here.path, "", ""); }).find("is no folder"), std::string::npos);
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
