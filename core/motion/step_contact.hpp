#pragma once
/// The contact part of a step: from the predicted velocities to those with which nothing passes through anything.
/// Internal to core/motion.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <string>

#include "core/motion/model.hpp"

namespace gambeson {

/// Adds the time since the last lap to a phase.
class StopWatch {
 public:
  void lap(double& phase) {
    const auto now = std::chrono::steady_clock::now();
    phase += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// "(0.1, 0, -0.25) m", to the micrometre.
inline std::string positionText(const Vec3& x) {
  const auto rounded = [](double v) { return std::round(1e6 * v) / 1e6 + 0.0; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", rounded(x.x), rounded(x.y), rounded(x.z));
}

inline Vec3 sampleAt(const SparseRows& WT, int sample, std::span<const Vec3> values) {
  Vec3 s{};
  for (int k = WT.offsets[sample]; k < WT.offsets[sample + 1]; ++k) s += WT.values[k] * values[WT.columns[k]];
  return s;
}

/// Whether something holds the free point `i`, whole or in part.
inline bool takesHold(const Model& m, int i) { return m.supports ? m.supports->binds(i) : m.held[i] != 0; }

inline bool allFinite(std::span<const Vec3> values) {
  double zero = 0;
  for (const Vec3& v : values) zero += 0 * (v.x + v.y + v.z);  // NaN from the first infinity or NaN on
  return zero == 0;
}

/// What the step's contacts give the free points [N s], w.impulses of w.rows, before anything holds these. `impulses`
/// has an entry for each.
void contactImpulses(const Model& model, StepWork& work, std::vector<Vec3>& impulses);

/// Loads of a structure on the free points [N], the control points at q.
void loadsAt(const Model& model, double time_s, std::span<const Vec3> q, std::vector<Vec3>& load, StepWork& work);

/// Reads w.predictor, w.x0, w.stage; leaves w.velocity, w.rows with w.impulses and w.warm, and w.impact_zones with
/// w.impact_zone_change. In turn: contacts and impacts found so far solved together; paths tested; what would still
/// pass joins them. After some rounds what is left moves in rigid impact zones. False where that does not do either:
/// report.earliest_impact is the part of the step up to which nothing touches.
bool resolveContacts(const Model& model, const State& in, double dt, StepReport& report, StopWatch& clock, StepWork& w);

/// What a step of any scheme leaves to the next in `out`: its persistent contacts, whether it ended tangled, and what
/// the time step is chosen by. Cloth wholly inside of a mesh crosses nothing until it comes out.
void leaveToNext(const Model& model, const State& in, double dt, const StepReport& report, const StepWork& work,
                 State& out);

/// What the step's contacts accelerate the free points by as a force that acts all the time [m/s^2]: of persistent rows
/// that have come to their layer, friction with them, as much as lasts (lastingShare). Impacts, what stops a sample on
/// its way to the layer and what frees intersections change velocities at once and are no part of it. Where threads are
/// limited their tensions and the contacts that bear them are solved as one and balance as one, though they pass from
/// sample to sample: then all persistent rows count, as all tensions do. Empty where nothing presses.
void pressingAccelerations(const Model& model, double dt, StepWork& work, std::vector<Vec3>& pressed);

/// The distance that a contact restores: half the sum of both sides' thicknesses, at a body that of the cloth, and no
/// less than keeps the cloth between the samples out of it.
double layerOf(const Model& model, const ContactRow& row);

/// The touched vertex of an impact zone's body nearest to a point, where the body deforms.
MaterialPoint nearestTouched(const Model& model, const ImpactZone& zone, const Vec3& p, const StepWork& w);

}  // namespace gambeson
