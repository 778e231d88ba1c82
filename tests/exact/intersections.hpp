#pragma once
/// Which triangles of a mesh intersect: the exact predicates of CGAL, the reference for what the project's own
/// detection says and for what a simulation may leave behind. Shares nothing with core/contact: other predicates, other
/// search, no ties broken (what touches, intersects).

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson::exact {

/// Triangles a < b, with 0 to 3 vertices (by number) in common.
struct IntersectingPair {
  int a = 0, b = 0, shared = 0;
  bool operator==(const IntersectingPair&) const = default;
};

struct Intersections {
  std::vector<IntersectingPair> pairs;  ///< sorted
  /// Of cloth on both sides of a sewn seam, whose borders lie on one line: left out of `pairs` by whoever knows seams.
  std::vector<IntersectingPair> across_seams = {};
  std::vector<int> collapsed = {};      ///< triangles whose corners lie exactly on a line: never right in a surface
  bool none() const { return pairs.empty() && collapsed.empty(); }
};

/// All pairs that have more points in common than their common vertices and edge, decided exactly for the coordinates
/// as they are:
///   no common vertex      the triangles, closed, have a point in common;
///   one common vertex     the edge opposite to it in one meets the other (both are convex: a common point beyond the
///                         vertex leads on to such an edge);
///   a common edge         they lie in one plane on the same side of it: folded flat onto each other;
///   all three             always.
/// A collapsed triangle counts as the segment that it is against those without a common vertex, and is not compared
/// with its neighbours. `obstacle` (one flag per vertex, or empty): pairs of obstacles with obstacles are left out.
/// Throws RunError where a coordinate is not finite.
Intersections intersections(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles,
                            std::span<const char> obstacle = {});

}  // namespace gambeson::exact
