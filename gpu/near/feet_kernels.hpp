#pragma once
/// Feet of samples on bodies, as core's ProximityQuery and MeshSurface find them: on ellipsoids each sample by itself;
/// on meshes from the triangles whose boxes meet the sample's, and where there are none, whether the sample is inside.

#include "core/motion/stand_out.hpp"
#include "gpu/finding/pair.hpp"
#include "gpu/finding/radix_tree.hpp"
#include "gpu/near/body_kernels.hpp"
#include "gpu/near/cloth_kernels.hpp"

namespace gambeson::gpu {

/// How far a sample looks for bodies: what it may keep from them, and its way.
GAMBESON_HD inline double bodyReach(double thickness_m, const Vec3& x0, const Vec3& x1) {
  return contactReach(std::max(thickness_m, double{kLargestClearance_m})) + norm(x1 - x0);
}

/// A minimum of the distance of a sample to a body.
struct FoundFoot {
  MeshPoint foot;
  int slot;  ///< of the body and the sample
  int place;
};

/// A sample is outside of a rigid mesh within a ball.
struct OutsideBall {
  Vec3 centre;  ///< in the mesh's frame
  double radius = 0;
};

/// By body and sample: slot = body * samples + sample.
struct BodySlots {
  int samples = 0;
  int cloth_triangles = 0;
  const int* body_of_vertex = nullptr;
  const std::array<int, 3>* triangles = nullptr;
  const int* body_triangle = nullptr;
  const BodySurface* body = nullptr;
  const double* thickness_m = nullptr;
  const Vec3 *x0 = nullptr, *x1 = nullptr;

  /// Of a sample and the number of a face among those of bodies.
  GAMBESON_HD int of(const Pair& p) const {
    return body_of_vertex[triangles[cloth_triangles + p.second][0]] * samples + p.first;
  }
  GAMBESON_HD Vec3 point(const BodySurface& b, int sample) const {
    return b.deforms ? x0[sample] : toFrame(b.start, x0[sample]);
  }
  GAMBESON_HD double limit(const BodySurface& b, int sample) const {
    return bodyReach(thickness_m[sample], x0[sample], x1[sample]) + b.motion_m;
  }
  /// The same in the frame of the surface.
  GAMBESON_HD double radius(const BodySurface& b, double limit_m) const {
    return b.deforms ? limit_m : limit_m / b.start.scale;
  }
};

/// Each pair's place among those of its slot.
struct CountCandidates {
  BodySlots slots;
  int *of_slot, *place;
  GAMBESON_HD void operator()(const Pair& p, Count i) const { place[i] = fetchAdd(&of_slot[slots.of(p)], 1); }
};
struct PlaceCandidates {
  BodySlots slots;
  const int *begin, *place;
  int* triangle;  ///< number in its mesh
  Count room;
  GAMBESON_HD void operator()(const Pair& p, Count i) const {
    const Count at = static_cast<Count>(begin[slots.of(p)] + place[i]);
    if (at < room) triangle[at] = slots.body_triangle[p.second];
  }
};

/// The minima that a triangle answers for.
struct FindFeet {
  BodySlots slots;
  List<FoundFoot> feet;
  int* of_slot;
  char* seen;  ///< of each slot: some triangle is within reach

  GAMBESON_HD void operator()(const Pair& p, Count) const {
    const int slot = slots.of(p), sample = p.first;
    const BodySurface& b = slots.body[slot / slots.samples];
    const double radius = slots.radius(b, slots.limit(b, sample));
    const auto add = [&](const MeshPoint& foot) {
      const int place = fetchAdd(&of_slot[slot], 1);
      const Count at = fetchAdd(feet.count, Count{1});
      if (at < feet.room) feet.items[at] = {foot, slot, place};
    };
    if (b.view.faceFeet(slots.body_triangle[p.second], slots.point(b, sample), radius, add)) seen[slot] = 1;
  }
};
struct PlaceFeet {
  const int* begin;
  MeshPoint* placed;
  Count room;
  GAMBESON_HD void operator()(const FoundFoot& found, Count) const {
    const Count at = static_cast<Count>(begin[found.slot] + found.place);
    if (at < room) placed[at] = found.foot;
  }
};

/// The nearest point of a body of all, by the tree of the faces of all bodies.
struct NearestOnBody {
  const TreeNode* node;
  const TreeLeaf* leaf;
  int leaves;
  const int* body_triangle;

  GAMBESON_HD void operator()(const BodySurface& b, const Vec3& p, const Vec3& x_W, SurfaceView::Nearest& best) const {
    constexpr double kRounding_m = 1e-11;  // of placements
    const double scale = b.deforms ? 1 : b.start.scale;
    const auto mayBe = [&](double box_m) { return box_m - kRounding_m <= scale * std::sqrt(best.dist2_m2); };
    struct Task {
      int node;
      double box_m;
    } stack[64];
    int tasks = 0;
    if (leaves > 0) stack[tasks++] = {0, 0};
    while (tasks > 0) {
      const Task now = stack[--tasks];
      if (!mayBe(now.box_m)) continue;
      const TreeNode& n = node[now.node];
      const double far[2] = {distance(n.box[0], x_W), distance(n.box[1], x_W)};
      const int first = far[1] < far[0] ? 1 : 0;
      // The nearer one is looked at first: it goes on the stack last.
      for (int k = 0; k < 2; ++k) {
        const int side = k == 0 ? first : 1 - first;
        if (n.child[side] >= 0 || !mayBe(far[side])) continue;
        const TreeLeaf& l = leaf[~n.child[side]];
        if (l.corner[0] >= b.first_vertex && l.corner[0] < b.first_vertex + b.vertices)
          b.view.lookAt(body_triangle[l.primitive], p, best);
      }
      for (int k = 0; k < 2; ++k) {
        const int side = k == 0 ? 1 - first : first;
        if (n.child[side] >= 0 && mayBe(far[side])) stack[tasks++] = {n.child[side], far[side]};
      }
    }
  }

 private:
  GAMBESON_HD static double distance(const FloatBox& box, const Vec3& p) {
    double d2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double lo = box.lo[k], hi = box.hi[k];
      if (lo > hi) return std::numeric_limits<double>::infinity();  // no box
      const double d = p[k] < lo ? lo - p[k] : p[k] > hi ? p[k] - hi : 0;
      d2 += d * d;
    }
    return std::sqrt(d2);
  }
};

/// Contacts of samples with bodies before what is not reached is dropped, by sample.
struct BodyContactList {
  List<FoundContact> list;
  int* of_sample;
  char* inside;  ///< of each sample: it is in some body, or on it

  GAMBESON_HD void add(FoundContact& found) const {
    if (!(found.facts.gap_m > 0)) inside[found.facts.sample] = 1;
    found.place = fetchAdd(&of_sample[found.facts.sample], 1);
    const Count at = fetchAdd(list.count, Count{1});
    if (at < list.room) list.items[at] = found;
  }
};

/// What a sample touches of a body, of the minima found.
struct ChooseFeet {
  BodySlots slots;
  NearestOnBody nearest;
  const int *begin, *of_slot, *triangle;  ///< candidates of slots
  Count triangle_room;
  const int *feet_begin, *feet_of_slot;
  MeshPoint* feet;
  Count feet_room;
  const char* seen;
  // What is known of the sample from the last step, and what is known then: a pass may be given again.
  const char* outside;      ///< of bodies that deform
  const OutsideBall* ball;  ///< of others
  char* outside_then;
  OutsideBall* ball_then;
  BodyContactList out;

  GAMBESON_HD void operator()(int slot) const {
    const int sample = slot % slots.samples;
    const BodySurface& b = slots.body[slot / slots.samples];
    const Vec3 p = slots.point(b, sample);
    const double limit = slots.limit(b, sample), radius = slots.radius(b, limit);
    const bool known = b.deforms ? outside[slot] != 0 : norm(p - ball[slot].centre) < ball[slot].radius;
    MeshPoint one;
    MeshPoint* found = feet + feet_begin[slot];
    int count = feet_of_slot[slot];
    outside_then[slot] = outside[slot];
    ball_then[slot] = ball[slot];
    if (static_cast<Count>(feet_begin[slot] + count) > feet_room) return;  // the pass is repeated
    if (of_slot[slot] == 0) {
      if (known) return;
      found = &one;
      count = wayOut(b, slot, sample, p, one) && !(one.distance_m > 0);
    } else if (count > 0) {
      sortByFeature(found, count);
      count = b.view.chooseAmong(found, count);
    } else if (!(b.deforms && known)) {
      found = &one;
      count = deepOrLost(b, slot, sample, p, radius, known, one);
    } else if (seen[slot]) {
      // Beside all that is near, or a minimum that the predicates lost to rounding.
      found = &one;
      SurfaceView::Nearest best{radius * radius};
      const Count end = std::min(static_cast<Count>(begin[slot] + of_slot[slot]), triangle_room);
      for (Count k = static_cast<Count>(begin[slot]); k < end; ++k) b.view.lookAt(triangle[k], p, best);
      count = best.feature >= 0;
      if (count > 0) one = b.view.signedFoot(p, best.position, best.feature);
    }
    bool all_outside = true;
    for (int k = 0; k < count; ++k) {
      all_outside = all_outside && found[k].distance_m > 0;
      add(b, sample, found[k], limit);
    }
    if (b.deforms) outside_then[slot] = all_outside;
  }

 private:
  GAMBESON_HD static void sortByFeature(MeshPoint* feet, int count) {
    for (int i = 1; i < count; ++i) {
      const MeshPoint mine = feet[i];
      int at = i;
      for (; at > 0 && mine.feature < feet[at - 1].feature; --at) feet[at] = feet[at - 1];
      feet[at] = mine;
    }
  }
  GAMBESON_HD bool nearestFoot(const BodySurface& b, int sample, const Vec3& p, double radius, MeshPoint& foot) const {
    SurfaceView::Nearest best{radius * radius};
    nearest(b, p, slots.x0[sample], best);
    if (best.feature < 0) return false;
    foot = b.view.signedFoot(p, best.position, best.feature);
    return true;
  }
  GAMBESON_HD bool maybeDeep(const BodySurface& b, const Vec3& p) const {
    return b.view.closed && boxDistance2(b.bounds, p) == 0;
  }
  GAMBESON_HD void learn(const BodySurface& b, int slot, const Vec3& p, const MeshPoint& foot) const {
    if (!b.deforms && foot.distance_m > 0) ball_then[slot] = {p, foot.distance_m * (1 - 1e-9)};
  }
  /// The nearest point of all, where p may be inside of a closed mesh.
  GAMBESON_HD bool wayOut(const BodySurface& b, int slot, int sample, const Vec3& p, MeshPoint& foot) const {
    if (!maybeDeep(b, p)) return false;
    if (!nearestFoot(b, sample, p, std::numeric_limits<double>::infinity(), foot)) return false;
    learn(b, slot, p, foot);
    return true;
  }
  /// Deep inside, or a minimum that the predicates lost to rounding. `known`: it is outside.
  GAMBESON_HD bool deepOrLost(const BodySurface& b, int slot, int sample, const Vec3& p, double radius, bool known,
                              MeshPoint& foot) const {
    const bool maybe_deep = maybeDeep(b, p);
    if (!seen[slot] && (!maybe_deep || known)) return false;
    if (!nearestFoot(b, sample, p, maybe_deep ? std::numeric_limits<double>::infinity() : radius, foot)) return false;
    learn(b, slot, p, foot);
    return foot.distance_m < 0 || foot.distance_m <= radius;
  }

  GAMBESON_HD void add(const BodySurface& b, int sample, const MeshPoint& foot, double limit) const {
    const double gap = b.deforms ? foot.distance_m : b.start.scale * foot.distance_m;
    if (!(gap < limit)) return;
    FoundContact found;
    found.facts.kind = kSampleOnBody;
    found.facts.sample = sample;
    found.facts.obstacle = b.obstacle;
    found.facts.feature = foot.feature;
    found.facts.normal = b.deforms ? foot.normal : b.start.rotation * foot.normal;
    found.facts.gap_m = gap;
    found.touch.local = foot.position;
    if (b.deforms) {
      const MaterialPoint at = b.view.material(foot);
      for (int k = 0; k < 3; ++k) {
        found.touch.vertex[k] = at.vertex[k];
        found.touch.weight[k] = at.weight[k];
      }
    }
    out.add(found);
  }
};

/// What a sample touches of all ellipsoids.
struct TouchEllipsoids {
  const EllipsoidBody* ellipsoid;
  int ellipsoids;
  const double* thickness_m;
  const Vec3 *x0, *x1;
  BodyContactList out;

  GAMBESON_HD void operator()(int sample) const {
    const double reach = bodyReach(thickness_m[sample], x0[sample], x1[sample]);
    for (int k = 0; k < ellipsoids; ++k) {
      const EllipsoidBody& e = ellipsoid[k];
      const double limit = reach + e.motion_m;
      const Vec3 p = toFrame(e.start, x0[sample]);
      if (surelyBeyond(e.metric, p, limit / e.start.scale)) continue;
      const SurfacePoint s = closestOnEllipsoid(e.metric, p);
      const double gap = e.start.scale * s.distance_m;
      if (!(gap < limit)) continue;
      FoundContact found;
      found.facts.kind = kSampleOnBody;
      found.facts.sample = sample;
      found.facts.obstacle = e.obstacle;
      found.facts.normal = e.start.rotation * s.normal;
      found.facts.gap_m = gap;
      found.touch.local = s.position;
      out.add(found);
    }
  }
};

/// Numbers of these contacts, those of a sample together.
struct PlaceBodyContacts {
  const int* begin;
  int* placed;
  Count room;
  GAMBESON_HD void operator()(const FoundContact& found, Count i) const {
    const Count at = static_cast<Count>(begin[found.facts.sample] + found.place);
    if (at < room) placed[at] = static_cast<int>(i);
  }
};

/// Clearances, and what is outside of the reach of contacts all the way left out.
struct ClearBodies {
  const int *begin, *placed;
  List<FoundContact> on_bodies;
  const int* body_of_obstacle;  ///< number of its surface, or ~ of its ellipsoid
  const BodySurface* body;
  const EllipsoidBody* ellipsoid;
  const double* thickness_m;
  BulgesView bulges;
  ContactMeshView mesh;
  const Vec3 *x0, *x1;
  const double* dt_s;
  FoundList out;

  GAMBESON_HD void operator()(const FoundContact& near, Count) const {
    if (*on_bodies.count > on_bodies.room) return;  // the pass is repeated
    FoundContact found = near;
    ContactFacts& f = found.facts;
    const int which = body_of_obstacle[f.obstacle];
    const EllipsoidBody* e = which < 0 ? ellipsoid + ~which : nullptr;
    const BodySurface* b = which < 0 ? nullptr : body + which;
    const Placement &start = e ? e->start : b->start, &end = e ? e->end : b->end;
    const auto view = [](const FoundContact& c) {
      return BodyContactView{c.facts.sample, c.facts.obstacle, c.facts.normal, c.facts.gap_m, c.touch.local};
    };
    const auto other = [&](int j) { return view(on_bodies.items[placed[j]]); };
    f.clearance_m = clearanceOf(view(found), thickness_m[f.sample], e ? &e->metric : nullptr, start, bulges, mesh,
                                other, begin, x0);
    Vec3 way{};
    if (b && b->deforms) {
      Vec3 to{}, from{};
      for (int k = 0; k < 3 && found.touch.vertex[k] >= 0; ++k) {
        to += found.touch.weight[k] * x1[b->first_vertex + found.touch.vertex[k]];
        from += found.touch.weight[k] * x0[b->first_vertex + found.touch.vertex[k]];
      }
      way = to - from;
    } else {
      way = at(end, found.touch.local) - at(start, found.touch.local);
    }
    if (f.gap_m > 0 && !comesWithin(contactReach(std::max(thickness_m[f.sample], f.clearance_m)), f.gap_m * f.normal,
                                    x1[f.sample] - x0[f.sample] - way))
      return;
    f.body_velocity = way / *dt_s;
    found.stencil.add(f.sample, 1);
    f.layer_m = std::max(clothLayer(found.stencil, thickness_m), f.clearance_m);
    out.add(found);
  }

 private:
  GAMBESON_HD static Vec3 at(const Placement& X, const Vec3& p) { return gpu::placed(X, p); }
};

}  // namespace gambeson::gpu
