#include "cases/wear/scene/stage.hpp"

#include <algorithm>

#include "human/body/skin.hpp"
#include "human/motion/blend.hpp"
#include "human/motion/smooth_step.hpp"
#include "tryon/projecting.hpp"
#include "tryon/skin_projecting.hpp"

namespace gambeson {

void CaseStage::placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const {
  std::size_t at = 0;
  if (human) {
    const Posture posture = postureAt(t);
    const std::vector<Pose> poses = linkPoses(human->skeleton, posture.q, posture.root);
    std::vector<Placement> body = obstaclePlacementsOf(*human, poses);
    if (!shrunk.empty() && t < grow_start_s + grow_s)
      body = placementsDuringGrowth(body, shrunk, (t - grow_start_s) / grow_s);
    for (const int foot : feet) body[foot].scale *= footScale(t);
    for (const Placement& p : body) obstacles[at++] = p;
    for (std::size_t l = 0; l < anchors.size(); ++l) anchors[l] = {poses[l].rotation, poses[l].origin, 1};
  }
  own.placements(t, obstacles.subspan(at), {});
}

bool CaseStage::leavesOut(int obstacle, double t) const {
  return t < feet_back_s && std::find(feet.begin(), feet.end(), obstacle) != feet.end();
}

double CaseStage::footScale(double t) const {
  constexpr double left_out = 0.02;  // some millimetres long: out of the way of any trouser leg
  return left_out + (1 - left_out) * smootherStep((t - feet_back_s) / feet_grow_s);
}

Posture CaseStage::postureAt(double t) const {
  const Posture first = motion->at(std::max(t, 0.0));
  if (!dressed || t >= 0 || !(settle_start_s < 0)) return first;
  const double x = std::clamp(1.5 * (t - settle_start_s) / -settle_start_s, 0.0, 1.0);
  return blend(*dressed, first, x * x * x * (10 + x * (6 * x - 15)));
}

void CaseStage::vertices(int obstacle, double t, std::span<Vec3> x) const {
  if (obstacle >= first_own) return own.vertices(obstacle - first_own, t, x);
  const Posture posture = postureAt(t);
  const std::vector<Pose> poses = linkPoses(human->skeleton, posture.q, posture.root);
  skinPositions(*human->skin, poses, x);
  bridge(bridged, *human->skin, poses, t, x);
  if (shrunk_skin.empty() || !(t < grow_start_s + grow_s)) return;
  const double w = grownPart((t - grow_start_s) / grow_s);
  for (std::size_t v = 0; v < x.size(); ++v) x[v] = shrunk_skin[v] + w * (x[v] - shrunk_skin[v]);
}

const Skin* CaseStage::skin(int obstacle, double t, std::vector<Pose>& poses) const {
  if (obstacle >= first_own || !human->skin || !bridged.empty() || (!shrunk_skin.empty() && t < grow_start_s + grow_s))
    return nullptr;
  const Posture posture = postureAt(t);
  poses = linkPoses(human->skeleton, posture.q, posture.root);
  return &*human->skin;
}

void CaseStage::heldMotions(double t, std::span<HeldMotion> motions) const {
  for (std::size_t k = 0; k < motions.size(); ++k) motions[k] = {held_drives[k].at(t), held_drives[k].rateAt(t)};
}

Vec3 CaseStage::air(double t) const {
  if (air_ramp_s <= 0) return air_velocity;
  const double x = std::clamp(t / air_ramp_s, 0.0, 1.0);
  return (x * x * (3 - 2 * x)) * air_velocity;
}

}  // namespace gambeson
