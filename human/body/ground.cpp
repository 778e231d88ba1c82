#include "human/body/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace gambeson {

Vec3 lowestPoint(const Shape& shape, const Mat3& R_WS) {
  const Vec3 down = transposeTimes(R_WS, {0, 0, -1});
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) {
    const Vec3 a = e->semi_axes, ad{a.x * down.x, a.y * down.y, a.z * down.z};
    return Vec3{a.x * ad.x, a.y * ad.y, a.z * ad.z} / norm(ad);
  }
  const auto& mesh = std::get<TriangleMesh>(shape);
  Vec3 lowest = mesh.vertices.front();
  for (const Vec3& v : mesh.vertices)
    if (dot(v, down) > dot(lowest, down)) lowest = v;
  return lowest;
}

double lowestHeight(const Human& human, std::span<const Pose> link_poses) {
  double z = std::numeric_limits<double>::infinity();
  for (const BodyShape& s : human.shapes) {
    const Pose X_WS = link_poses[s.link] * s.X_LS;
    z = std::min(z, (X_WS * lowestPoint(s.shape, X_WS.rotation)).z);
  }
  return z;
}

double Stairs::heightAt(double x) const {
  return x < first_edge_m ? 0 : (1 + std::floor((x - first_edge_m) / tread_m)) * rise_m;
}

const BodyShape& footOf(const Human& human, const std::string& side, const std::string& what) {
  const std::string name = "ankle_flexion_" + side;
  const int j = human.skeleton.joint(name);
  if (j < 0) throw InputError({"", 0, "human"}, what + " needs the joint '" + name + "'");
  const int link = human.skeleton.joints[j].child;
  for (const BodyShape& shape : human.shapes)
    if (shape.link == link && std::holds_alternative<Ellipsoid>(shape.shape)) return shape;
  throw InputError({"", 0, "human"},
                   what + " needs an ellipsoid on the link '" + human.skeleton.links[link].name + "'");
}

namespace {

/// The smallest n . x of a shape.
double reach(const Shape& shape, const Pose& X, const Vec3& n) {
  const Vec3 l = transposeTimes(X.rotation, n);
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) {
    const Vec3 a = e->semi_axes;
    return dot(n, X.origin) - norm({a.x * l.x, a.y * l.y, a.z * l.z});
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& v : std::get<TriangleMesh>(shape).vertices) least = std::min(least, dot(l, v));
  return dot(n, X.origin) + least;
}

}  // namespace

double gapTo(const Shape& shape, const Pose& X, const std::optional<Stairs>& stairs, int* nearest) {
  double gap = reach(shape, X, {0, 0, 1});
  if (nearest) *nearest = 0;
  if (!stairs) return gap;
  const double front = -reach(shape, X, {-1, 0, 0});
  const int last = static_cast<int>(std::floor((front - stairs->first_edge_m) / stairs->tread_m)) + 2;
  constexpr int directions = 45;
  for (int k = 1; k <= last; ++k) {
    const double x = stairs->first_edge_m + (k - 1) * stairs->tread_m, z = k * stairs->rise_m;
    double own = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= directions; ++i) {
      const double a = 0.5 * M_PI * i / directions;
      const Vec3 n{-std::sin(a), 0, std::cos(a)};  // away from the step
      own = std::max(own, reach(shape, X, n) - (n.x * x + n.z * z));
    }
    if (own < gap) {
      gap = own;
      if (nearest) *nearest = k;
    }
  }
  return gap;
}

double gapToHurdle(const Shape& shape, const Pose& X, const Hurdle& hurdle) {
  constexpr int directions = 360;
  double gap = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= directions; ++i) {
    const double a = M_PI * (static_cast<double>(i) / directions - 0.5);
    const Vec3 n{std::sin(a), 0, std::cos(a)};  // away from the hurdle
    const double x = hurdle.front_m + (n.x > 0 ? hurdle.depth_m : 0);
    gap = std::max(gap, reach(shape, X, n) - (n.x * x + n.z * hurdle.height_m));
  }
  return gap;
}

}  // namespace gambeson
