#include "human/motion/rolling_foot.hpp"

#include <cassert>

#include "human/body/ground.hpp"

namespace gambeson {

std::vector<Vec3> rolledAnkles(const Leg& leg, const std::vector<Pose>& pelvis, const std::vector<FootGoal>& goals,
                               Vec3 ankle) {
  assert(pelvis.size() == goals.size());
  const Pose& X_LS = leg.foot->X_LS;
  const auto rotationAt = [&](std::size_t i, const Vec3& at) {
    return footRotation(pelvis[i] * leg.hip_P, at, goals[i].pitch);
  };
  const auto lowest = [&](const Mat3& R) { return X_LS * lowestPoint(leg.foot->shape, R * X_LS.rotation); };
  std::vector<Vec3> ankles;
  Pose last;
  Vec3 last_low;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Vec3 carried = i == 0 ? Vec3{} : goals[i].way - goals[i - 1].way;
    // The foot's roll depends on the ankle by some hundredths, so this contracts.
    constexpr int rounds = 50;
    Vec3 at = ankle + carried, before;
    Pose now;
    Vec3 low;
    for (int k = 0; k < rounds && norm(at - before) > 1e-14; ++k) {
      before = at;
      now.rotation = rotationAt(i, at);
      low = lowest(now.rotation);
      if (i > 0) {
        const Vec3 middle = 0.5 * (low + last_low);
        at = last * middle + carried - now.rotation * middle;
      }
      at.z = goals[i].way.z - (now.rotation * low).z;
    }
    now.origin = at;
    ankles.push_back(at);
    ankle = at, last = now, last_low = low;
  }
  return ankles;
}

}  // namespace gambeson
