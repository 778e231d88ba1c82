/// Detail of pattern.hpp: shorts of six patches drafted on a body; the layout is described there.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"
#include "tryon/pattern/form.hpp"
#include "tryon/pattern/leg_form.hpp"
#include "tryon/pattern/pattern.hpp"
#include "tryon/pattern/wrap.hpp"

namespace gambeson {
namespace {

/// Below the waist edge the waist's ease goes over into that of the rest.
constexpr double waist_band_m = 0.12;
/// What the fork and the rows below it keep from thigh and pelvis along rays from their middles, besides what a spline
/// of cells cuts off a round of 10 cm; and what a leg keeps from the median plane, where thighs leave as much.
constexpr double body_gap_m = 0.002;
/// What the trunk's surface keeps between the points that it is drawn through.
constexpr double clear_m = 0.0005;
/// Between heights where that is looked at: skins from files have creases.
constexpr double level_m = 0.0015;
/// And along a row: corners of a coarse skin stand between wider steps.
constexpr int looks_per_cell = 16;

/// A cross-section of pelvis or thigh.
struct Outline {
  ClosedCurve curve;
  Vec2 middle;
  double nearest = 0;  ///< y up to which points may be moved towards the other leg
};

/// The body as the tape sees it, standing.
class Drafted {
 public:
  explicit Drafted(const BodyForm& form)
      : form_(form),
        thigh_(form.links({"thigh_left"}, "garment.shorts")),
        trunk_(form.links({"torso", "thigh_left", "thigh_right"}, "garment.shorts")) {
    trunk_.push_back(0);
    if (!std::isfinite(form.lowest({0})) || !std::isfinite(form.lowest(thigh_)))
      reject("garment.shorts", "needs a human with a surface on the root link and on thigh_left");
  }

  /// Lowest point of the pelvis [m].
  double pelvisBottom() const { return form_.lowest({0}); }
  /// The wrap of pelvis, torso and both thighs between two heights; the left half is mirrored.
  Wrap trunk(double from, double to) const { return form_.wrap(from, to, trunk_, "rise_m"); }
  /// The left leg down to a hem.
  LegForm leg(double crotch_z, double hem_z) const { return LegForm(form_, crotch_z, hem_z); }
  double medianY() const { return form_.medianY(); }
  /// Hulls of the pelvis, whose middle stands on the median plane, and of the left thigh, where they have a
  /// cross-section.
  std::vector<Outline> underFork(double z) const {
    std::vector<Vec2> pelvis = form_.level(z, {0});
    for (std::size_t i = 0, n = pelvis.size(); i < n; ++i) pelvis.push_back({pelvis[i].x, 2 * medianY() - pelvis[i].y});
    std::vector<Outline> out;
    for (std::vector<Vec2> points : {convexHull(std::move(pelvis)), convexHull(form_.level(z, thigh_))})
      if (points.size() >= 3) out.push_back(outline(ClosedCurve(std::move(points))));
    return out;
  }
  Outline outline(const ClosedCurve& body) const { return {body, body.centroid(), medianY() + innerRoom(body)}; }
  /// A thigh's distance from the median plane.
  double inside(const ClosedCurve& thigh) const { return -thigh.extent({0, -1}) - medianY(); }
  /// What its leg leaves of that to the other leg: the gap, half of it all where thighs are near. None for what passes
  /// through the plane.
  double innerRoom(const ClosedCurve& body) const {
    const double room = inside(body);
    return room > 0 ? std::min(body_gap_m, 0.5 * room) : -HUGE_VAL;
  }

 private:
  const BodyForm& form_;
  Links thigh_, trunk_;
};

/// The left half of the shorts as surfaces of (s, t), both from 0 to 1.
class Draft {
 public:
  Draft(const ShortsPattern& p, const Drafted& body)
      : p_(p),
        body_(body),
        crotch_z_(body.pelvisBottom() - p.crotch_ease_m),
        trunk_(body.trunk(crotch_z_, crotch_z_ + p.rise_m)),
        leg_(body.leg(crotch_z_, crotch_z_ - p.inseam_m)) {
    notch_half_width_ = leg_.at(crotch_z_).centroid().y - body.medianY();
    if (!(notch_half_width_ > 0)) reject("garment.shorts", "thigh_left does not stand on the left of the body");

    const Tape top = tape(0);
    const double depth = top.front_x - top.back_x;
    const int around = cellsFor(0.5 * (top.half + tape(1).half));
    trunk_cells_ = {around, cellsFor(p.rise_m)};
    leg_rows_ = cellsFor(p.inseam_m);
    inner_cells_ = std::max(3, cellsFor(p.gusset_share * depth));
    if (!(p.degree < inner_cells_ + 2))
      reject("cell_m", "too large for the degree: the inner leg would have few cells");
  }

  int around() const { return trunk_cells_[0]; }
  int rise() const { return trunk_cells_[1]; }
  int leg() const { return leg_rows_; }
  int inner() const { return inner_cells_; }

  /// s from centre front to centre back around the left hip, t from the crotch's level up to the waist.
  Vec3 trunk(double s, double t) const {
    const std::vector<Vec2> cross_section = halfCrossSection(t);
    std::vector<double> at{0};
    for (std::size_t i = 1; i < cross_section.size(); ++i)
      at.push_back(at.back() + std::hypot(cross_section[i].x - cross_section[i - 1].x,
                                          cross_section[i].y - cross_section[i - 1].y));
    const double length = s * at.back();
    const std::size_t i = std::upper_bound(at.begin() + 1, at.end() - 1, length) - at.begin();
    const double f = (length - at[i - 1]) / (at[i] - at[i - 1]);
    const Vec2 &a = cross_section[i - 1], &b = cross_section[i];
    return {a.x + f * (b.x - a.x), a.y + f * (b.y - a.y), crotch_z_ + t * p_.rise_m};
  }
  /// The patch through `trunk`. Between the points that it goes through a spline cuts off what stands out on the body
  /// in less than the 10 cm that the gap allows for: there these points are moved out, until it is clear. What still
  /// passes through the body after that is left to virtual projecting.
  NurbsPatch trunkPatch(const KnotVector& u, const KnotVector& v) const {
    const auto gu = grevillePoints(u), gv = grevillePoints(v);
    std::vector<Vec3> data;
    for (const double t : gv)
      for (const double s : gu) data.push_back(trunk(s, t));
    NurbsPatch patch = withSmoothCentres(interpolate(u, v, data));
    constexpr int rounds = 10;
    const int nu = u.count(), around = looks_per_cell * trunk_cells_[0];
    const int rows = static_cast<int>(std::ceil(p_.rise_m / level_m));
    std::vector<std::vector<Outline>> bodies;
    for (int k = 0; k <= rows; ++k) bodies.push_back(underTrunk(static_cast<double>(k) / rows));
    for (int round = 0; round < rounds; ++round) {
      std::vector<Vec2> moves(data.size());
      bool clear = true;
      for (int k = 0; k <= rows; ++k)
        for (int l = 0; l <= around; ++l) {
          const double s = static_cast<double>(l) / around, t = static_cast<double>(k) / rows;
          const Vec3 x = surfaceDerivatives(patch, s, t)[0];
          Vec2 out{x.x, x.y};
          for (const Outline& body : bodies[k])
            out = movedOut(out, body, [&](double radius) { return std::min(clear_m, easeAt(t) * radius); });
          const Vec2 move{out.x - x.x, out.y - x.y};
          if (move.x == 0 && move.y == 0) continue;
          clear = false;
          for (int j = 0; j < v.count(); ++j)
            for (int i = 0; i < nu; ++i) {
              if (std::abs(gu[i] - s) * trunk_cells_[0] > 1 || std::abs(gv[j] - t) * trunk_cells_[1] > 1) continue;
              Vec2& most = moves[i + nu * j];
              if (std::hypot(move.x, move.y) > std::hypot(most.x, most.y)) most = move;
            }
        }
      if (clear) break;
      for (std::size_t n = 0; n < data.size(); ++n) {
        const int i = static_cast<int>(n) % nu;
        data[n].x += moves[n].x;
        if (i > 0 && i < nu - 1) data[n].y += moves[n].y;
      }
      patch = withSmoothCentres(interpolate(u, v, data));
    }
    return patch;
  }
  /// s from the front leg line around the outside to the back leg line, t from the hem up to the trunk.
  Vec3 outer(double s, double t) const { return blend(trunk(s, 0), legPoint(s * share(), t), t); }
  /// s from the back leg line around the inside to the front leg line, t from the hem up to the gusset line.
  Vec3 inner(double s, double t) const {
    const Vec3 cf = trunk(0, 0), cb = trunk(1, 0);
    return blend((1 - s) * cb + s * cf, legPoint(share() + s * (1 - share()), t), t);
  }

 private:
  /// The trunk's cross-section grown by the ease.
  struct Tape {
    ClosedCurve curve;
    double front = 0, half = 0;  ///< arc length where the centre front stands, and to the centre back
    double front_x = 0, back_x = 0;
  };
  double easeAt(double t) const {
    const double below = std::clamp((1 - t) * p_.rise_m / waist_band_m, 0.0, 1.0);
    const double waist = p_.waist_ease.value_or(p_.ease);
    return waist + (p_.ease - waist) * below * below * (3 - 2 * below);
  }
  Tape tape(double t) const {
    const ClosedCurve body(trunk_.crossSection(crotch_z_ + t * p_.rise_m));
    const Vec2 c{body.centroid().x, body_.medianY()};
    const ClosedCurve grown = body.grown(1 + easeAt(t), c);
    const double front = grown.crossing(c, {1, 0}), half = 0.5 * grown.length();
    return {grown, front, half, grown.point(front).x, grown.point(front + half).x};
  }
  /// What the trunk goes around at its row t: none where it is drafted smaller than that.
  std::vector<Outline> underTrunk(double t) const {
    const double z = crotch_z_ + t * p_.rise_m;
    if (!(easeAt(t) > 0)) return {};
    if (z < crotch_z_ + p_.fork_m) return body_.underFork(z);
    return {body_.outline(ClosedCurve(trunk_.crossSection(z)))};
  }
  /// The trunk's cross-section with the fork, from centre front to centre back: the tape, drawn towards the middle by a
  /// bell across and a parabola upward, both flat where they end, so that the cross-section mirrors without a kink.
  std::vector<Vec2> halfCrossSection(double t) const {
    const Tape around = tape(t);
    const double up = std::max(0.0, 1 - t * p_.rise_m / p_.fork_m);
    const std::vector<Outline> bodies = up > 0 ? body_.underFork(crotch_z_ + t * p_.rise_m) : std::vector<Outline>{};
    const double wanted_gap = wantedGap();
    constexpr int n = 720;
    std::vector<Vec2> out;
    for (int k = 0; k <= n; ++k) {
      Vec2 x = around.curve.point(around.front + around.half * k / n);
      if (k == 0 || k == n) x.y = body_.medianY();
      const double y = std::min(1.0, (x.y - body_.medianY()) / notch_half_width_);
      const double pull = (1 - p_.gusset_share) * std::pow(std::cos(0.5 * std::numbers::pi * y) * up, 2);
      const double middle = 0.5 * (around.front_x + around.back_x);
      Vec2 drawn{x.x + pull * (middle - x.x), x.y};
      if (pull > 0 && p_.ease > 0)
        for (const Outline& body : bodies)
          drawn = movedOut(drawn, body, [&](double radius) { return std::min(wanted_gap, p_.ease * radius); });
      out.push_back(drawn);
    }
    return out;
  }
  int cellsFor(double length_m) const { return gambeson::cellsFor(length_m, p_.cell_m, 2); }
  /// Share of the outer leg in the leg's girth: cells of the same length on both sides of the leg lines.
  double share() const { return static_cast<double>(around()) / (around() + inner()); }
  /// Grown by the ease about the thigh's middle or, where that would take it nearer to the median plane than the leg's
  /// room, about a point c so much farther inside: y -> c + (1 + ease) (y - c). Either has the same length.
  ClosedCurve legTape(const ClosedCurve& thigh) const {
    Vec2 c = thigh.centroid();
    const double room = body_.innerRoom(thigh);
    if (p_.ease > 0 && std::isfinite(room))
      c.y = std::min(c.y, body_.medianY() + ((1 + p_.ease) * body_.inside(thigh) - room) / p_.ease);
    return thigh.grown(1 + p_.ease, c);
  }
  /// The thigh's tape by the fraction of its length, from the front leg line, outside first.
  Vec3 legPoint(double fraction, double t) const {
    const double z = crotch_z_ - (1 - t) * p_.inseam_m;
    const ClosedCurve body = leg_.at(z);
    const ClosedCurve tape = legTape(body);
    const double innermost = tape.crossing(body.centroid(), {0, -1});
    const Vec2 x = tape.point(innermost + (fraction + 0.5 * (1 - share())) * tape.length());
    return {x.x, x.y, z};
  }
  /// The fork's outline at the top goes over into the thigh's cross-section, with a slope there and without one below.
  /// Points of two outlines that face each other on different rays cut the corner between them; they are moved out to
  /// where the thigh leaves room.
  Vec3 blend(const Vec3& top, const Vec3& leg, double t) const {
    const double q = std::max(0.0, 1 - (1 - t) * p_.inseam_m / p_.blend_m), w = q * q;
    const Vec3 x{leg.x + w * (top.x - leg.x), leg.y + w * (top.y - leg.y), leg.z};
    if (w == 0 || t == 1 || !(p_.ease > 0)) return x;
    const Vec2 out = movedOut({x.x, x.y}, body_.outline(leg_.at(x.z)), [&](double radius) {
      const double eased = p_.ease * radius;  // not more where q is 0
      return std::min(wantedGap(), eased + std::max(0.0, wantedGap() - eased) * q);
    });
    return {out.x, out.y, x.z};
  }
  double wantedGap() const { return body_gap_m + p_.cell_m * p_.cell_m / 0.8; }
  /// Moved out along the ray from the middle of a cross-section of the body, unless it keeps `gap(radius of the body
  /// there)` already; never past where the other leg has its room.
  template <class Gap>
  static Vec2 movedOut(const Vec2& x, const Outline& body, const Gap& gap) {
    const Vec2 c = body.middle, ray{x.x - c.x, x.y - c.y};
    const Vec2 skin = body.curve.point(body.curve.crossing(c, ray));
    const double radius = std::hypot(skin.x - c.x, skin.y - c.y);
    double grow = (radius + gap(radius)) / std::hypot(ray.x, ray.y);
    if (c.y + grow * ray.y < body.nearest) grow = (body.nearest - c.y) / ray.y;
    return grow > 1 ? Vec2{c.x + grow * ray.x, c.y + grow * ray.y} : x;
  }
  /// The centre lines as the seams there make them: with the points beside them straight across the median plane.
  NurbsPatch withSmoothCentres(NurbsPatch p) const {
    for (const auto& [edge, beside] : {std::pair{0, 1}, std::pair{p.u.count() - 1, p.u.count() - 2}})
      for (int j = 1; j < p.v.count(); ++j) {
        const Vec3& x = p.points[p.index(beside, j)];
        p.points[p.index(edge, j)] = {x.x, body_.medianY(), x.z};
      }
    return p;
  }

  const ShortsPattern& p_;
  const Drafted& body_;
  double crotch_z_;
  Wrap trunk_;
  LegForm leg_;
  double notch_half_width_ = 0;
  std::array<int, 2> trunk_cells_{};
  int leg_rows_ = 0, inner_cells_ = 0;
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
  for (const auto& [key, ease] : {std::pair{"ease", p.ease}, std::pair{"waist_ease", p.waist_ease.value_or(p.ease)}})
    if (!(ease > -0.5 && ease < 2)) reject(key, std::to_string(ease) + ", must lie between -0.5 and 2");
  if (!(p.crotch_ease_m > -0.1 && p.crotch_ease_m < 0.2))
    reject("crotch_ease_m", std::to_string(p.crotch_ease_m) + ", must lie between -0.1 and 0.2");
  if (!(p.seam_stiffness_N >= 0) || !std::isfinite(p.seam_stiffness_N))
    reject("seam_stiffness_N", "must not be negative");
  if (!(p.fork_m <= p.rise_m))
    reject("rise_m",
           std::to_string(p.rise_m) + ", shorter than the fork; allowed: at least " + std::to_string(p.fork_m));
  if (!(p.blend_m <= p.inseam_m))
    reject("inseam_m", std::to_string(p.inseam_m) +
                           ", shorter than what legs need to go over from the fork to the thigh; " +
                           "allowed: at least " + std::to_string(p.blend_m));
}

}  // namespace

Garment makeShorts(const ShortsPattern& p, const Human& human) { return makeShorts(p, BodyForm(human)); }

Garment makeShorts(const ShortsPattern& p, const BodyForm& form) {
  check(p);
  const Drafted body(form);
  const Draft draft(p, body);
  const auto around = uniformKnots(p.degree, draft.around()), inside = uniformKnots(p.degree, draft.inner());
  const auto rise = uniformKnots(p.degree, draft.rise()), leg = uniformKnots(p.degree, draft.leg());
  const auto trunk = draft.trunkPatch(around, rise);
  const auto outer = interpolate(around, leg, [&](double s, double t) { return draft.outer(s, t); });
  const auto inner = interpolate(inside, leg, [&](double s, double t) { return draft.inner(s, t); });
  Garment g;
  g.name = "shorts";
  for (const NurbsPatch* left : {&trunk, &outer, &inner}) {
    g.patches.push_back(*left);
    g.patches.push_back(mirrored(*left, body.medianY()));
  }
  g.weft.assign(6, {0, 0, 1});
  g.patch_names = shortsPatchNames();
  for (const char* name : {"waist", "hem_left", "hem_right"}) g.edges.push_back({name, shortsEdge(name)});

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
