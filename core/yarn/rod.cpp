#include "core/yarn/rod.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion4 = Eigen::Vector4d;  ///< scalar part first
using Jacobian = Eigen::Matrix<double, 4, 6>;

Vector3 toEigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 fromEigen(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
Matrix3 toEigen(const Mat3& m) {
  Matrix3 e;
  e << toEigen(m.a), toEigen(m.b), toEigen(m.c);
  return e;
}
Matrix3 crossMatrix(const Vector3& v) {
  Matrix3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The unit quaternion of a rotation of less than half a turn.
Quaternion4 quaternionOf(const Matrix3& rotation) {
  const Eigen::Quaterniond q(rotation);
  const Quaternion4 v{q.w(), q.x(), q.y(), q.z()};
  return (v[0] < 0 ? -1.0 : 1.0) * v.normalized();
}
/// q (0, e_k) for k = 0, 1, 2, by columns; and (0, e_k) q.
Eigen::Matrix<double, 4, 3> timesAxes(const Quaternion4& q) {
  Eigen::Matrix<double, 4, 3> m;
  m << -q.tail<3>().transpose(), q[0] * Matrix3::Identity() + crossMatrix(q.tail<3>());
  return m;
}
Eigen::Matrix<double, 4, 3> axesTimes(const Quaternion4& q) {
  Eigen::Matrix<double, 4, 3> m;
  m << -q.tail<3>().transpose(), q[0] * Matrix3::Identity() - crossMatrix(q.tail<3>());
  return m;
}

/// F = 2 acos(c)/sqrt(1 - c²), with which F(q_0) q_v is the rotation vector of the unit quaternion q, and its first two
/// derivatives. (1 - c²) F' = c F - 2; differentiated n times, (1 - c²) F^(n+1) = (2n + 1) c F^(n) + n² F^(n-1).
struct Angle {
  double F, first, second;
};
Angle angleFactor(double c) {
  if (c < 0.9) {
    const double s2 = 1 - c * c, F = 2 * std::acos(c) / std::sqrt(s2), first = (c * F - 2) / s2;
    return {F, first, (F + 3 * c * first) / s2};
  }
  // Around c = 1 by F^(n) = -n²/(2n + 1) F^(n-1) there: terms fall with (1 - c)/2.
  constexpr int kTerms = 16;
  const double x = c - 1;
  Angle a{0, 0, 0};
  double derivative = 2, power = 1;  // F^(n) at 1, x^n/n!
  double previous = 0, before = 0;   // x^(n-1)/(n-1)!, x^(n-2)/(n-2)!
  for (int n = 0; n < kTerms; ++n) {
    a.F += derivative * power;
    a.first += derivative * previous;
    a.second += derivative * before;
    before = previous, previous = power;
    power *= x / (n + 1);
    derivative *= -double(n + 1) * (n + 1) / (2 * n + 3);
  }
  return a;
}

/// Rotations of a piece in the axes of its section a.
struct Turn {
  Quaternion4 q;  ///< from a to b
  Quaternion4 p;  ///< 1 + q: half way, not of unit length
  Angle angle;
  Vector3 turn() const { return angle.F * q.tail<3>(); }
  Matrix3 half() const {
    const Quaternion4 m = p.normalized();
    return Eigen::Quaterniond(m[0], m[1], m[2], m[3]).toRotationMatrix();
  }
};
Turn turnBetween(const Pose& a, const Pose& b) {
  Turn t;
  t.q = quaternionOf(toEigen(a.rotation).transpose() * toEigen(b.rotation));
  t.p = t.q;
  t.p[0] += 1;
  t.angle = angleFactor(t.q[0]);
  return t;
}

/// p^T M p = |p|² n . R(p)^T e, by columns of a basis of n the three matrices of |p|² R(p)^T e.
Eigen::Matrix4d formOf(const Vector3& n, const Vector3& e) {
  Eigen::Matrix4d m;
  const Vector3 across = e.cross(n);
  m(0, 0) = n.dot(e);
  m.block<1, 3>(0, 1) = -across.transpose();
  m.block<3, 1>(1, 0) = -across;
  m.block<3, 3>(1, 1) = -n.dot(e) * Matrix3::Identity() + n * e.transpose() + e * n.transpose();
  return m;
}

}  // namespace

RodSection ellipticSection(double young_Pa, double shear_Pa, double half_width_m, double half_thickness_m) {
  const auto check = [](const char* key, double value, const char* unit) {
    if (!(value > 0 && std::isfinite(value)))
      throw InputError({"", 0, key}, fmt::format("{:.6g} {}, must be > 0", value, unit));
  };
  check("yarn.young", young_Pa, "Pa");
  check("yarn.shear", shear_Pa, "Pa");
  check("yarn.half_width", half_width_m, "m");
  check("yarn.half_thickness", half_thickness_m, "m");
  const double a = half_width_m, b = half_thickness_m, area = std::numbers::pi * a * b;
  const auto k = [](double along, double other) {
    return 12 * (3 * along * along + other * other) / (40 * along * along + 16 * other * other);
  };
  return {young_Pa * area,
          k(a, b) * shear_Pa * area,
          k(b, a) * shear_Pa * area,
          shear_Pa * area * a * a * b * b / (a * a + b * b),
          young_Pa * area * b * b / 4,
          young_Pa * area * a * a / 4};
}

RodPiece restPiece(const Pose& a, const Pose& b, double length_m) {
  const Turn t = turnBetween(a, b);
  const Vector3 chord = toEigen(a.rotation).transpose() * toEigen(b.origin - a.origin);
  return {length_m, fromEigen(t.half().transpose() * chord / length_m), fromEigen(t.turn() / length_m)};
}

RodAnswer evaluateRod(const RodSection& section, const RodPiece& piece, const Pose& a, const Pose& b,
                      RodTangent tangent) {
  const double h = piece.length_m;
  const Turn t = turnBetween(a, b);
  const Matrix3 Ra = toEigen(a.rotation);
  const Vector3 e = Ra.transpose() * toEigen(b.origin - a.origin);
  const Matrix3 Rm = t.half();
  const Vector3 gamma = Rm.transpose() * e, psi = t.turn();

  const Vector3 shear(0, section.shear_across_N, section.shear_through_N);
  const Vector3 bend(section.torsion_Nm2, section.bending_through_Nm2, section.bending_in_plane_Nm2);
  const Vector3 Gamma = gamma / h, strain = Gamma - toEigen(piece.strain);
  const Vector3 curvature = psi / h - toEigen(piece.curvature_per_m);
  const double length = Gamma.norm(), stretch = length - norm(piece.strain);
  const Vector3 along = Gamma / length;
  const double tension = section.stretch_N * stretch;
  const Vector3 n = tension * along + shear.cwiseProduct(strain), m = bend.cwiseProduct(curvature);

  RodAnswer out;
  out.energy_J = 0.5 * h * (tension * stretch + strain.dot(shear.cwiseProduct(strain)) + m.dot(curvature));
  out.tension_N = tension, out.force_N = fromEigen(n), out.moment_Nm = fromEigen(m);

  // dp and dq over (alpha, beta): sections are exp(alpha/2) and q exp(beta/2), the relative one exp(-alpha/2) q
  // exp(beta/2).
  Quaternion4 one = Quaternion4::Zero();
  one[0] = 1;
  Jacobian dp, dq;
  dp << 0.5 * timesAxes(one), 0.5 * timesAxes(t.q);
  dq << -0.5 * axesTimes(t.q), 0.5 * timesAxes(t.q);

  // f = p^T M p/p^T p of each component of gamma.
  const double p2 = t.p.squaredNorm();
  Eigen::Matrix<double, 3, 4> dgamma_dp;
  for (int k = 0; k < 3; ++k)
    dgamma_dp.row(k) = (2 / p2 * (formOf(Vector3::Unit(k), e) * t.p - gamma[k] * t.p)).transpose();
  Eigen::Matrix<double, 3, 4> dpsi_dq;
  dpsi_dq << t.angle.first * t.q.tail<3>(), t.angle.F * Matrix3::Identity();

  // Over (chord in a's axes, alpha, beta).
  Eigen::Matrix<double, 3, 9> dgamma, dpsi;
  dgamma << Rm.transpose(), dgamma_dp * dp;
  dpsi << Matrix3::Zero(), dpsi_dq * dq;
  const Eigen::Matrix<double, 9, 1> g = dgamma.transpose() * n + dpsi.transpose() * m;

  // From (chord, alpha, beta) to (dx_a, alpha_a, dx_b, alpha_b).
  Eigen::Matrix<double, 9, 12> toUnknowns = Eigen::Matrix<double, 9, 12>::Zero();
  toUnknowns.block<3, 3>(0, 0) = -Ra.transpose();
  toUnknowns.block<3, 3>(0, 6) = Ra.transpose();
  toUnknowns.block<3, 3>(3, 3) = toUnknowns.block<3, 3>(6, 9) = Matrix3::Identity();
  Eigen::Map<Eigen::Matrix<double, 12, 1>>(out.gradient.data()) = toUnknowns.transpose() * g;
  if (tangent == RodTangent::none) return out;

  const double across = (tangent == RodTangent::downhill ? std::max(tension, 0.0) : tension) / length;
  Matrix3 stiff = across * Matrix3::Identity() + (section.stretch_N - across) * along * along.transpose();
  stiff.diagonal() += shear;
  Eigen::Matrix<double, 9, 9> H =
      dgamma.transpose() * (stiff / h) * dgamma + dpsi.transpose() * (bend / h).asDiagonal() * dpsi;
  // What n and m do along second derivatives.
  const double f = n.dot(gamma);
  const Quaternion4 df = dgamma_dp.transpose() * n;
  const Eigen::Matrix4d f_pp =
      (2 * formOf(n, e) - 2 * f * Eigen::Matrix4d::Identity() - 2 * (t.p * df.transpose() + df * t.p.transpose())) / p2;
  Eigen::Matrix<double, 3, 4> f_ep;  // of p^T M(n, e) p/p² in e and p
  const double s = t.p[0];
  const Vector3 v = t.p.tail<3>();
  f_ep << 2 * (s * n + v.cross(n)),
      2 * (v.dot(n) * Matrix3::Identity() + v * n.transpose() - n * v.transpose() - s * crossMatrix(n));
  f_ep = ((f_ep - 2 * (Rm * n) * t.p.transpose()) / p2).eval();
  const double w = m.dot(t.q.tail<3>());
  Eigen::Matrix4d s_qq = Eigen::Matrix4d::Zero();
  s_qq(0, 0) = t.angle.second * w;
  s_qq.block<1, 3>(0, 1) = t.angle.first * m.transpose();
  s_qq.block<3, 1>(1, 0) = t.angle.first * m;
  const Quaternion4 ds = dpsi_dq.transpose() * m;

  const Eigen::Matrix<double, 3, 6> H_ep = f_ep * dp;
  H.block<3, 6>(0, 3) += H_ep;
  H.block<6, 3>(3, 0) += H_ep.transpose();
  H.block<6, 6>(3, 3) += dp.transpose() * f_pp * dp + dq.transpose() * s_qq * dq;
  const Matrix3 unit = Matrix3::Identity();
  H.block<3, 3>(3, 3) -= 0.25 * (df[0] + ds.dot(t.q)) * unit;
  H.block<3, 3>(6, 6) -= 0.25 * (df.dot(t.q) + ds.dot(t.q)) * unit;
  const Eigen::Matrix<double, 4, 3> q_beta = timesAxes(t.q);
  Matrix3 mixed;  // -1/4 ds . (e_j q e_k)
  for (int k = 0; k < 3; ++k) mixed.col(k) = -0.25 * axesTimes(q_beta.col(k)).transpose() * ds;
  H.block<3, 3>(3, 6) += mixed;
  H.block<3, 3>(6, 3) += mixed.transpose();
  Eigen::Map<Eigen::Matrix<double, 12, 12>>(out.tangent.data()) = toUnknowns.transpose() * H * toUnknowns;
  return out;
}

Mat3 turned(const Mat3& rotation, const Vec3& alpha_rad) {
  const double angle = norm(alpha_rad), half = 0.5 * angle;
  const double part = angle > 1e-4 ? std::sin(half) / angle : 0.5 - angle * angle / 48;
  const Vec3 v = part * alpha_rad;
  const Eigen::Quaterniond by(std::cos(half), v.x, v.y, v.z);
  const Matrix3 m = (Eigen::Quaterniond(toEigen(rotation)) * by).normalized().toRotationMatrix();
  return {fromEigen(m.col(0)), fromEigen(m.col(1)), fromEigen(m.col(2))};
}

}  // namespace gambeson
