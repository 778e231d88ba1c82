#include "core/contact/crossing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/contact/orientation.hpp"
#include "core/error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// Positions for which `orientation` is exact.
std::vector<Vec3> exactRange(std::span<const Vec3> x) {
  std::vector<Vec3> y(x.begin(), x.end());
  for (auto& p : y)
    for (int c = 0; c < 3; ++c) {
      if (!(std::abs(p[c]) < 1e60)) throw RunError("a position is not finite, or 1e60 m or more from the origin");
      if (std::abs(p[c]) < 1e-60) p[c] = 0;
    }
  return y;
}

}  // namespace

std::vector<Box> triangleBoxes(const ContactMesh& mesh, std::span<const Vec3> x) {
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (int v : mesh.triangles[t]) boxes[t].add(x[v]);
  return boxes;
}

std::vector<Crossing> findCrossings(const ContactMesh& mesh, std::span<const Vec3> positions,
                                    const BoundingTree& triangle_tree, std::span<const char> obstacle) {
  assert(positions.size() == static_cast<std::size_t>(mesh.vertex_count));
  assert(obstacle.empty() || obstacle.size() == positions.size());
  const std::vector<Vec3> x = exactRange(positions);
  // Boxes and tree see the given positions: what a coordinate below 1e-60 can change is within the margin.
  const std::vector<Box> boxes = triangleBoxes(mesh, positions);
  constexpr double margin = 1e-60;

  const auto test = [&](int e, int t, std::vector<Crossing>& out) {
    const auto& [v, w] = mesh.edges[e];
    const auto& [a, b, c] = mesh.triangles[t];
    if (mesh.hangTogether(mesh.edges[e], mesh.triangles[t])) return;
    if (!obstacle.empty() && obstacle[v] && obstacle[a]) return;
    const int back = orientation(x, {a, b, c, v}), front = orientation(x, {a, b, c, w});
    if (back == front) return;
    const int turn = orientation(x, {v, w, a, b});
    if (turn != orientation(x, {v, w, b, c}) || turn != orientation(x, {v, w, c, a})) return;
    out.push_back({e, t, front});
  };

  // One walk through the tree for all edges with the same lower vertex: they follow one another.
  const int edges = static_cast<int>(mesh.edges.size());
  constexpr int kChunk = 256;
  const int chunks = (edges + kChunk - 1) / kChunk;
  std::vector<std::vector<Crossing>> found(chunks);
  forAllUneven(Each::much, chunks, [&](int chunk) {
    std::vector<Box> edge_boxes;
    const int chunk_end = std::min(edges, (chunk + 1) * kChunk);
    for (int first = chunk * kChunk, end = first; first < chunk_end; first = end) {
      edge_boxes.clear();
      Box all;
      for (; end < chunk_end && mesh.edges[end][0] == mesh.edges[first][0]; ++end) {
        Box box;
        for (int v : mesh.edges[end]) box.add(positions[v]);
        edge_boxes.push_back(box.grown(margin));
        all.add(edge_boxes.back());
      }
      triangle_tree.overlapping(all, [&](int t) {
        if (!overlap(all, boxes[t])) return;
        for (int e = first; e < end; ++e)
          if (overlap(edge_boxes[e - first], boxes[t])) test(e, t, found[chunk]);
      });
    }
    std::sort(found[chunk].begin(), found[chunk].end(), [](const Crossing& p, const Crossing& q) {
      return p.edge != q.edge ? p.edge < q.edge : p.triangle < q.triangle;
    });
  });
  std::vector<Crossing> out;
  for (const auto& part : found) out.insert(out.end(), part.begin(), part.end());
  return out;
}

std::vector<Crossing> findCrossings(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const char> obstacle) {
  return findCrossings(mesh, x, BoundingTree(triangleBoxes(mesh, x)), obstacle);
}

}  // namespace gambeson
