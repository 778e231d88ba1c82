#pragma once
/// Measures of flat panels. All of them take panels that checkPattern (panel_check.hpp) lets pass.

#include <vector>

#include "core/nurbs/curve.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// Number of edges of a panel, cutouts included; an edge by its number, and where it ends.
int edgeCount(const Panel& panel);
const PanelEdge& edgeOf(const Panel& panel, int edge);
Vec2 edgeEnd(const Panel& panel, int edge);
/// The edge before and the one after in the same loop.
int edgeBefore(const Panel& panel, int edge);
int edgeAfter(const Panel& panel, int edge);

/// An edge as a NURBS curve, exactly: lines and polylines of degree 1, arcs as rational quadratics of at most 90
/// degrees.
NurbsCurve curveOf(const PanelEdge& edge, Vec2 end);
NurbsCurve curveOf(const Panel& panel, int edge);
/// A loop as the trim loop of a patch whose parameters are m in the panel's plane (core/nurbs/trim.hpp).
std::vector<NurbsCurve> curvesOf(const PanelLoop& loop);

/// A curve measured by its length, to 1e-12 of it (Gauss-Legendre, halved until two rules agree).
class MeasuredCurve {
 public:
  explicit MeasuredCurve(const NurbsCurve& curve);
  double length_m() const { return start_m_.back(); }
  /// Point and unit tangent at a fraction of the length.
  CurvePoint at(double fraction) const;
  /// The parameter of the NURBS curve there.
  double parameterAt(double fraction) const;
  /// The fraction of the length at which the curve is nearest to p, and how far away.
  struct Nearest {
    double fraction = 0, distance_m = 0;
  };
  Nearest nearest(Vec2 p) const;

 private:
  struct Piece {
    BezierSegment curve;
    double t0, t1;  ///< of the segment
    double u0, u1;  ///< of the NURBS curve
  };
  /// Piece and its parameter.
  std::pair<const Piece*, double> find(double fraction) const;
  std::vector<Piece> pieces_;
  std::vector<double> start_m_;  ///< length before each piece, and the whole
};

double lengthOf(const Panel& panel, int edge);
/// Of a side of a seam.
double lengthOf(const FlatPattern& pattern, const std::vector<SeamPart>& side);
double perimeterOf(const PanelLoop& loop);
/// Signed: positive counter-clockwise.
double areaOf(const PanelLoop& loop);
/// Of the cloth: outline less cutouts.
double areaOf(const Panel& panel);

/// Points along an edge, its start among them and its end not, so that no point of the edge is farther than
/// `tolerance_m` from the lines between them (and the end).
std::vector<Vec2> flattened(const PanelEdge& edge, Vec2 end, double tolerance_m);
std::vector<Vec2> flattened(const PanelLoop& loop, double tolerance_m);

/// Lower left and upper right corner of the points of a loop's edges (flattened to 0.1 mm).
struct PanelBox {
  Vec2 low, high;
};
PanelBox boxOf(const PanelLoop& loop);

}  // namespace gambeson
