#pragma once
/// The narrow phase of one kind of pair: its lists, and the kernels from pairs to sorted hits.

#include "gpu/finding/hit_order.hpp"
#include "gpu/finding/impact_search.hpp"
#include "gpu/finding/stage.hpp"

namespace gambeson::gpu {

enum Counted { kPairs, kOpen, kHard, kTaken, kHits, kCounts };

struct ClearCounts {
  Count* count;
  int* of_first;
  int firsts;

  GAMBESON_HD void operator()(int i) const {
    if (i < kCounts) count[i] = 0;
    if (i < firsts) of_first[i] = 0;
  }
};

/// N: 3 for points and triangles, 4 for edges.
template <class Device, int N>
class NarrowPass {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// The mesh is another's and outlives this.
  NarrowPass(const FlatMesh<Device>& mesh, const SearchOptions& options, const ListSizes& room)
      : mesh_(mesh),
        options_(options),
        room_(room),
        pairs_(room.pairs),
        open_(room.open),
        hard_(room.hard),
        found_(room.hits),
        placed_(room.hits),
        sorted_(room.hits),
        of_first_(static_cast<std::size_t>(firsts())),
        begin_(static_cast<std::size_t>(firsts())),
        count_(kCounts),
        sum_(firsts()) {}

  List<Pair> pairs() { return list(pairs_, kPairs); }
  const ListSizes& room() const { return room_; }

  /// Before pairs are sought.
  ClearCounts clear() { return {count_.data(), of_first_.data(), firsts()}; }
  Stages<Device> stages(const std::string& of) {
    return {{"sifting " + of,
             [this](Queue& q) {
               q.forResidentGroups(SiftPairs<N>{queries(), pairs(), list(open_, kOpen)});
             }},
            {"first look at " + of,
             [this](Queue& q) {
               q.forResidentGroups(LookFirst<N>{queries(), list(open_, kOpen), list(hard_, kHard), hits()});
             }},
            {"turns of " + of,
             [this](Queue& q) {
               q.forResidentGroups(TakeTurns<N>{queries(), list(hard_, kHard), count_.data() + kTaken, hits()});
             }},
            {"order of " + of, [this](Queue& q) { sort(q); }}};
  }

  ListSizes sizes(Queue& queue) {
    const std::vector<Count> count = queue.download(count_, kCounts);
    return {count[kPairs], count[kOpen], count[kHard], count[kHits]};
  }
  std::vector<Pair> downloadPairs(Queue& queue) { return queue.download(pairs_, sizes(queue).pairs); }
  std::vector<Hit> downloadHits(Queue& queue) { return queue.download(sorted_, sizes(queue).hits); }

 private:
  int firsts() const { return N == 3 ? mesh_.vertices : mesh_.edges; }
  PairQueries<N> queries() const {
    return {mesh_.point.data(), mesh_.rough.data(), (N == 3 ? mesh_.face : mesh_.edge).data(), options_.separation_m,
            options_.tolerance_m};
  }
  template <class T>
  List<T> list(Buffer<T>& items, Counted count) {
    return {items.data(), count_.data() + count, items.size()};
  }
  HitList hits() { return {list(found_, kHits), of_first_.data()}; }

  void sort(Queue& queue) {
    sum_.run(queue, of_first_, begin_);
    queue.forItems(list(found_, kHits), PlaceHits{begin_.data(), list(placed_, kHits)});
    queue.forItems(list(placed_, kHits),
                   RankHits{begin_.data(), of_first_.data(), placed_.data(), list(sorted_, kHits)});
  }

  const FlatMesh<Device>& mesh_;
  SearchOptions options_;
  ListSizes room_;
  Buffer<Pair> pairs_;
  Buffer<OpenPair> open_;
  Buffer<HardPair> hard_;
  Buffer<FoundHit> found_;
  Buffer<Hit> placed_, sorted_;
  Buffer<int> of_first_, begin_;
  Buffer<Count> count_;
  typename Device::ExclusiveSum sum_;
};

}  // namespace gambeson::gpu
