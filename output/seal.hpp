// A seal at the end of a file: a checksum over all that stands before it. Damage of any kind is noticed before a library reads
// the file, which may crash on it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace undex::output {

/// XXH3, 128 bits, of some bytes, as 16 bytes. HDF5 takes no notice of them behind its own.
std::string seal_of(std::string_view bytes);

/// Does the file end with the seal of the rest? False also where it cannot be read.
bool is_sealed(const std::filesystem::path& path);

/// A checksum of what is handed over bit by bit, as 32 hexadecimal digits.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(const Checksum&) = delete;
  Checksum& operator=(const Checksum&) = delete;
  void add(const void* data, std::size_t bytes);
  std::string digits() const;
  std::string bytes() const;

 private:
  void* state_;
};

}  // namespace undex::output
