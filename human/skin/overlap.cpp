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

/// Unit vectors out of the surface at its vertices, by the areas of the triangles around them; 0 where these cancel.
std::vector<Vec3> outwardAt(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x) {
  std::vector<Vec3> normal(x.size());
  for (const auto& t : triangles)
    for (const int v : t) normal[v] += cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
  for (Vec3& n : normal)
    if (const double size = norm(n); size > 0) n = n / size;
  return normal;
}

}  // namespace

double areaOf(const std::vector<char>& which, const std::vector<std::array<int, 3>>& triangles,
              std::span<const Vec3> x) {
  double area = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    const auto [a, b, c] = triangles[k];
    if (which[k]) area += 0.5 * norm(cross(x[b] - x[a], x[c] - x[a]));
  }
  return area;
}

OverlapSearch::OverlapSearch(std::vector<std::array<int, 3>> triangles, int vertices)
    : triangles_(std::move(triangles)), mesh_(contactMesh(vertices, triangles_)) {}

Overlap OverlapSearch::at(std::span<const Vec3> x, double room_m, std::span<const char> among) {
  std::vector<Vec3> grown(x.begin(), x.end());
  const std::vector<Vec3> out = outwardAt(triangles_, x);
  if (room_m > 0)
    for (std::size_t v = 0; v < grown.size(); ++v) grown[v] += 0.5 * room_m * out[v];
  Overlap o;
  o.triangles.assign(triangles_.size(), 0);
  // Hidden vertices hang together with those of edges that pass through a triangle.
  std::vector<int> ask;
  std::vector<char> seen(grown.size(), 0), hidden(grown.size(), 0);
  const auto push = [&](int v) {
    if (!seen[v]) seen[v] = 1, ask.push_back(v);
  };
  const auto take = [&](const ContactMesh& mesh, const std::vector<Crossing>& crossings, auto&& number) {
    for (const Crossing& c : crossings) {
      o.triangles[number(c.triangle)] = 1;
      for (const int v : mesh.edges[c.edge]) push(v);
    }
  };
  if (among.empty()) {
    const std::vector<Box> boxes = triangleBoxes(mesh_, grown);
    if (tree_.empty())
      tree_ = BoundingTree(boxes);
    else
      tree_.refit(boxes);
    take(mesh_, findCrossings(mesh_, grown, tree_), [](int t) { return t; });
  } else {
    std::vector<int> number;
    std::vector<std::array<int, 3>> some;
    for (std::size_t t = 0; t < among.size(); ++t)
      if (among[t]) number.push_back(static_cast<int>(t)), some.push_back(triangles_[t]);
    const ContactMesh mesh = contactMesh(mesh_.vertex_count, some);
    take(mesh, findCrossings(mesh, grown), [&](int t) { return number[t]; });
  }
  if (ask.empty()) return o;
  // Normals of what has grown: they say where its outside is.
  const std::vector<Vec3> normal = room_m > 0 ? outwardAt(triangles_, grown) : out;
  const Winding winding(triangles_, grown);
  while (!ask.empty()) {
    const int v = ask.back();
    ask.pop_back();
    if (normal[v] == Vec3{} || winding(grown[v] + kOff_m * normal[v]) <= 0) continue;
    hidden[v] = 1;
    for (const int e : mesh_.vertex_edges[v])
      for (const int w : mesh_.edges[e]) push(w);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto [a, b, c] = triangles_[t];
    if (hidden[a] && hidden[b] && hidden[c]) o.triangles[t] = 1;
  }
  o.area_m2 = areaOf(o.triangles, triangles_, x);
  return o;
}

Overlap overlapOf(const std::vector<std::array<int, 3>>& triangles, std::span<const Vec3> x, double room_m) {
  return OverlapSearch(triangles, static_cast<int>(x.size())).at(x, room_m);
}

std::vector<std::string> linksOf(const std::vector<char>& triangles, const Human& human) {
  const Skin& skin = *human.skin;
  std::set<int> parts;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    const auto [a, b, c] = skin.rest.triangles[k];
    if (triangles[k]) parts.insert({skin.segment[a], skin.segment[b], skin.segment[c]});
  }
  std::vector<std::string> names;
  for (const int l : parts) names.push_back(human.skeleton.links[l].name);
  return names;
}

OverlapOfMotion overlapOf(const Human& human, const Motion& motion, double step_s) {
  const Skin& skin = *human.skin;
  OverlapOfMotion out;
  out.triangles.assign(skin.rest.triangles.size(), 0);
  std::vector<Vec3> x(skin.rest.vertices.size());
  OverlapSearch search(skin.rest.triangles, static_cast<int>(x.size()));
  out.instants = std::max(1, static_cast<int>(std::ceil(motion.duration() / step_s))) + 1;
  for (int i = 0; i < out.instants; ++i) {
    const double t = motion.duration() * i / (out.instants - 1);
    const Posture p = motion.at(t);
    skinPositions(skin, linkPoses(human.skeleton, p.q, p.root), x);
    const Overlap now = search.at(x, 0);
    if (!(now.area_m2 > 0)) continue;
    ++out.folded;
    if (now.area_m2 > out.largest_m2) out.largest_m2 = now.area_m2, out.largest_time_s = t;
    for (std::size_t k = 0; k < now.triangles.size(); ++k) out.triangles[k] |= now.triangles[k];
  }
  out.area_m2 = areaOf(out.triangles, skin.rest.triangles, skin.rest.vertices);
  out.links = linksOf(out.triangles, human);
  return out;
}

}  // namespace gambeson
