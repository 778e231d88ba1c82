#pragma once
/// The CUDA device: the same vocabulary as the reference (reference.hpp), for sources that nvcc compiles.

#include <cuda_runtime.h>

#include <algorithm>
#include <cstring>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gpu/device/cuda_error.hpp"
#include "gpu/device/list.hpp"

namespace gambeson::gpu {

/// A warp.
struct WarpLanes {
  static constexpr int kLanes = 32;

  template <class T>
  class PerLane {
   public:
    PerLane() = default;
    __device__ explicit PerLane(const T& all) : item_(all) {}
    __device__ T& operator[](int) { return item_; }
    __device__ const T& operator[](int) const { return item_; }

   private:
    T item_;
  };

  template <class F>
  __device__ void each(F&& f) const {
    f(static_cast<int>(threadIdx.x % kLanes));
  }
  __device__ LaneMask ballot(const PerLane<bool>& on) const { return __ballot_sync(~0u, on[0]); }
  __device__ std::uint32_t orOf(const PerLane<std::uint32_t>& bits) const { return __reduce_or_sync(~0u, bits[0]); }
  template <class T>
  __device__ T of(const PerLane<T>& items, int lane) const {
    return __shfl_sync(~0u, items[0], lane);
  }
  template <class F>
  __device__ auto once(F&& f) const {
    decltype(f()) result{};
    if (threadIdx.x % kLanes == 0) result = f();
    return __shfl_sync(~0u, result, 0);
  }
  __device__ void sync() const { __syncwarp(); }
};

/// Of a block of kernels over items: few, so that some thousand items are spread over many processors. Kernels over
/// rows, which are given again and again, have fewer and larger blocks to start.
constexpr int kThreads = 64, kThreadsOverRows = 256;

namespace kernel {

template <class F>
__global__ void __launch_bounds__(kThreads) forEach(int n, F f) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i < n) f(i);
}

template <class T, class F>
__global__ void __launch_bounds__(kThreads) forItems(List<T> list, F f) {
  const Count n = list.size();
  for (Count i = blockIdx.x * blockDim.x + threadIdx.x; i < n; i += gridDim.x * blockDim.x) f(list.items[i], i);
}

template <class Sized, class F>
__global__ void __launch_bounds__(kThreadsOverRows) forEachOf(Sized of, F f) {
  const int n = static_cast<int>(of.size());
  for (int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x); i < n;
       i += static_cast<int>(gridDim.x * blockDim.x))
    f(i);
}

template <class F>
__global__ void decide(cudaGraphConditionalHandle handle, F f) {
  cudaGraphSetConditional(handle, f() ? 1u : 0u);
}

template <int kGroups, class Kernel>
__global__ void __launch_bounds__(32 * kGroups, std::min(32, Kernel::kResident / kGroups))
    forGroups(int n, Kernel kernel) {
  // Bytes, as shared variables may have no constructor.
  using Shared = typename Kernel::Shared;
  __shared__ alignas(Shared) unsigned char shared[kGroups * sizeof(Shared)];
  const int mine = static_cast<int>(threadIdx.x) / 32, group = static_cast<int>(blockIdx.x) * kGroups + mine;
  if (group < n) kernel(WarpLanes{}, reinterpret_cast<Shared*>(shared)[mine], group, n);
}

}  // namespace kernel

/// kGroups: groups of a block. The same bits for each.
template <int kGroups>
class CudaOf {
 public:
  using Group = WarpLanes;

  template <class T>
  class Buffer {
   public:
    Buffer() = default;
    explicit Buffer(std::size_t size) : size_(size) {
      T* at = nullptr;
      const std::size_t bytes = std::max<std::size_t>(1, size * sizeof(T));
      check(cudaMalloc(&at, bytes), "memory for " + std::to_string(bytes) + " bytes");
      data_.reset(at);
      // Queues do not wait for the stream that this goes to.
      check(cudaMemset(at, 0, bytes), "clearing memory");
      check(cudaStreamSynchronize(cudaStreamLegacy), "clearing memory");
    }
    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t size() const { return size_; }

   private:
    struct Free {
      void operator()(T* at) const { cudaFree(at); }
    };
    std::unique_ptr<T, Free> data_;
    std::size_t size_ = 0;
  };

  template <class T>
  class HostBuffer {
   public:
    HostBuffer() = default;
    explicit HostBuffer(std::size_t size) : size_(size) {
      T* at = nullptr;
      check(cudaMallocHost(&at, std::max<std::size_t>(1, size * sizeof(T))), "memory between host and device");
      data_.reset(at);
    }
    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t size() const { return size_; }

   private:
    struct Free {
      void operator()(T* at) const { cudaFreeHost(at); }
    };
    std::unique_ptr<T, Free> data_;
    std::size_t size_ = 0;
  };
  class Queue;
  class Mark {
   public:
    explicit Mark(unsigned flags = cudaEventDisableTiming) {
      check(cudaEventCreateWithFlags(&event_, flags), "an event");
    }
    ~Mark() { cudaEventDestroy(event_); }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;
    void wait() const { check(cudaEventSynchronize(event_), "work on the device"); }
    cudaEvent_t event() const { return event_; }

   private:
    cudaEvent_t event_{};
  };
  class Laps {
   public:
    void start(Queue& queue) {
      used_ = 0;
      lap(queue);
    }
    void lap(Queue& queue) {
      if (used_ == marks_.size()) marks_.push_back(std::make_unique<Mark>(cudaEventDefault));
      queue.set(*marks_[used_++]);
    }
    const std::vector<double>& seconds() {
      seconds_.clear();
      for (std::size_t k = 1; k < used_; ++k) {
        float ms = 0;
        check(cudaEventElapsedTime(&ms, marks_[k - 1]->event(), marks_[k]->event()), "an event");
        seconds_.push_back(1e-3 * ms);
      }
      return seconds_;
    }

   private:
    std::vector<std::unique_ptr<Mark>> marks_;
    std::size_t used_ = 0;
    std::vector<double> seconds_;
  };

  class Queue {
   public:
    Queue() {
      check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "a stream");
      check(cudaEventCreateWithFlags(&given_, cudaEventDisableTiming), "an event");
    }
    ~Queue() {
      cudaStreamSynchronize(stream_);
      if (stage_) cudaFreeHost(stage_);
      cudaEventDestroy(given_);
      cudaStreamDestroy(stream_);
    }
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;

    template <class F>
    void forEach(int n, const F& f) {
      if (n > 0) kernel::forEach<<<(n + kThreads - 1) / kThreads, kThreads, 0, stream_>>>(n, f);
      check(cudaGetLastError(), "a kernel over items");
    }
    template <class T, class F>
    void forItems(const List<T>& list, const F& f) {
      kernel::forItems<<<8 * processors(), kThreads, 0, stream_>>>(list, f);
      check(cudaGetLastError(), "a kernel over a list");
    }
    template <class Sized, class F>
    void forEachOf(const Sized& of, const F& f) {
      kernel::forEachOf<<<2 * processors(), kThreadsOverRows, 0, stream_>>>(of, f);
      check(cudaGetLastError(), "a kernel over what the device counts");
    }
    template <class Goes, class F>
    void repeatWhile(const Goes& goes, F&& work) {
      conditional(cudaGraphCondTypeWhile, goes, std::forward<F>(work));
    }
    template <class Only, class F>
    void doIf(const Only& only, F&& work) {
      conditional(cudaGraphCondTypeIf, only, std::forward<F>(work));
    }
    template <class Kernel>
    void forGroups(int n, const Kernel& work) {
      if (n > 0) kernel::forGroups<kGroups><<<(n + kGroups - 1) / kGroups, 32 * kGroups, 0, stream_>>>(n, work);
      check(cudaGetLastError(), "a kernel over groups");
    }
    template <class Kernel>
    void forResidentGroups(const Kernel& work) {
      static const int blocks = [] {
        int of_processor = 0;
        check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&of_processor, kernel::forGroups<kGroups, Kernel>,
                                                            32 * kGroups, 0),
              "the room for a kernel");
        return of_processor * processors();
      }();
      forGroups(kGroups * blocks, work);
    }
    template <class T>
    void zero(Buffer<T>& buffer) {
      check(cudaMemsetAsync(buffer.data(), 0, buffer.size() * sizeof(T), stream_), "clearing memory");
    }
    template <class T>
    void upload(std::span<const T> from, Buffer<T>& to, std::size_t at = 0) {
      uploadLater(from, to, at);
      wait();
    }
    /// What is given to this queue from now on finds it there; what another one has been given may not. `from` may
    /// change at once. Not to be recorded (Replay).
    template <class T>
    void uploadLater(std::span<const T> from, Buffer<T>& to, std::size_t at = 0) {
      const std::size_t bytes = from.size_bytes();
      if (bytes == 0) return;
      const void* source = from.data();
      if (bytes <= kStaged) {
        if (staged_ + bytes > kStaged) wait();
        source = std::memcpy(stage() + staged_, from.data(), bytes);
        staged_ += (bytes + 63) / 64 * 64;
      }
      check(cudaMemcpyAsync(to.data() + at, source, bytes, cudaMemcpyHostToDevice, stream_), "an upload");
      if (bytes > kStaged) wait();
    }
    template <class T>
    std::vector<T> download(const Buffer<T>& from, std::size_t size) {
      std::vector<T> to(size);
      const std::size_t bytes = size * sizeof(T);
      const bool staged = bytes <= kStaged;
      void* const target = staged ? static_cast<void*>(stage() + kStaged) : to.data();
      check(cudaMemcpyAsync(target, from.data(), bytes, cudaMemcpyDeviceToHost, stream_), "a download");
      wait();
      if (staged && bytes > 0) std::memcpy(to.data(), target, bytes);
      return to;
    }
    template <class T>
    void downloadLater(const Buffer<T>& from, std::size_t n, HostBuffer<T>& to) {
      check(cudaMemcpyAsync(to.data(), from.data(), n * sizeof(T), cudaMemcpyDeviceToHost, stream_), "a download");
    }
    void set(Mark& mark) { check(cudaEventRecord(mark.event(), stream_), "an event"); }
    void after(Queue& other) {
      check(cudaEventRecord(other.given_, other.stream_), "an event");
      check(cudaStreamWaitEvent(stream_, other.given_), "waiting for another stream");
    }
    void wait() {
      check(cudaStreamSynchronize(stream_), "work on the device");
      staged_ = 0;
    }
    cudaStream_t stream() const { return stream_; }

   private:
    static constexpr std::size_t kStaged = std::size_t{1} << 20;

    /// A node of the graph that this queue is being recorded to, whose body is what `work` gives to the queue.
    template <class Decides, class F>
    void conditional(cudaGraphConditionalNodeType type, const Decides& decides, F&& work) {
      cudaGraphConditionalHandle handle{};
      check(cudaGraphConditionalHandleCreate(&handle, recorded().graph, 0, 0), "a condition of a graph");
      const auto decide = [&] {
        kernel::decide<<<1, 1, 0, stream_>>>(handle, decides);
        check(cudaGetLastError(), "a condition of a graph");
      };
      decide();
      cudaGraphNodeParams node{};
      node.type = cudaGraphNodeTypeConditional;
      node.conditional.handle = handle;
      node.conditional.type = type;
      node.conditional.size = 1;
      addBehind(recorded(), node);
      cudaStream_t body{};
      check(cudaStreamCreateWithFlags(&body, cudaStreamNonBlocking), "a stream");
      check(cudaStreamBeginCaptureToGraph(body, node.conditional.phGraph_out[0], nullptr, nullptr, 0,
                                          cudaStreamCaptureModeThreadLocal),
            "recording a part of a graph");
      std::swap(stream_, body);
      work();
      if (type == cudaGraphCondTypeWhile) decide();
      std::swap(stream_, body);
      cudaGraph_t graph{};
      check(cudaStreamEndCapture(body, &graph), "recording a part of a graph");
      check(cudaStreamDestroy(body), "a stream");
    }
    struct Recorded {
      cudaGraph_t graph{};
      const cudaGraphNode_t* last{};
      std::size_t count = 0;
    };
    Recorded recorded() const {
      Recorded r;
      cudaStreamCaptureStatus status{};
#if CUDART_VERSION >= 13000
      check(cudaStreamGetCaptureInfo(stream_, &status, nullptr, &r.graph, &r.last, nullptr, &r.count), "a recording");
#else
      check(cudaStreamGetCaptureInfo_v2(stream_, &status, nullptr, &r.graph, &r.last, &r.count), "a recording");
#endif
      return r;
    }
    /// What is recorded from now on waits for the node.
    void addBehind(const Recorded& r, cudaGraphNodeParams& params) {
      cudaGraphNode_t node{};
#if CUDART_VERSION >= 13000
      check(cudaGraphAddNode(&node, r.graph, r.last, nullptr, r.count, &params), "a part of a graph");
      check(cudaStreamUpdateCaptureDependencies(stream_, &node, nullptr, 1, cudaStreamSetCaptureDependencies),
            "a part of a graph");
#else
      check(cudaGraphAddNode(&node, r.graph, r.last, r.count, &params), "a part of a graph");
      check(cudaStreamUpdateCaptureDependencies(stream_, &node, 1, cudaStreamSetCaptureDependencies),
            "a part of a graph");
#endif
    }

    /// Memory that the device reads and writes itself: uploads on their way, then the download.
    char* stage() {
      if (!stage_) check(cudaMallocHost(&stage_, 2 * kStaged), "memory between host and device");
      return stage_;
    }

    cudaStream_t stream_{};
    cudaEvent_t given_{};
    char* stage_ = nullptr;
    std::size_t staged_ = 0;
  };

  class PairSort {
   public:
    PairSort(int n, int key_bits) : n_(n), bits_(key_bits) {
      std::size_t bytes = 0;
      check(sort(nullptr, bytes, nullptr, nullptr, nullptr, nullptr, nullptr), "room for a sort");
      room_ = Buffer<char>(bytes);
    }
    void run(Queue& queue, const Buffer<std::uint32_t>& keys, const Buffer<int>& values,
             Buffer<std::uint32_t>& keys_out, Buffer<int>& values_out) {
      std::size_t bytes = room_.size();
      check(sort(room_.data(), bytes, keys.data(), values.data(), keys_out.data(), values_out.data(), queue.stream()),
            "a sort");
    }
    std::size_t bytes() const { return room_.size(); }

   private:
    cudaError_t sort(void* room, std::size_t& bytes, const std::uint32_t* keys, const int* values,
                     std::uint32_t* keys_out, int* values_out, cudaStream_t stream) const {
      return cub::DeviceRadixSort::SortPairs(room, bytes, keys, keys_out, values, values_out, n_, 0, bits_, stream);
    }
    int n_, bits_;
    Buffer<char> room_;
  };

  template <class T>
  class ExclusiveSumOf {
   public:
    explicit ExclusiveSumOf(int n) : n_(n) {
      std::size_t bytes = 0;
      check(sum(nullptr, bytes, nullptr, nullptr, nullptr), "room for a sum");
      room_ = Buffer<char>(bytes);
    }
    void run(Queue& queue, const Buffer<T>& counts, Buffer<T>& sums) {
      std::size_t bytes = room_.size();
      check(sum(room_.data(), bytes, counts.data(), sums.data(), queue.stream()), "a sum");
    }
    std::size_t bytes() const { return room_.size(); }

   private:
    cudaError_t sum(void* room, std::size_t& bytes, const T* counts, T* sums, cudaStream_t stream) const {
      return cub::DeviceScan::ExclusiveSum(room, bytes, counts, sums, n_, stream);
    }
    int n_;
    Buffer<char> room_;
  };
  using ExclusiveSum = ExclusiveSumOf<int>;

  /// A graph: no host between its kernels.
  class Replay {
   public:
    template <class F>
    Replay(Queue& queue, F&& work) {
      check(cudaStreamBeginCapture(queue.stream(), cudaStreamCaptureModeThreadLocal), "recording a graph");
      work();
      cudaGraph_t graph{};
      check(cudaStreamEndCapture(queue.stream(), &graph), "recording a graph");
      const cudaError_t made = cudaGraphInstantiate(&graph_, graph, 0);
      cudaGraphDestroy(graph);
      check(made, "making a graph");
    }
    ~Replay() { cudaGraphExecDestroy(graph_); }
    Replay(const Replay&) = delete;
    Replay& operator=(const Replay&) = delete;
    void run(Queue& queue) { check(cudaGraphLaunch(graph_, queue.stream()), "starting a graph"); }

   private:
    cudaGraphExec_t graph_{};
  };

  template <class F>
  static double milliseconds(Queue& queue, F&& f) {
    cudaEvent_t start{}, end{};
    check(cudaEventCreate(&start), "an event");
    check(cudaEventCreate(&end), "an event");
    check(cudaEventRecord(start, queue.stream()), "an event");
    f();
    check(cudaEventRecord(end, queue.stream()), "an event");
    check(cudaEventSynchronize(end), "work on the device");
    float ms = 0;
    check(cudaEventElapsedTime(&ms, start, end), "an event");
    cudaEventDestroy(start);
    cudaEventDestroy(end);
    return ms;
  }

 private:
  static int processors() {
    static const int count = [] {
      int device = 0, n = 0;
      check(cudaGetDevice(&device), "the device");
      check(cudaDeviceGetAttribute(&n, cudaDevAttrMultiProcessorCount, device), "the device's processors");
      return n;
    }();
    return count;
  }
};

using Cuda = CudaOf<4>;

}  // namespace gambeson::gpu
