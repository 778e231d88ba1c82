#include "core/motion/resonance.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"
#include "core/motion/model.hpp"

namespace gambeson {
namespace {
/// From this swing on a step may have this part of the stable one.
struct Level {
  double swing, share;
};
// By measurement on free sheets without drag that start with noise of 0.5 to 20 % of a cell, 2,000 equal steps each: at
// 0.9 of the stable step energy grows from a swing of 0.02 on (a hundredfold in 700 to 1,600 steps), at 0.86 from 0.11,
// at 0.82 from 0.15, at 0.78 a little from 0.3, at 0.74 and below nowhere. Shorts that are worn (shorts_walk) swing by
// 0.005 to 0.013, with any step. sin(45 degrees) = 0.707 would be the resonance of fourth order.
constexpr Level kLevels[] = {{0.025, kFirstShare}, {0.12, 0.75}, {0.2, 0.7}};
constexpr double kCalmAgain = 0.6;  ///< part of a level's swing below which the step may be longer again
}  // namespace

double swing(const Model& m, const State& before, const State& after, double dt, double omega, StepWork& w) {
  w.jerk.resize(m.freeCount());
  w.net_jerk.resize(m.cloth->points());
  forAll(Each::value, m.freeCount(), [&](int i) { w.jerk[i] = after.a[i] - before.a[i]; });
  m.cloth->map().T.multiply<Vec3>(w.jerk, w.net_jerk);
  const double most = largestOf(Each::value, static_cast<int>(m.net.size()), 0.0, [&](int k) {
    const NetEdge& e = m.net[k];
    return norm2(w.net_jerk[e.second] - w.net_jerk[e.first]) * e.per_length2;
  });
  return swingOfJerk(most, dt, omega);
}

double swingOfJerk(double most, double dt, double omega) {
  return most > 0 ? std::sqrt(most) / (omega * omega * omega * dt) : 0;
}

double shareAtSwing(double swing, double before) {
  double share = 1;
  for (const Level& level : kLevels) {
    const bool there = before > 0 && before <= level.share;
    if (swing > (there ? kCalmAgain : 1) * level.swing) share = level.share;
  }
  return share;
}

}  // namespace gambeson
