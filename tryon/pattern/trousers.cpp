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
constexpr double least_inseam_m = 0.2;

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

void check(const TrousersPattern& p) {
  requirePositive("rise_m", p.rise_m);
  requirePositive("hem_m", p.hem_m);
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
      : median_y_(form.medianY()),
        crotch_z_(form.lowest({0}) - p.crotch_ease_m),
        hem_z_(p.hem_m),
        outline_(outlineOf(p, form)) {
    const Links leg = form.links({"thigh_left", "shank_left"}, kGarment);
    std::vector<Vec3> middles;
    for (int k = 0; k < levels; ++k) {
      const double z = crotch_z_ - inseam() * k / (levels - 1);
      std::vector<Vec2> hull = convexHull(form.level(z, leg));
      if (hull.size() < 3) continue;
      const ClosedCurve around(std::move(hull));
      leg_girth_ = std::max(leg_girth_, around.length());
      middles.push_back({around.centroid().x, around.centroid().y, z});
    }
    if (middles.size() < 2) reject(kGarment, "needs a human with a surface on the left leg");
    const Vec3 way = middles.front() - middles.back();
    leg_x_ = middles.front().x, lean_ = {way.x / way.z, way.y / way.z};
  }

  double crotch() const { return crotch_z_; }
  double inseam() const { return crotch_z_ - hem_z_; }
  double legGirth() const { return leg_girth_; }
  const ClosedCurve& outline() const { return outline_; }
  double medianY() const { return median_y_; }
  double legX() const { return leg_x_; }         ///< of the left leg's middle at the crotch
  const Vec2& legLean() const { return lean_; }  ///< how it moves for each metre upward

 private:
  /// The hull of all cross-sections between hem and waist, seen from above.
  ClosedCurve outlineOf(const TrousersPattern& p, const BodyForm& form) const {
    if (!std::isfinite(crotch_z_)) reject(kGarment, "needs a human with a surface on the root link");
    if (!(inseam() >= least_inseam_m))
      reject("hem_m", std::to_string(p.hem_m) + ", leaves no legs; allowed: at most " +
                          std::to_string(crotch_z_ - least_inseam_m));
    Links all = form.links({"torso", "thigh_left", "thigh_right", "shank_left", "shank_right"}, kGarment);
    all.push_back(0);
    std::vector<Vec2> points;
    for (int k = 0; k < levels; ++k)
      for (const Vec2& x : form.level(hem_z_ + (inseam() + p.rise_m) * k / (levels - 1), all)) {
        points.push_back(x);
        points.push_back({x.x, 2 * median_y_ - x.y});
      }
    std::vector<Vec2> hull = convexHull(std::move(points));
    if (hull.size() < 3) reject(kGarment, "needs a human with a surface on pelvis, thighs and shanks");
    return ClosedCurve(std::move(hull));
  }

  double median_y_, crotch_z_, hem_z_;
  ClosedCurve outline_;
  double leg_girth_ = 0, leg_x_ = 0;
  Vec2 lean_;
};

/// Where the control points of the tubes start.
class Opened {
 public:
  Opened(const TrousersPattern& p, const Measured& body, double width_m)
      : rise_m_(p.rise_m),
        width_m_(width_m),
        radius_m_(width_m / std::numbers::pi),
        crotch_{body.legX(), body.medianY(), body.crotch()},
        lean_(body.legLean()),
        ring_(body.outline().grown(4 * width_m / body.outline().length(), body.outline().centroid())),
        front_(ring_.crossing({ring_.centroid().x, body.medianY()}, {1, 0})) {}

  const Vec3& crotch() const { return crotch_; }

  /// x: of the front or the back of a tube beside the crotch, to the left (side 1) or to the right (-1).
  Vec3 at(const Vec3& x, double side, bool front) const {
    const Vec3 d = x - crotch_;
    if (d.z <= 0) return x + Vec3{lean_.x * d.z, side * lean_.y * d.z, 0};
    const double share = d.z / rise_m_;
    const double from_centre = std::atan2(std::abs(d.x), radius_m_ - side * d.y) / std::numbers::pi;
    const Vec2 top = ring_.point(front_ + side * (front ? from_centre : 2 - from_centre) * width_m_);
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
  const Opened opened(p, body, width);
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
      for (const Vec3& x : made.patches[patch].points) g.placed[to].push_back(opened.at(x, side, patch == 0));
    }
  };
  add(1, 0, p.rise_m, hips_front_left, hips_back_left);
  add(-1, 0, p.rise_m, hips_front_right, hips_back_right);
  add(1, -body.inseam(), body.inseam(), leg_front_left, leg_back_left);
  add(-1, -body.inseam(), body.inseam(), leg_front_right, leg_back_right);

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
