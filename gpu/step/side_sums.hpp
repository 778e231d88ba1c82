#pragma once
/// Several sums side by side, each in an order that depends on the number of its items alone: of every n-th item, then
/// of these sums, and so on. Neighbouring lanes read neighbouring items.

#include <algorithm>

#include "gpu/device/lanes.hpp"

namespace gambeson::gpu {

constexpr int kSummedApart = 32;  ///< items of a part, at most

template <class F, class T>
struct SumApart {
  F of;
  int n, parts;
  T* to;
  GAMBESON_HD void operator()(int k) const {
    const int sum = k / parts;
    T all{};
    for (int i = k - sum * parts; i < n; i += parts) all.add(of(sum, i));
    to[k] = all;
  }
};
template <class T>
struct SideAt {
  const T* part;
  int n;
  GAMBESON_HD T operator()(int sum, int i) const { return part[sum * n + i]; }
};

/// Up to `most` sums of up to so many items. T has `add`, and nothing added is T{}.
template <class Device, class T>
class SideSums {
  using Buffer = typename Device::template Buffer<T>;

 public:
  SideSums() = default;
  SideSums(int most, int items) : part_(size(most * partsOf(items))), next_(size(most * partsOf(partsOf(items)))) {}

  /// The sums of of(sum, i), i < n, for sum < sums, on the device until the next are asked for.
  template <class F>
  const T* run(typename Device::Queue& queue, int sums, int n, const F& of) {
    Buffer *from = &next_, *to = &part_;
    queue.forEach(sums * partsOf(n), SumApart<F, T>{of, n, partsOf(n), to->data()});
    for (n = partsOf(n); n > 1; n = partsOf(n)) {
      std::swap(from, to);
      queue.forEach(sums * partsOf(n), SumApart<SideAt<T>, T>{{from->data(), n}, n, partsOf(n), to->data()});
    }
    return to->data();
  }

 private:
  static int partsOf(int n) { return std::max(1, (n + kSummedApart - 1) / kSummedApart); }
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  Buffer part_, next_;
};

}  // namespace gambeson::gpu
