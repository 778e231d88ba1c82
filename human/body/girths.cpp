#include "human/body/girths.hpp"

#include <algorithm>

#include "human/body/section.hpp"
#include "human/body/skin.hpp"

namespace gambeson {
namespace {

bool isOf(const std::vector<int>& links, int link) {
  return std::find(links.begin(), links.end(), link) != links.end();
}

/// One end of a piece: a share of the way from one vertex to another.
struct CutEdge {
  std::size_t a = 0, b = 0;
  double share = 0;

  Vec3 of(std::span<const Vec3> x) const { return x[a] + share * (x[b] - x[a]); }
  std::array<int, 2> key() const { return {static_cast<int>(std::min(a, b)), static_cast<int>(std::max(a, b))}; }
};

/// Calls f with both ends of each piece where a plane cuts triangles.
template <class F>
void forCuts(const GirthPlane& p, std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles, F f) {
  const Vec3 n = cross(p.e1, p.e2);
  for (const auto& t : triangles) {
    std::array<CutEdge, 2> ends{};
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(t[k]), j = static_cast<std::size_t>(t[(k + 1) % 3]);
      const double a = dot(n, x[i] - p.origin), b = dot(n, x[j] - p.origin);
      if ((a < 0) == (b < 0) || found == 2) continue;
      ends[found++] = {i, j, a / (a - b)};
    }
    if (found == 2) f(ends[0], ends[1]);
  }
}

Vec2 inPlane(const GirthPlane& p, const Vec3& x) { return {dot(x - p.origin, p.e1), dot(x - p.origin, p.e2)}; }

}  // namespace

std::vector<GirthPlane> girthPlanes(const Human& human, std::span<const Pose> X) {
  const Skeleton& s = human.skeleton;
  std::vector<GirthPlane> planes;
  const auto pose = [&](int link) -> const Pose& { return X[static_cast<std::size_t>(link)]; };
  const auto add = [&](const std::string& zone, int link, double z, std::vector<int> links) {
    const Mat3& R = pose(link).rotation;
    planes.push_back({zone, pose(link) * Vec3{0, 0, z}, R.a, R.b, std::move(links)});
  };
  const int pelvis = s.link("pelvis"), torso = s.link("torso"), head = s.link("head"), right = s.link("thigh_right"),
            left = s.link("thigh_left");
  if (pelvis >= 0 && right >= 0 && left >= 0) {
    add("hip", pelvis, 0, {pelvis, right, left});
    // The pelvis's origin lies between the hip joints in our own skeletons; elsewhere its place is another.
    planes.back().origin = 0.5 * (pose(right).origin + pose(left).origin);
  }
  if (pelvis >= 0 && torso >= 0 && head >= 0) {
    const double trunk = norm(pose(head).origin - pose(torso).origin);
    add("waist", torso, kWaistShare * trunk, {pelvis, torso});
    add("chest", torso, kChestShare * trunk, {pelvis, torso});
  }
  for (const char* side : {"_left", "_right"}) {
    const auto along = [&](const char* upper, const char* lower, double share) {
      const int a = s.link(std::string(upper) + side), b = s.link(std::string(lower) + side);
      if (a >= 0 && b >= 0) add(std::string(upper) + side, a, -share * norm(pose(b).origin - pose(a).origin), {a});
    };
    along("thigh", "shank", kThighShare);
    along("upper_arm", "forearm", kUpperArmShare);
  }
  return planes;
}

std::vector<std::array<Vec2, 2>> cutPieces(const GirthPlane& p, std::span<const Vec3> x,
                                           std::span<const std::array<int, 3>> triangles) {
  std::vector<std::array<Vec2, 2>> out;
  forCuts(p, x, triangles, [&](const CutEdge& a, const CutEdge& b) {
    out.push_back({inPlane(p, a.of(x)), inPlane(p, b.of(x))});
  });
  return out;
}

std::vector<ClothPiece> cutCloth(const GirthPlane& p, std::span<const Vec3> x, std::span<const Vec3> rest,
                                 std::span<const std::array<int, 3>> triangles) {
  std::vector<ClothPiece> out;
  forCuts(p, x, triangles, [&](const CutEdge& a, const CutEdge& b) {
    out.push_back({{inPlane(p, a.of(x)), inPlane(p, b.of(x))}, {a.key(), b.key()}, norm(b.of(rest) - a.of(rest))});
  });
  return out;
}

std::vector<Vec2> bodySection(const Human& human, const GirthPlane& p, std::span<const Pose> X,
                              std::span<const Vec3> skin_x) {
  std::vector<Vec2> points;
  if (!human.skin) {
    // In the plane's frame it is the level at 0.
    const Pose X_PW = inverse(Pose{{p.e1, p.e2, cross(p.e1, p.e2)}, p.origin});
    for (const BodyShape& shape : human.shapes) {
      if (!isOf(p.links, shape.link)) continue;
      const Pose X_PS = X_PW * (X[static_cast<std::size_t>(shape.link)] * shape.X_LS);
      for (const Vec2& c : crossSection(shape.shape, {X_PS.rotation, X_PS.origin, 1}, 0)) points.push_back(c);
    }
    return points;
  }
  std::vector<std::array<int, 3>> mine;
  for (const auto& t : human.skin->rest.triangles) {
    int of = 0;
    for (const int v : t) of += isOf(p.links, human.skin->segment[static_cast<std::size_t>(v)]) ? 1 : 0;
    if (of >= 2) mine.push_back(t);
  }
  for (const auto& piece : cutPieces(p, skin_x, mine)) points.insert(points.end(), piece.begin(), piece.end());
  return points;
}

}  // namespace gambeson
