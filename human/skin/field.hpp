#pragma once
/// The body as a smooth implicit function: negative inside, about the distance to the skin near it.

#include <vector>

#include "core/math/vec.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// Smooth minimum, C²: min(a, b) - max(k - |a - b|, 0)³/(6 k²). At a = b it lies k/6 below.
double smoothMin(double a, double b, double k);

/// A tube along z with elliptic sections, closed by half ellipsoids. Semi-axes and centres run through the stations as
/// monotone cubics (Fritsch and Carlson 1980).
class Loft {
 public:
  struct Station {
    double z, cx, cy, a, b;  ///< centre and semi-axes along x and y [m]
  };
  /// Stations by ascending z; `low`, `high`: heights of the closing half ellipsoids.
  Loft(const Pose& X_WF, std::vector<Station> stations, double low, double high);
  double operator()(const Vec3& x_W) const;

 private:
  Pose X_FW_;
  std::vector<Station> at_, slope_;
  double low_, high_;
};

/// A cone between two spheres, with them.
struct RoundCone {
  Vec3 a, b;
  double ra = 0, rb = 0;
  double operator()(const Vec3& x) const;
};

/// An ellipsoid in a frame.
struct FramedEllipsoid {
  Pose X_FW;
  Vec3 semi;
  double operator()(const Vec3& x_W) const;
};

/// Symmetric in y. Frame: the world with the pelvis in it at `link_poses`.
class BodyField {
 public:
  BodyField(const Human& human, std::span<const Pose> link_poses);
  double operator()(const Vec3& x) const;
  Vec3 gradient(const Vec3& x) const;
  Vec3 low() const { return low_; }
  Vec3 high() const { return high_; }
  /// 0 where garments lie, growing to 1 on the head, less on feet and hands, which are thin.
  double coarseness(const Vec3& x) const;
  /// How much nearer a point of the surface is to the arm of its side than to the rest [m]; negative off the arm.
  double towardsArm(const Vec3& x) const;
  /// How much nearer to the left leg than to the right [m].
  double towardsLeftLeg(const Vec3& x) const;

 private:
  struct Parts;
  double side(const Vec3& x) const;  ///< leg of the left side
  double withoutArms(const Vec3& x) const;
  double arm(const Vec3& x) const;
  std::shared_ptr<const Parts> parts_;
  Vec3 low_, high_;
};

}  // namespace gambeson
