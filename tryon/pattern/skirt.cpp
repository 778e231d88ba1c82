/// Detail of armour.hpp: the skirt; described there.
#include <algorithm>
#include <cmath>
#include <map>

#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

constexpr int panels = 8;
}  // namespace

Garment makeSkirt(const SkirtPattern& p, const BodyForm& form, double layer_m, std::span<const Worn> under) {
  requirePositive("length_m", p.length_m);
  requireDegree(p.degree, 2);
  requireCells("cells_along", p.cells_along, 2);
  requireCells("cells_around", p.cells_around, 2 * panels);
  if (p.cells_around % panels != 0) reject("cells_around", "must be a multiple of 8");
  if (!(p.ease > -0.5 && p.ease < 2)) reject("ease", std::to_string(p.ease) + ", must lie between -0.5 and 2");
  if (!(p.flare_rad >= 0 && p.flare_rad <= 1.2)) reject("flare_rad", "must lie between 0 and 1.2");
  if (!(p.gap_m >= 0 && std::isfinite(p.gap_m))) reject("gap_m", "must not be negative");

  const Links torso = form.links({"torso"}, "garment.skirt");
  Links legs = form.links({"torso", "thigh_left", "thigh_right", "shank_left", "shank_right"}, "garment.skirt");
  legs.push_back(0);
  const double waist = waistOf(under, form.origin(torso[0]).z), hem = waist - p.length_m;
  const int heights = 1 + static_cast<int>(std::ceil(p.length_m / 0.005));
  const Wrap body = form.wrap(hem, waist, legs, "length_m", heights);
  const std::vector<Vec2> top = body.crossSection(waist);
  const Vec2 centre{ClosedCurve(top).centroid().x, form.medianY()};
  // The cone: the waist's cross-section everywhere, moved out in proportion to the depth below.
  std::vector<std::vector<Vec2>> same(heights, top);
  const Wrap ring = Wrap::plain(same, hem, waist).grown(1 + p.ease, centre);
  const Wrap cone = ring.raised([&](double z) { return std::tan(p.flare_rad) * (waist - z); });
  Wrap cross_sections = cone.with(body.grown(1 + p.ease, centre)).with(body.offset(layer_m + p.gap_m));
  Wrap over_others = cross_sections;
  if (wrapOf(under, layer_m, p.gap_m, hem, waist, heights, over_others))
    cross_sections = cross_sections.with(over_others.widened(1.5 * p.length_m / p.cells_along));

  struct Ring {
    ClosedCurve curve;
    double front = 0;
  };
  std::map<double, Ring> rings;
  const auto ringAt = [&](double z) -> const Ring& {
    const auto found = rings.find(z);
    if (found != rings.end()) return found->second;
    Ring r{ClosedCurve(cross_sections.crossSection(z)), 0};
    r.front = r.curve.crossing(centre, {1, 0});
    return rings.emplace(z, std::move(r)).first->second;
  };
  Garment g;
  g.name = "skirt";
  const auto u = uniformKnots(p.degree, p.cells_around / panels), v = uniformKnots(p.degree, p.cells_along);
  NamedEdge upper{"waist", {}}, lower{"hem", {}};
  for (int n = 0; n < panels; ++n) {
    g.patches.push_back(interpolate(u, v, [&](double s, double t) {
      const double z = hem + t * p.length_m;
      const Ring& r = ringAt(z);
      const Vec2 x = r.curve.point(r.front + (n + s) / panels * r.curve.length());
      return Vec3{x.x, x.y, z};
    }));
    g.weft.push_back({0, 0, 1});
    g.patch_names.push_back(skirtPatchNames()[static_cast<std::size_t>(n)]);
    upper.edges.push_back({n, Side::v1});
    lower.edges.push_back({n, Side::v0});
  }
  g.edges = {upper, lower};
  for (int n = 0; n < panels; ++n) {
    g.seams.push_back({{n, Side::u1}, {(n + 1) % panels, Side::u0}, SeamKind::G1, 0});
    averageSeam(g, g.seams.back(), 0, 0);
  }
  validate(g);
  return g;
}

}  // namespace gambeson
