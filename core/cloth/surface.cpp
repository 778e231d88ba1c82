#include "core/cloth/surface.hpp"

#include <algorithm>

namespace gambeson {

std::string edgeName(const PatchEdge& edge) {
  constexpr const char* names[] = {"u0", "u1", "v0", "v1"};
  return std::string("edge ") + names[static_cast<int>(edge.side)] + " of patch " + std::to_string(edge.patch);
}

std::vector<int> gridEdge(int nu, int nv, const PatchEdge& e) {
  std::vector<int> at;
  const bool along_v = e.side == Side::u0 || e.side == Side::u1;
  const int n = along_v ? nv : nu;
  for (int k = 0; k < n; ++k) {
    const int t = e.reversed ? n - 1 - k : k;
    switch (e.side) {
      case Side::u0:
        at.push_back(nu * t);
        break;
      case Side::u1:
        at.push_back(nu - 1 + nu * t);
        break;
      case Side::v0:
        at.push_back(t);
        break;
      case Side::v1:
        at.push_back(t + nu * (nv - 1));
        break;
    }
  }
  return at;
}

std::vector<int> edgeSamples(const Surface& surface, const PatchEdge& edge) {
  const auto side = static_cast<std::size_t>(edge.side);
  if (!surface.edge_samples.empty() && side < surface.edge_samples[edge.patch].size()) {
    // No grid, or a trimmed patch: what is left of the edge, with the points where loops meet it.
    std::vector<int> at = surface.edge_samples[edge.patch][side];
    if (edge.reversed) std::reverse(at.begin(), at.end());
    return at;
  }
  const auto [nu, nv] = surface.patch_grid_size[edge.patch];
  std::vector<int> at = gridEdge(nu, nv, edge);
  for (int& i : at) i = surface.patch_grid[edge.patch][i];
  return at;
}

}  // namespace gambeson
