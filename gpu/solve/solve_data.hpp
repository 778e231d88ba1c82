#pragma once
/// What a contact solve is on a device: core's lists (ContactWork), flat.

#include "gpu/device/quads.hpp"

namespace gambeson::gpu {

using SolveIsland = ContactWork::Island;

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

/// Of a row, in pieces of 16 bytes.
struct alignas(16) RowFacts {
  Vec3 normal, drift;
  double friction, drag, compliance, area;
};
struct alignas(16) RowState {
  Vec3 now, before;  ///< tractions, a sweep ago
};
/// What goes with the caution of the island: stepBound, and one over that.
struct alignas(16) RowPace {
  double bound, length;
};

/// Entries of a row that a lane of its quad loads before the row's turn comes. They stand at fixed places, kPlaces to a
/// row, so that no load waits for another; a row with more has the others at `more`.
constexpr int kKept = 5, kPlaces = kKept * kQuad;
struct RowEntries {
  int count, more;  ///< all of them; where the others begin
};

/// Arrays on the device. What is iterated on is read where it starts from and left in `..._now`; a run may be repeated.
struct SolveData {
  const SolveIsland* islands;
  SolveIsland* islands_now;
  const SolveChunk* chunks;
  const int* steps;  ///< first rows
  // Of rows.
  const RowFacts* facts;
  const double *own, *slope;
  const RowEntries* entries;
  const RowState* state;
  RowState* state_now;
  RowPace* pace;
  // Entries, at their places and then the others: a point of the chunk, its weight, and what an impulse does to it.
  const int* point;
  const double *weight, *push;
  // Of the points of all islands; `chunk_points` lists those of the chunks.
  const ChunkPoint* chunk_points;
  const Vec3 *moved, *moved_before;
  Vec3 *moved_now, *moved_before_now;
  // Of chunks, of a sweep and of the one before.
  double *largest2, *against;
  Vec3* spilled;  ///< of points in chunks, where shared memory has no room
};

}  // namespace gambeson::gpu
