#pragma once
/// Tree of axis-aligned boxes over primitives: constant topology from the primitives' centres, boxes refitted level by
/// level (Zheng 2013, sections 3.6.1 to 3.6.3).

#include <array>
#include <span>
#include <vector>

#include "core/contact/box.hpp"

namespace gambeson {

class BoundingTree {
 public:
  BoundingTree() = default;
  /// Bisects the box of the centres along its longest side until a node holds at most `leaf_size` primitives. Only the
  /// centres decide the topology; coinciding centres are split by index, so that it always ends.
  explicit BoundingTree(std::span<const Box> primitives, int leaf_size = 4);

  /// Same topology, new boxes: from the last level to the root.
  void refit(std::span<const Box> primitives);

  bool empty() const { return nodes_.empty(); }
  /// The box of everything. The tree is not empty.
  const Box& bounds() const { return nodes_[0].box; }
  int levels() const { return levels_; }

  /// Calls visit(primitive) for all primitives whose box touches `box` (a superset: leaves are not tested one by one).
  template <class Visit>
  void overlapping(const Box& box, Visit&& visit) const {
    traverse([&](const Box& node) { return overlap(node, box); }, visit);
  }

  /// Calls visit(primitive) for all primitives within `radius` of p (a superset, as above).
  template <class Visit>
  void within(const Vec3& p, double radius, Visit&& visit) const {
    const double r2 = radius * radius;
    traverse([&](const Box& node) { return boxDistance2(node, p) <= r2; }, visit);
  }

  /// Branch and bound: visit(primitive, best2) may lower best2, the squared distance beyond which nothing matters;
  /// nearer boxes first. Boxes at exactly best2 are still visited, so that ties are seen whatever the order.
  template <class Visit>
  void nearest(const Vec3& p, double& best2, Visit&& visit) const {
    if (nodes_.empty()) return;
    struct Entry {
      int node;
      double d2;
    };
    std::array<Entry, kMaxDepth> stack;
    int top = 0;
    stack[top++] = {0, boxDistance2(nodes_[0].box, p)};
    while (top > 0) {
      const Entry entry = stack[--top];
      if (entry.d2 > best2) continue;
      const Node& n = nodes_[entry.node];
      if (n.count > 0) {
        for (int k = n.first; k < n.first + n.count; ++k) visit(order_[k], best2);
        continue;
      }
      Entry a{n.first, boxDistance2(nodes_[n.first].box, p)};
      Entry b{n.first + 1, boxDistance2(nodes_[n.first + 1].box, p)};
      if (a.d2 < b.d2) std::swap(a, b);
      stack[top++] = a;
      stack[top++] = b;
    }
  }

 private:
  /// Leaf: primitives order_[first, first + count). Inner node: count 0, children first and first + 1. Breadth first,
  /// so children come after their parent.
  struct Node {
    Box box;
    int first = 0, count = 0;
  };
  static constexpr int kMaxDepth = 128;  ///< bound of the traversal stack: see the constructor

  template <class Test, class Visit>
  void traverse(Test&& test, Visit&& visit) const {
    if (nodes_.empty()) return;
    std::array<int, kMaxDepth> stack;
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& n = nodes_[stack[--top]];
      if (!test(n.box)) continue;
      if (n.count > 0) {
        for (int k = n.first; k < n.first + n.count; ++k) visit(order_[k]);
      } else {
        stack[top++] = n.first + 1;
        stack[top++] = n.first;
      }
    }
  }

  std::vector<Node> nodes_;
  std::vector<int> order_;
  int levels_ = 0;
};

}  // namespace gambeson
