#pragma once
/// Points in an order in which the halves of all of them, the halves of these and so on lie together.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// The place of each point in the order: [first, end) of the places, to begin with all, has its lesser points along its
/// longest extent in [first, middleOf(first, end)), and so has each of these.
std::vector<int> halvedPlaces(std::span<const Vec3> x);

GAMBESON_HD constexpr int middleOf(int first, int end) { return first + (end - first) / 2; }

/// Items [begin, end) by their places: part of the items of all places as they are halved, until there are no more than
/// `most` or all have one place. The part that item `k` is in. `place(i)`: of an item, ascending; all below `places`.
template <class Place>
GAMBESON_HD void halveAround(int k, int places, int most, const Place& place, int& begin, int& end) {
  const int mine = place(k);
  for (int first = 0, last = places; end - begin > most && last - first > 1;) {
    const int middle = middleOf(first, last);
    int below = begin;  // the items of places before the middle end here
    for (int beyond = end; below < beyond;) {
      const int between = middleOf(below, beyond);
      if (place(between) < middle)
        below = between + 1;
      else
        beyond = between;
    }
    if (mine < middle)
      end = below, last = middle;
    else
      begin = below, first = middle;
  }
}

}  // namespace gambeson
