#pragma once
/// Random numbers for scenes: the generator is in the standard to the bit, its distributions are not.

#include <random>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  /// In [-1, 1), evenly.
  double even() { return static_cast<double>(bits_() >> 11) * 0x1p-52 - 1; }
  Vec3 evenVec() {
    const double x = even(), y = even(), z = even();
    return {x, y, z};
  }
  /// Nearly normal, of variance 1: a sum of twelve.
  double normal() {
    double sum = 0;
    for (int k = 0; k < 12; ++k) sum += even();
    return 0.5 * sum;
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace gambeson::gpu
