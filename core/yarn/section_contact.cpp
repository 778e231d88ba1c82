#include "core/yarn/section_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gambeson {
namespace {

/// F, dF/dd, d²F/dd².
struct Force {
  double value, first, second;
};
Force forceAt(const LateralCompression& law, double touch_m, double d) {
  const double p = law.exponent, u = touch_m / d - 1, du = -touch_m / (d * d), ddu = -2 * du / d;
  const double power = law.half_force_N * std::pow(u, p - 2);
  return {power * u * u, p * power * u * du, p * power * ((p - 1) * du * du + u * ddu)};
}

Mat3 skew(const Vec3& u) { return {cross(u, {1, 0, 0}), cross(u, {0, 1, 0}), cross(u, {0, 0, 1})}; }
/// (x uᵀ + u xᵀ)/2 - (x . u) 1: the second derivative of x . exp(w) u in w.
Mat3 turnedTwice(const Vec3& x, const Vec3& u) {
  const double d = dot(x, u);
  const auto column = [&](int j) {
    Vec3 unit{};
    unit[j] = d;
    return 0.5 * (u[j] * x + x[j] * u) - unit;
  };
  return {column(0), column(1), column(2)};
}
void add(Mat3& to, double s, const Mat3& m) { to.a += s * m.a, to.b += s * m.b, to.c += s * m.c; }
void addOuter(Mat3& to, double s, const Vec3& x, const Vec3& y) {
  to.a += (s * y.x) * x, to.b += (s * y.y) * x, to.c += (s * y.z) * x;
}
constexpr Mat3 kNone{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};

/// Derivatives in the way r from the second to the first section and the turns of both.
using Three = std::array<Vec3, 3>;
struct Blocks {
  Three first{};
  std::array<std::array<Mat3, 3>, 3> second{{{kNone, kNone, kNone}, {kNone, kNone, kNone}, {kNone, kNone, kNone}}};
};

/// From upper blocks to places and turns of the two sections.
void fill(const Blocks& b, bool tangent, SectionPair& out) {
  out.gradient = {b.first[0], b.first[1], -b.first[0], b.first[2]};
  if (!tangent) return;
  constexpr int kBlock[] = {0, 1, 0, 2};
  constexpr double kSign[] = {1, 1, -1, 1};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const int r = kBlock[i], c = kBlock[j];
      const Mat3 m = r <= c ? b.second[r][c] : transpose(b.second[c][r]);
      const Vec3* columns[] = {&m.a, &m.b, &m.c};
      for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) out.tangent[12 * (3 * i + x) + 3 * j + y] = kSign[i] * kSign[j] * (*columns[y])[x];
    }
}

/// p = r . u, q = r . v, c = u . v, a = det(r, u, v), and what follows from them.
struct Chords {
  Vec3 r, u, v;
  double p, q, c, a;
  double g, w;  ///< 1/sin², 1/sin of the angle between chords
  double v1, v2, h;
};
Chords chordsOf(const Pose& first, const Pose& second, double above) {
  Chords k{first.origin - second.origin, first.rotation.b, second.rotation.b, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  k.p = dot(k.r, k.u), k.q = dot(k.r, k.v), k.c = dot(k.u, k.v), k.a = dot(k.r, cross(k.u, k.v));
  k.g = 1 / (1 - k.c * k.c), k.w = std::sqrt(k.g);
  k.v1 = (k.c * k.q - k.p) * k.g, k.v2 = (k.q - k.c * k.p) * k.g, k.h = above * k.a * k.w;
  return k;
}

}  // namespace

double pressureShare(const CrossingContact& k) {
  return std::sqrt(k.half_thickness_m[0] * k.half_thickness_m[1]) /
         (2 * std::numbers::pi * k.half_width_m[0] * k.half_width_m[1]);
}

double CrossingContact::distance_m(const Pose& first, const Pose& second, double above) const {
  const Chords k = chordsOf(first, second, above);
  const auto bulge = [&](int e) { return half_thickness_m[e] / (half_width_m[e] * half_width_m[e]); };
  return k.h + 0.5 * (bulge(0) * k.v1 * k.v1 + bulge(1) * k.v2 * k.v2);
}

double CrossingContact::reach_m() const {
  // b1 v1²/(2 a1²) + b2 v2²/(2 a2²) <= 2 D, and |v2 v - v1 u|² <= 2 (v1² + v2²).
  double widest = 0;
  for (int e = 0; e < 2; ++e) widest = std::max(widest, half_width_m[e] * half_width_m[e] / half_thickness_m[e]);
  return std::sqrt(8 * touch_m() * widest + touch_m() * touch_m());
}

std::array<double, 2> CrossingContact::meeting_m(const Pose& first, const Pose& second) const {
  const Chords k = chordsOf(first, second, 1);
  return {k.v1, k.v2};
}

SectionPair CrossingContact::evaluate(const Pose& first, const Pose& second, double above, bool tangent) const {
  SectionPair out;
  const double d = distance_m(first, second, above);
  if (!(d < touch_m())) return out;
  if (!(d > 0)) {
    out.energy = std::numeric_limits<double>::infinity();
    return out;
  }
  const Chords k = chordsOf(first, second, above);
  const double k1 = half_thickness_m[0] / (half_width_m[0] * half_width_m[0]),
               k2 = half_thickness_m[1] / (half_width_m[1] * half_width_m[1]);
  const double c = k.c, g = k.g, w = k.w, v1 = k.v1, v2 = k.v2, h = k.h;
  // In the order p, q, c, a.
  const double turn1 = v2 + c * v1, turn2 = v1 + c * v2;
  const std::array<double, 4> v1_{-g, c * g, g * turn1, 0}, v2_{-c * g, g, g * turn2, 0},
      h_{0, 0, c * g * h, above * w}, w_{0, 0, c * g * w, 0};
  std::array<double, 4> d_{};
  for (int i = 0; i < 4; ++i) d_[i] = h_[i] + k1 * v1 * v1_[i] + k2 * v2 * v2_[i];

  const double share = pressureShare(*this);
  const Force F = forceAt(law, touch_m(), d);
  const double psi = share * F.value, dpsi = share * F.first, ddpsi = share * F.second;
  out.energy = w * psi;
  out.pressing = -w * dpsi;
  std::array<double, 4> W_{};
  for (int i = 0; i < 4; ++i) W_[i] = w_[i] * psi + w * dpsi * d_[i];

  const Vec3 &r = k.r, &u = k.u, &v = k.v, m = cross(u, v), vr = cross(v, r), ru = cross(r, u);
  const std::array<Three, 4> by{Three{u, cross(u, r), Vec3{}}, Three{v, Vec3{}, vr}, Three{Vec3{}, m, -m},
                                Three{m, cross(u, vr), cross(v, ru)}};
  Blocks b;
  for (int s = 0; s < 4; ++s)
    for (int e = 0; e < 3; ++e) b.first[e] += W_[s] * by[s][e];
  if (tangent) {
    const double by_angle = g * (1 + 3 * c * c * g), cg2 = c * g * g, mixed = g * (1 + 2 * c * c * g);
    // Second derivatives that are not 0: p c, q c, c c of v1 and v2; c c and c a of h; c c of w.
    const double v1_cc = 2 * cg2 * turn1 + g * (v2_[2] + v1 + c * v1_[2]),
                 v2_cc = 2 * cg2 * turn2 + g * (v1_[2] + v2 + c * v2_[2]);
    std::array<std::array<double, 4>, 4> D{};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) D[i][j] = k1 * v1_[i] * v1_[j] + k2 * v2_[i] * v2_[j];
    const auto set = [&](int i, int j, double value) {
      D[i][j] += value;
      if (i != j) D[j][i] += value;
    };
    set(0, 2, k1 * v1 * (-2 * cg2) + k2 * v2 * (-mixed));
    set(1, 2, k1 * v1 * mixed + k2 * v2 * (2 * cg2));
    set(2, 2, k1 * v1 * v1_cc + k2 * v2 * v2_cc + by_angle * h);
    set(2, 3, above * c * g * w);
    std::array<std::array<double, 4>, 4> W{};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        W[i][j] = (i == 2 && j == 2 ? by_angle * w * psi : 0) + dpsi * (w_[i] * d_[j] + w_[j] * d_[i]) +
                  w * (ddpsi * d_[i] * d_[j] + dpsi * D[i][j]);
    for (int s = 0; s < 4; ++s)
      for (int t = 0; t < 4; ++t)
        for (int e = 0; e < 3; ++e)
          for (int f = e; f < 3; ++f) addOuter(b.second[e][f], W[s][t], by[s][e], by[t][f]);
    const Mat3 U = skew(u), V = skew(v), R = skew(r);
    const auto [Wp, Wq, Wc, Wa] = W_;
    add(b.second[0][1], -Wp, U), add(b.second[0][1], Wa, V * U);
    add(b.second[0][2], -Wq, V), add(b.second[0][2], -Wa, U * V);
    add(b.second[1][1], Wp, turnedTwice(r, u)), add(b.second[1][1], Wc, turnedTwice(v, u)),
        add(b.second[1][1], Wa, turnedTwice(vr, u));
    add(b.second[2][2], Wq, turnedTwice(r, v)), add(b.second[2][2], Wc, turnedTwice(u, v)),
        add(b.second[2][2], Wa, turnedTwice(ru, v));
    add(b.second[1][2], -Wc, U * V), add(b.second[1][2], Wa, U * R * V);
  }
  // Turns about each section's own axes.
  const Mat3 *R1 = &first.rotation, *R2 = &second.rotation;
  b.first[1] = transposeTimes(*R1, b.first[1]), b.first[2] = transposeTimes(*R2, b.first[2]);
  if (tangent) {
    b.second[0][1] = b.second[0][1] * *R1, b.second[0][2] = b.second[0][2] * *R2;
    b.second[1][1] = transpose(*R1) * b.second[1][1] * *R1, b.second[1][2] = transpose(*R1) * b.second[1][2] * *R2;
    b.second[2][2] = transpose(*R2) * b.second[2][2] * *R2;
  }
  fill(b, tangent, out);
  return out;
}

namespace {

/// Of y with the ellipsoid's axes: y_i/D_i².
Vec3 scaledBy(const Vec3& inverse_square, const Vec3& y) {
  return {inverse_square.x * y.x, inverse_square.y * y.y, inverse_square.z * y.z};
}
Vec3 axesOf(const BesideContact& k) {
  const auto inverse = [](double length) { return 1 / (length * length); };
  return {inverse(k.half_thickness_m), inverse(2 * k.half_width_m), inverse(2 * k.half_thickness_m)};
}
double squareOf(const BesideContact& k, const Pose& first, const Pose& second) {
  const Vec3 r = first.origin - second.origin, axes = axesOf(k);
  double sum = 0;
  for (const Pose* s : {&first, &second}) {
    const Vec3 y = transposeTimes(s->rotation, r);
    sum += 0.5 * dot(y, scaledBy(axes, y));
  }
  return sum;
}

}  // namespace

double BesideContact::reach_m() const { return std::max(2 * half_width_m, 2 * half_thickness_m); }

double BesideContact::distance(const Pose& first, const Pose& second) const {
  return std::sqrt(squareOf(*this, first, second));
}

SectionPair BesideContact::evaluate(const Pose& first, const Pose& second, bool tangent) const {
  SectionPair out;
  const double square = squareOf(*this, first, second);
  if (!(square < 1)) return out;
  const double rho = std::sqrt(square), D = touch_m, stiff = 2 * half_width_m / D * by_area;
  const Force F = forceAt(law, D, rho * D);
  const double d1 = 0.5 * D / rho, d2 = -0.25 * D / (rho * square);
  const double W1 = stiff * F.first * d1, W2 = stiff * (F.second * d1 * d1 + F.first * d2);
  out.energy = stiff * F.value;

  const Vec3 r = first.origin - second.origin, axes = axesOf(*this);
  const Pose* section[] = {&first, &second};
  Three q{};
  Blocks b;
  for (int e = 0; e < 2; ++e) {
    const Mat3& R = section[e]->rotation;
    const Vec3 y = transposeTimes(R, r), s = scaledBy(axes, y);
    q[0] += R * s;
    q[e + 1] = cross(s, y);
    if (!tangent) continue;
    const Mat3 Y = skew(y), scaling{{axes.x, 0, 0}, {0, axes.y, 0}, {0, 0, axes.z}}, stretched = scaling * Y;
    add(b.second[0][0], W1, R * scaling * transpose(R));
    Mat3 mixed = stretched;
    add(mixed, -1, skew(s));
    add(b.second[0][e + 1], W1, R * mixed);
    add(b.second[e + 1][e + 1], W1, transpose(Y) * stretched);
    add(b.second[e + 1][e + 1], W1, turnedTwice(s, y));
  }
  for (int e = 0; e < 3; ++e) {
    b.first[e] = W1 * q[e];
    if (!tangent) continue;
    for (int f = e; f < 3; ++f) addOuter(b.second[e][f], W2, q[e], q[f]);
  }
  out.pressing = norm(b.first[0]);
  fill(b, tangent, out);
  return out;
}

}  // namespace gambeson
