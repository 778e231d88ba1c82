#include "core/solid/facet_projection.hpp"

#include <Eigen/Dense>

namespace gambeson {
namespace {

using Row = Eigen::Matrix<double, kProjectionSize, 1>;
using Square = Eigen::Matrix<double, kProjectionSize, kProjectionSize, Eigen::RowMajor>;

Eigen::Vector3d vectorOf(const Vec3& v) { return {v.x, v.y, v.z}; }

/// r with its derivatives in xi, as numbers and as rows on z.
struct Derivatives {
  double weight[5];    ///< of r on x_s and the corners
  double slope[2][5];  ///< of r_a
  double twist[5];     ///< of r_12
  Eigen::Vector3d r, ra[2], r12;
  Eigen::Matrix2d H, inverse;  ///< phi_ab

  Derivatives(const FacetCorners& x, const Vec3& node, const Vec2& at) {
    static constexpr double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    weight[0] = 1, slope[0][0] = slope[1][0] = twist[0] = 0;
    for (int k = 0; k < 4; ++k) {
      weight[k + 1] = -0.25 * (1 + sign[k][0] * at.x) * (1 + sign[k][1] * at.y);
      slope[0][k + 1] = -0.25 * sign[k][0] * (1 + sign[k][1] * at.y);
      slope[1][k + 1] = -0.25 * sign[k][1] * (1 + sign[k][0] * at.x);
      twist[k + 1] = -0.25 * sign[k][0] * sign[k][1];
    }
    const auto sum = [&](const double* w) {
      Eigen::Vector3d v = w[0] * vectorOf(node);
      for (int k = 0; k < 4; ++k) v += w[k + 1] * vectorOf(x[k]);
      return v;
    };
    r = sum(weight);
    ra[0] = sum(slope[0]), ra[1] = sum(slope[1]);
    r12 = sum(twist);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) H(a, b) = ra[a].dot(ra[b]) + (a != b ? r.dot(r12) : 0.0);
    inverse = H.inverse();
  }

  /// The row on z of v . (sum of weights times positions).
  static Row on(const double* w, const Eigen::Vector3d& v) {
    Row row;
    for (int k = 0; k < 5; ++k) row.segment<3>(3 * k) = w[k] * v;
    return row;
  }
  Row mixed(int a) const { return on(weight, ra[a]) + on(slope[a], r); }  ///< phi_az
  /// n . r_ab
  double bend(const Eigen::Vector3d& n, int a, int b) const { return a != b ? n.dot(r12) : 0; }
};

Row rowOf(const ProjectionSlope& s) { return Eigen::Map<const Row>(s.data()); }

}  // namespace

FacetProjection projectionOf(const FacetCorners& corners, const Vec3& x, const Vec2& local) {
  const Derivatives d(corners, x, local);
  FacetProjection p;
  p.local = local;
  const Eigen::Vector3d n = d.ra[0].cross(d.ra[1]).normalized();
  p.normal = {n(0), n(1), n(2)};
  p.gap_m = -d.r.dot(n);
  Eigen::Map<Row>(p.gap_slope.data()) = -Derivatives::on(d.weight, n);
  const Row mixed[2] = {d.mixed(0), d.mixed(1)};
  for (int a = 0; a < 2; ++a)
    Eigen::Map<Row>(p.local_slope[a].data()) = -d.inverse(a, 0) * mixed[0] - d.inverse(a, 1) * mixed[1];
  return p;
}

void addGapCurvature(const FacetCorners& corners, const Vec3& x, const FacetProjection& at, double factor,
                     ProjectionMatrix& out) {
  const Derivatives d(corners, x, at.local);
  Eigen::Map<Square> K(out.data());
  const Eigen::Vector3d n = vectorOf(at.normal);
  const Row xi[2] = {rowOf(at.local_slope[0]), rowOf(at.local_slope[1])};
  Eigen::Matrix2d metric;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b) metric(a, b) = d.ra[a].dot(d.ra[b]);
  const Eigen::Matrix2d dual = metric.inverse();
  for (int a = 0; a < 2; ++a) {
    const Eigen::Vector3d ta = -(dual(a, 0) * d.ra[0] + dual(a, 1) * d.ra[1]);
    const Row turn = Derivatives::on(d.slope[a], n) + d.bend(n, a, 0) * xi[0] + d.bend(n, a, 1) * xi[1];
    K.noalias() -= factor * (Derivatives::on(d.slope[a], n) * xi[a].transpose());
    K.noalias() -= factor * (Derivatives::on(d.weight, ta) * turn.transpose());
  }
}

void addLocalCurvature(const FacetCorners& corners, const Vec3& x, const FacetProjection& at, const Vec2& factor,
                       ProjectionMatrix& out) {
  const Derivatives d(corners, x, at.local);
  Eigen::Map<Square> K(out.data());
  const Row xi[2] = {rowOf(at.local_slope[0]), rowOf(at.local_slope[1])};
  const Eigen::Vector2d w = d.inverse * Eigen::Vector2d(factor.x, factor.y);
  const auto second = [&](int a, int b) -> Eigen::Vector3d { return a != b ? d.r12 : Eigen::Vector3d::Zero(); };
  for (int a = 0; a < 2; ++a) {
    for (int b = 0; b < 2; ++b) {
      // phi_abz
      Row row = Derivatives::on(d.slope[a], d.ra[b]) + Derivatives::on(d.slope[b], d.ra[a]);
      if (a != b) row += Derivatives::on(d.weight, d.r12) + Derivatives::on(d.twist, d.r);
      K.noalias() -= w(a) * (row * xi[b].transpose() + xi[b] * row.transpose());
      for (int c = 0; c < 2; ++c) {
        const double third = d.ra[a].dot(second(b, c)) + d.ra[b].dot(second(a, c)) + d.ra[c].dot(second(a, b));
        K.noalias() -= w(a) * third * (xi[b] * xi[c].transpose());
      }
    }
    for (int k = 0; k < 5; ++k)
      for (int l = 0; l < 5; ++l) {
        const double both = d.slope[a][k] * d.weight[l] + d.weight[k] * d.slope[a][l];
        for (int c = 0; c < 3; ++c) K(3 * k + c, 3 * l + c) -= w(a) * both;
      }
  }
}

}  // namespace gambeson
