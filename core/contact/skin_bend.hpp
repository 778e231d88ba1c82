#pragma once
/// How the skin follows the links (skin.hpp), a vertex at a time, for host and device. A vertex turns about each of its
/// joints by its share of the joint's rotation since the bind posture, distal joints first; then creases keep the two
/// sides of a joint apart.
///
/// The inside of a fold: with psi = 1 - 2 share running from 0 on the plane to 1 a half-width away, a point at distance
/// s from the plane and r above the axis comes to
///   s' = s cos(psi theta/2) - r sin(psi theta/2)
/// from the bisecting plane, so the skin does not overtake itself where psi'(0) r theta/2 < 1: half-widths are chosen
/// above 1.25 r theta/2 for the bends that bodies make (hip 95, knee 110, elbow 115 degrees).
///
/// A crease: with the distance d of a point from the bisecting plane, counted into its own side,
///   d' = d                          for u = (d - h)/b - 1 >= 0,
///   d' = h + b / (1 - u + u²)       for u < 0,        h = S gap/2,  b = S (softness),
/// S growing from 0 at rest to 1 at a bend of 30 degrees. d -> d' is C² and strictly increasing, d' > h: a surface that
/// does not cross itself does not by being flattened either; at rest nothing moves.

#include <algorithm>

#include "core/math/vec.hpp"

namespace gambeson::skin_bend {

constexpr double kSoftness = 0.005;    ///< b [m]: the flattening begins about this far off the plane
constexpr double kFullSine2 = 0.0670;  ///< sin²(15 degrees)

struct Quaternion {
  double w = 1;
  Vec3 v;
};

/// Of a rotation by less than 180 degrees (Shepperd's other cases are not met by joints of a body but kept for safety).
GAMBESON_HD inline Quaternion quaternion(const Mat3& m) {
  const double trace = m.a.x + m.b.y + m.c.z;
  Quaternion q;
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q = {0.25 * s, {(m.b.z - m.c.y) / s, (m.c.x - m.a.z) / s, (m.a.y - m.b.x) / s}};
  } else if (m.a.x >= m.b.y && m.a.x >= m.c.z) {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.a.x - m.b.y - m.c.z));
    q = {(m.b.z - m.c.y) / s, {0.25 * s, (m.b.x + m.a.y) / s, (m.c.x + m.a.z) / s}};
  } else if (m.b.y >= m.c.z) {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.b.y - m.a.x - m.c.z));
    q = {(m.c.x - m.a.z) / s, {(m.b.x + m.a.y) / s, 0.25 * s, (m.c.y + m.b.z) / s}};
  } else {
    const double s = 2 * std::sqrt(std::max(0.0, 1 + m.c.z - m.a.x - m.b.y));
    q = {(m.a.y - m.b.x) / s, {(m.c.x + m.a.z) / s, (m.c.y + m.b.z) / s, 0.25 * s}};
  }
  if (q.w < 0) q = {-q.w, -q.v};
  return q;
}

/// The w-th part of a rotation, by normalised linear interpolation: exact at 0, 1/2 and 1.
GAMBESON_HD inline Quaternion part(const Quaternion& q, double w) {
  const double r = 1 - w + w * q.w;
  const double n = 1 / std::sqrt(r * r + w * w * norm2(q.v));
  return {r * n, (w * n) * q.v};
}

GAMBESON_HD inline Vec3 turned(const Quaternion& q, const Vec3& p) {
  const Vec3 t = 2 * cross(q.v, p);
  return p + q.w * t + cross(q.v, t);
}

// Poses as core/math/vec.hpp has them, for kernels.
GAMBESON_HD inline Vec3 moved(const Pose& X, const Vec3& p) { return X.rotation * p + X.origin; }
GAMBESON_HD inline Pose composed(const Pose& X, const Pose& Y) { return {X.rotation * Y.rotation, moved(X, Y.origin)}; }
GAMBESON_HD inline Pose inverted(const Pose& X) {
  const Mat3 rt = transpose(X.rotation);
  return {rt, -(rt * X.origin)};
}

/// What a joint has turned by since the bind posture.
GAMBESON_HD inline Quaternion turnOf(const Pose& parent, const Pose& parent_bind, const Pose& child,
                                     const Pose& child_bind) {
  const Mat3 p = parent.rotation * transpose(parent_bind.rotation), c = child.rotation * transpose(child_bind.rotation);
  return quaternion(transpose(p) * c);
}
/// All of a turn about a point.
GAMBESON_HD inline Pose wholeTurn(const Quaternion& q, const Vec3& about) {
  const Mat3 R{turned(q, {1, 0, 0}), turned(q, {0, 1, 0}), turned(q, {0, 0, 1})};
  return {R, about - R * about};
}

// A vertex coordinate by coordinate, so that loops over many become vector code.
GAMBESON_HD inline void moveRigidly(const Mat3& R, const Vec3& o, double& x, double& y, double& z) {
  const double a = x, b = y, c = z;
  x = a * R.a.x + b * R.b.x + c * R.c.x + o.x;
  y = a * R.a.y + b * R.b.y + c * R.c.y + o.y;
  z = a * R.a.z + b * R.b.z + c * R.c.z + o.z;
}
/// By the w-th part of a turn about c: part() and turned(), written out. v2: norm2(q.v).
GAMBESON_HD inline void turnPartly(const Quaternion& q, double v2, const Vec3& c, double w, double& x, double& y,
                                   double& z) {
  const double r = 1 - w + w * q.w, s = 1 / std::sqrt(r * r + w * w * v2), qw = r * s, f = w * s;
  const double vx = f * q.v.x, vy = f * q.v.y, vz = f * q.v.z;
  const double a = x - c.x, b = y - c.y, d = z - c.z;
  const double tx = 2 * (vy * d - vz * b), ty = 2 * (vz * a - vx * d), tz = 2 * (vx * b - vy * a);
  x += qw * tx + (vy * tz - vz * ty);
  y += qw * ty + (vz * tx - vx * tz);
  z += qw * tz + (vx * ty - vy * tx);
}

/// The bisecting plane of a bend, and how far it keeps what folds there apart.
struct Crease {
  Vec3 normal;
  double level_m = 0, half_gap_m = 0, softness_m = 0;
  bool folds = false;
};
/// `turn`: of the bend; `parent`: where its parent link is and was.
GAMBESON_HD inline Crease creaseOf(const Quaternion& turn, const Pose& parent, const Pose& parent_bind,
                                   const Vec3& centre, const Vec3& normal, double offset_m, double gap_m) {
  const double bent = std::clamp(norm2(turn.v) / kFullSine2, 0.0, 1.0), S = bent * bent * (3 - 2 * bent);
  Crease c;
  if (S == 0) return c;
  const Pose A = composed(parent, inverted(parent_bind));
  c.normal = A.rotation * turned(part(turn, 0.5), normal);
  c.level_m = dot(c.normal, moved(A, centre)) + offset_m;
  c.half_gap_m = 0.5 * S * gap_m;
  c.softness_m = S * kSoftness;
  c.folds = true;
  return c;
}
/// A vertex on a side (+1, -1) of a crease that folds.
GAMBESON_HD inline void crease(const Crease& c, double side, double strength, Vec3& p) {
  const double d = side * (dot(c.normal, p) - c.level_m) - c.half_gap_m, b = c.softness_m, u = d / b - 1;
  if (u < 0) p += (strength * side * (b / (1 - u + u * u) - d)) * c.normal;
}

}  // namespace gambeson::skin_bend
