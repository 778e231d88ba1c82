#pragma once
/// A tree of boxes over triangles that move from query to query.

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/contact/bounding_tree.hpp"

namespace gambeson {

/// Fitted to where the triangles are when it is first asked for after they have moved. Any threads may ask at the same
/// time; moving is for one alone.
class LazyTree {
 public:
  LazyTree() = default;
  LazyTree(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles);

  void moved() { fit_->due = true; }
  const BoundingTree& at(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles) const;

 private:
  struct Fit {
    std::mutex one_at_a_time;
    std::atomic<bool> due = false;
    std::vector<Box> boxes;  ///< of the triangles
    BoundingTree tree;
  };
  std::unique_ptr<Fit> fit_;
};

}  // namespace gambeson
