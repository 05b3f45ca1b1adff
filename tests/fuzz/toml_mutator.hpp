// Changes of a TOML text that keep its structure: lines and values change, not bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace undex::fuzz {

/// As LLVMFuzzerCustomMutator: changes `size` bytes in place to at most `most`, returns how many there are then. Half of the
/// changes are libFuzzer's own.
std::size_t mutate_toml(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed);

/// As LLVMFuzzerCustomCrossOver: the lines of one with some lines of the other.
std::size_t cross_toml(const std::uint8_t* one, std::size_t one_size, const std::uint8_t* other, std::size_t other_size,
                       std::uint8_t* out, std::size_t most, unsigned seed);

}  // namespace undex::fuzz
