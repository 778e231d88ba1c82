#pragma once
/// Errors out of parallel loops: one that leaves a thread of OpenMP ends the program.

#include <exception>
#include <limits>
#include <mutex>

namespace gambeson {

/// Keeps what the lowest index threw, whatever the number of threads.
class CarriedError {
 public:
  template <class F>
  void guard(long index, F&& f) {
    try {
      f();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (index >= lowest_) return;
      lowest_ = index;
      error_ = std::current_exception();
    }
  }
  /// After the loop: throws what was kept, if anything was.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  long lowest_ = std::numeric_limits<long>::max();
  std::exception_ptr error_;
};

}  // namespace gambeson
