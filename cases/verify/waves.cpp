/// Detail of verify.hpp: crests of profiles, and straight wrinkles of a sheet.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/verify/verify.hpp"
#include "core/error.hpp"

namespace gambeson::verify {

std::vector<std::size_t> crests(const std::vector<double>& y, double prominence, bool closed) {
  std::vector<std::size_t> found;
  const std::size_t n = y.size();
  // The lowest point on the way from i to higher ground, in steps of +1 or -1, or to the end where there is none.
  const auto saddle = [&](std::size_t i, std::ptrdiff_t step) {
    double low = y[i];
    const auto size = static_cast<std::ptrdiff_t>(n);
    std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i);
    for (std::ptrdiff_t k = 1; k < size; ++k) {
      at += step;
      if (!closed && (at < 0 || at >= size)) break;
      const double v = y[static_cast<std::size_t>((at + size) % size)];
      if (v > y[i]) break;
      low = std::min(low, v);
    }
    return low;
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) continue;
    const double before = y[(i + n - 1) % n], after = y[(i + 1) % n];
    if (!(y[i] > before && y[i] >= after)) continue;
    if (y[i] - std::max(saddle(i, -1), saddle(i, 1)) >= prominence) found.push_back(i);
  }
  return found;
}

namespace {

/// Distinct values in rising order; those closer than 1e-6 of the range are one.
std::vector<double> levels(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  std::vector<double> all;
  for (const double x : v)
    if (all.empty() || x - all.back() > 1e-6 * (v.back() - v.front())) all.push_back(x);
  return all;
}

std::size_t levelOf(const std::vector<double>& all, double v) {
  const auto it = std::lower_bound(all.begin(), all.end(), v);
  if (it == all.begin()) return 0;
  if (it == all.end()) return all.size() - 1;
  const auto i = static_cast<std::size_t>(it - all.begin());
  return *it - v < v - all[i - 1] ? i : i - 1;
}

}  // namespace

Wrinkles wrinklesOf(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& w,
                    double margin, double prominence) {
  for (std::size_t i = 0; i < w.size(); ++i)
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || !std::isfinite(w[i]))
      throw RunError("the shape holds numbers that are not finite");
  const std::vector<double> xs = levels(x), ys = levels(y);
  if (xs.size() < 5 || ys.size() < 5 || xs.size() * ys.size() != w.size())
    throw RunError(fmt::format("{} points are no grid of {} x {}", w.size(), xs.size(), ys.size()));
  std::vector<double> grid(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) grid[levelOf(xs, x[i]) + xs.size() * levelOf(ys, y[i])] = w[i];

  const auto inside = [&](const std::vector<double>& all, std::size_t i) {
    const double room = margin * (all.back() - all.front());
    return i > 0 && i + 1 < all.size() && all[i] >= all.front() + room && all[i] <= all.back() - room;
  };
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t j = 0; j < ys.size(); ++j)
    for (std::size_t i = 0; i < xs.size(); ++i) {
      if (!inside(xs, i) || !inside(ys, j)) continue;
      const std::size_t at = i + xs.size() * j;
      const double gx = (grid[at + 1] - grid[at - 1]) / (xs[i + 1] - xs[i - 1]);
      const double gy = (grid[at + xs.size()] - grid[at - xs.size()]) / (ys[j + 1] - ys[j - 1]);
      xx += gx * gx, xy += gx * gy, yy += gy * gy;
    }
  Wrinkles found;
  const double across = 0.5 * std::atan2(2 * xy, xx - yy);
  found.angle_deg = std::fmod(across * 180 / std::numbers::pi + 90 + 360, 180);

  const std::size_t middle = levelOf(ys, 0.5 * (ys.front() + ys.back()));
  for (std::size_t i = 0; i < xs.size(); ++i)
    if (inside(xs, i)) found.x.push_back(xs[i]), found.w.push_back(grid[i + xs.size() * middle]);
  const auto [low, high] = std::minmax_element(found.w.begin(), found.w.end());
  const std::vector<std::size_t> at = crests(found.w, prominence * (*high - *low), false);
  if (at.size() < 3) throw RunError(fmt::format("the middle line has {} crests: no wavelength", at.size()));
  found.wavelength = (found.x[at.back()] - found.x[at.front()]) / static_cast<double>(at.size() - 1) *
                     std::sin(found.angle_deg * std::numbers::pi / 180);
  return found;
}

}  // namespace gambeson::verify
