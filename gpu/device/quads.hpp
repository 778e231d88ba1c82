#pragma once
/// Groups of quads: lanes of a block that meet at barriers, four of them to an item. As groups of lanes (lanes.hpp), a
/// block on CUDA and loops on the host, where any number of quads gives the same bits.

#include <algorithm>
#include <span>
#include <vector>

#include "core/contact/row_sweep.hpp"

namespace gambeson::gpu {

constexpr int kQuad = 4;
static_assert(kQuad == kWays);

/// What each lane has of a sum over rows and of a largest number: parts of the sum by kSumLanes, those of its quad. The
/// lanes of a quad have the same.
template <int kQuads>
struct LaneTotals {
  static_assert(kSumLanes % kQuads == 0);
  double part[kSumLanes / kQuads] = {}, largest = 0;
};
/// Sums of eight parts each, in shared memory.
struct PartTotals {
  double sum[kSumLanes / 8], largest[kSumLanes / 8];
};
struct Totals {
  double sum, largest;
};
GAMBESON_HD inline Totals totalOf(const PartTotals& of) {
  double sum[kSumLanes / 8], largest = 0;
  for (int i = 0; i < kSumLanes / 8; ++i) sum[i] = of.sum[i], largest = std::max(largest, of.largest[i]);
  for (int step = 1; step < kSumLanes / 8; step *= 2)
    for (int i = 0; i < kSumLanes / 8; i += 2 * step) sum[i] += sum[i + step];
  return {sum[0], largest};
}

/// On the host.
template <int Q>
struct HostQuads {
  static constexpr int kQuads = Q, kLanes = Q * kQuad;

  template <class T>
  class PerLane {
   public:
    T& operator[](int lane) { return items_[static_cast<std::size_t>(lane)]; }
    const T& operator[](int lane) const { return items_[static_cast<std::size_t>(lane)]; }

   private:
    std::vector<T> items_ = std::vector<T>(kLanes);
  };

  template <class F>
  void each(F&& f) const {
    for (int lane = 0; lane < kLanes; ++lane) f(lane);
  }
  void sync() const {}
  /// (first + second) + (third + fourth) of each quad, for all four.
  void sumOfQuads(PerLane<Vec3>& v) const {
    for (int lane = 0; lane < kLanes; lane += kQuad) {
      const Vec3 sum = (v[lane] + v[lane + 1]) + (v[lane + 2] + v[lane + 3]);
      for (int k = 0; k < kQuad; ++k) v[lane + k] = sum;
    }
  }
  /// Sums of eight parts, to be seen after `sync`.
  void gather(const PerLane<LaneTotals<Q>>& of, PartTotals& to) const {
    double part[kSumLanes];
    std::fill_n(to.largest, kSumLanes / 8, 0.0);
    for (int q = 0; q < Q; ++q) {
      for (int i = 0; i < kSumLanes / Q; ++i) part[q + i * Q] = of[kQuad * q].part[i];
      to.largest[0] = std::max(to.largest[0], of[kQuad * q].largest);
    }
    for (int i = 0; i < kSumLanes / 8; ++i) {
      const double* p = part + 8 * i;
      to.sum[i] = ((p[0] + p[1]) + (p[2] + p[3])) + ((p[4] + p[5]) + (p[6] + p[7]));
    }
  }
};

}  // namespace gambeson::gpu
