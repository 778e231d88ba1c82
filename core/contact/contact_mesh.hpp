#pragma once
/// Triangles that may touch each other: who is whose neighbour, with one number for each edge.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace gambeson {

/// Lists of numbers, one after another: list i is items[first[i], first[i + 1]), ascending.
struct Lists {
  std::vector<int> first{0};
  std::vector<int> items;

  int size() const { return static_cast<int>(first.size()) - 1; }
  void add(std::span<const int> list) {
    items.insert(items.end(), list.begin(), list.end());
    first.push_back(static_cast<int>(items.size()));
  }
  std::span<const int> operator[](int i) const {
    return {items.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])};
  }
};

/// Topology alone: no positions, any orientation, any number of faces at an edge, several sheets in one mesh.
struct ContactMesh {
  int vertex_count = 0;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> edges;       ///< v < w, in lexicographic order
  std::vector<std::array<int, 3>> face_edges;  ///< edge k runs from corner k to corner k + 1 or back
  Lists edge_faces, vertex_faces, vertex_edges;
  Lists twins;  ///< of each vertex those that lie on it or beside it across a sewn seam; no lists where there is none

  /// Whether two primitives hang together: by a vertex of both, or by twins. What hangs together does not touch or
  /// cross.
  template <std::size_t A, std::size_t B>
  bool hangTogether(const std::array<int, A>& a, const std::array<int, B>& b) const {
    for (int v : a)
      for (int w : b)
        if (v == w || areTwins(v, w)) return true;
    return false;
  }
  bool areTwins(int v, int w) const {
    if (twins.size() == 0) return false;
    const std::span<const int> of_v = twins[v];
    return std::find(of_v.begin(), of_v.end(), w) != of_v.end();
  }

  bool border(int edge) const { return edge_faces[edge].size() == 1; }
};

/// The corners of a triangle are three different vertices below vertex_count. `twins`: pairs of two different vertices.
ContactMesh contactMesh(int vertex_count, std::span<const std::array<int, 3>> triangles,
                        std::span<const std::array<int, 2>> twins = {});

}  // namespace gambeson
