// Shorts of six patches drafted on a body; the layout is described in pattern.hpp.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/motion.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"
#include "tryon/pattern/pattern.hpp"
#include "tryon/pattern/section.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

/// The body as the tape sees it, standing.
class Drafted {
 public:
  explicit Drafted(const Human& human) : human_(human) {
    const Skeleton& s = human.skeleton;
    const int thigh = s.link("thigh_left"), torso = s.link("torso");
    if (thigh < 0 || s.link("thigh_right") < 0)
      reject("garment.shorts", "needs a human with links thigh_left and thigh_right");
    const Posture posture = standing(human);
    median_y_ = posture.root.origin.y;
    placements_ = placementsOf(human, linkPoses(s, posture.q, posture.root));
    for (std::size_t i = 0; i < human.shapes.size(); ++i) {
      const int link = human.shapes[i].link;
      if (link == 0) pelvis_.push_back(i);
      if (link == thigh) thigh_.push_back(i);
      if (link == 0 || link == thigh || link == torso) trunk_.push_back(i);
    }
    if (pelvis_.empty() || thigh_.empty())
      reject("garment.shorts", "needs a human with a surface on the root link and on thigh_left");
  }

  /// Lowest point of the pelvis [m].
  double pelvisBottom() const {
    double lowest = HUGE_VAL;
    for (const std::size_t i : pelvis_) {
      const Placement& X = placements_[i];
      if (const auto* e = std::get_if<Ellipsoid>(&human_.shapes[i].shape)) {
        const Vec3 up = transposeTimes(X.rotation, {0, 0, 1});
        const Vec3 a{e->semi_axes.x * up.x, e->semi_axes.y * up.y, e->semi_axes.z * up.z};
        lowest = std::min(lowest, X.origin.z - X.scale * norm(a));
      } else {
        for (const Vec3& v : std::get<TriangleMesh>(human_.shapes[i].shape).vertices)
          lowest = std::min(lowest, (X * v).z);
      }
    }
    return lowest;
  }
  /// The wrap of pelvis, torso and both thighs between two heights; the left half is mirrored.
  Wrap trunk(double from, double to) const {
    constexpr int heights = 65;
    std::vector<std::vector<Vec2>> sections;
    for (int k = 0; k < heights; ++k)
      sections.push_back(hull(trunk_, from + (to - from) * k / (heights - 1), true, "rise_m"));
    return Wrap(sections, from, to);
  }
  ClosedCurve leftThigh(double z) const { return ClosedCurve(hull(thigh_, z, false, "inseam_m")); }
  double medianY() const { return median_y_; }

 private:
  std::vector<Vec2> hull(const std::vector<std::size_t>& shapes, double z, bool mirrored, const char* key) const {
    std::vector<Vec2> points;
    for (const std::size_t i : shapes)
      for (const Vec2& p : section(human_.shapes[i].shape, placements_[i], z)) {
        points.push_back(p);
        if (mirrored) points.push_back({p.x, 2 * median_y_ - p.y});
      }
    auto out = convexHull(std::move(points));
    if (out.size() < 3) reject(key, "reaches the height " + std::to_string(z) + " m, where the body has no section");
    return out;
  }

  const Human& human_;
  std::vector<Placement> placements_;
  std::vector<std::size_t> pelvis_, thigh_, trunk_;
  double median_y_ = 0;
};

/// The left half of the shorts as surfaces of (s, t), both from 0 to 1.
class Draft {
 public:
  Draft(const ShortsPattern& p, const Drafted& body)
      : p_(p),
        body_(body),
        crotch_z_(body.pelvisBottom() - p.crotch_below_pelvis_m),
        trunk_(body.trunk(crotch_z_, crotch_z_ + p.rise_m)) {
    notch_half_width_ = body.leftThigh(crotch_z_).centroid().y - body.medianY();
    if (!(notch_half_width_ > 0)) reject("garment.shorts", "thigh_left does not stand on the left of the body");

    const Tape top = tape(0);
    const double depth = top.front_x - top.back_x;
    const int around = cellsFor(0.5 * (top.half + tape(1).half));
    trunk_cells_ = {around, cellsFor(p.rise_m)};
    leg_cells_ = cellsFor(p.inseam_m);
    inner_cells_ = std::max(3, cellsFor(p.gusset_share * depth));
    if (!(p.degree < inner_cells_ + 2))
      reject("cell_m", "too large for the degree: the inner leg would have few cells");
  }

  int around() const { return trunk_cells_[0]; }
  int rise() const { return trunk_cells_[1]; }
  int leg() const { return leg_cells_; }
  int inner() const { return inner_cells_; }

  /// s from centre front to centre back around the left hip, t from the crotch's level up to the waist.
  Vec3 trunk(double s, double t) const {
    const std::vector<Vec2> section = halfSection(t);
    std::vector<double> at{0};
    for (std::size_t i = 1; i < section.size(); ++i)
      at.push_back(at.back() + std::hypot(section[i].x - section[i - 1].x, section[i].y - section[i - 1].y));
    const double length = s * at.back();
    const std::size_t i = std::upper_bound(at.begin() + 1, at.end() - 1, length) - at.begin();
    const double f = (length - at[i - 1]) / (at[i] - at[i - 1]);
    const Vec2 &a = section[i - 1], &b = section[i];
    return {a.x + f * (b.x - a.x), a.y + f * (b.y - a.y), crotch_z_ + t * p_.rise_m};
  }
  /// s from the front leg line around the outside to the back leg line, t from the hem up to the trunk.
  Vec3 outer(double s, double t) const { return blend(trunk(s, 0), legPoint(s * share(), t), t); }
  /// s from the back leg line around the inside to the front leg line, t from the hem up to the gusset line.
  Vec3 inner(double s, double t) const {
    const Vec3 cf = trunk(0, 0), cb = trunk(1, 0);
    return blend((1 - s) * cb + s * cf, legPoint(share() + s * (1 - share()), t), t);
  }

 private:
  /// The trunk's section grown by the ease.
  struct Tape {
    ClosedCurve curve;
    double front = 0, half = 0;  ///< arc length where the centre front stands, and to the centre back
    double front_x = 0, back_x = 0;
  };
  Tape tape(double t) const {
    const ClosedCurve body(trunk_.section(crotch_z_ + t * p_.rise_m));
    const Vec2 c{body.centroid().x, body_.medianY()};
    const ClosedCurve grown = body.grown(1 + p_.ease, c);
    const double front = grown.crossing(c, {1, 0}), half = 0.5 * grown.length();
    return {grown, front, half, grown.point(front).x, grown.point(front + half).x};
  }
  /// The trunk's section with the fork, from centre front to centre back: the tape, drawn towards the middle by a bell
  /// across and a parabola upward, both flat where they end, so that the section mirrors without a kink.
  std::vector<Vec2> halfSection(double t) const {
    const Tape around = tape(t);
    const double up = std::max(0.0, 1 - t * p_.rise_m / p_.fork_m);
    constexpr int n = 720;
    std::vector<Vec2> out;
    for (int k = 0; k <= n; ++k) {
      Vec2 x = around.curve.point(around.front + around.half * k / n);
      if (k == 0 || k == n) x.y = body_.medianY();
      const double y = std::min(1.0, (x.y - body_.medianY()) / notch_half_width_);
      const double pull = (1 - p_.gusset_share) * std::pow(std::cos(0.5 * std::numbers::pi * y) * up, 2);
      const double middle = 0.5 * (around.front_x + around.back_x);
      out.push_back({x.x + pull * (middle - x.x), x.y});
    }
    return out;
  }
  int cellsFor(double length_m) const {
    const double n = std::round(length_m / p_.cell_m);
    if (!(n <= 1000)) reject("cell_m", std::to_string(p_.cell_m) + ", too small: more than 1000 cells along an edge");
    return std::max(2, static_cast<int>(n));
  }
  /// Share of the outer leg in the leg's girth: cells of the same length on both sides of the leg lines.
  double share() const { return static_cast<double>(around()) / (around() + inner()); }
  /// The thigh's tape by the fraction of its length, from the front leg line, outside first.
  Vec3 legPoint(double fraction, double t) const {
    const double z = crotch_z_ - (1 - t) * p_.inseam_m;
    const ClosedCurve body = body_.leftThigh(z);
    const ClosedCurve tape = body.grown(1 + p_.ease, body.centroid());
    const double innermost = tape.crossing(body.centroid(), {0, -1});
    const Vec2 x = tape.point(innermost + (fraction + 0.5 * (1 - share())) * tape.length());
    return {x.x, x.y, z};
  }
  /// The fork's outline at the top goes over into the thigh's section, with a slope there and without one below.
  Vec3 blend(const Vec3& top, const Vec3& leg, double t) const {
    const double q = std::max(0.0, 1 - (1 - t) * p_.inseam_m / p_.blend_m), w = q * q;
    return {leg.x + w * (top.x - leg.x), leg.y + w * (top.y - leg.y), leg.z};
  }

  const ShortsPattern& p_;
  const Drafted& body_;
  double crotch_z_;
  Wrap trunk_;
  double notch_half_width_ = 0;
  std::array<int, 2> trunk_cells_{};
  int leg_cells_ = 0, inner_cells_ = 0;
};

/// The patch on the other side; u is turned round, so that the normal still points outward.
NurbsPatch mirrored(const NurbsPatch& p, double median_y) {
  NurbsPatch out = p;
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      const Vec3& x = p.points[p.index(p.u.count() - 1 - i, j)];
      out.points[p.index(i, j)] = {x.x, 2 * median_y - x.y, x.z};
    }
  return out;
}

void check(const ShortsPattern& p) {
  requirePositive("inseam_m", p.inseam_m);
  requirePositive("rise_m", p.rise_m);
  requirePositive("cell_m", p.cell_m);
  if (!(p.gusset_share > 0.2 && p.gusset_share <= 1))
    reject("gusset_share", std::to_string(p.gusset_share) + ", must lie above 0.2 and not above 1");
  requirePositive("fork_m", p.fork_m);
  requirePositive("blend_m", p.blend_m);
  requireDegree(p.degree, 2);
  if (!(p.ease > -0.5 && p.ease < 2)) reject("ease", std::to_string(p.ease) + ", must lie between -0.5 and 2");
  if (!(p.crotch_below_pelvis_m > -0.1 && p.crotch_below_pelvis_m < 0.2))
    reject("crotch_below_pelvis_m", std::to_string(p.crotch_below_pelvis_m) + ", must lie between -0.1 and 0.2");
  if (!(p.seam_stiffness_N >= 0) || !std::isfinite(p.seam_stiffness_N))
    reject("seam_stiffness_N", "must not be negative");
  if (!(p.fork_m <= p.rise_m)) reject("fork_m", "must not exceed rise_m");
  if (!(p.blend_m <= p.inseam_m)) reject("blend_m", "must not exceed inseam_m");
}

}  // namespace

Garment makeShorts(const ShortsPattern& p, const Human& human) {
  check(p);
  const Drafted body(human);
  const Draft draft(p, body);
  const auto around = uniformKnots(p.degree, draft.around()), inside = uniformKnots(p.degree, draft.inner());
  const auto rise = uniformKnots(p.degree, draft.rise()), leg = uniformKnots(p.degree, draft.leg());
  const auto trunk = interpolate(around, rise, [&](double s, double t) { return draft.trunk(s, t); });
  const auto outer = interpolate(around, leg, [&](double s, double t) { return draft.outer(s, t); });
  const auto inner = interpolate(inside, leg, [&](double s, double t) { return draft.inner(s, t); });
  Garment g;
  g.name = "shorts";
  for (const NurbsPatch* left : {&trunk, &outer, &inner}) {
    g.patches.push_back(*left);
    g.patches.push_back(mirrored(*left, body.medianY()));
  }
  g.weft.assign(6, {0, 0, 1});

  using enum Side;
  const SeamKind C0 = SeamKind::C0, G1 = SeamKind::G1;
  const double k = p.seam_stiffness_N;
  const std::vector<Seam> smooth{{{trunk_left, u0}, {trunk_right, u1}, G1, 0},  // centre front
                                 {{trunk_left, u1}, {trunk_right, u0}, G1, 0},  // centre back
                                 {{outer_left, u0}, {inner_left, u1}, G1, 0},   // leg lines, front and back
                                 {{outer_left, u1}, {inner_left, u0}, G1, 0},
                                 {{outer_right, u1}, {inner_right, u0}, G1, 0},
                                 {{outer_right, u0}, {inner_right, u1}, G1, 0}};
  const std::vector<Seam> creased{{{outer_left, v1}, {trunk_left, v0}, C0, k},  // hip lines
                                  {{outer_right, v1}, {trunk_right, v0}, C0, k},
                                  {{inner_left, v1}, {inner_right, v1, true}, C0, k}};  // gusset
  // Cf and Cb are the lower ends of the centre seams and the upper ends of the leg lines.
  for (std::size_t i = 0; i < smooth.size(); ++i) averageSeam(g, smooth[i], i < 2 ? 1 : 0, i < 2 ? 0 : 1);
  // The creased edges agree up to rounding; make them one. The trunk's edge is the master, then the left inner leg's.
  const auto copy = [&](const PatchEdge& from, const PatchEdge& to) {
    const NurbsPatch& a = g.patches[from.patch];
    NurbsPatch& b = g.patches[to.patch];
    const auto ra = edgeRow(a, from), rb = edgeRow(b, to);
    for (std::size_t i = 0; i < ra.size(); ++i) b.points[rb[i]] = a.points[ra[i]];
  };
  copy(creased[0].b, creased[0].a);
  copy(creased[1].b, creased[1].a);
  copy(creased[2].a, creased[2].b);
  for (const int patch : {inner_left, inner_right}) {  // corners at Cf and Cb, from the trunk
    NurbsPatch& b = g.patches[patch];
    const NurbsPatch& a = g.patches[patch == inner_left ? outer_left : outer_right];
    const int n = b.u.count() - 1, m = b.v.count() - 1, na = a.u.count() - 1, ma = a.v.count() - 1;
    b.points[b.index(0, m)] = a.points[a.index(na, ma)];
    b.points[b.index(n, m)] = a.points[a.index(0, ma)];
  }
  g.seams = smooth;
  g.seams.insert(g.seams.end(), creased.begin(), creased.end());
  validate(g);
  return g;
}

}  // namespace gambeson
