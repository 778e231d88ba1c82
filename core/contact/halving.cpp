#include "core/contact/halving.hpp"

#include <algorithm>
#include <numeric>

namespace gambeson {
namespace {

/// The axis along which these points lie farthest apart.
int longestExtent(std::span<const Vec3> x, std::span<const int> points) {
  int longest = 0;
  double most = -1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] =
        std::minmax_element(points.begin(), points.end(), [&](int a, int b) { return x[a][axis] < x[b][axis]; });
    const double extent = x[*greatest][axis] - x[*least][axis];
    if (extent > most) most = extent, longest = axis;
  }
  return longest;
}

void halve(std::span<const Vec3> x, std::span<int> points) {
  const int n = static_cast<int>(points.size());
  if (n < 2) return;
  const int axis = longestExtent(x, points), middle = middleOf(0, n);
  std::nth_element(points.begin(), points.begin() + middle, points.end(),
                   [&](int a, int b) { return x[a][axis] < x[b][axis] || (x[a][axis] == x[b][axis] && a < b); });
  halve(x, points.first(middle));
  halve(x, points.subspan(middle));
}

}  // namespace

std::vector<int> halvedPlaces(std::span<const Vec3> x) {
  std::vector<int> points(x.size()), place(x.size());
  std::iota(points.begin(), points.end(), 0);
  halve(x, points);
  for (std::size_t k = 0; k < points.size(); ++k) place[points[k]] = static_cast<int>(k);
  return place;
}

}  // namespace gambeson
