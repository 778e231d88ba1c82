#pragma once
/// What a contact solve is on a device: core's lists (ContactWork), flat.

#include "gpu/device/quads.hpp"

namespace gambeson::gpu {

using SolveIsland = ContactWork::Island;
/// Whether it has several chunks.
GAMBESON_HD inline bool isLarge(const SolveIsland& island) { return island.chunk_end - island.chunk > 1; }

/// A chunk of an island: its rows, steps and points. Entries of its rows number points within the chunk. A step has at
/// most kSumLanes rows of one colour, which are taken side by side.
struct SolveChunk {
  int row, row_end, step, step_end, point, point_end, phase;
};

/// A point of a chunk; whether no chunk of the island has it before.
struct ChunkPoint {
  int point;
  bool first;
};

/// An island of several chunks, and how many of them are in one phase at most.
struct LargeIsland {
  int island, most_of_phase;
};

/// Numbers of rows: of eight rows side by side, number after number, so that the quads of a warp read what lies
/// together.
constexpr int kRowBlock = 8;
GAMBESON_HD constexpr int inRowBlocks(int rows) { return (rows + kRowBlock - 1) / kRowBlock * kRowBlock; }
template <int kNumbers>
struct PackedRow {
  int first;
  GAMBESON_HD explicit PackedRow(int row) : first(row / kRowBlock * kRowBlock * kNumbers + row % kRowBlock) {}
  GAMBESON_HD double at(const double* packed, int number) const { return packed[first + kRowBlock * number]; }
  GAMBESON_HD Vec3 vecAt(const double* packed, int number) const {
    return {at(packed, number), at(packed, number + 1), at(packed, number + 2)};
  }
  GAMBESON_HD void put(double* packed, int number, double x) const { packed[first + kRowBlock * number] = x; }
  GAMBESON_HD void put(double* packed, int number, const Vec3& x) const {
    put(packed, number, x.x), put(packed, number + 1, x.y), put(packed, number + 2, x.z);
  }
};

struct RowFacts {
  static constexpr int kNumbers = 10;
  Vec3 normal, drift;
  double friction, drag, compliance, area;

  GAMBESON_HD static RowFacts of(const double* packed, int row) {
    const PackedRow<kNumbers> r(row);
    return {r.vecAt(packed, 0), r.vecAt(packed, 3), r.at(packed, 6), r.at(packed, 7), r.at(packed, 8), r.at(packed, 9)};
  }
  GAMBESON_HD void put(double* packed, int row) const {
    const PackedRow<kNumbers> r(row);
    r.put(packed, 0, normal), r.put(packed, 3, drift), r.put(packed, 6, friction);
    r.put(packed, 7, drag), r.put(packed, 8, compliance), r.put(packed, 9, area);
  }
};
struct RowState {
  static constexpr int kNumbers = 6;
  Vec3 now, before;  ///< tractions, a sweep ago

  GAMBESON_HD static RowState of(const double* packed, int row) {
    const PackedRow<kNumbers> r(row);
    return {r.vecAt(packed, 0), r.vecAt(packed, 3)};
  }
  GAMBESON_HD void put(double* packed, int row) const {
    const PackedRow<kNumbers> r(row);
    r.put(packed, 0, now), r.put(packed, 3, before);
  }
};
/// What goes with the caution of the island: stepBound, and one over that.
struct RowPace {
  static constexpr int kNumbers = 2;
  double bound, length;

  GAMBESON_HD static RowPace of(const double* packed, int row) {
    const PackedRow<kNumbers> r(row);
    return {r.at(packed, 0), r.at(packed, 1)};
  }
  GAMBESON_HD void put(double* packed, int row) const {
    const PackedRow<kNumbers> r(row);
    r.put(packed, 0, bound), r.put(packed, 1, length);
  }
};

/// Entries of a row that a lane of its quad loads before the row's turn comes. They stand at fixed places, kPlaces to a
/// row, so that no load waits for another; a row with more has the others at `more`, one with fewer has the first point
/// of the chunk with a weight and a push of 0 in their place.
constexpr int kKept = 5, kPlaces = kKept * kQuad;
struct RowEntries {
  int count, more;  ///< all of them; where the others begin
};
/// Likewise by eight rows.
GAMBESON_HD inline int placeOf(int row, int entry) {
  return row / kRowBlock * kRowBlock * kPlaces + (entry / kQuad * kRowBlock + row % kRowBlock) * kQuad + entry % kQuad;
}

/// Arrays on the device. What is iterated on is read where it starts from and left in `..._now`; a run may be repeated.
struct SolveData {
  const SolveIsland* islands;
  SolveIsland* islands_now;
  const SolveChunk* chunks;
  const int* steps;  ///< first rows
  // Of rows.
  const double* facts;  ///< RowFacts
  const double *own, *slope;
  const RowEntries* entries;
  const double* state;  ///< RowState
  double* state_now;
  double* pace;  ///< RowPace
  // Entries, at their places and then the others: a point of the chunk, its weight, and what an impulse does to it.
  const int* point;
  const double *weight, *push;
  const int* free;  ///< of the points of islands, those of an island together: where they stand in the arrays below
  const ChunkPoint* chunk_points;  ///< of chunks, likewise
  const Vec3 *moved, *moved_before;
  Vec3 *moved_now, *moved_before_now;
  // Of chunks, of a sweep and of the one before.
  double *largest2, *against;
  Vec3 *spilled, *spilled_before;  ///< of points of islands and of chunks, where shared memory has no room
};

}  // namespace gambeson::gpu
