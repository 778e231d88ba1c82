#pragma once
/// Core's lists of a contact solve, flat, as they go to a device.

#include "gpu/solve/solve_data.hpp"

namespace gambeson::gpu {

struct FlatSolve {
  std::vector<SolveIsland> islands;
  std::vector<int> by_size, steps, point, free;
  std::vector<ChunkPoint> chunk_points;
  std::vector<SolveChunk> chunks;
  std::vector<double> facts, state;  ///< RowFacts, RowState
  std::vector<RowEntries> entries;
  std::vector<double> own, slope, weight, push;
  std::vector<Vec3> moved, moved_before;
  int small = 0;  ///< islands of one chunk come last in `by_size`, from here on
};

/// work.hold must be null.
FlatSolve flatSolve(const ContactWork& work);

}  // namespace gambeson::gpu
