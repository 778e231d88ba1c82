#include "tryon/pattern/flat/panel_geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

const Quadrature& rule() {
  static const Quadrature sixteen = gaussLegendre(16);
  return sixteen;
}

double speed(const BezierSegment& b, double t) {
  const Vec2 d = b.at(t).tangent;
  return std::hypot(d.x, d.y);
}

double lengthBetween(const BezierSegment& b, double t0, double t1) {
  double sum = 0;
  for (std::size_t k = 0; k < rule().points.size(); ++k)
    sum += rule().weights[k] * speed(b, t0 + (t1 - t0) * rule().points[k]);
  return (t1 - t0) * sum;
}

/// ∫ (x dy - y dx) / 2, seen from `origin`.
double areaBetween(const BezierSegment& b, double t0, double t1, Vec2 origin) {
  double sum = 0;
  for (std::size_t k = 0; k < rule().points.size(); ++k) {
    const CurvePoint c = b.at(t0 + (t1 - t0) * rule().points[k]);
    sum += rule().weights[k] * ((c.point.x - origin.x) * c.tangent.y - (c.point.y - origin.y) * c.tangent.x);
  }
  return 0.5 * (t1 - t0) * sum;
}

/// f over [t0, t1], in halves until these agree with the whole.
template <class F>
double refined(const F& f, double t0, double t1, double whole, double tolerance, int depth) {
  const double t = 0.5 * (t0 + t1), a = f(t0, t), b = f(t, t1);
  if (depth == 0 || std::abs(a + b - whole) <= tolerance) return a + b;
  return refined(f, t0, t, a, 0.5 * tolerance, depth - 1) + refined(f, t, t1, b, 0.5 * tolerance, depth - 1);
}
constexpr int kDeepest = 12;
constexpr double kAgree = 1e-13;

/// Where length is measured by one rule: [t0, t1] in halves.
void split(const BezierSegment& b, double t0, double t1, double length, double tolerance, int depth,
           std::vector<std::array<double, 3>>& out) {
  const double t = 0.5 * (t0 + t1), first = lengthBetween(b, t0, t), second = lengthBetween(b, t, t1);
  if (depth == 0 || std::abs(first + second - length) <= tolerance) {
    out.push_back({t0, t1, length});
    return;
  }
  split(b, t0, t, first, 0.5 * tolerance, depth - 1, out);
  split(b, t, t1, second, 0.5 * tolerance, depth - 1, out);
}

NurbsCurve arc(Vec2 a, Vec2 b, double turn) {
  const Vec2 chord{b.x - a.x, b.y - a.y};
  const double lift = 0.5 / std::tan(0.5 * turn);
  const Vec2 center{0.5 * (a.x + b.x) - lift * chord.y, 0.5 * (a.y + b.y) + lift * chord.x};
  const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / (0.5 * std::numbers::pi) - 1e-12)));
  const double step = turn / pieces, w = std::cos(0.5 * step);
  const Vec2 from{a.x - center.x, a.y - center.y};
  const auto turned = [&](double angle, double stretch) {
    const double c = std::cos(angle), s = std::sin(angle);
    return Vec2{center.x + stretch * (c * from.x - s * from.y), center.y + stretch * (s * from.x + c * from.y)};
  };
  NurbsCurve out{{2, {0, 0, 0}}, {a}, {1}};
  for (int k = 0; k < pieces; ++k) {
    out.points.push_back(turned((k + 0.5) * step, 1 / w));
    out.weights.push_back(w);
    out.points.push_back(k + 1 == pieces ? b : turned((k + 1) * step, 1));
    out.weights.push_back(1);
    for (int i = 0; i < (k + 1 == pieces ? 3 : 2); ++i) out.knots.knots.push_back(k + 1.0);
  }
  return out;
}

struct ToCurve {
  Vec2 start, end;
  NurbsCurve operator()(const StraightEdge&) const { return line(start, end); }
  NurbsCurve operator()(const BezierEdge& e) const {
    const std::size_t p = e.controls_m.size() + 1;
    NurbsCurve c{{static_cast<int>(p), {}}, {start}, std::vector<double>(p + 1, 1.0)};
    c.points.insert(c.points.end(), e.controls_m.begin(), e.controls_m.end());
    c.points.push_back(end);
    c.knots.knots.assign(p + 1, 0.0);
    c.knots.knots.insert(c.knots.knots.end(), p + 1, 1.0);
    return c;
  }
  NurbsCurve operator()(const ArcEdge& e) const { return arc(start, end, e.turn_rad); }
  NurbsCurve operator()(const SplineEdge& e) const {
    NurbsCurve c{{e.degree, e.knots}, {start}, e.weights};
    c.points.insert(c.points.end(), e.controls_m.begin(), e.controls_m.end());
    c.points.push_back(end);
    if (c.weights.empty()) c.weights.assign(c.points.size(), 1.0);
    return c;
  }
  NurbsCurve operator()(const PolylineEdge& e) const {
    NurbsCurve c{{1, {0}}, {start}, std::vector<double>(e.points_m.size() + 2, 1.0)};
    c.points.insert(c.points.end(), e.points_m.begin(), e.points_m.end());
    c.points.push_back(end);
    for (std::size_t k = 0; k < c.points.size(); ++k) c.knots.knots.push_back(static_cast<double>(k));
    c.knots.knots.push_back(c.knots.knots.back());
    return c;
  }
};

Vec2 plane(const Vec3& h) { return {h.x / h.z, h.y / h.z}; }

double distanceToLine(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d{b.x - a.x, b.y - a.y};
  const double d2 = d.x * d.x + d.y * d.y;
  const double t = d2 > 0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / d2, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * d.x, p.y - a.y - t * d.y);
}

/// Adds the start of the curve and points inside of it. A curve lies in the hull of its points (weights are positive).
void flatten(const std::vector<Vec3>& points, double tolerance_m, int depth, std::vector<Vec2>& out) {
  const Vec2 a = plane(points.front()), b = plane(points.back());
  double off = 0;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) off = std::max(off, distanceToLine(plane(points[k]), a, b));
  if (!(off > tolerance_m) || depth == 0) {
    out.push_back(a);
    return;
  }
  // De Casteljau at the middle: the first and the last points of each round are those of the halves.
  std::vector<Vec3> round = points, left, right;
  while (true) {
    left.push_back(round.front());
    right.push_back(round.back());
    if (round.size() == 1) break;
    for (std::size_t k = 0; k + 1 < round.size(); ++k) round[k] = 0.5 * (round[k] + round[k + 1]);
    round.pop_back();
  }
  std::reverse(right.begin(), right.end());
  flatten(left, tolerance_m, depth - 1, out);
  flatten(right, tolerance_m, depth - 1, out);
}

}  // namespace

int edgeCount(const Panel& panel) {
  std::size_t n = panel.outline.size();
  for (const PanelLoop& c : panel.cutouts) n += c.size();
  return static_cast<int>(n);
}

namespace {

/// The loop that an edge lies in, its number there, and the number of the loop's first edge.
struct InLoop {
  const PanelLoop* loop;
  int index, first;
};
InLoop inLoop(const Panel& panel, int edge) {
  int first = 0, size = static_cast<int>(panel.outline.size());
  const PanelLoop* loop = &panel.outline;
  for (std::size_t k = 0; edge >= first + size && k < panel.cutouts.size(); ++k) {
    first += size;
    loop = &panel.cutouts[k];
    size = static_cast<int>(loop->size());
  }
  return {loop, edge - first, first};
}

int modulo(int a, std::size_t n) { return (a + static_cast<int>(n)) % static_cast<int>(n); }

}  // namespace

const PanelEdge& edgeOf(const Panel& panel, int edge) {
  const InLoop at = inLoop(panel, edge);
  return (*at.loop)[static_cast<std::size_t>(at.index)];
}
int edgeBefore(const Panel& panel, int edge) {
  const InLoop at = inLoop(panel, edge);
  return at.first + modulo(at.index - 1, at.loop->size());
}
int edgeAfter(const Panel& panel, int edge) {
  const InLoop at = inLoop(panel, edge);
  return at.first + modulo(at.index + 1, at.loop->size());
}
Vec2 edgeEnd(const Panel& panel, int edge) { return edgeOf(panel, edgeAfter(panel, edge)).start_m; }

NurbsCurve curveOf(const PanelEdge& edge, Vec2 end) { return std::visit(ToCurve{edge.start_m, end}, edge.curve); }
NurbsCurve curveOf(const Panel& panel, int edge) { return curveOf(edgeOf(panel, edge), edgeEnd(panel, edge)); }
std::vector<NurbsCurve> curvesOf(const PanelLoop& loop) {
  std::vector<NurbsCurve> out;
  for (std::size_t k = 0; k < loop.size(); ++k) out.push_back(curveOf(loop[k], loop[(k + 1) % loop.size()].start_m));
  return out;
}

MeasuredCurve::MeasuredCurve(const NurbsCurve& curve) : start_m_{0} {
  const std::vector<double> ends = breakpoints(curve.knots);
  const std::vector<BezierSegment> segments = bezierSegments(curve);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::vector<std::array<double, 3>> parts;
    const double length = lengthBetween(segments[s], 0, 1);
    split(segments[s], 0, 1, length, kAgree * length, kDeepest, parts);
    for (const auto& [t0, t1, part] : parts) {
      const double span = ends[s + 1] - ends[s];
      pieces_.push_back({segments[s], t0, t1, ends[s] + span * t0, ends[s] + span * t1});
      start_m_.push_back(start_m_.back() + part);
    }
  }
}

std::pair<const MeasuredCurve::Piece*, double> MeasuredCurve::find(double fraction) const {
  const double s = std::clamp(fraction, 0.0, 1.0) * length_m();
  const auto after = std::upper_bound(start_m_.begin() + 1, start_m_.end() - 1, s);
  const std::size_t k = static_cast<std::size_t>(after - start_m_.begin()) - 1;
  const Piece& piece = pieces_[k];
  const double wanted = s - start_m_[k], whole = start_m_[k + 1] - start_m_[k];
  if (!(wanted > 0)) return {&piece, piece.t0};
  if (!(wanted < whole)) return {&piece, piece.t1};
  double low = piece.t0, high = piece.t1, t = low + (high - low) * wanted / whole;
  for (int k2 = 0; k2 < 60; ++k2) {  // Newton, halving where it leaves what is left
    const double over = lengthBetween(piece.curve, piece.t0, t) - wanted;
    (over > 0 ? high : low) = t;
    const double v = speed(piece.curve, t);
    double next = v > 0 ? t - over / v : low - 1;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - t) <= 1e-15 * std::max(1.0, std::abs(t))) break;
    t = next;
  }
  return {&piece, t};
}

CurvePoint MeasuredCurve::at(double fraction) const {
  const auto [piece, t] = find(fraction);
  CurvePoint c = piece->curve.at(t);
  double v = std::hypot(c.tangent.x, c.tangent.y);
  if (!(v > 0)) {  // a control point on the end: the way to a point beside it
    const double inside = t + 1e-6 * (0.5 * (piece->t0 + piece->t1) - t);
    const Vec2 q = piece->curve.at(inside).point;
    const double sense = inside > t ? 1 : -1;
    c.tangent = {sense * (q.x - c.point.x), sense * (q.y - c.point.y)};
    v = std::hypot(c.tangent.x, c.tangent.y);
  }
  c.tangent = {c.tangent.x / v, c.tangent.y / v};
  return c;
}

double MeasuredCurve::parameterAt(double fraction) const {
  const auto [piece, t] = find(fraction);
  return piece->u0 + (piece->u1 - piece->u0) * (t - piece->t0) / (piece->t1 - piece->t0);
}

MeasuredCurve::Nearest MeasuredCurve::nearest(Vec2 p) const {
  const auto distance = [&](const Piece& piece, double t) {
    const Vec2 q = piece.curve.at(t).point;
    return std::hypot(q.x - p.x, q.y - p.y);
  };
  constexpr int samples = 16;
  double best = 1e300, best_t = 0;
  std::size_t best_piece = 0;
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const Piece& piece = pieces_[k];
    double low = piece.t0, high = piece.t1, nearest = 1e300;
    for (int i = 0; i <= samples; ++i) {
      const double t = piece.t0 + (piece.t1 - piece.t0) * i / samples, d = distance(piece, t);
      if (d < nearest) {
        nearest = d;
        low = std::max(piece.t0, t - (piece.t1 - piece.t0) / samples);
        high = std::min(piece.t1, t + (piece.t1 - piece.t0) / samples);
      }
    }
    if (nearest > best + 2 * (start_m_[k + 1] - start_m_[k])) continue;
    for (int i = 0; i < 100 && high - low > 1e-14; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(piece, a) < distance(piece, b) ? high : low) = distance(piece, a) < distance(piece, b) ? b : a;
    }
    const double t = 0.5 * (low + high);
    for (const double u : {piece.t0, t, piece.t1})
      if (const double d = distance(piece, u); d < best) {
        best = d;
        best_t = u;
        best_piece = k;
      }
  }
  const Piece& piece = pieces_[best_piece];
  const double s = start_m_[best_piece] + lengthBetween(piece.curve, piece.t0, best_t);
  return {std::clamp(s / length_m(), 0.0, 1.0), best};
}

double lengthOf(const Panel& panel, int edge) { return MeasuredCurve(curveOf(panel, edge)).length_m(); }

double lengthOf(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
  double sum = 0;
  for (const SeamPart& part : side)
    sum += std::abs(part.to - part.from) * lengthOf(pattern.panels[static_cast<std::size_t>(part.panel)], part.edge);
  return sum;
}

double perimeterOf(const PanelLoop& loop) {
  double sum = 0;
  for (const NurbsCurve& c : curvesOf(loop)) sum += MeasuredCurve(c).length_m();
  return sum;
}

double areaOf(const PanelLoop& loop) {
  if (loop.empty()) return 0;
  const Vec2 origin = loop.front().start_m;
  double sum = 0;
  for (const NurbsCurve& c : curvesOf(loop))
    for (const BezierSegment& b : bezierSegments(c)) {
      const auto part = [&](double t0, double t1) { return areaBetween(b, t0, t1, origin); };
      const double whole = part(0, 1);
      sum += b.points.size() == 2 ? whole : refined(part, 0, 1, whole, kAgree * std::abs(whole), kDeepest);
    }
  return sum;
}

double areaOf(const Panel& panel) {
  double sum = areaOf(panel.outline);
  for (const PanelLoop& c : panel.cutouts) sum += areaOf(c);
  return sum;
}

std::vector<Vec2> flattened(const PanelEdge& edge, Vec2 end, double tolerance_m) {
  std::vector<Vec2> out;
  for (const BezierSegment& b : bezierSegments(curveOf(edge, end))) flatten(b.points, tolerance_m, 20, out);
  return out;
}

std::vector<Vec2> flattened(const PanelLoop& loop, double tolerance_m) {
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::vector<Vec2> more = flattened(loop[k], loop[(k + 1) % loop.size()].start_m, tolerance_m);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

PanelBox boxOf(const PanelLoop& loop) {
  PanelBox box{{1e300, 1e300}, {-1e300, -1e300}};
  for (const Vec2& p : flattened(loop, 1e-4)) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

}  // namespace gambeson
