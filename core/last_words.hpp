// What is still to be done when a program ends where no exception can pass: out of a parallel region, out of a destructor.
#pragma once

#include <atomic>
#include <functional>
#include <utility>

namespace undex {

/// As long as it lives its task, which is told why the program ends, is the one that say_last_words() does. One at a time.
class LastWords {
 public:
  explicit LastWords(std::function<void(const char*)> task) : task_(std::move(task)) { present() = this; }
  ~LastWords() { present() = nullptr; }
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

 private:
  friend void say_last_words(const char* why) noexcept;
  static std::atomic<LastWords*>& present() {
    static std::atomic<LastWords*> one = nullptr;
    return one;
  }
  std::function<void(const char*)> task_;
};

/// For a terminate handler: does the task, once. Other threads may still be at work, so that the task may only touch what they
/// do not.
inline void say_last_words(const char* why) noexcept {
  LastWords* const words = LastWords::present().exchange(nullptr);
  if (words == nullptr) return;
  try {
    words->task_(why);
  } catch (...) {  // there is nobody left to tell
  }
}

}  // namespace undex
