#pragma once
/// What runs share that are made by one process, side by side on one device.

#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace gambeson {

class Company {
 public:
  /// `memory_bytes`: of the device, for all of them; 0: as much as they want.
  explicit Company(std::size_t memory_bytes) : all_bytes_(memory_bytes), free_bytes_(memory_bytes) {}

  std::size_t memory() const { return all_bytes_; }

  /// A run's part of the memory, given back at the end.
  class Share {
   public:
    Share() = default;
    Share(Company& of, std::size_t bytes) : of_(&of), bytes_(bytes) {}
    Share(Share&& other) noexcept : of_(other.of_), bytes_(other.bytes_) { other.of_ = nullptr; }
    Share& operator=(Share&&) = delete;
    ~Share();

   private:
    Company* of_ = nullptr;
    std::size_t bytes_ = 0;
  };
  /// Waits until others have left so much. More than there is at all is waited for until nobody else has any.
  Share take(std::size_t bytes);

 private:
  std::mutex lock_;
  std::condition_variable left_;
  std::size_t all_bytes_, free_bytes_;
  int shares_ = 0;
};

}  // namespace gambeson
