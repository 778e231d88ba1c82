#include "core/sheet/shell.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/material/bending.hpp"
#include "core/sheet/cells.hpp"

namespace gambeson {
namespace {

/// G = d(xi)/dX: columns are the physical directions weft and warp (orthonormal, tangent to the rest surface).
struct RestFrame {
  double G11 = 1, G12 = 0, G21 = 0, G22 = 1, area = 1;  ///< area: |A1 x A2|
};

/// The weft is turned by `angle` about the normal.
RestFrame restFrame(const Vec3& A1, const Vec3& A2, const Vec3& weft, double angle) {
  const Vec3 normal = cross(A1, A2);
  const double area = norm(normal);
  if (!(area > 0)) throw InputError({"", 0, "patch"}, "the rest surface is degenerate (zero area)");
  const Vec3 n = normal / area;
  const Vec3 in_plane = weft - dot(weft, n) * n;
  if (!(norm(in_plane) > 1e-6 * norm(weft)))
    throw InputError({"", 0, "weft"}, "the weft direction is normal to the rest surface");
  const Vec3 e = normalized(in_plane);
  const Vec3 E1 = angle == 0 ? e : std::cos(angle) * e + std::sin(angle) * cross(n, e), E2 = cross(n, E1);
  const double J11 = dot(E1, A1), J12 = dot(E1, A2), J21 = dot(E2, A1), J22 = dot(E2, A2);
  const double det = J11 * J22 - J12 * J21;
  return {J22 / det, -J12 / det, -J21 / det, J11 / det, area};
}

Vec3 curvature(const RestFrame& G, const Vec3& a1, const Vec3& a2, const Vec3& x11, const Vec3& x22, const Vec3& x12) {
  const Vec3 n = normalized(cross(a1, a2));
  const double b11 = dot(n, x11), b22 = dot(n, x22), b12 = dot(n, x12);
  return {G.G11 * G.G11 * b11 + 2 * G.G11 * G.G21 * b12 + G.G21 * G.G21 * b22,
          G.G12 * G.G12 * b11 + 2 * G.G12 * G.G22 * b12 + G.G22 * G.G22 * b22,
          G.G11 * G.G12 * b11 + (G.G11 * G.G22 + G.G21 * G.G12) * b12 + G.G21 * G.G22 * b22};
}

bool isRational(const NurbsPatch& p) {
  return std::any_of(p.weights.begin(), p.weights.end(), [&](double w) { return w != p.weights.front(); });
}

/// Whether any fabric that a point of the patch may have counts bending from the rest shape.
bool anyRestCurvature(const Garment& garment) {
  return hasRestCurvature(garment.fabric) ||
         std::any_of(garment.other_fabrics.begin(), garment.other_fabrics.end(), hasRestCurvature);
}

/// Basis functions of a cell at a point: of its spans, also on its border.
struct CellBasis {
  std::vector<double> u, v;                     ///< of the knots: [derivative][function]
  std::array<double, 6> denominator{};          ///< and its derivatives: w, 1, 2, 11, 22, 12
  std::array<std::vector<double>, 6> rational;  ///< N, N,1 N,2 N,11 N,22 N,12
  std::array<Vec3, 6> rest{};                   ///< X and its derivatives
};

CellBasis cellBasis(const NurbsPatch& patch, const SheetCell& cell, double u, double v) {
  const int p = patch.u.degree, q = patch.v.degree, nu = p + 1, nv = q + 1;
  CellBasis b;
  b.u.resize(3 * nu);
  b.v.resize(3 * nv);
  basisDerivatives(patch.u, cell.su, u, 2, b.u);
  basisDerivatives(patch.v, cell.sv, v, 2, b.v);
  static constexpr int du[6] = {0, 1, 0, 2, 0, 1}, dv[6] = {0, 0, 1, 0, 2, 1};
  const auto local = [&](int k) { return patch.index(cell.su - p + k % nu, cell.sv - q + k / nu); };
  for (int m = 0; m < 6; ++m) {
    b.rational[m].resize(nu * nv);
    for (int k = 0; k < nu * nv; ++k) {
      b.rational[m][k] = b.u[du[m] * nu + k % nu] * b.v[dv[m] * nv + k / nu] * patch.weights[local(k)];
      b.denominator[m] += b.rational[m][k];
    }
  }
  const auto& W = b.denominator;
  auto& [r, r1, r2, r11, r22, r12] = b.rational;
  for (int k = 0; k < nu * nv; ++k) {
    r[k] = r[k] / W[0];
    r1[k] = (r1[k] - r[k] * W[1]) / W[0];
    r2[k] = (r2[k] - r[k] * W[2]) / W[0];
    r11[k] = (r11[k] - 2 * r1[k] * W[1] - r[k] * W[3]) / W[0];
    r22[k] = (r22[k] - 2 * r2[k] * W[2] - r[k] * W[4]) / W[0];
    r12[k] = (r12[k] - r1[k] * W[2] - r2[k] * W[1] - r[k] * W[5]) / W[0];
    for (int m = 0; m < 6; ++m) b.rest[m] += b.rational[m][k] * patch.points[local(k)];
  }
  return b;
}

/// Writes what a point of a cell has beside its basis: frame, area, denominator, rest curvature, law.
void packPoint(const Garment& garment, const SheetCell& cell, const CellBasis& basis, const CellPoint& at, bool real,
               ShellBlock& b, long point, int lane) {
  const Vec2 uv{at.u, at.v};
  const auto& d = basis.rest;
  const RestFrame G = restFrame(d[1], d[2], garment.weft[cell.patch], fibreAngleAt(garment, cell.patch, uv));
  std::vector<double> data{G.G11, G.G12, G.G21, G.G22, real ? G.area * at.weight : 0.0};
  if (b.rational) data.insert(data.end(), basis.denominator.begin(), basis.denominator.end());
  const bool varies = fabricVaries(garment, cell.patch);
  const Fabric fabric = varies ? fabricAt(garment, cell.patch, uv) : garment.fabric;
  if (b.rest_curvature) {
    const Vec3 k0 = hasRestCurvature(fabric) ? curvature(G, d[1], d[2], d[3], d[4], d[5]) : Vec3{};
    data.insert(data.end(), {k0.x, k0.y, k0.z});
  }
  for (std::size_t k = 0; k < data.size(); ++k)
    b.points[(point * b.pointDoubles() + static_cast<long>(k)) * b.lanes + lane] = data[k];
  if (!varies) return;
  checkFabric(fabric);
  const PointLaw law = pointLaw(fabric);
  const double* values = reinterpret_cast<const double*>(&law);
  for (int k = 0; k < kLawDoubles; ++k) b.laws[(point * kLawDoubles + k) * b.lanes + lane] = values[k];
}

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

/// The places of the assumed strains of a cell, in the order of the kernels' Ties, and their shares.
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
      const auto share = [&](int which, int component, int tie, double factor) {
        for (int j = 0; j < 3; ++j) {
          double s = j == component ? 1 : 0;
          if (physical[tie]) {
            s = 0;
            for (int i = 0; i < 3; ++i) s += covariant[component][i] * (*physical[tie])[i][j];
          }
          b.tie_share[(point * kShareDoubles + 3 * which + j) * L + lane] = factor * s;
          for (int d = 0; d < 2; ++d)
            for (int n = 0; n < 9; ++n) missing[component][d][n] -= factor * s * linear[tie][j][d][n];
        }
      };
      for (int k = 0; k < 2; ++k) {
        share(k, 0, k * b.gv + gv, a[k]);
        share(2 + k, 1, 2 * b.gv + k * b.gu + gu, c[k]);
        for (int l = 0; l < 2; ++l) share(4 + 2 * k + l, 2, 2 * b.gv + 2 * b.gu + 2 * k + l, a[k] * c[l]);
      }
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          b.tie_share[(point * kShareDoubles + 24 + 3 * i + j) * L + lane] = covariant[i][j];
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

/// Fills lane `lane` of group `group`; `real` is false for the copies that fill a last group up (their area is zero).
void packCell(const Garment& garment, const std::vector<int>& offsets, const SheetCell& cell, bool real, ShellBlock& b,
              int group, int lane) {
  const NurbsPatch& patch = garment.patches[cell.patch];
  const int nu = b.p + 1, nv = b.q + 1, nn = nu * nv, L = b.lanes;
  for (int k = 0; k < nn; ++k) {
    const int local = patch.index(cell.su - b.p + k % nu, cell.sv - b.q + k / nu);
    const long at = (static_cast<long>(group) * nn + k) * L + lane;
    b.nodes[at] = offsets[cell.patch] + local;
    if (b.rational) b.weights[at] = patch.weights[local];
  }
  if (b.scattered) {
    // The last point, with no area, fills the group up.
    const long first = b.first_point[group], count = b.first_point[group + 1] - first;
    for (long i = 0; i < count; ++i) {
      const bool own = i < static_cast<long>(cell.points.size());
      const CellPoint at = own ? cell.points[i] : cell.points.back();
      const CellBasis basis = cellBasis(patch, cell, at.u, at.v);
      for (int d = 0; d < 5; ++d)
        for (int k = 0; k < nn; ++k) b.shapes[(((first + i) * 5 + d) * nn + k) * L + lane] = basis.rational[d + 1][k];
      packPoint(garment, cell, basis, at, real && own, b, first + i, lane);
    }
    return;
  }
  if (b.assumed) packTies(garment, cell, b, group, lane);
  const std::vector<CellPoint> points = cellRule(cell, b.gu, b.gv);
  for (int gv = 0; gv < b.gv; ++gv)
    for (int gu = 0; gu < b.gu; ++gu) {
      const CellPoint& at = points[gu + b.gu * gv];
      const CellBasis basis = cellBasis(patch, cell, at.u, at.v);
      for (int k = 0; k < 3 * nu; ++k)
        b.basis_u[((static_cast<long>(group) * b.gu + gu) * 3 * nu + k) * L + lane] = basis.u[k];
      for (int k = 0; k < 3 * nv; ++k)
        b.basis_v[((static_cast<long>(group) * b.gv + gv) * 3 * nv + k) * L + lane] = basis.v[k];
      packPoint(garment, cell, basis, at, real, b, b.firstPoint(group) + gu + b.gu * gv, lane);
    }
}

/// What cells of one block share.
struct Kind {
  int p, q;
  bool rational, scattered, varies;
  bool assumed, fewer;  ///< assumed strains; 2 x 2 points
  auto operator<=>(const Kind&) const = default;
};

/// Whether 2 x 2 points see every mode of a quadratic patch: not where it, or what trimming leaves of it, may be so
/// narrow that a function of one direction vanishes at all of them (the quadratic of one cell does at its two).
bool fewerPoints(const Garment& garment, int index) {
  const NurbsPatch& patch = garment.patches[index];
  return !isTrimmed(garment, index) && breakpoints(patch.u).size() > 3 && breakpoints(patch.v).size() > 3;
}

ShellBlock packBlock(const Garment& garment, const std::vector<int>& offsets, const Kind& kind,
                     const std::vector<SheetCell>& cells, int lanes, int gauss_extra) {
  ShellBlock b;
  b.assumed = kind.assumed;
  b.p = kind.p;
  b.q = kind.q;
  b.rational = kind.rational;
  b.scattered = kind.scattered;
  b.gu = b.p + (kind.fewer ? 0 : 1) + gauss_extra;
  b.gv = b.q + (kind.fewer ? 0 : 1) + gauss_extra;
  assert(!b.assumed || (b.gu <= kMaxTies && b.gv <= kMaxTies));
  b.lanes = lanes;
  const int count = static_cast<int>(cells.size());
  b.groups = (count + lanes - 1) / lanes;
  b.rest_curvature = anyRestCurvature(garment);
  const long nn = b.nodeCount(), L = lanes;
  b.nodes.resize(b.groups * nn * L);
  long points = static_cast<long>(b.groups) * b.gu * b.gv;
  if (b.scattered) {
    b.first_point.push_back(0);
    for (int g = 0; g < b.groups; ++g) {
      std::size_t most = 0;
      for (int i = g * lanes; i < std::min(count, (g + 1) * lanes); ++i) most = std::max(most, cells[i].points.size());
      b.first_point.push_back(b.first_point.back() + static_cast<long>(most));
    }
    points = b.first_point.back();
    b.shapes.resize(points * 5 * nn * L);
  } else {
    b.basis_u.resize(static_cast<long>(b.groups) * b.gu * 3 * (b.p + 1) * L);
    b.basis_v.resize(static_cast<long>(b.groups) * b.gv * 3 * (b.q + 1) * L);
  }
  if (b.rational) b.weights.resize(b.groups * nn * L);
  if (b.assumed) {
    b.tie_u.resize(b.groups * 12 * L);
    b.tie_v.resize(b.groups * 12 * L);
    b.tie_share.resize(points * kShareDoubles * L);
    b.tie_mean.resize(static_cast<long>(b.groups) * kMeanDoubles * L);
    b.tie_rest.resize(static_cast<long>(b.groups) * b.tieCount() * 3 * L);
  }
  b.points.resize(points * b.pointDoubles() * L);
  if (kind.varies) b.laws.resize(points * kLawDoubles * L);
  for (int g = 0; g < b.groups; ++g)
    for (int l = 0; l < lanes; ++l) {
      const int at = g * lanes + l;
      packCell(garment, offsets, cells[std::min(at, count - 1)], at < count, b, g, l);
    }
  return b;
}

/// The law of a block: where it varies, what any of its points may need.
ShellLaw blockLaw(const Garment& garment, bool varies) {
  ShellLaw law = shellLaw(garment.fabric);
  if (!varies) return law;
  law.general = true;
  for (const Fabric& other : garment.other_fabrics) {
    const ShellLaw more = shellLaw(other);
    law.zheng |= more.zheng;
    law.tension |= more.tension;
  }
  return law;
}

/// Cut cells in the order of their number of points, so that a group has equals.
void sortByPoints(std::vector<SheetCell>& cells) {
  std::stable_sort(cells.begin(), cells.end(),
                   [](const SheetCell& a, const SheetCell& b) { return a.points.size() < b.points.size(); });
}

}  // namespace

Shell::Shell(const Garment& garment, const KernelSet& kernels, int gauss_extra, CellRule rule)
    : garment_(garment), kernels_(&kernels), offsets_(controlOffsets(garment)), control_count_(offsets_.back()) {
  checkFabric(garment.fabric);
  for (std::size_t k = 0; k < garment.other_fabrics.size(); ++k)
    checkFabric(garment.other_fabrics[k], ("other_fabrics[" + std::to_string(k) + "]").c_str());
  if (garment.weft.size() != garment.patches.size())
    throw InputError({"", 0, "weft"}, "one direction for each patch is needed");
  for (const NurbsPatch& patch : garment.patches) {
    validate(patch);
    if (patch.u.degree < 1 || patch.u.degree > 5 || patch.v.degree < 1 || patch.v.degree > 5)
      throw InputError({"", 0, "degree"}, "degrees of a shell patch must be 1 to 5");
  }
  validateFields(garment);
  std::map<Kind, std::vector<SheetCell>> kinds;
  for (SheetCell& cell : sheetCells(garment)) {
    if (cell.cut && cell.points.empty()) continue;
    const NurbsPatch& patch = garment.patches[cell.patch];
    Kind kind{
        patch.u.degree, patch.v.degree, !cell.cut && isRational(patch), cell.cut, fabricVaries(garment, cell.patch),
        false,          false};
    if (kind.p == 2 && kind.q == 2 && !kind.scattered) {
      kind.assumed = rule == CellRule::assumed;
      kind.fewer = rule != CellRule::full && fewerPoints(garment, cell.patch) && !(kind.assumed && kind.rational);
    }
    kinds[kind].push_back(std::move(cell));
  }
  const int L = kernels.lanes;
  std::vector<std::vector<std::pair<long, int>>> gather(control_count_);
  for (auto& [kind, cells] : kinds) {
    if (kind.scattered) sortByPoints(cells);
    ShellPart part{packBlock(garment, offsets_, kind, cells, L, gauss_extra), blockLaw(garment, kind.varies),
                   slot_count_, static_cast<int>(cells.size())};
    const ShellBlock& b = part.block;
    const int nn = b.nodeCount();
    for (long at = 0; at < static_cast<long>(cells.size()); ++at)
      for (int k = 0; k < nn; ++k) {
        const long place = (at / L) * nn + k;
        gather[b.nodes[place * L + at % L]].push_back({part.first_slot + place * 3 * L + at % L, L});
      }
    for (const SheetCell& cell : cells)
      gauss_points_ += cell.cut ? static_cast<long>(cell.points.size()) : long{b.gu} * b.gv;
    slot_count_ += static_cast<long>(b.groups) * nn * 3 * L;
    parts_.push_back(std::move(part));
  }

  // Springs along seams; where the map T holds the tangents together the angle cannot change, and no spring is needed.
  const FreeMap map = buildFreeMap(garment);
  std::vector<Vec3> Q, gradient;
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  WeakPoints weak = buildWeakSeams(garment);
  gaps_ = std::move(weak.gaps);
  std::vector<HingePoint> hinges = buildHinges(garment);
  std::move(weak.hinges.begin(), weak.hinges.end(), std::back_inserter(hinges));
  for (HingePoint& h : hinges) {
    hingeAngle(h, Q, &gradient);
    std::map<int, Vec3> pulled;
    double size = 0, left = 0;
    for (std::size_t k = 0; k < h.columns.size(); ++k) {
      size += norm(gradient[k]);
      for (int e = map.T.offsets[h.columns[k]]; e < map.T.offsets[h.columns[k] + 1]; ++e)
        pulled[map.T.columns[e]] += map.T.values[e] * gradient[k];
    }
    for (const auto& entry : pulled) left += norm(entry.second);
    if (left > 1e-9 * size) hinges_.push_back(std::move(h));
  }
  hinge_slot_ = slot_count_;
  for (const HingePoint& h : hinges_) {
    hinge_offset_.push_back((slot_count_ - hinge_slot_) / 3);
    for (std::size_t k = 0; k < h.columns.size(); ++k)
      gather[h.columns[k]].push_back({slot_count_ + 3 * static_cast<long>(k), 1});
    slot_count_ += 3 * static_cast<long>(h.columns.size());
  }
  gap_slot_ = slot_count_;
  for (const GapPoint& point : gaps_) {
    gap_offset_.push_back((slot_count_ - gap_slot_) / 3);
    for (std::size_t k = 0; k < point.columns.size(); ++k)
      gather[point.columns[k]].push_back({slot_count_ + 3 * static_cast<long>(k), 1});
    slot_count_ += 3 * static_cast<long>(point.columns.size());
  }
  gather_offsets_.push_back(0);
  for (const auto& list : gather) {
    for (const auto& [slot, stride] : list) {
      gather_slots_.push_back(slot);
      gather_strides_.push_back(stride);
    }
    gather_offsets_.push_back(static_cast<long>(gather_slots_.size()));
  }
}

ShellLaw withTerms(ShellLaw law, const ShellTerms& terms) {
  law.membrane = terms.membrane;
  law.bending = terms.bending;
  law.steepest = terms.steepest;
  if (!terms.membrane) law.d1 = law.d2 = law.d3 = law.d4 = 0;
  if (terms.steepest && law.kappa0 > 0) {
    law.bending_weft = zhengSteepest(law.bending_weft, law.kappa0, law.kappa_regular);
    law.bending_warp = zhengSteepest(law.bending_warp, law.kappa0, law.kappa_regular);
    law.kappa0 = law.kappa_regular = 0;
  }
  if (!terms.bending) law.bending_weft = law.bending_warp = law.twist = 0;
  return law;
}

void Shell::cellForces(std::span<const Vec3> q, ShellWork& work, double* energy, const ShellTerms& terms) const {
  work.slots.resize(slot_count_);
  double total = 0;
  const bool cells = terms.membrane || terms.bending;
  if (!cells) std::fill(work.slots.begin(), work.slots.begin() + hinge_slot_, 0.0);
  for (const ShellPart& part : parts_) {
    if (!cells) break;
    const ShellLaw law = withTerms(part.law, terms);
    if (energy) work.lane_energy.assign(static_cast<std::size_t>(part.block.groups) * part.block.lanes, 0.0);
    kernels_->force(part.block, law, reinterpret_cast<const double*>(q.data()), work.slots.data() + part.first_slot,
                    energy ? work.lane_energy.data() : nullptr);
    if (energy)
      for (double e : work.lane_energy) total += e;
  }
  if (energy) *energy = total;
}

void Shell::force(std::span<const Vec3> q, std::span<Vec3> f, ShellWork& work, double* energy,
                  const ShellTerms& terms) const {
  double total = 0;
  cellForces(q, work, energy ? &total : nullptr, terms);
  const int hinge_count = static_cast<int>(hinges_.size());
  std::vector<double> hinge_energy(energy ? hinge_count : 0);
#pragma omp parallel if (hinge_count > 64)
  {
    std::vector<Vec3> gradient;
#pragma omp for schedule(static)
    for (int i = 0; i < hinge_count; ++i) {
      const HingePoint& h = hinges_[i];
      const double turn = terms.seams ? hingeAngle(h, q, &gradient) - h.theta0 : 0.0;
      for (std::size_t k = 0; k < h.columns.size(); ++k) {
        const Vec3 g = terms.seams ? (h.stiffness_length * turn) * gradient[k] : Vec3{};
        double* slot = work.slots.data() + hinge_slot_ + 3 * (hinge_offset_[i] + static_cast<long>(k));
        slot[0] = g.x;
        slot[1] = g.y;
        slot[2] = g.z;
      }
      if (energy) hinge_energy[i] = 0.5 * h.stiffness_length * turn * turn;
    }
  }
  for (double e : hinge_energy) total += e;
  const int gap_count = static_cast<int>(gaps_.size());
  std::vector<double> gap_energy(energy ? gap_count : 0);
#pragma omp parallel for schedule(static) if (gap_count > 64)
  for (int i = 0; i < gap_count; ++i) {
    const GapPoint& point = gaps_[i];
    const Vec3 gap = terms.seams ? gapOf(point, q) : Vec3{};
    for (std::size_t k = 0; k < point.columns.size(); ++k) {
      const Vec3 g = (point.stiffness_N_per_m * point.row[k]) * gap;
      double* slot = work.slots.data() + gap_slot_ + 3 * (gap_offset_[i] + static_cast<long>(k));
      slot[0] = g.x;
      slot[1] = g.y;
      slot[2] = g.z;
    }
    if (energy) gap_energy[i] = 0.5 * point.stiffness_N_per_m * norm2(gap);
  }
  for (double e : gap_energy) total += e;
  if (energy) *energy = total;
#pragma omp parallel for schedule(static) if (control_count_ > 512)
  for (int i = 0; i < control_count_; ++i) {
    Vec3 sum{};
    for (long k = gather_offsets_[i]; k < gather_offsets_[i + 1]; ++k) {
      const double* slot = work.slots.data() + gather_slots_[k];
      sum.x += slot[0];
      sum.y += slot[gather_strides_[k]];
      sum.z += slot[2 * gather_strides_[k]];
    }
    f[i] = -sum;
  }
}

struct Shell::Frame {
  RestFrame G;
  std::array<Vec3, 6> rest{}, now{};  ///< derivatives in the parameters, as SurfaceBasis
};

Shell::Frame Shell::frameAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const SurfaceBasis basis = surfaceBasis(garment_.patches[patch], uv.x, uv.y);
  Frame frame;
  for (std::size_t k = 0; k < basis.columns.size(); ++k)
    for (int m = 1; m < 6; ++m) {
      frame.rest[m] += basis.values[m][k] * garment_.patches[patch].points[basis.columns[k]];
      frame.now[m] += basis.values[m][k] * q[offsets_[patch] + basis.columns[k]];
    }
  frame.G = restFrame(frame.rest[1], frame.rest[2], garment_.weft[patch], fibreAngleAt(garment_, patch, uv));
  return frame;
}

ShellState Shell::stateAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Frame frame = frameAt(patch, uv, q);
  const RestFrame& G = frame.G;
  const Vec3 e1 = G.G11 * frame.now[1] + G.G21 * frame.now[2], e2 = G.G12 * frame.now[1] + G.G22 * frame.now[2];
  const Fabric fabric = fabricAt(garment_, patch, uv);
  const auto bent = [&](const std::array<Vec3, 6>& d) { return curvature(G, d[1], d[2], d[3], d[4], d[5]); };
  Vec3 change = bent(frame.now);
  if (hasRestCurvature(fabric)) change -= bent(frame.rest);
  change.z *= 2;
  ShellState state{{0.5 * (norm2(e1) - 1), 0.5 * (norm2(e2) - 1), dot(e1, e2)}, change, {}, {}};
  const double e[3] = {state.strain.x, state.strain.y, state.strain.z}, k[3] = {change.x, change.y, change.z};
  const PointResultants r = resultants(pointLaw(fabric), e, k);
  state.n = {r.n[0], r.n[1], r.n[2]};
  state.m = {r.m[0], r.m[1], r.m[2]};
  return state;
}

ShellStress Shell::stressAt(int patch, Vec2 uv, std::span<const Vec3> q, Vec2 more_N_per_m) const {
  const auto [e, change, of_strain, m] = stateAt(patch, uv, q);
  const Vec3 n = of_strain + Vec3{more_N_per_m.x, more_N_per_m.y, 0};
  const double E11 = e.x, E22 = e.y, E12 = 0.5 * e.z, C11 = 2 * E11 + 1, C22 = 2 * E22 + 1, C12 = 2 * E12;
  // Principal values of F n Fᵀ / J are those of n C / J.
  const double J = std::sqrt(C11 * C22 - C12 * C12);
  const double trace = n.x * C11 + 2 * n.z * C12 + n.y * C22, det = (n.x * n.y - n.z * n.z) * (C11 * C22 - C12 * C12);
  const double root = std::sqrt(std::max(0.0, 0.25 * trace * trace - det));
  const double mean = 0.5 * (E11 + E22), radius = std::hypot(0.5 * (E11 - E22), E12);
  return {(0.5 * trace + root) / J, (0.5 * trace - root) / J, mean + radius, mean - radius};
}

Vec3 Shell::curvatureAt(int patch, Vec2 uv, std::span<const Vec3> q) const {
  const Frame frame = frameAt(patch, uv, q);
  const auto& d = frame.now;
  return curvature(frame.G, d[1], d[2], d[3], d[4], d[5]);
}

}  // namespace gambeson
