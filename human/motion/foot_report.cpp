#include "human/motion/foot_report.hpp"

#include <algorithm>
#include <cmath>

#include "human/body/ground.hpp"

namespace gambeson {

std::optional<FootReport> footReport(const Human& human, const Motion& motion, double until_s, double step_s) {
  constexpr double standing_m = 5e-3, h = 1e-4;
  std::vector<const BodyShape*> feet;
  for (const BodyShape& s : human.shapes)
    if (human.skeleton.links[s.link].name.starts_with("foot")) feet.push_back(&s);
  if (feet.empty()) return {};
  const auto stairs = motion.stairs();
  const auto poses = [&](double t) {
    const Posture p = motion.at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  };
  FootReport out;
  const double end = std::min(until_s, motion.duration());
  const int n = std::max(1, static_cast<int>(std::ceil(end / step_s)));
  int carries = -1;
  double way = 0;
  for (int i = 0; i <= n; ++i) {
    const double t = end * i / n, t0 = std::max(0.0, t - h), t1 = std::min(motion.duration(), t + h);
    const auto X = poses(t), before = poses(t0), after = poses(t1);
    double least = 0, speed = 0;
    int stance = -1;
    for (std::size_t f = 0; f < feet.size(); ++f) {
      const BodyShape& foot = *feet[f];
      const Pose X_WS = X[foot.link] * foot.X_LS;
      const double gap = gapTo(foot.shape, X_WS, stairs);
      if (f == 0 || gap < least) least = gap;
      if (gap > standing_m) continue;
      const Vec3 low = foot.X_LS * lowestPoint(foot.shape, X_WS.rotation);
      Vec3 v = (after[foot.link] * low - before[foot.link] * low) / (t1 - t0);
      v.z = 0;
      if (stance < 0 || norm(v) < speed) speed = norm(v), stance = static_cast<int>(f);
    }
    if (-least > out.penetration_m) out.penetration_m = -least, out.penetration_time_s = t;
    if (least > out.hover_m) out.hover_m = least, out.hover_time_s = t;
    if (stance != carries) carries = stance, way = 0;
    if (stance < 0) continue;
    if (speed > out.slip_m_per_s) out.slip_m_per_s = speed, out.slip_time_s = t;
    way += speed * end / n;
    out.slip_m = std::max(out.slip_m, way);
  }
  return out;
}

}  // namespace gambeson
