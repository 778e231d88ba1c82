#include "tryon/pattern/flat/place_panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "human/body/girths.hpp"
#include "tryon/pattern/arm_form.hpp"
#include "tryon/pattern/flat/body_tube.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/wrap.hpp"

namespace gambeson {
namespace {

using Part = RegionPart;
using Side = RegionSide;
using Face = RegionFace;

constexpr double kGap_m = 0.02;        ///< between panels of one plane
constexpr double kShoulder_m = 0.015;  ///< of a shoulder seam above the shoulder
constexpr double kCrotch_m = 0.01;     ///< of a crotch seam below the crotch
constexpr double kSample_m = 0.02;     ///< between points that are looked at
constexpr double kFree_m = 0.025;      ///< between points of a sleeve and of others
constexpr double kBody_m = 0.002;      ///< least distance of a point from the body
constexpr double kSlide_m = 0.01;      ///< steps of a sleeve down the arm
constexpr double kFarthest_m = 0.35;   ///< and how far it may go
constexpr double kClearances_m[] = {0.02, 0.035, 0.06, 0.1, 0.15};

[[noreturn]] void reject(const FlatPattern& pattern, int k, const std::string& reason) {
  throw InputError({"", 0, fmt::format("panels[{}]", k)},
                   fmt::format("panel \"{}\" {}", pattern.panels[static_cast<std::size_t>(k)].name, reason));
}

/// Points of a panel, in its plane: its border and a grid within.
std::vector<Vec2> samplesOf(const Panel& panel) {
  std::vector<Vec2> border = flattened(panel.outline, 1e-3), out;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Vec2 a = border[i], b = border[(i + 1) % border.size()];
    const int n = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / kSample_m)));
    for (int k = 0; k < n; ++k) out.push_back({a.x + (b.x - a.x) * k / n, a.y + (b.y - a.y) * k / n});
  }
  const PanelBox box = boxOf(panel.outline);
  for (double y = box.low.y + 0.5 * kSample_m; y < box.high.y; y += kSample_m)
    for (double x = box.low.x + 0.5 * kSample_m; x < box.high.x; x += kSample_m) {
      bool inside = false;
      for (std::size_t i = 0, j = border.size() - 1; i < border.size(); j = i++)
        if ((border[i].y > y) != (border[j].y > y) &&
            x < (border[j].x - border[i].x) * (y - border[i].y) / (border[j].y - border[i].y) + border[i].x)
          inside = !inside;
      if (inside) out.push_back({x, y});
    }
  return out;
}

/// Distances from the body as it stands.
class Body {
 public:
  explicit Body(const StandingBody& form) : form_(form), query_(form.shapes()) {
    for (std::size_t o = 0; o < form.shapes().size(); ++o) {
      const Shape& shape = form.shapes()[o].shape;
      double reach = 0;
      if (const auto* e = std::get_if<Ellipsoid>(&shape))
        reach = std::max({e->semi_axes.x, e->semi_axes.y, e->semi_axes.z});
      else
        for (const Vec3& v : std::get<TriangleMesh>(shape).vertices) reach = std::max(reach, norm(v));
      reach_m_.push_back(form.placements()[o].scale * reach);
    }
  }
  /// Of shapes that are nearer than kNear_m.
  PanelDepth depth(const Vec3& x) const {
    PanelDepth deepest;
    for (std::size_t o = 0; o < form_.shapes().size(); ++o) {
      const Placement& at = form_.placements()[o];
      if (norm(x - at.origin) > reach_m_[o] + kNear_m) continue;
      if (const double d = -query_.signedDistance(static_cast<int>(o), at, x); d > deepest.depth_m)
        deepest = {d, form_.shapes()[o].segment};
    }
    return deepest;
  }

 private:
  static constexpr double kNear_m = 0.01;
  const StandingBody& form_;
  ProximityQuery query_;
  std::vector<double> reach_m_;  ///< of each shape from its origin
};

/// Panels that cover one face of trunk and legs, in the parts that hang together.
struct Half {
  Face face;
  std::vector<int> panels;
  std::vector<LaidPart> parts;
};

void move(LaidPart& part, Vec2 by) {
  for (LaidPanel& p : part) p.move(by);
}
Vec2 lowOf(const LaidPart& part) {
  Vec2 v{1e300, 1e300};
  for (const LaidPanel& p : part) v = {std::min(v.x, p.low().x), std::min(v.y, p.low().y)};
  return v;
}
Vec2 highOf(const LaidPart& part) {
  Vec2 v{-1e300, -1e300};
  for (const LaidPanel& p : part) v = {std::max(v.x, p.high().x), std::max(v.y, p.high().y)};
  return v;
}

class Placing {
 public:
  Placing(const FlatPattern& pattern, const StandingBody& form)
      : pattern_(pattern), form_(form), pairs_(seamPairs(pattern)), body_(form) {
    arms_[0] = form.distalOf("upper_arm_left"), arms_[1] = form.distalOf("upper_arm_right");
    for (int l = 0; l < static_cast<int>(form.human().skeleton.links.size()); ++l)
      if (!contains(arms_[0], l) && !contains(arms_[1], l)) trunk_.push_back(l);
    pelvis_ = form.link("pelvis"), torso_ = form.link("torso"), head_ = form.link("head");
    for (const Panel& p : pattern.panels) regions_.push_back(regionOf(p));
    for (std::size_t k = 0; k < regions_.size(); ++k)
      if (!regions_[k]) reject(pattern, static_cast<int>(k), "has no region of the body to stand at");
    sort();
    for (Half* half : {&front_, &back_}) {
      std::vector<LaidPanel> own;
      for (const int k : half->panels) own.push_back(upright(pattern, k, pairs_));
      half->parts = layPanels(pattern, own, pairs_, kGap_m);
      for (LaidPart& part : half->parts) centre(*half, part);
    }
    findHeights();
    for (const int k : rings_) makeRoom(k);
    for (Half* half : {&front_, &back_}) spread(*half);
  }

  /// At this clearance; `stuck` where a panel passes through the body: which, and how deep.
  PlacedPanels at(double clearance_m, int& stuck, PanelDepth& depth) {
    PlacedPanels out;
    out.flat.resize(pattern_.panels.size());
    out.bent.resize(pattern_.panels.size());
    placeHalves(clearance_m, out);
    for (const int k : rings_) placeRing(k, clearance_m, out);
    std::vector<Vec3> others;
    for (std::size_t k = 0; k < out.bent.size(); ++k)
      if (out.bent[k])
        for (const Vec2 x : samplesOf(pattern_.panels[k])) others.push_back(out.bent[k](x));
    for (int side = 0; side < 2; ++side) placeSleeves(side, clearance_m, others, out);
    stuck = -1, depth = {};
    for (std::size_t k = 0; k < out.bent.size(); ++k)
      for (const Vec2 x : samplesOf(pattern_.panels[k]))
        if (const PanelDepth d = body_.depth(out.bent[k](x)); d.depth_m > std::max(depth.depth_m, -kBody_m))
          depth = d, stuck = static_cast<int>(k);
    for (const auto& [half, list] : {std::pair(&front_, &out.front), {&back_, &out.back}})
      for (const LaidPart& part : half->parts) list->insert(list->end(), part.begin(), part.end());
    return out;
  }

 private:
  static bool contains(const StandingBody::Links& of, int link) {
    return std::find(of.begin(), of.end(), link) != of.end();
  }
  const PanelRegion& region(int k) const { return *regions_[static_cast<std::size_t>(k)]; }

  /// Which panels lie in which plane. A collar or a waistband lies in that of the panels that it is sewn to, or is a
  /// ring where these are of both.
  void sort() {
    for (int k = 0; k < static_cast<int>(regions_.size()); ++k) {
      Face face = region(k).face;
      if (region(k).part == Part::sleeve) {
        sleeves_[region(k).side == Side::left ? 0 : 1].push_back(k);
        continue;
      }
      if (face == Face::both) {
        bool front = false, back = false;
        for (const SeamPair& p : pairs_)
          if ((p.a == k) != (p.b == k)) {
            const Face other = region(p.a == k ? p.b : p.a).face;
            front = front || other == Face::front, back = back || other == Face::back;
          }
        if (front != back) face = front ? Face::front : Face::back;
      }
      if (face == Face::both)
        rings_.push_back(k);
      else
        (face == Face::front ? front_ : back_).panels.push_back(k);
    }
  }

  /// Left and right parts lie on their sides of the middle, others across it. From the front the wearer's left is at
  /// +x, from behind his right.
  void centre(const Half& half, LaidPart& part) {
    bool left = true, right = true;
    for (const LaidPanel& p : part) {
      left = left && region(p.panel).side == Side::left;
      right = right && region(p.panel).side == Side::right;
    }
    if (half.face == Face::back) std::swap(left, right);
    const double low = lowOf(part).x, high = highOf(part).x;
    move(part, {left ? 0.5 * kGap_m - low : right ? -0.5 * kGap_m - high : -0.5 * (low + high), 0});
  }

  /// Parts that no seam holds together must not lie on each other either.
  void spread(Half& half) {
    std::stable_sort(half.parts.begin(), half.parts.end(), [](const LaidPart& a, const LaidPart& b) {
      return lowOf(a).x + highOf(a).x < lowOf(b).x + highOf(b).x;
    });
    for (std::size_t i = 1; i < half.parts.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        double by = 0;
        for (const LaidPanel& a : half.parts[j])
          for (const LaidPanel& b : half.parts[i]) by = std::max(by, wayPast(a, b, 1, kGap_m));
        move(half.parts[i], {by, 0});
      }
  }

  /// Height of the shoulders (neck and head apart) at a distance from the median plane.
  double shoulderAt(double y) const {
    double top = -1e300;
    StandingBody::Links of = arms_[0];
    of.insert(of.end(), arms_[1].begin(), arms_[1].end());
    of.push_back(torso_);
    for (const Vec3& x : form_.points(of))
      if (std::abs(std::abs(x.y - form_.medianY()) - y) < 0.03) top = std::max(top, x.z);
    return top > -1e300 ? top : form_.origin(head_).z;
  }
  double waist() const {
    return form_.origin(torso_).z + kWaistShare * (form_.origin(head_).z - form_.origin(torso_).z);
  }

  /// Moves a part to its own height; false where it has none.
  bool hang(LaidPart& part, const Half& other) {
    double shoulder = 0, out = 0, held = 0, crotch = 1e300, top = -1e300;
    for (const LaidPanel& q : part) {
      const Part what = region(q.panel).part;
      if (what == Part::skirt || what == Part::leg || what == Part::waistband) top = std::max(top, q.high().y);
      for (const SeamPair& given : pairs_) {
        if (given.a != q.panel && given.b != q.panel) continue;
        const SeamPair p = given.a == q.panel ? given : turned(given);
        const bool front_to_back = std::find(other.panels.begin(), other.panels.end(), p.b) != other.panels.end();
        const Vec2 x = q.of(p.xa);
        if (front_to_back && q.turn(p.na).y > 0.7)
          shoulder += p.length_m * x.y, out += p.length_m * std::abs(x.x), held += p.length_m;
        if (what == Part::leg && region(p.b).part == Part::leg && region(p.b).side != region(p.a).side)
          crotch = std::min(crotch, x.y);
      }
    }
    if (held > 0)
      move(part, {0, shoulderAt(out / held) + kShoulder_m - shoulder / held});
    else if (crotch < 1e300)
      move(part, {0, form_.lowest({pelvis_}) - kCrotch_m - crotch});
    else if (top > -1e300)
      move(part, {0, waist() - top});
    else
      return false;
    return true;
  }

  /// Of parts that hang at nothing the seams with others tell the height; else their upper edge lies under the armpits.
  void findHeights() {
    std::vector<LaidPart*> known, open;
    for (Half* half : {&front_, &back_})
      for (LaidPart& part : half->parts) (hang(part, half == &front_ ? back_ : front_) ? known : open).push_back(&part);
    while (!open.empty()) {
      bool found = false;
      for (std::size_t i = 0; i < open.size() && !found; ++i) {
        double way = 0, held = 0;
        for (const SeamPair& given : pairs_)
          for (const SeamPair& p : {given, turned(given)})
            for (const LaidPanel& q : *open[i])
              for (const LaidPart* part : known)
                for (const LaidPanel& at : *part)
                  if (p.a == q.panel && p.b == at.panel)
                    way += p.length_m * (at.of(p.xb).y - q.of(p.xa).y), held += p.length_m;
        if (!(held > 0)) continue;
        move(*open[i], {0, way / held});
        known.push_back(open[i]);
        open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
        found = true;
      }
      if (found || open.empty()) continue;
      const int arm = form_.human().skeleton.link("upper_arm_left");
      const double armpit = arm >= 0 ? form_.origin(arm).z - 0.03 * form_.human().stature_m : form_.origin(head_).z;
      move(*open[0], {0, armpit - highOf(*open[0]).y});
      known.push_back(open[0]);
      open.erase(open.begin());
    }
  }

  /// Calls f with each pair of a ring, its own point first, and which way its edge looks there.
  template <class F>
  void eachOfRing(int k, const LaidPanel& laid, F f) const {
    for (const SeamPair& given : pairs_) {
      if ((given.a == k) == (given.b == k)) continue;
      const SeamPair p = given.a == k ? given : turned(given);
      f(p, laid.turn(p.na).y);
    }
  }
  static bool isUpper(double looks) { return looks > 0.7; }
  /// Short ends of a band, sewn to a fly, to panels beside it or to the band's other piece, look aside.
  static bool isEnd(double looks) { return std::abs(looks) <= 0.7; }

  /// Between what a waistband is sewn to above and below it: what is below goes down until the band fits there.
  void makeRoom(int k) {
    if (region(k).part != Part::waistband) return;
    const LaidPanel laid = upright(pattern_, k, pairs_);
    std::vector<LaidPart*> below;
    double floor = -1e300, roof = 1e300;
    for (Half* half : {&front_, &back_})
      for (LaidPart& part : half->parts) {
        double high = -1e300, low = 1e300;
        eachOfRing(k, laid, [&](const SeamPair& p, double looks) {
          for (const LaidPanel& q : part)
            if (q.panel == p.b) {
              if (isUpper(looks))
                low = std::min(low, q.low().y);
              else if (!isEnd(looks))
                high = std::max(high, q.high().y);
            }
        });
        roof = std::min(roof, low), floor = std::max(floor, high);
        if (high > -1e299 && low > 1e299) below.push_back(&part);
      }
    const double missing = laid.high().y - laid.low().y + 2 * kGap_m - (roof - floor);
    if (floor < -1e299 || !(missing > 0)) return;
    for (LaidPart* part : below) move(*part, {0, -missing});
  }

  std::vector<Vec2> hullBetween(double low, double high) const {
    constexpr double kMore_m = 0.03;
    std::vector<Vec2> points;
    for (const Vec3& x : form_.points(trunk_))
      if (x.z > low - kMore_m && x.z < high + kMore_m) {
        points.push_back({x.x, x.y});
        points.push_back({x.x, 2 * form_.medianY() - x.y});
      }
    points = convexHull(std::move(points));
    if (points.size() < 3)
      throw InputError({"", 0, "human"},
                       fmt::format("has no body between the heights {:.2f} and {:.2f} m, where panels "
                                   "of the pattern are to stand",
                                   low, high));
    return points;
  }

  void set(PlacedPanels& out, const LaidPanel& laid, std::function<Vec3(Vec2)> world) const {
    // Where its middle touches, by differences: the surface is bent about one direction.
    constexpr double h = 1e-4;
    const Vec2 low = laid.low(), high = laid.high(), m{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
    const Vec3 up = normalized(world({m.x, m.y + h}) - world({m.x, m.y - h}));
    Vec3 right = world({m.x + h, m.y}) - world({m.x - h, m.y});
    right = normalized(right - dot(right, up) * up);
    const Vec3 origin = world(m) + (laid.at.x - m.x) * right + (laid.at.y - m.y) * up;
    const auto k = static_cast<std::size_t>(laid.panel);
    out.flat[k] = {origin, laid.right.x * right + laid.up.x * up, laid.right.y * right + laid.up.y * up};
    out.bent[k] = [laid, world = std::move(world)](Vec2 x) { return world(laid.of(x)); };
  }

  void placeHalves(double clearance_m, PlacedPanels& out) {
    double low = 1e300, high = -1e300;
    for (const Half* half : {&front_, &back_})
      for (const LaidPart& part : half->parts)
        low = std::min(low, lowOf(part).y), high = std::max(high, highOf(part).y);
    top_ = high, bottom_ = low;
    if (!(low < high)) return;
    const auto tube = std::make_shared<BodyTube>(hullBetween(low, high), clearance_m);
    for (const Half* half : {&front_, &back_}) {
      double from = 0, to = 0;
      for (const LaidPart& part : half->parts) from = std::min(from, lowOf(part).x), to = std::max(to, highOf(part).x);
      const TubeHalf face = tube->half(half->face == Face::front, from, to, 2 * kGap_m);
      for (const LaidPart& part : half->parts)
        for (const LaidPanel& p : part)
          set(out, p, [tube, face](Vec2 x) {
            const Vec2 at = tube->at(face, x.x);
            return Vec3{at.x, at.y, x.y};
          });
    }
  }

  /// Above what it is sewn to, its points as near in direction to those that they are sewn to as can be. A waistband
  /// stands above what is sewn to its lower edge alone, where nothing is beside what its short ends are sewn to, and
  /// outside of what else there is at its height.
  void placeRing(int k, double clearance_m, PlacedPanels& out) const {
    LaidPanel laid = upright(pattern_, k, pairs_);
    const bool band = region(k).part == Part::waistband;
    const double length = laid.high().x - laid.low().x, height = laid.high().y - laid.low().y;
    double bottom = -1e300, roof = 1e300, beside = 0, held = 0;
    std::vector<int> under;  // what it is sewn to below it
    eachOfRing(k, laid, [&](const SeamPair& p, double looks) {
      if (!out.bent[static_cast<std::size_t>(p.b)]) return;
      const double z = out.bent[static_cast<std::size_t>(p.b)](p.xb).z;
      if (band && isUpper(looks))
        roof = std::min(roof, z);
      else if (band && isEnd(looks))
        beside += p.length_m * (z - (laid.of(p.xa).y - laid.low().y)), held += p.length_m;
      else
        bottom = std::max(bottom, z), under.push_back(p.b);
    });
    if (bottom < -1e299 && roof < 1e299) bottom = roof - height - 2 * kGap_m;
    if (bottom < -1e299 && held > 0) bottom = beside / held - kGap_m;
    if (bottom < -1e299) bottom = region(k).part == Part::collar ? top_ : waist();
    bottom += kGap_m;
    const auto eachLaid = [&](auto f) {
      for (const Half* half : {&front_, &back_})
        for (const LaidPart& part : half->parts)
          for (const LaidPanel& p : part) f(p);
    };
    bool among = false;
    eachLaid([&](const LaidPanel& p) {
      if ((!band || std::find(under.begin(), under.end(), p.panel) != under.end()) && p.low().y < bottom + 0.3 &&
          p.high().y > bottom - kGap_m)
        bottom = std::max(bottom, std::min(p.high().y, top_) + kGap_m);
    });
    eachLaid([&](const LaidPanel& p) {
      among = among || (band && p.low().y < bottom + height + 0.5 * kGap_m && p.high().y > bottom - 0.5 * kGap_m);
    });
    const std::vector<Vec2> hull = among ? hullBetween(bottom_, top_) : hullBetween(bottom, bottom + height);
    const double around = tapeGirth(hull);
    const double off =
        std::max(clearance_m + (among ? kGap_m : 0), (length + 2 * kGap_m - around) / (2 * std::numbers::pi));
    const auto tube = std::make_shared<BodyTube>(hull, off);
    const Vec2 c = tube->centre();
    Vec2 direction{};
    eachOfRing(k, laid, [&](const SeamPair& p, double) {
      if (!out.bent[static_cast<std::size_t>(p.b)]) return;
      const Vec3 to = out.bent[static_cast<std::size_t>(p.b)](p.xb);
      const double angle =
          std::atan2(to.y - c.y, to.x - c.x) -
          2 * std::numbers::pi * (laid.of(p.xa).x - 0.5 * (laid.low().x + laid.high().x)) / tube->length();
      direction = {direction.x + p.length_m * std::cos(angle), direction.y + p.length_m * std::sin(angle)};
    });
    if (std::hypot(direction.x, direction.y) < 1e-9) direction = {region(k).part == Part::collar ? -1.0 : 1.0, 0};
    laid.move({-0.5 * (laid.low().x + laid.high().x), bottom - laid.low().y});
    const double start = tube->startAt(direction);
    set(out, laid, [tube, start](Vec2 x) {
      const Vec2 at = tube->point(start + x.x);
      return Vec3{at.x, at.y, x.y};
    });
  }

  /// Seams of a sleeve's panels without those that would have its front behind: the ones under the arm, which stays
  /// open there.
  std::vector<SeamPair> sleevePairs(int side, std::span<const LaidPanel> own) const {
    // How much more of a panel is sewn to the front than to the back [m].
    const auto faceOf = [&](int k) {
      double more = 0;
      for (const SeamPair& p : pairs_)
        if ((p.a == k) != (p.b == k)) {
          const Face face = region(p.a == k ? p.b : p.a).face;
          more += (face == Face::front ? 1 : face == Face::back ? -1 : 0) * p.length_m;
        }
      return more;
    };
    const auto laid = [&](int k) -> const LaidPanel* {
      for (const LaidPanel& p : own)
        if (p.panel == k) return &p;
      return nullptr;
    };
    std::vector<SeamPair> out, all;
    for (const SeamPair& given : pairs_) {
      const SeamPair p = laid(given.a) && laid(given.b) && faceOf(given.a) < faceOf(given.b) ? turned(given) : given;
      const LaidPanel *a = laid(p.a), *b = laid(p.b);
      if (!a || !b || a == b) continue;
      all.push_back(p);
      // a is further forward: seen from outside at the left of b on the left arm, at its right on the right arm.
      const double sense = side == 0 ? 1 : -1;
      if (faceOf(p.a) == faceOf(p.b) || sense * (a->turn(p.na).x - b->turn(p.nb).x) > 0) out.push_back(p);
    }
    return out.empty() ? all : out;
  }

  /// Where an arm lies across, (to its right, off the trunk) from its shoulder, between two places along its way up.
  struct ArmBox {
    Vec2 middle, half;
  };
  struct ArmWays {
    Vec3 right, off, up;
  };
  ArmBox boxOfArm(const StandingBody::Links& arm, const Vec3& shoulder, const ArmWays& ways, double from,
                  double to) const {
    Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Vec3& x : form_.points(arm)) {
      const Vec3 r = x - shoulder;
      if (const double along = dot(r, ways.up); !(along > from && along < to)) continue;
      low = {std::min(low.x, dot(r, ways.right)), std::min(low.y, dot(r, ways.off))};
      high = {std::max(high.x, dot(r, ways.right)), std::max(high.y, dot(r, ways.off))};
    }
    if (!(low.x < high.x)) return {};
    return {{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)}, {0.5 * (high.x - low.x), 0.5 * (high.y - low.y)}};
  }

  /// `side` 0: left. Along the line from shoulder to hand.
  void placeSleeves(int side, double clearance_m, const std::vector<Vec3>& others, PlacedPanels& out) const {
    const std::vector<int>& panels = sleeves_[side];
    if (panels.empty()) return;
    const char* const names[2][2] = {{"upper_arm_left", "forearm_left"}, {"upper_arm_right", "forearm_right"}};
    const StandingBody::Links links = form_.links({names[side][0], names[side][1]});
    const int hand = form_.human().skeleton.link(side == 0 ? "hand_left" : "hand_right");
    const Vec3 shoulder = form_.origin(links[0]);
    const ArmAxes arm = armAxes(normalized(shoulder - form_.origin(hand >= 0 ? hand : links[1])));
    const Vec3 up = arm.up, off = side == 0 ? arm.left : -arm.left;
    const Vec3 right = side == 0 ? -arm.forward : arm.forward;  // as seen from outside
    std::vector<LaidPanel> own;
    for (const int k : panels) own.push_back(upright(pattern_, k, pairs_, panels));
    std::vector<LaidPart> parts = layPanels(pattern_, own, sleevePairs(side, own), kGap_m);
    LaidPart all;
    for (LaidPart& part : parts) {
      const double middle = 0.5 * (lowOf(part).x + highOf(part).x);
      move(part, {-middle, -highOf(part).y});
      for (LaidPanel& p : part) {
        double by = 0;
        for (const LaidPanel& q : all) by = std::max(by, wayPast(q, p, 1, kGap_m));
        p.move({by, 0});
      }
      all.insert(all.end(), part.begin(), part.end());
    }
    move(all, {-0.5 * (lowOf(all).x + highOf(all).x), 0});
    const double half = highOf(all).x, low = lowOf(all).y;
    for (const double clearance : kClearances_m) {
      if (clearance > clearance_m) break;
      for (double down = 0; down <= kFarthest_m; down += kSlide_m) {
        const ArmBox box = boxOfArm(arms_[side], shoulder, {right, off, up}, low - down - 0.02, -down + 0.02);
        // A gutter: flat, round, then straight, no further than the arm is thick, whose walls are as near as can be.
        constexpr double quarter = 0.5 * std::numbers::pi;
        double wall = box.half.x + clearance, bottom = box.half.y + clearance, round = std::min(wall, bottom);
        const double flat = wall - round, straight = half - flat - quarter * round;
        if (const double more = (straight - 2 * bottom) / (quarter + 2); more > 0) bottom += more, round += more;
        const Vec3 axis = shoulder + box.middle.x * right + (box.middle.y + bottom - round) * off;
        const auto world = [=](Vec2 x) {
          const double s = std::abs(x.x), sense = x.x < 0 ? -1 : 1,
                       angle = std::clamp((s - flat) / round, 0.0, quarter);
          const double aside = std::min(s, flat) + round * std::sin(angle),
                       above = round * std::cos(angle) - std::max(0.0, s - flat - quarter * round);
          return axis + (x.y - down) * up + (sense * aside) * right + above * off;
        };
        for (const LaidPanel& p : all) set(out, p, world);
        bool free = true;
        for (const LaidPanel& p : all)
          for (const Vec2 x : samplesOf(pattern_.panels[static_cast<std::size_t>(p.panel)])) {
            const Vec3 at = world(p.of(x));
            free = free && body_.depth(at).depth_m < -kBody_m &&
                   std::none_of(others.begin(), others.end(), [&](const Vec3& o) { return norm(o - at) < kFree_m; });
            if (!free) break;
          }
        if (free) return;
      }
    }
    reject(pattern_, panels[0],
           fmt::format("finds no room around the {} arm beside the other panels and the body",
                       side == 0 ? "left" : "right"));
  }

  const FlatPattern& pattern_;
  const StandingBody& form_;
  std::vector<SeamPair> pairs_;
  Body body_;
  StandingBody::Links arms_[2], trunk_;
  int pelvis_ = -1, torso_ = -1, head_ = -1;
  std::vector<std::optional<PanelRegion>> regions_;
  Half front_{Face::front, {}, {}}, back_{Face::back, {}, {}};
  std::vector<int> sleeves_[2], rings_;
  double top_ = 0, bottom_ = 0;  ///< of all that stands before and behind
};

}  // namespace

std::optional<PanelRegion> regionOf(const Panel& panel) { return regionOf(std::string_view(panel.region)); }

bool coversArms(const FlatPattern& pattern) {
  return std::any_of(pattern.panels.begin(), pattern.panels.end(), [](const Panel& p) {
    const std::optional<PanelRegion> r = regionOf(p);
    return r && (r->part == Part::trunk || r->part == Part::sleeve);
  });
}

PanelDepth depthInBody(const Panel& panel, const std::function<Vec3(Vec2)>& at, const StandingBody& form) {
  const Body body(form);
  PanelDepth deepest;
  for (const Vec2 x : samplesOf(panel))
    if (const PanelDepth d = body.depth(at(x)); d.depth_m > deepest.depth_m) deepest = d;
  return deepest;
}

PlacedPanels placePanels(const FlatPattern& pattern, const StandingBody& form) {
  Placing placing(pattern, form);
  int stuck = -1;
  PanelDepth depth;
  std::optional<InputError> no_room;
  for (const double clearance_m : kClearances_m) {
    try {
      PlacedPanels out = placing.at(clearance_m, stuck, depth);
      if (stuck < 0) return out;
      no_room.reset();
    } catch (const InputError& e) {
      if (!e.where().key.starts_with("panels")) throw;
      no_room = e;
    }
  }
  if (no_room) throw *no_room;
  reject(pattern, stuck,
         fmt::format("({}) cannot stand around the wearer: {:.1f} cm of it would lie in the body ({}), at up to {:.0f} "
                     "cm off the trunk; another region, or a placement of its own, may free it",
                     wordOf(*regionOf(pattern.panels[static_cast<std::size_t>(stuck)])),
                     100 * std::max(0.0, depth.depth_m), depth.segment, 100 * std::end(kClearances_m)[-1]));
}

}  // namespace gambeson
