#include "analysis/sheet_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace gambeson {
namespace {

using Cell = std::pair<int, int>;

Cell cellOf(const SheetMesh& m, std::size_t t) { return {m.triangle_patch[t], m.triangle_cell[t]}; }

/// Sides of triangles by their ends, and how many triangles have them.
std::map<std::pair<int, int>, int> sidesOf(const SheetMesh& m) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++count[std::minmax(t[k], t[(k + 1) % 3])];
  return count;
}

/// Marks the samples of all triangles whose cell is not in `without`.
std::vector<char> samplesOutside(const SheetMesh& m, const std::set<Cell>& without) {
  std::vector<char> in(m.rest_m.size(), 0);
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (!without.contains(cellOf(m, t)))
      for (const int s : m.triangles[t]) in[static_cast<std::size_t>(s)] = 1;
  return in;
}

}  // namespace

std::vector<char> innerSamples(const SheetMesh& m) {
  const auto sides = sidesOf(m);
  std::set<Cell> at_border;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (sides.at(std::minmax(m.triangles[t][k], m.triangles[t][(k + 1) % 3])) == 1) at_border.insert(cellOf(m, t));
  return samplesOutside(m, at_border);
}

std::vector<char> clearOfCorners(const SheetMesh& m, double angle_rad) {
  std::vector<double> angle(m.rest_m.size(), 0);
  for (const auto& t : m.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](std::size_t i) { return m.rest_m[static_cast<std::size_t>(t[i % 3])]; };
      const Vec3 a = at(k + 1) - at(k), b = at(k + 2) - at(k);
      angle[static_cast<std::size_t>(t[k])] += std::atan2(norm(cross(a, b)), dot(a, b));
    }
  std::vector<char> corner(m.rest_m.size(), 0);
  for (const auto& [side, count] : sidesOf(m))
    if (count == 1)
      for (const int s : {side.first, side.second})
        corner[static_cast<std::size_t>(s)] = angle[static_cast<std::size_t>(s)] > angle_rad;
  std::set<Cell> near;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (const int s : m.triangles[t])
      if (corner[static_cast<std::size_t>(s)]) near.insert(cellOf(m, t));
  std::vector<char> clear = samplesOutside(m, near);
  // A sample between two cells is of both: here it is out where either of them is.
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (near.contains(cellOf(m, t)))
      for (const int s : m.triangles[t]) clear[static_cast<std::size_t>(s)] = 0;
  return clear;
}

std::vector<double> regionRms(std::span<const int> region, std::span<const double> area_m2, std::span<const double> x,
                              int regions) {
  if (region.size() != area_m2.size() || region.size() != x.size())
    throw std::logic_error("region, area and value of each sample");
  std::vector<double> sum(static_cast<std::size_t>(regions), 0), area(sum.size(), 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum[static_cast<std::size_t>(region[i])] += area_m2[i] * x[i] * x[i];
    area[static_cast<std::size_t>(region[i])] += area_m2[i];
  }
  for (std::size_t r = 0; r < sum.size(); ++r) sum[r] = area[r] > 0 ? std::sqrt(sum[r] / area[r]) : 0;
  return sum;
}

}  // namespace gambeson
