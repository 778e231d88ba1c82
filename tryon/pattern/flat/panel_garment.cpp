#include "tryon/pattern/flat/panel_garment.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/sewing.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/panel_pieces.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const char* list, std::size_t k, const std::string& reason) {
  throw InputError({"", 0, std::string(list) + "[" + std::to_string(k) + "]"}, reason);
}

/// From a panel's plane to parameters, and from there to the world. Parameters run along weft and warp, unless they are
/// turned.
struct Grain {
  Vec2 weft{1, 0}, warp{0, 1};
  Vec2 along_u, along_v;
  PanelPlace place;

  explicit Grain(const Panel& panel) : place(*panel.placement) {
    if (panel.grain) {
      const Vec2 way{panel.grain->to_m.x - panel.grain->from_m.x, panel.grain->to_m.y - panel.grain->from_m.y};
      const double length = std::hypot(way.x, way.y);
      warp = {way.x / length, way.y / length};
      weft = {warp.y, -warp.x};
    }
    along_u = weft, along_v = warp;
  }
  /// So that a direction of the panel's plane is along u or v, whichever is nearer.
  void turnTo(Vec2 way) {
    const double length = std::hypot(way.x, way.y);
    Vec2 at = parameters({way.x / length, way.y / length});
    while (!(at.x >= std::abs(at.y) - 1e-12)) at = {at.y, -at.x};  // a quarter turn
    if (std::abs(at.y) < 1e-9) return;
    along_u = {at.x * weft.x + at.y * warp.x, at.x * weft.y + at.y * warp.y};
    along_v = {-along_u.y, along_u.x};
  }
  Vec2 parameters(Vec2 p) const { return {along_u.x * p.x + along_u.y * p.y, along_v.x * p.x + along_v.y * p.y}; }
  Vec3 world(Vec2 uv) const {
    const Vec2 p{uv.x * along_u.x + uv.y * along_v.x, uv.x * along_u.y + uv.y * along_v.y};
    return place.origin_m + p.x * place.along_x + p.y * place.along_y;
  }
  Vec3 weftInWorld() const { return weft.x * place.along_x + weft.y * place.along_y; }
  NurbsCurve curve(NurbsCurve c) const {
    for (Vec2& p : c.points) p = parameters(p);
    return c;
  }
};

/// Cells of about the wanted size between the ends, and between `lines` where these are not too near to each other.
KnotVector evenKnots(int degree, double from, double to, double cell_m, std::vector<double> lines = {}) {
  constexpr double kNearest = 0.6;  // of a cell
  std::sort(lines.begin(), lines.end());
  std::vector<double> ends{from};
  for (const double line : lines)
    if (line - ends.back() > kNearest * cell_m && to - line > kNearest * cell_m) ends.push_back(line);
  ends.push_back(to);
  KnotVector k{degree, std::vector<double>(static_cast<std::size_t>(degree), from)};
  for (std::size_t e = 0; e + 1 < ends.size(); ++e) {
    const double low = ends[e], high = ends[e + 1];
    const int cells = std::max(1, static_cast<int>(std::lround((high - low) / cell_m)));
    for (int i = 0; i < cells; ++i) k.knots.push_back(low + (high - low) * i / cells);
  }
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

/// Cells of the whole panel, with lines through the cuts of its darts.
struct PanelGrid {
  KnotVector u, v;
};
PanelGrid gridOf(const Panel& panel, const Grain& grain, const PanelCells& cells, const std::vector<PieceCut>& cuts) {
  const PanelBox box = reachOf(panel, grain);
  std::vector<double> us, vs;
  for (const PieceCut& cut : cuts) {
    if (cut.straight_u) us.push_back(cut.from.x);
    if (cut.straight_v) vs.push_back(cut.from.y);
  }
  return {evenKnots(cells.degree, box.low.x, box.high.x, cells.cell_m, us),
          evenKnots(cells.degree, box.low.y, box.high.y, cells.cell_m, vs)};
}

/// The cells that reach from low to high, and as many more as functions reach over: the functions on those cells are
/// the same.
KnotVector cropped(const KnotVector& whole, double low, double high) {
  const std::vector<double> ends = breakpoints(whole);
  const int p = whole.degree, last = static_cast<int>(ends.size()) - 1;
  const double eps = 1e-9 * (ends.back() - ends.front());
  int a = 0, b = last;
  while (a < last && ends[static_cast<std::size_t>(a + 1)] <= low + eps) ++a;
  while (b > 0 && ends[static_cast<std::size_t>(b - 1)] >= high - eps) --b;
  a = std::max(0, a - p), b = std::min(last, b + p);
  KnotVector k{p, std::vector<double>(static_cast<std::size_t>(p), ends[static_cast<std::size_t>(a)])};
  k.knots.insert(k.knots.end(), ends.begin() + a, ends.begin() + b + 1);
  k.knots.insert(k.knots.end(), static_cast<std::size_t>(p), ends[static_cast<std::size_t>(b)]);
  return k;
}

NurbsPatch patchOn(const KnotVector& u, const KnotVector& v, const Grain& grain) {
  NurbsPatch patch;
  patch.u = u, patch.v = v;
  for (const double at_v : grevillePoints(v))
    for (const double at_u : grevillePoints(u)) patch.points.push_back(grain.world({at_u, at_v}));
  patch.weights.assign(patch.points.size(), 1.0);
  return patch;
}

PanelBorder borderOf(const Panel& panel, const Grain& grain) {
  PanelBorder out;
  const auto add = [&](const PanelLoop& loop) {
    out.emplace_back();
    for (NurbsCurve& c : curvesOf(loop)) out.back().push_back(grain.curve(std::move(c)));
  };
  add(panel.outline);
  for (const PanelLoop& cutout : panel.cutouts) add(cutout);
  return out;
}

/// A side of a seam in parameters of the edges' curves.
std::vector<BorderPart> borderParts(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
  std::vector<BorderPart> out;
  for (const SeamPart& part : side) {
    const NurbsCurve curve = curveOf(pattern.panels[static_cast<std::size_t>(part.panel)], part.edge);
    const MeasuredCurve measured(curve);
    const auto at = [&](double fraction) {
      return fraction <= 0 ? curve.knots.front() : fraction >= 1 ? curve.knots.back() : measured.parameterAt(fraction);
    };
    out.push_back({part.edge, at(part.from), at(part.to)});
  }
  return out;
}

/// A tip of a panel, the seam it is of, and which way the seam's sides lead off between them.
struct PanelTip {
  SeamTip tip;
  std::size_t seam = 0;
  Vec2 way;
  double length_m = 0;
};

/// Where both sides of a seam meet in one panel.
void addTips(const FlatPattern& pattern, std::size_t index, std::vector<std::vector<PanelTip>>& tips) {
  const PanelSeam& seam = pattern.seams[index];
  const std::vector<BorderPart> a = borderParts(pattern, seam.a), b = borderParts(pattern, seam.b);
  // The place as the start of an edge where it is a corner.
  const auto place = [&](const SeamPart& part, int edge, double t) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
    const NurbsCurve curve = curveOf(panel, edge);
    if (t < curve.knots.back()) return BorderPlace{edge, t};
    const int next = edgeAfter(panel, edge);
    return BorderPlace{next, curveOf(panel, next).knots.front()};
  };
  const auto point = [&](const SeamPart& part, const BorderPart& on, bool end) {
    return curvePoint(curveOf(pattern.panels[static_cast<std::size_t>(part.panel)], on.edge), end ? on.to : on.from)
        .point;
  };
  for (const bool end : {false, true}) {
    const SeamPart &pa = end ? seam.a.back() : seam.a.front(), &pb = end ? seam.b.back() : seam.b.front();
    if (pa.panel != pb.panel) continue;
    const BorderPlace at = place(pa, pa.edge, end ? a.back().to : a.front().from);
    const BorderPlace other = place(pb, pb.edge, end ? b.back().to : b.front().from);
    if (at.edge != other.edge || std::abs(at.t - other.t) > 1e-9 * (1 + std::abs(at.t))) continue;
    PanelTip tip{{at, seam.name.empty() ? sideText(pattern, seam.a) : "\"" + seam.name + "\""}, index, {}, 0};
    const Vec2 from = point(pa, end ? a.back() : a.front(), end);
    for (const auto& [side, parts] : {std::pair(&seam.a, &a), std::pair(&seam.b, &b)}) {
      const Vec2 far = point(end ? side->front() : side->back(), end ? parts->front() : parts->back(), !end);
      const Vec2 leg{far.x - from.x, far.y - from.y};
      const double length = std::hypot(leg.x, leg.y);
      if (length > 0) tip.way = {tip.way.x + leg.x / length, tip.way.y + leg.y / length};
      tip.length_m += 0.5 * length;
    }
    tips[static_cast<std::size_t>(pa.panel)].push_back(std::move(tip));
  }
}

/// A panel as patches of the garment.
struct MadePanel {
  int first_patch = 0;
  Grain grain;
  std::vector<PiecePart> parts;  ///< of its edges; empty where it is one patch
};

/// "front 2" of the second piece of "front", or what no panel is called, nor a piece that is there.
std::string pieceName(const FlatPattern& pattern, const Panel& panel, std::size_t piece, const Garment& g) {
  std::string between = " ", name;
  do {
    name = panel.name + between + std::to_string(piece + 1);
    between += "piece ";
  } while (std::any_of(pattern.panels.begin(), pattern.panels.end(), [&](const Panel& p) { return p.name == name; }) ||
           std::find(g.patch_names.begin(), g.patch_names.end(), name) != g.patch_names.end());
  return name;
}

/// Adds the patches of a panel: one, or one for each piece that the tips of its seams cut it into.
MadePanel addPanel(const FlatPattern& pattern, const Panel& panel, const std::vector<PanelTip>& panel_tips,
                   const PanelCells& cells, Garment& g) {
  Grain grain(panel);
  std::vector<SeamTip> tips;
  const PanelTip* longest = nullptr;
  for (const PanelTip& t : panel_tips) {
    tips.push_back(t.tip);
    if (std::hypot(t.way.x, t.way.y) > 0.1 && (!longest || t.length_m > longest->length_m)) longest = &t;
  }
  if (longest) grain.turnTo(longest->way);
  const PanelBorder border = borderOf(panel, grain);
  PanelPieces pieces{{border}, {}, {}};
  if (!tips.empty()) pieces = cutPanel(border, tips, cells.cell_m);
  const PanelGrid grid = gridOf(panel, grain, cells, pieces.cuts);
  MadePanel made{static_cast<int>(g.patches.size()), grain, pieces.parts};
  for (std::size_t k = 0; k < pieces.borders.size(); ++k) {
    if (tips.empty()) {
      g.patches.push_back(patchOn(grid.u, grid.v, grain));
    } else {
      Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
      for (const NurbsCurve& c : pieces.borders[k][0])
        for (const Vec2& p : c.points) {  // within which the curve lies
          low = {std::min(low.x, p.x), std::min(low.y, p.y)};
          high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
      g.patches.push_back(patchOn(cropped(grid.u, low.x, high.x), cropped(grid.v, low.y, high.y), grain));
    }
    g.weft.push_back(grain.weftInWorld());
    g.patch_names.push_back(k == 0 ? panel.name : pieceName(pattern, panel, k, g));
    Trim trim;
    trim.loops = pieces.borders[k];
    g.trims.push_back(std::move(trim));
  }
  for (const PieceCut& cut : pieces.cuts) {
    const int left = made.first_patch + cut.left, right = made.first_patch + cut.right;
    SewnSeam sewn{{{left, line(cut.from, cut.to), 0, 1}}, {{right, line(cut.from, cut.to), 0, 1}}};
    sewn.name = panel.name + ", on from the tip of " + tips[static_cast<std::size_t>(cut.tip)].seam;
    g.sewn_seams.push_back(std::move(sewn));
  }
  return made;
}

/// A side of a seam on the patches that its panels were made.
SewnEdge sewnEdge(const FlatPattern& pattern, const std::vector<SeamPart>& side, const std::vector<MadePanel>& made) {
  SewnEdge out;
  const std::vector<BorderPart> parts = borderParts(pattern, side);
  for (std::size_t k = 0; k < side.size(); ++k) {
    const Panel& panel = pattern.panels[static_cast<std::size_t>(side[k].panel)];
    const MadePanel& of = made[static_cast<std::size_t>(side[k].panel)];
    const NurbsCurve curve = of.grain.curve(curveOf(panel, side[k].edge));
    const BorderPart& part = parts[k];
    if (of.parts.empty()) {
      out.push_back({of.first_patch, curve, part.from, part.to});
      continue;
    }
    const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
    std::vector<SewnPart> found;
    for (const PiecePart& p : of.parts) {
      if (p.part.edge != part.edge) continue;
      const double a = std::max(low, p.part.from), b = std::min(high, p.part.to);
      if (b - a > 1e-9 * (high - low)) found.push_back({of.first_patch + p.piece, curve, a, b});
    }
    if (part.from > part.to) {
      std::reverse(found.begin(), found.end());
      for (SewnPart& p : found) std::swap(p.from, p.to);
    }
    out.insert(out.end(), found.begin(), found.end());
  }
  return out;
}

/// The edges of a panel, "front.3" and those that have a name "front.hem" too, on the patches that it was made.
void addNamedEdges(const FlatPattern& pattern, int number, const std::vector<MadePanel>& made, double cell_m,
                   Garment& g) {
  constexpr int kPlacesPerCell = 8;
  const Panel& panel = pattern.panels[static_cast<std::size_t>(number)];
  std::vector<NamedEdge> called;
  for (int e = 0; e < edgeCount(panel); ++e) {
    NamedEdge edge{panel.name + "." + std::to_string(e), {}};
    for (const SewnPart& part : sewnEdge(pattern, {{number, e, 0, 1}}, made)) {
      const double share = std::abs(part.to - part.from) / (part.curve.knots.back() - part.curve.knots.front());
      const int n = std::max(kPlacesPerCell, static_cast<int>(kPlacesPerCell * share * lengthOf(panel, e) / cell_m));
      edge.lines.emplace_back();
      for (int i = 0; i <= n; ++i)
        edge.lines.back().push_back(
            {part.patch, curvePoint(part.curve, part.from + (part.to - part.from) * i / n).point});
    }
    if (const std::string& name = edgeOf(panel, e).name; !name.empty()) {
      auto at = std::find_if(called.begin(), called.end(),
                             [&](const NamedEdge& c) { return c.name == panel.name + "." + name; });
      if (at == called.end()) at = called.insert(at, {panel.name + "." + name, {}});
      at->lines.insert(at->lines.end(), edge.lines.begin(), edge.lines.end());
    }
    g.edges.push_back(std::move(edge));
  }
  g.edges.insert(g.edges.end(), called.begin(), called.end());
}

/// The part of a side between two fractions of its length.
std::vector<SeamPart> stretchOf(const FlatPattern& pattern, const std::vector<SeamPart>& side, double from, double to) {
  const double whole = lengthOf(pattern, side);
  std::vector<SeamPart> out;
  double start = 0;
  for (const SeamPart& part : side) {
    const double range = lengthOf(pattern, {part}) / whole;
    const double a = std::clamp((from - start) / range, 0.0, 1.0), b = std::clamp((to - start) / range, 0.0, 1.0);
    const auto at = [&](double s) { return part.from + s * (part.to - part.from); };
    if (b - a > 1e-9) out.push_back({part.panel, part.edge, at(a), at(b)});
    start += range;
  }
  return out;
}

/// The buttons of an open seam: each a short seam of its own, about its point.
std::vector<PanelSeam> buttonsOf(const FlatPattern& pattern, const PanelSeam& seam, double cell_m) {
  constexpr double kButton_m = 0.01;
  const double length = std::min(lengthOf(pattern, seam.a), lengthOf(pattern, seam.b));
  const double half = std::min(0.5 * std::max(kButton_m, cell_m) / length, 0.4 / seam.buttons);
  std::vector<PanelSeam> out;
  for (int k = 0; k < seam.buttons; ++k) {
    const double at = (k + 0.5) / seam.buttons;
    PanelSeam button;
    button.name = seam.name + ", button " + std::to_string(k + 1);
    button.a = stretchOf(pattern, seam.a, at - half, at + half);
    button.b = stretchOf(pattern, seam.b, at - half, at + half);
    out.push_back(std::move(button));
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

Garment panelGarment(const FlatPattern& pattern, const PanelCells& cells, std::vector<int>* panel_of) {
  Garment g;
  g.name = pattern.name;
  std::vector<std::vector<PanelTip>> tips(pattern.panels.size());
  for (std::size_t k = 0; k < pattern.seams.size(); ++k)
    if (!pattern.seams[k].open) addTips(pattern, k, tips);
  std::vector<MadePanel> made;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const Panel& panel = pattern.panels[k];
    if (!panel.placement)
      reject("panels", k,
             "panel \"" + panel.name + "\" has no placement: nothing says where it stands around its wearer");
    if (panel.quantity > 1)
      reject("panels", k,
             "panel \"" + panel.name + "\" is cut " + std::to_string(panel.quantity) +
                 " times; allowed: once, each piece as a panel of its own");
    try {
      made.push_back(addPanel(pattern, panel, tips[k], cells, g));
      if (panel_of) panel_of->resize(g.patches.size(), static_cast<int>(k));
    } catch (const InputError& e) {
      reject("panels", k, "panel \"" + panel.name + "\": " + e.reason());
    }
  }
  for (std::size_t k = 0; k < pattern.panels.size(); ++k)
    addNamedEdges(pattern, static_cast<int>(k), made, cells.cell_m, g);
  std::vector<SewnSeam> cuts;
  std::swap(cuts, g.sewn_seams);
  // Sides that meet in a tip lie across the cells, and more hats leave the cloth beside them no way to bend; with fewer
  // they gape by some percent of a cell where they lean on the grid (core/cloth/DECISIONS.md).
  constexpr double kTipped = 2;
  std::vector<double> rows(pattern.seams.size(), SewnSeam{}.rows_per_cell);
  for (const std::vector<PanelTip>& panel_tips : tips)
    for (const PanelTip& t : panel_tips) rows[t.seam] = kTipped;
  const auto add = [&](const PanelSeam& seam, double rows_per_cell) {
    const std::string sides = sideText(pattern, seam.a) + " to " + sideText(pattern, seam.b);
    SewnSeam sewn{sewnEdge(pattern, seam.a, made), sewnEdge(pattern, seam.b, made)};
    sewn.rows_per_cell = rows_per_cell;
    sewn.stiffness_N = seam.stiffness_N;
    sewn.rest_angle_rad = seam.rest_angle_rad;
    if (seam.open) sewn.hold = SeamHold::open;
    sewn.name = seam.name.empty() ? sides : seam.name + ": " + sides;
    g.sewn_seams.push_back(std::move(sewn));
  };
  for (std::size_t k = 0; k < pattern.seams.size(); ++k) add(pattern.seams[k], rows[k]);
  for (const PanelSeam& seam : pattern.seams)
    if (seam.open)
      for (const PanelSeam& button : buttonsOf(pattern, seam, cells.cell_m)) add(button, SewnSeam{}.rows_per_cell);
  g.sewn_seams.insert(g.sewn_seams.end(), cuts.begin(), cuts.end());
  try {
    buildSewnRows(g, SeamHold::projected);
  } catch (const InputError& e) {  // "sewn_seams[k]" of the garment is "seams[k]" of the pattern
    const std::string own = "sewn_", key = e.where().key;
    throw InputError({"", 0, key.starts_with(own) ? key.substr(own.size()) : key}, e.reason());
  }
  return g;
}

}  // namespace gambeson
