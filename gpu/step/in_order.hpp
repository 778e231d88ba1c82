#pragma once
/// A thread that does what it is given, one thing after the other.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace gambeson::gpu {

class InOrder {
 public:
  /// `most`: things that may wait; `start` is called on the thread first.
  explicit InOrder(
      std::size_t most, std::function<void()> start = [] {})
      : most_(most), thread_([this, start = std::move(start)] {
          start();
          work();
        }) {}
  ~InOrder() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  InOrder(const InOrder&) = delete;
  InOrder& operator=(const InOrder&) = delete;

  /// Waits where too much waits already. Throws what something given before has thrown; nothing after that is done.
  void give(std::function<void()> job) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return jobs_.size() < most_ || failure_; });
    refuse();
    jobs_.push_back(std::move(job));
    lock.unlock();
    changed_.notify_all();
  }
  /// Until nothing is being done any more.
  void settle() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !busy_ && (jobs_.empty() || failure_); });
  }
  /// Until all is done; throws as `give` does.
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return (jobs_.empty() && !busy_) || failure_; });
    refuse();
  }

 private:
  void refuse() {
    if (failure_) std::rethrow_exception(failure_);
  }
  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return !jobs_.empty() || ends_; });
      if (jobs_.empty() || failure_) return;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      busy_ = true;
      lock.unlock();
      std::exception_ptr failure;
      try {
        job();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      busy_ = false;
      failure_ = failure;
      changed_.notify_all();
      if (failure_) return;
    }
  }

  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  std::exception_ptr failure_;
  bool busy_ = false, ends_ = false;
  std::thread thread_;
};

}  // namespace gambeson::gpu
