#pragma once
/// Plane NURBS curves: the edges of trimming loops (Zheng 2013, eq. 2.36).

#include <span>
#include <vector>

#include "core/nurbs/nurbs.hpp"

namespace gambeson {

/// A curve in the plane, here the parameter plane of a patch; t runs over [knots.front(), knots.back()].
struct NurbsCurve {
  KnotVector knots;
  std::vector<Vec2> points;
  std::vector<double> weights;
};

/// Throws InputError (key = what is wrong) unless counts match, knots ascend, weights are positive and all is finite.
void validate(const NurbsCurve& curve);
/// Point and tangent dC/dt.
struct CurvePoint {
  Vec2 point, tangent;
};
CurvePoint curvePoint(const NurbsCurve& curve, double t);

NurbsCurve line(Vec2 from, Vec2 to);
/// A full circle about `center` as a rational quadratic, exact; counter-clockwise, or clockwise.
NurbsCurve circle(Vec2 center, double radius_u, double radius_v, bool clockwise);
/// The edges of a polygon, in the given order, closed. At least three corners.
std::vector<NurbsCurve> polygon(std::span<const Vec2> corners);
/// A closed, C2 cubic B-spline through `points` in the given order, t by chord length. At least three points, none
/// equal to the next.
NurbsCurve closedSpline(std::span<const Vec2> points);
/// The same curve run backwards.
NurbsCurve reversed(const NurbsCurve& curve);

/// A rational Bezier segment on t in [0, 1]: points (w u, w v, w). NURBS curves are chains of them, one per knot cell.
struct BezierSegment {
  std::vector<Vec3> points;
  CurvePoint at(double t) const;
};
std::vector<BezierSegment> bezierSegments(const NurbsCurve& curve);

}  // namespace gambeson
