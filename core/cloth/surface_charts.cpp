#include "core/cloth/surface_charts.hpp"

#include <algorithm>
#include <map>
#include <utility>

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

/// Triangles by ones and twos: across the longest edges first, each at most once.
struct LooseCell {
  std::array<int, 2> triangle{-1, -1};
  Vec3 centre;
};

std::vector<LooseCell> paired(const Surface& s, int first, int end, std::span<const Vec3> rest) {
  struct Edge {
    double length2;
    std::array<int, 2> triangle;
  };
  std::map<std::pair<int, int>, int> open;
  std::vector<Edge> edges;
  for (int t = first; t < end; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<int, 3>& corner = s.triangles[static_cast<std::size_t>(t)];
      const int a = corner[k], b = corner[(k + 1) % 3];
      const auto [at, is_new] = open.emplace(std::minmax(a, b), t);
      if (!is_new)
        edges.push_back(
            {norm2(rest[static_cast<std::size_t>(b)] - rest[static_cast<std::size_t>(a)]), {at->second, t}});
    }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.length2 > b.length2; });
  std::vector<char> taken(static_cast<std::size_t>(end - first));
  const auto isTaken = [&](int t) -> char& { return taken[static_cast<std::size_t>(t - first)]; };
  std::vector<LooseCell> cells;
  const auto add = [&](std::array<int, 2> triangle) {
    LooseCell cell{triangle, {}};
    int corners = 0;
    for (int t : triangle) {
      if (t < 0) continue;
      isTaken(t) = 1;
      for (int v : s.triangles[static_cast<std::size_t>(t)])
        cell.centre += rest[static_cast<std::size_t>(v)], ++corners;
    }
    cell.centre *= 1.0 / corners;
    cells.push_back(cell);
  };
  for (const Edge& e : edges)
    if (!isTaken(e.triangle[0]) && !isTaken(e.triangle[1])) add(e.triangle);
  for (int t = first; t < end; ++t)
    if (!isTaken(t)) add({t, -1});
  return cells;
}

/// Bisected along the longest axis, again and again: near cells come near each other.
void bisect(std::span<LooseCell> cells) {
  if (cells.size() < 2) return;
  Box box;
  for (const LooseCell& c : cells) box.add(c.centre);
  const Vec3 h = box.halfSize();
  const int axis = h.x >= h.y && h.x >= h.z ? 0 : h.y >= h.z ? 1 : 2;
  const std::size_t middle = cells.size() / 2;
  std::nth_element(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(middle), cells.end(),
                   [&](const LooseCell& a, const LooseCell& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                             : a.triangle < b.triangle;
                   });
  bisect(cells.first(middle));
  bisect(cells.subspan(middle));
}

/// The triangles of a patch from `t` on: no two make a whole cell.
GridChart withoutGrid(const Surface& s, int patch, std::span<const Vec3> rest, std::size_t& t) {
  const int first = static_cast<int>(t);
  while (t < s.triangles.size() && s.triangle_patch[t] == patch) ++t;
  std::vector<LooseCell> cells = paired(s, first, static_cast<int>(t), rest);
  bisect(cells);
  GridChart chart;
  chart.has_grid = false;
  for (const LooseCell& cell : cells) {
    for (int triangle : cell.triangle)
      if (triangle >= 0) chart.triangles.items.push_back(triangle);
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
      out.charts.push_back(withoutGrid(s, p, rest, t));
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
          int which = 0;
          while (which < 4 && s.patch_grid[p][corner[which]] != s.triangles[triangle][k]) ++which;
          if (which == 4) {
            whole = false;
            continue;
          }
          out.corners[triangle][k] = {u[i + (which == 1 || which == 2)], v[j + (which >= 2)]};
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
