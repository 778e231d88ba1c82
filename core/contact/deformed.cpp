#include "core/contact/deformed.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/math/parallel.hpp"

namespace gambeson {

DeformedVertices::DeformedVertices(std::span<const Obstacle> obstacles) {
  for (const Obstacle& o : obstacles)
    first_.push_back(first_.back() + (o.deforms ? std::get<TriangleMesh>(o.shape).vertices.size() : 0));
  x_.resize(first_.back());
}

DeformedSurfaces::DeformedSurfaces(std::span<const Obstacle> obstacles) {
  if (std::none_of(obstacles.begin(), obstacles.end(), [](const Obstacle& o) { return o.deforms; })) return;
  for (const Obstacle& o : obstacles)
    surfaces_.push_back(o.deforms ? std::make_unique<MeshSurface>(std::get<TriangleMesh>(o.shape), true) : nullptr);
  motion_.assign(obstacles.size(), 0);
}

void DeformedSurfaces::move(const DeformedVertices& start, const DeformedVertices& end) {
  assert(empty() || (start.size() == surfaces_.size() && end.size() == surfaces_.size()));
  for (std::size_t o = 0; o < surfaces_.size(); ++o) {
    if (!surfaces_[o]) continue;
    surfaces_[o]->refit(start[o]);
    motion_[o] = std::sqrt(largestOf(Each::value, static_cast<int>(start[o].size()), 0.0,
                                     [&](int v) { return norm2(end[o][v] - start[o][v]); }));
  }
}

}  // namespace gambeson
