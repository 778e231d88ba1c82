#pragma once
/// The search for impacts on a device: a broad phase, then the narrow phase, points and triangles beside edges.

#include <optional>

#include "gpu/finding/cells/cell_pairs.hpp"
#include "gpu/finding/lbvh.hpp"
#include "gpu/finding/narrow_pass.hpp"

namespace gambeson::gpu {

/// What both kinds of pairs need before they are sought.
struct BeginPass {
  const MovingPoint* point;
  FloatPoint* rough;
  int vertices;
  ClearCounts points, edges;

  GAMBESON_HD void operator()(int i) const {
    if (i < vertices) rough[i] = floatPoint(point[i]);
    points(i);
    edges(i);
  }
};

template <class Device, template <class> class BroadPhase = Lbvh>
class ImpactFinder final : public ImpactSearch {
 public:
  using Queue = typename Device::Queue;

  ImpactFinder(const Mesh& mesh, std::span<const Vec3> positions, const SearchOptions& options, const BothSizes& room)
      : mesh_(mesh, positions), options_(options), broad_(mesh, mesh_, marginOf(options), options) {
    makeLists(room);
  }

  void setMotion(std::span<const Vec3> x0, std::span<const Vec3> x1) override {
    std::vector<MovingPoint> point;
    for (std::size_t i = 0; i < x0.size(); ++i) point.push_back({x0[i], x1[i]});
    queue_.upload(std::span<const MovingPoint>(point), mesh_.point);
  }

  void find(Trees trees) override {
    for (;; ++repeats_) {
      give(trees);
      queue_.wait();
      BothSizes room = {points_->room(), edges_->room()};
      const BothSizes need = sizes();
      bool enough = !broad_.ranOver(queue_);
      for (int kind = 0; kind < kPairKinds; ++kind)
        for (const auto list : {&ListSizes::pairs, &ListSizes::open, &ListSizes::hard, &ListSizes::hits}) {
          if (need[kind].*list <= room[kind].*list) continue;
          enough = false;
          room[kind].*list = std::max(2 * room[kind].*list, need[kind].*list);
        }
      if (enough) return;
      makeLists(room);
    }
  }

  BothSizes sizes() override { return {points_->sizes(queue_), edges_->sizes(queue_)}; }
  std::vector<Pair> pairs(PairKind kind) override {
    return kind == PairKind::pointTriangle ? points_->downloadPairs(queue_) : edges_->downloadPairs(queue_);
  }
  std::vector<Hit> hits(PairKind kind) override {
    return kind == PairKind::pointTriangle ? points_->downloadHits(queue_) : edges_->downloadHits(queue_);
  }
  int repeats() const override { return repeats_; }
  BroadFacts broadFacts() override { return broad_.facts(queue_); }

  double medianMilliseconds(Trees trees, int passes, Part part) override {
    const double ms = medianReplay<Device>(queue_, passes, [&] { give(trees, part); });
    if (part == Part::broad) find(trees);
    return ms;
  }

  std::vector<StageTime> stageTimes(int passes) override {
    Stages<Device> all = common_;
    all.insert(all.end(), stages_[0].begin(), stages_[0].end());
    all.insert(all.end(), stages_[1].begin(), stages_[1].end());
    const std::vector<double> ms = medianTimes<Device>(queue_, passes, all);
    std::vector<StageTime> times;
    for (std::size_t i = 0; i < all.size(); ++i) times.push_back({all[i].name, ms[i]});
    return times;
  }

 private:
  static float marginOf(const SearchOptions& options) {
    const float margin = roundedUp(options.margin_m, 0);
    return std::max(margin, roundedUp(0.5 * options.separation_m, 0));
  }

  void makeLists(const BothSizes& room) {
    points_.reset(), edges_.reset();  // their memory first
    points_.emplace(mesh_, options_, room[0]);
    edges_.emplace(mesh_, options_, room[1]);
    common_ = {{"beginning", [this](Queue& queue) {
                  const int n = std::max({mesh_.vertices, mesh_.edges, int{kCounts}});
                  queue.forEach(n, BeginPass{mesh_.point.data(), mesh_.rough.data(), mesh_.vertices, points_->clear(),
                                             edges_->clear()});
                }}};
    append(common_, broad_.common());
    broad_stages_[0] = stages_[0] = broad_.pointTriangle(points_->pairs());
    append(stages_[0], points_->stages("points"));
    broad_stages_[1] = stages_[1] = broad_.edgeEdge(edges_->pairs());
    append(stages_[1], edges_->stages("edges"));
  }
  static void append(Stages<Device>& to, const Stages<Device>& more) { to.insert(to.end(), more.begin(), more.end()); }

  /// Both kinds of pairs side by side.
  void give(Trees trees, Part part = Part::all) {
    const auto run = [trees](const Stages<Device>& stages, Queue& queue) {
      for (const Stage<Device>& stage : stages)
        if (trees == Trees::rebuilt || !stage.rebuilds) stage.work(queue);
    };
    run(common_, queue_);
    beside_.after(queue_);
    const auto& of_kind = part == Part::all ? stages_ : broad_stages_;
    run(of_kind[0], queue_);
    run(of_kind[1], beside_);
    queue_.after(beside_);
  }

  Queue queue_, beside_;
  FlatMesh<Device> mesh_;
  SearchOptions options_;
  BroadPhase<Device> broad_;
  std::optional<NarrowPass<Device, 3>> points_;
  std::optional<NarrowPass<Device, 4>> edges_;
  Stages<Device> common_, stages_[kPairKinds];
  Stages<Device> broad_stages_[kPairKinds];  ///< the first of these
  int repeats_ = 0;
};

/// With the broad phase that the options name.
template <class Device>
std::unique_ptr<ImpactSearch> impactFinder(const Mesh& mesh, std::span<const Vec3> positions,
                                           const SearchOptions& options, const BothSizes& room) {
  switch (options.broad) {
    case Broad::vss:
      return std::make_unique<ImpactFinder<Device, Vss>>(mesh, positions, options, room);
    case Broad::vssPieces:
      return std::make_unique<ImpactFinder<Device, VssPieces>>(mesh, positions, options, room);
    case Broad::otg:
      return std::make_unique<ImpactFinder<Device, Otg>>(mesh, positions, options, room);
    case Broad::grid:
      return std::make_unique<ImpactFinder<Device, PlainGrid>>(mesh, positions, options, room);
    case Broad::lbvh:
      break;
  }
  return std::make_unique<ImpactFinder<Device>>(mesh, positions, options, room);
}

}  // namespace gambeson::gpu
