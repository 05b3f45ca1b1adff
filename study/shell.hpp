// Words as a shell reads them.
#pragma once

#include <string>

namespace undex::study {

/// The text as one word of a command line, in quotes where it needs them.
inline std::string quoted_for_shell(const std::string& text) {
  if (!text.empty() && text.find_first_of(" \"'[]{}()$&;*?!<>|#~\\\n\t`") == std::string::npos) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace undex::study
