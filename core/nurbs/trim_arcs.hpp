#pragma once
/// Trimming loops as chains of arcs that are monotone in u and in v: what cutting, sampling and inside tests work on.

#include <array>
#include <span>
#include <vector>

#include "core/nurbs/trim.hpp"

namespace gambeson {

/// Part [t0, t1] of a Bezier segment, from a to b, monotone in u and in v. The kept side lies to its left.
struct MonotoneArc {
  int segment = 0;
  double t0 = 0, t1 = 1;
  Vec2 a, b;
  bool corner = false;  ///< the loop has a corner at `a`

  double lowU() const { return a.x < b.x ? a.x : b.x; }
  double highU() const { return a.x < b.x ? b.x : a.x; }
  double lowV() const { return a.y < b.y ? a.y : b.y; }
  double highV() const { return a.y < b.y ? b.y : a.y; }
};

/// The loops of a patch, checked. Consecutive arcs of a loop share their end points exactly.
struct TrimBoundary {
  struct Segment {
    BezierSegment curve;
    int loop = 0, index = 0;  ///< curve `index` of loop `loop`
  };
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;  ///< the patch's rectangle
  double eps_u = 0, eps_v = 0;            ///< lengths below these are nothing: 1e-11 of the rectangle
  std::vector<Segment> segments;
  std::vector<MonotoneArc> arcs;    ///< loop by loop, in the loop's sense
  std::vector<int> first_arc;       ///< of each loop, and the end
  std::vector<double> signed_area;  ///< of each loop in (u, v); > 0 counter-clockwise
  bool rectangle_is_outline = true;

  /// C(t) within the box of the arc's ends.
  Vec2 point(const MonotoneArc& arc, double t) const;
  CurvePoint at(const MonotoneArc& arc, double t) const;
  /// The t at which the arc has u = value (axis 0) or v = value (axis 1), which lies between its ends.
  double solve(const MonotoneArc& arc, int axis, double value) const;
  /// On a loop (within eps), or where the loops wind once about the point.
  bool isKept(Vec2 uv) const;
  /// The number of times that the loops wind about a point (the rectangle counts where it is the outline); `skip` is
  /// a loop that is left out.
  int winding(Vec2 uv, int skip = -1) const;
};

/// Throws InputError (key names loop and curve) where a loop is open, degenerate, leaves the patch, touches or crosses
/// itself or another, or is nested against its orientation.
TrimBoundary trimBoundary(const NurbsPatch& patch, const Trim& trim);

/// The arcs cut at the lines u = us[i] and v = vs[j] (ascending, from end to end of the patch): each lies in one closed
/// cell between them. Points within eps of a line are on it. Arcs of no length are dropped; consecutive arcs share
/// their ends.
struct GridArcs {
  std::vector<MonotoneArc> arcs;
  std::vector<int> first_arc;  ///< of each loop, and the end
};
GridArcs splitAtGrid(const TrimBoundary& boundary, std::span<const double> us, std::span<const double> vs);
/// The cell (i, j) that an arc of splitAtGrid lies in; {-1, -1} where it runs along a grid line.
std::array<int, 2> gridCell(const MonotoneArc& arc, std::span<const double> us, std::span<const double> vs);

}  // namespace gambeson
