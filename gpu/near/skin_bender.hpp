#pragma once
/// The skin that follows the links (core/contact/skin.hpp), bent on any device for a window of steps at once: the bits
/// of skinPositions.

#include <memory>
#include <span>
#include <vector>

#include "core/contact/skin.hpp"

namespace gambeson::gpu {

class SkinBender {
 public:
  virtual ~SkinBender() = default;

  /// `poses`: of all links at each of so many times, those of a time together. No more times than there is room for.
  virtual void bend(std::span<const Pose> poses, int times) = 0;
  /// Of the last window, at one of its times.
  virtual std::vector<Vec3> positions(int time) = 0;
  /// Median of so many passes over the last window.
  virtual double medianMilliseconds(int passes) = 0;
};

/// most_times: of a window.
std::unique_ptr<SkinBender> skinOnReference(const Skin& skin, int most_times);
std::unique_ptr<SkinBender> skinOnCuda(const Skin& skin, int most_times);

}  // namespace gambeson::gpu
