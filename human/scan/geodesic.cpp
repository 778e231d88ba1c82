#include "human/scan/geodesic.hpp"

#include <limits>
#include <queue>

namespace gambeson {

std::vector<double> distancesFrom(const TriangleMesh& mesh, const std::vector<int>& sources) {
  std::vector<std::vector<int>> beside(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      beside[static_cast<std::size_t>(t[k])].push_back(t[(k + 1) % 3]);
      beside[static_cast<std::size_t>(t[k])].push_back(t[(k + 2) % 3]);
    }
  std::vector<double> far(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  using At = std::pair<double, int>;
  std::priority_queue<At, std::vector<At>, std::greater<>> next;
  for (const int v : sources) far[static_cast<std::size_t>(v)] = 0, next.push({0, v});
  while (!next.empty()) {
    const auto [d, v] = next.top();
    next.pop();
    if (d > far[static_cast<std::size_t>(v)]) continue;
    for (const int w : beside[static_cast<std::size_t>(v)]) {
      const double via =
          d + norm(mesh.vertices[static_cast<std::size_t>(w)] - mesh.vertices[static_cast<std::size_t>(v)]);
      if (via < far[static_cast<std::size_t>(w)]) far[static_cast<std::size_t>(w)] = via, next.push({via, w});
    }
  }
  return far;
}

}  // namespace gambeson
