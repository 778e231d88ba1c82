#include <algorithm>

#include "core/contact/iteration_lanes.hpp"
#include "gpu/device/cuda.cuh"
#include "gpu/device/quads.cuh"
#include "gpu/solve/contact_sweeps.hpp"
#include "gpu/solve/flat_solve.hpp"
#include "gpu/solve/island_sweeps.hpp"

namespace gambeson::gpu {
namespace {

/// Of islands by teams, or by a block each.
template <int Q, bool kTeams>
__global__ void __launch_bounds__(Q* kQuad, 1)
    sweepIslands(SolveData data, SweepLimits limits, const SolveJob* jobs, int vectors) {
  using Sweeps = IslandSweeps<BlockQuads<Q>>;
  extern __shared__ double room[];
  __shared__ typename Sweeps::Shared shared;
  const Sweeps sweeps(data, limits, shared, reinterpret_cast<Vec3*>(room), vectors);
  if constexpr (kTeams)
    sweeps.runTeam(BlockQuads<Q>{}, jobs[blockIdx.x]);
  else
    sweeps.runAlone(BlockQuads<Q>{}, jobs[blockIdx.x].island);
}

template <int Q>
class CudaSweeps : public ContactSweeps {
 public:
  explicit CudaSweeps(const CudaSweepOptions& options) : options_(options) {
    int device = 0;
    check(cudaGetDevice(&device), "the device");
    check(cudaDeviceGetAttribute(&most_shared_, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "its shared memory");
    check(cudaDeviceGetAttribute(&processors_, cudaDevAttrMultiProcessorCount, device), "its processors");
    cudaFuncAttributes own{};
    check(cudaFuncGetAttributes(&own, sweepIslands<Q, true>), "the kernel of sweeps");
    most_shared_ -= static_cast<int>(own.sharedSizeBytes);
    if (options.shared_kB >= 0) most_shared_ = std::min(most_shared_, 1024 * options.shared_kB);
    for (const auto kernel : {sweepIslands<Q, true>, sweepIslands<Q, false>})
      check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, most_shared_),
            "room in shared memory");
  }

  void set(const ContactWork& work) override {
    const FlatSolve flat = flatSolve(work);
    small_ = flat.small;
    count_ = static_cast<int>(flat.islands.size());
    points_ = flat.moved.size(), rows_ = flat.own.size();
    put(flat.islands, islands_), put(flat.chunks, chunks_), put(flat.steps, steps_), put(flat.facts, facts_);
    put(flat.own, own_), put(flat.slope, slope_), put(flat.entries, entries_), put(flat.state, state_);
    put(flat.point, point_), put(flat.weight, weight_), put(flat.push, push_), put(flat.chunk_points, chunk_points_);
    put(flat.free, free_), put(flat.moved, moved_), put(flat.moved_before, moved_before_);
    grow(flat.islands.size(), islands_now_), grow(flat.islands.size(), arrived_);
    grow(flat.state.size(), state_now_), grow(flat.facts.size(), pace_), grow(points_, moved_now_),
        grow(points_, before_now_);
    grow(2 * flat.chunks.size(), largest2_), grow(2 * flat.chunks.size(), against_);
    grow(flat.chunk_points.size(), spilled_), grow(points_, spilled_before_);
    makeJobs(flat);
    queue_.wait();
  }

  void begin(double goal, int last, int most) override {
    const SweepLimits limits{goal, last, most - most / 4};
    SolveData data = dataOf();
    const SolveJob* jobs = jobs_.data();
    const bool beside = small_ > 0;
    if (small_ < count_) {
      Cuda::Queue& queue = beside ? side_ : queue_;
      if (beside) side_.after(queue_);
      const int first = batches_.empty() ? 0 : batches_.back();
      sweepIslands<Q, false>
          <<<count_ - small_, kQuad * Q, shared_, queue.stream()>>>(data, limits, jobs + first, vectors_);
      check(cudaGetLastError(), "sweeps over islands");
    }
    if (!beside) return;
    queue_.zero(arrived_);
    int from = 0, vectors = vectors_;
    SweepLimits own = limits;
    for (int to : batches_) {
      const SolveJob* those = jobs + from;
      void* arguments[] = {&data, &own, &those, &vectors};
      check(
          cudaLaunchCooperativeKernel(sweepIslands<Q, true>, to - from, kQuad * Q, arguments, shared_, queue_.stream()),
          "sweeps over large islands");
      from = to;
    }
    queue_.after(side_);
  }
  void wait() override { queue_.wait(); }
  void run(double goal, int last, int most) override {
    begin(goal, last, most);
    wait();
  }

  void get(ContactWork& w) const override {
    w.islands = queue_.download(islands_now_, w.islands.size());
    const auto rows = queue_.download(state_now_, state_now_.size());
    const auto points = queue_.download(moved_now_, points_), before = queue_.download(before_now_, points_);
    for (std::size_t k = 0; k < rows_; ++k) {
      const RowState state = RowState::of(rows.data(), static_cast<int>(k));
      w.candidate[k] = quadOf(state.now), w.previous[k] = quadOf(state.before);
    }
    for (std::size_t f = 0; f < points_; ++f) w.moved[f] = quadOf(points[f]), w.moved_before[f] = quadOf(before[f]);
  }

  double medianMilliseconds(double goal, int last, int most, int runs) override {
    std::vector<double> times;
    run(goal, last, most);
    for (int i = 0; i < runs; ++i) times.push_back(Cuda::milliseconds(queue_, [&] { begin(goal, last, most); }));
    std::ranges::nth_element(times, times.begin() + runs / 2);
    return times[static_cast<std::size_t>(runs / 2)];
  }

 private:
  template <class T>
  using Buffer = Cuda::Buffer<T>;

  template <class T>
  static void grow(std::size_t size, Buffer<T>& buffer) {
    if (buffer.size() < size || !buffer.data()) buffer = Buffer<T>(size);
  }
  template <class T>
  void put(const std::vector<T>& from, Buffer<T>& to) {
    grow(from.size(), to);
    queue_.upload(std::span<const T>(from), to);
  }

  void makeJobs(const FlatSolve& flat) {
    // Teams whose groups can all be on the device at once, then the next ones.
    std::vector<SolveJob> jobs;
    batches_.clear();
    int most_points = 0;
    for (int i = 0; i < small_; ++i) {
      const SolveIsland& island = flat.islands[flat.by_size[i]];
      int of_phase = 0, most = 0;
      for (int c = island.chunk; c < island.chunk_end; ++c) {
        of_phase = c > island.chunk && flat.chunks[c].phase == flat.chunks[c - 1].phase ? of_phase + 1 : 1;
        most = std::max(most, of_phase);
        most_points = std::max(most_points, flat.chunks[c].point_end - flat.chunks[c].point);
      }
      if (options_.most_team > 0) most = std::min(most, options_.most_team);
      const int groups = std::min(most, std::max(1, processors_ / small_));
      const int begun = batches_.size() > 1 ? batches_[batches_.size() - 2] : 0;
      if (batches_.empty() || static_cast<int>(jobs.size()) + groups - begun > processors_) batches_.push_back(0);
      for (int rank = 0; rank < groups; ++rank) jobs.push_back({flat.by_size[i], rank, groups, arrived_.data() + i});
      batches_.back() = static_cast<int>(jobs.size());
    }
    for (int i = small_; i < count_; ++i) {
      const SolveIsland& island = flat.islands[flat.by_size[i]];
      jobs.push_back({flat.by_size[i], 0, 1, nullptr});
      most_points = std::max(most_points, 2 * (island.free_end - island.free_point));
    }
    put(jobs, jobs_);
    vectors_ = std::min(most_points, most_shared_ / static_cast<int>(sizeof(Vec3)));
    shared_ = static_cast<std::size_t>(vectors_) * sizeof(Vec3);
  }

  SolveData dataOf() {
    return {islands_.data(),      islands_now_.data(), chunks_.data(),       steps_.data(),         facts_.data(),
            own_.data(),          slope_.data(),       entries_.data(),      state_.data(),         state_now_.data(),
            pace_.data(),         point_.data(),       weight_.data(),       push_.data(),          free_.data(),
            chunk_points_.data(), moved_.data(),       moved_before_.data(), moved_now_.data(),     before_now_.data(),
            largest2_.data(),     against_.data(),     spilled_.data(),      spilled_before_.data()};
  }

  CudaSweepOptions options_;
  mutable Cuda::Queue queue_;
  Cuda::Queue side_;
  int most_shared_ = 0, processors_ = 0, small_ = 0, count_ = 0, vectors_ = 0;
  std::vector<int> batches_;  ///< where each ends
  std::size_t shared_ = 0, rows_ = 0, points_ = 0;
  Buffer<SolveIsland> islands_, islands_now_;
  Buffer<SolveChunk> chunks_;
  Buffer<RowEntries> entries_;
  Buffer<SolveJob> jobs_;
  Buffer<ChunkPoint> chunk_points_;
  Buffer<int> steps_, point_, free_, arrived_;
  Buffer<double> facts_, state_, state_now_, pace_, own_, slope_, weight_, push_, largest2_, against_;
  Buffer<Vec3> moved_, moved_before_, moved_now_, before_now_, spilled_, spilled_before_;
};

}  // namespace

std::unique_ptr<ContactSweeps> sweepsOnCuda(const CudaSweepOptions& options) {
  switch (options.quads) {
    case 16:
      return std::make_unique<CudaSweeps<16>>(options);
    case 32:
      return std::make_unique<CudaSweeps<32>>(options);
    case 64:
      return std::make_unique<CudaSweeps<64>>(options);
    default:
      throw RunError("a block has 16, 32 or 64 quads");
  }
}

}  // namespace gambeson::gpu
