#include "gpu/scenes/scene.hpp"

#include <algorithm>

namespace gambeson::gpu {

std::vector<std::array<int, 2>> edgesOf(const std::vector<std::array<int, 3>>& faces) {
  std::vector<std::array<int, 2>> edges;  // larger, smaller
  for (const auto& f : faces)
    for (int k = 0; k < 3; ++k) {
      const auto [smaller, larger] = std::minmax(f[k], f[(k + 1) % 3]);
      edges.push_back({larger, smaller});
    }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (auto& [a, b] : edges) std::swap(a, b);
  return edges;
}

}  // namespace gambeson::gpu
