#pragma once
/// Boxes that move, array by array: one is compared with eight others at once.

#include <array>
#include <vector>

#include "core/contact/four.hpp"
#include "core/contact/moving_box.hpp"

namespace gambeson {

class BoxLanes {
 public:
  static constexpr int kMost = 8;

  void resize(std::size_t n) {
    for (std::vector<float>& of : number_) of.resize(n + kMost);  // past the last there is something to load
  }
  void set(int i, const MovingBox& box) {
    const std::array<float, 12> numbers = box.numbers();
    for (std::size_t k = 0; k < 12; ++k) number_[k][static_cast<std::size_t>(i)] = numbers[k];
  }

  /// Bit k: box first + k may meet `one` (`mayMeet`, the same comparisons); of `count` boxes, at most kMost.
  int meeting(const MovingBox& one, int first, int count, float margin) const {
    const std::array<float, 12> a = one.numbers();
    int bits = 0;
    for (int k = 0; k < count; k += 4) {
      FourBits apart{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Four lo = load(axis, first + k), hi = load(3 + axis, first + k), way_lo = load(6 + axis, first + k),
                   way_hi = load(9 + axis, first + k);
        const Four up = most(Four{}, way_hi - all(a[6 + axis])), down = least(Four{}, way_lo - all(a[9 + axis]));
        apart |= (all(a[axis] - margin) > hi + up) | (lo + down > all(a[3 + axis] + margin));
      }
      bits |= (~signs(apart) & 15) << k;
    }
    return bits & ((1 << count) - 1);
  }

 private:
  Four load(std::size_t which, int i) const {
    Four four;
    __builtin_memcpy(&four, number_[which].data() + i, sizeof four);
    return four;
  }

  std::array<std::vector<float>, 12> number_;  ///< lo, hi, way_lo, way_hi, of x, y, z
};

}  // namespace gambeson
