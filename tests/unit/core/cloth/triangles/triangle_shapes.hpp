#pragma once
/// Meshes of triangles for the tests of core/cloth/triangles.

#include <cmath>
#include <random>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson::shapes {

/// A flat rectangle in the x-y plane, `nu` x `nv` cells, all interior vertices moved by up to `jitter` of a cell.
inline MeshDraft flatTriangles(int nu, int nv, double width, double height, const Fabric& fabric,
                                     MeshKind kind = MeshKind::single, double jitter = 0, unsigned seed = 1) {
  const Garment draft = garmentOf({patchOf(uniformKnots(2, nu), uniformKnots(2, nv),
                                           [&](double a, double b) {
                                             return Vec3{width * a, height * b, 0};
                                           })},
                                  {}, fabric);
  MeshDraft g = meshDraft(draft, kind);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-jitter, jitter);
  for (Vec3& x : g.mesh.vertices)
    if (x.x > 1e-9 && x.x < width - 1e-9 && x.y > 1e-9 && x.y < height - 1e-9)
      x += Vec3{noise(random) * width / nu, noise(random) * height / nv, 0};
  // Threads along x and y, whatever the triangle.
  for (std::size_t t = 0; t < g.mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = g.mesh.vertices[static_cast<std::size_t>(g.mesh.triangles[t][k])];
      g.mesh.uv[t][k] = {x.x, x.y};
    }
  return g;
}

inline TriangleCloth clothOf(MeshDraft g) {
  std::vector<MeshDraft> all;
  all.push_back(std::move(g));
  return TriangleCloth(std::move(all));
}

}  // namespace gambeson::shapes
