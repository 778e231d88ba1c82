#include "tryon/pattern/flat/flatten_patch.hpp"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr int most_rounds = 2000;
constexpr double settled = 1e-9;

std::vector<double> linesOf(const KnotVector& knots, int per_cell) {
  const std::vector<double> cells = breakpoints(knots);
  std::vector<double> out;
  for (std::size_t c = 0; c + 1 < cells.size(); ++c)
    for (int k = 0; k < per_cell; ++k) out.push_back(cells[c] + (cells[c + 1] - cells[c]) * k / per_cell);
  out.push_back(cells.back());
  return out;
}

/// A triangle of the grid at rest: sides e1, e2 from its first corner, in a plane of its own.
struct Triangle {
  std::array<int, 3> corner;
  double a = 0, b = 0, c = 0;  ///< e1 = (a, 0), e2 = (b, c); the area is a c / 2
  /// J, by columns, of corners in the plane.
  std::array<Vec2, 2> jacobian(const std::vector<Vec2>& x) const {
    const Vec2 &o = x[corner[0]], &p = x[corner[1]], &q = x[corner[2]];
    const Vec2 first{(p.x - o.x) / a, (p.y - o.y) / a};
    return {first, {(q.x - o.x - b * first.x) / c, (q.y - o.y - b * first.y) / c}};
  }
  /// Gradients of the hat functions of the corners.
  std::array<Vec2, 3> gradients() const {
    const Vec2 second{1 / a, -b / (a * c)}, third{0, 1 / c};
    return {Vec2{-second.x - third.x, -second.y - third.y}, second, third};
  }
  double area() const { return 0.5 * a * c; }
};

/// Length of the geodesic between two places of the patch: of a chord c with the normal curvature k in its middle,
/// c (1 + (k c)^2 / 24), up to the fourth power of c.
double geodesic(const NurbsPatch& patch, Vec2 from, Vec2 to) {
  const Vec3 chord = surfaceDerivatives(patch, to.x, to.y)[0] - surfaceDerivatives(patch, from.x, from.y)[0];
  const auto d = surfaceDerivatives(patch, 0.5 * (from.x + to.x), 0.5 * (from.y + to.y));
  const double du = to.x - from.x, dv = to.y - from.y;
  const Vec3 along = du * d[1] + dv * d[2], bent = du * du * d[3] + dv * dv * d[4] + 2 * du * dv * d[5];
  const double k = dot(normalized(cross(d[1], d[2])), bent) / dot(along, along), c = norm(chord);
  return c * (1 + k * k * c * c / 24);
}

Triangle triangleOf(const NurbsPatch& patch, const std::array<int, 3>& corner, const std::array<Vec2, 3>& uv) {
  const double e1 = geodesic(patch, uv[0], uv[1]), e2 = geodesic(patch, uv[0], uv[2]),
               e3 = geodesic(patch, uv[1], uv[2]);
  Triangle t{corner, e1, 0, 0};
  t.b = (e1 * e1 + e2 * e2 - e3 * e3) / (2 * e1);
  t.c = std::sqrt(e2 * e2 - t.b * t.b);
  if (!(t.a > 0 && t.c > 0)) throw InputError({"", 0, "flat"}, "the patch has a cell without area");
  return t;
}

/// (cos, sin) of the rotation nearest to J.
Vec2 rotationOf(const std::array<Vec2, 2>& J) {
  const Vec2 r{J[0].x + J[1].y, J[0].y - J[1].x};
  const double length = std::hypot(r.x, r.y);
  return length > 0 ? Vec2{r.x / length, r.y / length} : Vec2{1, 0};
}

/// Principal stretches, the larger first; the other is negative where J turns the triangle over.
std::array<double, 2> stretchesOf(const std::array<Vec2, 2>& J) {
  const double p = 0.5 * std::hypot(J[0].x + J[1].y, J[0].y - J[1].x),
               q = 0.5 * std::hypot(J[0].x - J[1].y, J[0].y + J[1].x);
  return {p + q, p - q};
}

class Flattener {
 public:
  Flattener(const NurbsPatch& patch, int per_cell) {
    flat_.u = linesOf(patch.u, per_cell), flat_.v = linesOf(patch.v, per_cell);
    const int nu = static_cast<int>(flat_.u.size()), nv = static_cast<int>(flat_.v.size());
    const auto add = [&](std::array<std::array<int, 2>, 3> at) {
      std::array<int, 3> corner;
      std::array<Vec2, 3> uv;
      for (int k = 0; k < 3; ++k) corner[k] = at[k][0] + nu * at[k][1], uv[k] = {flat_.u[at[k][0]], flat_.v[at[k][1]]};
      triangles_.push_back(triangleOf(patch, corner, uv));
    };
    for (int j = 0; j + 1 < nv; ++j)
      for (int i = 0; i + 1 < nu; ++i)
        if ((i + j) % 2 == 0) {
          add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
          add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        } else {
          add({{{i, j}, {i + 1, j}, {i, j + 1}}});
          add({{{i + 1, j + 1}, {i, j + 1}, {i + 1, j}}});
        }
    start(patch);
  }

  FlatPatch solve() {
    const int n = static_cast<int>(flat_.points.size()) - 1;  // the first point stays
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triangle& t : triangles_) {
      const auto g = t.gradients();
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (t.corner[k] > 0 && t.corner[l] > 0)
            entries.emplace_back(t.corner[k] - 1, t.corner[l] - 1, t.area() * (g[k].x * g[l].x + g[k].y * g[l].y));
    }
    Eigen::SparseMatrix<double> A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(A);
    if (factor.info() != Eigen::Success) throw InputError({"", 0, "flat"}, "the patch cannot be laid flat");
    for (int round = 0; round < most_rounds; ++round) {
      Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(n, 2);
      for (const Triangle& t : triangles_) {
        const Vec2 r = rotationOf(t.jacobian(flat_.points));
        const auto g = t.gradients();
        for (int k = 0; k < 3; ++k)
          if (t.corner[k] > 0) {
            right(t.corner[k] - 1, 0) += t.area() * (r.x * g[k].x - r.y * g[k].y);
            right(t.corner[k] - 1, 1) += t.area() * (r.y * g[k].x + r.x * g[k].y);
          }
      }
      const Eigen::MatrixX2d x = factor.solve(right);
      double moved = 0;
      for (int k = 0; k < n; ++k) {
        Vec2& p = flat_.points[static_cast<std::size_t>(k) + 1];
        moved = std::max(moved, std::hypot(x(k, 0) - p.x, x(k, 1) - p.y));
        p = {x(k, 0), x(k, 1)};
      }
      if (moved <= settled * size_m_) break;
    }
    measure();
    turnUpright();
    return std::move(flat_);
  }

 private:
  /// Rows and columns as long as the patch's middle ones.
  void start(const NurbsPatch& patch) {
    const auto lengths = [&](const std::vector<double>& at, bool along_u) {
      const double other = along_u ? flat_.v[flat_.v.size() / 2] : flat_.u[flat_.u.size() / 2];
      std::vector<double> out{0};
      for (std::size_t k = 1; k < at.size(); ++k) {
        const double middle = 0.5 * (at[k - 1] + at[k]);
        const auto d = along_u ? surfaceDerivatives(patch, middle, other) : surfaceDerivatives(patch, other, middle);
        out.push_back(out.back() + (at[k] - at[k - 1]) * norm(d[along_u ? 1 : 2]));
      }
      return out;
    };
    const std::vector<double> x = lengths(flat_.u, true), y = lengths(flat_.v, false);
    size_m_ = x.back() + y.back();
    for (const double b : y)
      for (const double a : x) flat_.points.push_back({a, b});
  }
  void measure() {
    double area = 0, flat_area = 0, sum = 0;
    Flattening& f = flat_.flattening;
    for (const Triangle& t : triangles_) {
      const auto [s1, s2] = stretchesOf(t.jacobian(flat_.points));
      if (!(s2 > 0))
        throw InputError({"", 0, "flat"}, "the patch folds over itself when it is laid flat; it needs a seam");
      area += t.area(), flat_area += t.area() * s1 * s2;
      sum += t.area() * 0.5 * ((s1 - 1) * (s1 - 1) + (s2 - 1) * (s2 - 1));
      f.largest_strain = std::max({f.largest_strain, std::abs(s1 - 1), std::abs(s2 - 1)});
    }
    f.rms_strain = std::sqrt(sum / area);
    f.area_change = flat_area / area - 1;
  }
  /// The middle v line upward, the lower left corner of all at (0, 0).
  void turnUpright() {
    const int i = static_cast<int>(flat_.u.size()) / 2;
    const Vec2 low = flat_.at(i, 0), high = flat_.at(i, static_cast<int>(flat_.v.size()) - 1);
    const double length = std::hypot(high.x - low.x, high.y - low.y), c = (high.y - low.y) / length,
                 s = (high.x - low.x) / length;
    Vec2 corner{HUGE_VAL, HUGE_VAL};
    for (Vec2& p : flat_.points) {
      p = {c * p.x - s * p.y, s * p.x + c * p.y};
      corner = {std::min(corner.x, p.x), std::min(corner.y, p.y)};
    }
    for (Vec2& p : flat_.points) p = {p.x - corner.x, p.y - corner.y};
  }

  FlatPatch flat_;
  std::vector<Triangle> triangles_;
  double size_m_ = 0;
};

}  // namespace

Vec2 FlatPatch::at(Vec2 uv) const {
  const auto find = [](const std::vector<double>& lines, double x) {
    const auto k = std::upper_bound(lines.begin() + 1, lines.end() - 1, x) - lines.begin() - 1;
    return std::pair(static_cast<int>(k), (x - lines[k]) / (lines[k + 1] - lines[k]));
  };
  const auto [i, s] = find(u, uv.x);
  const auto [j, t] = find(v, uv.y);
  const auto mix = [](const Vec2& a, const Vec2& b, double f) {
    return Vec2{a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)};
  };
  return mix(mix(at(i, j), at(i + 1, j), s), mix(at(i, j + 1), at(i + 1, j + 1), s), t);
}

FlatPatch flattenPatch(const NurbsPatch& patch, int per_cell) { return Flattener(patch, per_cell).solve(); }

}  // namespace gambeson
