#include "human/scan/tailor.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>

#include "human/body/girths.hpp"
#include "human/body/section.hpp"
#include "human/body/skin.hpp"
#include "human/scan/landmarks.hpp"

namespace gambeson {
namespace {

constexpr double kStep_m = 0.005;
constexpr double kHipBelow = 0.12, kHipAbove = 0.15;  ///< of the hip joints, over the trunk's length
constexpr double kWaistFrom = 0.0, kWaistTo = 0.45;   ///< from the lumbar joint to the neck's
constexpr double kBelowCrotch_m = 0.004;

using Triangles = std::vector<std::array<int, 3>>;

/// A level of the scan that moves with a link.
struct Level {
  int link;
  Pose X_LP;
};

double girthOf(const Level& level, const Pose& X_WL, const std::vector<Vec3>& x, const Triangles& triangles) {
  const Pose X_WP = X_WL * level.X_LP;
  std::vector<Vec2> points;
  for (const auto& ends : cutPieces({"", X_WP.origin, X_WP.rotation.a, X_WP.rotation.b, {}}, x, triangles))
    points.insert(points.end(), ends.begin(), ends.end());
  return tapeGirth(std::move(points));
}

class Tailor {
 public:
  Tailor(const Human& human, const std::vector<Pose>& standing)
      : human_(human), skin_(*human.skin), standing_(standing), stands_(skin_.rest.vertices.size()) {
    skinPositions(skin_, standing_, stands_);
  }

  int link(const char* name) const { return human_.skeleton.link(name); }
  Vec3 joint(const char* name) const { return skin_.bind[static_cast<std::size_t>(link(name))].origin; }

  Level levelAt(const char* name, double z) const {
    const int l = link(name);
    return {l, inverse(skin_.bind[static_cast<std::size_t>(l)]) * Pose{{}, {0, 0, z}}};
  }
  double scanned(const Level& level, const Triangles& triangles) const {
    return girthOf(level, skin_.bind[static_cast<std::size_t>(level.link)], skin_.rest.vertices, triangles);
  }
  ScanGirth both(const std::string& name, const Level& level, const Triangles& triangles) const {
    return {name, scanned(level, triangles),
            girthOf(level, standing_[static_cast<std::size_t>(level.link)], stands_, triangles)};
  }

  /// Triangles most of whose corners are marked.
  Triangles where(const std::function<bool(std::size_t)>& marked) const {
    Triangles out;
    for (const auto& t : skin_.rest.triangles)
      if (std::count_if(t.begin(), t.end(), [&](int v) { return marked(static_cast<std::size_t>(v)); }) >= 2)
        out.push_back(t);
    return out;
  }
  Triangles of(const std::vector<int>& links) const {
    return where([&](std::size_t v) { return std::count(links.begin(), links.end(), skin_.segment[v]) > 0; });
  }

  /// The level between two heights whose girth is the largest (sign 1) or the smallest (-1).
  Level extreme(const char* name, double from, double to, double sign, const Triangles& triangles) const {
    Level best = levelAt(name, from);
    double most = -std::numeric_limits<double>::infinity();
    for (double z = from; z <= to; z += kStep_m) {
      const Level level = levelAt(name, z);
      if (const double g = scanned(level, triangles); g > 0 && sign * g > most) most = sign * g, best = level;
    }
    return best;
  }

 private:
  const Human& human_;
  const Skin& skin_;
  const std::vector<Pose>& standing_;
  std::vector<Vec3> stands_;
};

}  // namespace

std::vector<ScanGirth> tailorsGirths(const Human& human, double crotch_m, const std::vector<Pose>& standing) {
  const Tailor tailor(human, standing);
  const double hip = 0.5 * (tailor.joint("thigh_left").z + tailor.joint("thigh_right").z),
               lumbar = tailor.joint("torso").z, trunk = tailor.joint("head").z - lumbar;
  const Triangles hips = tailor.of({tailor.link("pelvis"), tailor.link("thigh_left"), tailor.link("thigh_right")}),
                  middle = tailor.of({tailor.link("pelvis"), tailor.link("torso")});
  std::vector<ScanGirth> out;
  out.push_back(tailor.both("widest hip",
                            tailor.extreme("pelvis", std::max(crotch_m + kBelowCrotch_m, hip - kHipBelow * trunk),
                                           hip + kHipAbove * trunk, 1, hips),
                            hips));
  out.push_back(tailor.both("narrowest waist",
                            tailor.extreme("torso", lumbar + kWaistFrom * trunk, lumbar + kWaistTo * trunk, -1, middle),
                            middle));
  const std::vector<char> legs = legsBelow(human.skin->rest, crotch_m - 1e-3);
  for (const char side : {1, 2}) {
    const char* thigh = side == 1 ? "thigh_right" : "thigh_left";
    out.push_back(tailor.both(std::string("top of ") + thigh, tailor.levelAt(thigh, crotch_m - kBelowCrotch_m),
                              tailor.where([&](std::size_t v) { return legs[v] == side; })));
  }
  return out;
}

}  // namespace gambeson
