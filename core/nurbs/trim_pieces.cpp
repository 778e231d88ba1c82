#include "core/nurbs/trim_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

// The cell is divided into slabs at the ends of its arcs. In a slab the arcs, monotone, run from side to side and do
// not meet, so that they bound bands, kept and not kept in turn (the kept side of an arc lies to its left). A band
// between an arc and a straight line across is one piece,
//   (t, s) -> (x(t), y_line + s (y(t) - y_line)),  Jacobian |x'(t)| |y(t) - y_line|,
// smooth also where the arc turns along the slab's side; one between two arcs is halved by a line where one fits
// between them, else taken as a graph over x where both arcs are flat enough, else the slab is halved.
// `axis` 0: slabs across u (x = u, y = v); 1: across v (x = v, y = u).
struct Strand {
  const MonotoneArc* arc;
  double ta, tb;  ///< at the slab's left and right side
  double ya, yb, y_mid;
  bool kept_above;
};

struct Piece {
  enum class Kind { box, arc_to_line, between } kind = Kind::box;
  double xa = 0, xb = 0;  ///< of the slab
  double ya = 0, yb = 0;  ///< box: lower and upper side; arc_to_line: ya is the line
  Strand lower{}, upper{};
};

class Slabs {
 public:
  Slabs(const TrimBoundary& b, std::span<const MonotoneArc> arcs, int axis, std::array<double, 2> x,
        std::array<double, 2> y)
      : b_(b), arcs_(arcs), axis_(axis), x_(x), y_(y) {
    eps_x_ = axis == 0 ? b.eps_u : b.eps_v;
    eps_y_ = axis == 0 ? b.eps_v : b.eps_u;
  }

  std::vector<Piece> pieces() {
    std::vector<double> sides{x_[0], x_[1]};
    for (const MonotoneArc& arc : arcs_)
      for (Vec2 p : {arc.a, arc.b}) sides.push_back(x(p));
    std::sort(sides.begin(), sides.end());
    double from = sides.front();
    for (double to : sides) {
      if (to - from <= eps_x_) continue;
      slab(from, to, 0);
      from = to;
    }
    return std::move(out_);
  }

 private:
  double x(Vec2 p) const { return axis_ == 0 ? p.x : p.y; }
  double y(Vec2 p) const { return axis_ == 0 ? p.y : p.x; }

  void slab(double xa, double xb, int depth) {
    std::vector<Strand> strands;
    for (const MonotoneArc& arc : arcs_) {
      const double low = std::min(x(arc.a), x(arc.b)), high = std::max(x(arc.a), x(arc.b)), mid = 0.5 * (xa + xb);
      if (!(low < mid && high > mid)) continue;
      const bool rightwards = x(arc.b) > x(arc.a);
      Strand s{&arc, 0, 0, 0, 0, 0, axis_ == 0 ? rightwards : !rightwards};
      s.ta = b_.solve(arc, axis_, std::clamp(xa, low, high));
      s.tb = b_.solve(arc, axis_, std::clamp(xb, low, high));
      s.ya = y(b_.point(arc, s.ta));
      s.yb = y(b_.point(arc, s.tb));
      s.y_mid = y(b_.point(arc, b_.solve(arc, axis_, mid)));
      strands.push_back(s);
    }
    std::sort(strands.begin(), strands.end(), [](const Strand& f, const Strand& g) { return f.y_mid < g.y_mid; });
    for (std::size_t k = 0; k + 1 < strands.size(); ++k)
      if (strands[k].kept_above == strands[k + 1].kept_above)
        throw InputError({"", 0, "loops"}, "arcs cross within a cell of the patch");
    if (strands.empty()) {
      const Vec2 mid{0.5 * (xa + xb), 0.5 * (y_[0] + y_[1])};
      if (b_.winding(axis_ == 0 ? mid : Vec2{mid.y, mid.x}) > 0) box(xa, xb, y_[0], y_[1]);
      return;
    }
    if (!strands.front().kept_above) toLine(xa, xb, strands.front(), y_[0]);
    if (strands.back().kept_above) toLine(xa, xb, strands.back(), y_[1]);
    for (std::size_t k = 0; k + 1 < strands.size(); ++k)
      if (strands[k].kept_above) between(xa, xb, strands[k], strands[k + 1], depth);
  }

  void box(double xa, double xb, double ya, double yb) {
    if (!out_.empty() && out_.back().kind == Piece::Kind::box && out_.back().xb == xa && out_.back().ya == ya &&
        out_.back().yb == yb)
      out_.back().xb = xb;
    else if (yb - ya > eps_y_)
      out_.push_back({Piece::Kind::box, xa, xb, ya, yb, {}, {}});
  }

  void toLine(double xa, double xb, const Strand& s, double line) {
    const double furthest = std::max(std::abs(s.ya - line), std::abs(s.yb - line));
    if (furthest > eps_y_) out_.push_back({Piece::Kind::arc_to_line, xa, xb, line, line, s, {}});
  }

  void between(double xa, double xb, const Strand& lower, const Strand& upper, int depth) {
    const double top_of_lower = std::max(lower.ya, lower.yb), bottom_of_upper = std::min(upper.ya, upper.yb);
    if (bottom_of_upper >= top_of_lower - eps_y_) {
      const double line = 0.5 * (top_of_lower + bottom_of_upper);
      toLine(xa, xb, lower, line);
      toLine(xa, xb, upper, line);
      return;
    }
    if (depth >= 12 || (isFlat(lower) && isFlat(upper))) {
      out_.push_back({Piece::Kind::between, xa, xb, 0, 0, lower, upper});
      return;
    }
    // Halve this band alone: the same two arcs on both halves.
    const double mid = 0.5 * (xa + xb);
    const auto cut = [&](const Strand& s, bool left) {
      Strand half = s;
      const double t = b_.solve(*s.arc, axis_, mid);
      (left ? half.tb : half.ta) = t;
      (left ? half.yb : half.ya) = s.y_mid;
      half.y_mid = y(b_.point(*s.arc, b_.solve(*s.arc, axis_, left ? 0.5 * (xa + mid) : 0.5 * (mid + xb))));
      return half;
    };
    between(xa, mid, cut(lower, true), cut(upper, true), depth + 1);
    between(mid, xb, cut(lower, false), cut(upper, false), depth + 1);
  }

  /// Whether t(x) is smooth: dx/dt varies little over the strand.
  bool isFlat(const Strand& s) const {
    double least = 1e300, most = 0;
    for (int k = 0; k <= 4; ++k) {
      const double speed = std::abs(x(b_.at(*s.arc, s.ta + 0.25 * k * (s.tb - s.ta)).tangent));
      least = std::min(least, speed);
      most = std::max(most, speed);
    }
    return least > 0.3 * most;
  }

  const TrimBoundary& b_;
  std::span<const MonotoneArc> arcs_;
  int axis_;
  std::array<double, 2> x_, y_;
  double eps_x_, eps_y_;
  std::vector<Piece> out_;
};

void addPoints(const TrimBoundary& b, const Piece& piece, int axis, const Quadrature& rule,
               std::vector<CellPoint>& out) {
  const auto push = [&](double x, double y, double weight) {
    if (!(weight > 0)) return;
    if (axis == 0)
      out.push_back({x, y, weight});
    else
      out.push_back({y, x, weight});
  };
  const auto xOf = [&](Vec2 p) { return axis == 0 ? p.x : p.y; };
  const auto yOf = [&](Vec2 p) { return axis == 0 ? p.y : p.x; };
  const std::size_t n = rule.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    double x = piece.xa + rule.points[i] * (piece.xb - piece.xa), dx = piece.xb - piece.xa;
    double lower = piece.ya, upper = piece.yb;
    if (piece.kind == Piece::Kind::arc_to_line) {
      const Strand& s = piece.lower;
      const CurvePoint c = b.at(*s.arc, s.ta + rule.points[i] * (s.tb - s.ta));
      x = std::clamp(xOf(c.point), piece.xa, piece.xb);
      dx = std::abs(xOf(c.tangent) * (s.tb - s.ta));
      const double y = yOf(c.point);
      // From the line to the arc, whichever is below.
      lower = std::min(piece.ya, y);
      upper = std::max(piece.ya, y);
    } else if (piece.kind == Piece::Kind::between) {
      lower = yOf(b.point(*piece.lower.arc, b.solve(*piece.lower.arc, axis, x)));
      upper = yOf(b.point(*piece.upper.arc, b.solve(*piece.upper.arc, axis, x)));
    }
    for (std::size_t j = 0; j < n; ++j)
      push(x, lower + rule.points[j] * (upper - lower), rule.weights[i] * rule.weights[j] * dx * (upper - lower));
  }
}

}  // namespace

std::vector<CellPoint> cutCellPoints(const TrimBoundary& b, std::span<const MonotoneArc> arcs, double u0, double u1,
                                     double v0, double v1, const Quadrature& rule) {
  const std::vector<Piece> across_u = Slabs(b, arcs, 0, {u0, u1}, {v0, v1}).pieces(),
                           across_v = Slabs(b, arcs, 1, {v0, v1}, {u0, u1}).pieces();
  const int axis = across_v.size() < across_u.size() ? 1 : 0;
  std::vector<CellPoint> points;
  for (const Piece& piece : axis == 0 ? across_u : across_v) addPoints(b, piece, axis, rule, points);
  return points;
}

}  // namespace gambeson
