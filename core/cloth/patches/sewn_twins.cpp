#include "core/cloth/patches/sewn_twins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/cloth/draft/sewn_length.hpp"

namespace gambeson {
namespace {

constexpr double kOn = 0.1;     ///< of the spacing of samples: on the seam
constexpr double kSame = 1e-6;  ///< of the length: at one fraction
constexpr int kLooksPerCell = 8;

/// Samples on one side of a seam: fraction of its length, ascending, and sample.
using Stations = std::vector<std::pair<double, int>>;

Vec3 restPoint(const Garment& g, int patch, Vec2 uv) {
  return surfaceDerivatives(g.patches[static_cast<std::size_t>(patch)], uv.x, uv.y)[0];
}

/// Rest positions and spacing of the samples on the borders of the triangles.
struct Borders {
  std::vector<int> sample;
  std::vector<Vec3> X;
  std::vector<double> spacing_m;  ///< of each, to the nearest on the border

  Borders(const Garment& g, const Surface& s) {
    std::map<std::array<int, 2>, int> faces;
    for (const auto& t : s.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto [v, w] = std::minmax(t[static_cast<std::size_t>(k)], t[static_cast<std::size_t>((k + 1) % 3)]);
        ++faces[{v, w}];
      }
    std::map<int, double> nearest;
    const auto rest = [&](int i) {
      return restPoint(g, s.patch[static_cast<std::size_t>(i)], s.parameters[static_cast<std::size_t>(i)]);
    };
    for (const auto& [edge, count] : faces) {
      if (count != 1) continue;
      const double length = norm(rest(edge[1]) - rest(edge[0]));
      for (const int v : edge) {
        const auto at = nearest.try_emplace(v, length).first;
        at->second = std::min(at->second, length);
      }
    }
    for (const auto& [v, length] : nearest) {
      sample.push_back(v);
      X.push_back(rest(v));
      spacing_m.push_back(length);
    }
  }
};

/// The samples of a seam's side. A dart's corner may be at two of its fractions.
Stations stationsOf(const Garment& g, const Surface& s, const Borders& borders, const SewnEdge& edge) {
  const SewnLength length(g, edge, "sewn_seams");
  const int looks = std::max(16, static_cast<int>(std::ceil(kLooksPerCell * length.cells())));
  std::vector<SewnPoint> point;
  std::vector<Vec3> x;
  for (int k = 0; k <= looks; ++k) {
    point.push_back(length.at(static_cast<double>(k) / looks));
    x.push_back(restPoint(g, point.back().patch, point.back().uv));
  }
  const double step_m = length.length_m() / looks;
  Stations out;
  for (std::size_t i = 0; i < borders.sample.size(); ++i) {
    const int patch = s.patch[static_cast<std::size_t>(borders.sample[i])];
    const auto distance = [&](double at) {
      const SewnPoint p = length.at(at);
      return p.patch == patch ? norm(restPoint(g, p.patch, p.uv) - borders.X[i])
                              : std::numeric_limits<double>::infinity();
    };
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= looks; ++k)
      if (point[static_cast<std::size_t>(k)].patch == patch)
        if (const double d = norm(x[static_cast<std::size_t>(k)] - borders.X[i]); d < least) least = d, nearest = k;
    if (nearest < 0 || least > 2 * step_m + borders.spacing_m[i]) continue;
    double low = std::max(0.0, (nearest - 1.0) / looks), high = std::min(1.0, (nearest + 1.0) / looks);
    for (int k = 0; k < 60 && high - low > 1e-12; ++k) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (distance(a) <= distance(b) ? high : low) = distance(a) <= distance(b) ? b : a;
    }
    double at = 0.5 * (low + high);
    for (const double other : {low, high})  // where parts meet, the middle may be on the next panel
      if (distance(other) < distance(at)) at = other;
    if (distance(at) <= kOn * borders.spacing_m[i]) out.push_back({at, borders.sample[i]});
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// The places in `of` between which a fraction lies; all at it where there are such.
std::pair<std::size_t, std::size_t> around(const Stations& of, double at) {
  const auto below = [](const std::pair<double, int>& s, double f) { return s.first < f; };
  std::size_t first = static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), at - kSame, below) - of.begin());
  std::size_t end = static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), at + kSame, below) - of.begin());
  if (first == end) {
    if (first > 0) --first;
    if (end < of.size()) ++end;
  }
  return {first, end};
}

}  // namespace

std::vector<std::array<int, 2>> sewnTwins(const Garment& g, const Surface& s) {
  std::set<std::array<int, 2>> pairs;
  const auto add = [&](int v, int w) {
    if (v != w) pairs.insert({std::min(v, w), std::max(v, w)});
  };
  if (std::all_of(g.sewn_seams.begin(), g.sewn_seams.end(),
                  [](const SewnSeam& seam) { return seam.hold == SeamHold::open; }))
    return {};
  const Borders borders(g, s);
  std::map<int, std::set<int>> ends;  // of samples at ends of seams, those that lie on them
  for (const SewnSeam& seam : g.sewn_seams) {
    if (seam.hold == SeamHold::open) continue;
    const Stations a = stationsOf(g, s, borders, seam.a), b = stationsOf(g, s, borders, seam.b);
    for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)})
      for (const auto& [at, sample] : *from) {
        const auto [first, end] = around(*to, at);
        for (std::size_t k = first; k < end; ++k) {
          add(sample, (*to)[k].second);
          if (std::abs((*to)[k].first - at) < kSame) ends[sample].insert((*to)[k].second);
        }
      }
  }
  // Samples that lie on each other through others: corners of three panels and more.
  for (const auto& [start, direct] : ends) {
    std::set<int> reached{start};
    std::vector<int> open{start};
    while (!open.empty()) {
      const int v = open.back();
      open.pop_back();
      if (const auto at = ends.find(v); at != ends.end())
        for (const int w : at->second)
          if (reached.insert(w).second) open.push_back(w);
    }
    for (const int w : reached) add(start, w);
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace gambeson
