#include "core/math/parallel.hpp"
#include "core/motion/forces.hpp"
#include "core/motion/free_motion.hpp"
#include "core/motion/step.hpp"

namespace gambeson {

StepReport freeStep(const Model& m, const Stage& stage, FreeScheme& scheme, const State& in, double dt, State& out,
                    FreeMotion& free, StepWork& w) {
  const int n = m.freeCount();
  StepReport report;
  report.step_s = dt;
  StopWatch clock, whole;
  placeStage(m, stage, in.time_s, in.time_s + dt, w.stage);
  clock.lap(w.times.stage);
  const auto notFinite = [&](const char* what) {
    report.failure = StepFailure::not_finite;
    report.why = what;
    return report;
  };

  // The free motion.
  out.time_s = in.time_s + dt;
  out.anchors = in.anchors;
  out.free_change.clear();
  free.solve = {};
  free.damping.clear();
  free.damping_lost_J = 0;
  if (!scheme.move(m, stage, in, dt, free, out, report, w)) return report;
  report.solve = free.solve;
  w.predictor.resize(n);
  for (int i = 0; i < n; ++i) w.predictor[i] = free.way[i] / dt;
  if (m.supports) m.supports->drive(in.time_s, out.time_s, w.predictor);
  if (!allFinite(w.predictor) || !allFinite(free.velocity)) return notFinite("a velocity is not finite");
  clock.lap(w.times.force);

  // Contact and impact.
  samplePositions(m, in.p, w.x0);
  if (!resolveContacts(m, in, dt, report, clock, w)) return report;
  out.p.resize(n);
  out.v.resize(n);
  for (int i = 0; i < n; ++i) {
    out.p[i] = in.p[i] + dt * w.velocity[i];
    out.v[i] = free.velocity[i] + (w.velocity[i] - w.predictor[i]);
  }
  if (m.supports) {
    m.supports->place(out.time_s, out.p);
    m.supports->placeInner(out.time_s, out.p, out.inner);
  }
  if (!allFinite(out.p)) return notFinite("a position is not finite");
  samplePositions(m, out.p, w.x1);
  report.largest_way =
      largestOf(Each::value, m.surface.size(), 0.0, [&](int s) { return norm(w.x1[s] - w.x0[s]) / m.cell_m[s]; });
  clock.lap(w.times.other);

  // Forces at the end, and what the laws remember there.
  const AnchorFrames before{w.stage.start.anchors, w.stage.start.vertices},
      after{w.stage.end.anchors, w.stage.end.vertices};
  out.limit_J.clear();
  out.damping_W = 0;  // Verlet's alone
  out.pressed.clear();
  out.history.clear();
  out.inner_acceleration.resize(out.inner_rate.size());
  ClothEnergy energy;
  report.work.cloth = accelerate(m, after, stage.air(out.time_s), out.v, {}, {0, dt, dt}, &in.history, out, w, &energy);
  if (!allFinite(out.a) || !allFinite(out.v)) return notFinite("a force is not finite");
  out.elastic_J = elasticEnergy(m, out, after, energy.stored, w);
  const double elastic_J = *out.elastic_J - (in.elastic_J ? *in.elastic_J : elasticEnergyAt(m, in, before, w));
  w.spring_impulses = free.spring;
  for (const Vec3& impulse : w.spring_impulses) report.momentum.scale += norm(impulse);
  report.work.supports += springWork(m, in, out, before, after, w.spring_impulses, dt);
  clock.lap(w.times.force);

  leaveToNext(m, in, dt, report, w, out);
  out.y.clear();
  auditFreeStep(m, in, out, dt, free, elastic_J, report, w);
  clock.lap(w.times.other);
  if (report.searched) {
    ++w.times.searches;
    whole.lap(w.times.searched_steps);
  }
  return report;
}

}  // namespace gambeson
