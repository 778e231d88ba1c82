#include "core/cloth/surface_charts.hpp"

#include <algorithm>

namespace gambeson {
namespace {

/// Coordinates of the grid lines along one direction: sums of the mean lengths between them.
std::vector<double> lines(const Surface& s, int patch, int along, std::span<const Vec3> rest) {
  const std::array<int, 2> n = s.patch_grid_size[patch];
  const auto at = [&](int i, int j) { return s.patch_grid[patch][along == 0 ? i + n[0] * j : j + n[0] * i]; };
  std::vector<double> out{0};
  for (int i = 0; i + 1 < n[along]; ++i) {
    double sum = 0;
    int count = 0;
    for (int j = 0; j < n[1 - along]; ++j) {
      const int a = at(i, j), b = at(i + 1, j);
      if (a < 0 || b < 0) continue;
      sum += norm(rest[b] - rest[a]);
      ++count;
    }
    out.push_back(out.back() + (sum > 0 ? sum / count : 1));
  }
  return out;
}

/// The triangles of a patch from `t` on, one after the other: no two make a whole cell.
GridChart withoutGrid(const Surface& s, int patch, std::size_t& t) {
  GridChart chart;
  for (; t < s.triangles.size() && s.triangle_patch[t] == patch; ++t) {
    chart.triangles.items.push_back(static_cast<int>(t));
    chart.triangles.first.push_back(static_cast<int>(chart.triangles.items.size()));
    chart.whole.push_back(0);
  }
  chart.cells = {static_cast<int>(chart.whole.size()), 1};
  return chart;
}

}  // namespace

SurfaceCharts surfaceCharts(const Surface& s, std::span<const Vec3> rest) {
  SurfaceCharts out;
  out.corners.resize(s.triangles.size());
  std::size_t t = 0;
  for (int p = 0; p < static_cast<int>(s.patch_grid.size()); ++p) {
    if (s.patch_grid[p].empty()) {
      out.charts.push_back(withoutGrid(s, p, t));
      continue;
    }
    const auto [nu, nv] = s.patch_grid_size[p];
    const std::vector<double> u = lines(s, p, 0, rest), v = lines(s, p, 1, rest);
    GridChart chart;
    chart.cells = {nu - 1, nv - 1};
    const int cells = chart.cells[0] * chart.cells[1];
    std::vector<std::vector<int>> in(cells);
    for (; t < s.triangles.size() && s.triangle_patch[t] == p; ++t)
      in[s.triangle_cell[t]].push_back(static_cast<int>(t));
    for (int cell = 0; cell < cells; ++cell) {
      const int i = cell % chart.cells[0], j = cell / chart.cells[0];
      const std::array<int, 4> corner{i + nu * j, i + 1 + nu * j, i + 1 + nu * (j + 1), i + nu * (j + 1)};
      bool whole = in[cell].size() == 2;
      for (int triangle : in[cell])
        for (int k = 0; k < 3; ++k) {
          int place = 0;
          while (place < 4 && s.patch_grid[p][corner[place]] != s.triangles[triangle][k]) ++place;
          if (place == 4) {
            whole = false;
            continue;
          }
          out.corners[triangle][k] = {u[i + (place == 1 || place == 2)], v[j + (place >= 2)]};
        }
      chart.whole.push_back(whole);
      chart.triangles.items.insert(chart.triangles.items.end(), in[cell].begin(), in[cell].end());
      chart.triangles.first.push_back(static_cast<int>(chart.triangles.items.size()));
    }
    out.charts.push_back(std::move(chart));
  }
  return out;
}

}  // namespace gambeson
