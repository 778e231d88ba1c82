#pragma once
/// Contacts of samples with bodies on a device: bodies of a step, feet, clearances.

#include <optional>

#include "gpu/finding/box_tree.hpp"
#include "gpu/finding/stage.hpp"
#include "gpu/near/feet_kernels.hpp"
#include "gpu/near/near_lists.hpp"
#include "gpu/near/near_queries.hpp"

namespace gambeson::gpu {

/// What is counted, at the start of a pass.
struct ClearFeet {
  int *candidate_slot, *feet_slot, slots;
  char* seen;
  int* of_sample;
  char* inside;
  int samples;
  BodyExtent* extent;
  int bodies;

  GAMBESON_HD void operator()(int i) const {
    if (i < slots) candidate_slot[i] = feet_slot[i] = 0, seen[i] = 0;
    if (i < samples) of_sample[i] = 0, inside[i] = 0;
    if (i < bodies) extent[i] = {};
  }
};
/// What a pass has learnt of where samples are is known to the next step.
struct KeepOutside {
  char* outside;
  OutsideBall* ball;
  const char* outside_then;
  const OutsideBall* ball_then;

  GAMBESON_HD void operator()(int slot) const {
    outside[slot] = outside_then[slot];
    ball[slot] = ball_then[slot];
  }
};
/// Behind sums of counts, their whole sum.
struct EndSums {
  int* begin;
  const int* of;
  int n;
  GAMBESON_HD void operator()(int) const { begin[n] = n > 0 ? begin[n - 1] + of[n - 1] : 0; }
};

template <class Device>
class BodyFeet {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  /// The mesh and the lists are another's and outlive this.
  BodyFeet(Queue& queue, const NearModel& model, DressedMesh<Device>& mesh, NearLists<Device>& lists)
      : mesh_(mesh),
        lists_(lists),
        tree_(mesh.body_faces),
        of_sample_(size(mesh.samples)),
        sample_begin_(size(mesh.samples + 1)),
        inside_(size(mesh.samples)),
        sample_sum_(mesh.samples) {
    makeBodies(queue, model);
  }

  void makeLists() {
    lists_.makeOne(candidate_place_, kBodyPoints), lists_.makeOne(candidate_, kBodyPoints);
    lists_.makeOne(found_feet_, kFeet), lists_.makeOne(feet_, kFeet);
    lists_.makeOne(found_, kOnBodies), lists_.makeOne(placed_, kOnBodies);
  }

  void setPlacements(Queue& queue, std::span<const Placement> start, std::span<const Placement> end) {
    const auto place = [&](auto& all, auto& to) {
      for (auto& of : all) {
        of.start = start[size(of.obstacle)];
        of.end = end[size(of.obstacle)];
      }
      if (!all.empty()) queue.uploadLater(std::span(std::as_const(all)), to);
    };
    place(host_bodies_, bodies_);
    place(host_ellipsoids_, ellipsoids_);
  }
  void keepOutside(Queue& queue) {
    queue.forEach(slots_, KeepOutside{outside_.data(), ball_.data(), outside_then_.data(), ball_then_.data()});
  }
  void forget(Queue& queue) {
    queue.zero(outside_), queue.zero(outside_then_);
    queue.zero(ball_), queue.zero(ball_then_);
  }

  /// Vertices of bodies, and what else a pass begins with.
  void begin(Queue& q) {
    const int bodies = static_cast<int>(host_bodies_.size()), ellipsoids = static_cast<int>(host_ellipsoids_.size());
    q.forEach(std::max({slots_, mesh_.samples, bodies}),
              ClearFeet{candidate_slot_.data(), feet_slot_.data(), slots_, seen_.data(), of_sample_.data(),
                        inside_.data(), mesh_.samples, extent_.data(), bodies});
    if (bodies + ellipsoids == 0) return;
    q.forEach(mesh_.vertices - mesh_.samples, PlaceVertices{mesh_.body_of_vertex.data(), bodies_.data(), mesh_.samples,
                                                            mesh_.x0.data(), mesh_.x1.data()});
    for (int b = 0; b < bodies; ++b)
      if (host_bodies_[size(b)].deforms)
        q.forEach((host_bodies_[size(b)].vertices + kExtentPart - 1) / kExtentPart,
                  FindExtent{bodies_.data(), b, mesh_.x0.data(), mesh_.x1.data(), extent_.data()});
    q.forEach(bodies + ellipsoids,
              EndBodies{bodies_.data(), bodies, ellipsoids_.data(), extent_.data(), mesh_.x0.data()});
  }

  /// `boxes`: of vertices, grown by all that samples may keep from bodies. dt_s: on the device.
  Stages<Device> stages(Buffer<FloatBox>& boxes, const double* dt_s, int per_group) {
    Stages<Device> all;
    if (slots_ > 0) appendFeet(all, boxes, per_group);
    if (!host_ellipsoids_.empty())
      all.push_back({"feet on ellipsoids", [this](Queue& q) {
                       q.forEach(mesh_.samples,
                                 TouchEllipsoids{ellipsoids_.data(), static_cast<int>(host_ellipsoids_.size()),
                                                 mesh_.thickness.data(), mesh_.x0.data(), mesh_.x1.data(), contacts()});
                     }});
    if (!host_bodies_.empty() || !host_ellipsoids_.empty())
      all.push_back({"clearances", [this, dt_s](Queue& q) { clear(q, dt_s); }});
    return all;
  }

  const BodySurface* bodies() const { return bodies_.data(); }
  const char* inside() const { return inside_.data(); }  ///< of each sample

 private:
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }

  void makeBodies(Queue& queue, const NearModel& model) {
    std::vector<int> which(model.obstacles.size(), -1);
    for (const CollisionModel::Body& b : model.collisions.bodies) {
      const auto& mesh = std::get<TriangleMesh>(model.obstacles[size(b.obstacle)].shape);
      const auto& flat = *surfaces_.emplace_back(std::make_unique<FlatSurface<Device>>(queue, mesh));
      BodySurface s;
      s.view = flat.view();
      s.local = s.bounds = flat.bounds();
      s.obstacle = b.obstacle;
      s.first_vertex = b.first_vertex;
      s.vertices = static_cast<int>(b.local.size());
      s.deforms = b.deforms;
      s.named = flat.named().data();
      s.named_count = static_cast<int>(flat.named().size());
      s.at = flat.local().data();
      which[size(b.obstacle)] = static_cast<int>(host_bodies_.size());
      host_bodies_.push_back(s);
    }
    for (std::size_t o = 0; o < model.obstacles.size(); ++o)
      if (const auto* e = std::get_if<Ellipsoid>(&model.obstacles[o].shape)) {
        EllipsoidBody body;
        body.metric = ellipsoidMetric(*e);
        body.obstacle = static_cast<int>(o);
        which[o] = ~static_cast<int>(host_ellipsoids_.size());
        host_ellipsoids_.push_back(body);
      }
    bodies_ = Buffer<BodySurface>(host_bodies_.size());
    ellipsoids_ = Buffer<EllipsoidBody>(host_ellipsoids_.size());
    body_of_obstacle_ = uploaded<Device>(queue, which);
    extent_ = Buffer<BodyExtent>(host_bodies_.size());
    slots_ = static_cast<int>(host_bodies_.size()) * mesh_.samples;
    const std::size_t n = size(slots_);
    candidate_slot_ = Buffer<int>(n), candidate_begin_ = Buffer<int>(n);
    feet_slot_ = Buffer<int>(n), feet_begin_ = Buffer<int>(n);
    seen_ = Buffer<char>(n);
    outside_ = Buffer<char>(n), outside_then_ = Buffer<char>(n);
    ball_ = Buffer<OutsideBall>(n), ball_then_ = Buffer<OutsideBall>(n);
    if (slots_ > 0) slot_sum_.emplace(slots_);
  }

  BodyContactList contacts() { return {lists_.list(found_, kOnBodies), of_sample_.data(), inside_.data()}; }
  BodySlots slots() {
    return {mesh_.samples,
            mesh_.cloth_triangles,
            mesh_.body_of_vertex.data(),
            mesh_.triangles.data(),
            mesh_.body_triangle.data(),
            bodies_.data(),
            mesh_.thickness.data(),
            mesh_.x0.data(),
            mesh_.x1.data()};
  }

  void appendFeet(Stages<Device>& to, Buffer<FloatBox>& boxes, int per_group) {
    to.push_back({"tree of bodies", [&](Queue& q) { tree_.build(q, mesh_.body_face, boxes, mesh_.cube); }, true});
    to.push_back({"boxes of bodies", [&](Queue& q) { tree_.fit(q, mesh_.body_face, boxes); }});
    to.push_back({"pairs with bodies", [this, &boxes, per_group](Queue& q) {
                    traverseTree(q, VerticesInFaces{mesh_.samples_along.data(), boxes.data()}, mesh_.samples, tree_,
                                 per_group, lists_.pairs(kBodyPoints));
                  }});
    to.push_back({"candidates", [this](Queue& q) {
                    const List<Pair> pairs = lists_.pairs(kBodyPoints);
                    q.forItems(pairs, CountCandidates{slots(), candidate_slot_.data(), candidate_place_.data()});
                    slot_sum_->run(q, candidate_slot_, candidate_begin_);
                    q.forItems(pairs, PlaceCandidates{slots(), candidate_begin_.data(), candidate_place_.data(),
                                                      candidate_.data(), candidate_.size()});
                  }});
    to.push_back({"feet of faces", [this](Queue& q) {
                    q.forItems(lists_.pairs(kBodyPoints),
                               FindFeet{slots(), lists_.list(found_feet_, kFeet), feet_slot_.data(), seen_.data()});
                  }});
    to.push_back(
        {"feet together", [this](Queue& q) {
           slot_sum_->run(q, feet_slot_, feet_begin_);
           q.forItems(lists_.list(found_feet_, kFeet), PlaceFeet{feet_begin_.data(), feet_.data(), feet_.size()});
         }});
    to.push_back({"choice of feet", [this](Queue& q) {
                    q.forEach(slots_,
                              ChooseFeet{slots(),
                                         {tree_.node(), tree_.leaf(), tree_.leaves(), mesh_.body_triangle.data()},
                                         candidate_begin_.data(),
                                         candidate_slot_.data(),
                                         candidate_.data(),
                                         candidate_.size(),
                                         feet_begin_.data(),
                                         feet_slot_.data(),
                                         feet_.data(),
                                         feet_.size(),
                                         seen_.data(),
                                         outside_.data(),
                                         ball_.data(),
                                         outside_then_.data(),
                                         ball_then_.data(),
                                         contacts()});
                  }});
  }
  void clear(Queue& q, const double* dt_s) {
    sample_sum_.run(q, of_sample_, sample_begin_);
    q.forEach(1, EndSums{sample_begin_.data(), of_sample_.data(), mesh_.samples});
    const List<FoundContact> all = lists_.list(found_, kOnBodies);
    q.forItems(all, PlaceBodyContacts{sample_begin_.data(), placed_.data(), placed_.size()});
    q.forItems(all, ClearBodies{sample_begin_.data(), placed_.data(), all, body_of_obstacle_.data(), bodies_.data(),
                                ellipsoids_.data(), mesh_.thickness.data(), mesh_.bulges(), mesh_.mesh(),
                                mesh_.x0.data(), mesh_.x1.data(), dt_s, lists_.found()});
  }

  DressedMesh<Device>& mesh_;
  NearLists<Device>& lists_;
  BoxTree<Device, 3> tree_;  ///< of the faces of all bodies
  Buffer<int> of_sample_, sample_begin_;
  Buffer<char> inside_;
  typename Device::ExclusiveSum sample_sum_;
  std::vector<std::unique_ptr<FlatSurface<Device>>> surfaces_;
  std::vector<BodySurface> host_bodies_;
  std::vector<EllipsoidBody> host_ellipsoids_;
  Buffer<BodySurface> bodies_;
  Buffer<EllipsoidBody> ellipsoids_;
  Buffer<int> body_of_obstacle_;
  Buffer<BodyExtent> extent_;
  int slots_ = 0;  ///< of bodies and samples
  Buffer<int> candidate_slot_, candidate_begin_, feet_slot_, feet_begin_;
  Buffer<char> seen_, outside_, outside_then_;
  Buffer<OutsideBall> ball_, ball_then_;
  std::optional<typename Device::ExclusiveSum> slot_sum_;
  Buffer<int> candidate_place_, candidate_;
  Buffer<FoundFoot> found_feet_;
  Buffer<MeshPoint> feet_;
  Buffer<FoundContact> found_;
  Buffer<int> placed_;
};

}  // namespace gambeson::gpu
