#include "tryon/pattern/flat/panel_garment.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/sewing.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const char* list, std::size_t k, const std::string& reason) {
  throw InputError({"", 0, std::string(list) + "[" + std::to_string(k) + "]"}, reason);
}

/// From a panel's plane to parameters along weft and warp, and from there to the world.
struct Grain {
  Vec2 weft{1, 0}, warp{0, 1};
  PanelPlace place;

  explicit Grain(const Panel& panel) : place(*panel.placement) {
    if (!panel.grain) return;
    const Vec2 way{panel.grain->to_m.x - panel.grain->from_m.x, panel.grain->to_m.y - panel.grain->from_m.y};
    const double length = std::hypot(way.x, way.y);
    warp = {way.x / length, way.y / length};
    weft = {warp.y, -warp.x};
  }
  Vec2 parameters(Vec2 p) const { return {weft.x * p.x + weft.y * p.y, warp.x * p.x + warp.y * p.y}; }
  Vec3 world(Vec2 uv) const {
    const Vec2 p{uv.x * weft.x + uv.y * warp.x, uv.x * weft.y + uv.y * warp.y};
    return place.origin_m + p.x * place.along_x + p.y * place.along_y;
  }
  Vec3 weftInWorld() const { return weft.x * place.along_x + weft.y * place.along_y; }
  NurbsCurve curve(NurbsCurve c) const {
    for (Vec2& p : c.points) p = parameters(p);
    return c;
  }
};

KnotVector evenKnots(int degree, double from, double to, double cell_m) {
  const int cells = std::max(1, static_cast<int>(std::lround((to - from) / cell_m)));
  KnotVector k{degree, std::vector<double>(static_cast<std::size_t>(degree), from)};
  for (int i = 0; i < cells; ++i) k.knots.push_back(from + (to - from) * i / cells);
  k.knots.insert(k.knots.end(), static_cast<std::size_t>(degree) + 1, to);
  return k;
}

/// What the outline reaches in (u, v). Where a curve reaches further than its ends, a little more than it was found to.
PanelBox reachOf(const Panel& panel, const Grain& grain) {
  constexpr double kFlat_m = 1e-5;
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  PanelBox ends{low, high}, all{low, high};
  const auto add = [&](PanelBox& box, Vec2 p) {
    const Vec2 uv = grain.parameters(p);
    box.low = {std::min(box.low.x, uv.x), std::min(box.low.y, uv.y)};
    box.high = {std::max(box.high.x, uv.x), std::max(box.high.y, uv.y)};
  };
  for (const PanelEdge& edge : panel.outline) add(ends, edge.start_m);
  for (const Vec2 p : flattened(panel.outline, kFlat_m)) add(all, p);
  const auto least = [&](double end, double found) { return found < end - 1e-12 ? found - 2 * kFlat_m : end; };
  return {{least(ends.low.x, all.low.x), least(ends.low.y, all.low.y)},
          {-least(-ends.high.x, -all.high.x), -least(-ends.high.y, -all.high.y)}};
}

NurbsPatch patchOf(const Panel& panel, const Grain& grain, const PanelCells& cells) {
  const PanelBox box = reachOf(panel, grain);
  NurbsPatch patch;
  patch.u = evenKnots(cells.degree, box.low.x, box.high.x, cells.cell_m);
  patch.v = evenKnots(cells.degree, box.low.y, box.high.y, cells.cell_m);
  for (const double v : grevillePoints(patch.v))
    for (const double u : grevillePoints(patch.u)) patch.points.push_back(grain.world({u, v}));
  patch.weights.assign(patch.points.size(), 1.0);
  return patch;
}

TrimLoop trimOf(const PanelLoop& loop, const Grain& grain) {
  TrimLoop out;
  for (NurbsCurve& c : curvesOf(loop)) out.push_back(grain.curve(std::move(c)));
  return out;
}

SewnEdge sewnEdge(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
  SewnEdge out;
  for (const SeamPart& part : side) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
    const NurbsCurve curve = curveOf(panel, part.edge);
    const MeasuredCurve measured(curve);
    const auto at = [&](double fraction) {
      return fraction <= 0 ? curve.knots.front() : fraction >= 1 ? curve.knots.back() : measured.parameterAt(fraction);
    };
    out.push_back({part.panel, Grain(panel).curve(curve), at(part.from), at(part.to)});
  }
  return out;
}

}  // namespace

std::string sideText(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
  std::string out;
  for (const SeamPart& part : side) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
    out += (out.empty() ? "" : " + ") + panel.name + "." + std::to_string(part.edge);
  }
  return out;
}

Garment panelGarment(const FlatPattern& pattern, const PanelCells& cells) {
  Garment g;
  g.name = pattern.name;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const Panel& panel = pattern.panels[k];
    if (!panel.placement)
      reject("panels", k,
             "panel \"" + panel.name + "\" has no placement: nothing says where it stands around its wearer");
    if (panel.quantity > 1)
      reject("panels", k,
             "panel \"" + panel.name + "\" is cut " + std::to_string(panel.quantity) +
                 " times; allowed: once, each piece as a panel of its own");
    const Grain grain(panel);
    g.patches.push_back(patchOf(panel, grain, cells));
    g.weft.push_back(grain.weftInWorld());
    g.patch_names.push_back(panel.name);
    Trim trim;
    trim.loops.push_back(trimOf(panel.outline, grain));
    for (const PanelLoop& cutout : panel.cutouts) trim.loops.push_back(trimOf(cutout, grain));
    g.trims.push_back(std::move(trim));
  }
  for (const PanelSeam& seam : pattern.seams) {
    const std::string sides = sideText(pattern, seam.a) + " to " + sideText(pattern, seam.b);
    SewnSeam sewn{sewnEdge(pattern, seam.a), sewnEdge(pattern, seam.b)};
    sewn.stiffness_N = seam.stiffness_N;
    sewn.name = seam.name.empty() ? sides : seam.name + ": " + sides;
    g.sewn_seams.push_back(std::move(sewn));
  }
  try {
    buildSewnRows(g, SeamHold::projected);
  } catch (const InputError& e) {  // "sewn_seams[k]" of the garment is "seams[k]" of the pattern
    const std::string own = "sewn_", key = e.where().key;
    throw InputError({"", 0, key.starts_with(own) ? key.substr(own.size()) : key}, e.reason());
  }
  return g;
}

}  // namespace gambeson
