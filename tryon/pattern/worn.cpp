/// Detail of armour.hpp: garments under the one that is drafted.
#include <algorithm>
#include <cmath>

#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

/// Names of a shirt's strips of sleeves (ShirtPatch).
bool isSleeve(const Garment& g, std::size_t patch) {
  return patch < g.patch_names.size() && g.patch_names[patch].starts_with("sleeve_");
}
bool isLeftSleeve(const Garment& g, std::size_t patch) {
  return isSleeve(g, patch) && g.patch_names[patch].ends_with("_left");
}

/// Those patches of a garment that `takes` says, as it starts, as triangles between points of each cell.
template <class F>
TriangleMesh meshOf(const Garment& g, const F& takes) {
  constexpr int per_cell = 3;
  TriangleMesh mesh;
  for (std::size_t n = 0; n < g.patches.size(); ++n) {
    if (!takes(g, n)) continue;
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

namespace {

template <class F>
bool wrapOf(std::span<const Worn> under, const Placement& placed, const F& takes, double layer_m, double gap_m,
            double from, double to, int heights, Wrap& out) {
  bool any = false;
  for (const Worn& w : under) {
    const TriangleMesh part = meshOf(*w.garment, takes);
    if (part.triangles.empty()) continue;
    const Shape mesh = part;
    std::vector<std::vector<Vec2>> cross_sections;
    for (int k = 0; k < heights; ++k)
      cross_sections.push_back(crossSection(mesh, placed, from + (to - from) * k / (heights - 1)));
    const Wrap wrap = Wrap::plain(cross_sections, from, to).offset(0.5 * (w.layer_m + layer_m) + gap_m);
    out = any ? out.with(wrap) : wrap;
    any = true;
  }
  return any;
}

}  // namespace

bool wrapOf(std::span<const Worn> under, double layer_m, double gap_m, double from, double to, int heights, Wrap& out) {
  return wrapOf(
      under, Placement{}, [](const Garment& g, std::size_t n) { return !isSleeve(g, n); }, layer_m, gap_m, from, to,
      heights, out);
}

bool sleeveWrapOf(std::span<const Worn> under, const Pose& X_FW, double layer_m, double gap_m, double from, double to,
                  int heights, Wrap& out) {
  return wrapOf(under, {X_FW.rotation, X_FW.origin}, isLeftSleeve, layer_m, gap_m, from, to, heights, out);
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
