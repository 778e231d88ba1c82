#pragma once
/// From the paths of a step to its hits: kernels around those of gpu/finding.

#include "core/contact/ellipsoid_path.hpp"
#include "core/motion/impact_side.hpp"
#include "gpu/finding/impact_search.hpp"
#include "gpu/finding/narrow.hpp"
#include "gpu/near/dressed_mesh.hpp"
#include "gpu/near/placing.hpp"
#include "gpu/step/impact_lists.hpp"

namespace gambeson::gpu {

/// What is counted beside the lists.
enum ImpactCounted {
  kPointsTaken = kImpactLists,
  kEdgesTaken,
  kSampleHits,
  kPointHits,
  kEdgeHits,
  kTouchingPairs,
  kCappedPairs,
  kImpactCounts
};

/// Where all is that a step prescribes or a solve has found, on the device.
struct ImpactPaths {
  const Vec3 *x0 = nullptr, *x1 = nullptr;  ///< of all vertices: samples of the cloth, then vertices of bodies
  const char* exempt = nullptr;             ///< of each sample: inside of a body, whose skin does not stop it
  const EllipsoidBody* ellipsoid =
      nullptr;  ///< of obstacles that are ellipsoids, in their order: metric and placements
  bool operator==(const ImpactPaths&) const = default;
};

/// What a pass begins with. Boxes of paths are grown by half of the separation.
struct BeginImpacts {
  ImpactPaths paths;
  int vertices;
  float margin_m;
  MovingPoint* point;
  FloatPoint* rough;
  FloatBox* box;
  Count* count;

  GAMBESON_HD void operator()(int i) const {
    if (i < vertices) {
      const MovingPoint p{paths.x0[i], paths.x1[i]};
      point[i] = p;
      rough[i] = floatPoint(p);
      box[i] = boxOf(p, margin_m);
    }
    if (i < kImpactCounts) count[i] = 0;
  }
};

/// Skin does not stop samples that are inside of it: a pair of cloth and a body counts where none of its samples is
/// exempt. N: as in PairQueries.
template <int N>
struct StopsPair {
  PairQueries<N> queries;
  const char* exempt;
  int samples;

  GAMBESON_HD bool operator()(const Pair& pair) const {
    bool inside = false, body = false;
    for (int k = 0; k < 4; ++k) {
      const int v = queries.vertex(pair, k);
      if (v >= samples)
        body = true;
      else
        inside = inside || exempt[v];
    }
    return !(body && inside);
  }
};

/// A pair that comes within the separation of all.
struct MetPair {
  Pair pair;
  double time, u, v;
  int capped;

  template <std::size_t N>
  GAMBESON_HD void note(const certified::Query<N>& q, const certified::Known& now, double enough_m) {
    const ImpactTime at = q.sound ? certified::impactAt(q, now, 0, enough_m) : certified::unsoundImpact();
    u = at.u, v = at.v, capped = at.capped;
  }
  GAMBESON_HD void set(const OpenPair& p) { pair = p.pair, time = p.time; }
};

struct MetList {
  using Found = MetPair;

  List<MetPair> met;

  template <class Group>
  GAMBESON_HD void append(const Group& group, const typename Group::template PerLane<bool>& on,
                          const typename Group::template PerLane<MetPair>& found) const {
    gpu::append(group, on, found, met);
  }
};

/// Where hits go, and what is counted with them (ImpactCounted).
struct StepHitList {
  List<StepHit> hits;
  Count* count;

  GAMBESON_HD void add(const StepHit& hit) const {
    const Count at = fetchAdd(hits.count, Count{1});
    if (at < hits.room) hits.items[at] = hit;
    fetchAdd(&count[kSampleHits + hit.kind], Count{1});
  }
};

constexpr double kNever = 2;  ///< the time of a pair that does not come within its own separation

/// Of the pairs that have met, when they come within their own separation, which depends on their distance at the
/// start.
template <int N>
struct ConfirmImpacts {
  PairQueries<N> queries;
  MetPair* met;
  Count* count;

  GAMBESON_HD void operator()(const MetPair& found, Count i) const {
    FourPoints x0, x1;
    queries.points(found.pair, x0, x1);
    const double start = certified::gapAtRest<N>(x0);
    if (!(start > 0)) {
      fetchAdd(&count[kTouchingPairs], Count{1});
      met[i].time = kNever;
      return;
    }
    bool capped = found.capped != 0;
    if (const double separation = separationFrom(start); separation < queries.separation_m) {
      const auto at = certified::findImpact<N>(x0, x1, separation, queries.tolerance_m);
      if (!at) {
        met[i].time = kNever;
        return;
      }
      met[i].time = at->time, met[i].u = at->u, met[i].v = at->v;
      capped = at->capped;
    }
    if (capped) fetchAdd(&count[kCappedPairs], Count{1});
  }
};

/// Of these, what does not come from inside a body: hits.
template <int N>
struct ListImpacts {
  PairQueries<N> queries;
  ImpactSurfaces surfaces;
  StepHitList out;

  GAMBESON_HD void operator()(const MetPair& met, Count) const {
    if (met.time == kNever) return;
    ImpactPair pair{N == 4, met.pair.first, met.pair.second, {}, {}, {}, met.time, met.u, met.v};
    queries.points(met.pair, pair.x0, pair.x1);
    for (int k = 0; k < 4; ++k) pair.vertex[k] = queries.vertex(met.pair, k);
    if (!comesFromInside(pair, surfaces))
      out.add({N == 3 ? kPointHit : kEdgeHit, met.pair.first, met.pair.second, met.time, met.u, met.v});
  }
};

/// Whether and where a sample enters an ellipsoid.
GAMBESON_HD inline bool entersEllipsoid(const ImpactPaths& paths, int sample, const EllipsoidBody& e,
                                        EllipsoidHit& hit) {
  return pathEnters(e.metric, e.start, toFrame(e.start, paths.x0[sample]), toFrame(e.end, paths.x1[sample]), hit);
}

struct SweepEllipsoids {
  const EllipsoidBody* ellipsoid;
  EllipsoidSweep* sweep;
  GAMBESON_HD void operator()(int i) const {
    const EllipsoidBody& e = ellipsoid[i];
    sweep[i] = sweepOf(e.metric, e.start, e.end);
  }
};
/// Of each sample, ellipsoids that it enters.
struct EnterEllipsoids {
  ImpactPaths paths;
  int ellipsoids;
  const EllipsoidSweep* sweep;
  StepHitList out;

  GAMBESON_HD void operator()(int sample) const {
    const Vec3 x0 = paths.x0[sample], x1 = paths.x1[sample];
    const Box starts{x0, x0}, path{minimum(x0, x1), maximum(x0, x1)};
    const double step_m = norm(x1 - x0);
    for (int i = 0; i < ellipsoids; ++i) {
      const EllipsoidBody& e = paths.ellipsoid[i];
      EllipsoidHit hit;
      if (sweep[i].mayMeet(starts, path, step_m, e.start.origin) && entersEllipsoid(paths, sample, e, hit))
        out.add({kSampleHit, sample, e.obstacle, hit.time, 0, 0});
    }
  }
};

}  // namespace gambeson::gpu
