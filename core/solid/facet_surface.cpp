#include "core/solid/facet_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gambeson {
namespace {

/// How far beyond its edges a facet is taken to go on [its half width]: at the edge or corner that is nearest to the
/// point, and as one that faces the nearest.
constexpr double kBeyondOwn = 3, kBeyondFacing = 1.5;

using Candidate = FacetCandidate;

bool candidateOf(const FacetCorners& corners, int facet, const Vec3& p, double reach, Candidate& c) {
  const std::optional<Vec2> local = projectOnFacet(corners, p, reach);
  if (!local) return false;
  c.touch = {facet, *local, dot(facetPosition(corners, *local) - p, facetNormal(corners, *local))};
  c.normal = facetNormal(corners, {});
  c.center = facetPosition(corners, {});
  c.beyond = std::max(0.0, std::max(std::abs(local->x), std::abs(local->y)) - 1);
  return true;
}

/// Whether the facets face each other: each lies outside of the other, and they meet at an angle.
bool facing(const Candidate& a, const Candidate& b, double groove_rad) {
  const Vec3 way = b.center - a.center;
  const double angle = std::atan2(norm(cross(a.normal, b.normal)), dot(a.normal, b.normal));
  return angle > groove_rad && dot(a.normal, way) > 0 && dot(b.normal, way) < 0;
}

/// The angle between the edges of a facet at its corner k.
double cornerAngle(const FacetCorners& x, int k) {
  const Vec3 a = x[(k + 1) % 4] - x[k], b = x[(k + 3) % 4] - x[k];
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// As many boxes as there are spheres, at most, each at least as wide as the largest.
void sortIntoBoxes(FacetSurface::Spheres& s) {
  Vec3 high = s.low = s.center.empty() ? Vec3{} : s.center.front();
  bool finite = true;
  for (const Vec3& c : s.center) {
    finite = finite && std::isfinite(c.x + c.y + c.z);
    for (int d = 0; d < 3; ++d) s.low[d] = std::min(s.low[d], c[d]), high[d] = std::max(high[d], c[d]);
  }
  const int most = std::max(1, static_cast<int>(std::cbrt(static_cast<double>(s.center.size()))));
  const Vec3 extent = high - s.low;
  s.box_m = std::max({2 * s.largest_m, extent.x / most, extent.y / most, extent.z / most});
  const bool one = !finite || !(s.box_m > 0);
  if (one) s.box_m = 1;
  for (int d = 0; d < 3; ++d) s.boxes[d] = one ? 1 : static_cast<int>(extent[d] / s.box_m) + 1;
  const auto boxOf = [&](const Vec3& c) {
    return one ? 0 : s.boxOf(0, c.x) + s.boxes[0] * (s.boxOf(1, c.y) + s.boxes[1] * s.boxOf(2, c.z));
  };
  s.offsets.assign(s.boxes[0] * s.boxes[1] * s.boxes[2] + 1, 0);
  for (const Vec3& c : s.center) ++s.offsets[boxOf(c) + 1];
  for (std::size_t b = 1; b < s.offsets.size(); ++b) s.offsets[b] += s.offsets[b - 1];
  std::vector<int> next(s.offsets.begin(), s.offsets.end() - 1);
  s.facets.resize(s.center.size());
  for (int f = 0; f < static_cast<int>(s.center.size()); ++f) s.facets[next[boxOf(s.center[f])]++] = f;
}

}  // namespace

FacetSurface::FacetSurface(std::vector<Facet> facets, int nodes) : facets_(std::move(facets)) {
  checkFacets(facets_, nodes);
  std::vector<std::vector<int>> at(nodes);
  for (int f = 0; f < static_cast<int>(facets_.size()); ++f)
    for (const int node : facets_[f]) at[node].push_back(f);
  node_offsets_.push_back(0);
  for (int i = 0; i < nodes; ++i) {
    if (!at[i].empty()) nodes_.push_back(i);
    node_facets_.insert(node_facets_.end(), at[i].begin(), at[i].end());
    node_offsets_.push_back(static_cast<int>(node_facets_.size()));
  }
}

FacetCorners FacetSurface::corners(int facet, std::span<const Vec3> x) const {
  const Facet& f = facets_[facet];
  return {x[f[0]], x[f[1]], x[f[2]], x[f[3]]};
}

std::span<const int> FacetSurface::facetsAt(int node) const {
  return {node_facets_.data() + node_offsets_[node], node_facets_.data() + node_offsets_[node + 1]};
}

FacetSurface::Spheres FacetSurface::spheres(std::span<const Vec3> x) const {
  Spheres s;
  for (int f = 0; f < static_cast<int>(facets_.size()); ++f) {
    const FacetCorners c = corners(f, x);
    const Vec3 center = 0.25 * (c[0] + c[1] + c[2] + c[3]);
    double radius = 0;  // the facet lies in the hull of its corners
    for (const Vec3& v : c) radius = std::max(radius, norm(v - center));
    s.center.push_back(center);
    s.radius.push_back(radius);
    s.largest_m = std::max(s.largest_m, radius);
  }
  sortIntoBoxes(s);
  return s;
}

int FacetSurface::Spheres::boxOf(int axis, double at) const {
  const double box = (at - low[axis]) / box_m;
  return box > 0 ? static_cast<int>(std::min(box, boxes[axis] - 1.0)) : 0;
}

NearestFacet FacetSurface::nearest(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p,
                                   double reach_m) const {
  constexpr double kRounding = 1e-12;  // of a sphere's distance: it rules out what is farther for certain
  NearestFacet best;
  double best_m = reach_m;
  const auto ask = [&](int f) {
    const double away = norm(spheres.center[f] - p);
    if (away * (1 - kRounding) - spheres.radius[f] > best_m) return;
    const FacetPoint at = closestOnFacet(corners(f, x), p);
    const double distance = std::sqrt(at.dist2_m2);
    if (best.facet < 0) {
      if (distance > reach_m) return;
    } else if (at.dist2_m2 > best.at.dist2_m2 || (at.dist2_m2 == best.at.dist2_m2 && f > best.facet)) {
      return;
    }
    best = {f, at};
    best_m = distance;
  };
  const double far = (reach_m + spheres.largest_m) * (1 + 8 * kRounding);
  std::array<int, 3> from{}, to{};
  for (int d = 0; d < 3; ++d) {
    from[d] = spheres.boxOf(d, p[d] - far);
    to[d] = spheres.boxOf(d, p[d] + far);
  }
  for (int k = from[2]; k <= to[2]; ++k)
    for (int j = from[1]; j <= to[1]; ++j) {
      const int row = spheres.boxes[0] * (j + spheres.boxes[1] * k);
      for (int at = spheres.offsets[row + from[0]]; at < spheres.offsets[row + to[0] + 1]; ++at)
        ask(spheres.facets[at]);
    }
  return best;
}

std::vector<int> FacetSurface::facetsOf(const NearestFacet& nearest) const {
  if (nearest.at.feature == kFacetFace) return {nearest.facet};
  const Facet& f = facets_[nearest.facet];
  const int k = nearest.at.feature % 4;
  const std::span<const int> around = facetsAt(f[k]);
  if (nearest.at.feature < kFacetEdge) return {around.begin(), around.end()};
  std::vector<int> both;
  for (const int facet : around)
    if (std::count(facets_[facet].begin(), facets_[facet].end(), f[(k + 1) % 4]) > 0) both.push_back(facet);
  return both;
}

std::vector<FacetCandidate> FacetSurface::first(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p,
                                                const TouchOptions& options, int held) const {
  const NearestFacet near = nearest(x, spheres, p, options.reach_m);
  if (near.facet < 0) return {};
  std::vector<Candidate> own;
  Vec3 outward{};  // weighted by angles: its sign is right where the nearest feature is an edge or a corner
  for (const int facet : facetsOf(near)) {
    const FacetCorners c = corners(facet, x);
    double weight = 1;
    if (near.at.feature < kFacetEdge)
      weight = cornerAngle(c, static_cast<int>(std::find(facets_[facet].begin(), facets_[facet].end(),
                                                         facets_[near.facet][near.at.feature]) -
                                               facets_[facet].begin()));
    outward += weight * facetNormal(c, {});
    if (Candidate candidate; candidateOf(c, facet, p, kBeyondOwn, candidate)) own.push_back(candidate);
  }
  if (own.empty()) return {};
  const bool passed = dot(outward, near.at.position - p) > 0;
  const auto shallower = [](const Candidate& a, const Candidate& b) { return a.touch.gap_m < b.touch.gap_m; };
  // Beside a ridge the facet that is passed least; in a groove the one that is passed most goes first.
  const Candidate found = passed ? *std::max_element(own.begin(), own.end(), shallower)
                                 : *std::min_element(own.begin(), own.end(), shallower);
  if (Candidate kept;
      held >= 0 && held != found.touch.facet && candidateOf(corners(held, x), held, p, 1 + options.keep, kept) &&
      std::abs(kept.touch.gap_m) <= options.reach_m && dot(kept.normal - found.normal, found.center - kept.center) > 0)
    return {kept, found};
  return {found};
}

std::vector<FacetTouch> FacetSurface::touching(std::span<const Vec3> x, const Spheres& spheres, const Vec3& p,
                                               const TouchOptions& options, std::span<const int> held,
                                               HeldFacet after) const {
  std::vector<Candidate> taken;
  if (options.keep > 0 && after == HeldFacet::keeps)
    for (const int facet : held)
      if (Candidate c;
          candidateOf(corners(facet, x), facet, p, kBeyondOwn, c) && std::abs(c.touch.gap_m) <= options.reach_m)
        taken.push_back(c);
  if (taken.empty()) {
    taken = first(x, spheres, p, options, options.keep > 0 && !held.empty() ? held[0] : -1);
    if (taken.empty()) return {};
  }
  if (options.simultaneous) {
    std::vector<Candidate> others;
    std::vector<int> seen;
    for (const Candidate& t : taken) seen.push_back(t.touch.facet);
    const int middle = seen.front();
    for (const int node : facets_[middle])
      for (const int facet : facetsAt(node)) {
        if (std::count(seen.begin(), seen.end(), facet) > 0) continue;
        seen.push_back(facet);
        Candidate candidate;
        if (candidateOf(corners(facet, x), facet, p, kBeyondFacing, candidate)) others.push_back(candidate);
      }
    // Those that the point lies over first; of a ridge among them, the facet that is passed least.
    std::stable_sort(others.begin(), others.end(), [](const Candidate& a, const Candidate& b) {
      return a.beyond != b.beyond ? a.beyond < b.beyond : a.touch.gap_m < b.touch.gap_m;
    });
    for (const Candidate& other : others)
      if (std::all_of(taken.begin(), taken.end(),
                      [&](const Candidate& t) { return facing(t, other, options.groove_rad); }))
        taken.push_back(other);
  }
  std::vector<FacetTouch> touches;
  for (const Candidate& t : taken)
    if (std::abs(t.touch.gap_m) <= options.reach_m) touches.push_back(t.touch);
  return touches;
}

}  // namespace gambeson
