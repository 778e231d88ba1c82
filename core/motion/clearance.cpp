#include "core/motion/clearance.hpp"

#include <optional>
#include <vector>

#include "core/contact/ellipsoid.hpp"
#include "core/math/parallel.hpp"
#include "core/motion/stand_out.hpp"

namespace gambeson {
namespace {

BodyContactView viewOf(const Contact& c) { return {c.sample, c.obstacle, c.normal, c.gap_m, c.local}; }

}  // namespace

/// That leaves room for the edges of bodies made of triangles too, which samples on their faces straddle. Where bodies
/// bend between the samples the cloth clears them by a part of the layer, which is for what contacts lag by: all of it
/// would lift cloth off all that is round.
void findClearances(const Model& m, StepWork& w) {
  const int n = static_cast<int>(w.near.size());
  std::vector<int>& first = w.near_first;
  first.assign(m.surface.size() + 1, 0);
  for (const Contact& c : w.near) ++first[c.sample + 1];
  for (int s = 0; s < m.surface.size(); ++s) first[s + 1] += first[s];
  std::vector<std::optional<EllipsoidMetric>> metric;
  for (const Obstacle& o : m.obstacles) {
    const auto* e = std::get_if<Ellipsoid>(&o.shape);
    metric.push_back(e ? std::optional(ellipsoidMetric(*e)) : std::nullopt);
  }
  const BulgesView bulges = gambeson::viewOf(m.bulges);
  const ContactMeshView mesh = gambeson::viewOf(m.collisions.mesh);
  const auto near = [&](int k) { return viewOf(w.near[k]); };
  forAll(Each::sum, n, [&](int k) {
    Contact& c = w.near[k];
    const std::optional<EllipsoidMetric>& of = metric[c.obstacle];
    c.clearance_m = clearanceOf(viewOf(c), m.layer_m[c.sample], of ? &*of : nullptr,
                                w.stage.start.obstacles[c.obstacle], bulges, mesh, near, first.data(), w.x0.data());
  });
}

}  // namespace gambeson
