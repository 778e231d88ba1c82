#include "core/solid/hexahedron.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace gambeson {
namespace {

constexpr double kSign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
constexpr int kRow[6] = {0, 1, 2, 1, 0, 0}, kColumn[6] = {0, 1, 2, 2, 2, 1};

double determinant(const Mat3& m) { return dot(m.a, cross(m.b, m.c)); }

/// E = B u with shears counted twice: a column for each component of the corners.
Eigen::Matrix<double, 6, 24> strainRows(const HexahedronPoint& point, const Mat3& F) {
  const Vec3 column[3] = {F.a, F.b, F.c};
  Eigen::Matrix<double, 6, 24> B;
  for (int n = 0; n < kHexahedronNodes; ++n)
    for (int c = 0; c < 3; ++c)
      for (int a = 0; a < 6; ++a) {
        const int i = kRow[a], j = kColumn[a];
        const Vec3& slope = point.slope_per_m[n];
        B(a, 3 * n + c) = i == j ? column[i][c] * slope[i] : column[i][c] * slope[j] + column[j][c] * slope[i];
      }
  return B;
}

void addForce(const HexahedronPoint& point, const Mat3& F, const Symmetric& S,
              std::array<Vec3, kHexahedronNodes>& force) {
  const Mat3 stress{{S[0], S[5], S[4]}, {S[5], S[1], S[3]}, {S[4], S[3], S[2]}};
  for (int n = 0; n < kHexahedronNodes; ++n) force[n] += point.volume_m3 * (F * (stress * point.slope_per_m[n]));
}

double notANumber(std::array<Vec3, kHexahedronNodes>& force) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  force.fill({nan, nan, nan});
  return nan;
}

}  // namespace

std::array<double, kHexahedronNodes> hexahedronShape(const Vec3& p) {
  std::array<double, kHexahedronNodes> N{};
  for (int a = 0; a < kHexahedronNodes; ++a)
    N[a] = 0.125 * (1 + kSign[a][0] * p.x) * (1 + kSign[a][1] * p.y) * (1 + kSign[a][2] * p.z);
  return N;
}

const std::array<Vec3, 8>& hexahedronPoints() {
  static const std::array<Vec3, 8> points = [] {
    const double g = 1 / std::sqrt(3.0);
    std::array<Vec3, 8> p;
    for (int k = 0; k < 8; ++k) p[k] = {g * kSign[k][0], g * kSign[k][1], g * kSign[k][2]};
    return p;
  }();
  return points;
}

Hexahedron hexahedron(const std::array<Vec3, kHexahedronNodes>& rest) {
  Hexahedron cell;
  for (int g = 0; g < 8; ++g) {
    const Vec3& p = hexahedronPoints()[g];
    std::array<Vec3, kHexahedronNodes> local;
    Mat3 J{{}, {}, {}};  // dX/dp by columns
    for (int a = 0; a < kHexahedronNodes; ++a) {
      const double sx = kSign[a][0], sy = kSign[a][1], sz = kSign[a][2];
      local[a] = {0.125 * sx * (1 + sy * p.y) * (1 + sz * p.z), 0.125 * sy * (1 + sx * p.x) * (1 + sz * p.z),
                  0.125 * sz * (1 + sx * p.x) * (1 + sy * p.y)};
      J.a += local[a].x * rest[a];
      J.b += local[a].y * rest[a];
      J.c += local[a].z * rest[a];
    }
    HexahedronPoint& point = cell[g];
    point.volume_m3 = determinant(J);
    const Vec3 up[3] = {cross(J.b, J.c) / point.volume_m3, cross(J.c, J.a) / point.volume_m3,
                        cross(J.a, J.b) / point.volume_m3};
    for (int a = 0; a < kHexahedronNodes; ++a)
      point.slope_per_m[a] = local[a].x * up[0] + local[a].y * up[1] + local[a].z * up[2];
  }
  return cell;
}

PointStrain strainAt(const HexahedronPoint& point, const std::array<Vec3, kHexahedronNodes>& x) {
  PointStrain s{{{}, {}, {}}, {}, 0};
  for (int n = 0; n < kHexahedronNodes; ++n) {
    s.F.a += point.slope_per_m[n].x * x[n];
    s.F.b += point.slope_per_m[n].y * x[n];
    s.F.c += point.slope_per_m[n].z * x[n];
  }
  s.C = {norm2(s.F.a), norm2(s.F.b), norm2(s.F.c), dot(s.F.b, s.F.c), dot(s.F.a, s.F.c), dot(s.F.a, s.F.b)};
  s.det = determinant(s.F);
  return s;
}

double evaluate(const Hexahedron& cell, const BonetBurton& law, const std::array<Vec3, kHexahedronNodes>& x,
                std::array<Vec3, kHexahedronNodes>& force) {
  force.fill({});
  double energy = 0;
  for (const HexahedronPoint& point : cell) {
    const PointStrain s = strainAt(point, x);
    if (!(s.det > 0)) return notANumber(force);
    const SolidAnswer answer = evaluate(law, point.fibre, s.C);
    energy += point.volume_m3 * answer.energy_J_per_m3;
    addForce(point, s.F, answer.stress_Pa, force);
  }
  return energy;
}

double evaluate(const Hexahedron& cell, const BonetBurton& law, const std::array<Vec3, kHexahedronNodes>& x,
                std::array<Vec3, kHexahedronNodes>& force, std::array<double, 576>& stiffness) {
  force.fill({});
  Eigen::Map<Eigen::Matrix<double, 24, 24, Eigen::RowMajor>> K(stiffness.data());
  K.setZero();
  double energy = 0;
  for (const HexahedronPoint& point : cell) {
    const PointStrain s = strainAt(point, x);
    if (!(s.det > 0)) {
      K.setConstant(std::numeric_limits<double>::quiet_NaN());
      return notANumber(force);
    }
    Elasticity elasticity;
    const SolidAnswer answer = evaluate(law, point.fibre, s.C, elasticity);
    energy += point.volume_m3 * answer.energy_J_per_m3;
    addForce(point, s.F, answer.stress_Pa, force);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> D(elasticity.data());
    const Eigen::Matrix<double, 6, 24> B = strainRows(point, s.F), DB = point.volume_m3 * D * B;
    K.noalias() += B.transpose() * DB;
    const Symmetric& S = answer.stress_Pa;
    const Mat3 stress{{S[0], S[5], S[4]}, {S[5], S[1], S[3]}, {S[4], S[3], S[2]}};
    for (int b = 0; b < kHexahedronNodes; ++b) {
      const Vec3 traction = point.volume_m3 * (stress * point.slope_per_m[b]);
      for (int a = 0; a < kHexahedronNodes; ++a) {
        const double geometric = dot(point.slope_per_m[a], traction);
        for (int c = 0; c < 3; ++c) K(3 * a + c, 3 * b + c) += geometric;
      }
    }
  }
  return energy;
}

std::array<double, 64> shapeProducts(const Hexahedron& cell) {
  std::array<double, 64> products{};
  for (int g = 0; g < 8; ++g) {
    const std::array<double, kHexahedronNodes> N = hexahedronShape(hexahedronPoints()[g]);
    for (int a = 0; a < kHexahedronNodes; ++a)
      for (int b = 0; b < kHexahedronNodes; ++b) products[8 * a + b] += cell[g].volume_m3 * N[a] * N[b];
  }
  return products;
}

}  // namespace gambeson
