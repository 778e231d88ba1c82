#pragma once
/// Detail of place_panels.hpp: a vertical tube around a body, in which sheets stand bent without strain.

#include <vector>

#include "tryon/pattern/wrap.hpp"

namespace gambeson {

/// How a sheet is bent about the front or the back of a tube: along its cross-section between two arc lengths from the
/// middle, and straight on beyond.
struct TubeHalf {
  double middle = 0;  ///< arc length on the cross-section
  double from = 0, to = 0;
};

class BodyTube {
 public:
  /// Around a convex polygon, off_m from it. Throws nothing; the polygon has at least three points.
  BodyTube(const std::vector<Vec2>& hull, double off_m);
  /// For a sheet that reaches from `from` to `to` (from <= 0 <= to) from the middle of the front, or the back: bent as
  /// far as it stays gap_m / 2 on its side of the plane between both, x = that of the tube's sides.
  TubeHalf half(bool front, double from, double to, double gap_m) const;
  /// A point of the sheet, counter-clockwise seen from above.
  Vec2 at(const TubeHalf& half, double s) const;

  double length() const { return curve_.length(); }
  Vec2 centre() const { return centre_; }
  Vec2 point(double s) const { return curve_.point(s); }
  /// Arc length where the cross-section is met in a direction from the centre.
  double startAt(Vec2 direction) const { return curve_.crossing(centre_, direction); }

 private:
  Vec2 tangent(double s) const;
  ClosedCurve curve_;
  Vec2 centre_;  ///< x: of the sides, y: midway
};

}  // namespace gambeson
