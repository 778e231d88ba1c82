/// Detail of armour.hpp: the shirt; its layout is described there.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "core/cloth/draft/part_seam.hpp"
#include "human/files/units.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/fit.hpp"
#include "tryon/pattern/sleeve.hpp"
#include "tryon/pattern/strap.hpp"
#include "tryon/pattern/turn.hpp"

namespace gambeson {
namespace {

void check(const ShirtPattern& p) {
  for (const auto& [key, value] :
       {std::pair{"strap_width_m", p.strap_width_m}, std::pair{"neck_depth_m", p.neck_depth_m},
        std::pair{"belly_length_m", p.belly_length_m}, std::pair{"cell_m", p.cell_m}})
    requirePositive(key, value);
  requireDegree(p.degree, 2);
  for (const auto& [key, value] : {std::pair{"wrap_share", p.wrap_share}, std::pair{"front_share", p.front_share},
                                   std::pair{"belly_share", p.belly_share}, std::pair{"neck_share", p.neck_share}})
    if (!(value >= 0.1 && value <= 0.9)) reject(key, std::to_string(value) + ", must lie between 0.1 and 0.9");
  if (!(p.ease > -0.5 && p.ease < 2)) reject("ease", std::to_string(p.ease) + ", must lie between -0.5 and 2");
  for (const auto& [key, value] : {std::pair{"margin_m", p.margin_m}, std::pair{"gap_m", p.gap_m},
                                   std::pair{"seam_stiffness_N", p.seam_stiffness_N}})
    if (!(value >= 0 && std::isfinite(value))) reject(key, std::to_string(value) + ", must not be negative");
  for (const auto& [key, value] :
       {std::pair{"hem_above_waist_m", p.hem_above_waist_m}, std::pair{"top_below_shoulder_m", p.top_below_shoulder_m}})
    if (!(value >= -0.1 && value <= 0.2)) reject(key, std::to_string(value) + ", must lie between -0.1 and 0.2");
  if (!p.sleeve_length_m) return;
  requirePositive("sleeve_length_m", *p.sleeve_length_m);
  for (const auto& [key, ease] :
       {std::pair{"sleeve_ease", p.sleeve_ease}, std::pair{"sleeve_hem_ease", p.sleeve_hem_ease.value_or(0)}})
    if (!(ease >= 0 && ease <= 2)) reject(key, std::to_string(ease) + ", must lie between 0 and 2");
}

/// A ring at one height: the curve around, and where its centre front stands on it.
struct Ring {
  ClosedCurve curve;
  double front = 0;
  Vec3 at(double s, double z) const {
    const Vec2 x = curve.point(front + s);
    return {x.x, x.y, z};
  }
};

/// What sleeves keep from the arm: besides layer and gap what a spline of such cells cuts off a round of 5 cm.
double keptFromArm(const ShirtPattern& p, double layer_m) { return layer_m + p.gap_m + p.cell_m * p.cell_m / 0.4; }

class Draft {
 public:
  Draft(const ShirtPattern& p, const BodyForm& form, double layer_m, std::span<const Worn> under)
      : p_(p), form_(form), under_(under), cross_sections_(standUp(layer_m)) {
    // Across the straps cells of one width; the front's and back's upper edges have the same.
    strap_cells = std::max(2, static_cast<int>(std::ceil(p.strap_width_m / p.cell_m)));
    const double cell = p.strap_width_m / strap_cells;
    const double shoulder =
        std::abs(form.origin(form.links({"upper_arm_left"}, "garment.shirt")[0]).y - form.medianY());
    neck_half = std::max(2, static_cast<int>(std::round(p.neck_share * shoulder / cell)));
    margin = static_cast<int>(std::round(p.margin_m / cell));
    if (p.sleeve_length_m) margin = 0;  // straps end at the armholes
    panel_cells = 2 * (neck_half + strap_cells + margin);
    top_half_m = (neck_half + strap_cells + margin) * cell;

    back_up = cellsFor(top_ - wrap_top_, p.cell_m, 2);
    const double girth = ringAt(0.5 * (hem_ + wrap_top_)).curve.length();
    wrap_around = cellsFor((1 - p.front_share) * girth, p.cell_m, panel_cells + 2);
    wrap_around += (wrap_around - panel_cells) % 2;  // the back in its middle
    belly_across = cellsFor(p.belly_share * panel_cells, 1, 2);
    belly_across -= (panel_cells - belly_across) % 2;
    belly_up = cellsFor(p.belly_length_m, p.cell_m, 2);
  }

  Vec3 front(double s, double t) const {
    const double z = hem_ + t * (top_ - hem_);
    const Ring& r = ringAt(z);
    const double low = 0.5 * p_.front_share * r.curve.length();
    return r.at((2 * s - 1) * armhole(low, z), z);
  }
  Vec3 wrap(double s, double t) const {
    const double z = hem_ + t * (wrap_top_ - hem_);
    const Ring& r = ringAt(z);
    const double half = 0.5 * p_.front_share * r.curve.length();
    return r.at(half + s * (r.curve.length() - 2 * half), z);
  }
  Vec3 back(double s, double t) const {
    const double z = wrap_top_ + t * (top_ - wrap_top_);
    const Ring& r = ringAt(z);
    const double around = (1 - p_.front_share) * r.curve.length();
    const double low = 0.5 * around * panel_cells / wrap_around;
    return r.at(0.5 * r.curve.length() + (2 * s - 1) * armhole(low, z), z);
  }
  /// Narrower by a fifth at its lower edge.
  Vec3 belly(double s, double t) const {
    const double z = hem_ - (1 - t) * p_.belly_length_m;
    const Ring& r = ringAt(z);
    const double half = 0.5 * p_.front_share * ringAt(hem_).curve.length() * belly_across / panel_cells;
    return r.at((2 * s - 1) * half * (0.8 + 0.2 * t), z);
  }
  double top() const { return top_; }
  double wrapTop() const { return wrap_top_; }
  double hem() const { return hem_; }
  /// How far from the wrap a point beside it stands, along the ray from the wrap's middle; negative inside.
  double beside(const Vec3& x) const {
    const ClosedCurve& curve = ringAt(x.z).curve;
    const Vec2 c = curve.centroid(), ray{x.x - c.x, x.y - c.y};
    const Vec2 p = curve.point(curve.crossing(c, ray));
    return std::hypot(ray.x, ray.y) - std::hypot(p.x - c.x, p.y - c.y);
  }

  int strap_cells = 0, neck_half = 0, margin = 0, panel_cells = 0, front_up = 0, wrap_up = 0, back_up = 0,
      wrap_around = 0, belly_across = 0, belly_up = 0;
  double top_half_m = 0;

 private:
  /// Sets the heights and the cells along them: the wrap ends a row below the arms' insides where these are in the way
  /// of its width.
  Wrap standUp(double layer_m) {
    const Links torso = form_.links({"torso"}, "garment.shirt");
    const Links arms = form_.links({"torso", "upper_arm_left", "upper_arm_right"}, "garment.shirt");
    Links trunk = form_.links({"torso", "thigh_left", "thigh_right"}, "garment.shirt");
    trunk.push_back(0);
    hem_ = waistOf(under_, form_.origin(torso[0]).z) + p_.hem_above_waist_m;
    top_ = form_.origin(arms[1]).z - p_.top_below_shoulder_m;
    const double height = top_ - hem_;
    if (!(height > 0.1)) reject("garment.shirt", "the shoulders stand less than 10 cm above the hem");
    if (!(p_.neck_depth_m <= 0.9 * height))
      reject("neck_depth_m",
             std::to_string(p_.neck_depth_m) + ", must leave a tenth of the front's " + std::to_string(height) + " m");
    front_up = cellsFor(height, p_.cell_m, 4);
    wrap_up = std::clamp(static_cast<int>(std::round(p_.wrap_share * front_up)), 2, front_up - 2);
    const double bottom = hem_ - p_.belly_length_m;
    const int heights = 1 + 2 * static_cast<int>(std::ceil((top_ - bottom) / 0.01));
    const Wrap body = form_.wrap(bottom, top_, trunk, "belly_length_m", heights);
    const Vec2 centre{ClosedCurve(body.crossSection(hem_)).centroid().x, form_.medianY()};
    const std::vector<Vec2> shoulders = form_.hull(top_, arms, true, "top_below_shoulder_m");
    const double cut = p_.cell_m * p_.cell_m / 0.8;  // by a spline of such cells off a body of 10 cm
    Wrap over_others = body;
    const bool over = wrapOf(under_, layer_m, p_.gap_m, bottom, top_, heights, over_others);
    for (;; --wrap_up) {
      wrap_top_ = hem_ + height * wrap_up / front_up;
      // Upward from the wrap the cross-sections go over into the hull of chest and shoulders at the upper edges.
      const Wrap upper = body.with(body.blended(shoulders, [&](double z) {
        const double x = std::clamp((z - wrap_top_) / (top_ - wrap_top_), 0.0, 1.0);
        return x * x * (3 - 2 * x);
      }));
      Wrap out = upper.grown(1 + p_.ease, centre).with(upper.offset(layer_m + p_.gap_m + cut));
      if (over) out = out.with(over_others.widened(1.5 * p_.cell_m));
      if (clearOfArms(out, layer_m)) return out;
      if (wrap_up == 2) reject("ease", std::to_string(p_.ease) + ", leaves no room between chest and arms");
    }
  }
  /// Whether the wrap keeps its distance from the insides of the arms, or of their sleeves, as the body stands.
  bool clearOfArms(const Wrap& out, double layer_m) const {
    const Links arm = form_.links({"upper_arm_left", "forearm_left", "hand_left"}, "garment.shirt");
    const double sleeve = p_.sleeve_length_m ? layer_m + keptFromArm(p_, layer_m) : 0;
    constexpr int heights = 60;
    for (int k = 0; k <= heights; ++k) {
      const double z = hem_ + (wrap_top_ - hem_) * k / heights;
      double widest = -HUGE_VAL, inside = HUGE_VAL;
      for (const Vec2& p : out.crossSection(z)) widest = std::max(widest, p.y);
      for (const Vec2& p : form_.level(z, arm)) inside = std::min(inside, p.y);
      if (!(widest + layer_m + p_.gap_m + sleeve <= inside)) return false;
    }
    return true;
  }
  const Ring& ringAt(double z) const {
    const auto found = rings_.find(z);
    if (found != rings_.end()) return found->second;
    Ring r{ClosedCurve(cross_sections_.crossSection(z)), 0};
    r.front = r.curve.crossing({r.curve.centroid().x, form_.medianY()}, {1, 0});
    return rings_.emplace(z, std::move(r)).first->second;
  }
  /// Half the width of a panel: `low` beside the wrap, then along a parabola to the upper edge's.
  double armhole(double low, double z) const {
    const double x = std::clamp((top_ - z) / (top_ - wrap_top_), 0.0, 1.0);
    return top_half_m + (low - top_half_m) * x * x;
  }

  const ShirtPattern& p_;
  const BodyForm& form_;
  std::span<const Worn> under_;
  double hem_ = 0, top_ = 0, wrap_top_ = 0;
  Wrap cross_sections_;
  mutable std::map<double, Ring> rings_;
};

/// The edge a of a seam on a part of edge b takes the control points that hold it there.
///
/// These seams are C0 with a rotational spring, where the thesis joins the patches of its armour by the G1 map of
/// section 2.3. Each of the eight ends inside of an edge: straps, belly and back are narrower than what they are sewn
/// to, and the front is higher than the wrap. The map ties the points beside a seam to those across it; where a seam
/// ends, the long edge goes on with points that have nobody across, and one and the same point would be tied and free
/// (partOf refuses it). Straps and belly moreover leave the front at an angle at rest, which G1 excludes; only the
/// wrap's sides and the back go on smoothly. What a sewn edge resists to folding is the spring's (seam_stiffness).
void fitPart(Garment& g, const Seam& seam) {
  g.seams.push_back(seam);
  const EdgePart part = partOf(g, static_cast<int>(g.seams.size()) - 1);
  const NurbsPatch& b = g.patches[seam.b.patch];
  NurbsPatch& a = g.patches[seam.a.patch];
  const auto rb = edgeRow(b, seam.b), ra = edgeRow(a, seam.a);
  for (std::size_t k = 0; k < ra.size(); ++k) {
    Vec3 x{};
    for (const auto& [i, w] : part.rows[k]) x += w * b.points[rb[i]];
    a.points[ra[k]] = x;
  }
}

/// A U cut out of the upper edge, between the straps' inner edges less half a cell on either side.
Trim neckline(const Draft& d, const ShirtPattern& p, double height_m) {
  const double half = (d.neck_half - 0.5) / d.panel_cells, low = 1 - p.neck_depth_m / height_m;
  const KnotVector one{2, {0, 0, 0, 1, 1, 1}};
  const double l = 0.5 - half, r = 0.5 + half;
  // Clockwise, a hole: along the edge to the right, then down and around.
  return Trim{{TrimLoop{line({l, 1}, {r, 1}),
                        {one, {{r, 1}, {r, low}, {0.5, low}}, {1, 1, 1}},
                        {one, {{0.5, low}, {l, low}, {l, 1}}, {1, 1, 1}}}}};
}

/// A sleeve that is drafted into the trunk cannot be worn: what lies beside the wrap keeps its distance from it, but
/// for two cells below the armhole, where the two are sewn together.
void checkRoom(const Draft& d, const SleeveDraft& sleeve, const ShirtPattern& p, double layer_m) {
  constexpr int looks = 40;
  for (int part = 0; part < 4; ++part)
    for (int k = 0; k < looks; ++k)
      for (int i = 0; i < 4; ++i) {
        const double s = i / 4.0, t = static_cast<double>(k) / looks;
        const Vec3 x = sleeve.at(part, s, t);
        if (x.z < d.hem() || x.z > d.wrapTop() || sleeve.belowArmhole(part, s, t) < 2 * p.cell_m) continue;
        if (!(d.beside(x) > layer_m))
          reject("sleeve_ease",
                 fmt::format("{:.4g}, leaves no room between chest and sleeve {:.1f} cm below the armhole",
                             p.sleeve_ease, 100 * (d.wrapTop() - x.z)));
      }
}

/// A sleeve and its strips.
struct CutSleeve {
  std::unique_ptr<SleeveDraft> draft;
  std::array<NurbsPatch, 4> strips;
};

/// With cells under the arm that are twice as wide as others, or wider where a cell would fold else: those of the back
/// do beside a thin arm below a wide armhole.
CutSleeve cutSleeve(const ArmForm& arm, const std::array<ArmholePart, 4>& armhole, const ShirtPattern& p) {
  CutSleeve best;
  double least = HUGE_VAL;
  for (const double wider_under : {2.0, 2.5, 3.0, 3.5, 4.0}) {
    CutSleeve cut{std::make_unique<SleeveDraft>(arm, armhole, p.cell_m, wider_under), {}};
    const auto along = uniformKnots(p.degree, cut.draft->along());
    double turn = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      cut.strips[k] = interpolate(uniformKnots(p.degree, armhole[k].cells), along,
                                  [&](double s, double t) { return cut.draft->at(static_cast<int>(k), s, t); });
      turn = std::max(turn, largestTurn(cut.strips[k]));
    }
    if (turn < least) least = turn, best = std::move(cut);
    if (least <= kFoldedTurn_rad) break;
  }
  return best;
}

/// Both sleeves: strips of the left one beside each other, and their mirror images, sewn to the armholes.
void addSleeves(Garment& g, const Draft& d, const ShirtPattern& p, const BodyForm& form, double layer_m,
                std::span<const Worn> under) {
  using enum Side;
  const int wrapped = (d.wrap_around - d.panel_cells) / 2;  // cells of the wrap under an arm
  /// Where each strip is sewn to, left and right, and from which cell on.
  struct Hole {
    PatchEdge left, right;
    int first_left, first_right, cells;
  };
  const std::array<Hole, 4> holes{{
      {{front, u1}, {front, u0, true}, d.wrap_up, 0, d.front_up - d.wrap_up},
      {{strap_left, u1},
       {strap_right, u0, true},
       0,
       0,
       static_cast<int>(breakpoints(g.patches[strap_left].v).size()) - 1},
      {{back, u0, true}, {back, u1}, 0, 0, d.back_up},
      {{side_wrap, v1, true}, {side_wrap, v1, true}, d.wrap_around - wrapped, 0, wrapped},
  }};
  std::array<ArmholePart, 4> armhole;
  for (std::size_t k = 0; k < 4; ++k) {
    const Hole& hole = holes[k];
    const NurbsPatch& patch = g.patches[hole.left.patch];
    const bool along_v = hole.left.side == u0 || hole.left.side == u1;
    const double far = hole.left.side == u1 || hole.left.side == v1 ? 1 : 0;
    const double all = static_cast<double>(breakpoints(along_v ? patch.v : patch.u).size()) - 1;
    const int points = 16 * hole.cells;
    for (int i = 0; i <= points; ++i) {
      const double sense = (hole.first_left + static_cast<double>(hole.cells) * i / points) / all;
      const double at = std::clamp(hole.left.reversed ? 1 - sense : sense, 0.0, 1.0);
      armhole[k].points.push_back(surfaceDerivatives(patch, along_v ? far : at, along_v ? at : far)[0]);
    }
    armhole[k].cells = hole.cells;
  }
  SleeveFit fit{*p.sleeve_length_m, p.sleeve_ease, p.sleeve_hem_ease};
  fit.keep_m = keptFromArm(p, layer_m);
  fit.layer_m = layer_m;
  fit.gap_m = p.gap_m;
  fit.shoulder_z_m = 0.5 * (d.wrapTop() + d.top());
  for (const ArmholePart& part : armhole)
    for (const Vec3& x : part.points) fit.shoulder_y_m = std::min(fit.shoulder_y_m, x.y);
  const ArmForm arm(form, fit, under);
  CutSleeve sleeve = cutSleeve(arm, armhole, p);
  checkRoom(d, *sleeve.draft, p, layer_m);

  const Vec3 axis = arm.toWorld().rotation.c;
  for (int k = 0; k < 4; ++k) {
    g.patches[sleeve_front_left + k] = std::move(sleeve.strips[static_cast<std::size_t>(k)]);
    g.weft[sleeve_front_left + k] = axis;
  }
  for (int k = 0; k < 4; ++k) {
    const NurbsPatch& left = g.patches[sleeve_front_left + k];
    NurbsPatch& right = g.patches[sleeve_front_right + k] = left;
    for (int j = 0; j < left.v.count(); ++j)
      for (int i = 0; i < left.u.count(); ++i) {
        const Vec3& x = left.points[left.index(left.u.count() - 1 - i, j)];
        right.points[right.index(i, j)] = {x.x, 2 * form.medianY() - x.y, x.z};
      }
    g.weft[sleeve_front_right + k] = {axis.x, -axis.y, axis.z};
  }
  const double stiff = p.seam_stiffness_N;
  for (int k = 0; k < 4; ++k) {
    const Hole& hole = holes[static_cast<std::size_t>(k)];
    // Free to fold: under the arm they nearly lie on each other, where a spring's angle ends.
    fitPart(g, {{sleeve_front_left + k, v1}, hole.left, SeamKind::C0, 0, hole.first_left});
    fitPart(g, {{sleeve_front_right + k, v1}, hole.right, SeamKind::C0, 0, hole.first_right});
  }
  for (int k = 0; k < 4; ++k)
    for (const bool right : {false, true}) {
      const int first = right ? sleeve_front_right : sleeve_front_left;
      const Seam seam{{first + k, right ? u0 : u1}, {first + (k + 1) % 4, right ? u1 : u0}, SeamKind::C0, stiff};
      const auto ra = edgeRow(g.patches[seam.a.patch], seam.a), rb = edgeRow(g.patches[seam.b.patch], seam.b);
      for (std::size_t i = 0; i + 1 < ra.size(); ++i)  // the same up to rounding
        g.patches[seam.b.patch].points[rb[i]] = g.patches[seam.a.patch].points[ra[i]];
      g.seams.push_back(seam);
    }
  for (const bool right : {false, true}) {
    NamedEdge cuff{right ? "cuff_right" : "cuff_left", {}};
    for (int k = 0; k < 4; ++k) cuff.edges.push_back({(right ? sleeve_front_right : sleeve_front_left) + k, v0});
    g.edges.push_back(cuff);
  }
}

}  // namespace

Garment makeShirt(const ShirtPattern& p, const BodyForm& form, double layer_m, std::span<const Worn> under) {
  check(p);
  const Draft d(p, form, layer_m, under);
  const auto knots = [&](int cells) { return uniformKnots(p.degree, cells); };
  Garment g;
  g.name = "shirt";
  g.patch_names = shirtPatchNames(p.sleeve_length_m.has_value());
  g.patches.resize(g.patch_names.size());
  g.weft.assign(g.patches.size(), {0, 0, 1});
  const auto across = knots(d.panel_cells);
  g.patches[front] = interpolate(across, knots(d.front_up), [&](double s, double t) { return d.front(s, t); });
  g.patches[side_wrap] =
      interpolate(knots(d.wrap_around), knots(d.wrap_up), [&](double s, double t) { return d.wrap(s, t); });
  g.patches[back] = interpolate(across, knots(d.back_up), [&](double s, double t) { return d.back(s, t); });
  g.patches[belly] =
      interpolate(knots(d.belly_across), knots(d.belly_up), [&](double s, double t) { return d.belly(s, t); });

  using enum Side;
  const double k = p.seam_stiffness_N;
  const SeamKind C0 = SeamKind::C0;
  fitPart(g, {{side_wrap, u0}, {front, u1}, C0, k, 0});
  fitPart(g, {{side_wrap, u1}, {front, u0}, C0, k, 0});
  fitPart(g, {{back, v0}, {side_wrap, v1}, C0, k, (d.wrap_around - d.panel_cells) / 2});
  fitPart(g, {{belly, v1}, {front, v0}, C0, k, (d.panel_cells - d.belly_across) / 2});

  // The left strap between the outer cells of both upper edges; the right one is its mirror image.
  const int inner = d.panel_cells / 2 + d.neck_half;
  const auto upper = [&](ShirtPatch patch, double cell) {
    return surfaceDerivatives(g.patches[patch], cell / d.panel_cells, 1)[0];
  };
  StrapLine line;
  for (int i = 0; i <= StrapLine::lines; ++i) {
    const double a = static_cast<double>(i) / StrapLine::lines;
    line.front.push_back(upper(front, inner + a * d.strap_cells));
    line.back.push_back(upper(back, d.panel_cells - inner - a * d.strap_cells));
  }
  line.width_m = p.strap_width_m;
  line.clearance_m = layer_m + p.gap_m + 0.003;
  const Strap strap(line, form);
  // Along it no cell is longer than a spline can have that follows a small man's shoulder.
  const auto along = knots(cellsFor(strap.length(), std::min(p.cell_m, 0.0234), 4));
  g.patches[strap_left] = interpolate(knots(d.strap_cells), along, [&](double s, double t) { return strap.at(s, t); });
  g.patches[strap_right] = interpolate(knots(d.strap_cells), along, [&](double s, double t) {
    const Vec3 x = strap.at(1 - s, t);
    return Vec3{x.x, 2 * form.medianY() - x.y, x.z};
  });
  const int outer = d.margin;
  fitPart(g, {{strap_left, v0}, {front, v1}, C0, k, inner});
  fitPart(g, {{strap_left, v1, true}, {back, v1}, C0, k, outer});
  fitPart(g, {{strap_right, v0}, {front, v1}, C0, k, outer});
  fitPart(g, {{strap_right, v1, true}, {back, v1}, C0, k, inner});

  g.trims.resize(g.patches.size());
  g.trims[front] =
      neckline(d, p, norm(upper(front, 0.5 * d.panel_cells) - surfaceDerivatives(g.patches[front], 0.5, 0)[0]));
  g.edges = {{"hem", {{front, v0}, {side_wrap, v0}}},
             {"neck_front", {{front, v1}}},
             {"neck_back", {{back, v1}}},
             {"belly_hem", {{belly, v0}}}};
  if (p.sleeve_length_m) addSleeves(g, d, p, form, layer_m, under);
  validate(g);
  return g;
}

}  // namespace gambeson
