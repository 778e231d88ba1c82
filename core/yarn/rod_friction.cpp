#include "core/yarn/rod_friction.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace gambeson {

void checkRodFriction(const RodFriction& friction) {
  constexpr double kMost = 10;
  if (!(friction.coefficient >= 0 && friction.coefficient <= kMost))
    throw InputError({"", 0, "friction.coefficient"},
                     fmt::format("{:.6g}, must be from 0 to {:g}", friction.coefficient, kMost));
  const double k = friction.stick_stiffness_N_per_m3;
  if (friction.coefficient > 0 && !(k > 0 && std::isfinite(k)))
    throw InputError({"", 0, "friction.stick_stiffness"}, fmt::format("{:.6g}, must be > 0", k));
}

RodGrip gripBetween(const Pose& first, const Pose& second, const Vec3& slip_m) {
  const Vec3 half = 0.5 * (slip_m - (first.origin - second.origin));
  return {transposeTimes(first.rotation, half), transposeTimes(second.rotation, -half)};
}

RodSlip slipOf(const RodGrip& grip, const Pose& first, const Pose& second) {
  RodSlip s;
  s.apart = first.origin - second.origin;
  s.arm[0] = first.rotation * grip.on_first;
  s.arm[1] = second.rotation * grip.on_second;
  const Vec3 gap = s.apart + s.arm[0] - s.arm[1];
  s.along = dot(gap, s.apart) / norm2(s.apart);
  s.slip = gap - s.along * s.apart;
  return s;
}

StickSlip stickSlip(double stiffness_N_per_m, double limit_N, double slip_m) {
  const double k = stiffness_N_per_m, r = slip_m;
  if (k * r <= limit_N) return {0.5 * k * r * r, k, false};
  return {limit_N * (r - 0.5 * limit_N / k), limit_N / r, true};
}

/// With z = dg - c dd, rho = |g_t|²:
///   d(rho)/2 = g_t . z,  d²(rho)/2 = |z|² - (d . z + g_t . dd)²/|d|² + g_t . d²g.
RodFrictionAnswer evaluateRodFriction(const RodGrip& grip, const Pose& first, const Pose& second,
                                      double stiffness_N_per_m, double limit_N, bool tangent) {
  const RodSlip s = slipOf(grip, first, second);
  const double rho = norm2(s.slip);
  const StickSlip law = stickSlip(stiffness_N_per_m, limit_N, std::sqrt(rho));
  const double secant = law.secant_N_per_m;
  RodFrictionAnswer out;
  out.energy_J = law.energy_J;
  const std::array<const Mat3*, 2> turn{&first.rotation, &second.rotation};
  const std::array<const Vec3*, 2> end{&grip.on_first, &grip.on_second};
  std::array<Vec3, 2> slip_in;  // by the axes of a section
  for (int e = 0; e < 2; ++e) {
    const double sign = e == 0 ? 1 : -1;
    slip_in[e] = transposeTimes(*turn[e], s.slip);
    out.gradient[2 * e] = sign * secant * (1 - s.along) * s.slip;
    out.gradient[2 * e + 1] = sign * secant * cross(*end[e], slip_in[e]);
  }
  if (!tangent) return out;

  std::array<Vec3, 12> z{};
  std::array<double, 12> line{}, slide{};
  for (int e = 0; e < 2; ++e)
    for (int c = 0; c < 3; ++c) {
      const double sign = e == 0 ? 1 : -1;
      Vec3 unit{};
      unit[c] = sign;
      z[6 * e + c] = (1 - s.along) * unit;
      z[6 * e + 3 + c] = *turn[e] * cross(unit, *end[e]);
      line[6 * e + c] = dot(unit, s.slip);
    }
  for (int i = 0; i < 12; ++i) line[i] += dot(z[i], s.apart), slide[i] = dot(z[i], s.slip);
  const double by_line = 1 / norm2(s.apart), by_slide = law.slides ? 1 / rho : 0;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      out.tangent[12 * i + j] =
          secant * (dot(z[i], z[j]) - by_line * (line[i] * line[j]) - by_slide * (slide[i] * slide[j]));
  for (int e = 0; e < 2; ++e) {  // g_t . d²g = slip . (w x (w x end)) of a turn w
    const double sign = e == 0 ? 1 : -1;
    const Vec3 &a = *end[e], &g = slip_in[e];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out.tangent[12 * (6 * e + 3 + i) + 6 * e + 3 + j] +=
            sign * secant * (0.5 * (g[i] * a[j] + g[j] * a[i]) - (i == j ? dot(g, a) : 0));
  }
  return out;
}

/// X = x + R exp(a) c: dX = dx + R (a x c) + R (a x (a x c))/2.
RodFrictionAnswer fromAside(const RodFrictionAnswer& answer, const Pose& first, const Pose& second,
                            const std::array<double, 2>& aside_m, bool tangent) {
  RodFrictionAnswer out = answer;
  std::array<Vec3, 12> by_turn{};  // dX of a turn: of the section e, turn i at 6 e + 3 + i
  const Pose* section[] = {&first, &second};
  for (int e = 0; e < 2; ++e) {
    const Vec3 c{0, aside_m[e], 0}, force = transposeTimes(section[e]->rotation, answer.gradient[2 * e]);
    out.gradient[2 * e + 1] += cross(c, force);
    for (int i = 0; i < 3; ++i) {
      Vec3 unit{};
      unit[i] = 1;
      by_turn[6 * e + 3 + i] = section[e]->rotation * cross(unit, c);
    }
  }
  if (!tangent) return out;
  // K J, then Jᵀ (K J).
  std::array<double, 144> half = answer.tangent;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (int x = 0; x < 3; ++x) half[12 * i + j] += answer.tangent[12 * i + 6 * (j / 6) + x] * by_turn[j][x];
  out.tangent = half;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (int x = 0; x < 3; ++x) out.tangent[12 * i + j] += by_turn[i][x] * half[12 * (6 * (i / 6) + x) + j];
  for (int e = 0; e < 2; ++e) {
    const Vec3 c{0, aside_m[e], 0}, force = transposeTimes(section[e]->rotation, answer.gradient[2 * e]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out.tangent[12 * (6 * e + 3 + i) + 6 * e + 3 + j] +=
            0.5 * (force[i] * c[j] + force[j] * c[i]) - (i == j ? dot(force, c) : 0);
  }
  return out;
}

}  // namespace gambeson
