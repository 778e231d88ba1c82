#pragma once
/// The colours of the rows of a part of an island, and their order by them, on a device: what colourChunk of
/// core/contact/row_order.cpp does.

#include "gpu/step/island_order.hpp"

namespace gambeson::gpu {

/// Gives rows of a part, by a group, the first colour that no row before has at any of the row's points; what finds all
/// taken one of its own. A lane has a row: which rows of the others come before it at its points is found side by side,
/// so that in turn each has only to tell the others its colour. Nearly all find one of the first 64, whose bits lie in
/// shared memory, by the numbers of the points. These numbers are fetched first, by all lanes for a row after the other,
/// so that no lane waits for each of its own.
template <class Group>
struct ColourRows {
  static constexpr int kResident = 16, kStaged = 48, kPoints = 744, kFirst = 2;
  struct Shared {
    std::uint32_t first[kFirst][kPoints], rows[kPoints];
    std::uint16_t point[kStaged][34];  ///< of rows, each a column; 34: lanes that write a row's find different banks
  };

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const int parts = o.fails() ? 0 : o.s.facts->parts;
    for (int at = index; at < parts; at += groups) {
      const int begin = o.parts[at];
      const IslandPart part = o.part[begin];
      group.each([&](int lane) {
        for (int p = lane; p < part.points && p < kPoints; p += Group::kLanes)
          shared.first[0][p] = shared.first[1][p] = shared.rows[p] = 0;
      });
      group.sync();
      int more = kColours;
      for (int k = begin; k < part.end; k += Group::kLanes)
        colour(group, shared, part, k, part.end - k < Group::kLanes ? part.end - k : Group::kLanes, more);
    }
  }

 private:
  using Bits = typename Group::template PerLane<std::uint32_t>;

  GAMBESON_HD std::uint32_t& taken(int f, int word) const {
    return o.taken[static_cast<std::ptrdiff_t>(kColourWords) * f + word];
  }
  GAMBESON_HD static bool numbered(const IslandPart& part) { return part.points <= kPoints; }
  /// visit(first and second word of the colours at the point, rows of the group at it) for each point of a row.
  template <class Visit>
  GAMBESON_HD void eachPoint(Shared& shared, const IslandPart& part, int lane, int i, const Visit& visit) const {
    const int count = o.reach.count[i];
    const int* const points = o.pointsOf(i);
    if (!numbered(part)) {
      for (int e = 0; e < count; ++e) {
        const int p = o.slotIn(part, points[e]);
        visit(taken(p, 0), taken(p, 1), o.rows_at[p]);
      }
      return;
    }
    constexpr int kAtOnce = 6;  // so that loads do not wait for each other
    static_assert(kStaged % kAtOnce == 0);
    for (int from = 0; from < count && from < kStaged; from += kAtOnce) {
      int p[kAtOnce];
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int j = 0; j < kAtOnce; ++j) p[j] = from + j < count ? shared.point[from + j][lane] : -1;
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
      for (int j = 0; j < kAtOnce; ++j)
        if (p[j] >= 0) visit(shared.first[0][p[j]], shared.first[1][p[j]], shared.rows[p[j]]);
    }
    for (int e = kStaged; e < count; ++e) {
      const int p = o.numberIn(part, points[e]);
      visit(shared.first[0][p], shared.first[1][p], shared.rows[p]);
    }
  }
  /// The numbers of the points of n rows from place k on.
  GAMBESON_HD void stage(const Group& group, Shared& shared, const IslandPart& part, int k, int n) const {
    constexpr int kAtOnce = 16;
    typename Group::template PerLane<int> first(0), count(0);
    typename Group::template PerLane<bool> longer(false);
    group.each([&](int lane) {
      if (lane >= n) return;
      const int i = o.ordered[k + lane];
      first[lane] = o.reach.first[i], count[lane] = o.reach.count[i];
    });
    for (int e0 = 0; e0 < kStaged; e0 += Group::kLanes) {
      group.each([&](int lane) { longer[lane] = count[lane] > e0; });
      if (group.ballot(longer) == 0) break;
      for (int r0 = 0; r0 < n; r0 += kAtOnce)
        group.each([&](int lane) {
          const int e = e0 + lane;
          int number[kAtOnce];
#ifdef __CUDA_ARCH__
#pragma unroll
#endif
          for (int j = 0; j < kAtOnce; ++j) {
            const int r = r0 + j < n ? r0 + j : 0, from = group.of(first, r), of_row = group.of(count, r);
            number[j] = e < of_row && e < kStaged ? o.numberIn(part, o.reach.point[from + e]) : -1;
          }
          for (int j = 0; j < kAtOnce; ++j)
            if (number[j] >= 0 && r0 + j < n) shared.point[e][r0 + j] = static_cast<std::uint16_t>(number[j]);
        });
    }
    group.sync();
  }

  /// The n rows from place k on.
  GAMBESON_HD void colour(const Group& group, Shared& shared, const IslandPart& part, int k, int n, int& more) const {
    if (numbered(part)) stage(group, shared, part, k, n);
    Bits all, second, before;  // colours that are taken, rows of the group that come before
    group.each([&](int lane) {
      if (lane >= n) return;
      eachPoint(shared, part, lane, o.ordered[k + lane],
                [&](std::uint32_t&, std::uint32_t&, std::uint32_t& rows) { fetchOr(&rows, std::uint32_t{1} << lane); });
    });
    group.sync();
    group.each([&](int lane) {
      all[lane] = second[lane] = before[lane] = 0;
      if (lane >= n) return;
      eachPoint(shared, part, lane, o.ordered[k + lane],
                [&](std::uint32_t& colours, std::uint32_t& more_colours, std::uint32_t& rows) {
                  all[lane] |= colours;
                  second[lane] |= more_colours;
                  before[lane] |= rows;
                });
    });
    typename Group::template PerLane<int> mine(0);
    for (int r = 0; r < n; ++r) {
      const std::uint32_t there = group.of(all, r), behind = group.of(second, r);
      const int colour = ~there != 0    ? firstClear(there)
                         : ~behind != 0 ? 32 + firstClear(behind)
                                        : laterColour(group, part, o.ordered[k + r], more);
      group.each([&](int lane) {
        if (lane == r) mine[lane] = colour;
        if (colour >= 32 * kFirst || (before[lane] >> r & 1) == 0) return;
        (colour < 32 ? all : second)[lane] |= std::uint32_t{1} << colour % 32;
      });
    }
    group.sync();
    group.each([&](int lane) {
      if (lane >= n) return;
      o.colour[k + lane] = mine[lane];
      eachPoint(shared, part, lane, o.ordered[k + lane],
                [&](std::uint32_t& colours, std::uint32_t& more_colours, std::uint32_t& rows) {
                  const std::uint32_t bit = std::uint32_t{1} << mine[lane] % 32;
                  if (mine[lane] < 32)
                    fetchOr(&colours, bit);
                  else if (mine[lane] < 32 * kFirst)
                    fetchOr(&more_colours, bit);
                  put(&rows, std::uint32_t{0});
                });
    });
    group.sync();
  }
  /// Of a row that finds the first ones taken.
  GAMBESON_HD int laterColour(const Group& group, const IslandPart& part, int i, int& more) const {
    const int* const points = o.pointsOf(i);
    const int count = o.reach.count[i];
    for (int w = kFirst; w < kColourWords; ++w) {
      Bits mine;
      group.each([&](int lane) {
        mine[lane] = 0;
        for (int e = lane; e < count; e += Group::kLanes) mine[lane] |= taken(o.slotIn(part, points[e]), w);
      });
      const std::uint32_t all = group.orOf(mine);
      if (~all == 0) continue;
      const int bit = firstClear(all);
      group.each([&](int lane) {
        for (int e = lane; e < count; e += Group::kLanes)
          taken(o.slotIn(part, points[e]), w) |= std::uint32_t{1} << bit;
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
    const int begin = o.part_of[k], mine = o.colour[k];
    const IslandPart& part = o.part[begin];
    int below = 0, same = 0;
    for (int b = begin; b < part.end; ++b) {
      const int other = o.colour[b];
      below += other < mine;
      same += other == mine && b < k;
    }
    const int at = part.to + below + same;
    o.order[at] = o.ordered[k];
    o.key[at] = same;
    o.part_at[at] = begin;
  }
};

}  // namespace gambeson::gpu
