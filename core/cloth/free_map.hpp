#pragma once
/// From the points that move freely to all points of a cloth.

#include <vector>

#include "core/math/sparse.hpp"

namespace gambeson {

/// q = T p, positions only: points that seams join are one, and points that others determine are combinations of
/// these. Rows sum to 1.
struct FreeMap {
  SparseRows T;           ///< points x free points
  SparseRows Tt;          ///< its transpose
  std::vector<int> home;  ///< of each free point: the point that it is
};

}  // namespace gambeson
