#include "human/skin/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/contact/contact_mesh.hpp"
#include "core/contact/crossing.hpp"
#include "human/body/skin.hpp"

namespace gambeson {
namespace {

constexpr double kOff_m = 1e-4;   ///< of the surface, where a point is asked for
constexpr double kSlab_m = 0.01;  ///< thickness of the slabs that triangles are sorted by

/// How many times the surface goes around a point: 0 outside. By a ray askew to the axes, so that it does not run along
/// edges of what is drawn along them; triangles are sorted by slabs that hold it.
class Winding {
 public:
  Winding(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x) : triangles_(triangles), x_(x) {
    const Mat3 R = rotationAbout({0.48, 0.6, 0.64}, 0.7);
    along_ = R.a;
    level_ = R.c;
    low_ = dot(level_, x.front());
    double high = low_;
    for (const Vec3& p : x) low_ = std::min(low_, dot(level_, p)), high = std::max(high, dot(level_, p));
    slabs_.resize(static_cast<std::size_t>((high - low_) / kSlab_m) + 1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto [a, b, c] = triangles[t];
      const double i = dot(level_, x[a]), j = dot(level_, x[b]), k = dot(level_, x[c]);
      for (std::size_t s = slab(std::min({i, j, k})), last = slab(std::max({i, j, k})); s <= last; ++s)
        slabs_[s].push_back(static_cast<int>(t));
    }
  }

  int operator()(const Vec3& p) const {
    const double h = dot(level_, p);
    if (h < low_ || slab(h) >= slabs_.size()) return 0;
    int turns = 0;
    for (const int t : slabs_[slab(h)]) {
      const auto [i, j, k] = triangles_[static_cast<std::size_t>(t)];
      const Vec3 a = x_[i] - p, b = x_[j] - p, c = x_[k] - p;
      const double u = dot(along_, cross(b, c)), v = dot(along_, cross(c, a)), w = dot(along_, cross(a, b));
      const bool out = u > 0 && v > 0 && w > 0, in = u < 0 && v < 0 && w < 0;
      if ((out || in) && dot(a, cross(b, c)) * (out ? 1 : -1) > 0) turns += out ? 1 : -1;
    }
    return turns;
  }

 private:
  std::size_t slab(double h) const { return static_cast<std::size_t>(std::max(0.0, (h - low_) / kSlab_m)); }
  const std::vector<std::array<int, 3>>& triangles_;
  std::span<const Vec3> x_;
  Vec3 along_, level_;
  double low_ = 0;
  std::vector<std::vector<int>> slabs_;
};

}  // namespace

Overlap overlapOf(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x) {
  Overlap out;
  out.triangles.assign(triangles.size(), 0);
  const ContactMesh mesh = contactMesh(static_cast<int>(x.size()), triangles);
  const std::vector<Crossing> crossings = findCrossings(mesh, x);
  if (crossings.empty()) return out;

  std::vector<std::vector<int>> neighbours(x.size());
  std::vector<Vec3> normal(x.size());
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      normal[t[k]] += cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
    }
  // Hidden vertices hang together with those of edges that pass through a triangle.
  const Winding winding(triangles, x);
  std::vector<char> seen(x.size(), 0), hidden(x.size(), 0);
  std::vector<int> ask;
  const auto push = [&](int v) {
    if (!seen[v]) seen[v] = 1, ask.push_back(v);
  };
  for (const Crossing& c : crossings) {
    out.triangles[c.triangle] = 1;
    for (const int v : mesh.edges[c.edge]) push(v);
  }
  while (!ask.empty()) {
    const int v = ask.back();
    ask.pop_back();
    const double size = norm(normal[v]);
    if (!(size > 0) || winding(x[v] + (kOff_m / size) * normal[v]) <= 0) continue;
    hidden[v] = 1;
    for (const int w : neighbours[v]) push(w);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    if (hidden[a] && hidden[b] && hidden[c]) out.triangles[t] = 1;
    if (out.triangles[t]) out.area_m2 += 0.5 * norm(cross(x[b] - x[a], x[c] - x[a]));
  }
  return out;
}

OverlapOfMotion overlapOf(const Human& human, const Motion& motion, double step_s) {
  const Skin& skin = *human.skin;
  OverlapOfMotion out;
  out.triangles.assign(skin.rest.triangles.size(), 0);
  std::vector<Vec3> x(skin.rest.vertices.size());
  out.instants = std::max(1, static_cast<int>(std::ceil(motion.duration() / step_s))) + 1;
  for (int i = 0; i < out.instants; ++i) {
    const double t = motion.duration() * i / (out.instants - 1);
    const Posture p = motion.at(t);
    skinPositions(skin, linkPoses(human.skeleton, p.q, p.root), x);
    const Overlap now = overlapOf(skin.rest.triangles, x);
    if (!(now.area_m2 > 0)) continue;
    ++out.folded;
    if (now.area_m2 > out.largest_m2) out.largest_m2 = now.area_m2, out.largest_time_s = t;
    for (std::size_t k = 0; k < now.triangles.size(); ++k) out.triangles[k] |= now.triangles[k];
  }
  std::set<int> parts;
  for (std::size_t k = 0; k < out.triangles.size(); ++k) {
    const auto [a, b, c] = skin.rest.triangles[k];
    const auto& r = skin.rest.vertices;
    if (out.triangles[k]) parts.insert({skin.segment[a], skin.segment[b], skin.segment[c]});
    if (out.triangles[k]) out.area_m2 += 0.5 * norm(cross(r[b] - r[a], r[c] - r[a]));
  }
  for (const int l : parts) out.links.push_back(human.skeleton.links[l].name);
  return out;
}

}  // namespace gambeson
