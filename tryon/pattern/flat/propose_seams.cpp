#include "tryon/pattern/flat/propose_seams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double kShortest_m = 0.02, kNotchApart_m = 5e-3, kLengthShare = 0.035, kLength_m = 2e-3, kMirror = 1e-3,
                 kStraight = 0.03, kGoesOn = 0.4, kRound = 5e-3, kSameSide = 0.3, kWorst = 0.999, kUp = 0.8,
                 kAside = 0.7;
constexpr std::size_t kMostEdges = 1000;

struct Side {
  int panel, edge;
  double length_m;
  std::vector<double> notches;  ///< fractions, ascending, ends left out
  double start_rad, end_rad;    ///< angles of the cloth at its corners
  bool straight;                ///< nearly: its middle lies within 3 % of its length from the line between its ends
  bool hollow;                  ///< its middle lies further into the panel than that
  std::optional<Vec2> looks;    ///< which way it looks off the panel as that is worn, x to the right, y up

  bool isUp() const { return looks && looks->y > kUp; }
  bool isDown() const { return looks && looks->y < -kUp; }
  bool isAside() const { return !looks || std::abs(looks->x) > kAside; }
};

/// Up along the grain, by which a panel hangs: within 30 degrees of its y axis that way; of a panel that was drawn
/// lying as the grain line runs. None where it has no grain line, or is cut on the bias.
std::optional<Vec2> upOf(const Panel& panel) {
  if (!panel.grain) return std::nullopt;
  const Vec2 way{panel.grain->to_m.x - panel.grain->from_m.x, panel.grain->to_m.y - panel.grain->from_m.y};
  const double length = std::hypot(way.x, way.y), nearly = std::cos(std::numbers::pi / 6);
  if (std::max(std::abs(way.x), std::abs(way.y)) < nearly * length) return std::nullopt;
  const double sense = way.y < -nearly * length ? -1 : 1;
  return Vec2{sense * way.x / length, sense * way.y / length};
}

bool isStraight(const MeasuredCurve& c) {
  const Vec2 a = c.at(0).point, b = c.at(1).point, m = c.at(0.5).point;
  return std::hypot(m.x - 0.5 * (a.x + b.x), m.y - 0.5 * (a.y + b.y)) <= kStraight * c.length_m();
}

/// The cloth lies to the left of an edge.
bool isHollow(const MeasuredCurve& c) {
  const Vec2 a = c.at(0).point, b = c.at(1).point, m = c.at(0.5).point;
  return (b.x - a.x) * (m.y - a.y) - (b.y - a.y) * (m.x - a.x) >
         kStraight * c.length_m() * std::hypot(b.x - a.x, b.y - a.y);
}

std::optional<Vec2> looksOf(const MeasuredCurve& c, const std::optional<Vec2>& up) {
  const Vec2 a = c.at(0).point, b = c.at(1).point, off{b.y - a.y, a.x - b.x};
  const double length = std::hypot(off.x, off.y);
  if (!up || !(length > 0)) return std::nullopt;
  return Vec2{(off.x * up->y - off.y * up->x) / length, (off.x * up->x + off.y * up->y) / length};
}

double wayOf(Vec2 v) { return std::atan2(v.y, v.x); }

/// Of the cloth between the end of one edge and the start of the next, 0 to 2 pi.
double cornerAngle(const MeasuredCurve& in, const MeasuredCurve& out) {
  const Vec2 back = in.at(1).tangent, on = out.at(0).tangent;
  const double angle = wayOf({-back.x, -back.y}) - wayOf(on), full = 2 * std::numbers::pi;
  return std::fmod(angle + 2 * full, full);
}

void addSides(const Panel& panel, int number, std::vector<Side>& out) {
  const int n = static_cast<int>(panel.outline.size());
  std::vector<MeasuredCurve> curves;
  for (int e = 0; e < n; ++e) curves.emplace_back(curveOf(panel, e));
  const auto corner = [&](int e) {  // where edge e starts
    return cornerAngle(curves[static_cast<std::size_t>((e + n - 1) % n)], curves[static_cast<std::size_t>(e)]);
  };
  const std::optional<Vec2> up = upOf(panel);
  for (int e = 0; e < n; ++e) {
    const MeasuredCurve& curve = curves[static_cast<std::size_t>(e)];
    Side side{number,
              e,
              curve.length_m(),
              {},
              corner(e),
              corner((e + 1) % n),
              isStraight(curve),
              isHollow(curve),
              looksOf(curve, up)};
    for (const Notch& notch : panel.notches)
      if (notch.edge == e && notch.at > 1e-6 && notch.at < 1 - 1e-6) side.notches.push_back(notch.at);
    std::sort(side.notches.begin(), side.notches.end());
    out.push_back(std::move(side));
  }
}

/// Whether the lengths of a run backwards, from some edge on, are those of b: panels that are mirror images.
bool areImages(const std::vector<Side>& a, const std::vector<Side>& b) {
  const std::size_t n = a.size();
  if (b.size() != n) return false;
  for (std::size_t sum = 0; sum < n; ++sum) {
    bool same = true;
    for (std::size_t e = 0; same && e < n; ++e) {
      const double x = a[e].length_m, y = b[(sum + n - e) % n].length_m;
      same = std::abs(x - y) <= kMirror * std::max(x, y);
    }
    if (same) return true;
  }
  return false;
}

/// Whether both look to the same side, as no two edges of panels do that hang beside each other.
bool lookAlike(const Side& a, const Side& b) {
  return a.looks && b.looks && a.isAside() && b.isAside() && a.looks->x * b.looks->x > 0;
}

/// Whether two edges of one panel are sewn to each other, as those under the arm of a sleeve are: alike, with one edge
/// (the hem) between them, and with more of the panel on the other side than a fourth edge.
bool closesRound(const Side& a, const Side& b, std::size_t count) {
  const int n = static_cast<int>(count), apart = std::abs(a.edge - b.edge);
  return n > 4 && a.isAside() && b.isAside() && !lookAlike(a, b) && (apart == 2 || apart == n - 2) && a.straight &&
         b.straight && std::abs(a.length_m - b.length_m) <= kRound * a.length_m;
}

struct Pair {
  const Side *a, *b;
  double misfit;
};

/// Nothing where they cannot be sewn; the smaller the better.
std::optional<double> misfit(const Side& a, const Side& b, bool images) {
  const double allowed = std::max(kLength_m, kLengthShare * std::max(a.length_m, b.length_m));
  const double off = std::abs(a.length_m - b.length_m) / allowed;
  if (!(off < 1)) return std::nullopt;
  if (a.isDown() && b.isDown()) return std::nullopt;                      // hems, cuffs
  if (a.isUp() && b.isUp() && a.hollow && b.hollow) return std::nullopt;  // necks
  if (images && !(a.isAside() && b.isAside())) return std::nullopt;       // no centre lines
  const double corners = 0.5 * (std::abs(a.start_rad + b.end_rad - std::numbers::pi) +
                                std::abs(a.end_rad + b.start_rad - std::numbers::pi));
  const double fit = 0.5 * off + 0.5 * std::min(1.0, corners / std::numbers::pi) + (lookAlike(a, b) ? kSameSide : 0),
               within = std::min(kWorst, fit);  // of its sort, however bad
  if (images) return a.straight && b.straight ? std::optional(3 + within) : std::nullopt;
  if (a.notches.size() != b.notches.size()) return 2 + within;
  double apart = 0;
  for (std::size_t k = 0; k < a.notches.size(); ++k)
    apart =
        std::max(apart, std::abs(a.notches[k] * a.length_m - (1 - b.notches[b.notches.size() - 1 - k]) * b.length_m));
  if (apart > kNotchApart_m) return 2 + within;
  return a.notches.empty() ? 1 + within : 0.5 * within + 0.5 * apart / kNotchApart_m;
}

/// How many of the pair's neighbours are sewn to each other already, on both of its ends.
int neighboursSewn(const Pair& p, const std::vector<std::vector<Side>>& sides, const std::vector<PanelSeam>& seams) {
  const auto next = [&](const Side* s, int step) {
    const int n = static_cast<int>(sides[static_cast<std::size_t>(s->panel)].size());
    return (s->edge + step + n) % n;
  };
  int count = 0;
  for (const PanelSeam& seam : seams) {
    const SeamPart &a = seam.a.front(), &b = seam.b.front();
    for (const int step : {1, -1})
      count +=
          (a.panel == p.a->panel && a.edge == next(p.a, step) && b.panel == p.b->panel && b.edge == next(p.b, -step)) ||
          (b.panel == p.a->panel && b.edge == next(p.a, step) && a.panel == p.b->panel && a.edge == next(p.b, -step));
  }
  return count;
}

/// The best pair that is left, or null. `pairs` ascend; those that go on from a seam go before those that do not.
const Pair* bestOf(const std::vector<Pair>& pairs, const std::set<const Side*>& taken,
                   const std::vector<std::vector<Side>>& sides, const std::vector<PanelSeam>& seams) {
  const Pair* best = nullptr;
  double least = 1e300;
  for (const Pair& p : pairs) {
    if (p.misfit - 2 * kGoesOn >= least) break;
    if (taken.contains(p.a) || taken.contains(p.b)) continue;
    if (const double score = p.misfit - kGoesOn * neighboursSewn(p, sides, seams); score < least) {
      least = score;
      best = &p;
    }
  }
  return best;
}

}  // namespace

ProposedSeams proposeSeams(const FlatPattern& pattern) {
  std::vector<std::vector<Side>> sides(pattern.panels.size());
  std::size_t count = 0;
  for (const Panel& p : pattern.panels) count += p.outline.size();
  ProposedSeams out;
  if (count > kMostEdges) {
    out.edges_left = static_cast<int>(count);
    return out;
  }
  for (std::size_t p = 0; p < sides.size(); ++p) addSides(pattern.panels[p], static_cast<int>(p), sides[p]);
  std::vector<Pair> pairs;
  for (std::size_t p = 0; p < sides.size(); ++p)
    for (std::size_t q = p; q < sides.size(); ++q) {
      const bool images = p != q && areImages(sides[p], sides[q]);
      for (const Side& a : sides[p])
        for (const Side& b : sides[q])
          if (a.length_m >= kShortest_m && (p != q || (a.edge < b.edge && closesRound(a, b, sides[p].size()))))
            if (const auto off = misfit(a, b, images)) pairs.push_back({&a, &b, *off});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& s, const Pair& t) { return s.misfit < t.misfit; });
  std::set<const Side*> taken;
  for (const Pair* p = bestOf(pairs, taken, sides, out.seams); p; p = bestOf(pairs, taken, sides, out.seams)) {
    taken.insert({p->a, p->b});
    PanelSeam seam;
    seam.name = fmt::format("s{}", out.seams.size() + 1);
    seam.a = {{p->a->panel, p->a->edge, 0, 1}};
    seam.b = {{p->b->panel, p->b->edge, 1, 0}};
    seam.proposed = true;
    out.seams.push_back(std::move(seam));
  }
  out.edges_left = static_cast<int>(count - taken.size());
  return out;
}

}  // namespace gambeson
