#pragma once
/// A leg that reaches from its hip to a given ankle: inverse kinematics in closed form, in a plane that contains x.

#include <array>
#include <optional>
#include <string>

#include "human/motion/motion.hpp"

namespace gambeson {

/// Flexion, adduction and rotation of the hip; knee; ankle [rad], with the signs of human/manikin/manikin.hpp.
using LegAngles = std::array<double, 5>;

/// The joints of a leg, in the order of LegAngles, and its lengths.
struct Leg {
  std::array<int, 5> joints{};
  Vec3 hip_P, knee_T, ankle_S;  ///< joint centres in the frames of pelvis, thigh and shank [m]
  const BodyShape* foot = nullptr;

  double length_m() const;  ///< of thigh and shank
  LegAngles anglesOf(const Posture& posture) const;
  void set(const LegAngles& angles, Posture& posture) const;
};

/// The leg of a side ("right", "left"); points into `human`. Throws InputError where a joint or the foot's ellipsoid is
/// missing, or where the three joints of the hip do not meet in one point across each other; `what` needs the leg.
Leg legOf(const Human& human, const std::string& side, const std::string& what);

/// Orientation of the foot of a leg from `hip_W` to `ankle_W` whose sole is pitched by `pitch` (toes up +): thigh,
/// shank and foot lie in the plane through hip, ankle and the world's x, so a level foot points along x and rolls with
/// the plane. The ankle is not straight ahead of the hip.
Mat3 footRotation(const Vec3& hip_W, const Vec3& ankle_W, double pitch);

/// The angles with which the ankle is at `ankle_W` and the foot has footRotation, the knee bent forward; none where the
/// leg is too short. Thigh and shank as two links in the plane: cosine rule. Exact for legs whose knee and ankle turn
/// about y and whose centres lie in the plane y = 0 of thigh and shank; where bones lean out of that plane, as those of
/// characters do by millimetres, the foot is as far beside `ankle_W` as they do.
std::optional<LegAngles> reach(const Human& human, const Leg& leg, const Pose& pelvis, const Vec3& ankle_W,
                               double pitch);

}  // namespace gambeson
