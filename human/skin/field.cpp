#include "human/skin/field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// What turns the manikin's ellipsoids into a body. Factors of the named measure; lengths [m] at a stature of 1.755 m,
/// scaled with stature. Chosen by eye (no published counterpart) so that the girths of the data are kept.
namespace shape {
constexpr double crotch_over_pelvis = 0.53;        ///< crotch below the hips over the pelvis's vertical semi-axis
constexpr double thigh_lateral_over_round = 0.83;  ///< the fore-aft semi-axis keeps the girth
constexpr double thigh_outward_over_hip_half = 0.12;
}  // namespace shape

/// Radius of the circle with the perimeter of the ellipse a, b.
double roundRadius(double a, double b) {
  if (a < b) std::swap(a, b);
  return 2 * a * std::comp_ellint_2(std::sqrt(std::max(0.0, 1 - b * b / (a * a)))) / std::numbers::pi;
}
/// The other semi-axis of the ellipse with the semi-axis b and the perimeter of the circle r.
double otherSemiAxis(double b, double r) {
  double lo = 0, hi = 2 * r;
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (lo + hi);
    (roundRadius(a, b) < r ? lo : hi) = a;
  }
  return 0.5 * (lo + hi);
}

Vec3 flipped(const Vec3& x) { return {x.x, -x.y, x.z}; }

/// A part of the manikin: its ellipsoid with its centre and frame in the world.
struct Part {
  Pose X_WS;
  Vec3 semi;
};

Part partOf(const Human& human, std::span<const Pose> link_poses, const std::string& name) {
  for (const BodyShape& s : human.shapes)
    if (s.name == name && std::holds_alternative<Ellipsoid>(s.shape))
      return {link_poses[s.link] * s.X_LS, std::get<Ellipsoid>(s.shape).semi_axes};
  throw InputError({"", 0, "skin"}, "needs a body with an ellipsoid '" + name + "', as our manikins have");
}

Pose linkPose(const Human& human, std::span<const Pose> link_poses, const std::string& name) {
  const int l = human.skeleton.link(name);
  if (l < 0) throw InputError({"", 0, "skin"}, "needs a skeleton with a link '" + name + "', as our manikins have");
  return link_poses[l];
}

}  // namespace

double smoothMin(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * h * k / 6;
}

Loft::Loft(const Pose& X_WF, std::vector<Station> stations, double low, double high)
    : X_FW_(inverse(X_WF)), at_(std::move(stations)), slope_(at_.size()), low_(low), high_(high) {
  const auto slopes = [&](double Station::*value) {
    const auto secant = [&](std::size_t i) { return (at_[i + 1].*value - at_[i].*value) / (at_[i + 1].z - at_[i].z); };
    for (std::size_t i = 1; i + 1 < at_.size(); ++i) {
      const double s = secant(i - 1), t = secant(i);
      slope_[i].*value = s * t > 0 ? 2 * s * t / (s + t) : 0;
    }
    slope_.front().*value = slope_.back().*value = 0;
  };
  for (const auto value : {&Station::cx, &Station::cy, &Station::a, &Station::b}) slopes(value);
}

double Loft::operator()(const Vec3& x_W) const {
  const Vec3 p = X_FW_ * x_W;
  const double z = std::clamp(p.z, at_.front().z, at_.back().z);
  std::size_t i = 0;
  while (i + 2 < at_.size() && z > at_[i + 1].z) ++i;
  const double step = at_[i + 1].z - at_[i].z, u = (z - at_[i].z) / step, w = 1 - u;
  const auto value = [&](double Station::*m) {
    return w * w * (1 + 2 * u) * at_[i].*m + u * u * (1 + 2 * w) * at_[i + 1].*m +
           step * u * w * (w * slope_[i].*m - u * slope_[i + 1].*m);
  };
  const double a = value(&Station::a), b = value(&Station::b), c = p.z < z ? low_ : high_;
  const Vec3 q{(p.x - value(&Station::cx)) / a, (p.y - value(&Station::cy)) / b, (p.z - z) / c};
  const double k0 = norm(q), k1 = norm(Vec3{q.x / a, q.y / b, q.z / c});
  if (k0 < 1e-3) return -std::min(a, b);
  return k0 * (k0 - 1) / k1;
}

double RoundCone::operator()(const Vec3& x) const {
  const Vec3 axis = b - a;
  const double length2 = norm2(axis), u = std::clamp(dot(x - a, axis) / length2, 0.0, 1.0), w = u * u * (3 - 2 * u);
  return norm(x - (a + u * axis)) - ((1 - w) * ra + w * rb);
}

double FramedEllipsoid::operator()(const Vec3& x_W) const {
  const Vec3 p = X_FW * x_W, q{p.x / semi.x, p.y / semi.y, p.z / semi.z};
  const double k0 = norm(q), k1 = norm(Vec3{q.x / semi.x, q.y / semi.y, q.z / semi.z});
  if (k0 < 1e-3) return -std::min({semi.x, semi.y, semi.z});
  return k0 * (k0 - 1) / k1;
}

struct BodyField::Parts {
  Loft trunk, neck, leg, arm;
  FramedEllipsoid buttock, head, jaw, foot, hand;
  RoundCone trapezius, girdle, instep;
  double scale;
  Vec3 neck_base, wrist, ankle;
};

namespace {

Loft trunkOf(const Human& human, std::span<const Pose> X_WL) {
  const Part hips = partOf(human, X_WL, "pelvis"), iliac = partOf(human, X_WL, "iliac"),
             waist = partOf(human, X_WL, "waist"), chest = partOf(human, X_WL, "chest");
  const Vec3 root = hips.X_WS.origin, shoulder = linkPose(human, X_WL, "upper_arm_left").origin;
  const Vec3 c = chest.semi;
  const double sz = shoulder.z - root.z, cz = chest.X_WS.origin.z - root.z, drop = sz - cz;
  const double mx = root.x, cx = chest.X_WS.origin.x, sx = shoulder.x;
  const auto at = [&](const Part& p) {
    return Loft::Station{p.X_WS.origin.z - root.z, p.X_WS.origin.x, 0, p.semi.x, p.semi.y};
  };
  std::vector<Loft::Station> s;
  s.push_back({0, mx + 0.03 * hips.semi.x, 0, 0.93 * hips.semi.x, 0.925 * hips.semi.y});
  s.push_back(at(iliac));
  s.push_back(at(waist));
  const Vec3 w = waist.semi;
  const double wz = waist.X_WS.origin.z - root.z;
  s.push_back({0.5 * (wz + cz), 0.5 * (waist.X_WS.origin.x + cx), 0, 0.485 * (w.x + c.x), 0.98 * std::min(w.y, c.y)});
  s.push_back(at(chest));
  s.push_back({cz + 0.25 * drop, 0.85 * cx + 0.15 * sx, 0, 0.98 * c.x, 1.01 * c.y});
  return Loft({{}, {0, 0, root.z}}, s, shape::crotch_over_pelvis * hips.semi.z, 1.30 * drop);
}

Loft legOf(const Human& human, std::span<const Pose> X_WL) {
  const Pose X_WT = linkPose(human, X_WL, "thigh_left");
  const Pose X_TW = inverse(X_WT);
  const Vec3 knee = X_TW * linkPose(human, X_WL, "shank_left").origin;
  const Vec3 ankle = X_TW * linkPose(human, X_WL, "foot_left").origin;
  const double hip_half = std::abs(X_WT.origin.y - X_WL[0].origin.y);
  const Part thigh = partOf(human, X_WL, "thigh_left"), joint = partOf(human, X_WL, "knee_left"),
             shank = partOf(human, X_WL, "shank_left");
  const double r = roundRadius(thigh.semi.x, thigh.semi.y), lateral = shape::thigh_lateral_over_round * r,
               deep = otherSemiAxis(lateral, r), k = joint.semi.x, calf = shank.semi.x;
  const double out = shape::thigh_outward_over_hip_half * hip_half, lt = -knee.z, ls = knee.z - ankle.z;
  const auto bone = [&](double z) {
    return z > knee.z ? knee.x * z / knee.z : knee.x + (ankle.x - knee.x) * (knee.z - z) / ls;
  };
  std::vector<Loft::Station> s;
  const auto add = [&](double z, double x, double y, double a, double b) { s.push_back({z, bone(z) + x, y, a, b}); };
  add(ankle.z + 0.0 * ls, 0, 0, 0.62 * calf, 0.50 * calf);
  add(ankle.z + 0.10 * ls, 0.0, 0, 0.60 * calf, 0.54 * calf);
  add(ankle.z + 0.35 * ls, -0.10 * calf, 0, 0.80 * calf, 0.77 * calf);
  add(ankle.z + 0.68 * ls, -0.22 * calf, 0, 1.01 * calf, 0.98 * calf);
  add(ankle.z + 0.88 * ls, -0.10 * calf, 0, 0.92 * calf, 0.88 * calf);
  add(knee.z, 0, 0, 1.00 * k, 0.95 * k);
  add(-0.80 * lt, 0.04 * k, 0.15 * out, 1.12 * k, 1.05 * k);
  add(-0.50 * lt, 0.05 * r, 0.6 * out, 0.985 * deep, 0.99 * lateral);
  add(-0.25 * lt, -0.03 * r, out, deep, lateral);
  add(-0.06 * lt, -0.10 * r, out, 0.92 * deep, 0.96 * lateral);
  add(0.08 * lt, -0.14 * r, 0.8 * out, 0.80 * deep, 0.84 * lateral);
  return Loft(X_WT, s, 0.5 * calf, 0.8 * r);
}

Loft armOf(const Human& human, std::span<const Pose> X_WL) {
  const Pose X_WU = linkPose(human, X_WL, "upper_arm_left");
  const Pose X_UW = inverse(X_WU);
  const Vec3 elbow = X_UW * linkPose(human, X_WL, "forearm_left").origin;
  const Vec3 wrist = X_UW * linkPose(human, X_WL, "hand_left").origin;
  const double u = partOf(human, X_WL, "upper_arm_left").semi.x, f = partOf(human, X_WL, "forearm_left").semi.x;
  const double lu = -elbow.z, lf = elbow.z - wrist.z;
  std::vector<Loft::Station> s;
  s.push_back({wrist.z, 0, 0, 0.66 * f, 0.48 * f});
  s.push_back({wrist.z + 0.15 * lf, 0, 0, 0.66 * f, 0.52 * f});
  s.push_back({wrist.z + 0.70 * lf, 0.08 * f, 0, 0.98 * f, 0.98 * f});
  s.push_back({elbow.z, 0, 0, 0.86 * f, 0.92 * f});
  s.push_back({elbow.z + 0.18 * lu, 0, 0, 0.80 * u, 0.80 * u});
  s.push_back({elbow.z + 0.55 * lu, 0.04 * u, 0, 1.03 * u, 0.97 * u});
  s.push_back({elbow.z + 0.80 * lu, 0, 0, 1.04 * u, 0.98 * u});
  s.push_back({0, 0, 0, 1.02 * u, 0.98 * u});
  return Loft(X_WU, s, 0.3 * f, 0.98 * u);
}

}  // namespace

BodyField::BodyField(const Human& human, std::span<const Pose> X_WL) {
  const double scale = human.stature_m / 1.755;
  const Part hips = partOf(human, X_WL, "pelvis"), head = partOf(human, X_WL, "head"),
             neck = partOf(human, X_WL, "neck"), foot = partOf(human, X_WL, "foot_left"),
             hand = partOf(human, X_WL, "hand_left"), upper_arm = partOf(human, X_WL, "upper_arm_left");
  const auto ellipsoid = [](const Pose& X_WF, const Vec3& offset, const Vec3& semi) {
    return FramedEllipsoid{inverse(X_WF * Pose{{}, offset}), semi};
  };
  const Vec3 h = hips.semi, C7 = linkPose(human, X_WL, "head").origin,
             shoulder = linkPose(human, X_WL, "upper_arm_left").origin, skull = head.X_WS.origin;
  const double rn = neck.semi.x, ra = upper_arm.semi.x;
  Loft neck_loft({{}, {}},
                 {{C7.z - 0.06 * scale, C7.x + 0.012 * scale, 0, 1.06 * rn, 1.06 * rn},
                  {C7.z + 0.03 * scale, C7.x + 0.02 * scale, 0, rn, rn},
                  {skull.z - 0.3 * head.semi.z, skull.x - 0.012 * scale, 0, rn, 0.95 * rn}},
                 0.5 * rn, 0.5 * rn);
  const FramedEllipsoid buttock =
      ellipsoid(hips.X_WS, {-0.40 * h.x, 0.40 * h.y, -0.18 * h.z}, {0.60 * h.x, 0.46 * h.y, 0.85 * h.z});
  const RoundCone trapezius{{C7.x + 0.2 * (shoulder.x - C7.x), 0.35 * rn, C7.z - 0.062 * scale},
                            {shoulder.x, 0.88 * shoulder.y, shoulder.z + 0.04 * ra},
                            0.9 * rn,
                            0.90 * ra};
  const Part chest = partOf(human, X_WL, "chest");
  const Vec3 sternum{0.5 * (chest.X_WS.origin.x + shoulder.x), 0.50 * chest.semi.y, shoulder.z - 0.055 * scale};
  const RoundCone girdle{
      sternum, {shoulder.x, 0.97 * shoulder.y, shoulder.z - 0.010 * scale}, 0.60 * chest.semi.x, 0.96 * ra};
  const Vec3 ankle = linkPose(human, X_WL, "foot_left").origin, toes = foot.X_WS * Vec3{0.35 * foot.semi.x, 0, 0};
  const RoundCone instep{ankle, toes, 0.95 * foot.semi.z, 0.75 * foot.semi.z};
  parts_ = std::make_shared<const Parts>(
      Parts{trunkOf(human, X_WL), neck_loft, legOf(human, X_WL), armOf(human, X_WL), buttock,
            ellipsoid(head.X_WS, {0, 0, 0.10 * head.semi.z}, {head.semi.x, head.semi.y, 0.90 * head.semi.z}),
            ellipsoid(head.X_WS, {0.30 * head.semi.x, 0, -0.45 * head.semi.z},
                      {0.62 * head.semi.x, 0.68 * head.semi.y, 0.55 * head.semi.z}),
            ellipsoid(foot.X_WS, {}, foot.semi),
            ellipsoid(hand.X_WS, {}, {0.92 * hand.semi.x, 1.45 * hand.semi.y, 0.96 * hand.semi.z}), trapezius, girdle,
            instep, scale, C7, linkPose(human, X_WL, "hand_left").origin, linkPose(human, X_WL, "foot_left").origin});
  low_ = {1e9, 1e9, 1e9};
  high_ = -low_;
  for (const BodyShape& s : human.shapes) {
    if (!std::holds_alternative<Ellipsoid>(s.shape)) continue;
    const Pose X = X_WL[s.link] * s.X_LS;
    const Vec3 e = std::get<Ellipsoid>(s.shape).semi_axes;
    for (int i = 0; i < 3; ++i) {
      const Mat3& R = X.rotation;
      const double reach = norm(Vec3{R.a[i] * e.x, R.b[i] * e.y, R.c[i] * e.z}) + 0.02;
      low_[i] = std::min(low_[i], X.origin[i] - reach);
      high_[i] = std::max(high_[i], X.origin[i] + reach);
    }
  }
}

double BodyField::side(const Vec3& x) const {
  const Parts& p = *parts_;
  return smoothMin(p.leg(x), smoothMin(p.foot(x), p.instep(x), 0.03 * p.scale), 0.03 * p.scale);
}

double BodyField::withoutArms(const Vec3& x) const {
  const Parts& p = *parts_;
  const Vec3 l{x.x, std::abs(x.y), x.z}, r = flipped(l);
  const double k = p.scale;
  double f = p.trunk(l);
  f = smoothMin(f, smoothMin(p.buttock(l), p.buttock(r), 0.01 * k), 0.03 * k);
  f = smoothMin(f, smoothMin(p.trapezius(l), p.trapezius(r), 0.05 * k), 0.05 * k);
  f = smoothMin(f, smoothMin(p.girdle(l), p.girdle(r), 0.05 * k), 0.06 * k);
  f = smoothMin(f, smoothMin(p.neck(l), smoothMin(p.head(l), p.jaw(l), 0.03 * k), 0.03 * k), 0.04 * k);
  return smoothMin(f, smoothMin(side(l), side(r), 0.02 * k), 0.045 * k);
}

double BodyField::arm(const Vec3& x) const {
  const Parts& p = *parts_;
  const Vec3 l{x.x, std::abs(x.y), x.z};
  return smoothMin(p.arm(l), p.hand(l), 0.02 * p.scale);
}

double BodyField::operator()(const Vec3& x) const { return smoothMin(withoutArms(x), arm(x), 0.035 * parts_->scale); }

double BodyField::towardsArm(const Vec3& x) const { return withoutArms(x) - arm(x); }

double BodyField::towardsLeftLeg(const Vec3& x) const { return side(flipped(x)) - side(x); }

Vec3 BodyField::gradient(const Vec3& x) const {
  constexpr double h = 1e-5;
  const auto& f = *this;
  return Vec3{f({x.x + h, x.y, x.z}) - f({x.x - h, x.y, x.z}), f({x.x, x.y + h, x.z}) - f({x.x, x.y - h, x.z}),
              f({x.x, x.y, x.z + h}) - f({x.x, x.y, x.z - h})} /
         (2 * h);
}

double BodyField::coarseness(const Vec3& x) const {
  const Parts& p = *parts_;
  const double reach = 0.10 * p.scale;
  const auto ramp = [](double u) {
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3 - 2 * u);
  };
  const double hand = std::abs(x.y) > 0.8 * p.wrist.y ? 0.4 * ramp((p.wrist.z + reach - x.z) / reach) : 0;
  return std::max({ramp((x.z - p.neck_base.z) / reach), 0.6 * ramp((p.ankle.z + reach - x.z) / reach), hand});
}

}  // namespace gambeson
