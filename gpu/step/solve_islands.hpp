#pragma once
/// The islands of a solve and the order of their rows, on a device: what restrict (core/contact/contact_rows.cpp) and
/// orderRows (row_order.cpp) make of the rows that are iterated on; large islands are cut in solve_chunks.hpp. Islands,
/// parts and points have other numbers here, which nothing hangs on.

#include <limits>

#include "gpu/step/island_order.hpp"

namespace gambeson::gpu {

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
      facts.parts = facts.large = facts.cut = 0, facts.bits = 0;
      facts.chunk_points = points;
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
    o.island_points[q] = o.island_parts[q] = 0;
    fetchMax(&o.s.facts->most_rows, rows);
  }
};
/// A small island has its rows in the order in which they come, a large one by the places that they begin with first.
struct PlaceInIslands {
  SolveModel m;
  IslandOrder o;
  RowsInOrder sorted;
  GAMBESON_HD void operator()(int p) const {
    const int i = sorted[p];
    if (o.island[i] < 0) return;
    o.island[i] = o.size[o.island[i]];
    const SolveIsland& island = o.islands[o.island[i]];
    const bool large = island.row_end - island.row > kWholeIsland && m.places > 0;
    const int place = large ? m.place[o.s.rows.stencil[i].sample[0]] : 0;
    o.position[island.row + o.rank[i]] = static_cast<Count>(place) << 32 | static_cast<Count>(p);
  }
};
/// Of places of islands: o.ordered, rows in their order.
struct SortByPosition {
  IslandOrder o;
  RowsInOrder sorted;
  GAMBESON_HD void operator()(int k) const {
    if (k >= o.s.facts->rows || o.fails()) return;
    const Count mine = o.position[k];
    const int i = sorted[static_cast<int>(mine & 0xffffffffU)];
    const SolveIsland& island = o.islands[o.island[i]];
    int rank = island.row;
    for (int b = island.row; b < island.row_end; ++b) rank += o.position[b] < mine;
    o.ordered[rank] = i;
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

/// A group takes an island after the other: where its points stand, and how it goes on where its rows were in islands
/// before.
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
      if (goes_on) goOn(group, shared, begin, n, island);
      group.each([&](int lane) {
        if (lane == 0) o.islands[q] = island;
      });
      group.sync();
    }
  }

 private:
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

/// Parts become chunks, by a group each.
template <class Group>
struct EndChunks {
  static constexpr int kResident = 32;
  struct Shared {};

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int parts = o.fails() ? 0 : o.s.facts->parts;
    for (int at = index; at < parts; at += groups) {
      const int begin = o.parts[at];
      const IslandPart part = o.part[begin];
      SolveChunk chunk{};
      chunk.row = part.to, chunk.row_end = part.to + part.end - begin;
      chunk.step = part.to, chunk.step_end = part.to + cutIntoSteps(group, part.to, part.end - begin);
      if (part.bits >= 0) chunk.point = part.point, chunk.point_end = part.point + part.points;
      chunk.phase = part.phase;
      group.each([&](int lane) {
        if (lane == 0) o.chunks[part.chunk] = chunk;
      });
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
      const IslandPart part = o.part[o.part_at[k]];
      group.each([&](int lane) {
        if (lane == 0) fill(k, i, {count, more});
        for (int e = lane; e < count; e += Group::kLanes) {
          const int from = o.reach.first[i] + e, f = o.reach.point[from], of_island = o.number[f] - 1,
                    number = o.numberIn(part, f);
          const double w = o.reach.weight[from];
          const int at = e < kPlaces ? placeOf(k, e) : more + e - kPlaces;
          point[at] = number;
          weight[at] = w;
          push[at] = w * m.inverse_mass[f];
          o.free_points[free_point + of_island] = f;
          if (part.bits >= 0)
            o.chunk_points[part.point + number] = {f, (o.bits[part.fresh + of_island / 32] >> of_island % 32 & 1) != 0};
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
