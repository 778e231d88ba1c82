#pragma once
/// Where loops of straight lines cross or touch, decided exactly.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Sign of (b - a) x (c - a): 1 to the left, -1 to the right, 0 on the line. Exact (Shewchuk 1997: a filter, then an
/// expansion) for coordinates that are 0 or between 1e-140 and 1e140 in size.
int turnSign(Vec2 a, Vec2 b, Vec2 c);

/// How often a closed polygon winds about a point that is not on it.
int windingOf(std::span<const Vec2> polygon, Vec2 p);

/// Two lines of closed polygons that meet: polygon and number of each, lines from point k to the next.
struct LineMeeting {
  int polygon_a = 0, line_a = 0, polygon_b = 0, line_b = 0;
  Vec2 at;
};

/// The first crossing, and the first touch, of polygons with themselves and with each other. A crossing leads from one
/// side of a line to the other; lines that only meet, in a point or along a stretch, touch. No two points in a row are
/// equal.
struct Meetings {
  std::vector<LineMeeting> crossing, touch;  ///< one or none
};
Meetings meetingsOf(const std::vector<std::vector<Vec2>>& polygons);

}  // namespace gambeson
