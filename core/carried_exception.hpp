// An exception may not leave a region that threads share: it would end the program. It is carried out instead.
#pragma once

#include <exception>
#include <mutex>

namespace undex {

/// Made before the region; every piece of its work goes through run(), and rethrow() follows the region.
class CarriedException {
 public:
  /// Does the work; of what it throws on all threads the first is kept.
  template <class Work>
  void run(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!first_) first_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr first_;
};

}  // namespace undex
