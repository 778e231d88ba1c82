#pragma once
/// The colours of the rows of a part of an island, and their order by them, on a device: what colourChunk of
/// core/contact/row_order.cpp does.

#include "gpu/step/island_order.hpp"

namespace gambeson::gpu {

/// Gives rows of a part, by a group, the first colour that no row before has at any of the row's points; what finds all
/// taken one of its own. A lane has a row: which rows of the others come before it at its points is found side by side,
/// so that in turn each has only to tell the others its colour. Nearly all find one of the first 32, whose bits lie in
/// shared memory, by the numbers of the points.
template <class Group>
struct ColourRows {
  static constexpr int kResident = 16, kStaged = 16, kPoints = 1152;
  struct Shared {
    std::uint32_t first[kPoints], rows[kPoints];
    int point[kStaged][32];
  };

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const int parts = o.fails() ? 0 : o.s.facts->parts;
    for (int at = index; at < parts; at += groups) {
      const int begin = o.parts[at];
      const IslandPart part = o.part[begin];
      group.each([&](int lane) {
        for (int p = lane; p < part.points && p < kPoints; p += Group::kLanes) shared.first[p] = shared.rows[p] = 0;
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
  /// visit(colours at the point, rows of the group at it) for each point of a row.
  template <class Visit>
  GAMBESON_HD void eachPoint(Shared& shared, const IslandPart& part, int lane, int i, bool staged,
                             const Visit& visit) const {
    const int count = o.reach.count[i];
    const bool numbered = part.points <= kPoints;
    const int* const points = o.pointsOf(i);
    for (int e = 0; e < count; ++e) {
      const bool stands = e < kStaged;
      const int p = staged && stands ? shared.point[e][lane]
                    : numbered       ? o.numberIn(part, points[e])
                                     : o.slotIn(part, points[e]);
      if (!staged && stands) shared.point[e][lane] = p;
      if (numbered)
        visit(shared.first[p], shared.rows[p]);
      else
        visit(taken(p, 0), o.rows_at[p]);
    }
  }

  /// The n rows from place k on.
  GAMBESON_HD void colour(const Group& group, Shared& shared, const IslandPart& part, int k, int n, int& more) const {
    Bits all, before;  // colours that are taken, rows of the group that come before
    group.each([&](int lane) {
      if (lane >= n) return;
      eachPoint(shared, part, lane, o.ordered[k + lane], false,
                [&](std::uint32_t&, std::uint32_t& rows) { fetchOr(&rows, std::uint32_t{1} << lane); });
    });
    group.sync();
    group.each([&](int lane) {
      all[lane] = before[lane] = 0;
      if (lane >= n) return;
      eachPoint(shared, part, lane, o.ordered[k + lane], true, [&](std::uint32_t& colours, std::uint32_t& rows) {
        all[lane] |= colours;
        before[lane] |= rows;
      });
    });
    typename Group::template PerLane<int> mine(0);
    for (int r = 0; r < n; ++r) {
      const std::uint32_t there = group.of(all, r);
      const int colour = ~there != 0 ? firstClear(there) : laterColour(group, part, o.ordered[k + r], more);
      group.each([&](int lane) {
        if (lane == r) mine[lane] = colour;
        if (colour < 32 && (before[lane] >> r & 1) != 0) all[lane] |= std::uint32_t{1} << colour;
      });
    }
    group.sync();
    group.each([&](int lane) {
      if (lane >= n) return;
      o.colour[k + lane] = mine[lane];
      eachPoint(shared, part, lane, o.ordered[k + lane], true, [&](std::uint32_t& colours, std::uint32_t& rows) {
        if (mine[lane] < 32) fetchOr(&colours, std::uint32_t{1} << mine[lane]);
        put(&rows, std::uint32_t{0});
      });
    });
    group.sync();
  }
  /// Of a row that finds the first ones taken.
  GAMBESON_HD int laterColour(const Group& group, const IslandPart& part, int i, int& more) const {
    const int* const points = o.pointsOf(i);
    const int count = o.reach.count[i];
    for (int w = 1; w < kColourWords; ++w) {
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
