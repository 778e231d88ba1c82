#pragma once
/// What would pass through what during a step, and the rows that keep it apart, on a device: as core finds them
/// (core/motion/collisions.hpp, findImpacts; core/contact/proximity.hpp, impacts) and adds them (core/motion/
/// step_rows.hpp, addImpacts), to the same bits. Without tangled samples.
///
/// Core leaves out pairs by certificates, margins, garments and blunt features: what is left out so is farther apart
/// than the separation, and no rule of those decides what is found (gpu/DECISIONS.md). Here all pairs whose boxes meet
/// are asked but those of bodies with bodies, and of cloth with cloth where that does not meet itself.

#include <algorithm>
#include <optional>

#include "core/motion/model.hpp"
#include "gpu/finding/lbvh.hpp"
#include "gpu/finding/stage.hpp"
#include "gpu/near/near_queries.hpp"
#include "gpu/near/uploaded.hpp"
#include "gpu/step/impact_rows.hpp"

namespace gambeson::gpu {

template <class Device>
class StepImpacts {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// The queue and the model are another's and outlive this. `start`: positions of all vertices from which the trees'
  /// order is taken: any will do, those of the first step are best.
  StepImpacts(Queue& queue, const Model& model, std::span<const Vec3> start, const ImpactSizes& room)
      : queue_(queue),
        self_(model.collisions.self),
        samples_(model.collisions.cloth.cloth_vertices),
        bodies_(static_cast<int>(model.collisions.bodies.size())),
        mesh_(meshOf(model.collisions), start),
        points_of_cloth_(uploaded<Device>(queue, inTriangles(model.collisions, start, true))),
        points_of_bodies_(uploaded<Device>(queue, inTriangles(model.collisions, start, false))),
        triangle_(uploaded<Device>(queue, model.collisions.mesh.triangles)),
        edge_(uploaded<Device>(queue, model.collisions.mesh.edges)),
        edge_faces_(queue, model.collisions.mesh.edge_faces),
        vertex_edges_(queue, model.collisions.mesh.vertex_edges),
        body_edges_(uploaded<Device>(queue, edgesOfBodies(model.collisions, start))),
        thickness_(uploaded<Device>(queue, model.layer_m)),
        body_of_vertex_(uploaded<Device>(queue, model.collisions.body_of_vertex)),
        box_(start.size()),
        faces_(mesh_.cloth_faces),
        body_faces_(mesh_.faces - mesh_.cloth_faces),
        edge_boxes_(mesh_.cloth_edges),
        count_(kImpactCounts),
        slots_{samples_, mesh_.vertices, mesh_.edges},
        of_slot_(static_cast<std::size_t>(slots_.count())),
        begin_(static_cast<std::size_t>(slots_.count())),
        slot_sum_(slots_.count()) {
    flattenBodies(model);
    makeLists(room);
    makeStages();
  }

  /// A pass, given without waiting: for recordings. Trees are to be rebuilt once before they are refitted.
  void give(const ImpactPaths& paths, Trees trees) {
    paths_ = paths;
    const auto run = [trees](const Stages<Device>& stages, Queue& queue) {
      for (const Stage<Device>& stage : stages)
        if (trees == Trees::rebuilt || !stage.rebuilds) stage.work(queue);
    };
    Queue &edges = beside_[0], &bodies = beside_[1], &parts = beside_[2];
    run(common_, queue_);
    edges.after(queue_);
    bodies.after(queue_);
    run(edge_tree_, edges);
    run(face_tree_, queue_);
    parts.after(edges);
    parts.after(queue_);
    run(on_bodies_, bodies);
    run(cloth_points_, queue_);
    run(cloth_edges_, edges);
    run(body_parts_, parts);
    for (Queue* beside : {&bodies, &parts}) queue_.after(*beside);
    edges.after(parts);
    run(points_, queue_);
    run(edges_, edges);
    queue_.after(edges);
  }

  /// A pass, given without waiting.
  void start(const ImpactPaths& paths, Trees trees) {
    const bool anew = !built_ || trees == Trees::rebuilt;
    if (!(paths == paths_)) forgetPasses();
    std::optional<typename Device::Replay>& pass = passes_[anew];
    if (!pass) pass.emplace(queue_, [this, paths, anew] { give(paths, anew ? Trees::rebuilt : Trees::refitted); });
    pass->run(queue_);
    built_ = true;
  }
  /// What the last pass has counted, on the device.
  const Count* counts() const { return count_.data(); }
  /// Of that. False: a list ran over; all have room for it now, and the pass is to be given again.
  bool took(std::span<const Count> count, ImpactCounts& found) {
    ImpactSizes room = room_;
    for (std::size_t k = 0; k < room.size(); ++k) {
      sizes_[k] = count[k];
      if (count[k] > room[k]) room[k] = std::max<unsigned long long>(2 * room[k], count[k]);
    }
    found = {count[kSampleHits], count[kPointHits], count[kEdgeHits], count[kTouchingPairs], count[kCappedPairs]};
    if (room == room_) return true;
    makeLists(room);
    ++repeats_;
    return false;
  }
  /// A pass, and a wait for its counts, repeated until nothing has run over.
  ImpactCounts find(const ImpactPaths& paths, Trees trees) {
    ImpactCounts found;
    do start(paths, trees);
    while (!took(queue_.download(count_, kImpactCounts), found));
    return found;
  }

  /// The hits of the last pass become rows, on the same paths, which still stand where they stood: those of a pair that
  /// has a row replace it, and leave its traction; others come behind, in core's order, with none. Where the rows have
  /// no room *rows.count is above it then: with larger arrays that begin with what is there, and a count of no more
  /// than there were, the same once more does what is missing.
  void addRows(const StepRows& rows, const ImpactRowTerms& step) {
    sortHits();
    queue_.zero(replaces_);
    queue_.zero(is_new_);
    const List<StepHit> sorted = list(sorted_, kStepHits);
    queue_.forItems(List<ContactFacts>{rows.facts, rows.count, rows.room},
                    FindReplaced{sorted, rows.stencil, rows.terms, mesh_.vertices, step.round, replaces_.data()});
    queue_.forItems(sorted, MarkNewRows{replaces_.data(), is_new_.data()});
    new_sum_->run(queue_, is_new_, rank_);
    queue_.forItems(sorted, WriteImpactRows{paths_, samples_, ellipsoids_, mesh_.face.data(), mesh_.edge.data(),
                                            body_of_vertex_.data(), body_.data(), local_.data(), thickness_.data(),
                                            ellipsoid_of_.data(), step, replaces_.data(), rank_.data(), rows});
    queue_.forEach(1, EndImpactRows{sorted, rank_.data(), is_new_.data(), rows});
  }

  /// Of the last pass that was waited for.
  const ImpactSizes& sizes() const { return sizes_; }
  int repeats() const { return repeats_; }  ///< of passes, for want of room, since the start
  /// Sorted; waits.
  std::vector<StepHit> hits() {
    sortHits();
    return queue_.download(sorted_, queue_.download(count_, kImpactCounts)[kStepHits]);
  }
  /// All stages one after the other, each alone.
  Stages<Device> stages() const {
    Stages<Device> all;
    for (const Stages<Device>* part : {&common_, &face_tree_, &edge_tree_, &on_bodies_, &cloth_points_, &cloth_edges_,
                                       &body_parts_, &points_, &edges_})
      all.insert(all.end(), part->begin(), part->end());
    return all;
  }

 private:
  static constexpr int kPerGroup = 8;  ///< queries

  static Mesh meshOf(const CollisionModel& m) {
    return {m.mesh.vertex_count, m.mesh.triangles, m.mesh.edges, m.bodies.empty() ? -1 : m.cloth.cloth_vertices};
  }
  /// Vertices that a triangle has, near ones after each other: core asks no others.
  static std::vector<int> inTriangles(const CollisionModel& m, std::span<const Vec3> start, bool cloth) {
    return alongCurve(
        cubeAround(start), m.mesh.vertex_count,
        [&](int v) { return (v < m.cloth.cloth_vertices) == cloth && !m.mesh.vertex_faces[v].empty(); },
        [&](int v) { return start[static_cast<std::size_t>(v)]; });
  }

  /// Likewise.
  static std::vector<int> edgesOfBodies(const CollisionModel& m, std::span<const Vec3> start) {
    const auto first = [&](int e) { return m.mesh.edges[static_cast<std::size_t>(e)][0]; };
    return alongCurve(
        cubeAround(start), static_cast<int>(m.mesh.edges.size()),
        [&](int e) { return first(e) >= m.cloth.cloth_vertices; },
        [&](int e) { return start[static_cast<std::size_t>(first(e))]; });
  }

  void flattenBodies(const Model& model) {
    std::vector<ImpactBody> bodies;
    std::vector<Vec3> local;
    for (const CollisionModel::Body& b : model.collisions.bodies) {
      bodies.push_back({b.obstacle, b.first_vertex, b.deforms});
      local.insert(local.end(), b.local.begin(), b.local.end());
    }
    body_ = uploaded<Device>(queue_, bodies);
    local_ = uploaded<Device>(queue_, local);
    std::vector<int> which;
    for (const Obstacle& o : model.obstacles)
      which.push_back(std::holds_alternative<Ellipsoid>(o.shape) ? ellipsoids_++ : -1);
    ellipsoid_of_ = uploaded<Device>(queue_, which);
    sweep_ = Buffer<EllipsoidSweep>(static_cast<std::size_t>(ellipsoids_));
  }

  void forgetPasses() {
    for (auto& pass : passes_) pass.reset();
  }
  void makeLists(const ImpactSizes& room) {
    forgetPasses();
    room_ = room;
    for (const ImpactList which : {kPointPairs, kEdgePairs}) makeOne(pairs_[which == kEdgePairs], which);
    for (const ImpactList which : {kPointOpen, kEdgeOpen}) makeOne(open_[which == kEdgeOpen], which);
    for (const ImpactList which : {kPointHard, kEdgeHard}) makeOne(hard_[which == kEdgeHard], which);
    for (const ImpactList which : {kPointMet, kEdgeMet}) makeOne(met_[which == kEdgeMet], which);
    if (hits_.size() == room[kStepHits] && new_sum_) return;
    makeOne(hits_, kStepHits), makeOne(sorted_, kStepHits);
    makeOne(place_, kStepHits), makeOne(placed_, kStepHits);
    makeOne(replaces_, kStepHits), makeOne(is_new_, kStepHits), makeOne(rank_, kStepHits);
    new_sum_.emplace(static_cast<int>(room[kStepHits]));
  }
  template <class T>
  void makeOne(Buffer<T>& items, ImpactList which) {
    if (items.size() == room_[which] && items.size() > 0) return;
    items = Buffer<T>();  // its memory first
    items = Buffer<T>(room_[which]);
  }
  template <class T>
  List<T> list(Buffer<T>& items, int which) {
    return {items.data(), count_.data() + which, items.size()};
  }

  template <class Queries, class Tree>
  void traverse(Queue& queue, const Queries& queries, int count, const Tree& tree, ImpactList to) {
    traverseTree(queue, queries, count, tree, kPerGroup, list(pairs_[to == kEdgePairs], to));
  }
  template <class Tree>
  void appendTree(Stages<Device>& to, Tree& tree, Buffer<int>& corners, const std::string& of) {
    to.push_back({"tree of " + of, [&](Queue& q) { tree.build(q, corners, box_, mesh_.cube); }, true});
    to.push_back({"boxes of " + of, [&](Queue& q) { tree.fit(q, corners, box_); }});
  }

  void makeStages() {
    common_ = {{"beginning", [this](Queue& q) {
                  q.forEach(std::max(mesh_.vertices, int{kImpactCounts}),
                            BeginImpacts{paths_, mesh_.vertices, roundedUp(0.5 * kImpactSeparation_m, 0),
                                         mesh_.point.data(), mesh_.rough.data(), box_.data(), count_.data()});
                }}};
    if (ellipsoids_ > 0)
      on_bodies_.push_back({"hits on ellipsoids", [this](Queue& q) {
                              q.forEach(ellipsoids_, SweepEllipsoids{paths_.ellipsoid, sweep_.data()});
                              q.forEach(samples_, EnterEllipsoids{paths_, ellipsoids_, sweep_.data(), hitList()});
                            }});
    const int of_cloth = static_cast<int>(points_of_cloth_.size()),
              of_bodies = static_cast<int>(points_of_bodies_.size());
    if (body_faces_.leaves() > 0) {
      appendTree(on_bodies_, body_faces_, mesh_.body_face, "bodies");
      on_bodies_.push_back(
          {"pairs with bodies", [this, of_cloth](Queue& q) {
             traverse(q, VerticesInBodies{points_of_cloth_.data(), box_.data(), samples_, mesh_.cloth_faces}, of_cloth,
                      body_faces_, kPointPairs);
           }});
    }
    if ((!self_ && bodies_ == 0) || faces_.leaves() == 0) return;
    appendTree(face_tree_, faces_, mesh_.face, "faces");
    appendTree(edge_tree_, edge_boxes_, mesh_.edge, "edges");
    if (self_) {
      cloth_points_.push_back(
          {"pairs of points", [this, of_cloth](Queue& q) {
             traverse(q, VerticesInFaces{points_of_cloth_.data(), box_.data()}, of_cloth, faces_, kPointPairs);
           }});
      cloth_edges_.push_back({"pairs of edges", [this](Queue& q) {
                                traverse(q, EdgesInEdges{edge_boxes_.leaf(), edge_boxes_.leafBox()}, mesh_.cloth_edges,
                                         edge_boxes_, kEdgePairs);
                              }});
    }
    if (bodies_ > 0) {
      body_parts_.push_back({"pairs of body edges", [this](Queue& q) {
                               traverse(q, BodyEdgesInEdges{body_edges_.data(), edge_.data(), box_.data()},
                                        static_cast<int>(body_edges_.size()), edge_boxes_, kEdgePairs);
                             }});
      body_parts_.push_back(
          {"pairs of body points", [this, of_bodies](Queue& q) {
             traverse(q, VerticesInFaces{points_of_bodies_.data(), box_.data()}, of_bodies, faces_, kPointPairs);
           }});
    }
    appendNarrow<3>(points_, "points", mesh_.face);
    appendNarrow<4>(edges_, "edges", mesh_.edge);
  }

  /// From pairs to hits. N: 3 for points and triangles, 4 for edges.
  template <int N>
  void appendNarrow(Stages<Device>& to, const std::string& of, Buffer<int>& corners) {
    constexpr int kKind = N == 3 ? 0 : 1;
    constexpr int kFirst = N == 3 ? kPointPairs : kEdgePairs;
    const PairQueries<N> queries{mesh_.point.data(), mesh_.rough.data(), corners.data(), kImpactSeparation_m,
                                 kImpactTolerance_m};
    to.push_back({"sifting " + of, [this, queries](Queue& q) {
                    q.forResidentGroups(SiftPairs<N, StopsPair<N>>{queries,
                                                                   list(pairs_[kKind], kFirst),
                                                                   list(open_[kKind], kFirst + 1),
                                                                   {queries, paths_.exempt, samples_}});
                  }});
    to.push_back({"first look at " + of, [this, queries](Queue& q) {
                    q.forResidentGroups(LookFirst<N, MetList>{queries, list(open_[kKind], kFirst + 1),
                                                              list(hard_[kKind], kFirst + 2), metList(kKind)});
                  }});
    to.push_back({"turns of " + of, [this, queries](Queue& q) {
                    q.forResidentGroups(TakeTurns<N, MetList>{queries, list(hard_[kKind], kFirst + 2),
                                                              count_.data() + kPointsTaken + kKind, metList(kKind)});
                  }});
    to.push_back({"hits of " + of, [this, queries](Queue& q) {
                    const List<MetPair> met = metList(kKind).met;
                    q.forItems(met, ConfirmImpacts<N>{queries, met.items, count_.data()});
                    q.forItems(met, ListImpacts<N>{queries, surfaces(), hitList()});
                  }});
  }
  MetList metList(int kind) {
    MetList to;
    to.met = list(met_[kind], kind == 0 ? kPointMet : kEdgeMet);
    return to;
  }
  ImpactSurfaces surfaces() const {
    ContactMeshView mesh;
    mesh.triangles = triangle_.data();
    mesh.edge_faces = edge_faces_.view();
    mesh.vertex_edges = vertex_edges_.view();
    return {mesh, samples_, paths_.x0, paths_.x1};
  }
  StepHitList hitList() { return {list(hits_, kStepHits), count_.data()}; }

  void sortHits() {
    queue_.zero(of_slot_);
    const List<StepHit> found = list(hits_, kStepHits);
    queue_.forItems(found, CountStepHits{slots_, of_slot_.data(), place_.data()});
    slot_sum_.run(queue_, of_slot_, begin_);
    queue_.forItems(found, PlaceStepHits{slots_, begin_.data(), place_.data(), placed_.data()});
    queue_.forItems(found,
                    RankStepHits{slots_, begin_.data(), of_slot_.data(), placed_.data(), hits_.data(), sorted_.data()});
  }

  Queue& queue_;
  Queue beside_[3];
  bool self_;
  int samples_, bodies_, ellipsoids_ = 0;
  FlatMesh<Device> mesh_;
  Buffer<int> points_of_cloth_, points_of_bodies_;
  Buffer<std::array<int, 3>> triangle_;
  Buffer<std::array<int, 2>> edge_;
  FlatLists<Device> edge_faces_, vertex_edges_;
  Buffer<int> body_edges_;
  Buffer<double> thickness_;
  Buffer<int> body_of_vertex_, ellipsoid_of_;
  Buffer<ImpactBody> body_;
  Buffer<Vec3> local_;
  Buffer<EllipsoidSweep> sweep_;
  Buffer<FloatBox> box_;
  BoxTree<Device, 3> faces_, body_faces_;  ///< of cloth, of bodies
  BoxTree<Device, 2> edge_boxes_;          ///< of cloth
  ImpactPaths paths_;
  ImpactSizes room_{}, sizes_{};
  Buffer<Count> count_;
  Buffer<Pair> pairs_[kPairKinds];
  Buffer<OpenPair> open_[kPairKinds];
  Buffer<HardPair> hard_[kPairKinds];
  Buffer<MetPair> met_[kPairKinds];
  Buffer<StepHit> hits_, sorted_;
  // Of rows.
  StepHitSlots slots_;
  Buffer<int> of_slot_, begin_, place_, placed_;
  Buffer<Count> replaces_;
  Buffer<int> is_new_, rank_;
  typename Device::ExclusiveSum slot_sum_;
  std::optional<typename Device::ExclusiveSum> new_sum_;
  Stages<Device> common_, face_tree_, edge_tree_, on_bodies_, cloth_points_, cloth_edges_, body_parts_, points_, edges_;
  std::optional<typename Device::Replay> passes_[2];  ///< refitted, rebuilt
  bool built_ = false;
  int repeats_ = 0;
};

}  // namespace gambeson::gpu
