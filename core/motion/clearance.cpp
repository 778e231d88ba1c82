#include "core/motion/clearance.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "core/contact/ellipsoid.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// By how much the middles of the cloth's edges at a sample that touches an ellipsoid are nearer to it than the sample,
/// where they are nearer than the mean of both ends at most by that; 0 where none is [m]. About h^2/8 of the curvature,
/// sum_i (d_i/e_i)^2/(8 |g|) with g_i = p_i/e_i^2 at the foot p; asked for exactly where that is half of `least_m`.
double standOut(const Ellipsoid& shape, const Placement& X, const Contact& c, double least_m, const ContactMesh& mesh,
                std::span<const Vec3> x) {
  const EllipsoidMetric metric = ellipsoidMetric(shape);
  const Vec3 at = toLocal(X, x[c.sample]);
  const double slope =
      norm({c.local.x * metric.inverse2.x, c.local.y * metric.inverse2.y, c.local.z * metric.inverse2.z});
  const auto gap = [&](const Vec3& p) { return X.scale * closestOnEllipsoid(metric, p).distance_m; };
  double most = 0;
  for (int edge : mesh.vertex_edges[c.sample]) {
    const auto [a, b] = mesh.edges[edge];
    const Vec3 end = toLocal(X, x[a == c.sample ? b : a]), d = end - at;
    const double about = norm2({d.x * metric.inverse.x, d.y * metric.inverse.y, d.z * metric.inverse.z}) / (8 * slope);
    if (!(X.scale * about > 0.5 * least_m)) continue;
    most = std::max(most, std::min(c.gap_m, 0.5 * (c.gap_m + gap(end))) - gap(0.5 * (at + end)));
  }
  return most;
}

/// The same at a body of triangles, which bends between the samples: it lies below the tangent planes at the feet of
/// both ends, so that the surface between these, x(t) = (1 - t) a + t b + 4 t (1 - t) bulge, is
///     g(t) >= max((x - p_a).n_a, (x - p_b).n_b)
/// away from it, where it is convex there. Looked at in the quarters of each edge and diagonal. Contacts farther than
/// all clearances are left out: which of them are known depends on the lists of candidates. Only what is `more_m` more
/// than Bulges::beside counts. That takes a way which leads so much nearer to the tangent plane at the sample than the
/// gaps tell, within three quarters of it: few do.
double standOut(const Bulges& bulges, const Contact& c, std::span<const Contact> near, std::span<const int> first,
                std::span<const Vec3> x, double more_m) {
  constexpr double kParallel = 1 - 1e-9;  // of normals: Bulges::beside tells the same of one plane
  constexpr double kRounding_m = 1e-9;    // far more than it is
  double most = 0;
  for (int k = bulges.of_sample.offsets[c.sample]; k < bulges.of_sample.offsets[c.sample + 1]; ++k) {
    const int row = bulges.of_sample.columns[k];
    const auto [a, b] = bulges.ends[row];
    const int other = a == c.sample ? b : a;
    const Vec3 way = x[other] - x[c.sample];
    const double nearer = -dot(way, c.normal);
    if (!(0.75 * nearer > more_m - kRounding_m)) continue;
    for (int j = first[other]; j < first[other + 1]; ++j) {
      const Contact& d = near[j];
      if (d.obstacle != c.obstacle || dot(c.normal, d.normal) > kParallel) continue;
      if (!(d.gap_m < contactReach(kLargestClearance_m))) continue;
      if (!(0.75 * (nearer + std::min(0.0, d.gap_m - c.gap_m)) > more_m - kRounding_m)) continue;
      const Vec3 bulge = bulges.at(row, x);
      for (const double t : {0.25, 0.5, 0.75}) {
        const Vec3 from = t * way + (4 * t * (1 - t)) * bulge;
        const double gap = std::max(c.gap_m + dot(from, c.normal), d.gap_m + dot(from - way, d.normal));
        most = std::max(most, std::min(c.gap_m, c.gap_m + t * (d.gap_m - c.gap_m)) - gap);
      }
    }
  }
  return most;
}

}  // namespace

/// That leaves room for the edges of bodies made of triangles too, which samples on their faces straddle. Where bodies
/// bend between the samples the cloth clears them by a part of the layer, which is for what contacts lag by: all of it
/// would lift cloth off all that is round.
void findClearances(const Model& m, StepWork& w) {
  constexpr double kLag = 0.1, kLagAtSkin = 0.3;
  const int n = static_cast<int>(w.near.size());
  std::vector<int>& first = w.near_first;
  first.assign(m.surface.size() + 1, 0);
  for (const Contact& c : w.near) ++first[c.sample + 1];
  for (int s = 0; s < m.surface.size(); ++s) first[s + 1] += first[s];
  forAll(Each::sum, n, [&](int k) {
    Contact& c = w.near[k];
    const double layer = m.layer_m[c.sample];
    c.clearance_m = kLargestClearance_m;
    if (layer >= kLargestClearance_m) return;
    double asked = 0;
    // Ellipsoids are asked for along the edges of the triangles; diagonals across them take in the way along the body.
    if (const auto* e = std::get_if<Ellipsoid>(&m.obstacles[c.obstacle].shape)) {
      const double out = standOut(*e, w.stage.start.obstacles[c.obstacle], c, layer, m.collisions.mesh, w.x0);
      asked = m.bulges.beside(c.sample, -c.normal, w.x0, false) + std::max(layer, out + kLag * layer);
    } else {
      const double out = standOut(m.bulges, c, w.near, first, w.x0, (1 - kLagAtSkin) * layer);
      asked = std::max(m.bulges.beside(c.sample, -c.normal, w.x0) + layer, out + kLagAtSkin * layer);
    }
    c.clearance_m = std::min(kLargestClearance_m, asked);
  });
}

}  // namespace gambeson
