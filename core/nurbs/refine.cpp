#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/nurbs/nurbs.hpp"

namespace gambeson {
namespace {

/// A control point in homogeneous coordinates (w x, w): a rational curve is a polynomial one there.
struct Homogeneous {
  Vec3 wx;
  double w = 0;
};
Homogeneous mix(const Homogeneous& a, const Homogeneous& b, double t) {
  return {(1 - t) * a.wx + t * b.wx, (1 - t) * a.w + t * b.w};
}
using Row = std::vector<Homogeneous>;

/// Applies `change` (row of old points -> row of new points, for the new knots) to every row of the patch along a
/// direction.
template <class Change>
NurbsPatch changeRows(const NurbsPatch& patch, Direction direction, const KnotVector& knots, Change change) {
  NurbsPatch out = patch;
  (direction == Direction::u ? out.u : out.v) = knots;
  out.points.assign(out.size(), {});
  out.weights.assign(out.size(), 0);
  const bool along_u = direction == Direction::u;
  const int rows = along_u ? patch.v.count() : patch.u.count();
  const int length = along_u ? patch.u.count() : patch.v.count();
  Row row(length);
  for (int r = 0; r < rows; ++r) {
    for (int i = 0; i < length; ++i) {
      const int k = along_u ? patch.index(i, r) : patch.index(r, i);
      row[i] = {patch.weights[k] * patch.points[k], patch.weights[k]};
    }
    const Row changed = change(row);
    for (int i = 0; i < knots.count(); ++i) {
      const int k = along_u ? out.index(i, r) : out.index(r, i);
      out.points[k] = changed[i].wx / changed[i].w;
      out.weights[k] = changed[i].w;
    }
  }
  return out;
}

/// The blossom (polar form) of the polynomial piece on cell `span`: the symmetric multi-affine f with f(u,..,u) = C(u),
/// by de Boor's algorithm with another argument at each level (The NURBS Book, section 5.2 has A5.1 as its special
/// case; Ramshaw 1989). The control point i of the same piece over other knots t is f(t_{i+1}, .., t_{i+p}).
Homogeneous blossom(const KnotVector& k, const Row& row, int span, std::span<const double> arguments) {
  const int p = k.degree;
  Row d(row.begin() + (span - p), row.begin() + (span + 1));
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const double left = k.knots[span - p + j], right = k.knots[span + 1 + j - r];
      d[j] = mix(d[j - 1], d[j], (arguments[r - 1] - left) / (right - left));
    }
  return d[p];
}

/// Degree p -> p + 1 with every breakpoint's multiplicity raised by one, the ends clamped.
KnotVector raised(const KnotVector& k) {
  KnotVector out{k.degree + 1, {}};
  out.knots.assign(k.degree + 2, k.front());
  const auto b = breakpoints(k);
  for (std::size_t i = 1; i + 1 < b.size(); ++i)
    out.knots.insert(out.knots.end(), std::count(k.knots.begin(), k.knots.end(), b[i]) + 1, b[i]);
  out.knots.insert(out.knots.end(), k.degree + 2, k.back());
  return out;
}

NurbsPatch elevateOnce(const NurbsPatch& patch, Direction direction) {
  const KnotVector& old = direction == Direction::u ? patch.u : patch.v;
  const KnotVector knots = raised(old);
  const int n = knots.degree;
  return changeRows(patch, direction, knots, [&](const Row& row) {
    Row out(knots.count());
    std::vector<double> arguments(old.degree);
    for (int i = 0; i < knots.count(); ++i) {
      // Any cell of the function's support gives the same point; the one in its middle extrapolates least.
      const int span = findSpan(old, 0.5 * (knots.knots[i] + knots.knots[i + n + 1]));
      // F(t_1..t_n) = 1/n sum over j of f(t_1 .. without t_j .. t_n): the blossom of the same curve, one degree higher.
      Homogeneous sum;
      for (int j = 0; j < n; ++j) {
        for (int m = 0, a = 0; m < n; ++m)
          if (m != j) arguments[a++] = knots.knots[i + 1 + m];
        const Homogeneous f = blossom(old, row, span, arguments);
        sum.wx += f.wx;
        sum.w += f.w;
      }
      out[i] = {sum.wx / n, sum.w / n};
    }
    return out;
  });
}

}  // namespace

// Boehm 1980; The NURBS Book, eq. 5.15: Q_i = a_i P_i + (1 - a_i) P_{i-1}, a_i = (knot - U_i) / (U_{i+p} - U_i) in
// between.
NurbsPatch insertKnot(const NurbsPatch& patch, Direction direction, double knot, int times) {
  if (times < 0) throw InputError({"", 0, "times"}, std::to_string(times) + ", must not be negative");
  NurbsPatch out = patch;
  for (int t = 0; t < times; ++t) {
    const KnotVector old = direction == Direction::u ? out.u : out.v;
    const int p = old.degree;
    if (!(knot > old.front() && knot < old.back()))
      throw InputError({"", 0, "knot"}, std::to_string(knot) + ", must lie inside " + std::to_string(old.front()) +
                                            " .. " + std::to_string(old.back()));
    if (std::count(old.knots.begin(), old.knots.end(), knot) >= p)
      throw InputError({"", 0, "knot"},
                       std::to_string(knot) + ", its multiplicity would exceed the degree " + std::to_string(p));
    const int s = findSpan(old, knot);
    KnotVector knots = old;
    knots.knots.insert(knots.knots.begin() + s + 1, knot);
    out = changeRows(out, direction, knots, [&](const Row& row) {
      Row changed(knots.count());
      for (int i = 0; i < knots.count(); ++i) {
        if (i <= s - p) {
          changed[i] = row[i];
        } else if (i > s) {
          changed[i] = row[i - 1];
        } else {
          const double a = (knot - old.knots[i]) / (old.knots[i + p] - old.knots[i]);
          changed[i] = a >= 1 ? row[i] : a <= 0 ? row[i - 1] : mix(row[i - 1], row[i], a);
        }
      }
      return changed;
    });
  }
  return out;
}

NurbsPatch insertKnots(const NurbsPatch& patch, Direction direction, std::span<const double> knots) {
  NurbsPatch out = patch;
  for (const double knot : knots) out = insertKnot(out, direction, knot);
  return out;
}

NurbsPatch elevateDegree(const NurbsPatch& patch, Direction direction, int by) {
  if (by < 0) throw InputError({"", 0, "by"}, std::to_string(by) + ", must not be negative");
  NurbsPatch out = patch;
  for (int i = 0; i < by; ++i) out = elevateOnce(out, direction);
  return out;
}

}  // namespace gambeson
