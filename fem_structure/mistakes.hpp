// The mistakes of a user, gathered so that all of them are seen at once.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace undex::fem {

/// Each mistake is one line: who, what with which value, and the remedy.
class Mistakes {
 public:
  explicit Mistakes(std::string who) : who_(std::move(who)) {}
  template <class... Parts>
  void require(bool holds, const Parts&... parts) {
    if (holds) return;
    std::ostringstream text;
    text << who_ << ": ";
    (text << ... << parts);
    if (!all_.empty()) all_ += '\n';
    all_ += text.str();
  }
  void throw_if_any() const {
    if (!all_.empty()) throw std::invalid_argument(all_);
  }

 private:
  std::string who_, all_;
};

}  // namespace undex::fem
