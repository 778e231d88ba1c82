#pragma once
/// Work that is spread unevenly over rows, dealt out evenly to lanes: sums of the rows' shares say of each piece of
/// work to which row it belongs (Wong 2014, section 5.3.4: workload distribution).

#include "gpu/device/list.hpp"

namespace gambeson::gpu {

/// sum[r]: pieces of all rows before r; sum[rows]: all of them.
struct Shares {
  const Count* sum;
  int rows;

  /// The row of piece t, known to be one of [from, to].
  GAMBESON_HD int rowOf(Count t, int from, int to) const { return rowAmong(sum, t, from, to); }
  GAMBESON_HD static int rowAmong(const Count* sum, Count t, int from, int to) {
    while (from < to) {
      const int middle = from + (to - from + 1) / 2;
      if (sum[middle] <= t)
        from = middle;
      else
        to = middle - 1;
    }
    return from;
  }
};

/// Groups take some hundred pieces at a time. The first and the last are sought among all rows, the others between
/// these, in a copy in shared memory where it has the room.
///
/// Work: `piece(group, shared, on, row, place, kept)` for a piece a lane, its place in its row, and
/// `end(group, shared, kept)` when a group has had its last; `kept` is a number of the group's own, 0 before.
template <class Work>
struct DealOut {
  static constexpr int kResident = Work::kResident;
  static constexpr int kCopied = 256, kLeast = 64, kMost = 1024;

  struct Shared {
    Count sum[kCopied];
    typename Work::Shared own;
  };

  Shares shares;
  Work work;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    const Count total = shares.sum[shares.rows];
    const Count even = total / static_cast<Count>(4 * groups);
    const Count chunk = even < kLeast ? kLeast : even > kMost ? kMost : even / 32 * 32;
    int kept = 0;
    for (Count first = static_cast<Count>(index) * chunk; first < total; first += static_cast<Count>(groups) * chunk)
      take(group, shared, first, first + chunk < total ? first + chunk : total, kept);
    work.end(group, shared.own, kept);
  }

 private:
  template <class Group>
  GAMBESON_HD void take(const Group& group, Shared& shared, Count first, Count end, int& kept) const {
    typename Group::template PerLane<bool> on;
    typename Group::template PerLane<int> row;
    typename Group::template PerLane<Count> place;
    const int from = shares.rowOf(first, 0, shares.rows - 1), to = shares.rowOf(end - 1, from, shares.rows - 1);
    const bool copied = to - from < kCopied;
    group.sync();
    group.each([&](int lane) {
      for (int k = lane; copied && k <= to - from; k += Group::kLanes) shared.sum[k] = shares.sum[from + k];
    });
    group.sync();
    for (Count next = first; next < end; next += Group::kLanes) {
      group.each([&](int lane) {
        const Count t = next + static_cast<Count>(lane);
        on[lane] = t < end;
        if (!on[lane]) return;
        if (copied) {
          const int k = Shares::rowAmong(shared.sum, t, 0, to - from);
          row[lane] = from + k;
          place[lane] = t - shared.sum[k];
        } else {
          row[lane] = shares.rowOf(t, from, to);
          place[lane] = t - shares.sum[row[lane]];
        }
      });
      work.piece(group, shared.own, on, row, place, kept);
    }
  }
};

}  // namespace gambeson::gpu
