#pragma once
/// The parts of islands that become chunks, on a device: what cutIsland of core/contact/row_order.cpp does. The points
/// of parts are bits, of each part in a row of words, with as many rows more for the phases and one for what chunks
/// have so far; points are numbered within their islands already.

#include "core/contact/halving.hpp"
#include "gpu/step/island_order.hpp"

namespace gambeson::gpu {

/// Of places: the part that each is in.
struct CutIslands {
  SolveModel m;
  IslandOrder o;
  GAMBESON_HD void operator()(int k) const {
    if (k >= o.s.facts->rows || o.fails()) return;
    const int q = o.island[o.ordered[k]];
    int begin = o.islands[q].row, end = o.islands[q].row_end;
    if (m.places > 0)
      halveAround(
          k, m.places, kWholeIsland, [&](int at) { return m.place[o.s.rows.stencil[o.ordered[at]].sample[0]]; }, begin,
          end);
    o.part_of[k] = begin;
    if (k != begin) return;
    o.parts[fetchAdd(&o.s.facts->parts, 1)] = k;
    o.part[k] = {q, end, k, q, 0, -1, fetchAdd(&o.island_parts[q], 1), 0, o.island_points[q]};
  }
};

/// Whether there are islands of several parts.
struct AnyLarge {
  const SolveFacts* facts;
  GAMBESON_HD bool operator()() const { return facts->most_rows > kWholeIsland; }
};

/// Of islands: room for the bits of those that have several parts.
struct PlaceBits {
  IslandOrder o;
  GAMBESON_HD void operator()(int q) const {
    if (q >= o.s.facts->islands || o.island_parts[q] < 2) return;
    const int parts = o.island_parts[q], words = wordsOf(o.island_points[q]);
    o.island_bits[q] = static_cast<int>(fetchAdd(&o.s.facts->bits, static_cast<Count>(2 * parts + 1) * words));
    o.islands[q].chunk = o.s.facts->islands + fetchAdd(&o.s.facts->cut, parts);
    o.islands[q].chunk_end = o.islands[q].chunk + parts;
    o.large[fetchAdd(&o.s.facts->large, 1)] = {q, 0};
  }
  GAMBESON_HD static int wordsOf(int points) { return (points + 31) / 32; }
};
/// Of parts: where their bits begin. They have numbers from CutIslands in the place of `fresh`.
struct FindBits {
  IslandOrder o;
  GAMBESON_HD void operator()(int at) const {
    if (at >= o.s.facts->parts || o.fails()) return;
    IslandPart& part = o.part[o.parts[at]];
    if (o.island_parts[part.island] < 2) return;
    part.bits = o.island_bits[part.island] + part.fresh * PlaceBits::wordsOf(o.island_points[part.island]);
  }
};

struct ClearBits {
  IslandOrder o;
  GAMBESON_HD Count size() const { return o.fails() ? 0 : o.s.facts->bits; }
  GAMBESON_HD void operator()(int word) const { o.bits[word] = 0; }
};
/// The bits of the points of parts; a group takes a row.
template <class Group>
struct MarkPoints {
  static constexpr int kResident = 32;
  struct Shared {};

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int rows = o.fails() ? 0 : o.s.facts->rows;
    for (int k = index; k < rows; k += groups) {
      const int bits = o.part[o.part_of[k]].bits, i = o.ordered[k];
      if (bits < 0) continue;
      const int count = o.reach.count[i];
      group.each([&](int lane) {
        for (int e = lane; e < count; e += Group::kLanes) {
          const int n = o.number[o.pointsOf(i)[e]] - 1;
          fetchOr(&o.bits[bits + n / 32], std::uint32_t{1} << n % 32);
        }
      });
    }
  }
};
/// The numbers of points within parts; a group takes a part.
template <class Group>
struct CountBits {
  static constexpr int kResident = 32;
  struct Shared {};

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int parts = o.fails() ? 0 : o.s.facts->parts;
    for (int at = index; at < parts; at += groups) {
      IslandPart& part = o.part[o.parts[at]];
      const int bits = part.bits, words = PlaceBits::wordsOf(o.island_points[part.island]);
      if (bits < 0) continue;
      int points = 0;
      for (int first = 0; first < words; first += Group::kLanes) {
        typename Group::template PerLane<int> here;
        group.each([&](int lane) { here[lane] = first + lane < words ? lanesIn(o.bits[bits + first + lane]) : 0; });
        for (int lane = 0; lane < Group::kLanes && first + lane < words; ++lane) {
          const int more = group.of(here, lane);
          group.each([&](int l) {
            if (l == lane) o.before[bits + first + lane] = points;
          });
          points += more;
        }
      }
      const int point = group.once([&] { return fetchAdd(&o.s.facts->chunk_points, points); });
      group.each([&](int lane) {
        if (lane == 0) part.point = point, part.points = points;
        for (int p = point + lane; p < point + points; p += Group::kLanes) {
          o.rows_at[p] = 0;
          for (int w = 0; w < kColourWords; ++w) o.taken[static_cast<std::ptrdiff_t>(kColourWords) * p + w] = 0;
        }
      });
      group.sync();
    }
  }
};

/// Before a launch of sweeps.
struct ClearArrived {
  int* arrived;
  GAMBESON_HD void operator()(int i) const { arrived[i] = 0; }
};

/// The phases of the parts of an island, by a group, and their order by them.
template <class Group>
struct PhaseParts {
  static constexpr int kResident = 16;
  struct Shared {};

  IslandOrder o;
  GAMBESON_HD void operator()(const Group& group, Shared&, int index, int groups) const {
    const int large = o.fails() ? 0 : o.s.facts->large;
    for (int l = index; l < large; l += groups) {
      const int q = o.large[l].island, begin = o.islands[q].row, end = o.islands[q].row_end;
      const int words = PlaceBits::wordsOf(o.island_points[q]), parts = o.island_parts[q];
      std::uint32_t* const more_rows = o.bits + o.island_bits[q] + parts * words;
      int more = kColours, phases = 0;
      for (int first = begin; first < end; first = o.part[first].end) {
        const int phase = phaseOf(group, o.bits + o.part[first].bits, more_rows, words, more);
        group.each([&](int lane) {
          if (lane == 0) o.part[first].phase = phase;
        });
        phases = phase < phases ? phases : phase + 1;
        group.sync();
      }
      const int most = sort(group, q, phases, words);
      group.each([&](int lane) {
        if (lane == 0) o.large[l].most_of_phase = most;
      });
    }
  }

 private:
  /// The first whose parts share no point with this one, `taken` their bits phase by phase; `more`, which goes up,
  /// where there is none.
  GAMBESON_HD int phaseOf(const Group& group, const std::uint32_t* bits, std::uint32_t* taken, int words,
                          int& more) const {
    for (int phase = 0; phase < kColours; ++phase, taken += words) {
      typename Group::template PerLane<std::uint32_t> shared;
      group.each([&](int lane) {
        shared[lane] = 0;
        for (int w = lane; w < words; w += Group::kLanes) shared[lane] |= bits[w] & taken[w];
      });
      if (group.orOf(shared) != 0) continue;
      group.each([&](int lane) {
        for (int w = lane; w < words; w += Group::kLanes) taken[w] |= bits[w];
      });
      return phase;
    }
    return more++;
  }
  /// Sorts the parts by phases, with the points that they are the first to have; the most parts of a phase.
  GAMBESON_HD int sort(const Group& group, int q, int phases, int words) const {
    const SolveIsland island = o.islands[q];
    const int parts = o.island_parts[q], rows = o.island_bits[q] + parts * words;
    std::uint32_t* const had = o.bits + rows + parts * words;
    int to = island.row, number = 0, most = 0;
    for (int phase = 0; phase < phases; ++phase) {
      const int of_phase = number;
      for (int first = island.row; first < island.row_end; first = o.part[first].end) {
        IslandPart& part = o.part[first];
        if (part.phase != phase) continue;
        const int fresh = rows + number * words, chunk = island.chunk + number;
        group.each([&](int lane) {
          for (int w = lane; w < words; w += Group::kLanes) {
            const std::uint32_t bits = o.bits[part.bits + w];
            o.bits[fresh + w] = bits & ~had[w];
            had[w] |= bits;
          }
          if (lane == 0) part.to = to, part.chunk = chunk, part.fresh = fresh;
        });
        to += part.end - first;
        ++number;
      }
      most = number - of_phase > most ? number - of_phase : most;
    }
    return most;
  }
};

}  // namespace gambeson::gpu
