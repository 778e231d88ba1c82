#include "tryon/pattern/flat/panel_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "human/body/girths.hpp"
#include "human/body/section.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

using Part = RegionPart;

/// Girth of a link across the line to the next, midway: points within 2.5 cm of the plane, seen along the line.
double girthAcross(const StandingBody& form, int link, int next) {
  constexpr double kNear_m = 0.025;
  const Vec3 a = form.origin(link), b = form.origin(next), n = normalized(b - a), middle = 0.5 * (a + b);
  const Vec3 e1 = normalized(cross(std::abs(n.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, n)), e2 = cross(n, e1);
  std::vector<Vec2> points;
  for (const Vec3& x : form.points({link}))
    if (std::abs(dot(x - middle, n)) < kNear_m) points.push_back({dot(x - middle, e1), dot(x - middle, e2)});
  return tapeGirth(std::move(points));
}

double widest(const LaidPanel& p) {
  constexpr double kStep_m = 0.005;
  double most = 0;
  for (double y = p.low().y + 0.5 * kStep_m; y < p.high().y; y += kStep_m) most = std::max(most, widthAt(p, y));
  return most;
}

}  // namespace

std::vector<PanelGirth> panelGirths(const FlatPattern& pattern, const std::vector<LaidPanel>& front,
                                    const std::vector<LaidPanel>& back, const StandingBody& form) {
  constexpr double kSide = 0.7, kInside_m = 0.01, kNear_m = 0.12, kNearChest_m = 0.15, kSeam_m = 0.03;
  std::vector<PanelGirth> out;
  const std::vector<SeamPair> pairs = seamPairs(pattern);
  const Skeleton& skeleton = form.human().skeleton;
  const int pelvis = skeleton.link("pelvis"), torso = skeleton.link("torso"), head = skeleton.link("head");
  const int thigh[2] = {skeleton.link("thigh_left"), skeleton.link("thigh_right")};
  if (pelvis < 0 || torso < 0 || head < 0 || thigh[0] < 0 || thigh[1] < 0) return out;
  const double crotch = form.lowest({pelvis});

  // Where side seams close the panels, above the crotch.
  double low = 1e300, high = -1e300;
  for (const SeamPair& given : pairs)
    for (const SeamPair& p : {given, turned(given)})
      for (const LaidPanel& a : front)
        for (const LaidPanel& b : back)
          if (p.a == a.panel && p.b == b.panel && std::abs(a.turn(p.na).x) > kSide && a.of(p.xa).y > crotch) {
            low = std::min({low, a.of(p.xa).y});
            high = std::max({high, a.of(p.xa).y});
          }
  const auto widthOf = [&](double z, auto counts) {
    double sum = 0;
    for (const auto* half : {&front, &back}) {
      double own = 0;
      for (const LaidPanel& p : *half)
        if (counts(p)) own += widthAt(p, z);
      if (!(own > 0)) return 0.0;
      sum += own;
    }
    return sum;
  };
  const double trunk = form.origin(head).z - form.origin(torso).z;
  const struct {
    const char* name;
    double z, near_m;
  } levels[] = {{"chest", form.origin(torso).z + kChestShare * trunk, kNearChest_m},
                {"waist", form.origin(torso).z + kWaistShare * trunk, kNear_m},
                {"hip", 0.5 * (form.origin(thigh[0]).z + form.origin(thigh[1]).z), kNear_m}};
  for (const auto& level : levels) {
    if (!(high - low > 4 * kInside_m)) break;
    const auto all = [&](double z) { return widthOf(z, [](const LaidPanel&) { return true; }); };
    double z = std::clamp(level.z, low + kInside_m, high - kInside_m);
    if (std::abs(z - level.z) > level.near_m) continue;
    // Where a seam around the body crosses the level, neither what is above it nor what is below is there whole.
    double lowest = z, highest = z;
    for (const SeamPair& p : pairs)
      for (const auto* half : {&front, &back})
        for (const LaidPanel& one : *half)
          for (const LaidPanel& other : *half)
            if (p.a == one.panel && p.b == other.panel && std::abs(one.turn(p.na).y) > kSide &&
                std::abs(one.of(p.xa).y - level.z) < kSeam_m)
              for (const double y : {one.of(p.xa).y, other.of(p.xb).y})
                lowest = std::min(lowest, y - kInside_m), highest = std::max(highest, y + kInside_m);
    const bool up = lowest < low || (highest < high && highest - z < z - lowest);
    if (highest > lowest) z = up ? highest : lowest;
    const double panels = all(z);
    const double body = tapeGirth(form.level(z, {pelvis, torso, thigh[0], thigh[1]}));
    if (panels > 0 && body > 0) out.push_back({level.name, z, body, panels});
  }
  for (int side = 0; side < 2; ++side) {
    const RegionSide of = side == 0 ? RegionSide::left : RegionSide::right;
    const std::string name = side == 0 ? "left" : "right";
    const auto isOf = [&](int panel, Part part) {
      const std::optional<PanelRegion> r = regionOf(pattern.panels[static_cast<std::size_t>(panel)]);
      return r && r->part == part && r->side == of;
    };
    const int shank = skeleton.link("shank_" + name);
    if (shank >= 0) {
      const double z = (1 - kThighShare) * form.origin(thigh[side]).z + kThighShare * form.origin(shank).z;
      const double panels = widthOf(z, [&](const LaidPanel& p) { return isOf(p.panel, Part::leg); });
      const double body = tapeGirth(form.level(z, {thigh[side]}));
      if (panels > 0 && body > 0 && z < crotch) out.push_back({name + " thigh", z, body, panels});
    }
    const int arm = skeleton.link("upper_arm_" + name), forearm = skeleton.link("forearm_" + name);
    double panels = 0;
    std::vector<int> sleeve;
    for (int k = 0; k < static_cast<int>(pattern.panels.size()); ++k)
      if (isOf(k, Part::sleeve)) sleeve.push_back(k);
    for (const int k : sleeve) panels += widest(upright(pattern, k, pairs, sleeve));
    if (arm >= 0 && forearm >= 0 && panels > 0)
      out.push_back({name + " upper arm", 0.5 * (form.origin(arm).z + form.origin(forearm).z),
                     girthAcross(form, arm, forearm), panels});
  }
  return out;
}

void layAsPlaced(const FlatPattern& pattern, const Vec3& shift_m, std::vector<LaidPanel>& front,
                 std::vector<LaidPanel>& back) {
  constexpr double kUpright = 0.3;
  for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
    const Panel& panel = pattern.panels[k];
    const std::optional<PanelRegion> region = regionOf(panel);
    if (!panel.placement || !region || region->part == RegionPart::sleeve || region->face == RegionFace::both) continue;
    const PanelPlace& at = *panel.placement;
    const Vec3 out = cross(at.along_x, at.along_y);
    if (std::abs(out.z) > kUpright) continue;
    const Vec3 level = normalized(cross(Vec3{0, 0, 1}, out));
    LaidPanel laid;
    laid.panel = static_cast<int>(k);
    laid.right = {dot(at.along_x, level), dot(at.along_y, level)};
    laid.up = {at.along_x.z, at.along_y.z};
    const Vec3 origin = at.origin_m + shift_m;
    laid.at = {dot(origin, level), origin.z};
    for (const Vec2 x : flattened(panel.outline, 5e-4)) laid.outline.push_back(laid.of(x));
    (region->face == RegionFace::front ? front : back).push_back(std::move(laid));
  }
}

std::string shortText(std::vector<PanelGirth> girths, double stands) {
  std::erase_if(girths, [](const PanelGirth& g) { return !(g.short_m() > 5e-4); });
  std::stable_sort(girths.begin(), girths.end(),
                   [](const auto& a, const auto& b) { return a.short_m() > b.short_m(); });
  std::string text;
  for (const PanelGirth& g : girths) {
    text += fmt::format(
        "{}at the {} (at {:.2f} m) the wearer is {:.1f} cm around and the panels {:.1f} cm: {:.1f} cm short",
        text.empty() ? "" : "; ", g.where, g.height_m, 100 * g.body_m, 100 * g.panels_m, 100 * g.short_m());
    if (const double stretch = g.body_m / g.panels_m - 1; stretch > stands)
      text += fmt::format(" (stretched by {:.2g} %, and its fabric stands {:.2g} %)", 100 * stretch, 100 * stands);
  }
  return text;
}

}  // namespace gambeson
