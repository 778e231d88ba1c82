#include "tryon/skin_projecting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"
#include "human/body/skin.hpp"
#include "tryon/projecting.hpp"

namespace gambeson {
namespace {

constexpr double kStep = 0.98;
/// Part of a touched point's weight from which a link takes part in shrinking away from it.
constexpr double kTakesPart = 0.2;

struct Axis {
  Vec3 a, b;
  Vec3 nearest(const Vec3& x) const {
    const Vec3 d = b - a;
    const double l2 = norm2(d), t = l2 > 0 ? std::clamp(dot(x - a, d) / l2, 0.0, 1.0) : 0;
    return a + t * d;
  }
};

double volumeOf(const Ellipsoid& e) { return e.semi_axes.x * e.semi_axes.y * e.semi_axes.z; }

/// From one end's sphere's centre to the other's: the longest semi-axis less the mean of the others, either way.
std::vector<std::optional<Axis>> axesOf(const Human& human, std::span<const Pose> X_WL) {
  std::vector<std::optional<Axis>> axes(human.skeleton.links.size());
  std::vector<double> largest(axes.size(), 0);
  for (const BodyShape& shape : human.shapes) {
    const auto* e = std::get_if<Ellipsoid>(&shape.shape);
    const auto l = static_cast<std::size_t>(shape.link);
    if (!e || !(volumeOf(*e) > largest[l])) continue;
    largest[l] = volumeOf(*e);
    int k = 0;
    for (int i = 1; i < 3; ++i)
      if (e->semi_axes[i] > e->semi_axes[k]) k = i;
    const double half = e->semi_axes[k] - 0.5 * (e->semi_axes[(k + 1) % 3] + e->semi_axes[(k + 2) % 3]);
    Vec3 along;
    along[k] = half;
    const Pose X_WS = X_WL[l] * shape.X_LS;
    axes[l] = Axis{X_WS * (-along), X_WS * along};
  }
  return axes;
}

class Shrinking {
 public:
  Shrinking(const Human& human, std::span<const Pose> X_WL, std::span<const Vec3> samples, double clearance)
      : skin_(*human.skin),
        samples_(samples),
        clearance_(clearance),
        axes_(axesOf(human, X_WL)),
        obstacles_{{skin_.rest, "skin", true}},
        query_(obstacles_),
        surfaces_(obstacles_),
        standing_(skin_.rest.vertices.size()) {
    skinPositions(skin_, X_WL, standing_);
  }

  std::vector<Vec3> positions(const std::vector<double>& factor) const {
    std::vector<Vec3> x = standing_;
    const int n = static_cast<int>(x.size());
    forAll(Each::much, n, [&](int v) {
      for (int i = skin_.first[v]; i < skin_.first[v + 1]; ++i) {
        const auto l = static_cast<std::size_t>(skin_.link[i]);
        if (factor[l] < 1)
          x[v] += (skin_.weight[i] * (1 - factor[l])) * (axes_[l]->nearest(standing_[v]) - standing_[v]);
      }
    });
    return x;
  }

  /// Which links are touched with these factors; false: none.
  bool touched(const std::vector<double>& factor, std::vector<char>& links) {
    const DeformedVertices x{positions(factor)};
    surfaces_.move(x);
    const int n = static_cast<int>(samples_.size());
    std::vector<Contact> near(samples_.size());
    forAll(Each::much, n, [&](int s) { near[s] = query_.nearest(0, samples_[s], surfaces_); });
    links.assign(axes_.size(), 0);
    bool any = false;
    std::vector<double> weight(axes_.size());
    for (const Contact& c : near) {
      if (c.gap_m >= clearance_) continue;
      any = true;
      std::fill(weight.begin(), weight.end(), 0.0);
      int most = 0;
      for (int k = 0; k < 3 && c.touched.vertex[k] >= 0; ++k)
        for (int i = skin_.first[c.touched.vertex[k]]; i < skin_.first[c.touched.vertex[k] + 1]; ++i)
          if (axes_[skin_.link[i]]) weight[skin_.link[i]] += c.touched.weight[k] * skin_.weight[i];
      for (std::size_t l = 0; l < weight.size(); ++l) {
        if (weight[l] > weight[most]) most = static_cast<int>(l);
        if (weight[l] >= kTakesPart) links[l] = 1;
      }
      if (weight[most] > 0) links[most] = 1;
    }
    return any;
  }

 private:
  const Skin& skin_;
  std::span<const Vec3> samples_;
  double clearance_;
  std::vector<std::optional<Axis>> axes_;
  std::vector<Obstacle> obstacles_;
  ProximityQuery query_;
  DeformedSurfaces surfaces_;
  std::vector<Vec3> standing_;
};

}  // namespace

ShrunkSkin shrinkSkinToFree(const Human& human, std::span<const Pose> X_WL, std::span<const Vec3> samples,
                            double clearance_m) {
  if (!(clearance_m > 0) || !std::isfinite(clearance_m))
    throw InputError({"", 0, "clearance_m"}, std::to_string(clearance_m) + ", must be positive");
  Shrinking shrinking(human, X_WL, samples, clearance_m);
  std::vector<double> factor(human.skeleton.links.size(), 1.0);
  std::vector<char> links;
  while (shrinking.touched(factor, links)) {
    std::string stuck;
    bool moved = false;
    for (std::size_t l = 0; l < factor.size(); ++l) {
      if (!links[l]) continue;
      factor[l] *= kStep;
      moved = true;
      if (factor[l] < least_projecting_scale) stuck += (stuck.empty() ? "" : ", ") + human.skeleton.links[l].name;
    }
    if (!moved) stuck = "a part without a shape";
    if (!stuck.empty())
      throw RunError("virtual projecting cannot free the garment of: " + stuck + ". Even at " +
                     std::to_string(static_cast<int>(std::lround(100 * least_projecting_scale))) +
                     " % of their distance from the bones the cloth passes within " +
                     std::to_string(1000 * clearance_m) +
                     " mm of them: place the garment around the body, or give it more ease");
  }
  for (double& k : factor) {
    if (!(k < 1)) continue;
    const double found = k;
    k = std::min(1.0, k / kStep);
    if (shrinking.touched(factor, links)) k = found;
  }
  return {factor, shrinking.positions(factor)};
}

}  // namespace gambeson
