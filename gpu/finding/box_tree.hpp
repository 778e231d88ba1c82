#pragma once
/// The tree of boxes over the faces (K = 3) or edges (K = 2) of a mesh, and what making it needs.

#include "gpu/device/bytes.hpp"
#include "gpu/finding/radix_tree.hpp"

namespace gambeson::gpu {

template <class Device, int K>
class BoxTree {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  explicit BoxTree(int n)
      : n_(n),
        node_(size(n)),
        leaf_(size(n)),
        leaf_box_(size(n)),
        code_(size(n)),
        code_sorted_(size(n)),
        primitive_(size(n)),
        order_(size(n)),
        above_node_(size(n)),
        above_leaf_(size(n)),
        came_(size(n)),
        sort_(n, kMortonBits) {}

  /// Which primitives belong together, by where they are. Boxes are fitted after it.
  void build(Queue& queue, const Buffer<int>& corners, const Buffer<FloatBox>& vertex_box, const MortonCube& cube) {
    queue.forEach(n_, CodePrimitives<K>{corners.data(), vertex_box.data(), cube, code_.data(), primitive_.data()});
    sort_.run(queue, code_, primitive_, code_sorted_, order_);
    queue.forEach(n_ > 1 ? n_ - 1 : n_, LinkNodes{code_sorted_.data(), n_, node_.data(), above()});
  }
  void fit(Queue& queue, const Buffer<int>& corners, const Buffer<FloatBox>& vertex_box) {
    queue.forEach(n_, FitBoxes<K>{order_.data(), corners.data(), vertex_box.data(), node_.data(), above(), came_.data(),
                                  leaf_.data(), leaf_box_.data()});
  }

  std::size_t bytes() const {
    return sort_.bytes() +
           bytesOf(node_, leaf_, leaf_box_, code_, code_sorted_, primitive_, order_, above_node_, above_leaf_, came_);
  }
  int leaves() const { return n_; }
  const TreeNode* node() const { return node_.data(); }
  const TreeLeaf* leaf() const { return leaf_.data(); }
  const FloatBox* leafBox() const { return leaf_box_.data(); }

 private:
  static std::size_t size(int n) { return static_cast<std::size_t>(n); }
  Above above() { return {above_node_.data(), above_leaf_.data()}; }

  int n_;
  Buffer<TreeNode> node_;
  Buffer<TreeLeaf> leaf_;
  Buffer<FloatBox> leaf_box_;
  Buffer<std::uint32_t> code_, code_sorted_;
  Buffer<int> primitive_, order_, above_node_, above_leaf_, came_;
  typename Device::PairSort sort_;
};

}  // namespace gambeson::gpu
