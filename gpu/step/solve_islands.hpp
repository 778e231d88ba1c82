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

/// What rows move: entries of each row from its `first` on.
struct RowReach {
  int *first, *count;
  int* point;
  double* weight;
  Count room;  ///< for the entries of all rows
};

struct IslandOrder {
  SolveRows s;
  RowReach reach;
  // Of rows.
  double* own;  ///< what the row's own impulse does to it, over its area; drift: of what nothing of the points does
  Vec3* drift;
  int *island, *rank, *kept_island;  ///< of a row; -1: none
  // Of places: rows of an island together.
  int *position, *ordered, *colour, *key, *order;
  // Of points.
  int *tied, *size;  ///< size: of a root rows, then the island's number
  int* number;       ///< in its island, from 1 on
  std::uint32_t *taken, *rows_at;  ///< rows_at: of a group that colours, 0 before and after
  int* free_points;
  // Of islands.
  int *root, *island_points;
  SolveIsland *islands, *kept_islands;
  SolveChunk* chunks;
  int* steps;

  /// Whether there is an island that no group takes, or no room: nothing is ordered then, and nothing solved.
  GAMBESON_HD bool fails() const { return s.facts->most_rows > kIslandRows || s.facts->reach > reach.room; }
  GAMBESON_HD const int* pointsOf(int i) const { return reach.point + reach.first[i]; }
};

/// All rows by the sample that they begin with, then as they come.
struct RowsInOrder {
  const int *listed, *begin;  ///< lists; where those of this sort begin
  GAMBESON_HD int operator[](int p) const { return listed[*begin + p] / kPartsOfRow; }
};

struct ForgetReach {
  IslandOrder o;
  GAMBESON_HD void operator()(int i) const { o.reach.count[i] = o.kept_island[i] = -1; }
};
struct ClearPoints {
  IslandOrder o;
  int points;
  GAMBESON_HD void operator()(int k) const {
    SolveFacts& facts = *o.s.facts;
    if (k == 0) {
      facts.islands = facts.rows = facts.points = facts.others = 0;
    }
    if (k >= points) return;
    o.tied[k] = k;
    o.size[k] = o.number[k] = 0;
    o.rows_at[k] = 0;
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
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int n = static_cast<int>(o.s.rows.size());
    for (int i = index; i < n; i += groups) {
      if (!o.s.in[i]) continue;
      if (o.reach.count[i] < 0) find(group, i);
      const int count = o.reach.count[i];
      const int* const points = o.pointsOf(i);
      group.each([&](int lane) {
        for (int e = 1 + lane; e < count; e += Group::kLanes) unite(o.tied, points[0], points[e]);
      });
    }
  }

 private:
  GAMBESON_HD void find(const Group& group, int i) const {
    const ContactStencil& at = o.s.rows.stencil[i];
    int most = 0;
    for (int j = 0; j < at.count; ++j) most += m.WT.length[at.sample[j]];
    const Count begin = group.once([&] { return fetchAdd(&o.s.facts->reach, static_cast<Count>(most)); });
    const bool fits = begin + static_cast<Count>(most) <= o.reach.room;
    int* const points = o.reach.point + begin;
    double* const weights = o.reach.weight + begin;
    int count = 0;
    for (int j = 0; fits && j < at.count; ++j) {
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
      o.reach.first[i] = static_cast<int>(begin);
      o.reach.count[i] = count;
    });
    group.sync();
  }
};

struct NumberIslands {
  IslandOrder o;
  GAMBESON_HD void operator()(int i) const {
    o.island[i] = -1;
    if (!o.s.in[i] || o.fails()) return;
    const int root = rootOf(o.tied, o.pointsOf(i)[0]);
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
    if (k >= o.s.facts->rows || o.fails()) return;
    const int mine = o.position[k], i = sorted[mine];
    const SolveIsland& island = o.islands[o.island[i]];
    int rank = island.row;
    for (int b = island.row; b < island.row_end; ++b) rank += o.position[b] < mine;
    o.ordered[rank] = i;
  }
};

/// Gives rows of an island, by a group, the first colour that no row before has at any of the row's points; what finds
/// all taken one of its own. A lane has a row: which rows of the others come before it at its points is found side by
/// side, so that in turn each has only to tell the others its colour. Nearly all find one of the first 32, whose bits
/// lie in shared memory, by the numbers of the points.
template <class Group>
struct ColourRows {
  static constexpr int kResident = 16, kStaged = 16, kPoints = 1152;
  struct Shared {
    std::uint32_t first[kPoints], rows[kPoints];
    int point[kStaged][32];
  };

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const int islands = o.fails() ? 0 : o.s.facts->islands;
    for (int q = index; q < islands; q += groups) {
      const int points = o.island_points[q];
      group.each([&](int lane) {
        for (int p = lane; p < points && p < kPoints; p += Group::kLanes) shared.first[p] = shared.rows[p] = 0;
      });
      group.sync();
      const SolveIsland& island = o.islands[q];
      int more = kColours;
      for (int k = island.row; k < island.row_end; k += Group::kLanes)
        colour(group, shared, k, island.row_end - k < Group::kLanes ? island.row_end - k : Group::kLanes,
               points <= kPoints, more);
    }
  }

 private:
  using Bits = typename Group::template PerLane<std::uint32_t>;

  GAMBESON_HD std::uint32_t& taken(int f, int word) const {
    return o.taken[static_cast<std::ptrdiff_t>(kColourWords) * f + word];
  }
  /// visit(colours at the point, rows of the group at it) for each point of a row.
  template <class Visit>
  GAMBESON_HD void eachPoint(Shared& shared, int lane, int i, bool numbered, bool staged, const Visit& visit) const {
    const int count = o.reach.count[i];
    const int* const points = o.pointsOf(i);
    for (int e = 0; e < count; ++e) {
      const bool stands = e < kStaged;
      const int p = staged && stands ? shared.point[e][lane] : numbered ? o.number[points[e]] - 1 : points[e];
      if (!staged && stands) shared.point[e][lane] = p;
      if (numbered)
        visit(shared.first[p], shared.rows[p]);
      else
        visit(taken(p, 0), o.rows_at[p]);
    }
  }

  /// The n rows from place k on.
  GAMBESON_HD void colour(const Group& group, Shared& shared, int k, int n, bool numbered, int& more) const {
    Bits all, before;  // colours that are taken, rows of the group that come before
    group.each([&](int lane) {
      if (lane >= n) return;
      eachPoint(shared, lane, o.ordered[k + lane], numbered, false,
                [&](std::uint32_t&, std::uint32_t& rows) { fetchOr(&rows, std::uint32_t{1} << lane); });
    });
    group.sync();
    group.each([&](int lane) {
      all[lane] = before[lane] = 0;
      if (lane >= n) return;
      eachPoint(shared, lane, o.ordered[k + lane], numbered, true, [&](std::uint32_t& colours, std::uint32_t& rows) {
        all[lane] |= colours;
        before[lane] |= rows;
      });
    });
    typename Group::template PerLane<int> mine(0);
    for (int r = 0; r < n; ++r) {
      const std::uint32_t there = group.of(all, r);
      const int colour = ~there != 0 ? firstClear(there) : laterColour(group, o.ordered[k + r], more);
      group.each([&](int lane) {
        if (lane == r) mine[lane] = colour;
        if (colour < 32 && (before[lane] >> r & 1) != 0) all[lane] |= std::uint32_t{1} << colour;
      });
    }
    group.sync();
    group.each([&](int lane) {
      if (lane >= n) return;
      o.colour[k + lane] = mine[lane];
      eachPoint(shared, lane, o.ordered[k + lane], numbered, true, [&](std::uint32_t& colours, std::uint32_t& rows) {
        if (mine[lane] < 32) fetchOr(&colours, std::uint32_t{1} << mine[lane]);
        put(&rows, std::uint32_t{0});
      });
    });
    group.sync();
  }
  /// Of a row that finds the first ones taken.
  GAMBESON_HD int laterColour(const Group& group, int i, int& more) const {
    const int* const points = o.pointsOf(i);
    const int count = o.reach.count[i];
    for (int w = 1; w < kColourWords; ++w) {
      Bits mine;
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
      group.sync();
      return 32 * w + bit;
    }
    return more++;
  }
};

/// Of places: o.order, rows by colour, then in their order; o.key: which of its colour a row is.
struct SortByColour {
  IslandOrder o;
  GAMBESON_HD void operator()(int k) const {
    if (k >= o.s.facts->rows || o.fails()) return;
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
/// Points are numbered within their islands; a group takes a row.
template <class Group>
struct NumberPoints {
  static constexpr int kResident = 32;
  struct Shared {};

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int n = o.fails() ? 0 : static_cast<int>(o.s.rows.size());
    for (int i = index; i < n; i += groups) {
      if (!o.s.in[i]) continue;
      const int count = o.reach.count[i];
      group.each([&](int lane) {
        for (int e = lane; e < count; e += Group::kLanes) number(o.pointsOf(i)[e], o.island[i]);
      });
    }
  }

 private:
  GAMBESON_HD void number(int f, int island) const {
    if (seen(o.number[f]) == 0 && swapIf(&o.number[f], 0, -1))
      put(&o.number[f], fetchAdd(&o.island_points[island], 1) + 1);
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
    const int islands = o.fails() ? 0 : o.s.facts->islands;
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

/// Rows in the order of the iteration, with what they are to it, by a group each.
template <class Group>
struct FillRows {
  static constexpr int kResident = 32;
  struct Shared {};

  SolveModel m;
  IslandOrder o;
  double* facts;  ///< RowFacts
  double *own, *slope;
  RowEntries* entries;
  double* state;  ///< RowState
  int* place;     ///< of a row in the iteration
  int others;     ///< where entries stand that have no place, of all rows
  int* point;
  double *weight, *push;

  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int rows = o.fails() ? 0 : o.s.facts->rows;
    for (int k = index; k < rows; k += groups) {
      const int i = o.order[k], count = o.reach.count[i], without = count > kPlaces ? count - kPlaces : 0;
      const int more = others + group.once([&] { return without == 0 ? 0 : fetchAdd(&o.s.facts->others, without); });
      const int free_point = o.islands[o.island[i]].free_point;
      group.each([&](int lane) {
        if (lane == 0) fill(k, i, {count, more});
        for (int e = lane; e < count; e += Group::kLanes) {
          const int from = o.reach.first[i] + e, f = o.reach.point[from], number = o.number[f] - 1;
          const double w = o.reach.weight[from];
          const int at = e < kPlaces ? placeOf(k, e) : more + e - kPlaces;
          point[at] = number;
          weight[at] = w;
          push[at] = w * m.inverse_mass[f];
          o.free_points[free_point + number] = f;
        }
        for (int e = count + lane; e < kPlaces; e += Group::kLanes) {
          const int at = placeOf(k, e);
          point[at] = 0;
          weight[at] = push[at] = 0;
        }
      });
    }
  }

 private:
  GAMBESON_HD void fill(int k, int i, const RowEntries& has) const {
    const SolveRows& s = o.s;
    entries[k] = has;
    RowFacts{s.rows.facts[i].normal, o.drift[i], s.friction[i], 0, s.rows.terms[i].compliance, s.area_m2[i]}.put(facts,
                                                                                                                 k);
    own[k] = o.own[i];
    slope[k] = s.slope[i];
    s.state[i].put(state, k);
    o.kept_island[i] = o.island[i];
    place[i] = k;
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

/// Before sweeps: how far they go. Whether there are any.
struct NextSweeps {
  IslandOrder o;
  const SolveLimits* limits;
  GAMBESON_HD bool operator()() const {
    SolveFacts& f = *o.s.facts;
    if (f.ended || o.fails()) return false;
    const int most = limits->most, next = f.limits.last == 0 ? kFirstCheck : 2 * f.limits.last;
    if (f.limits.last == 0) f.limits.goal_m_per_s = goalOf(limits->tolerance_m_per_s, numberOf(f.largest));
    f.limits.last = next < most ? next : most;
    f.limits.calm = most - most / 4;
    f.residual = f.left_out = 0;
    f.iterations = f.undone = f.joins = 0;
    return true;
  }
};
/// After them: what the report says. Whether rows have joined, so that islands and their order are to be found anew.
struct EndSweeps {
  SolveFacts* facts;
  const SolveLimits* limits;
  GAMBESON_HD bool operator()() const {
    SolveFacts& f = *facts;
    const double left_out = std::sqrt(numberOf(f.left_out)), swept = numberOf(f.residual);
    f.converged = left_out <= f.limits.goal_m_per_s && f.undone == 0;
    f.residual_m_per_s = left_out < swept ? swept : left_out;
    f.ended = f.converged || f.limits.last >= limits->most;
    return !f.ended && f.joins > 0;
  }
};

/// What the solve leaves in the rows: nothing where it fails.
struct EndRows {
  IslandOrder o;
  GAMBESON_HD void operator()(int i) const {
    if (o.fails()) return;
    const SolveRows& s = o.s;
    const Vec3 t = s.in[i] ? s.state[i].now : Vec3{};
    s.rows.traction[i] = t;
    s.rows.impulse[i] = s.area_m2[i] * t;
  }
};

}  // namespace gambeson::gpu
