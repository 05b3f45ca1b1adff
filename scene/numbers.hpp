// Numbers as text: as few digits as read back to the same number.
#pragma once

#include <charconv>
#include <string>

namespace undex::scene {

inline std::string shortest(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// Few digits, for messages.
inline std::string rounded(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6).ptr};
}

}  // namespace undex::scene
