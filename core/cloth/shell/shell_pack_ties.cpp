#include <cmath>
#include <optional>

#include "core/cloth/patches/rest_frame.hpp"
#include "core/cloth/shell/shell_pack.hpp"

namespace gambeson {
namespace {

/// Rows that take a tensor (11, 22, 2 x 12) from parameter to orthonormal components, G = d(xi)/dX, and back.
using Rows3 = std::array<std::array<double, 3>, 3>;
Rows3 toPhysical(const RestFrame& G) {
  return {{{G.G11 * G.G11, G.G21 * G.G21, G.G11 * G.G21},
           {G.G12 * G.G12, G.G22 * G.G22, G.G12 * G.G22},
           {2 * G.G11 * G.G12, 2 * G.G21 * G.G22, G.G11 * G.G22 + G.G21 * G.G12}}};
}
Rows3 toCovariant(const RestFrame& G) {
  const double det = G.G11 * G.G22 - G.G12 * G.G21;
  return toPhysical({G.G22 / det, -G.G12 / det, -G.G21 / det, G.G11 / det, 0});
}

/// Components of A1 and A2 (columns) in the orthonormal frame: the inverse of G.
using Rows2 = std::array<std::array<double, 2>, 2>;
Rows2 jacobian(const RestFrame& G) {
  const double det = G.G11 * G.G22 - G.G12 * G.G21;
  return {{{G.G22 / det, -G.G12 / det}, {-G.G21 / det, G.G11 / det}}};
}
/// The same where A1 x A2 vanishes: in the frame of the cell's middle.
Rows2 poleJacobian(const Vec3& A1, const Vec3& A2, const CellBasis& middle, const Vec3& weft) {
  const Vec3 n = normalized(cross(middle.rest[1], middle.rest[2])), e1 = normalized(weft - dot(weft, n) * n),
             e2 = cross(n, e1);
  return {{{dot(e1, A1), dot(e1, A2)}, {dot(e2, A1), dot(e2, A2)}}};
}

}  // namespace

void packTies(const Garment& garment, const SheetCell& cell, ShellBlock& b, long group, int lane) {
  const NurbsPatch& patch = garment.patches[cell.patch];
  const Vec3& weft = garment.weft[cell.patch];
  const int L = b.lanes;
  const double knot_u[2] = {cell.u0, cell.u1}, knot_v[2] = {cell.v0, cell.v1};
  const std::vector<CellPoint> points = cellRule(cell, b.gu, b.gv);
  const auto gauss_u = [&](int g) { return points[g].u; };
  const auto gauss_v = [&](int g) { return points[static_cast<std::size_t>(g) * b.gu].v; };
  for (int k = 0; k < 2; ++k) {
    const CellBasis basis = cellBasis(patch, cell, knot_u[k], knot_v[k]);
    for (int i = 0; i < 6; ++i) {
      b.tie_u[(group * 12 + 6 * k + i) * L + lane] = basis.u[i];
      b.tie_v[(group * 12 + 6 * k + i) * L + lane] = basis.v[i];
    }
  }
  long at = group * b.tieCount() * 3;
  std::vector<std::optional<Rows3>> physical;  // of each tie, none at a pole
  // Of each place: covariant components of F_c . x,b, one number for each component, c and node.
  using Linear = std::array<std::array<std::array<double, 9>, 2>, 3>;
  std::vector<Linear> linear;
  const auto linearOf = [](const CellBasis& basis, const Rows2& J) {
    Linear l;
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < 9; ++k) {
        const double d1 = basis.rational[1][k], d2 = basis.rational[2][k];
        l[0][c][k] = d1 * J[c][0];
        l[1][c][k] = d2 * J[c][1];
        l[2][c][k] = d1 * J[c][1] + d2 * J[c][0];
      }
    return l;
  };
  const auto place = [&](double u, double v) {
    const CellBasis basis = cellBasis(patch, cell, u, v);
    const Vec3 &A1 = basis.rest[1], &A2 = basis.rest[2];
    for (double metric : {dot(A1, A1), dot(A2, A2), dot(A1, A2)}) b.tie_rest[at++ * L + lane] = metric;
    const CellBasis middle = cellBasis(patch, cell, 0.5 * (cell.u0 + cell.u1), 0.5 * (cell.v0 + cell.v1));
    const bool pole = norm(cross(A1, A2)) < 1e-8 * norm(cross(middle.rest[1], middle.rest[2]));
    physical.push_back(pole ? std::nullopt : std::optional(toPhysical(restFrame(A1, A2, weft, 0))));
    linear.push_back(linearOf(basis, pole ? poleJacobian(A1, A2, middle, weft) : jacobian(restFrame(A1, A2, weft, 0))));
  };
  for (double u : knot_u)
    for (int g = 0; g < b.gv; ++g) place(u, gauss_v(g));
  for (double v : knot_v)
    for (int g = 0; g < b.gu; ++g) place(gauss_u(g), v);
  for (double u : knot_u)
    for (double v : knot_v) place(u, v);

  std::array<double, kMeanDoubles> rows{};
  double area = 0;
  for (int gv = 0; gv < b.gv; ++gv)
    for (int gu = 0; gu < b.gu; ++gu) {
      const CellBasis basis = cellBasis(patch, cell, gauss_u(gu), gauss_v(gv));
      const RestFrame frame = restFrame(basis.rest[1], basis.rest[2], weft, 0);
      const Rows3 covariant = toCovariant(frame), to_physical = toPhysical(frame);
      const double dA = frame.area * points[gu + b.gu * gv].weight;
      area += dA;
      const double G[2][2] = {{frame.G11, frame.G12}, {frame.G21, frame.G22}};
      Linear missing = linearOf(basis, jacobian(frame));
      for (int d = 0; d < 2; ++d)
        for (int k = 0; k < 9; ++k)
          rows[9 * d + k] += dA * (basis.rational[1][k] * G[0][d] + basis.rational[2][k] * G[1][d]);
      const double su = (gauss_u(gu) - cell.u0) / (cell.u1 - cell.u0),
                   sv = (gauss_v(gv) - cell.v0) / (cell.v1 - cell.v0);
      const double a[2] = {1 - su, su}, c[2] = {1 - sv, sv};
      const long point = b.firstPoint(static_cast<int>(group)) + gu + b.gu * gv;
      const auto weigh = [&](int which, int component, int tie, double factor) {
        for (int j = 0; j < 3; ++j) {
          double s = j == component ? 1 : 0;
          if (physical[tie]) {
            s = 0;
            for (int i = 0; i < 3; ++i) s += covariant[component][i] * (*physical[tie])[i][j];
          }
          b.tie_weight[(point * kTieWeightDoubles + 3 * which + j) * L + lane] = factor * s;
          for (int d = 0; d < 2; ++d)
            for (int n = 0; n < 9; ++n) missing[component][d][n] -= factor * s * linear[tie][j][d][n];
        }
      };
      for (int k = 0; k < 2; ++k) {
        weigh(k, 0, k * b.gv + gv, a[k]);
        weigh(2 + k, 1, 2 * b.gv + k * b.gu + gu, c[k]);
        for (int l = 0; l < 2; ++l) weigh(4 + 2 * k + l, 2, 2 * b.gv + 2 * b.gu + 2 * k + l, a[k] * c[l]);
      }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          b.tie_weight[(point * kTieWeightDoubles + 24 + 3 * i + j) * L + lane] = covariant[i][j];
          for (int d = 0; d < 2; ++d)
            for (int n = 0; n < 9; ++n) rows[18 + 9 * (2 * i + d) + n] += dA * to_physical[i][j] * missing[j][d][n];
        }
    }
  for (double& value : rows) value /= area;
  // C of the rest shape, which counts as none.
  const auto local = [&](int k) { return patch.index(cell.su - 2 + k % 3, cell.sv - 2 + k / 3); };
  const auto combined = [&](int row) {
    Vec3 sum{};
    for (int k = 0; k < 9; ++k) sum += rows[9 * row + k] * patch.points[local(k)];
    return sum;
  };
  for (int i = 0; i < 3; ++i)
    rows[72 + i] = dot(combined(0), combined(2 + 2 * i)) + dot(combined(1), combined(3 + 2 * i));
  for (int i = 0; i < kMeanDoubles; ++i) b.tie_mean[(group * kMeanDoubles + i) * L + lane] = rows[i];
}

}  // namespace gambeson
