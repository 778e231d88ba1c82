#include "human/body/segment_ellipsoid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double shortest_m = 1e-3;
constexpr double nearest_of_length = 1e-3;

bool finite(const Vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

}  // namespace

Pose segmentPose(const Vec3& J1, const Vec3& J2, const Vec3& M, const std::string& name) {
  const InputError::Where where{"", 0, name};
  if (!finite(J1) || !finite(J2) || !finite(M)) throw InputError(where, "a joint or the marker is not known");
  const double length = norm(J2 - J1);
  if (!(length >= shortest_m))
    throw InputError(
        where, fmt::format("the joints are {:.3g} m from each other; allowed: at least {} m", length, shortest_m));
  const Vec3 centre = 0.5 * (J1 + J2), e1 = (J2 - J1) / length, beside = (M - centre) - dot(M - centre, e1) * e1;
  const double distance = norm(beside);
  if (!(distance >= nearest_of_length * length))
    throw InputError(where, fmt::format("the marker is {:.3g} m from the line through the joints; allowed: at least "
                                        "{:.3g} m, a thousandth of their distance",
                                        distance, nearest_of_length * length));
  const Vec3 e2 = beside / distance;
  return {{e1, e2, cross(e1, e2)}, centre};
}

std::vector<Pose> segmentPoses(const SegmentCourse& s) {
  if (s.J1.size() != s.J2.size() || s.J1.size() != s.M.size())
    throw InputError({"", 0, s.name}, fmt::format("has {} and {} positions of joints and {} of the marker", s.J1.size(),
                                                  s.J2.size(), s.M.size()));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < s.J1.size(); ++i) {
    const Pose X = segmentPose(s.J1[i], s.J2[i], s.M[i], fmt::format("{}[{}]", s.name, i));
    if (i > 0 && (dot(X.rotation.b, poses.back().rotation.b) < 0 || dot(X.rotation.c, poses.back().rotation.c) < 0))
      throw InputError({"", 0, fmt::format("{}[{}]", s.name, i)},
                       "turns by more than a quarter turn from one instant to the next; allowed: a marker that stays "
                       "on its side of the bone");
    poses.push_back(X);
  }
  return poses;
}

}  // namespace gambeson
