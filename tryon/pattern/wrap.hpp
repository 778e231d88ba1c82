#pragma once
/// Horizontal cross-sections of a body, as a tape measure sees them: convex closed curves with their length.

#include <functional>
#include <span>
#include <vector>

#include "core/math/vec.hpp"
#include "human/body/section.hpp"

namespace gambeson {

/// Horizontal cross-sections of the convex hull of a body between two heights: cloth under tension bridges the hollows
/// between the shapes below one another, as a tape bridges those beside one another.
///
/// The support function of a hull's cross-section at height z, h(angle, z) = max of cos(angle) x + sin(angle) y, is the
/// least concave function of z above that of the cross-sections. Kept for 360 directions at evenly spaced heights,
/// linear between.
class Wrap {
 public:
  /// cross_sections[k], not empty, belongs to the height from + k (to - from) / (count - 1).
  Wrap(const std::vector<std::vector<Vec2>>& cross_sections, double from, double to);
  /// Only hulls of the cross-sections themselves, each at its height; where a cross-section is empty nothing is there.
  static Wrap plain(const std::vector<std::vector<Vec2>>& cross_sections, double from, double to);

  /// The cross-section as the polygon of its tangents, counterclockwise; from <= z <= to.
  std::vector<Vec2> crossSection(double z) const;
  /// How far a point lies outside of the cross-section, or (negative) inside of it: the largest over all directions.
  double beyond(double z, const Vec2& point) const;
  /// Length of the cross-section, the integral of the support over all directions (Cauchy).
  double girth(double z) const;

  /// Each cross-section grown by a factor about a centre; each moved outward by a distance.
  Wrap grown(double factor, const Vec2& centre) const;
  Wrap offset(double distance) const;
  /// Each moved outward by a distance of its height.
  Wrap raised(const std::function<double(double)>& distance) const;
  /// Hulls of both wraps' cross-sections; both have the same heights.
  Wrap with(const Wrap& other) const;
  /// The wrap that has at each height the hull of all cross-sections within `reach` above and below.
  Wrap widened(double reach) const;
  /// (1 - share(z)) this + share(z) the cross-section `other`, as supports (Minkowski).
  Wrap blended(const std::vector<Vec2>& other, const std::function<double(double)>& share) const;

  double from() const { return from_; }
  double to() const { return to_; }
  int heights() const { return static_cast<int>(support_.size()); }

 private:
  Wrap() = default;
  template <class F>
  Wrap changed(const F& support) const;  ///< support(height's number, direction)
  double heightOf(int k) const { return from_ + (to_ - from_) * k / (heights() - 1); }

  static constexpr int directions = 360;
  double from_ = 0, to_ = 0;
  std::vector<std::vector<double>> support_;  ///< by height, then direction
};

/// A closed polygon by arc length.
class ClosedCurve {
 public:
  /// Counterclockwise, at least three points.
  explicit ClosedCurve(std::vector<Vec2> points);
  double length() const { return at_.back(); }
  /// The point at arc length s from the first vertex, any s (wraps).
  Vec2 point(double s) const;
  /// Arc length where the ray from `origin` (inside) along `direction` leaves the curve.
  double crossing(const Vec2& origin, const Vec2& direction) const;
  /// Centroid of the area.
  Vec2 centroid() const;
  /// How far it reaches along a direction: the largest direction . x.
  double extent(const Vec2& direction) const;
  /// Grown by a factor about a centre.
  ClosedCurve grown(double factor, const Vec2& centre) const;

 private:
  std::vector<Vec2> points_;
  std::vector<double> at_;
};

}  // namespace gambeson
