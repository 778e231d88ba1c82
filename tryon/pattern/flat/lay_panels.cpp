#include "tryon/pattern/flat/lay_panels.hpp"

#include <algorithm>
#include <cmath>

#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr int kPairs = 32;
constexpr double kFlat_m = 5e-4;
constexpr double kLying = 0.5;       ///< sine of 30 degrees
constexpr double kLevels_m = 0.005;  ///< between heights at which widths are compared

/// A side of a seam by fractions of its length.
class MeasuredSide {
 public:
  MeasuredSide(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
    for (const SeamPart& part : side) {
      const Panel& panel = pattern.panels[static_cast<std::size_t>(part.panel)];
      pieces_.push_back({part, MeasuredCurve(curveOf(panel, part.edge)), 0});
      length_ += std::abs(part.to - part.from) * pieces_.back().curve.length_m();
      pieces_.back().end_m = length_;
    }
  }
  double length_m() const { return length_; }
  /// Panel, point and outward normal: the cloth lies to the left of every edge.
  void at(double fraction, int& panel, Vec2& x, Vec2& n) const {
    const double s = fraction * length_;
    double start = 0;
    for (const Piece& p : pieces_) {
      if (s <= p.end_m || &p == &pieces_.back()) {
        const double t = std::clamp((s - start) / (p.end_m - start), 0.0, 1.0);
        const CurvePoint c = p.curve.at(p.part.from + t * (p.part.to - p.part.from));
        panel = p.part.panel;
        x = c.point;
        n = {c.tangent.y, -c.tangent.x};
        return;
      }
      start = p.end_m;
    }
  }

 private:
  struct Piece {
    SeamPart part;
    MeasuredCurve curve;
    double end_m;
  };
  std::vector<Piece> pieces_;
  double length_ = 0;
};

/// What a horizontal line through a polygon meets: its crossings' x, ascending.
std::vector<double> crossingsAt(const std::vector<Vec2>& polygon, double y) {
  std::vector<double> x;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y < y) == (b.y < y)) continue;
    x.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(x.begin(), x.end());
  return x;
}

/// The same with x and y exchanged, for going up and down.
LaidPanel lying(const LaidPanel& p) {
  LaidPanel out = p;
  for (Vec2& x : out.outline) x = {x.y, x.x};
  return out;
}

double past(const LaidPanel& a, const LaidPanel& b, Vec2 way, double gap_m) {
  return way.x != 0 ? wayPast(a, b, way.x > 0 ? 1 : -1, gap_m) : wayPast(lying(a), lying(b), way.y > 0 ? 1 : -1, gap_m);
}

/// Whether they share a point, or are nearer than the gap at one height.
bool meet(const LaidPanel& a, const LaidPanel& b, double gap_m) {
  const double low = std::max(a.low().y, b.low().y), high = std::min(a.high().y, b.high().y);
  for (double y = low + 0.5 * kLevels_m; y < high; y += kLevels_m) {
    const std::vector<double> of_a = crossingsAt(a.outline, y), of_b = crossingsAt(b.outline, y);
    for (std::size_t i = 0; i + 1 < of_a.size(); i += 2)
      for (std::size_t k = 0; k + 1 < of_b.size(); k += 2)
        if (of_a[i] < of_b[k + 1] + gap_m && of_b[k] < of_a[i + 1] + gap_m) return true;
  }
  return false;
}

}  // namespace

SeamPair turned(const SeamPair& p) { return {p.b, p.a, p.xb, p.xa, p.nb, p.na, p.length_m}; }

std::vector<SeamPair> seamPairs(const FlatPattern& pattern) {
  std::vector<SeamPair> out;
  for (const PanelSeam& seam : pattern.seams) {
    const MeasuredSide a(pattern, seam.a), b(pattern, seam.b);
    for (int k = 0; k < kPairs; ++k) {
      SeamPair& p = out.emplace_back();
      a.at((k + 0.5) / kPairs, p.a, p.xa, p.na);
      b.at((k + 0.5) / kPairs, p.b, p.xb, p.nb);
      p.length_m = 0.5 * (a.length_m() + b.length_m()) / kPairs;
    }
  }
  return out;
}

void LaidPanel::move(Vec2 by) {
  at.x += by.x, at.y += by.y;
  for (Vec2& x : outline) x.x += by.x, x.y += by.y;
}
Vec2 LaidPanel::low() const {
  Vec2 v{1e300, 1e300};
  for (const Vec2& x : outline) v = {std::min(v.x, x.x), std::min(v.y, x.y)};
  return v;
}
Vec2 LaidPanel::high() const {
  Vec2 v{-1e300, -1e300};
  for (const Vec2& x : outline) v = {std::max(v.x, x.x), std::max(v.y, x.y)};
  return v;
}

LaidPanel upright(const FlatPattern& pattern, int k, std::span<const SeamPair> pairs, std::span<const int> sleeve) {
  const Panel& panel = pattern.panels[static_cast<std::size_t>(k)];
  LaidPanel laid;
  laid.panel = k;
  if (panel.grain) {
    Vec2 d{panel.grain->to_m.x - panel.grain->from_m.x, panel.grain->to_m.y - panel.grain->from_m.y};
    const double length = std::hypot(d.x, d.y);
    d = {d.x / length, d.y / length};
    if (std::abs(d.x) < kLying) {
      laid.up = d.y > 0 ? d : Vec2{-d.x, -d.y};
    } else if (std::abs(d.y) < kLying) {
      // Where its border is sewn, against its middle.
      const PanelBox box = boxOf(panel.outline);
      const double middle = 0.5 * (d.x * (box.low.x + box.high.x) + d.y * (box.low.y + box.high.y));
      double above = 0;
      const auto add = [&](int of, Vec2 x, double length_m) {
        if (of == k) above += length_m * (d.x * x.x + d.y * x.y - middle);
      };
      for (const SeamPair& p : pairs) add(p.a, p.xa, p.length_m), add(p.b, p.xb, p.length_m);
      laid.up = above >= 0 ? d : Vec2{-d.x, -d.y};
    }
  }
  if (!panel.grain && !sleeve.empty()) {
    const PanelBox box = boxOf(panel.outline);
    Vec2 to{};
    const auto add = [&](int of, int other, Vec2 x, double length_m) {
      if (of != k || std::find(sleeve.begin(), sleeve.end(), other) != sleeve.end()) return;
      to = {to.x + length_m * (x.x - 0.5 * (box.low.x + box.high.x)),
            to.y + length_m * (x.y - 0.5 * (box.low.y + box.high.y))};
    };
    for (const SeamPair& p : pairs) add(p.a, p.b, p.xa, p.length_m), add(p.b, p.a, p.xb, p.length_m);
    laid.up = std::abs(to.x) > std::abs(to.y) ? Vec2{to.x > 0 ? 1.0 : -1.0, 0} : Vec2{0, to.y < 0 ? -1.0 : 1.0};
  }
  laid.right = {laid.up.y, -laid.up.x};
  for (const Vec2 x : flattened(panel.outline, kFlat_m)) laid.outline.push_back(laid.of(x));
  return laid;
}

double wayPast(const LaidPanel& a, const LaidPanel& b, int sense, double gap_m) {
  const double low = std::max(a.low().y, b.low().y), high = std::min(a.high().y, b.high().y);
  double way = 0;
  for (double y = low + 0.5 * kLevels_m; y < high; y += kLevels_m) {
    const std::vector<double> of_a = crossingsAt(a.outline, y), of_b = crossingsAt(b.outline, y);
    if (of_a.empty() || of_b.empty()) continue;
    way = std::max(way, gap_m + (sense > 0 ? of_a.back() - of_b.front() : of_b.back() - of_a.front()));
  }
  return way;
}

double widthAt(const LaidPanel& panel, double height) {
  const std::vector<double> x = crossingsAt(panel.outline, height);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.size(); i += 2) sum += x[i + 1] - x[i];
  return sum;
}

std::vector<LaidPart> layPanels(const FlatPattern& pattern, std::span<const LaidPanel> panels,
                                std::span<const SeamPair> pairs, double gap_m) {
  std::vector<LaidPanel> left(panels.begin(), panels.end());
  const auto area = [&](const LaidPanel& p) { return areaOf(pattern.panels[static_cast<std::size_t>(p.panel)]); };
  std::stable_sort(left.begin(), left.end(), [&](const auto& p, const auto& q) { return area(p) > area(q); });
  std::vector<LaidPart> parts;
  while (!left.empty()) {
    LaidPart part{left.front()};
    left.erase(left.begin());
    while (true) {
      // The next one is that which most seam holds to those that lie.
      std::size_t next = left.size();
      double most = 0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        double held = 0;
        for (const SeamPair& p : pairs)
          for (const LaidPanel& q : part)
            if ((p.a == q.panel && p.b == left[i].panel) || (p.b == q.panel && p.a == left[i].panel))
              held += p.length_m;
        if (held > most) most = held, next = i;
      }
      if (next == left.size()) break;
      LaidPanel b = left[next];
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
      Vec2 to{}, out{};
      for (const SeamPair& given : pairs)
        for (const LaidPanel& q : part) {
          const SeamPair p = given.a == b.panel ? turned(given) : given;
          if (p.a != q.panel || p.b != b.panel) continue;
          const Vec2 xa = q.of(p.xa), xb = b.of(p.xb), na = q.turn(p.na), nb = b.turn(p.nb);
          const double w = p.length_m / most;
          to = {to.x + w * (xa.x - xb.x), to.y + w * (xa.y - xb.y)};
          out = {out.x + w * (na.x - nb.x), out.y + w * (na.y - nb.y)};
        }
      b.move(to);
      const Vec2 way =
          std::abs(out.x) >= std::abs(out.y) ? Vec2{out.x >= 0 ? 1.0 : -1.0, 0} : Vec2{0, out.y >= 0 ? 1.0 : -1.0};
      const auto push = [&](const LaidPanel& q) {
        const double by = past(q, b, way, gap_m);
        b.move({by * way.x, by * way.y});
      };
      for (const LaidPanel& q : part)
        if (std::any_of(pairs.begin(), pairs.end(), [&](const SeamPair& p) {
              return (p.a == q.panel && p.b == b.panel) || (p.b == q.panel && p.a == b.panel);
            }))
          push(q);
      for (std::size_t round = 0; round < part.size(); ++round)
        for (const LaidPanel& q : part)
          if (meet(q, b, 0.5 * gap_m)) push(q);
      part.push_back(std::move(b));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace gambeson
