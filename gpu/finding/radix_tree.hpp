#pragma once
/// A tree of boxes over primitives sorted along Morton's curve: which node has which children (Karras 2012, "Maximizing
/// parallelism in the construction of BVHs, octrees, and k-d trees", section 4), and boxes from the leaves up.

#include "gpu/device/atomics.hpp"
#include "gpu/finding/morton.hpp"

namespace gambeson::gpu {

/// An inner node holds the boxes of both children, so that one fetch tests two. Root: node 0.
struct alignas(64) TreeNode {
  FloatBox box[2];
  int child[2];  ///< an inner node, or ~leaf
  int last[2];   ///< the last leaf under each child: leaves stand in the order of the curve
};

/// Longest way from the root: codes and, where they are the same, places differ in ever lower bits.
constexpr int kTreeDepth = kMortonBits + 32;

/// A primitive in its place on the curve. Of an edge the last two corners are the same.
struct alignas(16) TreeLeaf {
  int corner[3];
  int primitive;
};

/// Who is above: 2 node + side, -1 above the root.
struct Above {
  int* of_node;
  int* of_leaf;
};

GAMBESON_HD inline int leadingZeros(std::uint32_t x) {
#ifdef __CUDA_ARCH__
  return __clz(static_cast<int>(x));
#else
  return std::countl_zero(x);
#endif
}

/// Writes the inner node i of a tree of n leaves, n >= 2, without boxes; one leaf alone makes a node with an empty
/// side.
struct LinkNodes {
  const std::uint32_t* code;  ///< sorted
  int n;
  TreeNode* node;
  Above above;

  GAMBESON_HD void operator()(int i) const {
    if (i == 0) above.of_node[0] = -1;
    if (n == 1) {
      node[0].child[0] = node[0].child[1] = ~0;
      node[0].last[0] = node[0].last[1] = 0;
      node[0].box[1] = emptyBox();
      above.of_leaf[0] = 0;
      return;
    }
    // The leaves under the node: from i in the direction in which more bits are common, as far as more are common than
    // with the neighbour on the other side.
    const int way = common(i, i + 1) > common(i, i - 1) ? 1 : -1;
    const int least = common(i, i - way);
    int reach = 2;
    while (common(i, i + reach * way) > least) reach *= 2;
    int length = 0;
    for (int step = reach / 2; step >= 1; step /= 2)
      if (common(i, i + (length + step) * way) > least) length += step;
    const int end = i + length * way;
    // The last leaf of the first child: where the bits common to all end.
    const int shared = common(i, end);
    int split = 0;
    for (int step = (length + 1) / 2;; step = (step + 1) / 2) {
      if (common(i, i + (split + step) * way) > shared) split += step;
      if (step == 1) break;
    }
    const int cut = i + split * way + (way < 0 ? -1 : 0);
    const int first = way > 0 ? i : end, last = way > 0 ? end : i;
    link(i, 0, cut, first == cut, cut);
    link(i, 1, cut + 1, last == cut + 1, last);
  }

 private:
  /// How many leading bits of two places are the same; less than any where there is no such place.
  GAMBESON_HD int common(int i, int j) const {
    if (j < 0 || j >= n) return -1;
    const std::uint32_t differ = code[i] ^ code[j];
    return differ != 0 ? leadingZeros(differ) : 32 + leadingZeros(static_cast<std::uint32_t>(i ^ j));
  }
  GAMBESON_HD void link(int i, int side, int child, bool is_leaf, int last) const {
    node[i].child[side] = is_leaf ? ~child : child;
    node[i].last[side] = last;
    (is_leaf ? above.of_leaf : above.of_node)[child] = 2 * i + side;
  }
};

/// K: corners of a primitive, 2 or 3.
template <int K>
GAMBESON_HD FloatBox primitiveBox(const int* corners, const FloatBox* vertex_box) {
  FloatBox box = vertex_box[corners[0]];
  for (int k = 1; k < K; ++k) box = joined(box, vertex_box[corners[k]]);
  return box;
}

template <int K>
struct CodePrimitives {
  const int* corners;
  const FloatBox* vertex_box;
  MortonCube cube;
  std::uint32_t* code;
  int* primitive;

  GAMBESON_HD void operator()(int i) const {
    code[i] = cube.code(primitiveBox<K>(corners + K * i, vertex_box));
    primitive[i] = i;
  }
};

/// Leaf i and its box; then up, by whoever comes second to a node.
template <int K>
struct FitBoxes {
  const int* order;  ///< of primitives along the curve
  const int* corners;
  const FloatBox* vertex_box;
  TreeNode* node;
  Above above;
  int* came;
  TreeLeaf* leaf;
  FloatBox* leaf_box;

  GAMBESON_HD void operator()(int i) const {
    const int primitive = order[i];
    const int* corner = corners + K * primitive;
    leaf[i] = {{corner[0], corner[1], corner[K - 1]}, primitive};
    FloatBox box = primitiveBox<K>(corner, vertex_box);
    leaf_box[i] = box;
    for (int up = above.of_leaf[i]; up >= 0;) {
      const int at = up / 2, side = up % 2;
      up = above.of_node[at];  // read before the wait
      node[at].box[side] = box;
      if (!comesSecond(&came[at])) return;
      box = joined(box, node[at].box[1 - side]);
    }
  }
};

}  // namespace gambeson::gpu
