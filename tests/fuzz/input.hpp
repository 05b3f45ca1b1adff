// What the fuzzers share: an input as a file, scenes to change, and a claim that ends the process where it does not hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace undex::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder of this process in memory, where the system has one (/dev/shm); removed at the end.
const std::filesystem::path& scratch();

/// Writes the text to a file of the folder and returns its path.
std::filesystem::path written(const std::string& name, std::string_view text);

/// Scene files that are shipped, sorted by path.
const std::vector<std::filesystem::path>& shipped_scenes();

/// Ends the process, so that the fuzzer keeps the input.
void require(bool holds, const char* claim);

}  // namespace undex::fuzz
