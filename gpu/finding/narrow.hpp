#pragma once
/// Which pairs meet, and when: the query of core/contact/impact_query.hpp cut into kernels, since a query of 250
/// registers leaves few lanes at work, and most pairs are apart by what takes few. N: 3 for a point and a triangle, 4
/// for two edges. Each pair gets its time, whatever the others'.

#include "core/contact/impact_query.hpp"
#include "gpu/device/list.hpp"
#include "gpu/finding/float_box.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

/// A pair that is open from a time on.
struct OpenPair {
  Pair pair;
  double time;
};

/// A hit, and how many others of its first primitive were found before it: for sorting (hit_order.hpp).
struct FoundHit {
  Hit hit;
  int place;
};

/// What a query needs beside the pair.
template <int N>
struct PairQueries {
  const MovingPoint* point;
  const int* corners;  ///< 3 of a face, 2 of an edge
  double separation_m, tolerance_m;

  GAMBESON_HD void points(const Pair& pair, FourPoints& x0, FourPoints& x1) const {
    for (int k = 0; k < 4; ++k) {
      const MovingPoint& p = point[vertex(pair, k)];
      x0[k] = p.start, x1[k] = p.end;
    }
  }

 private:
  GAMBESON_HD int vertex(const Pair& pair, int k) const {
    if constexpr (N == 3)
      return k == 0 ? pair.first : corners[3 * pair.second + k - 1];
    else
      return k < 2 ? corners[2 * pair.first + k] : corners[2 * pair.second + k - 2];
  }
};

/// What is left of the pairs by boxes, then by coplanarity: pairs that boxes leave gather until every lane has one.
template <int N>
struct SiftPairs {
  struct Shared {
    Gathered<Pair, 64> near;
  };

  PairQueries<N> queries;
  List<Pair> pairs;
  List<OpenPair> open;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    Lanes<Group, bool> left;
    Lanes<Group, Pair> pair;
    const Count n = pairs.size();
    int near = 0;
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n;
         first += static_cast<Count>(groups) * Group::kLanes) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        left[lane] = false;
        if (i >= n) return;
        pair[lane] = pairs.items[i];
        FourPoints x0, x1;
        queries.points(pair[lane], x0, x1);
        const auto q = certified::queryOf<N>(x0, x1, queries.separation_m);
        left[lane] = !q.sound || !q.boxesApart();
      });
      shared.near.add(group, left, pair, near);
      group.sync();
      if (near >= Group::kLanes) {
        near -= Group::kLanes;
        coplanar(group, shared, near, Group::kLanes);
      }
    }
    coplanar(group, shared, 0, near);
  }

 private:
  template <class Group, class T>
  using Lanes = typename Group::template PerLane<T>;

  /// The gathered pairs from `first` on.
  template <class Group>
  GAMBESON_HD void coplanar(const Group& group, const Shared& shared, int first, int count) const {
    Lanes<Group, bool> left;
    Lanes<Group, OpenPair> item;
    group.each([&](int lane) {
      left[lane] = false;
      if (lane >= count) return;
      const Pair pair = shared.near.items[first + lane];
      FourPoints x0, x1;
      queries.points(pair, x0, x1);
      const auto q = certified::queryOf<N>(x0, x1, queries.separation_m);
      const double time = q.sound ? certified::startTime(q, certified::coplanarity(q, x0, x1)) : 0;
      left[lane] = !(time >= 1);
      item[lane] = {pair, time};
    });
    append(group, left, item, open);
    group.sync();
  }
};

/// Where hits go, and how many each first primitive has.
struct HitList {
  List<FoundHit> hits;
  int* of_first;

  template <class Group>
  GAMBESON_HD void append(const Group& group, const typename Group::template PerLane<bool>& on,
                          const typename Group::template PerLane<OpenPair>& pair) const {
    typename Group::template PerLane<FoundHit> hit;
    group.each([&](int lane) {
      if (!on[lane]) return;
      const OpenPair& p = pair[lane];
      hit[lane] = {{p.pair, p.time}, fetchAdd(&of_first[p.pair.first], 1)};
    });
    gpu::append(group, on, hit, hits);
  }
};

/// Nearest points at the time from which a pair is open: most are apart to the end by their direction, or meet.
template <int N>
struct LookFirst {
  struct Shared {};

  PairQueries<N> queries;
  List<OpenPair> open, hard;
  HitList hits;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    typename Group::template PerLane<bool> meets, left;
    typename Group::template PerLane<OpenPair> item;
    const Count n = open.size();
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n;
         first += static_cast<Count>(groups) * Group::kLanes) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        meets[lane] = left[lane] = false;
        if (i >= n) return;
        item[lane] = open.items[i];
        const double t = item[lane].time;
        FourPoints x0, x1;
        queries.points(item[lane].pair, x0, x1);
        const auto q = certified::queryOf<N>(x0, x1, queries.separation_m);
        const auto now = certified::know(q, q.at(t), t);
        const auto verdict = certified::verdict(now, t, certified::enoughGap(q, queries.tolerance_m), 0);
        meets[lane] = !q.sound || verdict == certified::Verdict::meets;
        left[lane] = q.sound && verdict == certified::Verdict::open;
      });
      hits.append(group, meets, item);
      gpu::append(group, left, item, hard);
    }
  }
};

/// The others turn by turn; a lane that is done takes the next pair.
template <int N>
struct TakeTurns {
  struct Shared {};

  PairQueries<N> queries;
  List<OpenPair> hard;
  Count* taken;  ///< 0 before
  HitList hits;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared&, int, int) const {
    typename Group::template PerLane<bool> busy(false), meets;
    typename Group::template PerLane<OpenPair> item;
    typename Group::template PerLane<certified::Query<N>> query;
    typename Group::template PerLane<certified::Coplanarity> coplanarity;
    typename Group::template PerLane<double> stride(1);
    typename Group::template PerLane<int> turns(0);
    const Count n = hard.size();
    bool more = true;
    for (;;) {
      if (more) {
        group.each([&](int lane) { meets[lane] = !busy[lane]; });
        const LaneMask idle = group.ballot(meets);
        if (idle != 0) {
          const Count first = group.once([&] { return fetchAdd(taken, static_cast<Count>(lanesIn(idle))); });
          group.each([&](int lane) {
            const Count i = first + static_cast<Count>(lanesBefore(idle, lane));
            if (busy[lane] || i >= n) return;
            busy[lane] = true;
            item[lane] = hard.items[i];
            stride[lane] = 1, turns[lane] = 0;
            FourPoints x0, x1;
            queries.points(item[lane].pair, x0, x1);
            query[lane] = certified::queryOf<N>(x0, x1, queries.separation_m);
            coplanarity[lane] = certified::coplanarity(query[lane], x0, x1);
          });
          more = first + static_cast<Count>(lanesIn(idle)) < n;
        }
      }
      if (group.ballot(busy) == 0) return;
      group.each([&](int lane) {
        meets[lane] = false;
        if (!busy[lane]) return;
        const certified::Query<N>& q = query[lane];
        double& t = item[lane].time;
        const auto r = q.at(t);
        const auto now = certified::know(q, r, t);
        switch (certified::verdict(now, t, certified::enoughGap(q, queries.tolerance_m), turns[lane]++)) {
          case certified::Verdict::apart:
            busy[lane] = false;
            break;
          case certified::Verdict::meets:
            meets[lane] = true, busy[lane] = false;
            break;
          case certified::Verdict::open:
            // What a turn knows already of the time that it reached is found again: other lanes do so meanwhile.
            certified::Relative<N> r_far;
            certified::Known later;
            busy[lane] = certified::advance(q, coplanarity[lane], r, now, t, stride[lane], r_far, later) !=
                         certified::Turn::apart;
        }
      });
      hits.append(group, meets, item);
    }
  }
};

}  // namespace gambeson::gpu
