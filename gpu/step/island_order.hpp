#pragma once
/// Islands of rows and their order, as arrays on a device.

#include "core/contact/row_order.hpp"
#include "gpu/step/solve_rows.hpp"

namespace gambeson::gpu {

constexpr int kColourWords = kColours / 32;

/// What rows move: entries of each row from its `first` on.
struct RowReach {
  int *first, *count;
  int* point;
  double* weight;
  Count room;  ///< for the entries of all rows
};

/// Rows that become a chunk: a whole island, or a part of a large one. Kept at the place of the first of them.
struct IslandPart {
  int island, end;   ///< end: the place behind the last of them
  int to;            ///< where they begin in the order of the iteration
  int chunk, phase;  ///< which they become
  int bits, fresh;   ///< where bits of its points begin, and of those that no chunk before has; -1: a whole island
  int point;         ///< where its points begin among those of chunks
  int points;        ///< how many it has
};

struct IslandOrder {
  SolveRows s;
  RowReach reach;
  // Of rows.
  double* own;  ///< what the row's own impulse does to it, over its area; drift: of what nothing of the points does
  Vec3* drift;
  int *island, *rank, *kept_island;  ///< of a row; -1: none
  // Of places: rows of an island together.
  Count* position;  ///< in an island, by what comes first
  int *ordered, *colour, *key, *order;
  int *part_of, *part_at;  ///< where the part begins that a place of `ordered`, of `order` is in
  IslandPart* part;        ///< at the place where it begins
  int* parts;              ///< all such places
  // Of points.
  int *tied, *size;  ///< size: of a root rows, then the island's number
  int* number;       ///< in its island, from 1 on
  int* free_points;
  // Of points, and behind them of those of chunks that are not whole islands.
  std::uint32_t *taken, *rows_at;  ///< rows_at: of a group that colours, 0 before and after
  ChunkPoint* chunk_points;
  // Words of bits, one for each point of an island in a row for each of its parts.
  std::uint32_t* bits;
  int* before;  ///< how many bits of the row are set in words before
  Count bits_room;
  // Of islands.
  int *root, *island_points, *island_parts, *island_bits;
  LargeIsland* large;
  SolveIsland *islands, *kept_islands;
  SolveChunk* chunks;
  int* steps;

  /// Whether there is no room: nothing is ordered then, and nothing solved.
  GAMBESON_HD bool fails() const { return s.facts->reach > reach.room || s.facts->bits > bits_room; }
  GAMBESON_HD const int* pointsOf(int i) const { return reach.point + reach.first[i]; }
  /// The number of a point of a part in it.
  GAMBESON_HD int numberIn(const IslandPart& of, int f) const {
    const int n = number[f] - 1;
    if (of.bits < 0) return n;
    const int word = of.bits + n / 32;
    return before[word] + lanesBefore(bits[word], n % 32);
  }
  /// Where it has what each part has of its points.
  GAMBESON_HD int slotIn(const IslandPart& of, int f) const { return of.bits < 0 ? f : of.point + numberIn(of, f); }
};

/// All rows by the sample that they begin with, then as they come.
struct RowsInOrder {
  const int *listed, *begin;  ///< lists; where those of this sort begin
  GAMBESON_HD int operator[](int p) const { return listed[*begin + p] / kPartsOfRow; }
};

}  // namespace gambeson::gpu
