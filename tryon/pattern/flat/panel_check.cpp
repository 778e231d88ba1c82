#include "tryon/pattern/flat/panel_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "tryon/pattern/flat/crossings.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double kFarthest_m = 10, kLeastEdge_m = 1e-6, kLeastArea_m2 = 1e-6, kFlat_m = 1e-5;
constexpr std::size_t kMostPanels = 1000, kMostPoints = 20000;

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

std::string named(const Panel& p) { return "panel \"" + p.name + "\" "; }
std::string inCm(Vec2 p) { return fmt::format("({:.2f}, {:.2f}) cm", 100 * p.x, 100 * p.y); }

void checkPoint(Vec2 p, const std::string& key) {
  if (!(std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m))
    reject(key, fmt::format("({:g}, {:g}) m is too far away; allowed: coordinates of -10 to 10 m. Is the unit right?",
                            p.x, p.y));
}
void checkPoints(const std::vector<Vec2>& points, const std::string& key) {
  for (std::size_t k = 0; k < points.size(); ++k) checkPoint(points[k], fmt::format("{}[{}]", key, k));
}

double distance(Vec2 a, Vec2 b) { return std::hypot(b.x - a.x, b.y - a.y); }

struct CheckCurve {
  Vec2 start, end;
  std::string key;
  void operator()(const StraightEdge&) const {}
  void operator()(const BezierEdge& e) const {
    if (e.controls_m.empty() || e.controls_m.size() > 2)
      reject(key + ".bezier",
             fmt::format("has {} points; allowed: one (quadratic) or two (cubic)", e.controls_m.size()));
    checkPoints(e.controls_m, key + ".bezier");
  }
  void operator()(const ArcEdge& e) const {
    if (!(std::abs(e.turn_rad) >= 1e-9 && std::abs(e.turn_rad) < 2 * std::numbers::pi))
      reject(key + ".arc",
             fmt::format("turns by {:g} rad; allowed: up to a full circle (2 pi), and not 0", e.turn_rad));
    if (!(distance(start, end) > 0)) reject(key + ".arc", "ends where it starts; make two arcs of a circle");
    if (const double r = 0.5 * distance(start, end) / std::sin(0.5 * std::abs(e.turn_rad)); !(r < 1e3))
      reject(key + ".arc", fmt::format("has a radius of {:g} m; allowed: up to 1000 m", r));
  }
  void operator()(const SplineEdge& e) const {
    checkPoints(e.controls_m, key + ".spline.points");
    const NurbsCurve c = curveOf({"", start, e}, end);
    try {
      validate(c);
    } catch (const InputError& error) {
      reject(key + ".spline." + error.where().key, error.reason());
    }
    const auto& k = e.knots;
    const auto p = static_cast<std::size_t>(e.degree);
    if (k.front() != k[p] || k.back() != k[k.size() - 1 - p])
      reject(key + ".spline.knots",
             "must repeat the first and the last knot degree + 1 times: the curve runs from end "
             "to end");
    const auto [low, high] = std::minmax_element(c.weights.begin(), c.weights.end());
    if (*low * 1e6 < *high) reject(key + ".spline.weights", "differ by more than a factor of a million");
  }
  void operator()(const PolylineEdge& e) const { checkPoints(e.points_m, key + ".polyline"); }
};

/// Numbers and lengths of the edges of a loop.
void checkLoop(const Panel& panel, const PanelLoop& loop, const std::string& key) {
  if (loop.empty()) reject(key, named(panel) + "has no edges here; allowed: a closed chain of them");
  for (std::size_t k = 0; k < loop.size(); ++k) checkPoint(loop[k].start_m, fmt::format("{}[{}].start", key, k));
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::string edge = fmt::format("{}[{}]", key, k);
    const Vec2 end = loop[(k + 1) % loop.size()].start_m;
    std::visit(CheckCurve{loop[k].start_m, end, edge}, loop[k].curve);
    // Lengths are measured once the points are known to be few and near.
    double polygon = 0;
    const NurbsCurve curve = curveOf(loop[k], end);
    if (curve.points.size() > kMostPoints)
      reject(edge, fmt::format("has {} points; allowed: {}", curve.points.size(), kMostPoints));
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) polygon += distance(curve.points[i], curve.points[i + 1]);
    if (!(polygon >= kLeastEdge_m))
      reject(edge, named(panel) + fmt::format("has an edge without length at {}; remove it", inCm(loop[k].start_m)));
  }
}

/// A loop as lines, with the edge that each line is of. Points that follow each other are different.
struct Outline {
  std::vector<Vec2> points;
  std::vector<int> edge;
};
Outline drawn(const Panel& panel, const PanelLoop& loop, int first_edge, std::size_t& left, const std::string& key) {
  Outline out;
  for (std::size_t k = 0; k < loop.size(); ++k)
    for (const Vec2& p : flattened(loop[k], loop[(k + 1) % loop.size()].start_m, kFlat_m)) {
      if (!out.points.empty() && out.points.back().x == p.x && out.points.back().y == p.y) continue;
      if (left-- == 0)
        reject(key, named(panel) + fmt::format("takes more than {} points to draw; allowed: fewer. Simplify its curves",
                                               kMostPoints));
      out.points.push_back(p);
      out.edge.push_back(first_edge + static_cast<int>(k));
    }
  while (out.points.size() > 1 && out.points.front().x == out.points.back().x &&
         out.points.front().y == out.points.back().y) {
    out.points.pop_back();
    out.edge.pop_back();
  }
  return out;
}

struct Drawn {
  std::vector<std::vector<Vec2>> polygons;
  std::vector<std::vector<int>> edges;
};
Drawn drawn(const Panel& panel, const std::string& key) {
  Drawn all;
  std::size_t left = kMostPoints;
  int first = 0;
  for (std::size_t c = 0; c <= panel.cutouts.size(); ++c) {
    const PanelLoop& loop = c == 0 ? panel.outline : panel.cutouts[c - 1];
    Outline one = drawn(panel, loop, first, left, key);
    all.polygons.push_back(std::move(one.points));
    all.edges.push_back(std::move(one.edge));
    first += static_cast<int>(loop.size());
  }
  return all;
}

int edgeOfLine(const Drawn& d, int polygon, int line) {
  return d.edges[static_cast<std::size_t>(polygon)][static_cast<std::size_t>(line)];
}

/// Loops that cross themselves or each other.
void checkCrossings(const Panel& panel, const std::string& key) {
  const Drawn d = drawn(panel, key);
  const Meetings met = meetingsOf(d.polygons);
  if (met.crossing.empty()) return;
  const LineMeeting& m = met.crossing.front();
  const int a = edgeOfLine(d, m.polygon_a, m.line_a), b = edgeOfLine(d, m.polygon_b, m.line_b);
  const std::string which =
      a == b ? fmt::format("edge {} with itself", a) : fmt::format("edges {} and {}", std::min(a, b), std::max(a, b));
  reject(key,
         named(panel) + fmt::format("crosses itself at {}: {}. Mend the pattern where it is drawn", inCm(m.at), which));
}

void checkShape(const Panel& panel, const std::string& key) {
  const Drawn d = drawn(panel, key);
  const bool touches = !meetingsOf(d.polygons).touch.empty();
  for (std::size_t c = 0; c <= panel.cutouts.size(); ++c) {
    const double area = areaOf(c == 0 ? panel.outline : panel.cutouts[c - 1]);
    const std::string loop = c == 0 ? key + ".outline" : fmt::format("{}.cutouts[{}]", key, c - 1);
    if (!(std::abs(area) >= kLeastArea_m2))
      reject(loop, named(panel) + fmt::format("encloses {:.3g} cm^2 here; allowed: at least 0.01 cm^2", 1e4 * area));
    if ((area > 0) != (c == 0))
      reject(loop, named(panel) + (c == 0 ? "runs clockwise; allowed: counter-clockwise, seen from the right side"
                                          : "runs counter-clockwise; allowed: clockwise, around a hole"));
    if (c == 0) continue;
    for (std::size_t other = 0; other <= panel.cutouts.size(); ++other)
      if (other != c && (windingOf(d.polygons[other], d.polygons[c].front()) != 0) != (other == 0) && !touches)
        reject(loop, named(panel) + (other == 0 ? "has a cutout that does not lie inside of it"
                                                : "has a cutout inside of another one"));
  }
  if (!(areaOf(panel) >= kLeastArea_m2)) reject(key, named(panel) + "has no cloth left between its cutouts");
}

void checkMarks(const Panel& panel, const std::string& key) {
  const int edges = edgeCount(panel);
  for (std::size_t k = 0; k < panel.notches.size(); ++k) {
    const Notch& n = panel.notches[k];
    const std::string at = fmt::format("{}.notches[{}]", key, k);
    if (n.edge < 0 || n.edge >= edges)
      reject(at + ".edge", fmt::format("there is no edge {} of {}; allowed: 0 to {}", n.edge, named(panel), edges - 1));
    if (!(n.at >= 0 && n.at <= 1))
      reject(at + ".at", fmt::format("{:g} is no part of the edge; allowed: 0 to 1", n.at));
    if (!(n.depth_m >= 0 && n.depth_m <= 0.1))
      reject(at + ".depth", fmt::format("{:g} m; allowed: 0 to 0.1 m", n.depth_m));
  }
  if (panel.grain) {
    checkPoints({panel.grain->from_m, panel.grain->to_m}, key + ".grain");
    if (!(distance(panel.grain->from_m, panel.grain->to_m) > 0))
      reject(key + ".grain", named(panel) + "has a grain line without length");
  }
  for (std::size_t k = 0; k < panel.lines.size(); ++k) {
    const std::string at = fmt::format("{}.lines[{}]", key, k);
    if (panel.lines[k].points_m.empty()) reject(at + ".points", "is empty; allowed: at least one point");
    checkPoints(panel.lines[k].points_m, at + ".points");
  }
  for (std::size_t k = 0; k < panel.annotations.size(); ++k)
    checkPoint(panel.annotations[k].at_m, fmt::format("{}.annotations[{}].at", key, k));
  if (panel.placement) {
    const PanelPlace& p = *panel.placement;
    const double x2 = norm2(p.along_x), y2 = norm2(p.along_y), xy = dot(p.along_x, p.along_y);
    if (!(norm(p.origin_m) <= 100)) reject(key + ".placement.origin", "is more than 100 m away");
    if (!(std::abs(x2 - 1) < 1e-9 && std::abs(y2 - 1) < 1e-9 && std::abs(xy) < 1e-9))
      reject(key + ".placement", named(panel) + "needs along_x and along_y of length 1, at a right angle");
  }
  if (!(panel.quantity >= 1 && panel.quantity <= 1000))
    reject(key + ".quantity", fmt::format("{}; allowed: 1 to 1000", panel.quantity));
}

std::string seamText(const FlatPattern& pattern, std::size_t k) {
  const std::string& name = pattern.seams[k].name;
  return name.empty() ? fmt::format("seams[{}]", k) : "seam \"" + name + "\"";
}

void checkSeams(const FlatPattern& pattern) {
  std::map<std::pair<int, int>, std::vector<std::array<double, 3>>> taken;  // from, to, seam
  std::set<std::string> names;
  for (std::size_t s = 0; s < pattern.seams.size(); ++s) {
    const PanelSeam& seam = pattern.seams[s];
    const std::string key = fmt::format("seams[{}]", s);
    if (!seam.name.empty() && !names.insert(seam.name).second)
      reject(key + ".name", "\"" + seam.name + "\" names two seams; allowed: a name for each");
    if (!(seam.stiffness_N >= 0 && seam.stiffness_N <= 1e3))
      reject(key + ".stiffness", fmt::format("{:g} N; allowed: 0 to 1000 N", seam.stiffness_N));
    if (seam.open && seam.use != SeamUse::opening)
      reject(key + ".open", "is of a seam that can be opened; allowed: with \"use\": \"opening\"");
    if (seam.buttons > 0 && !seam.open)
      reject(key + ".buttons", "hold a seam that is open; allowed: with \"open\": true");
    if (seam.open && seam.stiffness_N > 0)
      reject(key + ".stiffness", "is of a seam that is sewn; allowed: 0, or without \"open\"");
    if (seam.rest_angle_rad != 0 && !(seam.stiffness_N > 0))
      reject(key + ".rest_angle", "is of a spring; allowed: with a stiffness above 0");
    for (const auto& [side, word] : {std::pair(&seam.a, "a"), std::pair(&seam.b, "b")}) {
      if (side->empty()) reject(key + "." + word, "is empty; allowed: at least one part of an edge");
      for (std::size_t k = 0; k < side->size(); ++k) {
        const SeamPart& part = (*side)[k];
        const std::string at = fmt::format("{}.{}[{}]", key, word, k);
        if (part.panel < 0 || part.panel >= static_cast<int>(pattern.panels.size()))
          reject(at, fmt::format("there is no panel {}; there are {}", part.panel, pattern.panels.size()));
        const Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
        if (part.edge < 0 || part.edge >= edgeCount(panel))
          reject(at, fmt::format("there is no edge {} of {}; allowed: 0 to {}", part.edge, named(panel),
                                 edgeCount(panel) - 1));
        if (!(part.from >= 0 && part.from <= 1 && part.to >= 0 && part.to <= 1))
          reject(at, fmt::format("from {:g} to {:g} is no part of the edge; allowed: 0 to 1", part.from, part.to));
        const double low = std::min(part.from, part.to), high = std::max(part.from, part.to);
        if (!(high - low >= 1e-6)) reject(at, "has no length");
        for (const auto& [from, to, other] : taken[{part.panel, part.edge}])
          if (std::min(high, to) - std::max(low, from) > 1e-9)
            reject(at, fmt::format("edge {} of {}is sewn already, by {}; allowed: one seam for each part of an edge",
                                   part.edge, named(panel), seamText(pattern, static_cast<std::size_t>(other))));
        taken[{part.panel, part.edge}].push_back({low, high, static_cast<double>(s)});
        if (seam.use == SeamUse::dart && part.panel != seam.a.front().panel)
          reject(at, "is of another panel; a dart joins a panel with itself");
      }
    }
  }
}

}  // namespace

void checkEdges(const Panel& panel, const std::string& key) {
  checkLoop(panel, panel.outline, key + ".outline");
  for (std::size_t c = 0; c < panel.cutouts.size(); ++c)
    checkLoop(panel, panel.cutouts[c], fmt::format("{}.cutouts[{}]", key, c));
  if (!panel.cut_line.empty()) checkLoop(panel, panel.cut_line, key + ".cut_line");
  checkCrossings(panel, key);
}

void checkPattern(const FlatPattern& pattern) {
  if (pattern.panels.empty()) reject("panels", "there is none; allowed: at least one");
  if (pattern.panels.size() > kMostPanels)
    reject("panels", fmt::format("there are {}; allowed: at most {}", pattern.panels.size(), kMostPanels));
  std::set<std::string> names;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const Panel& panel = pattern.panels[k];
    const std::string key = fmt::format("panels[{}]", k);
    if (panel.name.empty()) reject(key + ".name", "is empty; allowed: a name of its own");
    if (!names.insert(panel.name).second)
      reject(key + ".name", "\"" + panel.name + "\" names two panels; allowed: a name for each");
    checkEdges(panel, key);
    checkShape(panel, key);
    checkMarks(panel, key);
  }
  checkSeams(pattern);
}

std::vector<std::string> doubtsAbout(const FlatPattern& pattern) {
  std::vector<std::string> out;
  std::set<int> sewn;
  for (const PanelSeam& seam : pattern.seams) {
    const double a = lengthOf(pattern, seam.a), b = lengthOf(pattern, seam.b);
    if (std::max(a, b) > 1.2 * std::min(a, b))
      out.push_back(fmt::format("seam {}: {:.1f} cm are sewn to {:.1f} cm; gathered by {:.0f} %", seam.name, 100 * a,
                                100 * b, 100 * (std::max(a, b) / std::min(a, b) - 1)));
    for (const auto* side : {&seam.a, &seam.b})
      for (const SeamPart& part : *side) sewn.insert(part.panel);
  }
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const Panel& panel = pattern.panels[k];
    const Drawn d = drawn(panel, "");
    if (const Meetings met = meetingsOf(d.polygons); !met.touch.empty())
      out.push_back(fmt::format("{}touches itself at {}", named(panel), inCm(met.touch.front().at)));
    if (!pattern.seams.empty() && !sewn.contains(static_cast<int>(k))) out.push_back(named(panel) + "is in no seam");
  }
  return out;
}

}  // namespace gambeson
