#pragma once
/// Broad phases by cells: triangles that share a cell are compared, then what is their own (Wong 2014, chapters 5, 6).
/// They find the pairs that Lbvh finds (lbvh.hpp).

#include <functional>
#include <optional>

#include "gpu/finding/cells/features.hpp"
#include "gpu/finding/cells/lists.hpp"
#include "gpu/finding/cells/octree.hpp"
#include "gpu/finding/cells/uniform.hpp"

namespace gambeson::gpu {

template <class Device, class Cells>
class CellPairs {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// The mesh is another's and outlives this.
  CellPairs(const Mesh& host, FlatMesh<Device>& mesh, float margin_m, const SearchOptions& options)
      : owners_(host, mesh, margin_m, options.bounds), cells_(owners_), count_(kCounts) {
    const auto n = static_cast<Count>(owners_.count());
    makeLists(options.cells_room > 0 ? options.cells_room : 4 * n + 1024,
              options.cells_room > 0 ? options.cells_room : 64 * n + 1024);
  }

  Stages<Device> common() {
    Stages<Device> all = owners_.stages();
    const auto append = [&](const Stages<Device>& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(cells_.stages([this] { return found(); }));
    append({{"order of cells",
             [this](Queue& queue) {
               sort_->run(queue, cell_, owner_, cell_sorted_, owner_sorted_);
               queue.forEach(room() + 1, CountTests{sorted(), tests_.data()});
               sum_->run(queue, tests_, test_sum_);
             }},
            {"pairs of triangles", [this](Queue& queue) { pairOwners<false>(queue, ofOwners()); }}});
    all.insert(all.begin(), {"beginning of cells", [this](Queue& queue) {
                               queue.zero(count_);
                               queue.forEach(room(), NoCell{cell_.data()});
                             }});
    return all;
  }
  Stages<Device> pointTriangle(const List<Pair>& pairs) {
    return {{"pairs of points", [this, pairs](Queue& queue) { pairFeatures<3, false>(queue, pairs); }}};
  }
  Stages<Device> edgeEdge(const List<Pair>& pairs) {
    return {{"pairs of edges", [this, pairs](Queue& queue) { pairFeatures<4, false>(queue, pairs); }}};
  }

  /// After a pass: whether a list of its own ran over; it has more room then.
  bool ranOver(Queue& queue) {
    const std::vector<Count> count = queue.download(count_, kCounts);
    const Count cells = cell_.size(), pairs = pairs_.size();
    if (count[kRegistered] <= cells && count[kPairs] <= pairs) return false;
    const auto enough = [](Count need, Count room) { return need <= room ? room : std::max(2 * room, need); };
    makeLists(enough(count[kRegistered], cells), enough(count[kPairs], pairs));
    return true;
  }

  BroadFacts facts(Queue& queue) {
    BroadFacts facts;
    const std::vector<Count> before = queue.download(count_, kCounts);
    facts.registrations = before[kRegistered];
    for (const std::uint32_t cell : queue.download(cell_sorted_, facts.registrations)) {
      const auto level = static_cast<std::size_t>(Cells::levelOf(cell));
      if (facts.registrations_of.size() <= level) facts.registrations_of.resize(level + 1);
      ++facts.registrations_of[level];
    }
    facts.tests = queue.download(test_sum_, test_sum_.size()).back();
    facts.pairs_of_triangles = before[kPairs];
    // Once more, counting: what is found goes nowhere.
    Buffer<Count> nowhere(3);
    pairOwners<true>(queue, {nullptr, nowhere.data(), 0});
    pairFeatures<3, true>(queue, {nullptr, nowhere.data() + 1, 0});
    pairFeatures<4, true>(queue, {nullptr, nowhere.data() + 2, 0});
    const std::vector<Count> after = queue.download(count_, kCounts);
    facts.boxes_of_triangles = after[kBoxes] - before[kBoxes];
    facts.boxes_of_features = after[kFeatures] - before[kFeatures];
    facts.bytes = owners_.bytes() + cells_.bytes() + sort_->bytes() + sum_->bytes() +
                  bytesOf(cell_, cell_sorted_, owner_, owner_sorted_, tests_, test_sum_, pairs_);
    return facts;
  }

 private:
  enum Counted { kRegistered, kPairs, kBoxes, kFeatures, kCounts };

  void makeLists(Count cells, Count pairs) {
    sort_.reset(), sum_.reset();
    for (auto* list : {&cell_, &cell_sorted_}) *list = {}, *list = Buffer<std::uint32_t>(cells);
    for (auto* list : {&owner_, &owner_sorted_}) *list = {}, *list = Buffer<int>(cells);
    for (auto* list : {&tests_, &test_sum_}) *list = {}, *list = Buffer<Count>(cells + 1);
    pairs_ = {}, pairs_ = Buffer<Pair>(pairs);
    sort_.emplace(room(), Cells::kKeyBits);
    sum_.emplace(room() + 1);
  }
  int room() const { return static_cast<int>(cell_.size()); }
  Registrations found() { return {cell_.data(), owner_.data(), count_.data() + kRegistered, cell_.size()}; }
  Registrations sorted() {
    return {cell_sorted_.data(), owner_sorted_.data(), count_.data() + kRegistered, cell_.size()};
  }
  List<Pair> ofOwners() { return {pairs_.data(), count_.data() + kPairs, pairs_.size()}; }

  template <bool kTallied>
  void pairOwners(Queue& queue, const List<Pair>& to) {
    using Test = PairsInCells<typename Cells::Rule, kTallied>;
    queue.forResidentGroups(DealOut<Test>{{test_sum_.data(), room()},
                                          {sorted(), cells_.rule(), owners_.owner(), owners_.clothVertices(),
                                           owners_.box(), owners_.dop(), to, count_.data() + kBoxes}});
  }
  template <int N, bool kTallied>
  void pairFeatures(Queue& queue, const List<Pair>& to) {
    queue.forResidentGroups(PairsOfOwners<N, kTallied>{ofOwners(), owners_.owner(), owners_.box(), owners_.vertexBox(),
                                                       owners_.dop(), owners_.vertexDop(), to,
                                                       count_.data() + kFeatures});
  }

  MeasuredOwners<Device> owners_;
  Cells cells_;
  Buffer<std::uint32_t> cell_, cell_sorted_;
  Buffer<int> owner_, owner_sorted_;
  Buffer<Count> tests_, test_sum_, count_;
  Buffer<Pair> pairs_;
  std::optional<typename Device::PairSort> sort_;
  std::optional<typename Device::template ExclusiveSumOf<Count>> sum_;
};

template <class Device>
using Vss = CellPairs<Device, UniformCells<Device, CellSize::ofMean, false>>;
template <class Device>
using VssPieces = CellPairs<Device, UniformCells<Device, CellSize::ofMean, true>>;
template <class Device>
using PlainGrid = CellPairs<Device, UniformCells<Device, CellSize::ofLargest, false>>;
template <class Device>
using Otg = CellPairs<Device, OctreeCells<Device>>;

}  // namespace gambeson::gpu
