// Damaged checkpoints and evidence: whatever is done to the bytes, the file is refused with FileError; untouched it is read.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "core/errors.hpp"
#include "output/checkpoint.hpp"
#include "output/evidence.hpp"

namespace {

namespace fs = std::filesystem;
using namespace undex;

long setting(const char* name, long usual) {
  const char* given = std::getenv(name);
  return given ? std::atol(given) : usual;
}

class SealedFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const fs::path base = fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path();
    folder_ = base / ("undex_sealed_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  std::string bytes_of(const fs::path& path) {
    std::ostringstream bytes;
    bytes << std::ifstream(path, std::ios::binary).rdbuf();
    return bytes.str();
  }
  void write(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

  /// What a disk, a cable or a copy that was cut may do to a file.
  std::string damaged(std::string bytes, const std::string& other) {
    const std::size_t at = below(bytes.size()), length = 1 + below(bytes.size() - at);
    switch (below(8)) {
      case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
      case 1:
        for (std::size_t k = 0, count = 1 + below(30); k < count; ++k) bytes[below(bytes.size())] = static_cast<char>(below(256));
        break;
      case 2: bytes.resize(at); break;
      case 3: bytes.replace(at, length, length, '\0'); break;
      case 4:
        for (std::size_t k = at; k < at + length; ++k) bytes[k] = static_cast<char>(below(256));
        break;
      case 5: bytes.append(1 + below(5000), static_cast<char>(below(256))); break;
      case 6: bytes.erase(at, length); break;
      default: bytes.replace(at, length, other, std::min(at, other.size()), length);  // of an older file
    }
    return bytes;
  }

  /// `read` throws FileError for every damaged copy of the file, and nothing for the file itself. UNDEX_MUTATIONS sets their
  /// count.
  template <class Read>
  void refuses_damage(const fs::path& path, const std::string& other, Read read) {
    const std::string sound = bytes_of(path);
    const long count = setting("UNDEX_MUTATIONS", 2000);
    long refused = 0, accepted = 0;
    for (long i = 0; i < count; ++i) {
      std::string bytes;
      do bytes = damaged(sound, other);
      while (bytes == sound || bytes == other);  // all of an older file is a sound one
      write(path, bytes);
      try {
        read(path);
        ADD_FAILURE() << "damage " << i << " was not noticed";
      } catch (const FileError& error) {
        EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
        ++refused;
      }
      if (i % 100 != 0) continue;
      write(path, sound);
      EXPECT_NO_THROW(read(path));
      ++accepted;
    }
    std::printf("%s: %ld damaged, %ld refused, %ld sound ones read\n", path.filename().c_str(), count, refused, accepted);
  }

  std::mt19937_64 random_{static_cast<std::uint64_t>(setting("UNDEX_SEED", 1))};
  fs::path folder_;
};

TEST_F(SealedFiles, Checkpoints) {
  std::vector<double> pressures(500);
  for (double& each : pressures) each = static_cast<double>(below(1u << 30));
  const auto visit = [&](StateVisitor& state) { state("pressures", pressures); };
  const output::CheckpointTitle title{.time = 1e-5, .steps = 10, .scene = "end_time = 1", .numerics = "1", .start = "0"};
  output::write_checkpoint(folder_, title, visit);
  for (double& each : pressures) each += 1;
  output::write_checkpoint(folder_, title, visit);
  const std::string older = bytes_of(folder_ / output::checkpoint_names[1]);
  refuses_damage(folder_ / output::checkpoint_names[0], older, [&](const fs::path& path) {
    const std::vector<double> sound = pressures;
    output::Checkpoint(path).restore(visit);
    EXPECT_EQ(pressures, sound);
  });
}

TEST_F(SealedFiles, Evidence) {
  output::Evidence evidence;
  evidence.time = 0.1;
  evidence.energy = output::Samples({{"time", "s"}, {"error", ""}});
  for (int i = 0; i < 100; ++i) evidence.energy.append({0.001 * i, 1e-9 * i});
  output::write_evidence(folder_ / "evidence.h5", evidence);
  const std::string older = bytes_of(folder_ / "evidence.h5");
  evidence.fields["fluid.mass"] = {.components = 1, .values = {7, 1.0 / 7}};
  output::write_evidence(folder_ / "evidence.h5", evidence);
  refuses_damage(folder_ / "evidence.h5", older, [](const fs::path& path) { EXPECT_EQ(output::read_evidence(path).time, 0.1); });
}

}  // namespace
