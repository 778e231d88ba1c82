#include "tryon/pattern/form.hpp"

#include <algorithm>
#include <cmath>

#include "human/body/skin.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/check.hpp"

namespace gambeson {
namespace {

bool isOf(const Links& of, int link) { return std::find(of.begin(), of.end(), link) != of.end(); }

/// Leans by `lean` about x (form.hpp), then x, y, z become z, x, y: a cut at constant y becomes a level, whose points
/// are (z, x).
Placement turned(const Placement& X, double lean) {
  const auto cycle = [lean](const Vec3& v) {
    const Vec3 w = leaned(v, lean);
    return Vec3{w.z, w.x, w.y};
  };
  return {{cycle(X.rotation.a), cycle(X.rotation.b), cycle(X.rotation.c)}, cycle(X.origin), X.scale};
}

}  // namespace

BodyForm::BodyForm(const Human& human) : BodyForm(human, human.shapes.empty() ? Posture{} : standing(human)) {}

BodyForm::BodyForm(const Human& human, const Posture& posture) : human_(human) {
  if (human.shapes.empty()) return;  // no surface: links() names what is missing, or hull()
  const std::vector<Pose> links = linkPoses(human.skeleton, posture.q, posture.root);
  for (const Pose& X : links) origin_.push_back(X.origin);
  placements_ = placementsOf(human, links);
  median_y_ = posture.root.origin.y;
  if (!human.skin) return;
  skin_ = human.skin->rest;
  segment_ = human.skin->segment;
  skinPositions(*human.skin, links, skin_.vertices);
}

BodyForm::BodyForm(const Human& human, TriangleMesh skin, std::vector<int> segment) : BodyForm(human) {
  if (segment.size() != skin.vertices.size())
    reject("skin",
           std::to_string(segment.size()) + " segments for " + std::to_string(skin.vertices.size()) + " vertices");
  skin_ = std::move(skin);
  segment_ = std::move(segment);
}

Links BodyForm::links(std::span<const char* const> names, const char* key) const {
  Links out;
  for (const char* name : names) {
    out.push_back(human_.skeleton.link(name));
    if (out.back() < 0) reject(key, std::string("needs a human with the link ") + name);
  }
  return out;
}

Vec3 leaned(const Vec3& x, double lean_rad) {
  const double c = std::cos(lean_rad), s = std::sin(lean_rad);
  return {x.x, c * x.y - s * x.z, s * x.y + c * x.z};
}

std::vector<Vec2> BodyForm::cut(double at, const Links& of, const double* lean) const {
  std::vector<Vec2> out;
  const auto add = [&](const Shape& shape, const Placement& X) {
    for (const Vec2& p : crossSection(shape, lean ? turned(X, *lean) : X, at)) out.push_back(lean ? Vec2{p.y, p.x} : p);
  };
  if (segment_.empty()) {
    for (std::size_t i = 0; i < human_.shapes.size(); ++i)
      if (isOf(of, human_.shapes[i].link)) add(human_.shapes[i].shape, placements_[i]);
    return out;
  }
  add(skinOf(of), Placement{});
  return out;
}

TriangleMesh BodyForm::skinOf(const Links& of) const {
  TriangleMesh part;
  part.vertices = skin_.vertices;
  for (const auto& t : skin_.triangles)
    if (isOf(of, segment_[t[0]]) && isOf(of, segment_[t[1]]) && isOf(of, segment_[t[2]])) part.triangles.push_back(t);
  return part;
}

std::vector<Vec2> BodyForm::across(const Pose& X_FW, double at, const Links& of) const {
  const auto moved = [&](const Placement& X) {
    return Placement{X_FW.rotation * X.rotation, X_FW * X.origin, X.scale};
  };
  if (!segment_.empty()) return crossSection(Shape{skinOf(of)}, moved({}), at);
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < human_.shapes.size(); ++i)
    if (isOf(of, human_.shapes[i].link))
      for (const Vec2& p : crossSection(human_.shapes[i].shape, moved(placements_[i]), at)) out.push_back(p);
  return out;
}

std::vector<Vec2> BodyForm::level(double z, const Links& of) const { return cut(z, of, nullptr); }
std::vector<Vec2> BodyForm::profile(double y, const Links& of, double lean_rad) const { return cut(y, of, &lean_rad); }

double BodyForm::lowest(const Links& of) const {
  double lowest = HUGE_VAL;
  for (std::size_t v = 0; v < segment_.size(); ++v)
    if (isOf(of, segment_[v])) lowest = std::min(lowest, skin_.vertices[v].z);
  if (!segment_.empty()) return lowest;
  for (std::size_t i = 0; i < human_.shapes.size(); ++i) {
    if (!isOf(of, human_.shapes[i].link)) continue;
    const Placement& X = placements_[i];
    if (const auto* e = std::get_if<Ellipsoid>(&human_.shapes[i].shape)) {
      const Vec3 up = transposeTimes(X.rotation, {0, 0, 1});
      const Vec3 a{e->semi_axes.x * up.x, e->semi_axes.y * up.y, e->semi_axes.z * up.z};
      lowest = std::min(lowest, X.origin.z - X.scale * norm(a));
    } else {
      for (const Vec3& v : std::get<TriangleMesh>(human_.shapes[i].shape).vertices)
        lowest = std::min(lowest, (X * v).z);
    }
  }
  return lowest;
}

std::vector<Vec2> BodyForm::hull(double z, const Links& of, bool mirrored, const char* key) const {
  std::vector<Vec2> points = level(z, of);
  if (mirrored)
    for (std::size_t i = 0, n = points.size(); i < n; ++i) points.push_back({points[i].x, 2 * median_y_ - points[i].y});
  std::vector<Vec2> out = convexHull(std::move(points));
  if (out.size() < 3)
    reject(key, "reaches the height " + std::to_string(z) + " m, where the body has no cross-section");
  return out;
}

Wrap BodyForm::wrap(double from, double to, const Links& of, const char* key, int heights) const {
  std::vector<std::vector<Vec2>> cross_sections;
  for (int k = 0; k < heights; ++k)
    cross_sections.push_back(hull(from + (to - from) * k / (heights - 1), of, true, key));
  return Wrap(cross_sections, from, to);
}

}  // namespace gambeson
