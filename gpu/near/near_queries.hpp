#pragma once
/// What is sought in the trees of a dressed body, for traverse.hpp: samples in faces of cloth and of bodies, sharp
/// corners of bodies in faces of cloth (all as VerticesInFaces), and edges in the edges of cloth.

#include "gpu/finding/traverse.hpp"

namespace gambeson::gpu {

/// Edges of cloth against each other, each pair once, where the first along the curve is sharp enough to meet edges.
struct ClothEdgesInEdges : EdgesInEdges {
  const char* blunt;  ///< of each edge

  GAMBESON_HD BoxQuery operator()(int i) const {
    BoxQuery query = EdgesInEdges::operator()(i);
    if (blunt[query.primitive]) query.box = emptyBox();
    return query;
  }
};

/// Sharp edges of bodies against edges of cloth.
struct BodyEdgesInEdges {
  const int* order;  ///< edges in which they are taken
  const std::array<int, 2>* edges;
  const FloatBox* vertex_box;

  GAMBESON_HD BoxQuery operator()(int i) const {
    const int e = order[i], a = edges[e][0], b = edges[e][1];
    return {joined(vertex_box[a], vertex_box[b]), {a, b}, e, -1};
  }
  GAMBESON_HD static bool counts(const BoxQuery&, const TreeLeaf&) { return true; }
  GAMBESON_HD static Pair pair(const BoxQuery& q, const TreeLeaf& leaf) { return {leaf.primitive, q.primitive}; }
};

template <class Queue, class Queries, class Tree>
void traverseTree(Queue& queue, const Queries& queries, int count, const Tree& tree, int per_group,
                  const List<Pair>& to) {
  if (tree.leaves() == 0 || count == 0) return;
  queue.forGroups((count + per_group - 1) / per_group,
                  Traverse<Queries>{queries, count, per_group, tree.node(), tree.leaf(), to});
}

/// What of the pairs of a list is left: keep(pair).
template <class Keep>
struct SiftNear {
  static constexpr int kResident = 16;
  struct Shared {
    Gathered<Pair, 128> left;
  };

  Keep keep;
  List<Pair> pairs, open;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int groups) const {
    typename Group::template PerLane<bool> left;
    typename Group::template PerLane<Pair> pair;
    const Count n = pairs.size();
    int found = 0;
    for (Count first = static_cast<Count>(index) * Group::kLanes; first < n;
         first += static_cast<Count>(groups) * Group::kLanes) {
      group.each([&](int lane) {
        const Count i = first + static_cast<Count>(lane);
        left[lane] = false;
        if (i >= n) return;
        pair[lane] = pairs.items[i];
        left[lane] = keep(pair[lane]);
      });
      shared.left.add(group, left, pair, found);
      group.sync();
      if (found > 128 - Group::kLanes) shared.left.flush(group, found, open);
    }
    if (found > 0) shared.left.flush(group, found, open);
  }
};

}  // namespace gambeson::gpu
