#pragma once
/// Curves through values at given times, with continuous velocity; and a motion made of them.

#include <vector>

#include "human/motion/motion.hpp"

namespace gambeson {

/// Slopes of the monotone cubic of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984), so that the curve never
/// leaves the range of neighbouring values; one-sided three-point slopes, limited likewise, at the ends. t ascends, at
/// least two values.
std::vector<double> monotoneSlopes(const std::vector<double>& t, const std::vector<double>& x);
/// Slopes of the cubic spline (C²) whose end slopes are those of the parabola through the three outermost values.
std::vector<double> splineSlopes(const std::vector<double>& t, const std::vector<double>& x);

/// One value of a posture over time.
struct MotionColumn {
  int joint = -1;  ///< -1: of the root
  int root = 0;    ///< 0, 1, 2: x, y, z [m]; 3, 4, 5: roll, pitch, yaw [rad]
  std::vector<double> x, slope;
};

/// The rotation Rz(yaw) Ry(pitch) Rx(roll), and the angles (roll, pitch, yaw) of a rotation; |pitch| <= pi / 2.
Mat3 rotationOf(const Vec3& roll_pitch_yaw);
Vec3 anglesOf(const Mat3& rotation);

/// Cubic Hermite curves through the columns; what no column names stays as in `rest`. times[0] is 0.
std::unique_ptr<Motion> makeSampledMotion(std::vector<double> times, std::vector<MotionColumn> columns, Posture rest);

}  // namespace gambeson
