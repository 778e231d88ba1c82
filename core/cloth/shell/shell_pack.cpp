#include "core/cloth/shell/shell_pack.hpp"

#include <algorithm>
#include <cassert>

#include "core/cloth/patches/rest_frame.hpp"
#include "core/material/fabric_law.hpp"

namespace gambeson {
namespace {

/// Whether any fabric that a point of the patch may have counts bending from the rest shape.
bool anyRestCurvature(const Garment& garment) {
  return hasRestCurvature(garment.fabric) ||
         std::any_of(garment.other_fabrics.begin(), garment.other_fabrics.end(), hasRestCurvature);
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
  if (b.laws.empty()) return;
  checkFabric(fabric);
  const PointLaw law = pointLaw(fabric);
  const double* values = reinterpret_cast<const double*>(&law);
  for (int k = 0; k < kLawDoubles; ++k) b.laws[(point * kLawDoubles + k) * b.lanes + lane] = values[k];
}

/// Which numbers of the points' laws differ anywhere from those of the garment's fabric.
std::vector<int> varyingNumbers(const Garment& garment, const ShellBlock& b) {
  std::vector<int> varying;
  if (b.laws.empty()) return varying;
  const PointLaw law = pointLaw(garment.fabric);
  const double* values = reinterpret_cast<const double*>(&law);
  const std::size_t lanes = static_cast<std::size_t>(b.lanes), stride = kLawDoubles * lanes;
  for (int k = 0; k < kLawDoubles; ++k) {
    bool same = true;
    for (std::size_t first = k * lanes; first < b.laws.size() && same; first += stride)
      for (std::size_t lane = 0; lane < lanes && same; ++lane) same = b.laws[first + lane] == values[k];
    if (!same) varying.push_back(k);
  }
  return varying;
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

}  // namespace

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

ShellBlock packBlock(const Garment& garment, const std::vector<int>& offsets, const BlockKind& kind,
                     const std::vector<SheetCell>& cells, int lanes, int gauss_extra) {
  ShellBlock b;
  b.assumed = kind.assumed;
  b.p = kind.p;
  b.q = kind.q;
  b.rational = kind.rational;
  b.scattered = kind.scattered;
  b.gu = b.p + (kind.fewer_u ? 0 : 1) + gauss_extra;
  b.gv = b.q + (kind.fewer_v ? 0 : 1) + gauss_extra;
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
    b.tie_weight.resize(points * kTieWeightDoubles * L);
    b.tie_mean.resize(static_cast<long>(b.groups) * kMeanDoubles * L);
    b.tie_rest.resize(static_cast<long>(b.groups) * b.tieCount() * 3 * L);
  }
  b.points.resize(points * b.pointDoubles() * L);
  if (!kind.fabric) b.laws.resize(points * kLawDoubles * L);
  for (int g = 0; g < b.groups; ++g)
    for (int l = 0; l < lanes; ++l) {
      const int at = g * lanes + l;
      packCell(garment, offsets, cells[std::min(at, count - 1)], at < count, b, g, l);
    }
  b.law_varies = varyingNumbers(garment, b);
  return b;
}

}  // namespace gambeson
