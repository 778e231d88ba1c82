/// The same state gives the same bits: for any number of threads, whatever scratch earlier steps have left, and
/// whatever lies in memory behind the samples' data.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const ContactParameters kContact{1.2e-3, 0.2, 0.01, 1e-2, 400};
constexpr double kEnd_s = 0.012;

/// Two sheets in one model, apart at rest (else they are neighbours), near each other now and coming closer.
Motion twoSheets(const NurbsPatch& lower, NurbsPatch upper, double gap, const Vec3& velocity) {
  constexpr double apart = 0.1;
  for (Vec3& x : upper.points) x.z += apart;
  Garment g = squareSheet(1, 0.1, 0);
  g.patches = {lower, upper};
  g.weft.push_back(g.weft[0]);
  Motion m(g, {{0, 0, 0}, 0.3}, kContact);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    Vec3& p = m.state.p[i];
    if (p.z < 0.5 * apart) continue;
    p.z += gap - apart;
    m.state.v[i] = velocity + Vec3{0, 0, -p.x};
  }
  m.restart();
  return m;
}

/// Bent about axes at right angles, ridge on ridge: edges of both carry what presses. The lower one is the larger.
Motion ridges() {
  const double radius = 0.03;
  const auto bent = [&](int axis, int cells, double up) {
    const double side = 0.008 * cells;
    NurbsPatch patch = squareSheet(cells, side, 0).patches[0];
    for (Vec3& x : patch.points) {
      const double s = (axis == 0 ? x.x : x.y) - 0.5 * side, along = (axis == 0 ? x.y : x.x) - 0.5 * side;
      const double across = radius * std::sin(s / radius), z = -up * radius * (1 - std::cos(s / radius));
      x = axis == 0 ? Vec3{across, along, z} : Vec3{along, across, z};
    }
    return patch;
  };
  NurbsPatch upper = bent(1, 5, -1);
  for (Vec3& x : upper.points) x += Vec3{1.7e-3, 2.2e-3, 0};  // samples beside each other
  return twoSheets(bent(0, 10, 1), upper, 1.3e-3, {0, 0, -1});
}

/// Flat on each other, with more contacts than one thread alone solves.
Motion pile() {
  return twoSheets(squareSheet(17, 0.2, 0).patches[0], squareSheet(16, 0.19, 0).patches[0], 1.25e-3, {0.1, 0.03, -0.1});
}

/// All bits of a state.
std::vector<char> bits(const State& s) {
  std::vector<char> out;
  const auto add = [&](const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    out.insert(out.end(), at, at + size);
  };
  for (const auto* list : {&s.p, &s.v, &s.a, &s.mode}) add(list->data(), list->size() * sizeof(Vec3));
  for (const WarmContact& w : s.warm) {
    for (int number : {w.sample, w.obstacle, w.feature}) add(&number, sizeof number);
    for (double number : {w.traction.x, w.traction.y, w.traction.z, w.mean_Pa}) add(&number, sizeof number);
  }
  for (double number : {s.time_s, s.frequency_rad_per_s, s.swing, s.share, s.last_step_s}) add(&number, sizeof number);
  return out;
}

struct Met {
  int contacts = 0, edges = 0;  ///< most of a step; pairs of edges that carried something that lasts
};

/// Advances to `until`. `forget`: with the scratch of a run that starts again from here.
Met advanceTo(Motion& m, double until, bool forget = false) {
  Met met;
  Frequency frequency;
  if (forget) m.work = StepWork();
  VelocityVerlet(*m.model, m.stage, {}, frequency, m.work)
      .advance(until, m.state,
               [&](const State&, const State& after, const StepReport& report, const StepResult&, const Frequency&) {
                 met.contacts = std::max(met.contacts, report.contacts);
                 for (const WarmContact& w : after.warm)
                   met.edges += w.kind == ContactKind::edge_on_edge && w.mean_Pa > 0;
               });
  return met;
}

class SameBits : public testing::TestWithParam<Motion (*)()> {
 protected:
  void TearDown() override { omp_set_num_threads(before_); }

 private:
  const int before_ = omp_get_max_threads();
};

TEST_P(SameBits, ForAnyNumberOfThreads) {
  omp_set_num_threads(1);
  Motion one = GetParam()();
  const Met met = advanceTo(one, kEnd_s);
  EXPECT_TRUE(met.contacts > 1024 || met.edges > 5) << met.contacts << " " << met.edges;
  for (int threads : {2, 3}) {
    omp_set_num_threads(threads);
    Motion many = GetParam()();
    advanceTo(many, kEnd_s);
    EXPECT_TRUE(bits(one.state) == bits(many.state)) << threads;
  }
}

TEST_P(SameBits, WhateverEarlierStepsHaveLeft) {
  Motion whole = GetParam()(), resumed = GetParam()();
  for (double until : {0.002, 0.005, kEnd_s}) {
    advanceTo(whole, until);
    advanceTo(resumed, until, true);
    ASSERT_TRUE(bits(whole.state) == bits(resumed.state)) << until;
  }
}

TEST_P(SameBits, WhateverLiesBehindTheSamples) {
  // In pairs of edges Contact::sample is an edge's number, and those of the ridges are beyond the number of samples.
  Motion plain = GetParam()(), guarded = GetParam()();
  Model& m = *guarded.model;
  const std::size_t room = m.surface.size() + m.collisions.mesh.edges.size() + m.collisions.mesh.triangles.size();
  for (auto* of_samples : {&m.density_kg_per_m2, &m.layer_m, &m.cell_m}) of_samples->resize(room, -1e3);
  advanceTo(plain, kEnd_s);
  advanceTo(guarded, kEnd_s);
  EXPECT_TRUE(bits(plain.state) == bits(guarded.state));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SameBits, testing::Values(&ridges, &pile),
                         [](const auto& scene) { return scene.index == 0 ? "ridges" : "pile"; });

}  // namespace
}  // namespace gambeson
