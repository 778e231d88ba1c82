#pragma once
/// Plane NURBS curves: the edges of trimming loops (Zheng 2013, eq. 2.36).

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

}  // namespace gambeson
