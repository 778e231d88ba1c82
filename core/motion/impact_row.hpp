#pragma once
/// The row of an impact: what keeps a pair of primitives apart whose paths meet, and what a row of an impact asks for.
/// Detail of core/motion/collisions.hpp and step_rows.hpp, a pair at a time, for host and device.

#include <algorithm>
#include <array>

#include "core/contact/impact_query.hpp"
#include "core/contact/proximity.hpp"

namespace gambeson {

/// Pairs stay farther apart than this, or than a tenth of their distance at the start.
constexpr double kImpactSeparation_m = 1e-6;

/// The separation of a pair that starts so far apart.
GAMBESON_HD inline double separationFrom(double start_m) {
  const double most = kImpactSeparation_m;
  return std::min(most, 0.1 * start_m);
}

/// A vertex of a body, as a pair touches it.
struct BodyVertex {
  int obstacle = 0;
  int number = 0;  ///< of the vertex in its obstacle
  bool deforms = false;
  Vec3 at;  ///< in the obstacle's frame; of one that deforms, in the world at the start
};

/// A pair of which it is known when and where it meets.
struct ImpactPair {
  bool edges = false;
  int a = 0, b = 0;  ///< vertex and triangle, or two edges
  std::array<int, 4> vertex{};
  FourPoints x0, x1;
  double time = 0, u = 0, v = 0;  ///< ImpactTime's
};

/// Samples with weights of one side positive, the other negative; the body's side stands in `touched` and `local`.
struct ImpactRow {
  Vec3 normal;
  double gap_m = 0;  ///< at the start, along the normal
  Vec3 body_velocity;
  ContactKind kind = ContactKind::sample_on_cloth;
  int sample = 0, obstacle = -1, feature = 0;
  int count = 0;
  int stencil[4] = {};
  double weight[4] = {};
  Vec3 local;
  int touched_count = 0;
  int touched[3] = {};
  double touched_weight[3] = {};
};

/// Where a pair meets: positions and weights there, the normal from side b to side a as they stood at the start, and
/// the gap that they had along it.
struct ImpactPlace {
  std::array<double, 4> weight;
  std::array<Vec3, 4> x;
  Vec3 normal;
  double gap_m = 0;
};

GAMBESON_HD inline ImpactPlace placeOf(const ImpactPair& pair) {
  const double u = pair.u, v = pair.v;
  const FourPoints &x0 = pair.x0, &x1 = pair.x1;
  ImpactPlace at;
  at.weight = pair.edges ? std::array<double, 4>{1 - u, u, v - 1, -v} : std::array<double, 4>{1, u + v - 1, -u, -v};
  std::array<Vec3, 4>& x = at.x;
  Vec3 start{};
  for (int k = 0; k < 4; ++k) {
    x[k] = x0[k] + pair.time * (x1[k] - x0[k]);
    start += at.weight[k] * x0[k];
  }
  Vec3 n = pair.edges ? cross(x[1] - x[0], x[3] - x[2]) : cross(x[2] - x[1], x[3] - x[1]);
  const double size = norm(n), length = norm(start);
  // Parallel edges and triangles without area have no normal; then the way between them at the start.
  const double scale = pair.edges ? norm(x[1] - x[0]) * norm(x[3] - x[2]) : norm(x[2] - x[1]) * norm(x[3] - x[1]);
  n = size > 1e-6 * scale ? n / size : length > 0 ? start / length : Vec3{0, 0, 1};
  if (dot(n, start) < 0) n = -n;
  at.normal = n;
  at.gap_m = dot(n, start);
  return at;
}

/// The row that keeps a pair apart: weights at the hit, normal there, from side b to side a as they stood at the start.
/// bodies(v, vertex) tells whether vertex v is a body's, and which.
template <class Bodies>
GAMBESON_HD ImpactRow impactRow(const ImpactPair& pair, double dt_s, const Bodies& bodies) {
  const FourPoints &x0 = pair.x0, &x1 = pair.x1;
  const ImpactPlace at = placeOf(pair);
  const std::array<double, 4>& weight = at.weight;
  ImpactRow row;
  row.normal = at.normal;
  row.gap_m = at.gap_m;
  row.kind = pair.edges ? ContactKind::edge_on_edge : ContactKind::sample_on_cloth;
  row.sample = pair.a;
  row.feature = pair.b;
  Vec3 touched{};
  double body_weight = 0;
  std::array<BodyVertex, 4> body;
  std::array<bool, 4> of_body{};
  for (int k = 0; k < 4; ++k) {
    of_body[k] = bodies(pair.vertex[k], body[k]);
    if (!of_body[k]) {
      if (weight[k] != 0) {
        row.stencil[row.count] = pair.vertex[k];
        row.weight[row.count++] = weight[k];
      }
      continue;
    }
    row.obstacle = body[k].obstacle;
    row.kind = pair.edges ? ContactKind::edge_on_body : ContactKind::sample_on_body;
    row.body_velocity -= (weight[k] / dt_s) * (x1[k] - x0[k]);
    touched += weight[k] * body[k].at;
    body_weight += weight[k];
  }
  if (body_weight != 0) {
    row.local = touched / body_weight;
    for (int k = 0; k < 4; ++k) {
      const double share = weight[k] / body_weight;
      if (!of_body[k] || !body[k].deforms || share == 0) continue;
      row.touched[row.touched_count] = body[k].number;
      row.touched_weight[row.touched_count++] = share;
    }
    row.sample = row.stencil[0];
    if (body_weight > 0) {
      // The body is the first side: written from the cloth's.
      for (int k = 0; k < row.count; ++k) row.weight[k] = -row.weight[k];
      row.body_velocity = -row.body_velocity;
      row.normal = -row.normal;
    }
  }
  return row;
}

/// What the row of an impact asks for [m/s]: what eq. 3.23 leaves of the gap, min(k delta, g), and half of k delta more
/// each round: bodies are curved, and pairs turn. As a speed that is delta/(2 tau) at most, however short the step:
/// where steps are cut, what is asked for must not grow. `restored_m`: k delta, k = 1 - exp(-dt/tau).
GAMBESON_HD inline double impactTarget(double gap_m, double restored_m, int round, double dt_s) {
  return (std::min(restored_m, std::max(gap_m, 0.0)) - gap_m + 0.5 * (round - 1) * restored_m) / dt_s;
}

}  // namespace gambeson
