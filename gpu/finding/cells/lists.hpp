#pragma once
/// Triangles by cell: each (cell, triangle) once, sorted by cell; then each two of a cell are a test.

#include "gpu/finding/cells/frame.hpp"
#include "gpu/finding/cells/shares.hpp"
#include "gpu/finding/float_dop.hpp"
#include "gpu/finding/pair.hpp"

namespace gambeson::gpu {

constexpr std::uint32_t kNoCell = ~0u;

/// Which triangle covers which cell, appended in any order.
struct Registrations {
  std::uint32_t* cell;
  int* owner;
  Count* count;
  Count room;

  GAMBESON_HD int size() const { return static_cast<int>(*count < room ? *count : room); }

  template <class Group>
  GAMBESON_HD void append(const Group& group, const typename Group::template PerLane<bool>& on,
                          const typename Group::template PerLane<std::uint32_t>& in,
                          const typename Group::template PerLane<int>& of) const {
    const LaneMask mask = group.ballot(on);
    if (mask == 0) return;
    const Count first = group.once([&] { return fetchAdd(count, static_cast<Count>(lanesIn(mask))); });
    group.each([&](int lane) {
      const Count at = first + static_cast<Count>(lanesBefore(mask, lane));
      if (!on[lane] || at >= room) return;
      cell[at] = in[lane];
      owner[at] = of[lane];
    });
  }
};

struct NoCell {
  std::uint32_t* cell;
  GAMBESON_HD void operator()(int i) const { cell[i] = kNoCell; }
};

/// The number of tests of a registration: with all behind it in its cell.
struct CountTests {
  Registrations sorted;
  Count* tests;

  GAMBESON_HD void operator()(int i) const {
    const int n = sorted.size();
    tests[i] = 0;
    if (i >= n) return;
    int from = i, to = n;  // the first of another cell
    while (to - from > 1) {
      const int middle = from + (to - from) / 2;
      (sorted.cell[middle] == sorted.cell[i] ? from : to) = middle;
    }
    tests[i] = static_cast<Count>(from - i);
  }
};

/// Two triangles of a cell: those that are tested here and not in another cell, are not both of bodies, and whose boxes
/// meet, and their polytopes where there are any. Rule: `testedIn(cell, a, b)`, true in one common cell of both.
template <class Rule, bool kTallied>
struct PairsInCells {
  static constexpr int kResident = 40;
  static constexpr int kGathered = 128;
  struct Shared {
    Gathered<Pair, kGathered> found;
  };

  Registrations sorted;
  Rule rule;
  const Owner* owner;
  int cloth_vertices;
  const FloatBox* box;
  const FloatDop* dop;  ///< null: none
  List<Pair> pairs;
  Count* tally;  ///< boxes that have been compared

  template <class Group>
  GAMBESON_HD void piece(const Group& group, Shared& shared, const typename Group::template PerLane<bool>& on,
                         const typename Group::template PerLane<int>& row,
                         const typename Group::template PerLane<Count>& place, int& found) const {
    typename Group::template PerLane<bool> here, meets;
    typename Group::template PerLane<Pair> pair;
    group.each([&](int lane) {
      here[lane] = meets[lane] = false;
      if (!on[lane]) return;
      const int a = sorted.owner[row[lane]], b = sorted.owner[row[lane] + 1 + static_cast<int>(place[lane])];
      if (!rule.testedIn(sorted.cell[row[lane]], a, b)) return;
      here[lane] = true;
      if (!meet(box[a], box[b]) || (ofBody(a) && ofBody(b))) return;
      meets[lane] = dop == nullptr || meet(dop[a], dop[b]);
      pair[lane] = {a, b};
    });
    if constexpr (kTallied) {
      const int tested = lanesIn(group.ballot(here));
      group.once([&] { return fetchAdd(tally, static_cast<Count>(tested)); });
    }
    shared.found.add(group, meets, pair, found);
    if (found > kGathered - Group::kLanes) shared.found.flush(group, found, pairs);
  }
  template <class Group>
  GAMBESON_HD void end(const Group& group, Shared& shared, int& found) const {
    if (found > 0) shared.found.flush(group, found, pairs);
  }

 private:
  GAMBESON_HD bool ofBody(int i) const { return owner[i].corner[0] >= cloth_vertices; }
};

}  // namespace gambeson::gpu
