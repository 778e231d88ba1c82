#pragma once
/// The search for what is near (near_search.hpp) on a device: cloth with cloth beside cloth with bodies.

#include <algorithm>
#include <optional>

#include "gpu/near/body_feet.hpp"

namespace gambeson::gpu {

/// What samples of cloth may keep from a body, whatever their thickness.
constexpr double kBodyReach_m = contactReach(kLargestClearance_m);

/// Boxes of vertices over the step. Those of cloth with cloth are grown by their half reach, so that two that meet may
/// be within the sum; bodies by the largest of these, for their sharp parts. Those of cloth with faces of bodies by all
/// of what samples may keep.
struct BoxNear {
  const Vec3 *x0, *x1;
  const float* half_reach;
  int samples;
  float largest_half_reach;
  FloatBox *near, *far;

  GAMBESON_HD void operator()(int i) const {
    const MovingPoint p{x0[i], x1[i]};
    if (i < samples) {
      near[i] = boxOf(p, half_reach[i]);
      far[i] = boxOf(p, std::max(2 * half_reach[i], roundedUp(kBodyReach_m, 0)));
    } else {
      near[i] = boxOf(p, largest_half_reach);
      far[i] = boxOf(p, 0);
    }
  }
};

template <class Device>
class NearFinder final : public NearSearch {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  NearFinder(const NearModel& model, const NearStep& step, const NearSizes& room)
      : collisions_(model.collisions),
        mesh_(queue_, model, allVertices(step.x0, step.obstacles.start, step.obstacles.start_vertices)),
        lists_(mesh_.samples, mesh_.cloth_edges),
        feet_(queue_, model, mesh_, lists_),
        warm_(lists_.slots()),
        faces_(mesh_.cloth_triangles),
        edges_(mesh_.cloth_edges),
        near_box_(static_cast<std::size_t>(mesh_.vertices)),
        far_box_(static_cast<std::size_t>(mesh_.vertices)),
        blunt_(static_cast<std::size_t>(mesh_.cloth_edges)),
        dt_s_(1) {
    for (float half : collisions_.vertex_half_reach_m) largest_half_reach_ = std::max(largest_half_reach_, half);
    makeLists(room);
    setStep(step);
    warm_.set(queue_, {}, 0);
  }

  void setStep(const NearStep& step) override {
    if (found_) feet_.keepOutside(queue_);
    found_ = false;
    const ObstacleMotion& o = step.obstacles;
    const auto x0 = allVertices(step.x0, o.start, o.start_vertices), x1 = allVertices(step.x1, o.end, o.end_vertices);
    queue_.upload(std::span<const Vec3>(x0), mesh_.x0);
    queue_.upload(std::span<const Vec3>(x1), mesh_.x1);
    queue_.upload(std::span<const double>(&step.dt_s, 1), dt_s_);
    feet_.setPlacements(queue_, o.start, o.end);
  }

  // For a step on the device, which places samples itself: mesh().x0 and x1, before a pass.
  Queue& queue() { return queue_; }
  DressedMesh<Device>& mesh() { return mesh_; }
  NearLists<Device>& lists() { return lists_; }
  WarmStarts<Device>& warm() { return warm_; }
  const BodyFeet<Device>& feet() const { return feet_; }
  /// The next step, or the last one once more; `goes_on`: it begins where the last one ended. Bodies that deform are
  /// placed by others.
  void setBodies(const ObstacleMotion& o, double dt_s, bool goes_on) {
    if (found_ && goes_on) feet_.keepOutside(queue_);
    found_ = false;
    queue_.uploadLater(std::span<const double>(&dt_s, 1), dt_s_);
    feet_.setPlacements(queue_, o.start, o.end);
  }

  /// At least so many contacts have room, in the next pass: what is known stays.
  void makeRoom(Count contacts) {
    NearSizes room = lists_.room();
    if (contacts <= room[kContacts]) return;
    room[kContacts] = std::max(2 * room[kContacts], contacts);
    makeLists(room);
    ++repeats_;
  }

  void find(bool rebuild) override {
    do start(rebuild);
    while (!took(lists_.sizes(queue_)));
  }
  /// A pass, given without waiting.
  void start(bool rebuild) {
    const bool anew = rebuild || !built_;
    std::optional<typename Device::Replay>& pass = passes_[anew];
    if (!pass) pass.emplace(queue_, [this, anew] { give(anew); });
    pass->run(queue_);
    built_ = found_ = true;
  }
  /// Of the sizes of the last pass. False: a list ran over; all have room for it now, and the pass is to be given again.
  bool took(const NearSizes& sizes) {
    const NearSizes room = lists_.needed(sizes);
    if (room == lists_.room()) return true;
    makeLists(room);
    ++repeats_;
    return false;
  }

  void forget() override {
    feet_.forget(queue_);
    queue_.wait();
    found_ = false;
  }

  void setWarm(std::span<const WarmEntry> sorted, double scale) override { warm_.set(queue_, sorted, scale); }
  void keepWarm(std::span<const WarmStart> borne, double scale) override {
    warm_.keep(queue_, lists_.facts(), borne);
    warm_.setScale(queue_, scale);
  }
  std::vector<WarmEntry> warmEntries() override { return warm_.kept(queue_); }

  NearSizes sizes() override { return lists_.sizes(queue_); }
  NearContacts contacts() override { return lists_.download(queue_); }
  std::vector<WarmStart> warmStarts() override { return warm_.starts(queue_, sizes()[kContacts]); }
  int repeats() const override { return repeats_; }

  double medianMilliseconds(bool rebuild, int passes) override {
    return medianReplay<Device>(queue_, passes, [&] { give(rebuild); });
  }
  std::vector<StageTime> stageTimes(int passes) override {
    Stages<Device> all;
    for (const Stages<Device>* part : {&common_, &on_bodies_, &points_, &cloth_edges_, &ending_})
      all.insert(all.end(), part->begin(), part->end());
    const std::vector<double> ms = medianTimes<Device>(queue_, passes, all);
    std::vector<StageTime> times;
    for (std::size_t i = 0; i < all.size(); ++i) times.push_back({all[i].name, ms[i]});
    return times;
  }

 private:
  static constexpr int kPerGroup = 4;  ///< queries

  /// Vertices of the mesh. Those of rigid bodies the device places anew in each step.
  std::vector<Vec3> allVertices(std::span<const Vec3> samples, std::span<const Placement> placement,
                                const DeformedVertices& deformed) const {
    std::vector<Vec3> x(samples.begin(), samples.end());
    x.reserve(static_cast<std::size_t>(collisions_.mesh.vertex_count));
    for (const CollisionModel::Body& b : collisions_.bodies) {
      const auto obstacle = static_cast<std::size_t>(b.obstacle);
      for (std::size_t k = 0; k < b.local.size(); ++k)
        x.push_back(b.deforms ? deformed[obstacle][k] : placement[obstacle] * b.local[k]);
    }
    return x;
  }

  void makeLists(const NearSizes& room) {
    for (auto& pass : passes_) pass.reset();
    lists_.make(room);
    feet_.makeLists();
    warm_.makeRoom(queue_, room[kContacts]);
    makeStages();
  }
  template <class Queries, class Tree>
  void traverse(Queue& queue, const Queries& queries, int count, const Tree& tree, NearList to) {
    traverseTree(queue, queries, count, tree, kPerGroup, lists_.pairs(to));
  }
  template <class Keep>
  void sift(Queue& queue, const Keep& keep, NearList from, NearList to) {
    queue.forResidentGroups(SiftNear<Keep>{keep, lists_.pairs(from), lists_.pairs(to)});
  }
  template <class Tree>
  Stages<Device> treeStages(Tree& tree, Buffer<int>& corners, const std::string& of) {
    if (tree.leaves() == 0) return {};
    return {{"tree of " + of, [&](Queue& q) { tree.build(q, corners, near_box_, mesh_.cube); }, true},
            {"boxes of " + of, [&](Queue& q) { tree.fit(q, corners, near_box_); }}};
  }

  void makeStages() {
    const bool self = collisions_.self, corners = mesh_.corner_count > 0, sharp_edges = mesh_.body_edge_count > 0;
    common_ = {{"beginning",
                [this](Queue& q) {
                  lists_.clear(q);
                  feet_.begin(q);
                }},
               {"boxes", [this](Queue& q) {
                  q.forEach(mesh_.vertices,
                            BoxNear{mesh_.x0.data(), mesh_.x1.data(), mesh_.half_reach.data(), mesh_.samples,
                                    largest_half_reach_, near_box_.data(), far_box_.data()});
                }}};
    on_bodies_ = feet_.stages(far_box_, dt_s_.data(), kPerGroup);
    points_ = self || corners ? treeStages(faces_, mesh_.cloth_face, "faces") : Stages<Device>{};
    if (self) appendPoints(points_);
    if (corners)
      points_.push_back({"pairs of corners", [this](Queue& q) {
                           traverse(q, VerticesInFaces{mesh_.corners_along.data(), near_box_.data()},
                                    mesh_.corner_count, faces_, kCorners);
                         }});
    cloth_edges_ = self || sharp_edges ? treeStages(edges_, mesh_.cloth_edge, "edges") : Stages<Device>{};
    if (self) appendEdges(cloth_edges_);
    if (sharp_edges)
      cloth_edges_.push_back(
          {"pairs of body edges", [this](Queue& q) {
             traverse(q, BodyEdgesInEdges{mesh_.body_edges_along.data(), mesh_.edges.data(), near_box_.data()},
                      mesh_.body_edge_count, edges_, kBodyEdges);
           }});
    ending_.clear();
    if (corners || sharp_edges) ending_.push_back({"sharp parts of bodies", [this](Queue& q) { touchSharp(q); }});
    ending_.push_back({"order", [this](Queue& q) { lists_.sort(q); }});
    ending_.push_back({"warm starts", [this](Queue& q) { warm_.match(q, lists_.facts()); }});
  }

  void appendPoints(Stages<Device>& to) {
    to.push_back({"pairs of points", [this](Queue& q) {
                    traverse(q, VerticesInFaces{mesh_.samples_along.data(), near_box_.data()}, mesh_.samples, faces_,
                             kClothPoints);
                  }});
    to.push_back(
        {"sifting points", [this](Queue& q) { sift(q, KeepPoints{mesh_.clothPairs()}, kClothPoints, kOpenPoints); }});
    to.push_back({"contacts of points", [this](Queue& q) {
                    q.forItems(lists_.pairs(kOpenPoints),
                               TouchCloth<false>{mesh_.clothPairs(), mesh_.thickness.data(), lists_.found()});
                  }});
  }
  void appendEdges(Stages<Device>& to) {
    to.push_back({"blunt edges", [this](Queue& q) {
                    q.forEach(mesh_.cloth_edges, MarkBlunt{mesh_.clothPairs(), blunt_.data()});
                  }});
    to.push_back({"pairs of edges", [this](Queue& q) {
                    traverse(q, ClothEdgesInEdges{{edges_.leaf(), edges_.leafBox()}, blunt_.data()}, mesh_.cloth_edges,
                             edges_, kClothEdges);
                  }});
    to.push_back({"sifting edges", [this](Queue& q) {
                    sift(q, KeepEdges{mesh_.clothPairs(), blunt_.data()}, kClothEdges, kOpenEdges);
                  }});
    to.push_back({"contacts of edges", [this](Queue& q) {
                    q.forItems(lists_.pairs(kOpenEdges),
                               TouchCloth<true>{mesh_.clothPairs(), mesh_.thickness.data(), lists_.found()});
                  }});
  }
  void touchSharp(Queue& q) {
    const BodyEdgeView view = mesh_.bodyEdges();
    const OutsideCounts counts{feet_.inside()};
    q.forItems(lists_.pairs(kCorners), TouchSharp<false>{view, dt_s_.data(), counts, feet_.bodies(), lists_.found()});
    q.forItems(lists_.pairs(kBodyEdges), TouchSharp<true>{view, dt_s_.data(), counts, feet_.bodies(), lists_.found()});
  }

  /// Cloth with bodies, points of cloth and edges of cloth side by side.
  void give(bool rebuild) {
    const auto run = [rebuild](const Stages<Device>& stages, Queue& queue) {
      for (const Stage<Device>& stage : stages)
        if (rebuild || !stage.rebuilds) stage.work(queue);
    };
    run(common_, queue_);
    beside_[0].after(queue_);
    beside_[1].after(queue_);
    run(on_bodies_, queue_);
    run(points_, beside_[0]);
    run(cloth_edges_, beside_[1]);
    queue_.after(beside_[0]);
    queue_.after(beside_[1]);
    run(ending_, queue_);
  }

  const CollisionModel& collisions_;
  Queue queue_, beside_[2];
  DressedMesh<Device> mesh_;
  NearLists<Device> lists_;
  BodyFeet<Device> feet_;
  WarmStarts<Device> warm_;
  BoxTree<Device, 3> faces_;  ///< of cloth
  BoxTree<Device, 2> edges_;  ///< likewise
  Buffer<FloatBox> near_box_, far_box_;
  float largest_half_reach_ = 0;
  Buffer<char> blunt_;
  Buffer<double> dt_s_;
  Stages<Device> common_, on_bodies_, points_, cloth_edges_, ending_;
  std::optional<typename Device::Replay> passes_[2];  ///< refitted, rebuilt
  bool built_ = false, found_ = false;
  int repeats_ = 0;
};

}  // namespace gambeson::gpu
