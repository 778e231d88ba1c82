#include "tryon/pattern/fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>

namespace gambeson {
namespace {

Eigen::PartialPivLU<Eigen::MatrixXd> collocation(const KnotVector& k) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(k.count(), k.count());
  const auto g = grevillePoints(k);
  std::vector<double> b(k.degree + 1);
  for (int r = 0; r < k.count(); ++r) {
    const int s = findSpan(k, g[r]);
    basisDerivatives(k, s, g[r], 0, b);
    for (int i = 0; i <= k.degree; ++i) a(r, s - k.degree + i) = b[i];
  }
  return Eigen::PartialPivLU<Eigen::MatrixXd>(a);
}

}  // namespace

NurbsPatch interpolate(const KnotVector& u, const KnotVector& v, const std::function<Vec3(double, double)>& surface) {
  const auto gu = grevillePoints(u), gv = grevillePoints(v);
  std::vector<Vec3> data;
  for (const double t : gv)
    for (const double s : gu) data.push_back(surface(s, t));
  return interpolate(u, v, data);
}

NurbsPatch interpolate(const KnotVector& u, const KnotVector& v, const std::vector<Vec3>& data) {
  NurbsPatch out{u, v, {}, {}};
  assert(data.size() == static_cast<std::size_t>(out.size()));
  const auto lu = collocation(u), lv = collocation(v);
  out.points.resize(out.size());
  out.weights.assign(out.size(), 1);
  for (int d = 0; d < 3; ++d) {
    Eigen::MatrixXd m(u.count(), v.count());
    for (int j = 0; j < v.count(); ++j)
      for (int i = 0; i < u.count(); ++i) m(i, j) = data[out.index(i, j)][d];
    const Eigen::MatrixXd rows = lu.solve(m);
    const Eigen::MatrixXd net = lv.solve(rows.transpose());  // net(j, i)
    for (int j = 0; j < v.count(); ++j)
      for (int i = 0; i < u.count(); ++i) out.points[out.index(i, j)][d] = net(j, i);
  }
  return out;
}

std::vector<int> edgeRow(const NurbsPatch& p, const PatchEdge& edge, int row) {
  const int nu = p.u.count(), nv = p.v.count();
  std::vector<int> out;
  if (edge.side == Side::u0 || edge.side == Side::u1) {
    const int i = edge.side == Side::u0 ? row : nu - 1 - row;
    for (int j = 0; j < nv; ++j) out.push_back(p.index(i, j));
  } else {
    const int j = edge.side == Side::v0 ? row : nv - 1 - row;
    for (int i = 0; i < nu; ++i) out.push_back(p.index(i, j));
  }
  if (edge.reversed) std::reverse(out.begin(), out.end());
  return out;
}

void averageSeam(Garment& garment, const Seam& seam, int skip_first, int skip_last) {
  NurbsPatch &a = garment.patches[seam.a.patch], &b = garment.patches[seam.b.patch];
  const auto a0 = edgeRow(a, seam.a), a1 = edgeRow(a, seam.a, 1), b0 = edgeRow(b, seam.b), b1 = edgeRow(b, seam.b, 1);
  for (int k = skip_first; k + skip_last < static_cast<int>(a0.size()); ++k)
    a.points[a0[k]] = b.points[b0[k]] = 0.5 * (a.points[a1[k]] + b.points[b1[k]]);
}

}  // namespace gambeson
