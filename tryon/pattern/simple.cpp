/// Detail of pattern.hpp: the sheet, the disc and the tube.
#include <cmath>
#include <complex>
#include <numbers>

#include "core/cloth/draft/trim_loops.hpp"
#include "core/error.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

void requireUnit(const char* key, const Vec3& v) {
  if (!(std::abs(norm(v) - 1) < 1e-9)) throw InputError({"", 0, key}, "must be a unit vector");
}
void requireFinite(const char* key, const Vec3& v) {
  if (!std::isfinite(v.x + v.y + v.z)) throw InputError({"", 0, key}, "must be finite");
}

/// The part of a patch between two knots of u that have multiplicity `degree`, clamped there, over [0, 1].
NurbsPatch between(const NurbsPatch& p, double from, double to) {
  const int degree = p.u.degree;
  const auto first = std::find(p.u.knots.begin(), p.u.knots.end(), from);
  const auto last = std::find(p.u.knots.begin(), p.u.knots.end(), to);
  NurbsPatch out{{degree, {}}, p.v, {}, {}};
  out.u.knots.push_back(0);
  for (auto it = first; it != last + degree; ++it) out.u.knots.push_back((*it - from) / (to - from));
  out.u.knots.push_back(1);
  const int i0 = static_cast<int>(first - p.u.knots.begin()) - 1;
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < out.u.count(); ++i) {
      out.points.push_back(p.points[p.index(i0 + i, j)]);
      out.weights.push_back(p.weights[p.index(i0 + i, j)]);
    }
  return out;
}

}  // namespace

Garment makeSheet(const SheetPattern& s) {
  requirePositive("width_m", s.width_m);
  requirePositive("height_m", s.height_m);
  requireDegree(s.degree, 1);
  requireFinite("corner", s.corner);
  requireUnit("axis_u", s.axis_u);
  requireUnit("axis_v", s.axis_v);
  if (!(std::abs(dot(s.axis_u, s.axis_v)) < 1e-9)) throw InputError({"", 0, "axis_v"}, "must be orthogonal to axis_u");
  requireCells("cells_u", s.cells_u, 1);
  requireCells("cells_v", s.cells_v, 1);
  Garment g;
  g.name = "sheet";
  // Linear precision: the control points of a plane's linear parameterisation lie at the Greville points.
  NurbsPatch p{uniformKnots(s.degree, s.cells_u), uniformKnots(s.degree, s.cells_v), {}, {}};
  for (const double v : grevillePoints(p.v))
    for (const double u : grevillePoints(p.u))
      p.points.push_back(s.corner + u * s.width_m * s.axis_u + v * s.height_m * s.axis_v);
  p.weights.assign(p.points.size(), 1);
  g.patches.push_back(std::move(p));
  g.weft.push_back(s.axis_u);
  for (const char* name : {"u0", "u1", "v0", "v1"}) g.edges.push_back({name, sheetEdge(name)});
  return g;
}

// The cross-section is one uniform periodic spline, whose net is a regular polygon; each patch is cut out of it by
// inserting its end knots to multiplicity p. The cut leaves the curve C^(p-1), so both sides have the same first
// difference there.
Garment makeDisc(const DiscPattern& d) {
  requirePositive("radius_m", d.radius_m);
  requireDegree(d.degree, 1);
  requireFinite("center", d.center);
  requireUnit("axis_u", d.axis_u);
  requireUnit("axis_v", d.axis_v);
  if (!(std::abs(dot(d.axis_u, d.axis_v)) < 1e-9)) throw InputError({"", 0, "axis_v"}, "must be orthogonal to axis_u");
  requireCells("cells", d.cells, 2);
  const int cells = d.cells + 1;
  const double side = 2 * d.radius_m * cells / d.cells;
  Garment g = makeSheet(
      {side, side, cells, cells, d.degree, d.center - (0.5 * side) * (d.axis_u + d.axis_v), d.axis_u, d.axis_v});
  g.name = "disc";
  g.edges.clear();
  g.trims = {Trim{{circleLoop(g.patches[0], {0.5 * side, 0.5 * side}, d.radius_m, Keep::inside)}}};
  return g;
}

// The cross-section is one uniform periodic spline, whose net is a regular polygon; each patch is cut out of it by
// inserting its end knots to multiplicity p. The cut leaves the curve C^(p-1), so both sides have the same first
// difference there.
Garment makeTube(const TubePattern& t) {
  requirePositive("radius_m", t.radius_m);
  requirePositive("length_m", t.length_m);
  requireDegree(t.degree, 2);
  requireFinite("start", t.start);
  requireUnit("axis", t.axis);
  requireCells("cells_around", t.cells_around, 3);
  requireCells("cells_along", t.cells_along, 1);
  if (!(t.patches >= 1 && t.cells_around % t.patches == 0))
    throw InputError({"", 0, "patches"},
                     std::to_string(t.patches) + ", must divide cells_around (" + std::to_string(t.cells_around) + ")");
  if (!(t.seam_stiffness_N >= 0) || !std::isfinite(t.seam_stiffness_N))
    throw InputError({"", 0, "seam_stiffness_N"}, "must not be negative");
  const int p = t.degree, cells = t.cells_around / t.patches;
  const double step = 2 * std::numbers::pi / t.cells_around;
  const Vec3 i = normalized(cross(std::abs(t.axis.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, t.axis));
  const Vec3 j = cross(t.axis, i);

  // The cells -1 .. cells, so that both ends lie strictly inside.
  KnotVector u{p, {}};
  for (int k = -1 - p; k <= cells + 1 + p; ++k) u.knots.push_back(k);
  // At a knot the curve is sum of B_k e^{i k step} over a net of radius 1: the net's radius puts it on the circle.
  std::vector<double> b(p + 1);
  basisDerivatives(u, findSpan(u, 0), 0, 0, b);
  std::complex<double> at_knot;
  for (int k = 0; k <= p; ++k) at_knot += b[k] * std::polar(1.0, k * step);
  const double net = t.radius_m / std::abs(at_knot);

  Garment g;
  g.name = "tube";
  for (int n = 0; n < t.patches; ++n) {
    NurbsPatch patch{u, uniformKnots(p, t.cells_along), {}, {}};
    for (const double v : grevillePoints(patch.v))
      for (int k = 0; k < u.count(); ++k) {
        // Control point k belongs to the middle of its support, knot k - 1 - p + (p + 1)/2; whole turns are taken away
        // so that the patches meet to the bit.
        const int twice = (2 * (k + n * cells) - p - 1 + 4 * t.cells_around) % (2 * t.cells_around);
        const double angle = 0.5 * twice * step;
        patch.points.push_back(t.start + v * t.length_m * t.axis + net * (std::cos(angle) * i + std::sin(angle) * j));
      }
    patch.weights.assign(patch.points.size(), 1);
    patch = insertKnot(insertKnot(patch, Direction::u, 0, p - 1), Direction::u, cells, p - 1);
    g.patches.push_back(between(patch, 0, cells));
    g.weft.push_back(t.axis);
  }
  for (int n = 0; n < t.patches; ++n) {
    Seam seam{{n, Side::u1}, {(n + 1) % t.patches, Side::u0}, t.seam, t.seam == SeamKind::C0 ? t.seam_stiffness_N : 0};
    averageSeam(g, seam, 0, 0);  // already so up to rounding; the two edges become equal to the bit
    g.seams.push_back(seam);
  }
  for (const char* name : {"start", "end"}) g.edges.push_back({name, tubeEdge(t, name)});
  return g;
}

}  // namespace gambeson
