#pragma once
/// Times of phases.

#include <chrono>

namespace gambeson::gpu {

/// Adds the time since the last lap to a phase [s].
class LapClock {
 public:
  void lap(double& phase) {
    const auto now = std::chrono::steady_clock::now();
    phase += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace gambeson::gpu
