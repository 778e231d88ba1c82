#include "core/nurbs/trim_arcs.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

std::string keyOf(int loop, int curve = -1) {
  std::string key = "loops[" + std::to_string(loop) + "]";
  return curve < 0 ? key : key + ".curves[" + std::to_string(curve) + "]";
}
[[noreturn]] void reject(int loop, int curve, const std::string& reason) {
  throw InputError({"", 0, keyOf(loop, curve)}, reason);
}

std::string text(Vec2 p) { return std::string("(").append(std::to_string(p.x)) + ", " + std::to_string(p.y) + ")"; }

double binomial(int n, int k) {
  double b = 1;
  for (int i = 1; i <= k; ++i) b = b * (n - k + i) / i;
  return b;
}

/// Bernstein coefficients of X' W - X W' on [0, 1], X the homogeneous coordinate `axis` taken from the segment's
/// start: its sign is that of the derivative of the coordinate. All zero where the coordinate is constant.
std::vector<double> slopeNumerator(const BezierSegment& s, int axis) {
  const int p = static_cast<int>(s.points.size()) - 1;
  std::vector<double> X(p + 1), W(p + 1);
  double size = 0;
  const double origin = s.points[0][axis] / s.points[0].z;
  for (int i = 0; i <= p; ++i) {
    W[i] = s.points[i].z;
    X[i] = W[i] * (s.points[i][axis] / W[i] - origin);
    size = std::max(size, std::abs(s.points[i][axis] / W[i]));
  }
  std::vector<double> c(2 * p, 0.0);
  double weight = 0;
  for (int k = 0; k < 2 * p; ++k)
    for (int i = 0; i < p; ++i) {
      const int j = k - i;
      if (j < 0 || j > p) continue;
      const double factor = p * binomial(p - 1, i) * binomial(p, j) / binomial(2 * p - 1, k);
      c[k] += factor * ((X[i + 1] - X[i]) * W[j] - X[j] * (W[i + 1] - W[i]));
      weight = std::max(weight, W[i + 1] * W[j]);
    }
  const double noise = 1e-14 * p * size * weight;
  double largest = 0;
  for (double v : c) largest = std::max(largest, std::abs(v));
  if (largest <= 4 * noise) std::fill(c.begin(), c.end(), 0.0);
  return c;
}

/// Roots in (0, 1) of a polynomial in Bernstein form, by halving until the signs change at most once (Descartes' rule).
/// More points than roots may come back, at halvings that meet a root; missing is none that changes the sign.
void bernsteinRoots(const std::vector<double>& c, double a, double b, std::vector<double>& out) {
  int changes = 0;
  double last = 0;
  for (double v : c) {
    if (v == 0) continue;
    if (last != 0 && (v > 0) != (last > 0)) ++changes;
    last = v;
  }
  if (changes == 0) return;
  const auto split = [](const std::vector<double>& from, double t, std::vector<double>& left,
                        std::vector<double>& right) {
    std::vector<double> d = from;
    const std::size_t n = d.size();
    left.resize(n);
    right.resize(n);
    for (std::size_t r = 0; r < n; ++r) {
      left[r] = d[0];
      right[n - 1 - r] = d[n - 1 - r];
      for (std::size_t i = 0; i + r + 1 < n; ++i) d[i] = (1 - t) * d[i] + t * d[i + 1];
    }
  };
  if (b - a < 1e-15) {
    out.push_back(0.5 * (a + b));
    return;
  }
  std::vector<double> left, right;
  if (changes == 1 && c.front() != 0 && c.back() != 0) {
    // One simple change: bisection on the polynomial itself.
    double low = 0, high = 1;
    for (int k = 0; k < 60 && high - low > 1e-16; ++k) {
      const double mid = 0.5 * (low + high);
      split(c, mid, left, right);
      if (right[0] == 0) {
        low = high = mid;
        break;
      }
      ((right[0] > 0) == (c.front() > 0) ? low : high) = mid;
    }
    out.push_back(a + (b - a) * 0.5 * (low + high));
    return;
  }
  split(c, 0.5, left, right);
  const double mid = 0.5 * (a + b);
  bernsteinRoots(left, a, mid, out);
  if (right[0] == 0) out.push_back(mid);
  bernsteinRoots(right, mid, b, out);
}

double coordinate(Vec2 p, int axis) { return axis == 0 ? p.x : p.y; }

/// Nearest line within eps, or the value itself. Monotone in the value.
double snap(double value, std::span<const double> lines, double eps) {
  const auto it = std::lower_bound(lines.begin(), lines.end(), value);
  if (it != lines.end() && *it - value <= eps) return *it;
  if (it != lines.begin() && value - *(it - 1) <= eps) return *(it - 1);
  return value;
}

/// Whether two arcs meet elsewhere than within `near` of a point that they share.
class Crossing {
 public:
  Crossing(const TrimBoundary& b, const MonotoneArc& f, const MonotoneArc& g) : b_(b), f_(f), g_(g) {
    near_u_ = 1e-6 * (b.u1 - b.u0);
    near_v_ = 1e-6 * (b.v1 - b.v0);
  }
  bool find(std::vector<Vec2> shared) {
    shared_ = std::move(shared);
    return search(f_.t0, f_.t1, f_.a, f_.b, g_.t0, g_.t1, g_.a, g_.b);
  }
  Vec2 where() const { return where_; }

 private:
  static bool apart(double a0, double a1, double b0, double b1, double eps) {
    return std::max(a0, a1) < std::min(b0, b1) - eps || std::max(b0, b1) < std::min(a0, a1) - eps;
  }
  bool nearShared(Vec2 p) const {
    for (Vec2 s : shared_)
      if (std::abs(p.x - s.x) <= near_u_ && std::abs(p.y - s.y) <= near_v_) return true;
    return false;
  }
  bool search(double f0, double f1, Vec2 fa, Vec2 fb, double g0, double g1, Vec2 ga, Vec2 gb) {
    // Monotone pieces lie in the box of their ends.
    if (apart(fa.x, fb.x, ga.x, gb.x, b_.eps_u) || apart(fa.y, fb.y, ga.y, gb.y, b_.eps_v)) return false;
    if (nearShared(fa) && nearShared(fb)) return false;
    if (nearShared(ga) && nearShared(gb)) return false;
    const auto extent = [&](Vec2 p, Vec2 q) {
      return std::max(std::abs(p.x - q.x) / (b_.u1 - b_.u0), std::abs(p.y - q.y) / (b_.v1 - b_.v0));
    };
    const double f_size = extent(fa, fb), g_size = extent(ga, gb);
    if (f_size < 1e-9 && g_size < 1e-9) {
      where_ = fa;
      return true;
    }
    if (f_size >= g_size) {
      const double mid = 0.5 * (f0 + f1);
      const Vec2 m = b_.point(f_, mid);
      return search(f0, mid, fa, m, g0, g1, ga, gb) || search(mid, f1, m, fb, g0, g1, ga, gb);
    }
    const double mid = 0.5 * (g0 + g1);
    const Vec2 m = b_.point(g_, mid);
    return search(f0, f1, fa, fb, g0, mid, ga, m) || search(f0, f1, fa, fb, mid, g1, m, gb);
  }

  const TrimBoundary& b_;
  const MonotoneArc &f_, &g_;
  double near_u_, near_v_;
  std::vector<Vec2> shared_;
  Vec2 where_;
};

void checkCrossings(const TrimBoundary& b) {
  const int n = static_cast<int>(b.arcs.size());
  const auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const MonotoneArc &f = b.arcs[i], &g = b.arcs[j];
      const auto &sf = b.segments[f.segment], &sg = b.segments[g.segment];
      std::vector<Vec2> shared;
      if (sf.loop == sg.loop) {
        const int first = b.first_arc[sf.loop], count = b.first_arc[sf.loop + 1] - first;
        if ((i - first + 1) % count == j - first && same(f.b, g.a)) shared.push_back(f.b);
        if ((j - first + 1) % count == i - first && same(g.b, f.a)) shared.push_back(g.b);
      }
      Crossing crossing(b, f, g);
      if (!crossing.find(shared)) continue;
      if (sf.loop == sg.loop)
        reject(sg.loop, sg.index,
               "meets curve " + std::to_string(sf.index) + " of its own loop at " + text(crossing.where()) +
                   "; a loop may not cross or touch itself");
      reject(sg.loop, sg.index,
             "meets " + keyOf(sf.loop, sf.index) + " at " + text(crossing.where()) +
                 "; loops may not cross or touch each other");
    }
}

void checkNesting(const TrimBoundary& b) {
  for (std::size_t loop = 0; loop + 1 < b.first_arc.size(); ++loop) {
    const int number = static_cast<int>(loop);
    const MonotoneArc& arc = b.arcs[b.first_arc[loop]];
    const int around = b.winding(b.point(arc, 0.5 * (arc.t0 + arc.t1)), number);
    if (b.signed_area[loop] > 0 && around != 0)
      reject(number, -1, "runs counter-clockwise (its inside is kept) but lies where the patch is kept already");
    if (b.signed_area[loop] < 0 && around != 1)
      reject(number, -1, "runs clockwise (a hole) but lies where nothing is kept");
  }
}

}  // namespace

CurvePoint TrimBoundary::at(const MonotoneArc& arc, double t) const {
  CurvePoint c = segments[arc.segment].curve.at(t);
  c.point.x = std::clamp(c.point.x, arc.lowU(), arc.highU());
  c.point.y = std::clamp(c.point.y, arc.lowV(), arc.highV());
  return c;
}

Vec2 TrimBoundary::point(const MonotoneArc& arc, double t) const {
  return t <= arc.t0 ? arc.a : t >= arc.t1 ? arc.b : at(arc, t).point;
}

double TrimBoundary::solve(const MonotoneArc& arc, int axis, double value) const {
  double low = arc.t0, high = arc.t1;
  const double at_low = coordinate(arc.a, axis) - value, at_high = coordinate(arc.b, axis) - value;
  if (at_low == 0 || at_low == at_high) return low;
  if (at_high == 0) return high;
  const bool rising = at_high > at_low;
  double t = low + (high - low) * std::clamp(at_low / (at_low - at_high), 0.0, 1.0);
  for (int k = 0; k < 100; ++k) {  // Newton, kept within the bracket by halving
    const CurvePoint c = segments[arc.segment].curve.at(t);
    const double error = coordinate(c.point, axis) - value, slope = coordinate(c.tangent, axis);
    if (std::abs(error) <= 1e-16 * std::abs(slope)) return t;
    ((error > 0) == rising ? high : low) = t;
    const double next = t - error / slope;
    t = next > low && next < high && k % 8 != 7 ? next : 0.5 * (low + high);
    if (!(high - low > 1e-16)) return t;
  }
  return t;
}

int TrimBoundary::winding(Vec2 p, int skip) const {
  int turns = rectangle_is_outline ? 1 : 0;
  for (const MonotoneArc& arc : arcs) {
    if (segments[arc.segment].loop == skip) continue;
    if (!(arc.lowV() <= p.y && p.y < arc.highV())) continue;
    double u = arc.a.x;
    if (p.x > arc.highU()) continue;
    if (p.x >= arc.lowU()) {
      u = point(arc, solve(arc, 1, p.y)).x;
      if (u < p.x) continue;
    }
    turns += arc.b.y > arc.a.y ? 1 : -1;
  }
  return turns;
}

bool TrimBoundary::isKept(Vec2 p) const {
  for (const MonotoneArc& arc : arcs) {
    if (p.x < arc.lowU() - eps_u || p.x > arc.highU() + eps_u || p.y < arc.lowV() - eps_v || p.y > arc.highV() + eps_v)
      continue;
    for (int axis : {0, 1}) {
      const double low = axis == 0 ? arc.lowU() : arc.lowV(), high = axis == 0 ? arc.highU() : arc.highV();
      const Vec2 c = point(arc, solve(arc, axis, std::clamp(coordinate(p, axis), low, high)));
      if (std::abs(c.x - p.x) <= eps_u && std::abs(c.y - p.y) <= eps_v) return true;
    }
  }
  return winding(p) > 0;
}

TrimBoundary trimBoundary(const NurbsPatch& patch, const Trim& trim) {
  TrimBoundary b;
  b.u0 = patch.u.front(), b.u1 = patch.u.back(), b.v0 = patch.v.front(), b.v1 = patch.v.back();
  const double range_u = b.u1 - b.u0, range_v = b.v1 - b.v0;
  b.eps_u = 1e-11 * range_u, b.eps_v = 1e-11 * range_v;
  const double loose_u = 1e-9 * range_u, loose_v = 1e-9 * range_v;
  const auto inside = [&](Vec2 p) {
    return p.x >= b.u0 - loose_u && p.x <= b.u1 + loose_u && p.y >= b.v0 - loose_v && p.y <= b.v1 + loose_v;
  };
  const auto onto = [&](Vec2 p) {
    const std::array<double, 2> u{b.u0, b.u1}, v{b.v0, b.v1};
    return Vec2{std::clamp(snap(p.x, u, loose_u), b.u0, b.u1), std::clamp(snap(p.y, v, loose_v), b.v0, b.v1)};
  };
  b.first_arc.push_back(0);
  for (int loop = 0; loop < static_cast<int>(trim.loops.size()); ++loop) {
    const TrimLoop& curves = trim.loops[loop];
    if (curves.empty()) reject(loop, -1, "holds no curve");
    for (int k = 0; k < static_cast<int>(curves.size()); ++k) try {
        validate(curves[k]);
      } catch (const InputError& e) {
        throw InputError({"", 0, keyOf(loop, k) + "." + e.where().key}, e.reason());
      }
    Vec2 last{};
    bool started = false;
    for (int k = 0; k < static_cast<int>(curves.size()); ++k) {
      const int next = (k + 1) % static_cast<int>(curves.size());
      const Vec2 end = curvePoint(curves[k], curves[k].knots.back()).point,
                 start = curvePoint(curves[next], curves[next].knots.front()).point;
      if (!(std::abs(end.x - start.x) <= loose_u && std::abs(end.y - start.y) <= loose_v))
        reject(loop, k,
               "ends at " + text(end) + " but curve " + std::to_string(next) + " starts at " + text(start) +
                   "; a loop must be closed");
      double length = 0;
      for (BezierSegment& bezier : bezierSegments(curves[k])) {
        std::vector<double> cuts{0.0, 1.0};
        for (int axis : {0, 1}) bernsteinRoots(slopeNumerator(bezier, axis), 0, 1, cuts);
        std::sort(cuts.begin(), cuts.end());
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
          MonotoneArc arc{static_cast<int>(b.segments.size()), cuts[c], cuts[c + 1], bezier.at(cuts[c]).point,
                          bezier.at(cuts[c + 1]).point,        false};
          for (Vec2 p : {arc.a, arc.b})
            if (!inside(p))
              reject(loop, k,
                     "leaves the patch at " + text(p) +
                         "; a loop stays within: where it cuts the border, let it run along the border "
                         "(a notch: a chain of curves, one of them a straight line on the border)");
          arc.a = started ? last : onto(arc.a);
          arc.b = onto(arc.b);
          if (std::abs(arc.a.x - arc.b.x) <= b.eps_u && std::abs(arc.a.y - arc.b.y) <= b.eps_v) continue;
          length += std::abs(arc.a.x - arc.b.x) / range_u + std::abs(arc.a.y - arc.b.y) / range_v;
          started = true;
          last = arc.b;
          b.arcs.push_back(arc);
        }
        b.segments.push_back({std::move(bezier), loop, k});
      }
      if (!(length > 1e-8)) reject(loop, k, "has no length");
    }
    const int first = b.first_arc.back();
    b.arcs.back().b = b.arcs[first].a;
    b.first_arc.push_back(static_cast<int>(b.arcs.size()));
    for (int k = first; k < b.first_arc.back(); ++k) {
      const int before = k > first ? k - 1 : b.first_arc.back() - 1;
      const Vec2 in = b.at(b.arcs[before], b.arcs[before].t1).tangent, out = b.at(b.arcs[k], b.arcs[k].t0).tangent;
      const double turn = in.x * out.y - in.y * out.x, along = in.x * out.x + in.y * out.y;
      b.arcs[k].corner = !(std::abs(turn) <= 1e-6 * along);
    }
    // Area by Green's theorem, 1/2 ∮ u dv - v du, from chords (its sign is all that matters).
    double area = 0;
    for (int k = first; k < b.first_arc.back(); ++k) {
      const MonotoneArc& arc = b.arcs[k];
      constexpr int pieces = 8;
      Vec2 from = arc.a;
      for (int piece = 1; piece <= pieces; ++piece) {
        const Vec2 to = b.point(arc, arc.t0 + (arc.t1 - arc.t0) * piece / pieces);
        area += 0.5 * ((from.x - b.u0) * (to.y - b.v0) - (to.x - b.u0) * (from.y - b.v0));
        from = to;
      }
    }
    if (!(std::abs(area) > 1e-12 * range_u * range_v)) reject(loop, -1, "encloses no area");
    b.signed_area.push_back(area);
    if (area > 0) b.rectangle_is_outline = false;
  }
  checkCrossings(b);
  checkNesting(b);
  return b;
}

GridArcs splitAtGrid(const TrimBoundary& b, std::span<const double> us, std::span<const double> vs) {
  GridArcs out;
  out.first_arc.push_back(0);
  const auto onto = [&](Vec2 p) { return Vec2{snap(p.x, us, b.eps_u), snap(p.y, vs, b.eps_v)}; };
  for (std::size_t loop = 0; loop + 1 < b.first_arc.size(); ++loop) {
    Vec2 last{};
    bool started = false, corner = false;
    for (int k = b.first_arc[loop]; k < b.first_arc[loop + 1]; ++k) {
      const MonotoneArc& arc = b.arcs[k];
      corner = corner || arc.corner;
      struct Cut {
        double t;
        Vec2 at;
      };
      std::vector<Cut> cuts;
      for (int axis : {0, 1}) {
        const std::span<const double> lines = axis == 0 ? us : vs;
        const double eps = axis == 0 ? b.eps_u : b.eps_v;
        const double low = axis == 0 ? arc.lowU() : arc.lowV(), high = axis == 0 ? arc.highU() : arc.highV();
        for (auto it = std::upper_bound(lines.begin(), lines.end(), low + eps); it != lines.end() && *it < high - eps;
             ++it) {
          const double t = b.solve(arc, axis, *it);
          Vec2 at = b.point(arc, t);
          (axis == 0 ? at.x : at.y) = *it;
          cuts.push_back({t, onto(at)});
        }
      }
      std::sort(cuts.begin(), cuts.end(), [](const Cut& x, const Cut& y) { return x.t < y.t; });
      cuts.push_back({arc.t1, onto(arc.b)});
      Vec2 from = onto(arc.a);
      if (started) from = last;
      double t = arc.t0;
      for (const Cut& cut : cuts) {
        if (std::abs(cut.at.x - from.x) <= b.eps_u && std::abs(cut.at.y - from.y) <= b.eps_v) continue;
        out.arcs.push_back({arc.segment, t, cut.t, from, cut.at, corner});
        corner = false;
        started = true;
        from = last = cut.at;
        t = cut.t;
      }
    }
    if (static_cast<int>(out.arcs.size()) > out.first_arc.back()) out.arcs.back().b = out.arcs[out.first_arc.back()].a;
    out.first_arc.push_back(static_cast<int>(out.arcs.size()));
  }
  return out;
}

std::array<int, 2> gridCell(const MonotoneArc& arc, std::span<const double> us, std::span<const double> vs) {
  const auto cell = [](double a, double b, std::span<const double> lines) {
    const int at = static_cast<int>(std::upper_bound(lines.begin(), lines.end(), 0.5 * (a + b)) - lines.begin()) - 1;
    if (a == b && at >= 0 && lines[at] == a) return -1;  // along a grid line
    return std::clamp(at, 0, static_cast<int>(lines.size()) - 2);
  };
  const int i = cell(arc.a.x, arc.b.x, us), j = cell(arc.a.y, arc.b.y, vs);
  return i < 0 || j < 0 ? std::array<int, 2>{-1, -1} : std::array<int, 2>{i, j};
}

}  // namespace gambeson
