#pragma once
/// Lists of fixed room that kernels append to, in no order.

#include "gpu/device/atomics.hpp"
#include "gpu/device/lanes.hpp"

namespace gambeson::gpu {

/// What has no room is counted and left out: a count above the room says that the list ran over.
template <class T>
struct List {
  T* items;
  Count* count;
  Count room;

  /// How many items stand in it.
  GAMBESON_HD Count size() const { return *count < room ? *count : room; }
};

/// Appends the items of the lanes that are `on`, with one atomic for the group.
template <class Group, class T>
GAMBESON_HD void append(const Group& group, const typename Group::template PerLane<bool>& on,
                        const typename Group::template PerLane<T>& item, const List<T>& list) {
  const LaneMask mask = group.ballot(on);
  if (mask == 0) return;
  const Count first = group.once([&] { return fetchAdd(list.count, static_cast<Count>(lanesIn(mask))); });
  group.each([&](int lane) {
    const Count at = first + static_cast<Count>(lanesBefore(mask, lane));
    if (on[lane] && at < list.room) list.items[at] = item[lane];
  });
}

/// Items that a group gathers in its shared memory, to be taken `kLanes` at a time or written in one go.
template <class T, int kRoom>
struct Gathered {
  T items[kRoom];

  /// Behind the `size` that are there; `size` grows.
  template <class Group>
  GAMBESON_HD void add(const Group& group, const typename Group::template PerLane<bool>& on,
                       const typename Group::template PerLane<T>& item, int& size) {
    const LaneMask mask = group.ballot(on);
    group.each([&](int lane) {
      if (on[lane]) items[size + lanesBefore(mask, lane)] = item[lane];
    });
    size += lanesIn(mask);
  }

  /// All `size` of them to a list.
  template <class Group>
  GAMBESON_HD void flush(const Group& group, int& size, const List<T>& list) const {
    group.sync();
    const Count first = group.once([&] { return fetchAdd(list.count, static_cast<Count>(size)); });
    group.each([&](int lane) {
      for (int k = lane; k < size; k += Group::kLanes)
        if (first + static_cast<Count>(k) < list.room) list.items[first + static_cast<Count>(k)] = items[k];
    });
    group.sync();
    size = 0;
  }
};

}  // namespace gambeson::gpu
