#include "output/seal.hpp"

#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <vector>

namespace undex::output {
namespace {

constexpr std::size_t seal_bytes = sizeof(XXH128_canonical_t);

XXH3_state_t* state_of(void* state) { return static_cast<XXH3_state_t*>(state); }

}  // namespace

Checksum::Checksum() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_of(state_));
}

Checksum::~Checksum() { XXH3_freeState(state_of(state_)); }

void Checksum::add(const void* data, std::size_t bytes) {
  if (bytes > 0) XXH3_128bits_update(state_of(state_), data, bytes);
}

std::string Checksum::bytes() const {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits_digest(state_of(state_)));
  return {reinterpret_cast<const char*>(canonical.digest), seal_bytes};
}

std::string Checksum::digits() const {
  std::string text;
  for (const char byte : bytes()) {
    char two[3];
    std::snprintf(two, sizeof two, "%02x", static_cast<unsigned char>(byte));
    text += two;
  }
  return text;
}

std::string seal_of(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes.data(), bytes.size());
  return sum.bytes();
}

bool is_sealed(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg();
  if (!file || size <= std::streamoff(seal_bytes)) return false;
  file.seekg(0);
  Checksum sum;
  std::vector<char> part(1u << 20);
  for (std::streamoff left = size - std::streamoff(seal_bytes); left > 0;) {
    const std::streamsize now = std::min<std::streamoff>(left, std::streamoff(part.size()));
    if (!file.read(part.data(), now)) return false;
    sum.add(part.data(), static_cast<std::size_t>(now));
    left -= now;
  }
  std::array<char, seal_bytes> seal{};
  return file.read(seal.data(), seal.size()) && sum.bytes() == std::string(seal.data(), seal.size());
}

}  // namespace undex::output
