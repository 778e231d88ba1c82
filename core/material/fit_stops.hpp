#pragma once
/// From a raw loop of moment over curvature, as an instrument draws it, to a sum of stops.

#include <vector>

#include "core/material/hysteresis.hpp"
#include "core/material/laws/hysteresis_bending.hpp"

namespace gambeson {

/// A point of a measured loop: curvature [1/m] and moment per width [N], in the order of measurement.
struct LoopSample {
  double curvature_per_m = 0, moment_N = 0;
};

struct LoopFit {
  Stops<kStops> stops;
  int branches = 0;        ///< ways from turn to turn that were used
  int points = 0;          ///< of these
  double rms_N = 0;        ///< what the stops miss of the moments on these ways
  double largest_N = 0;    ///< the same, at most
  double amplitude_N = 0;  ///< half of the largest way of the moment, what these are small against
};

/// Masing's rule: from a turn (k0, m0) on, a way is the virgin curve doubled, (m - m0)/2 = virgin((k - k0)/2). So every
/// way between two turns that is at least half as long as the longest gives points of the virgin curve, which is
///   m = b2 k + sum_j w_j min(k, r_j),   b2, w_j >= 0,
/// with r_j of a fine grid and w_j by least squares (nonNegativeLeastSquares); neighbours are put together at their
/// centroid until 8 are left, those first whose merging bends the curve least. The way before the first turn and that
/// behind the last are left out: their starts are no turns. Shifts of either zero cancel. Throws InputError (reason
/// only) where there are fewer than three ways' worth of points, a number is not finite or the loop encloses nothing.
LoopFit fitStops(const std::vector<LoopSample>& loop);

/// x >= 0 that makes |A x - b| least (Lawson and Hanson 1974, chapter 23). A has `columns` columns, one after another.
std::vector<double> nonNegativeLeastSquares(const std::vector<double>& A, const std::vector<double>& b, int columns);

}  // namespace gambeson
