// Evidence: what is written comes back bit for bit, and a damaged file is told from a sound one.
#include "output/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/errors.hpp"
#include "temporary_folder.hpp"

namespace undex::output {
namespace {

Evidence sample() {
  Evidence evidence;
  evidence.time = 0.1;
  evidence.energy = Samples({{"time", "s"}, {"error", ""}});
  evidence.bodies = Samples({{"time", "s"}, {"water.volume", "m3"}});
  evidence.bodies.append({0, 1.0 / 3});
  evidence.lines["out"] = Samples({{"time", "s"}, {"distance", "m"}});
  evidence.lines["out"].append({0, std::nan("")});
  Samples wall({{"time", "s"}, {"pressure", "Pa"}, {"density", "kg/m3"}});
  for (int i = 0; i < 1000; ++i) wall.append({i / 3.0, std::sin(i), 1e3 / (1 + i)});
  wall.append({1e3, std::nan(""), -std::numeric_limits<double>::infinity()});
  evidence.probes = {{"wall-1", wall}, {"empty", Samples({{"time", "s"}, {"stress_xx", "Pa"}})}};
  evidence.energy.append({0, 1e-300});
  evidence.fields["fluid.position"] = {.components = 3, .values = {1, 2, 3, 0.1, 0.2, 0.3}};
  evidence.fields["fluid.mass"] = {.components = 1, .values = {7, 1.0 / 7}};
  return evidence;
}

void expect_same(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.empty() ? 0 : std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
}

void expect_same(const Samples& a, const Samples& b) {
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t c = 0; c < a.columns.size(); ++c) {
    EXPECT_EQ(a.columns[c].name, b.columns[c].name);
    EXPECT_EQ(a.columns[c].unit, b.columns[c].unit);
    expect_same(a.values[c], b.values[c]);
  }
}

TEST(Evidence, ComesBackBitForBit) {
  const TemporaryFolder folder;
  const Evidence written = sample();
  write_evidence(folder.path / "evidence.h5", written);
  EXPECT_EQ(folder.files(), 1u);
  const Evidence read = read_evidence(folder.path / "evidence.h5");
  EXPECT_EQ(read.time, written.time);
  expect_same(read.energy, written.energy);
  ASSERT_EQ(read.probes.size(), written.probes.size());
  for (const auto& [name, samples] : written.probes) expect_same(read.probes.at(name), samples);
  ASSERT_EQ(read.fields.size(), written.fields.size());
  for (const auto& [name, field] : written.fields) {
    EXPECT_EQ(read.fields.at(name).components, field.components);
    expect_same(read.fields.at(name).values, field.values);
  }
  EXPECT_EQ(read.field("fluid.position").vectors()[1], Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(read.series("wall-1", "density").y[1], 500);
  EXPECT_TRUE(read.series("wall-1", "velocity_x").empty());
  EXPECT_TRUE(read.series("none", "density").empty());
  EXPECT_THROW(read.field("fluid.energy"), FileError);
}

TEST(Evidence, WhereItCannotBeReadTheMessageNamesFileAndRemedy) {
  const TemporaryFolder folder;
  const auto path = folder.path / "evidence.h5";
  const auto message = [&] { return message_of<FileError>([&] { read_evidence(path); }); };
  EXPECT_NE(message().find("evidence.h5: no such file"), std::string::npos) << message();
  std::ofstream(path) << "no HDF5 at all";
  EXPECT_NE(message().find("evidence.h5: "), std::string::npos) << message();
  EXPECT_NE(message().find("run the scene again"), std::string::npos) << message();
}

TEST(Evidence, AFileThatIsCutOffOrScratchedIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path / "evidence.h5";
  write_evidence(path, sample());
  const std::string sound = read_text(path);
  const auto is_read = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return message_of<FileError>([&] { read_evidence(path); }).empty();
  };
  for (const double share : {0.0, 0.1, 0.5, 0.999})
    EXPECT_FALSE(is_read(sound.substr(0, std::size_t(share * double(sound.size())))));
  for (std::size_t at = 0; at < sound.size(); at += 97) {
    std::string scratched = sound;
    scratched[at] = static_cast<char>(~scratched[at]);
    EXPECT_FALSE(is_read(scratched)) << "byte " << at;
  }
  EXPECT_TRUE(is_read(sound));
}

TEST(Evidence, AFileThatCannotBeWrittenLeavesWhatWasThere) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path / "evidence.h5");  // a folder in its way
  EXPECT_THROW(write_evidence(folder.path / "evidence.h5", sample()), FileError);
  EXPECT_EQ(folder.files(), 1u);
}

}  // namespace
}  // namespace undex::output
