#pragma once
/// Small fixed-size vectors and matrices for host and device code.

#include <cmath>

#ifdef __CUDACC__
#define GAMBESON_HD __host__ __device__
#else
#define GAMBESON_HD
#endif

namespace gambeson {

struct Vec2 {
  double x = 0, y = 0;
};

struct Vec3 {
  double x = 0, y = 0, z = 0;
  GAMBESON_HD double& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  GAMBESON_HD double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  GAMBESON_HD Vec3& operator+=(const Vec3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
  GAMBESON_HD Vec3& operator-=(const Vec3& b) {
    x -= b.x;
    y -= b.y;
    z -= b.z;
    return *this;
  }
  GAMBESON_HD Vec3& operator*=(double s) {
    x *= s;
    y *= s;
    z *= s;
    return *this;
  }
  bool operator==(const Vec3&) const = default;
};

GAMBESON_HD inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
GAMBESON_HD inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
GAMBESON_HD inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
GAMBESON_HD inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
GAMBESON_HD inline Vec3 operator*(const Vec3& a, double s) { return s * a; }
GAMBESON_HD inline Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
GAMBESON_HD inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
GAMBESON_HD inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
GAMBESON_HD inline double norm2(const Vec3& a) { return dot(a, a); }
GAMBESON_HD inline double norm(const Vec3& a) { return std::sqrt(norm2(a)); }
/// a/|a|; the caller guarantees |a| > 0.
GAMBESON_HD inline Vec3 normalized(const Vec3& a) { return a / norm(a); }

/// 3 x 3 matrix by columns: M v = v.x * a + v.y * b + v.z * c. The default is the identity.
struct Mat3 {
  Vec3 a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};
  bool operator==(const Mat3&) const = default;
};

GAMBESON_HD inline Vec3 operator*(const Mat3& m, const Vec3& v) { return v.x * m.a + v.y * m.b + v.z * m.c; }
GAMBESON_HD inline Mat3 operator*(const Mat3& m, const Mat3& n) { return {m * n.a, m * n.b, m * n.c}; }
/// Mᵀ v
GAMBESON_HD inline Vec3 transposeTimes(const Mat3& m, const Vec3& v) { return {dot(m.a, v), dot(m.b, v), dot(m.c, v)}; }
GAMBESON_HD inline Mat3 transpose(const Mat3& m) {
  return {{m.a.x, m.b.x, m.c.x}, {m.a.y, m.b.y, m.c.y}, {m.a.z, m.b.z, m.c.z}};
}

/// Rotation by `angle_rad` about the unit vector `axis` (Rodrigues).
inline Mat3 rotationAbout(const Vec3& axis, double angle_rad) {
  const double s = std::sin(angle_rad), t = 2 * std::pow(std::sin(angle_rad / 2), 2);
  const auto turn = [&](const Vec3& e) { return e + s * cross(axis, e) + t * cross(axis, cross(axis, e)); };
  return {turn({1, 0, 0}), turn({0, 1, 0}), turn({0, 0, 1})};
}

/// Position and orientation of frame B in frame W: p_W = rotation p_B + origin.
struct Pose {
  Mat3 rotation;
  Vec3 origin;
  bool operator==(const Pose&) const = default;
};

inline Vec3 operator*(const Pose& X_WB, const Vec3& p_B) { return X_WB.rotation * p_B + X_WB.origin; }
inline Pose operator*(const Pose& X_WA, const Pose& X_AB) {
  return {X_WA.rotation * X_AB.rotation, X_WA * X_AB.origin};
}
inline Pose inverse(const Pose& X) {
  const Mat3 rt = transpose(X.rotation);
  return {rt, -(rt * X.origin)};
}

/// Where a body shape stands: x_W = rotation (scale p_B) + origin. The scale serves virtual projecting (Zheng 6.3).
struct Placement {
  Mat3 rotation;
  Vec3 origin;
  double scale = 1;
  bool operator==(const Placement&) const = default;
};

inline Vec3 operator*(const Placement& X, const Vec3& p) { return X.rotation * (X.scale * p) + X.origin; }
/// The point p with X * p = x_W.
inline Vec3 toLocal(const Placement& X, const Vec3& x_W) {
  return transposeTimes(X.rotation, x_W - X.origin) / X.scale;
}

}  // namespace gambeson
