#include "core/contact/lazy_tree.hpp"

#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

void triangleBoxes(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles, std::vector<Box>& boxes) {
  const int n = static_cast<int>(triangles.size());
  boxes.resize(triangles.size());
  forAll(Each::sum, n, [&](int t) {
    boxes[t] = {};
    for (int i : triangles[t]) boxes[t].add(x[i]);
  });
}

}  // namespace

LazyTree::LazyTree(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles)
    : fit_(std::make_unique<Fit>()) {
  triangleBoxes(x, triangles, fit_->boxes);
  fit_->tree = BoundingTree(fit_->boxes);
}

const BoundingTree& LazyTree::at(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles) const {
  if (fit_->due.load(std::memory_order_acquire)) {
    const std::scoped_lock lock(fit_->one_at_a_time);
    if (fit_->due.load(std::memory_order_relaxed)) {
      triangleBoxes(x, triangles, fit_->boxes);
      fit_->tree.refit(fit_->boxes);
      fit_->due.store(false, std::memory_order_release);
    }
  }
  return fit_->tree;
}

}  // namespace gambeson
