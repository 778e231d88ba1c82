#pragma once
/// Which pairs meet, and when: the query of core/contact/impact_query.hpp cut into kernels, since a query of 250
/// registers leaves few lanes at work, and most pairs are apart by what takes few. N: 3 for a point and a triangle, 4
/// for two edges. Each pair gets its time, whatever the others'.

#include "core/contact/impact_query.hpp"
#include "gpu/device/list.hpp"
#include "gpu/finding/float_point.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

/// A pair that is open from a time on.
struct OpenPair {
  Pair pair;
  double time;
};

/// A pair that is open at that time after nearest points have been looked at, and what of that its next turn takes
/// (certified::Known).
struct HardPair {
  OpenPair open;
  Vec3 n;  ///< the direction that separates longest
  double u, v, until, gap_m;

  GAMBESON_HD void keep(const certified::Known& now) {
    n = now.furthest.n, u = now.furthest.u, v = now.furthest.v;
    until = now.until, gap_m = now.gap_m;
  }
  GAMBESON_HD certified::Known known() const {
    certified::Known now;
    now.furthest.n = n, now.furthest.u = u, now.furthest.v = v;
    now.until = until, now.gap_m = gap_m;
    return now;
  }
};

/// A hit, and how many others of its first primitive were found before it: for sorting (hit_order.hpp).
struct FoundHit {
  Hit hit;
  int place;

  /// What is known of the pair at its time; then which pair it is.
  template <std::size_t N>
  GAMBESON_HD void note(const certified::Query<N>&, const certified::Known&, double) {}
  GAMBESON_HD void set(const OpenPair& p) { hit = {p.pair, p.time}; }
};

/// Which pairs are asked at all.
struct EveryPair {
  GAMBESON_HD bool operator()(const Pair&) const { return true; }
};

/// What a query needs beside the pair.
template <int N>
struct PairQueries {
  const MovingPoint* point;
  const FloatPoint* rough;  ///< the same points
  const int* corners;       ///< 3 of a face, 2 of an edge
  double separation_m, tolerance_m;

  GAMBESON_HD void points(const Pair& pair, FourPoints& x0, FourPoints& x1) const {
    for (int k = 0; k < 4; ++k) {
      const MovingPoint& p = point[vertex(pair, k)];
      x0[k] = p.start, x1[k] = p.end;
    }
  }
  /// Apart by boxes in single precision?
  GAMBESON_HD bool surelyApart(const Pair& pair) const {
    FloatPoint p[4];
    for (int k = 0; k < 4; ++k) p[k] = rough[vertex(pair, k)];
    return gpu::surelyApart<N>(p, roundedUp(separation_m, 0));
  }
  /// The k-th of the four.
  GAMBESON_HD int vertex(const Pair& pair, int k) const {
    if constexpr (N == 3)
      return k == 0 ? pair.first : corners[3 * pair.second + k - 1];
    else
      return k < 2 ? corners[2 * pair.first + k] : corners[2 * pair.second + k - 2];
  }
};

/// What is left of the pairs by boxes, roughly and then exactly, and coplanarity: pairs that rough boxes leave gather
/// until every lane has one. Asks: asks(pair) tells which take part.
template <int N, class Asks = EveryPair>
struct SiftPairs {
  static constexpr int kResident = 16;
  struct Shared {
    Gathered<Pair, 64> near;
  };

  PairQueries<N> queries;
  List<Pair> pairs;
  List<OpenPair> open;
  Asks asks = {};

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    Lanes<Group, bool> left;
    Lanes<Group, Pair> pair;
    const Count n = pairs.size();
    int near = 0;
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n || near > 0;
         first += static_cast<Count>(groups) * Group::kLanes) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        left[lane] = false;
        if (i >= n) return;
        pair[lane] = pairs.items[i];
        left[lane] = !queries.surelyApart(pair[lane]) && asks(pair[lane]);
      });
      shared.near.add(group, left, pair, near);
      group.sync();
      if (near < Group::kLanes && first < n) continue;
      const int count = std::min(near, int{Group::kLanes});
      near -= count;
      lookClosely(group, shared, near, count);
    }
  }

 private:
  template <class Group, class T>
  using Lanes = typename Group::template PerLane<T>;

  /// The gathered pairs from `first` on.
  template <class Group>
  GAMBESON_HD void lookClosely(const Group& group, const Shared& shared, int first, int count) const {
    Lanes<Group, bool> left;
    Lanes<Group, OpenPair> item;
    group.each([&](int lane) {
      left[lane] = false;
      if (lane >= count) return;
      const Pair pair = shared.near.items[first + lane];
      FourPoints x0, x1;
      queries.points(pair, x0, x1);
      const auto q = certified::queryOf<N>(x0, x1, queries.separation_m);
      // What is not sound is a hit at 0, as the next look says.
      if (q.sound && q.boxesApart()) return;
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
  using Found = FoundHit;

  List<FoundHit> hits;
  int* of_first;

  template <class Group>
  GAMBESON_HD void append(const Group& group, const typename Group::template PerLane<bool>& on,
                          typename Group::template PerLane<FoundHit>& hit) const {
    group.each([&](int lane) {
      if (on[lane]) hit[lane].place = fetchAdd(&of_first[hit[lane].hit.pair.first], 1);
    });
    gpu::append(group, on, hit, hits);
  }
};

/// Nearest points at the time from which a pair is open: most are apart to the end by their direction, or meet. Hits:
/// takes what Found keeps of pairs that meet.
template <int N, class Hits = HitList>
struct LookFirst {
  static constexpr int kResident = 12;
  struct Shared {};

  PairQueries<N> queries;
  List<OpenPair> open;
  List<HardPair> hard;
  Hits hits;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    typename Group::template PerLane<bool> meets, left;
    typename Group::template PerLane<typename Hits::Found> found;
    typename Group::template PerLane<HardPair> looked;
    const Count n = open.size();
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n;
         first += static_cast<Count>(groups) * Group::kLanes) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        meets[lane] = left[lane] = false;
        if (i >= n) return;
        const OpenPair item = open.items[i];
        const double t = item.time;
        FourPoints x0, x1;
        queries.points(item.pair, x0, x1);
        const auto q = certified::queryOf<N>(x0, x1, queries.separation_m);
        const auto now = certified::know(q, q.at(t), t);
        const double enough_m = certified::enoughGap(q, queries.tolerance_m);
        const auto verdict = certified::verdict(now, t, enough_m, 0);
        meets[lane] = !q.sound || verdict == certified::Verdict::meets;
        left[lane] = q.sound && verdict == certified::Verdict::open;
        found[lane].note(q, now, enough_m);
        found[lane].set(item);
        looked[lane].open = item;
        looked[lane].keep(now);
      });
      hits.append(group, meets, found);
      append(group, left, looked, hard);
    }
  }
};

/// The others turn by turn; a lane that is done takes the next pair.
template <int N, class Hits = HitList>
struct TakeTurns {
  static constexpr int kResident = 12;
  struct Shared {};

  PairQueries<N> queries;
  List<HardPair> hard;
  Count* taken;  ///< 0 before
  Hits hits;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared&, int, int) const {
    typename Group::template PerLane<bool> busy(false), meets;
    typename Group::template PerLane<typename Hits::Found> met;
    typename Group::template PerLane<HardPair> item(HardPair{});
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
            queries.points(item[lane].open.pair, x0, x1);
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
        takeTurn(query[lane], coplanarity[lane], item[lane], stride[lane], ++turns[lane], busy[lane], meets[lane],
                 met[lane]);
        met[lane].set(item[lane].open);
      });
      hits.append(group, meets, met);
    }
  }

 private:
  /// A turn of a pair, and a look at where it leads.
  GAMBESON_HD void takeTurn(const certified::Query<N>& q, const certified::Coplanarity& coplanarity, HardPair& item,
                            double& stride, int turns, bool& busy, bool& meets, typename Hits::Found& met) const {
    double& t = item.open.time;
    certified::Known now = item.known(), later;
    certified::Turn turn = certified::Turn::moved;
    const double far = certified::lookAhead(q, now, t, stride);
    if (far > now.until) {
      const auto r_far = q.at(far);
      later = certified::know(q, r_far, far);
      turn = certified::turnTo(q, coplanarity, q.at(t), now, r_far, later, far, t, stride);
    } else {
      certified::moveOn(now, t, stride);
    }
    busy = turn != certified::Turn::apart;
    if (!busy) return;
    now = turn == certified::Turn::reached ? later : certified::know(q, q.at(t), t);
    const double enough_m = certified::enoughGap(q, queries.tolerance_m);
    const auto verdict = certified::verdict(now, t, enough_m, turns);
    meets = verdict == certified::Verdict::meets;
    busy = verdict == certified::Verdict::open;
    item.keep(now);
    met.note(q, now, enough_m);
  }
};

}  // namespace gambeson::gpu
