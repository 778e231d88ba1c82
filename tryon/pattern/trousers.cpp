#include "tryon/pattern/trousers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

constexpr const char* kGarment = "garment.trousers";
constexpr int levels = 120;  ///< at which the body is measured, a few millimetres apart

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

void check(const TrousersPattern& p) {
  requirePositive("rise_m", p.rise_m);
  requirePositive("inseam_m", p.inseam_m);
  requirePositive("cell_m", p.cell_m);
  requireDegree(p.degree, 2);
  if (!(p.ease > -0.5 && p.ease < 2)) reject("ease", std::to_string(p.ease) + ", must lie between -0.5 and 2");
  if (!(p.crotch_ease_m > -0.1 && p.crotch_ease_m < 0.3))
    reject("crotch_ease_m", std::to_string(p.crotch_ease_m) + ", must lie between -0.1 and 0.3");
}

/// The standing body from the waist down, without feet.
class Measured {
 public:
  Measured(const TrousersPattern& p, const BodyForm& form)
      : left_(form.links({"thigh_left", "shank_left"}, kGarment)),
        median_y_(form.medianY()),
        crotch_(form.lowest({0})),
        outline_(outlineOf(p, form)) {
    for (int k = 0; k < levels; ++k) {
      const double z = crotch_ - p.inseam_m * k / (levels - 1);
      const std::vector<Vec2> hull = convexHull(form.level(z, left_));
      if (hull.size() < 3) continue;
      const ClosedCurve leg(hull);
      leg_girth_ = std::max(leg_girth_, leg.length());
      (heights_.empty() ? upper_ : lower_) = leg.centroid();
      heights_.push_back(z);
    }
    if (heights_.size() < 2) reject("inseam_m", "there are no legs below the crotch");
  }

  double crotch() const { return crotch_; }
  double legGirth() const { return leg_girth_; }
  const ClosedCurve& outline() const { return outline_; }
  double medianY() const { return median_y_; }
  /// Where the left leg's middle is at its crotch, and how it moves for each metre upward.
  Vec2 legAtCrotch() const { return upper_; }
  Vec2 legLean() const {
    const double rise = heights_.front() - heights_.back();
    return {(upper_.x - lower_.x) / rise, (upper_.y - lower_.y) / rise};
  }

 private:
  /// The hull of all cross-sections, seen from above.
  ClosedCurve outlineOf(const TrousersPattern& p, const BodyForm& form) const {
    if (!std::isfinite(crotch_)) reject(kGarment, "needs a human with a surface on the root link");
    Links all = form.links({"torso", "thigh_left", "thigh_right", "shank_left", "shank_right"}, kGarment);
    all.push_back(0);
    const double from = crotch_ - p.crotch_ease_m - p.inseam_m, to = crotch_ - p.crotch_ease_m + p.rise_m;
    if (!(from > 0))
      reject("inseam_m", std::to_string(p.inseam_m) + ", the hem would lie below the ground; allowed: less than " +
                             std::to_string(p.inseam_m + from));
    std::vector<Vec2> points;
    for (int k = 0; k < levels; ++k)
      for (const Vec2& x : form.level(from + (to - from) * k / (levels - 1), all)) {
        points.push_back(x);
        points.push_back({x.x, 2 * median_y_ - x.y});
      }
    std::vector<Vec2> hull = convexHull(std::move(points));
    if (hull.size() < 3) reject(kGarment, "needs a human with a surface on pelvis, thighs and shanks");
    return ClosedCurve(std::move(hull));
  }

  Links left_;
  double median_y_, crotch_;
  ClosedCurve outline_;
  double leg_girth_ = 0;
  Vec2 upper_{}, lower_{};
  std::vector<double> heights_;  ///< where the leg has a cross-section, downward
};

/// Where the control points of the tubes start.
class Opened {
 public:
  Opened(const TrousersPattern& p, const Measured& body, double width_m, double crotch_z)
      : rise_m_(p.rise_m),
        width_m_(width_m),
        radius_m_(width_m / std::numbers::pi),
        crotch_{body.legAtCrotch().x, body.medianY(), crotch_z},
        lean_(body.legLean()),
        ring_(body.outline().grown(4 * width_m / body.outline().length(), body.outline().centroid())),
        front_(ring_.crossing({ring_.centroid().x, body.medianY()}, {1, 0})) {}

  const Vec3& crotch() const { return crotch_; }

  /// x: of a tube about a line beside the crotch, to the left (side 1) or to the right (-1).
  Vec3 at(const Vec3& x, double side) const {
    const Vec3 d = x - crotch_;
    if (d.z <= 0) return x + Vec3{lean_.x * d.z, side * lean_.y * d.z, 0};
    const double share = d.z / rise_m_;
    const double around = std::atan2(d.x, radius_m_ - side * d.y) / std::numbers::pi;  // 0 at the centre, 1 at the side
    const double along = around >= 0 ? around : 2 + around;                            // from centre front
    const Vec2 top = ring_.point(front_ + side * along * width_m_);
    return {x.x + share * (top.x - x.x), x.y + share * (top.y - x.y), x.z};
  }

 private:
  double rise_m_, width_m_, radius_m_;
  Vec3 crotch_;
  Vec2 lean_;
  ClosedCurve ring_;
  double front_;
};

}  // namespace

std::vector<std::string> trousersPatchNames() {
  return {"hips_front_left", "hips_front_right", "hips_back_left", "hips_back_right",
          "leg_front_left",  "leg_front_right",  "leg_back_left",  "leg_back_right"};
}

std::vector<std::string> trousersEdgeNames() { return {"waist", "hem_left", "hem_right"}; }

Garment makeTrousers(const TrousersPattern& p, const BodyForm& form) {
  check(p);
  const Measured body(p, form);
  const double width = 0.25 * (1 + p.ease) * std::max(body.outline().length(), 2 * body.legGirth());
  const Opened opened(p, body, width, body.crotch() - p.crotch_ease_m);
  const double radius = width / std::numbers::pi;

  Garment g;
  g.name = "trousers";
  g.patch_names = trousersPatchNames();
  g.patches.resize(g.patch_names.size());
  g.placed.resize(g.patches.size());
  g.weft.assign(g.patches.size(), {0, 0, 1});
  // A tube's first patch is its front, and its second its back (makeTube begins at -y).
  const auto add = [&](double side, double from_m, double length_m, int front, int back) {
    TubePattern tube;
    tube.radius_m = radius, tube.length_m = length_m;
    tube.cells_around = 2 * cellsFor(width, p.cell_m, p.degree + 1);
    tube.cells_along = cellsFor(length_m, p.cell_m, 2);
    tube.degree = p.degree, tube.patches = 2;
    tube.start = opened.crotch() + Vec3{0, side * radius, from_m}, tube.axis = {0, 0, 1};
    const Garment made = makeTube(tube);
    for (const auto& [patch, to] : {std::pair{0, front}, std::pair{1, back}}) {
      g.patches[to] = made.patches[patch];
      for (const Vec3& x : made.patches[patch].points) g.placed[to].push_back(opened.at(x, side));
    }
  };
  add(1, 0, p.rise_m, hips_front_left, hips_back_left);
  add(-1, 0, p.rise_m, hips_front_right, hips_back_right);
  add(1, -p.inseam_m, p.inseam_m, leg_front_left, leg_back_left);
  add(-1, -p.inseam_m, p.inseam_m, leg_front_right, leg_back_right);

  using enum Side;
  const auto join = [&](PatchEdge a, PatchEdge b, SeamKind kind) { g.seams.push_back({a, b, kind, 0}); };
  join({hips_front_left, u1}, {hips_back_left, u0}, SeamKind::G1);  // outer sides
  join({hips_back_right, u1}, {hips_front_right, u0}, SeamKind::G1);
  join({leg_front_left, u1}, {leg_back_left, u0}, SeamKind::G1);
  join({leg_back_right, u1}, {leg_front_right, u0}, SeamKind::G1);
  join({leg_back_left, u1}, {leg_front_left, u0}, SeamKind::G1);  // inner sides
  join({leg_front_right, u1}, {leg_back_right, u0}, SeamKind::G1);
  for (int k = 0; k < 4; ++k) join({leg_front_left + k, v1}, {hips_front_left + k, v0}, SeamKind::G1);  // the cut
  join({hips_front_right, u1}, {hips_front_left, u0}, SeamKind::C0);  // centre front and back
  join({hips_back_left, u1}, {hips_back_right, u0}, SeamKind::C0);
  for (const std::string& name : trousersEdgeNames()) {
    const bool waist = name == "waist", left = name == "hem_left";
    NamedEdge edge{name, {}};
    for (int k = 0; k < 4; ++k)
      if (waist)
        edge.edges.push_back({k, v1});
      else if ((k % 2 == 0) == left)
        edge.edges.push_back({leg_front_left + k, v0});
    g.edges.push_back(std::move(edge));
  }
  validate(g);
  return g;
}

}  // namespace gambeson
