#include "core/cloth/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

std::vector<int> lineSamples(const Surface& s, std::span<const EdgePlace> line) {
  constexpr double kOn = 0.1;  // of the spacing of samples
  const auto minus = [](Vec2 a, Vec2 b) { return Vec2{a.x - b.x, a.y - b.y}; };
  const auto at = [&](int i) { return s.parameters[static_cast<std::size_t>(i)]; };
  std::map<std::array<int, 2>, int> faces;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && s.triangle_patch[t] == line[0].patch; ++k) {
      const auto [v, w] = std::minmax(s.triangles[t][k], s.triangles[t][(k + 1) % 3]);
      ++faces[{v, w}];
    }
  std::map<int, double> spacing;  // of the samples on the border, to the nearest
  for (const auto& [edge, count] : faces) {
    if (count != 1) continue;
    const Vec2 way = minus(at(edge[1]), at(edge[0]));
    for (const int v : edge) {
      const auto known = spacing.try_emplace(v, HUGE_VAL).first;
      known->second = std::min(known->second, std::hypot(way.x, way.y));
    }
  }
  std::vector<std::pair<double, int>> on;  // how far along
  for (const auto& [v, near] : spacing) {
    double least = HUGE_VAL, along = 0, start = 0;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec2 way = minus(line[k + 1].uv, line[k].uv), to = minus(at(v), line[k].uv);
      const double length = std::hypot(way.x, way.y);
      const double part = length > 0 ? std::clamp((to.x * way.x + to.y * way.y) / (length * length), 0.0, 1.0) : 0;
      const Vec2 off = minus(to, {part * way.x, part * way.y});
      if (const double d = std::hypot(off.x, off.y); d < least) least = d, along = start + part * length;
      start += length;
    }
    if (least <= kOn * near) on.push_back({along, v});
  }
  std::sort(on.begin(), on.end());
  std::vector<int> out;
  for (const auto& [along, v] : on) out.push_back(v);
  return out;
}

}  // namespace gambeson
