#include "core/motion/held_motion.hpp"

namespace gambeson {
namespace {

template <class F>
void forMoved(const Model& m, F f) {
  for (std::size_t k = 0; k < m.held_motion.size(); ++k)
    if (m.held_motion[k] >= 0) f(static_cast<std::size_t>(m.held_points[k]), m.held_motion[k]);
}

}  // namespace

void findHeldMotions(const Model& m, const Stage& stage, double start_s, double end_s, StepScratch& w) {
  if (m.held_motion.empty()) return;
  const auto count = static_cast<std::size_t>(m.held_motion_count);
  w.held_start.resize(count);
  w.held_end.resize(count);
  stage.heldMotions(start_s, w.held_start);
  stage.heldMotions(end_s, w.held_end);
}

Vec3 carried(const StepScratch& w, int motion, const Vec3& x) {
  const Pose &a = w.held_start[static_cast<std::size_t>(motion)].pose,
             &b = w.held_end[static_cast<std::size_t>(motion)].pose;
  if (a.rotation == b.rotation) return x + (b.origin - a.origin);  // without the rounding of a turn there and back
  return b * (transpose(a.rotation) * (x - a.origin));
}

void driveHeld(const Model& m, std::span<const Vec3> p, double dt, const StepScratch& w, std::span<Vec3> v) {
  forMoved(m, [&](std::size_t i, int motion) { v[i] = (carried(w, motion, p[i]) - p[i]) / dt; });
}

void placeHeld(const Model& m, std::span<const Vec3> before, const StepScratch& w, std::span<Vec3> p) {
  forMoved(m, [&](std::size_t i, int motion) { p[i] = carried(w, motion, before[i]); });
}

void rateHeld(const Model& m, std::span<const Vec3> p, const StepScratch& w, std::span<Vec3> v) {
  forMoved(m, [&](std::size_t i, int motion) { v[i] = w.held_end[static_cast<std::size_t>(motion)].rate.at(p[i]); });
}

}  // namespace gambeson
