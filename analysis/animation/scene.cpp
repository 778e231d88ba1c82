#include "analysis/animation/scene.hpp"

namespace gambeson {

std::vector<Placement> worldOf(const AnimatedScene& scene, std::size_t time) {
  std::vector<Placement> X_WN;
  for (const MovedNode& n : scene.nodes) {
    const Placement& X = n.at.size() == 1 ? n.at[0] : n.at.at(time);
    if (n.parent < 0) {
      X_WN.push_back(X);
    } else {
      const Placement& P = X_WN.at(static_cast<std::size_t>(n.parent));
      X_WN.push_back({P.rotation * X.rotation, P * X.origin, P.scale * X.scale});
    }
  }
  return X_WN;
}

std::vector<Vec3> positionsOf(const SkinnedMesh& skin, const std::vector<Placement>& X_WN) {
  std::vector<Vec3> x(skin.rest.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    for (const auto& [k, weight] : skin.weights[v]) {
      const auto n = static_cast<std::size_t>(k);
      x[v] += static_cast<double>(weight) *
              (X_WN[static_cast<std::size_t>(skin.nodes[n])] * (skin.inverse_bind[n] * skin.rest[v]));
    }
  return x;
}

}  // namespace gambeson
