#include "core/contact/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/segment_pair.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {
namespace {

/// Two primitives by their corners: each corner of the first stays on its side of a direction from the second.
template <std::size_t A, std::size_t B>
Apart apart(const ListedMotion& m, const std::array<int, A>& a, const std::array<int, B>& b, const Vec3& way) {
  const double length = norm(way);
  if (!(length > 0)) return {0, std::numeric_limits<float>::infinity()};
  const Vec3 n = way / length;
  double gap = std::numeric_limits<double>::infinity(), closing = -gap;
  std::array<double, B> at, speed;
  for (std::size_t k = 0; k < B; ++k) at[k] = dot(n, m.x[b[k]] - m.x[a[0]]), speed[k] = dot(n, m.velocity(b[k]));
  for (int i : a) {
    const double x = dot(n, m.x[i] - m.x[a[0]]), v = dot(n, m.velocity(i));
    for (std::size_t k = 0; k < B; ++k) gap = std::min(gap, x - at[k]), closing = std::max(closing, speed[k] - v);
  }
  // Rounded to the safe side, of a float too.
  return {static_cast<float>(gap - 1e-6 * std::abs(gap) - 1e-9),
          static_cast<float>(closing + 1e-6 * std::abs(closing))};
}

/// A lower bound of how far all corners of b stay on one side of the plane of a until the horizon, slack apart.
double beyondPlane(const ListedMotion& m, const std::array<int, 3>& a, const std::array<int, 3>& b) {
  const Vec3 n = cross(m.x[a[1]] - m.x[a[0]], m.x[a[2]] - m.x[a[0]]);
  const double size = norm(n);
  if (!(size > 0)) return 0;
  const Vec3 at{dot(n, m.x[b[0]] - m.x[a[0]]), dot(n, m.x[b[1]] - m.x[a[0]]), dot(n, m.x[b[2]] - m.x[a[0]])};
  const double above = std::min({at.x, at.y, at.z}), below = -std::max({at.x, at.y, at.z});
  if (above <= 0 && below <= 0) return 0;
  const Vec3 s{dot(n, m.velocity(a[0])), dot(n, m.velocity(a[1])), dot(n, m.velocity(a[2]))};
  const Vec3 t{dot(n, m.velocity(b[0])), dot(n, m.velocity(b[1])), dot(n, m.velocity(b[2]))};
  const Vec3 then = at + m.horizon_s * t;
  const double last = above > 0 ? std::min({then.x, then.y, then.z}) - m.horizon_s * std::max({s.x, s.y, s.z})
                                : m.horizon_s * std::min({s.x, s.y, s.z}) - std::max({then.x, then.y, then.z});
  return std::min(std::max(above, below), last) / size * (1 - 1e-6) - 1e-9;
}

}  // namespace

PairCollector::PairCollector(const ContactMesh& mesh, const BluntFeatures& blunt) : owned_(mesh.triangles.size(), 0) {
  std::vector<char> vertex_taken(mesh.vertex_count, 0), edge_taken(mesh.edges.size(), 0);
  blunt_.resize(mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int vertex = mesh.triangles[t][k], edge = mesh.face_edges[t][k];
      if (!std::exchange(vertex_taken[vertex], 1)) owned_[t] |= 1 << k;
      if (!std::exchange(edge_taken[edge], 1)) owned_[t] |= 8 << k;
      if (!blunt.vertex.empty() && blunt.vertex[vertex]) blunt_[t] |= 1 << k;
      if (!blunt.edge.empty() && blunt.edge[edge]) blunt_[t] |= 8 << k;
    }
}

void PairCollector::collect(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion,
                            const PairRules& rules, CandidatePairs& out) const {
  const std::span<const Vec3> x = motion.x;
  const double wide = rules.margin_m, narrow = rules.blunt_margin_m;
  const float wide_reach = roundUp(wide), narrow_reach = roundUp(narrow);
  out.points.clear();
  out.edges.clear();
  out.vertex_box.resize(mesh.vertex_count);
  for (int i = 0; i < mesh.vertex_count; ++i) out.vertex_box[i] = MovingBox(motion, i);
  out.edge_box.resize(mesh.edges.size());
  out.edge_slack.resize(mesh.edges.size());
  for (std::size_t e = 0; e < mesh.edges.size(); ++e) {
    const auto& [v, w] = mesh.edges[e];
    out.edge_box[e] = out.vertex_box[v];
    out.edge_box[e].add(out.vertex_box[w]);
    out.edge_slack[e] = std::max(motion.slack(v), motion.slack(w));
  }
  out.triangle_slack.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [u, v, w] = mesh.triangles[t];
    out.triangle_slack[t] = std::max({motion.slack(u), motion.slack(v), motion.slack(w)});
  }
  // `beyond`: that far apart a and b are, but for what they may leave their paths by.
  const auto pointsAgainst = [&](int a, int b, double beyond) {
    for (int k = 0; k < 3; ++k) {
      if (!(owned_[a] & (1 << k))) continue;
      const bool blunt = blunt_[a] & (1 << k);
      const double margin = (blunt ? narrow : wide) + motion.slack(mesh.triangles[a][k]) + out.triangle_slack[b];
      if (beyond > margin) continue;
      const std::array<int, 1> v{mesh.triangles[a][k]};
      const std::array<int, 3>& t = mesh.triangles[b];
      if (v[0] == t[0] || v[0] == t[1] || v[0] == t[2]) continue;
      if (!mayMeet(out.vertex_box[v[0]], tree.box(b), blunt ? narrow_reach : wide_reach)) continue;
      const Vec3 way = x[v[0]] - closestOnTriangle({x[t[0]], x[t[1]], x[t[2]]}, x[v[0]]).position;
      const Apart gap = apart(motion, v, t, way);
      if (!(gap.within(0, motion.horizon_s) > margin)) out.points.push_back({v[0], b, gap});
    }
  };
  tree.pairs(rules, [&](int a, int b) {
    const double slack = out.triangle_slack[a] + out.triangle_slack[b];
    double beyond = beyondPlane(motion, mesh.triangles[a], mesh.triangles[b]);
    if (beyond > wide + slack) return;
    beyond = std::max(beyond, beyondPlane(motion, mesh.triangles[b], mesh.triangles[a]));
    if (beyond > wide + slack) return;
    pointsAgainst(a, b, beyond);
    pointsAgainst(b, a, beyond);
    for (int k = 0; k < 3; ++k) {
      if (!(owned_[a] & (8 << k))) continue;
      const int e = mesh.face_edges[a][k];
      const std::array<int, 2>& v = mesh.edges[e];
      const MovingBox& box = out.edge_box[e];
      for (int l = 0; l < 3; ++l) {
        if (!(owned_[b] & (8 << l))) continue;
        const int f = mesh.face_edges[b][l];
        const bool blunt = (blunt_[a] & (8 << k)) || (blunt_[b] & (8 << l));
        const double margin = (blunt ? narrow : wide) + out.edge_slack[e] + out.edge_slack[f];
        if (beyond > margin) continue;
        const std::array<int, 2>& y = mesh.edges[f];
        if (v[0] == y[0] || v[0] == y[1] || v[1] == y[0] || v[1] == y[1]) continue;
        if (!mayMeet(box, out.edge_box[f], blunt ? narrow_reach : wide_reach)) continue;
        const SegmentPair near = nearestOnSegments(x[v[0]], x[v[1]], x[y[0]], x[y[1]]);
        const Vec3 way = x[v[0]] + near.s * (x[v[1]] - x[v[0]]) - x[y[0]] - near.t * (x[y[1]] - x[y[0]]);
        const Apart gap = apart(motion, v, y, way);
        if (!(gap.within(0, motion.horizon_s) > margin)) out.edges.push_back({std::min(e, f), std::max(e, f), gap});
      }
    }
  });
  std::sort(out.points.begin(), out.points.end());
}

}  // namespace gambeson
