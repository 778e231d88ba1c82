#include "core/contact/bounding_tree.hpp"
#include "core/math/parallel.hpp"

#include <cassert>
#include <numeric>

namespace gambeson {
namespace {}

BoundingTree::BoundingTree(std::span<const Box> primitives, int leaf_size) {
  assert(leaf_size > 0);
  if (primitives.empty()) return;
  order_.resize(primitives.size());
  std::iota(order_.begin(), order_.end(), 0);
  struct Range {
    int begin, end;
  };
  std::vector<Range> level{{0, static_cast<int>(primitives.size())}}, next;
  nodes_.push_back({});
  int level_begin = 0;
  // Bisection of space for 64 levels, then halving by count: at most 64 + 32 levels, each adds one to the stack.
  for (; !level.empty(); ++levels_) {
    next.clear();
    const int next_begin = level_begin + static_cast<int>(level.size());
    for (std::size_t r = 0; r < level.size(); ++r) {
      const auto [begin, end] = level[r];
      Node& node = nodes_[level_begin + r];
      if (end - begin <= leaf_size) {
        node.first = begin;
        node.count = end - begin;
        continue;
      }
      Box centres;
      for (int k = begin; k < end; ++k) centres.add(primitives[order_[k]].centre());
      const Vec3 h = centres.halfSize();
      const int axis = h.x >= h.y && h.x >= h.z ? 0 : h.y >= h.z ? 1 : 2;
      const double cut = centres.centre()[axis];
      int middle = begin;
      if (levels_ < 64) {
        const auto it = std::stable_partition(order_.begin() + begin, order_.begin() + end,
                                              [&](int i) { return primitives[i].centre()[axis] < cut; });
        middle = static_cast<int>(it - order_.begin());
      }
      if (middle == begin || middle == end) middle = begin + (end - begin) / 2;
      node.first = next_begin + static_cast<int>(next.size());
      node.count = 0;
      next.push_back({begin, middle});
      next.push_back({middle, end});
    }
    nodes_.resize(nodes_.size() + next.size());
    level_begin = next_begin;
    level.swap(next);
  }
  refit(primitives);
}

void BoundingTree::refit(std::span<const Box> primitives) {
  assert(primitives.size() == order_.size());
  const int count = static_cast<int>(nodes_.size());
  forAll(Each::value, count, [&](int i) {
    Node& n = nodes_[i];
    if (n.count == 0) return;
    n.box = Box{};
    for (int k = n.first; k < n.first + n.count; ++k) n.box.add(primitives[order_[k]]);
  });
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& n = nodes_[i];
    if (n.count > 0) continue;
    n.box = nodes_[n.first].box;
    n.box.add(nodes_[n.first + 1].box);
  }
}

}  // namespace gambeson
