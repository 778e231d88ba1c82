#include "core/contact/pairs.hpp"

#include <algorithm>
#include <utility>

namespace gambeson {

PairCollector::PairCollector(const ContactMesh& mesh) : owned_(mesh.triangles.size(), 0) {
  std::vector<char> vertex_taken(mesh.vertex_count, 0), edge_taken(mesh.edges.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (!std::exchange(vertex_taken[mesh.triangles[t][k]], 1)) owned_[t] |= 1 << k;
      if (!std::exchange(edge_taken[mesh.face_edges[t][k]], 1)) owned_[t] |= 8 << k;
    }
}

void PairCollector::collect(const ContactMesh& mesh, const ContactTree& tree, std::span<const Vec3> x,
                            std::span<const double> slack, double margin_m, double least, CandidatePairs& out) const {
  const auto around = [&](int v) { return slack.empty() ? Box{x[v], x[v]} : Box{x[v], x[v]}.grown(slack[v]); };
  const auto aroundBoth = [&](int v, int w) {
    Box b = around(v);
    b.add(around(w));
    return b;
  };
  out.points.clear();
  out.edges.clear();
  const auto pointsAgainst = [&](int a, int b) {
    for (int k = 0; k < 3; ++k) {
      if (!(owned_[a] & (1 << k))) continue;
      const int v = mesh.triangles[a][k];
      const auto& [p, q, r] = mesh.triangles[b];
      if (v == p || v == q || v == r) continue;
      if (overlap(around(v).grown(margin_m), tree.box(b))) out.points.push_back({v, b});
    }
  };
  tree.pairs(margin_m, least, [&](int a, int b) {
    pointsAgainst(a, b);
    pointsAgainst(b, a);
    for (int k = 0; k < 3; ++k) {
      if (!(owned_[a] & (8 << k))) continue;
      const int e = mesh.face_edges[a][k];
      const auto [v, w] = mesh.edges[e];
      const Box box = aroundBoth(v, w).grown(margin_m);
      for (int l = 0; l < 3; ++l) {
        if (!(owned_[b] & (8 << l))) continue;
        const int f = mesh.face_edges[b][l];
        const auto [y, z] = mesh.edges[f];
        if (v == y || v == z || w == y || w == z) continue;
        if (overlap(box, aroundBoth(y, z))) out.edges.push_back({std::min(e, f), std::max(e, f)});
      }
    }
  });
}

}  // namespace gambeson
