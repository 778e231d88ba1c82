#pragma once
/// The reference device: kernels as loops on the host, under OpenMP. It needs no GPU and gives the bits of CUDA.

#include <algorithm>
#include <chrono>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "core/math/parallel.hpp"
#include "gpu/device/list.hpp"

namespace gambeson::gpu {

/// W: lanes of a group. The same bits for each.
template <int W>
class ReferenceOf {
 public:
  using Group = HostLanes<W>;

  template <class T>
  class Buffer {
   public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : items_(size) {}
    T* data() { return items_.data(); }
    const T* data() const { return items_.data(); }
    std::size_t size() const { return items_.size(); }

   private:
    std::vector<T> items_;
  };

  /// Memory of the host that a device writes to by itself.
  template <class T>
  using HostBuffer = Buffer<T>;
  /// A place in a queue.
  class Mark {
   public:
    void wait() const {}
  };
  /// Seconds between places in a queue.
  class Laps {
   public:
    void start(auto&) {
      seconds_.clear();
      last_ = std::chrono::steady_clock::now();
    }
    void lap(auto&) {
      const auto now = std::chrono::steady_clock::now();
      seconds_.push_back(std::chrono::duration<double>(now - last_).count());
      last_ = now;
    }
    /// After a wait for the last place.
    const std::vector<double>& seconds() { return seconds_; }

   private:
    std::chrono::steady_clock::time_point last_;
    std::vector<double> seconds_;
  };

  /// Work in the order in which it was given. Here each piece is done at once.
  class Queue {
   public:
    /// f(i) for i < n.
    template <class F>
    void forEach(int n, const F& f) {
      forAll(Each::much, n, [&](int i) { f(i); });
    }
    /// f(item) for the items of a list whose length only the device knows.
    template <class T, class F>
    void forItems(const List<T>& list, const F& f) {
      forAll(Each::much, static_cast<long>(list.size()), [&](long i) { f(list.items[i], static_cast<Count>(i)); });
    }
    /// f(i) for i < of.size(), which only the device knows.
    template <class Sized, class F>
    void forEachOf(const Sized& of, const F& f) {
      forAll(Each::much, static_cast<long>(of.size()), [&](long i) { f(static_cast<int>(i)); });
    }
    /// kernel(group, shared memory, index of the group, n) for n groups.
    template <class Kernel>
    void forGroups(int n, const Kernel& kernel) {
#pragma omp parallel for schedule(dynamic)
      for (int i = 0; i < n; ++i) {
        typename Kernel::Shared shared;
        kernel(Group{}, shared, i, n);
      }
    }
    /// The same, by as many groups as work side by side: for kernels that take their items one after the other.
    template <class Kernel>
    void forResidentGroups(const Kernel& kernel) {
      forGroups(4 * omp_get_max_threads(), kernel);
    }
    /// Work that is done again and again as long as goes() says so on the device; where only() does. In recordings
    /// alone (Replay).
    template <class Goes, class F>
    void repeatWhile(const Goes& goes, F&& work) {
      while (goes()) work();
    }
    template <class Only, class F>
    void doIf(const Only& only, F&& work) {
      if (only()) work();
    }
    template <class T>
    void zero(Buffer<T>& buffer) {
      std::fill_n(buffer.data(), buffer.size(), T{});
    }
    template <class T>
    void upload(std::span<const T> from, Buffer<T>& to, std::size_t at = 0) {
      std::copy(from.begin(), from.end(), to.data() + at);
    }
    template <class T>
    void uploadLater(std::span<const T> from, Buffer<T>& to, std::size_t at = 0) {
      upload(from, to, at);
    }
    template <class T>
    std::vector<T> download(const Buffer<T>& from, std::size_t size) {
      return {from.data(), from.data() + size};
    }
    /// The first n are there once a mark that is set later is reached.
    template <class T>
    void downloadLater(const Buffer<T>& from, std::size_t n, HostBuffer<T>& to) {
      std::copy_n(from.data(), n, to.data());
    }
    void set(Mark&) {}
    /// What is given from now on waits for what the other has been given.
    void after(Queue&) {}
    void wait() {}
  };

  /// Pairs (key, value) by key, equal keys in the order in which they came.
  class PairSort {
   public:
    PairSort(int n, int key_bits) : n_(n), order_(static_cast<std::size_t>(n)) { static_cast<void>(key_bits); }
    void run(Queue&, const Buffer<std::uint32_t>& keys, const Buffer<int>& values, Buffer<std::uint32_t>& keys_out,
             Buffer<int>& values_out) {
      std::iota(order_.begin(), order_.end(), 0);
      std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return keys.data()[a] < keys.data()[b]; });
      for (int i = 0; i < n_; ++i) {
        keys_out.data()[i] = keys.data()[order_[i]];
        values_out.data()[i] = values.data()[order_[i]];
      }
    }

    std::size_t bytes() const { return order_.size() * sizeof(int); }

   private:
    int n_;
    std::vector<int> order_;
  };

  /// sums[i] = counts[0] + ... + counts[i - 1]
  template <class T>
  class ExclusiveSumOf {
   public:
    explicit ExclusiveSumOf(int n) : n_(n) {}
    void run(Queue&, const Buffer<T>& counts, Buffer<T>& sums) {
      std::exclusive_scan(counts.data(), counts.data() + n_, sums.data(), T{});
    }
    std::size_t bytes() const { return 0; }

   private:
    int n_;
  };
  using ExclusiveSum = ExclusiveSumOf<int>;

  /// Work that is given again and again, the same each time.
  class Replay {
   public:
    Replay(Queue&, std::function<void()> work) : work_(std::move(work)) {}
    void run(Queue&) { work_(); }

   private:
    std::function<void()> work_;
  };

  /// Milliseconds that the work given by f takes on the queue.
  template <class F>
  static double milliseconds(Queue&, F&& f) {
    const auto start = std::chrono::steady_clock::now();
    f();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  }
};

using Reference = ReferenceOf<1>;

}  // namespace gambeson::gpu
