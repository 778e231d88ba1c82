#pragma once
/// Sums in an order that depends on the number of items alone: of 8 neighbours, then of 8 of these, and so on.

#include <algorithm>

#include "gpu/device/lanes.hpp"

namespace gambeson::gpu {

constexpr int kSummed = 8;

template <class F, class T>
struct SumItems {
  F of;
  int n;
  T* to;
  GAMBESON_HD void operator()(int k) const {
    T sum{};
    const int end = n < kSummed * (k + 1) ? n : kSummed * (k + 1);
    for (int i = kSummed * k; i < end; ++i) sum.add(of(i));
    to[k] = sum;
  }
};
template <class T>
struct PartAt {
  const T* part;
  GAMBESON_HD T operator()(int i) const { return part[i]; }
};

/// Of up to so many items. T has `add`, and nothing added is T{}.
template <class Device, class T>
class TreeSum {
  template <class U>
  using Buffer = typename Device::template Buffer<U>;

 public:
  explicit TreeSum(int most) : part_(size(partsOf(most))), next_(size(partsOf(partsOf(most)))) {}

  /// The sum of of(i), i < n, on the device.
  template <class F>
  const T* run(typename Device::Queue& queue, int n, const F& of) {
    Buffer<T>*from = &next_, *to = &part_;
    queue.forEach(partsOf(n), SumItems<F, T>{of, n, to->data()});
    for (n = partsOf(n); n > 1; n = partsOf(n)) {
      std::swap(from, to);
      queue.forEach(partsOf(n), SumItems<PartAt<T>, T>{{from->data()}, n, to->data()});
    }
    return to->data();
  }

 private:
  static int partsOf(int n) { return std::max(1, (n + kSummed - 1) / kSummed); }
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  Buffer<T> part_, next_;
};

}  // namespace gambeson::gpu
