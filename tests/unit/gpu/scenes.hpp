#pragma once
/// Small scenes, and their pairs and hits by brute force.

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/contact/certified_impact.hpp"
#include "gpu/finding/float_box.hpp"
#include "gpu/scenes/stage_facts.hpp"

namespace gambeson::gpu {

/// Triangles anywhere, many with a corner in common, some without area, some at rest; coordinates of few bits, so that
/// boxes touch.
inline Scene triangleSoup(int faces, unsigned seed) {
  std::mt19937 rng(seed);
  const auto below = [&](int n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  Scene scene;
  scene.name = "soup";
  scene.mesh.vertices = 2 * faces;
  for (int i = 0; i < scene.mesh.vertices; ++i) {
    const auto point = [&] { return Vec3{below(33) / 16.0, below(33) / 16.0, below(33) / 16.0}; };
    scene.x0.push_back(point());
    scene.x1.push_back(below(4) == 0 ? scene.x0.back() : scene.x0.back() + 0.25 * (point() - Vec3{1, 1, 1}));
  }
  for (int f = 0; f < faces; ++f) {
    const int a = below(scene.mesh.vertices - 4);
    scene.mesh.faces.push_back({a, a + 1 + below(2), a + 3});
    if (f % 7 == 0) scene.x0[a + 3] = scene.x0[a], scene.x1[a + 3] = scene.x1[a];
  }
  scene.mesh.edges = edgesOf(scene.mesh.faces);
  scene.options.separation_m = 1e-3;
  scene.options.tolerance_m = 1e-9;
  return scene;
}

inline std::vector<Scene> smallScenes() {
  std::vector<Scene> scenes{triangleSoup(60, 1), triangleSoup(300, 2), flyingBalls(3), wavySheets(3, 9)};
  scenes.push_back(fallingSheets(12));
  // So few that there is hardly a tree.
  Scene one;
  one.name = "one triangle and a point";
  one.x0 = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 0.5}};
  one.x1 = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -0.5}};
  one.mesh = {4, {{0, 1, 2}}, {{0, 3}}};
  scenes.push_back(one);
  Scene two = one;
  two.name = "two edges, no triangle";
  two.mesh = {4, {}, {{0, 1}, {2, 3}}};
  scenes.push_back(two);
  return scenes;
}

inline FourPoints pointsOf(const Mesh& mesh, const std::vector<Vec3>& x, PairKind kind, const Pair& pair) {
  if (kind == PairKind::edgeEdge) {
    const auto &a = mesh.edges[pair.first], &b = mesh.edges[pair.second];
    return {x[a[0]], x[a[1]], x[b[0]], x[b[1]]};
  }
  const auto& f = mesh.faces[pair.second];
  return {x[pair.first], x[f[0]], x[f[1]], x[f[2]]};
}

/// Sorted: pairs of primitives without a common vertex whose boxes meet, each against each.
inline std::vector<Pair> pairsByBruteForce(const Scene& scene, PairKind kind) {
  const float margin = roundedUp(std::max(scene.options.margin_m, 0.5 * scene.options.separation_m), 0);
  const auto boxOfAll = [&](const auto& corners) {
    FloatBox box = emptyBox();
    for (const int v : corners) box = joined(box, boxOf({scene.x0[v], scene.x1[v]}, margin));
    return box;
  };
  const auto share = [](const auto& a, const auto& b) {
    for (const int i : a)
      for (const int j : b)
        if (i == j) return true;
    return false;
  };
  std::vector<Pair> pairs;
  const auto tryPair = [&](int i, const auto& a, int j, const auto& b) {
    if (!share(a, b) && meet(boxOfAll(a), boxOfAll(b))) pairs.push_back({i, j});
  };
  const int vertices = scene.mesh.vertices;
  const auto& faces = scene.mesh.faces;
  const auto& edges = scene.mesh.edges;
  if (kind == PairKind::pointTriangle)
    for (int v = 0; v < vertices; ++v)
      for (int f = 0; f < static_cast<int>(faces.size()); ++f) tryPair(v, std::array{v}, f, faces[f]);
  else
    for (int a = 0; a < static_cast<int>(edges.size()); ++a)
      for (int b = a + 1; b < static_cast<int>(edges.size()); ++b) tryPair(a, edges[a], b, edges[b]);
  return pairs;
}

/// What core says of pairs, in their order.
inline std::vector<Hit> hitsByCore(const Scene& scene, PairKind kind, const std::vector<Pair>& pairs) {
  std::vector<Hit> hits;
  for (const Pair& pair : pairs) {
    const auto hit = (kind == PairKind::edgeEdge ? edgeEdgeImpact : pointTriangleImpact)(
        pointsOf(scene.mesh, scene.x0, kind, pair), pointsOf(scene.mesh, scene.x1, kind, pair),
        scene.options.separation_m, scene.options.tolerance_m);
    if (hit) hits.push_back({pair, hit->time});
  }
  return hits;
}

}  // namespace gambeson::gpu
