#pragma once
/// Pairs whose boxes meet, from a tree of boxes: tasks (query, node) on the stack of a group, as many at a time as it
/// has lanes, so that a heavy query is shared by all of them.

#include "gpu/device/list.hpp"
#include "gpu/finding/float_dop.hpp"
#include "gpu/finding/pair.hpp"
#include "gpu/finding/radix_tree.hpp"

namespace gambeson::gpu {

/// What is sought in the tree: a box and the primitive that has it.
struct BoxQuery {
  FloatBox box;
  int corner[2];
  int primitive;
  int leaf;  ///< its own, in a tree that holds it; leaves up to it are not looked at
};

/// Vertices against the tree of the faces.
struct VerticesInFaces {
  const int* order;  ///< in which vertices are taken
  const FloatBox* vertex_box;

  GAMBESON_HD BoxQuery operator()(int i) const {
    const int v = order[i];
    return {vertex_box[v], {v, v}, v, -1};
  }
  GAMBESON_HD static bool counts(const BoxQuery& q, const TreeLeaf& leaf) {
    return leaf.corner[0] != q.corner[0] && leaf.corner[1] != q.corner[0] && leaf.corner[2] != q.corner[0];
  }
  GAMBESON_HD static Pair pair(const BoxQuery& q, const TreeLeaf& leaf) { return {q.primitive, leaf.primitive}; }
};

/// Edges against the tree of the edges, each pair once.
struct EdgesInEdges {
  const TreeLeaf* leaf;
  const FloatBox* leaf_box;

  GAMBESON_HD BoxQuery operator()(int i) const {
    return {leaf_box[i], {leaf[i].corner[0], leaf[i].corner[1]}, leaf[i].primitive, i};
  }
  GAMBESON_HD static bool counts(const BoxQuery& q, const TreeLeaf& other) {
    return other.corner[0] != q.corner[0] && other.corner[0] != q.corner[1] && other.corner[1] != q.corner[0] &&
           other.corner[1] != q.corner[1];
  }
  GAMBESON_HD static Pair pair(const BoxQuery& q, const TreeLeaf& other) {
    return q.primitive < other.primitive ? Pair{q.primitive, other.primitive} : Pair{other.primitive, q.primitive};
  }
};

/// Vertices of cloth against the tree of the faces of bodies, which are numbered from `first_face` on.
struct VerticesInBodies {
  const int* order;
  const FloatBox* vertex_box;
  int cloth_vertices, first_face;

  GAMBESON_HD BoxQuery operator()(int i) const {
    const int v = order[i];
    return {v < cloth_vertices ? vertex_box[v] : emptyBox(), {v, first_face}, v, -1};
  }
  GAMBESON_HD static bool counts(const BoxQuery&, const TreeLeaf&) { return true; }
  GAMBESON_HD static Pair pair(const BoxQuery& q, const TreeLeaf& leaf) {
    return {q.primitive, q.corner[1] + leaf.primitive};
  }
};

/// Edges of bodies, from `first` on, against the tree of the edges of cloth.
struct BodyEdgesInCloth {
  const int* edge;
  const FloatBox* vertex_box;
  int first;

  GAMBESON_HD BoxQuery operator()(int i) const {
    const int e = first + i, a = edge[2 * e], b = edge[2 * e + 1];
    return {joined(vertex_box[a], vertex_box[b]), {a, b}, e, -1};
  }
  GAMBESON_HD static bool counts(const BoxQuery&, const TreeLeaf&) { return true; }
  GAMBESON_HD static Pair pair(const BoxQuery& q, const TreeLeaf& leaf) { return {leaf.primitive, q.primitive}; }
};

/// Queries whose polytopes are compared after their boxes.
template <class Queries, bool kOfVertices>
struct WithPolytopes : Queries {
  const FloatDop* vertex_dop;

  GAMBESON_HD bool counts(const BoxQuery& q, const TreeLeaf& other) const {
    if (!Queries::counts(q, other)) return false;
    const FloatDop mine = kOfVertices ? vertex_dop[q.primitive] : primitiveDop<2>(q.corner, vertex_dop);
    return meet(mine, primitiveDop<3>(other.corner, vertex_dop));
  }
};

constexpr int kMostQueries = 16;  ///< of a group

/// kStack: tasks of a group, more than kTreeDepth and the queries together. kTallied: boxes that are compared are
/// counted.
template <class Queries, int kStack = 512, bool kTallied = false>
struct Traverse {
  static constexpr int kResident = 48;
  static constexpr int kGathered = 256, kNodeBits = 26;
  static_assert(kMostQueries <= 1 << (32 - kNodeBits));

  struct Shared {
    BoxQuery query[kMostQueries];
    std::uint32_t stack[kStack];  ///< query and node of a task
    Gathered<Pair, kGathered> found;
  };

  Queries queries;
  int count;             ///< of queries
  int per_group;         ///< at most kMostQueries
  const TreeNode* node;  ///< fewer than 2^kNodeBits
  const TreeLeaf* leaf;
  List<Pair> pairs;
  Count* tally = nullptr;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int) const {
    Lanes<Group, bool> opens[2], counts[2];
    Lanes<Group, std::uint32_t> task[2];
    Lanes<Group, Pair> pair[2];
    const int first = index * per_group;
    int tasks = std::min(per_group, count - first), found = 0;
    group.each([&](int lane) {
      for (int k = lane; k < tasks; k += Group::kLanes) {
        shared.query[k] = queries(first + k);
        shared.stack[k] = static_cast<std::uint32_t>(k) << kNodeBits;
      }
    });
    group.sync();
    while (tasks > 0) {
      // Each task may leave two. Where the stack is nearly full one is taken at a time: depth first, that adds no more
      // than the tree is deep.
      const int take = std::min(std::min(int{Group::kLanes}, tasks), std::max(1, kStack - kTreeDepth - tasks));
      tasks -= take;
      if constexpr (kTallied) group.once([&] { return fetchAdd(tally, static_cast<Count>(2 * take)); });
      group.each([&](int lane) {
        opens[0][lane] = opens[1][lane] = counts[0][lane] = counts[1][lane] = false;
        if (lane >= take) return;
        const std::uint32_t now = shared.stack[tasks + lane], of_query = now >> kNodeBits << kNodeBits;
        const TreeNode at = node[now - of_query];
        const BoxQuery& query = shared.query[now >> kNodeBits];
        for (int side = 0; side < 2; ++side) {
          if (!meet(query.box, at.box[side]) || at.last[side] <= query.leaf) continue;
          if (at.child[side] >= 0) {
            opens[side][lane] = true;
            task[side][lane] = of_query | static_cast<std::uint32_t>(at.child[side]);
          } else {
            const TreeLeaf other = leaf[~at.child[side]];
            counts[side][lane] = queries.counts(query, other);
            pair[side][lane] = Queries::pair(query, other);
          }
        }
      });
      group.sync();
      for (int side = 0; side < 2; ++side) {
        push(group, opens[side], task[side], shared.stack, tasks);
        shared.found.add(group, counts[side], pair[side], found);
      }
      group.sync();
      if (found > kGathered - 2 * Group::kLanes) shared.found.flush(group, found, pairs);
    }
    if (found > 0) shared.found.flush(group, found, pairs);
  }

 private:
  template <class Group, class T>
  using Lanes = typename Group::template PerLane<T>;

  template <class Group>
  GAMBESON_HD static void push(const Group& group, const Lanes<Group, bool>& on,
                               const Lanes<Group, std::uint32_t>& task, std::uint32_t* stack, int& tasks) {
    const LaneMask mask = group.ballot(on);
    group.each([&](int lane) {
      if (on[lane]) stack[tasks + lanesBefore(mask, lane)] = task[lane];
    });
    tasks += lanesIn(mask);
  }
};

}  // namespace gambeson::gpu
