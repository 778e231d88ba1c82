#pragma once
/// How far from a body a sample stays, so that the cloth beside it stays out too: one contact at a time. Detail of
/// core/motion/clearance.hpp, which states the law, for host and device.

#include <algorithm>

#include "core/cloth/bulge_view.hpp"
#include "core/contact/contact_mesh_view.hpp"
#include "core/contact/ellipsoid_foot.hpp"
#include "core/contact/reach.hpp"

namespace gambeson {

/// What counts of a contact of a sample with a body.
struct BodyContactView {
  int sample, obstacle;
  Vec3 normal;
  double gap_m;
  Vec3 local;
};

/// By how much the middles of the cloth's edges at a sample that touches an ellipsoid are nearer to it than the sample,
/// where they are nearer than the mean of both ends at most by that; 0 where none is [m]. About h^2/8 of the curvature,
/// sum_i (d_i/e_i)^2/(8 |g|) with g_i = p_i/e_i^2 at the foot p; asked for exactly where that is half of `least_m`.
GAMBESON_HD inline double standOut(const EllipsoidMetric& metric, const Placement& X, const BodyContactView& c,
                                   double least_m, const ContactMeshView& mesh, const Vec3* x) {
  const auto local = [&](const Vec3& x_W) { return transposeTimes(X.rotation, x_W - X.origin) / X.scale; };
  const Vec3 at = local(x[c.sample]);
  const double slope =
      norm({c.local.x * metric.inverse2.x, c.local.y * metric.inverse2.y, c.local.z * metric.inverse2.z});
  const auto gap = [&](const Vec3& p) { return X.scale * closestOnEllipsoid(metric, p).distance_m; };
  double most = 0;
  for (int edge : mesh.vertex_edges[c.sample]) {
    const auto& [a, b] = mesh.edges[edge];
    const Vec3 end = local(x[a == c.sample ? b : a]), d = end - at;
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
/// gaps tell, within three quarters of it: few do. Contacts of sample s are near(j), first[s] <= j < first[s + 1].
template <class Near>
GAMBESON_HD double standOut(const BulgesView& bulges, const BodyContactView& c, const Near& near, const int* first,
                            const Vec3* x, double more_m) {
  constexpr double kParallel = 1 - 1e-9;  // of normals: Bulges::beside tells the same of one plane
  constexpr double kRounding_m = 1e-9;    // far more than it is
  double most = 0;
  for (int k = bulges.of_sample.offsets[c.sample]; k < bulges.of_sample.offsets[c.sample + 1]; ++k) {
    const int row = bulges.of_sample.columns[k];
    const auto& [a, b] = bulges.ends[row];
    const int other = a == c.sample ? b : a;
    const Vec3 way = x[other] - x[c.sample];
    const double nearer = -dot(way, c.normal);
    if (!(0.75 * nearer > more_m - kRounding_m)) continue;
    for (int j = first[other]; j < first[other + 1]; ++j) {
      const BodyContactView d = near(j);
      if (d.obstacle != c.obstacle || dot(c.normal, d.normal) > kParallel) continue;
      if (!(d.gap_m < contactReach(kLargestClearance_m))) continue;
      if (!(0.75 * (nearer + std::min(0.0, d.gap_m - c.gap_m)) > more_m - kRounding_m)) continue;
      const Vec3 bulge = bulges.at(row, x);
      for (int q = 1; q <= 3; ++q) {
        const double t = 0.25 * q;
        const Vec3 from = t * way + (4 * t * (1 - t)) * bulge;
        const double gap = std::max(c.gap_m + dot(from, c.normal), d.gap_m + dot(from - way, d.normal));
        most = std::max(most, std::min(c.gap_m, c.gap_m + t * (d.gap_m - c.gap_m)) - gap);
      }
    }
  }
  return most;
}

/// `metric`: of an ellipsoid, null for a body of triangles.
template <class Near>
GAMBESON_HD double clearanceOf(const BodyContactView& c, double layer_m, const EllipsoidMetric* metric,
                               const Placement& X, const BulgesView& bulges, const ContactMeshView& mesh,
                               const Near& near, const int* first, const Vec3* x) {
  constexpr double kLag = 0.1, kLagAtSkin = 0.3;
  if (layer_m >= kLargestClearance_m) return kLargestClearance_m;
  double asked = 0;
  // Ellipsoids are asked for along the edges of the triangles; diagonals across them take in the way along the body.
  if (metric) {
    const double out = standOut(*metric, X, c, layer_m, mesh, x);
    asked = bulges.beside(c.sample, -c.normal, x, false) + std::max(layer_m, out + kLag * layer_m);
  } else {
    const double out = standOut(bulges, c, near, first, x, (1 - kLagAtSkin) * layer_m);
    asked = std::max(bulges.beside(c.sample, -c.normal, x) + layer_m, out + kLagAtSkin * layer_m);
  }
  return std::min(double{kLargestClearance_m}, asked);
}

}  // namespace gambeson
