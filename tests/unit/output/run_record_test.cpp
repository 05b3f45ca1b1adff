#include "output/run_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "output/files.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

RunRecord sample() {
  RunRecord record;
  record.scene = "rigid_cylinder";
  record.status = "done";
  record.time_s = 1.25e-4;
  record.steps = 1234;
  record.particle_updates = 5'000'000'000;
  record.energy_error = 1e-3;
  record.clamps = {{"density", 0}, {"smoothing", 5'000'000'000}};
  record.passes = {{"forces", 10.5}, {"neighbours", 3.25}};
  record.metrics = {{"first_peak_pa", 7.2e8}, {"arrival_s", 1.44e-5}, {"collapse_s", std::nan("")}};
  return record;
}

TEST(RunRecord, HasEveryPromisedKey) {
  const auto json = nlohmann::json::parse(to_json(sample()));
  for (const char* key : {"scene", "status", "time_s", "steps", "wall_time_s", "cpu_time_s", "threads", "particles",
                          "wall_particles", "cells", "particle_updates", "neighbour_interactions", "peak_memory_bytes",
                          "mass_error", "momentum_error", "energy_error", "clamps", "passes", "metrics"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_FALSE(json.contains("interface_energy_error"));
  EXPECT_EQ(json["particle_updates"], 5'000'000'000);
  EXPECT_DOUBLE_EQ(json["passes"]["forces"], 10.5);
  EXPECT_EQ(json["clamps"]["density"], 0);
  EXPECT_EQ(json["clamps"]["smoothing"], 5'000'000'000);
}

TEST(RunRecord, CoupledRunsTellTheInterfaceError) {
  RunRecord record = sample();
  record.interface_energy_error = 2e-3;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(to_json(record))["interface_energy_error"], 2e-3);
  EXPECT_FALSE(nlohmann::json::parse(to_json(record)).contains("interface_impulse_error"));
  record.interface_impulse_error = 1e-15;
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(to_json(record))["interface_impulse_error"], 1e-15);
}

TEST(RunRecord, TrustReadsBack) {
  const TemporaryFolder folder;
  RunRecord record = sample();
  EXPECT_FALSE(nlohmann::json::parse(to_json(record)).contains("trust"));
  record.step_limits = {{"Courant (water)", 280}, {"burn (charge)", 6}};
  record.trust = {{"energy", Trust::good, "fine"}, {"charge", Trust::notice, "coarse"}, {"mass", Trust::bad, "lost"}};
  write_summary(folder.path / "summary.json", record);
  const RunRecord back = read_summary(folder.path / "summary.json");
  EXPECT_EQ(back.step_limits, record.step_limits);
  ASSERT_EQ(back.trust.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(back.trust[k].about, record.trust[k].about);
    EXPECT_EQ(back.trust[k].level, record.trust[k].level);
    EXPECT_EQ(back.trust[k].text, record.trust[k].text);
  }
}

TEST(RunRecord, ObstaclesReadBack) {
  const TemporaryFolder folder;
  RunRecord record = sample();
  EXPECT_FALSE(nlohmann::json::parse(to_json(record)).contains("obstacles"));
  record.obstacles = {{.name = "ball",
                       .motion = "free",
                       .mass = 2.5,
                       .displacement = {1e-3, 2e-3},
                       .rotation = {0.5},
                       .velocity = {3, std::nan("")},
                       .spin = {-7},
                       .impulse = {10, 20}},
                      {.name = "rudder",
                       .motion = "fixed",
                       .mass = {},
                       .displacement = {0, 0},
                       .rotation = {0},
                       .velocity = {0, 0},
                       .spin = {0},
                       .impulse = {1, 2}}};
  write_summary(folder.path / "summary.json", record);
  const RunRecord read = read_summary(folder.path / "summary.json");
  ASSERT_EQ(read.obstacles.size(), 2u);
  EXPECT_EQ(read.obstacles[0].name, "ball");
  EXPECT_EQ(read.obstacles[0].motion, "free");
  EXPECT_EQ(read.obstacles[0].mass, 2.5);
  EXPECT_EQ(read.obstacles[0].displacement, (std::vector<double>{1e-3, 2e-3}));
  EXPECT_EQ(read.obstacles[0].velocity[0], 3);
  EXPECT_TRUE(std::isnan(read.obstacles[0].velocity[1]));
  EXPECT_EQ(read.obstacles[0].spin, std::vector<double>{-7});
  EXPECT_FALSE(read.obstacles[1].mass);
  EXPECT_EQ(read.obstacles[1].impulse, (std::vector<double>{1, 2}));
}

TEST(RunRecord, StructuresReadBack) {
  const TemporaryFolder folder;
  RunRecord record = sample();
  EXPECT_FALSE(nlohmann::json::parse(to_json(record)).contains("structures"));
  record.structures = {{.name = "front",
                        .cells = 40,
                        .steps = 1000,
                        .kinetic = 1,
                        .elastic = 2,
                        .plastic = 3,
                        .viscous = 4,
                        .received = 5,
                        .external = 6,
                        .energy_error = 7e-6,
                        .impulse = {8, 9, 10}},
                       {}};
  record.structures[1].kinetic = std::nan("");
  write_summary(folder.path / "summary.json", record);
  const RunRecord read = read_summary(folder.path / "summary.json");
  ASSERT_EQ(read.structures.size(), 2u);
  const StructureRecord& front = read.structures[0];
  EXPECT_EQ(front.name, "front");
  EXPECT_EQ(front.cells, 40);
  EXPECT_EQ(front.steps, 1000);
  EXPECT_EQ((std::vector<double>{front.kinetic, front.elastic, front.plastic, front.viscous, front.received, front.external}),
            (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(front.energy_error, 7e-6);
  EXPECT_EQ(front.impulse, (std::vector<double>{8, 9, 10}));
  EXPECT_TRUE(std::isnan(read.structures[1].kinetic));
}

TEST(RunRecord, WhatDidNotHappenIsNull) {
  const auto json = nlohmann::json::parse(to_json(sample()));
  EXPECT_TRUE(json["metrics"]["collapse_s"].is_null());
  EXPECT_DOUBLE_EQ(json["metrics"]["arrival_s"], 1.44e-5);
}

TEST(RunRecord, KeepsTheOrderOfMetrics) {
  const std::string text = to_json(sample());
  EXPECT_LT(text.find("first_peak_pa"), text.find("arrival_s"));
  EXPECT_LT(text.find("\"scene\""), text.find("\"status\""));
}

TEST(RunRecord, TextThatIsNotUtf8DoesNotLoseTheRecord) {
  RunRecord record = sample();
  record.message = "bad \xff byte";
  EXPECT_TRUE(nlohmann::json::accept(to_json(record)));
}

TEST(RunRecord, SummaryIsWrittenWholeAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  write_summary(folder.path / "summary.json", sample());
  write_summary(folder.path / "summary.json", sample());
  EXPECT_EQ(nlohmann::json::parse(read_text(folder.path / "summary.json"))["steps"], 1234);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Files, FailedWriteKeepsTheOldFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "taken");  // a folder cannot be replaced by a file
  const std::string message = message_of<FileError>([&] { write_text_atomically(folder.path / "taken", "text"); });
  EXPECT_NE(message.find("taken"), std::string::npos);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Files, FileInPlaceOfAFolderIsReported) {
  const TemporaryFolder folder;
  write_text_atomically(folder.path / "file", "text");
  const std::string message =
      message_of<FileError>([&] { write_text_atomically(folder.path / "file" / "summary.json", "text"); });
  EXPECT_NE(message.find("Not a directory"), std::string::npos) << message;
}

TEST(Files, SpaceIsAskedForBeforeItIsUsed) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(require_space(folder.path / "a", 1.0));
  EXPECT_THROW(require_space(folder.path / "a", 1e24), FileError);
}

TEST(Process, CostsAreMeasured) {
  EXPECT_GT(peak_memory_bytes(), 1'000'000);
  const double before = cpu_time();
  double sum = 0;
  for (int i = 1; i < 3'000'000; ++i) sum += std::sqrt(static_cast<double>(i));
  EXPECT_GT(sum, 0);
  EXPECT_GT(cpu_time(), before);
}

}  // namespace
}  // namespace undex::output
