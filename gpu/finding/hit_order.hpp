#pragma once
/// Hits sorted by pair, without a number that the host would have to wait for: each first primitive has counted its
/// hits; sums of the counts say where they begin, and each hit counts which of the same first primitive come before it.

#include "gpu/finding/narrow.hpp"

namespace gambeson::gpu {

/// Hits of one first primitive together, in the order in which they were found.
struct PlaceHits {
  const int* begin;  ///< of the hits of each first primitive
  List<Hit> placed;

  GAMBESON_HD void operator()(const FoundHit& found, Count) const {
    // Hits that the list had no room for have been counted as well.
    const Count at = static_cast<Count>(begin[found.hit.pair.first] + found.place);
    if (at < placed.room) placed.items[at] = found.hit;
  }
};

struct RankHits {
  const int* begin;
  const int* of_first;
  const Hit* placed;
  List<Hit> sorted;

  GAMBESON_HD void operator()(const Hit& hit, Count) const {
    const Count from = static_cast<Count>(begin[hit.pair.first]);
    const Count end = std::min(from + static_cast<Count>(of_first[hit.pair.first]), sorted.room);
    Count at = from;
    for (Count k = from; k < end; ++k) at += placed[k].pair.second < hit.pair.second;
    if (at < sorted.room) sorted.items[at] = hit;
  }
};

}  // namespace gambeson::gpu
