#include "core/yarn/cell_faces.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(const std::string& key, double value, const std::string& allowed) {
  throw InputError({"", 0, key}, fmt::format("{:.6g}, must be {}", value, allowed));
}

/// The triangular Phi: columns (along, 0) and (over, up).
struct Triangle {
  double along, over, up;
};
Triangle triangleOf(const CellLoad& l) {
  const double along = std::sqrt(1 + 2 * l.e11), over = l.g12 / along;
  return {along, over, std::sqrt(1 + 2 * l.e22 - over * over)};
}

/// Axes of a bend: along the arcs and across them, in the plane.
struct Bend {
  Vec3 along, across;
  double k;
};
Bend bendOf(const CellLoad& l) {
  const double c = std::cos(l.direction_rad), s = std::sin(l.direction_rad);
  return {{c, s, 0}, {-s, c, 0}, l.curvature_per_m};
}

constexpr double kFlat = 1e-2;  ///< of an angle: below it by series, terms left out are below 1e-16

/// sin(x)/x and (1 - cos(x))/x, and their derivatives.
struct Arc {
  double along, up, d_along, d_up;
};
Arc arcOf(double x) {
  if (std::abs(x) < kFlat) {
    const double q = x * x;
    return {1 - q / 6 * (1 - q / 20 * (1 - q / 42)), x / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56))),
            -x / 3 * (1 - q / 10 * (1 - q / 28 * (1 - q / 54))), 0.5 - q / 8 * (1 - q / 18 * (1 - q / 40))};
  }
  const double s = std::sin(x), v = 2 * std::pow(std::sin(x / 2), 2);
  return {s / x, v / x, (std::cos(x) - s / x) / x, (s - v / x) / x};
}

constexpr Vec3 kUp{0, 0, 1};

/// Where the arc of length s ends, and the turn of the cloth there.
Vec3 arcEnd(const Bend& b, double s) {
  const Arc arc = arcOf(b.k * s);
  return s * (arc.along * b.along + arc.up * kUp);
}
Mat3 arcTurn(const Bend& b, double s) { return rotationAbout(b.across, -b.k * s); }

/// The columns of Phi times the periods.
std::array<Vec3, 2> stepsInPlane(const WovenYarns& yarns, const CellLoad& load) {
  const Triangle t = triangleOf(load);
  return {yarns.period_m(along_weft) * Vec3{t.along, 0, 0}, yarns.period_m(along_warp) * Vec3{t.over, t.up, 0}};
}

}  // namespace

void checkLoad(const CellLoad& load) {
  if (!(load.e11 > -0.5 && std::isfinite(load.e11))) refuse("load.e11", load.e11, "> -0.5");
  if (!(load.e22 > -0.5 && std::isfinite(load.e22))) refuse("load.e22", load.e22, "> -0.5");
  const double most = std::sqrt((1 + 2 * load.e11) * (1 + 2 * load.e22));
  if (!(std::abs(load.g12) < most)) refuse("load.g12", load.g12, fmt::format("within +-{:.6g}", most));
  if (!std::isfinite(load.curvature_per_m)) refuse("load.curvature", load.curvature_per_m, "a number");
  if (!std::isfinite(load.direction_rad)) refuse("load.direction", load.direction_rad, "a number");
}

CellLoad loadOf(const std::array<double, 4>& f) {
  return {0.5 * (f[0] * f[0] + f[2] * f[2] - 1), 0.5 * (f[1] * f[1] + f[3] * f[3] - 1), f[0] * f[1] + f[2] * f[3]};
}

CellLoad shearAsPrinted(double e, double stretch) { return loadOf({stretch, e, e, stretch}); }

CellLoad trellis(double gamma_rad, double stretch) {
  return loadOf({stretch, stretch * std::sin(gamma_rad), 0, stretch * std::cos(gamma_rad)});
}

CellFaces facesOf(const WovenYarns& yarns, const CellLoad& load) {
  const Bend bend = bendOf(load);
  const std::array<Vec3, 2> steps = stepsInPlane(yarns, load);
  CellFaces faces;
  for (int g = 0; g < 2; ++g) {
    if (load.curvature_per_m == 0) {
      faces.step[g].origin = steps[g];
      continue;
    }
    const double s = dot(steps[g], bend.along), m = dot(steps[g], bend.across);
    faces.step[g] = {arcTurn(bend, s), arcEnd(bend, s) + m * bend.across};
  }
  return faces;
}

std::array<FaceMotion, 4> faceMotions(const WovenYarns& yarns, const CellLoad& load) {
  const Triangle t = triangleOf(load);
  const double L1 = yarns.period_m(along_weft), L2 = yarns.period_m(along_warp);
  const double r = t.over / t.along;  // d(over)/d(e11) = -over/along²
  const std::array<std::array<Vec3, 2>, 3> in_plane = {{
      {Vec3{L1 / t.along, 0, 0}, L2 * Vec3{-r / t.along, r * r / t.up, 0}},
      {Vec3{}, L2 * Vec3{0, 1 / t.up, 0}},
      {Vec3{}, L2 * Vec3{1 / t.along, -r / t.up, 0}},
  }};
  const Bend bend = bendOf(load);
  const std::array<Vec3, 2> steps = stepsInPlane(yarns, load);
  std::array<FaceMotion, 4> motions{};
  for (int g = 0; g < 2; ++g) {
    const double s = dot(steps[g], bend.along), x = bend.k * s;
    for (int e = 0; e < 3; ++e) {
      const double ds = dot(in_plane[e][g], bend.along), dm = dot(in_plane[e][g], bend.across);
      motions[e].dt_m[g] = ds * (std::cos(x) * bend.along + std::sin(x) * kUp) + dm * bend.across;
      motions[e].spin_rad[g] = -bend.k * ds * bend.across;
    }
    const Arc arc = arcOf(x);
    motions[3].dt_m[g] = s * s * (arc.d_along * bend.along + arc.d_up * kUp);
    motions[3].spin_rad[g] = -s * bend.across;
  }
  return motions;
}

std::array<std::array<Vec3, 2>, 6> faceCurvature(const WovenYarns& yarns, const CellLoad& load) {
  const Triangle t = triangleOf(load);
  const double L1 = yarns.period_m(along_weft), L2 = yarns.period_m(along_warp);
  const double a2 = t.along * t.along, r = t.over / t.along, u = t.up, u3 = u * u * u;
  // up² = Q = 1 + 2 e22 - over²: first derivatives of Q/2, and second.
  const double q1 = r * r, q2 = 1, q3 = -r;
  const double q11 = -4 * r * r / a2, q13 = 2 * r / a2, q33 = -1 / a2;
  const auto second = [&](double qij, double qi, double qj) { return qij / u - qi * qj / u3; };
  return {{
      {Vec3{-L1 / (a2 * t.along), 0, 0}, L2 * Vec3{3 * t.over / (a2 * a2), second(q11, q1, q1), 0}},
      {Vec3{}, L2 * Vec3{0, second(0, q2, q2), 0}},
      {Vec3{}, L2 * Vec3{0, second(q33, q3, q3), 0}},
      {Vec3{}, L2 * Vec3{0, second(0, q1, q2), 0}},
      {Vec3{}, L2 * Vec3{-1 / (a2 * t.along), second(q13, q1, q3), 0}},
      {Vec3{}, L2 * Vec3{0, second(0, q2, q3), 0}},
  }};
}

std::vector<Pose> carried(std::span<const Pose> sections, const CellLoad& from, const CellLoad& to) {
  const Bend before = bendOf(from), after = bendOf(to);
  const Triangle old_phi = triangleOf(from), new_phi = triangleOf(to);
  std::vector<Pose> out;
  out.reserve(sections.size());
  for (const Pose& section : sections) {
    Vec3 p = section.origin;
    Mat3 rotation = section.rotation;
    if (from.curvature_per_m != 0) {
      const double along = dot(p, before.along), inward = 1 - before.k * p.z;
      const double angle = std::atan2(before.k * along, inward);
      p = angle / before.k * before.along + dot(p, before.across) * before.across +
          (1 - std::hypot(before.k * along, inward)) / before.k * kUp;
      rotation = transpose(arcTurn(before, angle / before.k)) * rotation;
    }
    const double X2 = p.y / old_phi.up, X1 = (p.x - old_phi.over * X2) / old_phi.along;
    p = {new_phi.along * X1 + new_phi.over * X2, new_phi.up * X2, p.z};
    if (to.curvature_per_m != 0) {
      const double s = dot(p, after.along);
      const Mat3 turn = arcTurn(after, s);
      p = arcEnd(after, s) + dot(p, after.across) * after.across + p.z * (turn * kUp);
      rotation = turn * rotation;
    }
    out.push_back({rotation, p});
  }
  return out;
}

}  // namespace gambeson
