/// Detail of armour.hpp: the belt; the law of its length is described there.
#include <algorithm>
#include <cmath>

#include "core/cloth/draft/areas.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

void check(const BeltPattern& p) {
  requirePositive("width_m", p.width_m);
  requirePositive("cell_m", p.cell_m);
  requireDegree(p.degree, 2);
  if (!(p.tension_N >= 0 && std::isfinite(p.tension_N))) reject("tension_N", "must not be negative");
  if (!(p.gap_m >= 0 && std::isfinite(p.gap_m))) reject("gap_m", "must not be negative");
  if (!std::isfinite(p.below_waist_m)) reject("below_waist_m", "must be finite");
}

/// Rings of a wrap as a closed patch, u from the centre back around the left... to the centre back again.
NurbsPatch ring(const KnotVector& u, const KnotVector& v, const Wrap& wrap, double median_y) {
  double last_z = HUGE_VAL, start = 0;
  std::vector<ClosedCurve> curve;
  return interpolate(u, v, [&](double s, double t) {
    const double z = wrap.from() + t * (wrap.to() - wrap.from());
    if (z != last_z) {
      curve.assign(1, ClosedCurve(wrap.crossSection(z)));
      start = curve[0].crossing({curve[0].centroid().x, median_y}, {-1, 0});
      last_z = z;
    }
    const Vec2 x = curve[0].point(start + s * curve[0].length());
    return Vec3{x.x, x.y, z};
  });
}

}  // namespace

double stretchAt(double tension_N, double width_m, const Fabric& fabric) {
  // The weft lies across the belt.
  const double stiffness = width_m * fabric.thickness_m * fabric.young_warp_Pa;
  if (!(stiffness > 0)) reject("fabric", "a belt needs a stiffness");
  double lambda = 1;  // Newton on a convex function from its left: monotone after the first step
  for (int k = 0; k < 50; ++k) {
    const double f = stiffness * 0.5 * lambda * (lambda * lambda - 1) - tension_N;
    lambda -= f / (stiffness * 0.5 * (3 * lambda * lambda - 1));
  }
  if (!(lambda < 1.5)) reject("tension_N", std::to_string(tension_N) + ", would stretch the belt by more than half");
  return lambda;
}

Garment makeBelt(const BeltPattern& p, const BodyForm& form, const Fabric& fabric, double layer_m,
                 std::span<const Worn> under) {
  check(p);
  const Links trunk = [&] {
    Links l = form.links({"torso", "thigh_left", "thigh_right"}, "garment.belt");
    l.push_back(0);
    return l;
  }();
  const double middle = form.origin(form.links({"torso"}, "garment.belt")[0]).z;
  const double top = waistOf(under, middle + 0.5 * p.width_m + p.below_waist_m) - p.below_waist_m;
  constexpr int heights = 17;
  const Wrap body = form.wrap(top - p.width_m, top, trunk, "below_waist_m", heights);
  // Each garment keeps half the sum to the next, the first its thickness to the body.
  double out = layer_m, below = 0;
  for (std::size_t k = 0; k < under.size(); ++k) {
    out = (k == 0 ? under[k].layer_m : below + 0.5 * (under[k - 1].layer_m + under[k].layer_m));
    below = out;
  }
  if (!under.empty()) out = below + 0.5 * (under.back().layer_m + layer_m);
  const Wrap worn = body.offset(out);
  const double middle_z = 0.5 * (worn.from() + worn.to());
  const ClosedCurve ring_middle(worn.crossSection(middle_z));
  const Vec2 centre{ring_middle.centroid().x, form.medianY()};
  Wrap start = worn.offset(p.gap_m), over_others = start;
  if (wrapOf(under, layer_m, p.gap_m, start.from(), start.to(), heights, over_others)) start = start.with(over_others);

  const auto u = uniformKnots(p.degree, cellsFor(ring_middle.length(), p.cell_m, 8));
  const auto v = uniformKnots(p.degree, cellsFor(p.width_m, p.cell_m, 2));
  Garment g;
  g.name = "belt";
  g.weft = {{0, 0, 1}};
  g.patch_names = beltPatchNames();
  g.edges = {{"lower", {{0, Side::v0}}}, {"upper", {{0, Side::v1}}}};
  const Seam closing{{0, Side::u0}, {0, Side::u1}, SeamKind::G1, 0};
  g.patches = {ring(u, v, start, form.medianY())};
  averageSeam(g, closing, 0, 0);
  g.placed = {g.patches[0].points};
  // On hips it is a cone, wider along its slope than upright.
  double area = 0;
  for (const double a : controlAreas(g)) area += a;
  const double lambda = stretchAt(p.tension_N, area / ClosedCurve(start.crossSection(middle_z)).length(), fabric);
  g.patches = {ring(u, v, worn.grown(1 / lambda, centre), form.medianY())};
  averageSeam(g, closing, 0, 0);
  g.seams = {closing};
  validate(g);
  return g;
}

}  // namespace gambeson
