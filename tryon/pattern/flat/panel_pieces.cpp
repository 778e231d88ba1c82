#include "tryon/pattern/flat/panel_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "tryon/pattern/flat/crossings.hpp"

namespace gambeson {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kOn_m = 1e-9;         ///< on a node
constexpr double kLeastAngle = 0.2;    ///< of a cut with both sides of its tip [rad]
constexpr double kLeastMeeting = 0.1;  ///< of a cut with what it ends at [rad]
constexpr double kNearNode = 0.1;      ///< of a cell: a cut that ends so near to a corner ends there

Vec2 minus(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
double length(Vec2 a) { return std::hypot(a.x, a.y); }
Vec2 along(double angle) { return {std::cos(angle), std::sin(angle)}; }
/// From a to b, counter-clockwise, in [0, 2 pi).
double turn(Vec2 a, Vec2 b) {
  const double angle = std::atan2(cross(a, b), dot(a, b));
  return angle < 0 ? angle + 2 * kPi : angle;
}

/// Where a polynomial in Bernstein form may vanish, by halving.
void roots(const std::vector<double>& c, double a, double b, std::vector<double>& out) {
  const auto [low, high] = std::minmax_element(c.begin(), c.end());
  if (*low > 0 || *high < 0) return;
  if (b - a < 1e-15) {
    out.push_back(0.5 * (a + b));
    return;
  }
  std::vector<double> left(c.size()), right(c.size()), d = c;
  const std::size_t n = d.size();
  for (std::size_t r = 0; r < n; ++r) {
    left[r] = d[0];
    right[n - 1 - r] = d[n - 1 - r];
    for (std::size_t i = 0; i + r + 1 < n; ++i) d[i] = 0.5 * (d[i] + d[i + 1]);
  }
  roots(left, a, 0.5 * (a + b), out);
  roots(right, 0.5 * (a + b), b, out);
}

/// The part [t0, t1] of a curve as a curve of its own; its ends are what they are said to be.
NurbsCurve partOf(const NurbsCurve& whole, double t0, double t1, Vec2 start, Vec2 end) {
  NurbsCurve out;
  if (t0 == whole.knots.front() && t1 == whole.knots.back()) {
    out = whole;
  } else {
    const std::vector<double> ends = breakpoints(whole.knots);
    const std::vector<BezierSegment> segments = bezierSegments(whole);
    const int p = whole.knots.degree;
    out.knots.degree = p;
    out.knots.knots.assign(static_cast<std::size_t>(p) + 1, t0);
    std::vector<Vec3> points;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const double low = std::max(t0, ends[s]), high = std::min(t1, ends[s + 1]), range = ends[s + 1] - ends[s];
      if (!(high - low > 1e-14 * range)) continue;
      // de Casteljau, to the right of low, then to the left of high.
      std::vector<Vec3> d = segments[s].points;
      const double a = (low - ends[s]) / range, b = (high - low) / (ends[s + 1] - low);
      for (int r = 1; r <= p; ++r)
        for (int i = 0; i + r <= p; ++i)
          d[static_cast<std::size_t>(i)] =
              (1 - a) * d[static_cast<std::size_t>(i)] + a * d[static_cast<std::size_t>(i + 1)];
      for (int r = 1; r <= p; ++r)
        for (int i = p; i >= r; --i)
          d[static_cast<std::size_t>(i)] =
              (1 - b) * d[static_cast<std::size_t>(i - 1)] + b * d[static_cast<std::size_t>(i)];
      if (!points.empty()) out.knots.knots.insert(out.knots.knots.end(), static_cast<std::size_t>(p), low);
      points.insert(points.end(), points.empty() ? d.begin() : d.begin() + 1, d.end());
    }
    out.knots.knots.insert(out.knots.knots.end(), static_cast<std::size_t>(p) + 1, t1);
    for (const Vec3& x : points) {
      out.weights.push_back(x.z);
      out.points.push_back({x.x / x.z, x.y / x.z});
    }
  }
  out.points.front() = start, out.points.back() = end;
  return out;
}

/// A stretch of an edge, or of a cut (edge < 0), between two nodes.
struct Arc {
  int edge = -1, cut = -1;
  double t0 = 0, t1 = 1;
  int start = 0, end = 0;
  bool hole = false;  ///< of a cutout
};

class Cutter {
 public:
  Cutter(const PanelBorder& border, double cell_m) : cell_m_(cell_m) {
    for (std::size_t l = 0; l < border.size(); ++l) {
      const int first = static_cast<int>(nodes_.size()), count = static_cast<int>(border[l].size());
      for (int k = 0; k < count; ++k) {
        const NurbsCurve& c = border[l][static_cast<std::size_t>(k)];
        nodes_.push_back(curvePoint(c, c.knots.front()).point);
        arcs_.push_back({static_cast<int>(edges_.size()), -1, c.knots.front(), c.knots.back(), first + k,
                         first + (k + 1) % count, l > 0});
        edges_.push_back(c);
      }
      std::vector<Vec2> drawn;
      for (const NurbsCurve& c : border[l]) {
        const int n = c.knots.degree == 1 ? 1 : 32;
        for (const double low : breakpoints(c.knots)) {
          const auto ends = breakpoints(c.knots);
          const auto next = std::upper_bound(ends.begin(), ends.end(), low);
          if (next == ends.end()) continue;
          for (int i = 0; i < n; ++i) drawn.push_back(curvePoint(c, low + (*next - low) * i / n).point);
        }
      }
      drawn_.push_back(std::move(drawn));
    }
  }

  /// The node at a place, made where it lies within an edge.
  int nodeAt(const BorderPlace& p) {
    const NurbsCurve& c = edges_[static_cast<std::size_t>(p.edge)];
    const double eps = 1e-9 * (c.knots.back() - c.knots.front());
    for (std::size_t a = 0; a < arcs_.size(); ++a) {
      if (arcs_[a].edge != p.edge || p.t < arcs_[a].t0 - eps || p.t > arcs_[a].t1 + eps) continue;
      if (p.t <= arcs_[a].t0 + eps) return arcs_[a].start;
      if (p.t >= arcs_[a].t1 - eps) return arcs_[a].end;
      return split(static_cast<int>(a), p.t, curvePoint(c, p.t).point);
    }
    return arcs_[0].start;
  }

  /// Cuts on through a tip. The tips at all nodes are known: a cut that comes near to one ends there.
  void cut(int tip, const SeamTip& of, std::span<const int> tip_nodes) {
    const int node = tip_nodes[static_cast<std::size_t>(tip)];
    const auto [out, in] = sidesAt(node);
    double room = turn(out, in);
    if (room < 1e-6) room = 2 * kPi;  // a needle
    for (const Arc& arc : arcs_)      // a cut that ends here is this one's as well
      if (arc.edge < 0 && arc.end == node) return;
    const double least = std::min(kLeastAngle, 0.25 * room);
    std::vector<std::pair<double, Vec2>> ways;  // and by how much they are off the middle
    const std::array<Vec2, 4> axes{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (const Vec2& axis : axes)
      if (const double at = turn(out, axis); at > least && at < room - least)
        ways.push_back({std::abs(at - 0.5 * room), axis});
    std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const double middle = std::atan2(out.y, out.x) + 0.5 * room;
    for (const double off : {0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4, -0.4})
      if (0.5 * room - std::abs(off) > least) ways.push_back({std::abs(off), along(middle + off)});
    for (const auto& [off, way] : ways) {
      std::vector<Meeting> met;
      if (!follow(node, way, tip_nodes, met)) continue;
      // Ends near a corner end there.
      const int near = nearNode(node, met.back());
      if (near >= 0 && met.size() == 1 && met.back().node < 0) {
        const Vec2 there = minus(nodes_[static_cast<std::size_t>(near)], nodes_[static_cast<std::size_t>(node)]);
        const double at = turn(out, there);
        std::vector<Meeting> other;
        if (at > least && at < room - least &&
            follow(node, {there.x / length(there), there.y / length(there)}, tip_nodes, other) && other.size() == 1 &&
            other.back().node == near)
          met = other;
      }
      draw(tip, node, way, met);
      return;
    }
    throw InputError({"", 0, ""}, "no straight cut leads on from the tip of seam " + of.seam + " to another border");
  }

  PanelPieces pieces(const std::vector<SeamTip>& tips) const;

 private:
  struct Half {
    int arc = 0;
    bool back = false;
  };
  struct Meeting {
    double far_m = 0;  ///< from the tip
    int arc = 0;
    double t = 0;
    int node = -1;  ///< that it is at
  };

  int startOf(Half h) const {
    const Arc& a = arcs_[static_cast<std::size_t>(h.arc)];
    return h.back ? a.end : a.start;
  }
  int endOf(Half h) const { return startOf({h.arc, !h.back}); }

  /// The direction in which an arc leaves its start, or its end backwards.
  Vec2 leaves(Half h) const {
    const Arc& a = arcs_[static_cast<std::size_t>(h.arc)];
    const Vec2 from = nodes_[static_cast<std::size_t>(startOf(h))];
    Vec2 way = minus(nodes_[static_cast<std::size_t>(endOf(h))], from);
    if (a.edge >= 0) {
      const double little = 1e-5 * (a.t1 - a.t0);
      way = minus(curvePoint(edges_[static_cast<std::size_t>(a.edge)], h.back ? a.t1 - little : a.t0 + little).point,
                  from);
    }
    const double l = length(way);
    return {way.x / l, way.y / l};
  }

  /// How the border leaves a node, and back from where it comes: the cloth lies between them, counter-clockwise.
  std::pair<Vec2, Vec2> sidesAt(int node) const {
    Vec2 out{}, in{};
    for (int a = 0; a < static_cast<int>(arcs_.size()); ++a) {
      if (arcs_[static_cast<std::size_t>(a)].edge < 0) continue;
      if (arcs_[static_cast<std::size_t>(a)].start == node) out = leaves({a, false});
      if (arcs_[static_cast<std::size_t>(a)].end == node) in = leaves({a, true});
    }
    return {out, in};
  }

  int split(int arc, double t, Vec2 at) {
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back(at);
    Arc rest = arcs_[static_cast<std::size_t>(arc)];
    arcs_[static_cast<std::size_t>(arc)].t1 = rest.t0 = t;
    arcs_[static_cast<std::size_t>(arc)].end = rest.start = node;
    arcs_.insert(arcs_.begin() + arc + 1, rest);
    return node;
  }

  /// What a ray from a node meets, up to where the cut ends; false where it does not leave the panel cleanly.
  bool follow(int node, Vec2 way, std::span<const int> tip_nodes, std::vector<Meeting>& out) const {
    const Vec2 from = nodes_[static_cast<std::size_t>(node)], side{-way.y, way.x};
    std::vector<Meeting> met;
    for (int a = 0; a < static_cast<int>(arcs_.size()); ++a) {
      const Arc& arc = arcs_[static_cast<std::size_t>(a)];
      std::vector<double> at;
      const NurbsCurve curve =
          arc.edge >= 0 ? edges_[static_cast<std::size_t>(arc.edge)]
                        : line(nodes_[static_cast<std::size_t>(arc.start)], nodes_[static_cast<std::size_t>(arc.end)]);
      const std::vector<double> ends = breakpoints(curve.knots);
      const std::vector<BezierSegment> segments = bezierSegments(curve);
      for (std::size_t s = 0; s < segments.size(); ++s) {
        std::vector<double> c, found;
        double most = 0;
        for (const Vec3& x : segments[s].points) {
          c.push_back(x.x * side.x + x.y * side.y - x.z * dot(from, side));
          most = std::max(most, std::abs(c.back()) / x.z);
        }
        if (most < 1e-12) return false;  // it runs along the ray
        roots(c, 0, 1, found);
        for (const double r : found) at.push_back(ends[s] + r * (ends[s + 1] - ends[s]));
      }
      const double t0 = arc.edge >= 0 ? arc.t0 : 0, t1 = arc.edge >= 0 ? arc.t1 : 1, little = 1e-12 * (t1 - t0);
      for (const double t : at) {
        if (t < t0 - little || t > t1 + little) continue;
        Meeting m{dot(minus(curvePoint(curve, t).point, from), way), a, t, -1};
        for (const int n : {arc.start, arc.end})
          if (length(minus(curvePoint(curve, t).point, nodes_[static_cast<std::size_t>(n)])) < kOn_m) m.node = n;
        if (m.far_m > 1e-6 && m.node != node) met.push_back(m);
      }
    }
    std::sort(met.begin(), met.end(), [](const Meeting& a, const Meeting& b) { return a.far_m < b.far_m; });
    for (const Meeting& m : met) {
      if (!out.empty() && m.far_m - out.back().far_m < kOn_m) {
        if (out.back().node < 0) out.back().node = m.node;
        continue;
      }
      if (!out.empty() && ends(out.back())) break;
      if (m.node >= 0 && arcs_[static_cast<std::size_t>(m.arc)].hole &&
          std::find(tip_nodes.begin(), tip_nodes.end(), m.node) == tip_nodes.end())
        return false;  // a corner of a cutout, neither through it nor past it
      out.push_back(m);
    }
    if (out.empty() || !ends(out.back())) return false;
    for (const Meeting& m : out) {
      const Arc& arc = arcs_[static_cast<std::size_t>(m.arc)];
      for (const Half h : {Half{m.arc, false}, Half{m.arc, true}}) {
        if (m.node >= 0 && startOf(h) != m.node) continue;
        Vec2 t = leaves(h);
        if (m.node < 0 && arc.edge >= 0) t = curvePoint(edges_[static_cast<std::size_t>(arc.edge)], m.t).tangent;
        if (!(std::abs(cross(t, way)) > kLeastMeeting * length(t))) return false;
      }
    }
    double start = 0;
    for (std::size_t k = 0; k < out.size(); k += 2) {
      const double middle = 0.5 * (start + out[k].far_m);
      if (!isCloth({from.x + middle * way.x, from.y + middle * way.y})) return false;
      if (k + 1 < out.size()) start = out[k + 1].far_m;
    }
    return out.size() % 2 == 1;
  }

  bool ends(const Meeting& m) const { return m.node >= 0 || !arcs_[static_cast<std::size_t>(m.arc)].hole; }

  bool isCloth(Vec2 p) const {
    int turns = 0;
    for (const std::vector<Vec2>& loop : drawn_) turns += windingOf(loop, p);
    return turns == 1;
  }

  /// The node nearest to where a cut ends, within a tenth of a cell; -1: none.
  int nearNode(int from, const Meeting& m) const {
    const Arc& arc = arcs_[static_cast<std::size_t>(m.arc)];
    const Vec2 at = pointAt(m);
    for (const int n : {arc.start, arc.end})
      if (n != from && length(minus(at, nodes_[static_cast<std::size_t>(n)])) < kNearNode * cell_m_) return n;
    return -1;
  }

  Vec2 pointAt(const Meeting& m) const {
    const Arc& arc = arcs_[static_cast<std::size_t>(m.arc)];
    if (m.node >= 0) return nodes_[static_cast<std::size_t>(m.node)];
    if (arc.edge >= 0) return curvePoint(edges_[static_cast<std::size_t>(arc.edge)], m.t).point;
    const Vec2 a = nodes_[static_cast<std::size_t>(arc.start)], b = nodes_[static_cast<std::size_t>(arc.end)];
    return {a.x + m.t * (b.x - a.x), a.y + m.t * (b.y - a.y)};
  }

  /// Makes the nodes and the arcs of a cut.
  void draw(int tip, int node, Vec2 way, const std::vector<Meeting>& met) {
    std::vector<int> stops{node};
    // From the farthest on, so that the numbers of arcs before them stay.
    std::vector<std::size_t> order(met.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(met[a].arc, met[a].t) > std::pair(met[b].arc, met[b].t);
    });
    std::vector<int> at(met.size());
    const Vec2 from = nodes_[static_cast<std::size_t>(node)];
    for (const std::size_t k : order) {
      Vec2 p = pointAt(met[k]);
      if (way.x == 0) p.x = from.x;  // to the bit, for the knot line that follows it
      if (way.y == 0) p.y = from.y;
      at[k] = met[k].node;
      if (at[k] < 0)
        at[k] = split(met[k].arc, met[k].t, p);
      else if (length(minus(p, nodes_[static_cast<std::size_t>(at[k])])) < kOn_m)
        nodes_[static_cast<std::size_t>(at[k])] = p;
    }
    stops.insert(stops.end(), at.begin(), at.end());
    for (std::size_t k = 0; k + 1 < stops.size(); k += 2) {
      Arc arc;
      arc.cut = static_cast<int>(cuts_.size());
      arc.start = stops[k], arc.end = stops[k + 1];
      arcs_.push_back(arc);
      cuts_.push_back(tip);
    }
  }

  double cell_m_;
  std::vector<NurbsCurve> edges_;
  std::vector<Vec2> nodes_;
  std::vector<Arc> arcs_;
  std::vector<int> cuts_;                 ///< the tip of each
  std::vector<std::vector<Vec2>> drawn_;  ///< the loops as lines
};

PanelPieces Cutter::pieces(const std::vector<SeamTip>& tips) const {
  // Round every face: at each node on along the arc that turns most to the left.
  std::vector<std::vector<Half>> leaving(nodes_.size());
  std::vector<Half> all;
  for (int a = 0; a < static_cast<int>(arcs_.size()); ++a)
    for (const bool back : {false, true}) {
      if (back && arcs_[static_cast<std::size_t>(a)].edge >= 0) continue;
      all.push_back({a, back});
      leaving[static_cast<std::size_t>(startOf(all.back()))].push_back(all.back());
    }
  const auto id = [](Half h) { return static_cast<std::size_t>(2 * h.arc + (h.back ? 1 : 0)); };
  std::vector<int> face_of(2 * arcs_.size(), -1);
  std::vector<std::vector<Half>> loops;
  for (const Half first : all) {
    if (face_of[id(first)] >= 0) continue;
    std::vector<Half> loop;
    for (Half h = first; face_of[id(h)] < 0;) {
      face_of[id(h)] = static_cast<int>(loops.size());
      loop.push_back(h);
      const std::vector<Half>& choices = leaving[static_cast<std::size_t>(endOf(h))];
      const Vec2 back = leaves({h.arc, !h.back});
      Half best = choices.front();
      double least = 1e300;
      for (const Half c : choices) {
        if (c.arc == h.arc && choices.size() > 1) continue;
        const double clockwise = 2 * kPi - turn(back, leaves(c));
        if (clockwise < least) least = clockwise, best = c;
      }
      h = best;
    }
    loops.push_back(std::move(loop));
  }
  // Their curves, and which of them are holes in which.
  std::vector<std::vector<NurbsCurve>> curves(loops.size());
  std::vector<std::vector<Vec2>> drawn(loops.size());
  std::vector<double> area(loops.size(), 0.0);
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (const Half h : loops[l]) {
      const Arc& a = arcs_[static_cast<std::size_t>(h.arc)];
      const Vec2 start = nodes_[static_cast<std::size_t>(startOf(h))], end = nodes_[static_cast<std::size_t>(endOf(h))];
      curves[l].push_back(a.edge >= 0 ? partOf(edges_[static_cast<std::size_t>(a.edge)], a.t0, a.t1, start, end)
                                      : line(start, end));
      const NurbsCurve& c = curves[l].back();
      const int n = 32 * std::max(1, static_cast<int>(breakpoints(c.knots).size()) - 1);
      for (int i = 0; i < n; ++i)
        drawn[l].push_back(curvePoint(c, c.knots.front() + (c.knots.back() - c.knots.front()) * i / n).point);
    }
    for (std::size_t k = 0; k < drawn[l].size(); ++k)
      area[l] += 0.5 * cross(drawn[l][k], drawn[l][(k + 1) % drawn[l].size()]);
  }
  PanelPieces out;
  std::vector<int> piece(loops.size(), -1);
  for (std::size_t l = 0; l < loops.size(); ++l)
    if (area[l] > 0) {
      piece[l] = static_cast<int>(out.borders.size());
      out.borders.push_back({curves[l]});
    }
  for (std::size_t l = 0; l < loops.size(); ++l) {
    if (area[l] > 0) continue;
    double smallest = 1e300;
    for (std::size_t o = 0; o < loops.size(); ++o)
      if (area[o] > 0 && area[o] < smallest && windingOf(drawn[o], drawn[l].front()) != 0)
        smallest = area[o], piece[l] = piece[o];
    if (piece[l] >= 0) out.borders[static_cast<std::size_t>(piece[l])].push_back(curves[l]);
  }
  const auto pieceOf = [&](Half h) { return piece[static_cast<std::size_t>(face_of[id(h)])]; };
  for (int a = 0; a < static_cast<int>(arcs_.size()); ++a) {
    const Arc& arc = arcs_[static_cast<std::size_t>(a)];
    if (arc.edge >= 0) {
      out.parts.push_back({pieceOf({a, false}), {arc.edge, arc.t0, arc.t1}});
      continue;
    }
    const int tip = cuts_[static_cast<std::size_t>(arc.cut)];
    const Vec2 from = nodes_[static_cast<std::size_t>(arc.start)], to = nodes_[static_cast<std::size_t>(arc.end)];
    out.cuts.push_back({from, to, pieceOf({a, false}), pieceOf({a, true}), tip, from.x == to.x, from.y == to.y});
    if (out.cuts.back().left == out.cuts.back().right)
      throw InputError({"", 0, ""}, "the tip of seam " + tips[static_cast<std::size_t>(tip)].seam +
                                        " lies at a cutout, and a cut from there leaves the panel in one piece; "
                                        "allowed: tips at its outline, or two at a cutout that face away from each "
                                        "other");
  }
  return out;
}

}  // namespace

PanelPieces cutPanel(const PanelBorder& border, const std::vector<SeamTip>& tips, double cell_m) {
  Cutter cutter(border, cell_m);
  std::vector<int> nodes;
  for (const SeamTip& tip : tips) nodes.push_back(cutter.nodeAt(tip.at));
  for (std::size_t k = 0; k < tips.size(); ++k) cutter.cut(static_cast<int>(k), tips[k], nodes);
  return cutter.pieces(tips);
}

}  // namespace gambeson
