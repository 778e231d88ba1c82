#pragma once
/// Which triangle answers for which vertices and edges, so that grids that find pairs of triangles give each pair of
/// features once (R-triangles: Curtis, Tamstorf and Manocha 2008; Wong 2014, sections 3.3.1 and 5.3.5).

#include <vector>

#include "gpu/finding/flat_mesh.hpp"

namespace gambeson::gpu {

/// A face and what is its own. An edge of no face is a triangle without a face, and so is a vertex of nothing: their
/// corners are repeated.
struct alignas(16) Owner {
  int corner[3];
  int face;        ///< -1: none
  int edge[3];     ///< from corner k to corner k + 1; -1: another's
  int own_corner;  ///< bit k: the vertex at corner k is its own
};

/// Each vertex and each edge of the mesh belongs to one of them, of those that have it to one with few of its own.
/// Faces come first, in their order.
inline std::vector<Owner> ownersOf(const Mesh& mesh) {
  std::vector<Owner> owners;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto& [a, b, c] = mesh.faces[f];
    owners.push_back({{a, b, c}, static_cast<int>(f), {-1, -1, -1}, 0});
  }
  struct Named {
    std::array<int, 2> ends;
    int edge;
    auto operator<=>(const Named&) const = default;
  };
  const auto ends = [](int a, int b) { return std::array{std::min(a, b), std::max(a, b)}; };
  std::vector<Named> named;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    named.push_back({ends(mesh.edges[e][0], mesh.edges[e][1]), static_cast<int>(e)});
  std::ranges::sort(named);
  // Sides of faces by edge, corners by vertex: 3 owner + k.
  std::vector<std::vector<int>> of_edge(mesh.edges.size()), of_vertex(static_cast<std::size_t>(mesh.vertices));
  for (std::size_t f = 0; f < owners.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int side = static_cast<int>(3 * f) + k, a = owners[f].corner[k], b = owners[f].corner[(k + 1) % 3];
      of_vertex[a].push_back(side);
      const auto at = std::ranges::lower_bound(named, ends(a, b), {}, &Named::ends);
      if (at != named.end() && at->ends == ends(a, b)) of_edge[at->edge].push_back(side);
    }
  std::vector<int> has(owners.size(), 0);
  const auto give = [&](const std::vector<int>& sides) {
    const int side = *std::ranges::min_element(sides, {}, [&](int s) { return has[s / 3]; });
    ++has[side / 3];
    return side;
  };
  std::vector<bool> given(of_vertex.size(), false);
  for (std::size_t e = 0; e < of_edge.size(); ++e) {
    const auto& [a, b] = mesh.edges[e];
    const int edge = static_cast<int>(e);
    if (!of_edge[e].empty()) {
      const int side = give(of_edge[e]);
      owners[side / 3].edge[side % 3] = edge;
      continue;
    }
    Owner alone{{a, b, b}, -1, {edge, -1, -1}, 0};
    for (int k = 0; k < 2; ++k) {
      const int v = alone.corner[k];
      if (!of_vertex[v].empty() || given[v]) continue;
      given[v] = true;
      alone.own_corner |= 1 << k;
    }
    owners.push_back(alone);
  }
  for (int v = 0; v < mesh.vertices; ++v) {
    if (given[v]) continue;
    if (of_vertex[v].empty()) {
      owners.push_back({{v, v, v}, -1, {-1, -1, -1}, 1});
      continue;
    }
    const int side = give(of_vertex[v]);
    owners[side / 3].own_corner |= 1 << side % 3;
  }
  return owners;
}

}  // namespace gambeson::gpu
