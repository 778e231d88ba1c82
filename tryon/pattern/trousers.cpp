#include "tryon/pattern/trousers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tryon/pattern/check.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

constexpr const char* kGarment = "garment.trousers";
constexpr int levels = 120;  ///< at which the body is measured, a few millimetres apart
constexpr double least_inseam_m = 0.2;

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

/// Where the control points of the tubes start: hips that open upward from the legs' two circles to a ring. Each row
/// keeps its length: the direction of its curve, by the length from the centre, goes over from that of a circle to that
/// of an ellipse. Each column keeps its length too: where it leans outward it reaches less high.
class Opened {
 public:
  Opened(const TrousersPattern& p, const Measured& body, double width_m)
      : width_m_(width_m),
        rise_m_(p.rise_m),
        radius_m_(width_m / std::numbers::pi),
        crotch_{body.legX(), body.medianY(), body.crotch()},
        lean_(body.legLean()),
        middle_x_(body.outline().centroid().x),
        heading_(headingOf(body.outline())) {
    for (int k = 0; k <= rows; ++k) row_.push_back(rowAt(static_cast<double>(k) / rows));
    height_.assign(rows + 1, std::vector<double>(columns + 1, 0));
    for (int k = rows - 1; k >= 0; --k)
      for (int i = 0; i <= columns; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const Vec2 &low = row_[k][n], &high = row_[k + 1][n];
        const double step = rise_m_ / rows, out = std::hypot(high.x - low.x, high.y - low.y);
        height_[k][n] = height_[k + 1][n] - std::sqrt(std::max(0.1 * step * step, step * step - out * out));
      }
  }

  const Vec3& crotch() const { return crotch_; }

  /// x: of the front or the back of a tube beside the crotch, to the left (side 1) or to the right (-1).
  Vec3 at(const Vec3& x, double side, bool front) const {
    const Vec3 d = x - crotch_;
    const double share = std::clamp(d.z / rise_m_, 0.0, 1.0);
    const double from_centre = std::atan2(std::abs(d.x), radius_m_ - side * d.y) / std::numbers::pi;
    const Vec3 open = openedAt(from_centre, share);
    const Vec3 start{crotch_.x + share * (middle_x_ - crotch_.x) + (front ? open.x : -open.x),
                     crotch_.y + side * open.y, crotch_.z + rise_m_ + open.z};
    const double below = std::min(d.z, 0.0);
    return start + Vec3{lean_.x * below, side * lean_.y * below, below};
  }

 private:
  static constexpr int rows = 24, columns = 96;

  /// Of a quarter of the ellipse that is as deep for its width as the outline: the direction of its curve at even
  /// lengths from the centre to the side, from y to -x.
  static std::vector<double> headingOf(const ClosedCurve& outline) {
    const double depth = outline.extent({1, 0}) + outline.extent({-1, 0});
    const double across = outline.extent({0, 1}) + outline.extent({0, -1});
    constexpr int n = 4000;
    std::vector<double> length{0}, angle;
    for (int k = 0; k <= n; ++k) {
      const double a = 0.5 * std::numbers::pi * k / n, dx = -depth * std::sin(a), dy = across * std::cos(a);
      angle.push_back(std::atan2(dy, dx));
      if (k > 0) length.push_back(length.back() + std::hypot(dx, dy));
    }
    std::vector<double> heading;
    for (int i = 0; i <= columns; ++i) {
      const double at = length.back() * i / columns;
      const auto k = std::lower_bound(length.begin(), length.end(), at) - length.begin();
      heading.push_back(angle[static_cast<std::size_t>(k)]);
    }
    return heading;
  }

  /// Half a front from the centre to the side; x is 0 at the side.
  std::vector<Vec2> rowAt(double share) const {
    std::vector<Vec2> row{{0, 0}};
    for (int i = 1; i <= columns; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double circle = std::numbers::pi * (i - 0.5) / columns;
      const double heading = circle + share * (0.5 * (heading_[n - 1] + heading_[n]) - circle);
      row.push_back({row.back().x + width_m_ / columns * std::cos(heading),
                     row.back().y + width_m_ / columns * std::sin(heading)});
    }
    const double side_x = row.back().x;
    for (Vec2& x : row) x.x -= side_x;
    return row;
  }

  /// x and y in its row, and its height below the waist edge.
  Vec3 openedAt(double from_centre, double share) const {
    const double u = columns * from_centre, v = rows * share;
    const int i = std::min(static_cast<int>(u), columns - 1), k = std::min(static_cast<int>(v), rows - 1);
    const auto point = [&](int row, int column) {
      const auto n = static_cast<std::size_t>(column);
      return Vec3{row_[row][n].x, row_[row][n].y, height_[row][n]};
    };
    const double s = u - i, t = v - k;
    return (1 - t) * ((1 - s) * point(k, i) + s * point(k, i + 1)) +
           t * ((1 - s) * point(k + 1, i) + s * point(k + 1, i + 1));
  }

  double width_m_, rise_m_, radius_m_;
  Vec3 crotch_;
  Vec2 lean_;
  double middle_x_;
  std::vector<double> heading_;
  std::vector<std::vector<Vec2>> row_;       ///< from the crotch up
  std::vector<std::vector<double>> height_;  ///< likewise
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
