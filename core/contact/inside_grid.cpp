#include "core/contact/inside_grid.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {

InsideGrid::InsideGrid(std::span<const std::array<Vec3, 3>> triangles,
                       const std::function<bool(const Vec3&)>& is_inside, int resolution) {
  Box bounds;
  for (const std::array<Vec3, 3>& t : triangles)
    for (const Vec3& p : t) bounds.add(p);
  const Vec3 extent = bounds.hi - bounds.lo;
  const double longest = std::max({extent.x, extent.y, extent.z});
  if (!(longest > 0)) return;
  per_cell_ = resolution / longest;
  origin_ = bounds.lo;
  for (int i = 0; i < 3; ++i) size_[i] = std::clamp(static_cast<int>(std::ceil(extent[i] * per_cell_)), 1, resolution);
  const int nx = size_[0], ny = size_[1], nz = size_[2];
  const auto index = [&](int i, int j, int k) { return (static_cast<std::size_t>(k) * ny + j) * nx + i; };
  const std::size_t n = index(0, 0, nz);
  enum State : unsigned char { kSurface, kFree };
  std::vector<unsigned char> state(n, kFree);
  for (const std::array<Vec3, 3>& t : triangles) {
    Box b;
    for (const Vec3& p : t) b.add(p);
    int lo[3], hi[3];
    for (int i = 0; i < 3; ++i) {
      // Larger by far more than the rounding of a look-up.
      lo[i] = std::clamp(static_cast<int>(std::floor((b.lo[i] - origin_[i]) * per_cell_ - 1e-6)), 0, size_[i] - 1);
      hi[i] = std::clamp(static_cast<int>(std::floor((b.hi[i] - origin_[i]) * per_cell_ + 1e-6)), 0, size_[i] - 1);
    }
    // Its plane misses cells whose centre is farther from it than the cell's corners; without an area there is none.
    const Vec3 u = t[1] - t[0], v = t[2] - t[0], normal = cross(u, v);
    const double rounding = 1e-14 * norm(u) * norm(v) * (norm(u) + norm(v) + 1 / per_cell_);
    const double half =
        (0.5 + 1e-6) / per_cell_ * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) + rounding;
    for (int k = lo[2]; k <= hi[2]; ++k)
      for (int j = lo[1]; j <= hi[1]; ++j)
        for (int i = lo[0]; i <= hi[0]; ++i) {
          const Vec3 centre = origin_ + (1 / per_cell_) * Vec3{i + 0.5, j + 0.5, k + 0.5};
          if (!(std::abs(dot(normal, centre - t[0])) > half)) state[index(i, j, k)] = kSurface;
        }
  }
  cells_.assign(n, Cube::undecided);
  struct Index {
    int i, j, k;
  };
  std::vector<Index> front;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        if (state[index(i, j, k)] != kFree || cells_[index(i, j, k)] != Cube::undecided) continue;
        const Vec3 centre = origin_ + (1 / per_cell_) * Vec3{i + 0.5, j + 0.5, k + 0.5};
        const Cube value = is_inside(centre) ? Cube::inside : Cube::outside;
        cells_[index(i, j, k)] = value;
        front.assign(1, {i, j, k});
        while (!front.empty()) {
          const Index c = front.back();
          front.pop_back();
          const auto reach = [&](int a, int b, int d) {
            if (a < 0 || b < 0 || d < 0 || a >= nx || b >= ny || d >= nz) return;
            const std::size_t m = index(a, b, d);
            if (state[m] != kFree || cells_[m] != Cube::undecided) return;
            cells_[m] = value;
            front.push_back({a, b, d});
          };
          reach(c.i - 1, c.j, c.k), reach(c.i + 1, c.j, c.k), reach(c.i, c.j - 1, c.k);
          reach(c.i, c.j + 1, c.k), reach(c.i, c.j, c.k - 1), reach(c.i, c.j, c.k + 1);
        }
      }
}

}  // namespace gambeson
