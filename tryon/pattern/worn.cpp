/// Detail of armour.hpp: garments under the one that is drafted.
#include <algorithm>
#include <cmath>

#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

/// A garment as it starts, as triangles between points of each cell.
TriangleMesh meshOf(const Garment& g) {
  constexpr int per_cell = 3;
  TriangleMesh mesh;
  for (std::size_t n = 0; n < g.patches.size(); ++n) {
    NurbsPatch p = g.patches[n];
    if (!g.placed.empty() && !g.placed[n].empty()) p.points = g.placed[n];
    const auto lines = [](const KnotVector& k) {
      const std::vector<double> ends = breakpoints(k);
      std::vector<double> out;
      for (std::size_t c = 0; c + 1 < ends.size(); ++c)
        for (int i = 0; i < per_cell; ++i) out.push_back(ends[c] + (ends[c + 1] - ends[c]) * i / per_cell);
      out.push_back(ends.back());
      return out;
    };
    const auto us = lines(p.u), vs = lines(p.v);
    const int first = static_cast<int>(mesh.vertices.size()), nu = static_cast<int>(us.size());
    for (const double v : vs)
      for (const double u : us) mesh.vertices.push_back(surfaceDerivatives(p, u, v)[0]);
    for (int j = 0; j + 1 < static_cast<int>(vs.size()); ++j)
      for (int i = 0; i + 1 < nu; ++i) {
        const int a = first + i + nu * j;
        mesh.triangles.push_back({a, a + 1, a + 1 + nu});
        mesh.triangles.push_back({a, a + 1 + nu, a + nu});
      }
  }
  return mesh;
}

}  // namespace

bool wrapOf(std::span<const Worn> under, double layer_m, double gap_m, double from, double to, int heights, Wrap& out) {
  bool any = false;
  for (const Worn& w : under) {
    const Shape mesh = meshOf(*w.garment);
    std::vector<std::vector<Vec2>> cross_sections;
    for (int k = 0; k < heights; ++k)
      cross_sections.push_back(crossSection(mesh, Placement{}, from + (to - from) * k / (heights - 1)));
    const Wrap wrap = Wrap::plain(cross_sections, from, to).offset(0.5 * (w.layer_m + layer_m) + gap_m);
    out = any ? out.with(wrap) : wrap;
    any = true;
  }
  return any;
}

double waistOf(std::span<const Worn> under, double otherwise) {
  double z = otherwise;
  for (const Worn& w : under)
    for (const NamedEdge& e : w.garment->edges)
      if (e.name == "waist") {
        z = -HUGE_VAL;
        for (const PatchEdge& edge : e.edges) {
          const NurbsPatch& p = w.garment->patches[edge.patch];
          for (const int i : edgeRow(p, edge)) z = std::max(z, p.points[i].z);
        }
      }
  return z;
}

}  // namespace gambeson
