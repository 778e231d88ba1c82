#pragma once
/// The islands of a solve and the order of their rows, on a device: what restrict (core/contact/contact_rows.cpp) and
/// orderRows (row_order.cpp) make of the rows that are iterated on, where no island is so large that core cuts it into
/// chunks. Islands and points have other numbers here, which nothing hangs on.

#include <limits>

#include "core/contact/row_order.hpp"
#include "gpu/step/solve_rows.hpp"

namespace gambeson::gpu {

constexpr int kIslandRows = kWholeIsland;  ///< of an island, at most
constexpr int kColourWords = kColours / 32;

/// Whether there is an island that no group takes: nothing is ordered then.
GAMBESON_HD inline bool tooLarge(const SolveFacts& facts) { return facts.most_rows > kIslandRows; }

struct IslandOrder {
  SolveRows s;
  // Of rows.
  int reach_room;  ///< points of a row, at most
  int* reach_count;
  int* reach_point;
  double* reach_weight;
  double* own;  ///< what the row's own impulse does to it, over its area; drift: of what nothing of the points does
  Vec3* drift;
  int *island, *rank, *kept_island;  ///< of a row; -1: none
  // Of places: rows of an island together.
  int *position, *ordered, *colour, *key, *order;
  // Of points.
  int *tied, *size;  ///< size: of a root rows, then the island's number
  int* number;       ///< in its island, from 1 on
  std::uint32_t* taken;
  int* free_points;
  // Of islands.
  int *root, *island_points;
  SolveIsland *islands, *kept_islands;
  SolveChunk* chunks;
  int* steps;
};

/// All rows by the sample that they begin with, then as they come.
struct RowsInOrder {
  const int *listed, *begin;  ///< lists; where those of this sort begin
  GAMBESON_HD int operator[](int p) const { return listed[*begin + p] / kPartsOfRow; }
};

struct ForgetReach {
  IslandOrder o;
  GAMBESON_HD void operator()(int i) const { o.reach_count[i] = o.kept_island[i] = -1; }
};
struct ClearPoints {
  IslandOrder o;
  int points;
  GAMBESON_HD void operator()(int k) const {
    SolveFacts& facts = *o.s.facts;
    if (k == 0) {
      facts.islands = facts.rows = facts.points = 0;
    }
    if (k >= points) return;
    o.tied[k] = k;
    o.size[k] = o.number[k] = 0;
    for (int w = 0; w < kColourWords; ++w) o.taken[kColourWords * k + w] = 0;
  }
};

GAMBESON_HD inline int rootOf(const int* tied, int f) {
  for (int next = seen(tied[f]); next != f; next = seen(tied[f])) f = next;
  return f;
}
GAMBESON_HD inline void unite(int* tied, int a, int b) {
  for (;;) {
    a = rootOf(tied, a), b = rootOf(tied, b);
    if (a == b) return;
    const int less = a < b ? a : b, more = a < b ? b : a;
    if (swapIf(&tied[more], more, less)) return;
  }
}

/// What a row moves with, by a group, and islands by it. The least point of an island is its root.
template <class Group>
struct TiePoints {
  static constexpr int kResident = 32;
  struct Shared {};

  SolveModel m;
  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int i, int) const {
    if (!o.s.in[i]) return;
    int* const points = o.reach_point + static_cast<std::ptrdiff_t>(o.reach_room) * i;
    if (o.reach_count[i] < 0) reach(group, i, points, o.reach_weight + static_cast<std::ptrdiff_t>(o.reach_room) * i);
    const int count = o.reach_count[i];
    group.each([&](int lane) {
      for (int e = 1 + lane; e < count; e += Group::kLanes) unite(o.tied, points[0], points[e]);
    });
  }

 private:
  GAMBESON_HD void reach(const Group& group, int i, int* points, double* weights) const {
    const ContactStencil& at = o.s.rows.stencil[i];
    int count = 0;
    for (int j = 0; j < at.count; ++j) {
      const int row = at.sample[j], first = m.WT.first[row >> 5] + (row & 31), length = m.WT.length[row],
                before = count;
      for (int from = 0; from < length; from += Group::kLanes) {
        typename Group::template PerLane<bool> is_new;
        typename Group::template PerLane<int> point;
        typename Group::template PerLane<double> weight;
        group.each([&](int lane) {
          is_new[lane] = false;
          const int k = from + lane;
          if (k >= length) return;
          const int f = m.WT.column[first + 32 * k];
          const double w = at.weight[j] * m.WT.value[first + 32 * k];
          if (w == 0 || !(m.inverse_mass[f] > 0)) return;
          int known = 0;
          while (known < before && points[known] != f) ++known;
          if (known < before) weights[known] += w;
          is_new[lane] = known == before;
          point[lane] = f, weight[lane] = w;
        });
        const LaneMask mask = group.ballot(is_new);
        group.each([&](int lane) {
          if (!is_new[lane]) return;
          const int slot = count + lanesBefore(mask, lane);
          points[slot] = point[lane], weights[slot] = weight[lane];
        });
        count += lanesIn(mask);
      }
      group.sync();
    }
    group.each([&](int lane) {
      if (lane != 0) return;
      double own = 0;
      Vec3 moves{};  // of its points as they would move without contacts
      for (int e = 0; e < count; ++e) {
        own += weights[e] * weights[e] * m.inverse_mass[points[e]];
        moves += weights[e] * o.s.predicted[points[e]];
      }
      o.own[i] = own * o.s.area_m2[i];
      o.drift[i] = moves - o.s.start[i];
      o.reach_count[i] = count;
    });
    group.sync();
  }
};

struct NumberIslands {
  IslandOrder o;
  GAMBESON_HD void operator()(int i) const {
    o.island[i] = -1;
    if (!o.s.in[i]) return;
    const int root = rootOf(o.tied, o.reach_point[static_cast<std::ptrdiff_t>(o.reach_room) * i]);
    o.island[i] = root;  // for now
    o.rank[i] = fetchAdd(&o.size[root], 1);
    if (o.rank[i] > 0) return;
    const int number = fetchAdd(&o.s.facts->islands, 1);
    o.root[number] = root;
  }
};
struct PlaceIslands {
  IslandOrder o;
  GAMBESON_HD void operator()(int q) const {
    if (q >= o.s.facts->islands) return;
    const int rows = o.size[o.root[q]];
    o.size[o.root[q]] = q;  // from here on
    SolveIsland island;
    island.row = fetchAdd(&o.s.facts->rows, rows);
    island.row_end = island.row + rows;
    island.chunk = q, island.chunk_end = q + 1;
    o.islands[q] = island;
    o.island_points[q] = 0;
    fetchMax(&o.s.facts->most_rows, rows);
  }
};
struct PlaceInIslands {
  IslandOrder o;
  RowsInOrder sorted;
  GAMBESON_HD void operator()(int p) const {
    const int i = sorted[p];
    if (o.island[i] < 0) return;
    o.island[i] = o.size[o.island[i]];
    o.position[o.islands[o.island[i]].row + o.rank[i]] = p;
  }
};
/// Of places of islands: o.ordered, rows in their order.
struct SortByPosition {
  IslandOrder o;
  RowsInOrder sorted;
  GAMBESON_HD void operator()(int k) const {
    if (k >= o.s.facts->rows || tooLarge(*o.s.facts)) return;
    const int mine = o.position[k], i = sorted[mine];
    const SolveIsland& island = o.islands[o.island[i]];
    int rank = island.row;
    for (int b = island.row; b < island.row_end; ++b) rank += o.position[b] < mine;
    o.ordered[rank] = i;
  }
};

/// Gives rows of an island, by a group, the first colour that no row before has at any of the row's points; what finds
/// all taken one of its own. Nearly all find one of the first 32, whose bits lie in shared memory, by the numbers of
/// the points.
template <class Group>
struct ColourRows {
  static constexpr int kResident = 16, kStaged = 24, kPoints = 1536;
  struct Shared {
    std::uint32_t first[kPoints];
    int point[32][kStaged], count[32];
  };

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const int islands = tooLarge(*o.s.facts) ? 0 : o.s.facts->islands;
    for (int q = index; q < islands; q += groups) {
      const int points = o.island_points[q];
      group.each([&](int lane) {
        for (int p = lane; p < points && p < kPoints; p += Group::kLanes) shared.first[p] = 0;
      });
      colour(group, shared, o.islands[q].row, o.islands[q].row_end - o.islands[q].row, points <= kPoints);
    }
  }

 private:
  GAMBESON_HD const int* pointsOf(int i) const { return o.reach_point + static_cast<std::ptrdiff_t>(o.reach_room) * i; }
  GAMBESON_HD std::uint32_t& taken(int f, int word) const {
    return o.taken[static_cast<std::ptrdiff_t>(kColourWords) * f + word];
  }

  GAMBESON_HD void colour(const Group& group, Shared& shared, int begin, int n, bool numbered) const {
    int more = kColours;
    for (int first = 0; first < n; first += Group::kLanes) {
      group.sync();
      group.each([&](int lane) {
        if (first + lane >= n) return;
        const int i = o.ordered[begin + first + lane], count = o.reach_count[i];
        shared.count[lane] = count;
        for (int e = 0; e < count && e < kStaged; ++e) {
          const int f = pointsOf(i)[e];
          shared.point[lane][e] = numbered ? o.number[f] - 1 : f;
        }
      });
      group.sync();
      for (int r = 0; r < Group::kLanes && first + r < n; ++r) {
        const int count = shared.count[r], place = begin + first + r;
        const auto firstBits = [&](int e) -> std::uint32_t& {
          int p = 0;
          if (e < kStaged) {
            p = shared.point[r][e];
          } else {
            p = pointsOf(o.ordered[place])[e];
            if (numbered) p = o.number[p] - 1;
          }
          return numbered ? shared.first[p] : taken(p, 0);
        };
        typename Group::template PerLane<std::uint32_t> mine;
        group.each([&](int lane) {
          mine[lane] = 0;
          for (int e = lane; e < count; e += Group::kLanes) mine[lane] |= firstBits(e);
        });
        const std::uint32_t all = group.orOf(mine);
        const int colour = ~all != 0 ? firstClear(all) : laterColour(group, o.ordered[place], count, more);
        group.each([&](int lane) {
          if (lane == 0) o.colour[place] = colour;
          if (colour >= 32) return;
          for (int e = lane; e < count; e += Group::kLanes) firstBits(e) |= std::uint32_t{1} << colour;
        });
        group.sync();
      }
    }
  }
  /// Of a row that finds the first ones taken.
  GAMBESON_HD int laterColour(const Group& group, int i, int count, int& more) const {
    const int* const points = pointsOf(i);
    for (int w = 1; w < kColourWords; ++w) {
      typename Group::template PerLane<std::uint32_t> mine;
      group.each([&](int lane) {
        mine[lane] = 0;
        for (int e = lane; e < count; e += Group::kLanes) mine[lane] |= taken(points[e], w);
      });
      const std::uint32_t all = group.orOf(mine);
      if (~all == 0) continue;
      const int bit = firstClear(all);
      group.each([&](int lane) {
        for (int e = lane; e < count; e += Group::kLanes) taken(points[e], w) |= std::uint32_t{1} << bit;
      });
      return 32 * w + bit;
    }
    return more++;
  }
};

/// Of places: o.order, rows by colour, then in their order; o.key: which of its colour a row is.
struct SortByColour {
  IslandOrder o;
  GAMBESON_HD void operator()(int k) const {
    if (k >= o.s.facts->rows || tooLarge(*o.s.facts)) return;
    const int i = o.ordered[k], mine = o.colour[k];
    const SolveIsland& island = o.islands[o.island[i]];
    int below = 0, same = 0;
    for (int b = island.row; b < island.row_end; ++b) {
      const int other = o.colour[b];
      below += other < mine;
      same += other == mine && b < k;
    }
    o.order[island.row + below + same] = i;
    o.key[island.row + below + same] = same;
  }
};
/// Of entries of rows: points are numbered within their islands.
struct NumberPoints {
  IslandOrder o;
  GAMBESON_HD void operator()(int k) const {
    const int i = k / o.reach_room, e = k - i * o.reach_room;
    if (!o.s.in[i] || e >= o.reach_count[i]) return;
    const int f = o.reach_point[static_cast<std::ptrdiff_t>(o.reach_room) * i + e];
    if (seen(o.number[f]) == 0 && swapIf(&o.number[f], 0, -1))
      put(&o.number[f], fetchAdd(&o.island_points[o.island[i]], 1) + 1);
  }
};

/// A group takes an island after the other: where its points stand, its steps, and how it goes on where its rows were
/// in islands before.
template <class Group>
struct EndIslands {
  static constexpr int kResident = 32;
  struct Shared {
    double momentum[32];
    int at[32];
  };

  IslandOrder o;
  bool goes_on;  ///< there were islands before

  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const int islands = tooLarge(*o.s.facts) ? 0 : o.s.facts->islands;
    for (int q = index; q < islands; q += groups) {
      SolveIsland island = o.islands[q];
      const int begin = island.row, n = island.row_end - island.row;
      const int points = o.island_points[q];
      island.free_point = group.once([&] { return fetchAdd(&o.s.facts->points, points); });
      island.free_end = island.free_point + points;
      SolveChunk chunk{};
      chunk.row = begin, chunk.row_end = begin + n;
      chunk.step = begin, chunk.step_end = begin + cutIntoSteps(group, begin, n);
      if (goes_on) goOn(group, shared, begin, n, island);
      group.each([&](int lane) {
        if (lane == 0) o.islands[q] = island, o.chunks[q] = chunk;
      });
      group.sync();
    }
  }

 private:
  /// Rows of one colour, at most kSumLanes of them, are a step: where steps begin; how many there are.
  GAMBESON_HD int cutIntoSteps(const Group& group, int begin, int n) const {
    int steps = 0;
    for (int first = 0; first < n; first += Group::kLanes) {
      typename Group::template PerLane<bool> starts;
      group.each([&](int lane) { starts[lane] = first + lane < n && o.key[begin + first + lane] % kSumLanes == 0; });
      const LaneMask mask = group.ballot(starts);
      group.each([&](int lane) {
        if (starts[lane]) o.steps[begin + steps + lanesBefore(mask, lane)] = begin + first + lane;
      });
      steps += lanesIn(mask);
    }
    return steps;
  }
  /// With the least momentum of those that grew together, the first of several (join, core/contact/response.cpp).
  GAMBESON_HD void goOn(const Group& group, Shared& shared, int begin, int n, SolveIsland& island) const {
    typename Group::template PerLane<bool> differs;
    const int of_first = o.kept_island[o.order[begin]];
    group.each([&](int lane) {
      differs[lane] = false;
      shared.at[lane] = -1, shared.momentum[lane] = 0;
      for (int a = lane; a < n; a += Group::kLanes) {
        const int old = o.kept_island[o.order[begin + a]];
        differs[lane] = differs[lane] || old < 0 || old != of_first;
        if (old < 0) continue;
        const double momentum = o.kept_islands[old].momentum;
        if (shared.at[lane] >= 0 && !(momentum < shared.momentum[lane])) continue;
        shared.at[lane] = a, shared.momentum[lane] = momentum;
      }
    });
    group.sync();
    const bool same = group.ballot(differs) == 0;
    int at = -1;
    double momentum = 0;
    for (int lane = 0; lane < Group::kLanes; ++lane) {
      if (shared.at[lane] < 0) continue;
      const double other = shared.momentum[lane];
      if (at >= 0 && !(other < momentum || (other == momentum && shared.at[lane] < at))) continue;
      at = shared.at[lane], momentum = other;
    }
    group.sync();
    if (at < 0) return;
    const SolveIsland& slowest = o.kept_islands[o.kept_island[o.order[begin + at]]];
    island.beta = slowest.beta;
    island.momentum = slowest.momentum;
    island.caution = slowest.caution;
    island.iterations = slowest.iterations;
    island.residual_m_per_s = slowest.residual_m_per_s;
    island.done = same && slowest.done;
  }
};

/// Rows in the order of the iteration, with what they are to it.
struct FillRows {
  IslandOrder o;
  double* facts;  ///< RowFacts
  double *own, *slope;
  RowEntries* entries;
  double* state;  ///< RowState
  int* place;     ///< of a row in the iteration
  int others;     ///< where entries stand that have no place, of all rows

  GAMBESON_HD void operator()(int k) const {
    const SolveRows& s = o.s;
    if (k >= s.facts->rows || tooLarge(*s.facts)) return;
    const int i = o.order[k];
    entries[k] = {o.reach_count[i], otherEntries(k)};
    RowFacts{s.rows.facts[i].normal, o.drift[i], s.friction[i], 0, s.rows.terms[i].compliance, s.area_m2[i]}.put(facts,
                                                                                                                 k);
    own[k] = o.own[i];
    slope[k] = s.slope[i];
    s.state[i].put(state, k);
    o.kept_island[i] = o.island[i];
    place[i] = k;
  }
  GAMBESON_HD int otherEntries(int k) const {
    return others + (o.reach_room > kPlaces ? o.reach_room - kPlaces : 0) * k;
  }
};
struct FillEntries {
  SolveModel m;
  FillRows rows;
  int* point;
  double *weight, *push;
  GAMBESON_HD void operator()(int ke) const {
    const IslandOrder& o = rows.o;
    const int k = ke / o.reach_room, e = ke - k * o.reach_room;
    if (k >= o.s.facts->rows || tooLarge(*o.s.facts)) return;
    const int i = o.order[k];
    if (e >= o.reach_count[i]) return;
    const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(o.reach_room) * i + e;
    const int f = o.reach_point[from], number = o.number[f] - 1;
    const double w = o.reach_weight[from];
    const int at = e < kPlaces ? placeOf(k, e) : rows.otherEntries(k) + e - kPlaces;
    point[at] = number;
    weight[at] = w;
    push[at] = w * m.inverse_mass[f];
    o.free_points[o.islands[o.island[i]].free_point + number] = f;
  }
};

/// After sweeps.
struct LookAtIslands {
  IslandOrder o;
  GAMBESON_HD void operator()(int q) const {
    if (q >= o.s.facts->islands) return;
    const SolveIsland& island = o.islands[q];
    const double residual = island.residual_m_per_s;
    raise(&o.s.facts->residual, inOrder(residual == residual ? residual : std::numeric_limits<double>::infinity()));
    fetchMax(&o.s.facts->iterations, island.iterations);
    if (!island.done) fetchAdd(&o.s.facts->undone, 1);
    o.kept_islands[q] = island;
  }
};

}  // namespace gambeson::gpu
