#pragma once
/// Library cases run in memory, step by step, with what the tests of scenes look at.

#include <omp.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "cases/wear/scene/scenario.hpp"
#include "core/contact/scene_check.hpp"
#include "core/motion/advance.hpp"

namespace gambeson {

inline Case libraryCase(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return readCase(std::string(GAMBESON_SOURCE_DIR "/cases/library/") + name + ".json", overrides);
}

/// A scene under way. `watch` is called after each step, as the observer of `advance`.
class SceneRun {
 public:
  explicit SceneRun(const Case& c) : scenario(buildScenario(c)), model(*scenario->model), stage(*scenario->stage) {
    omp_set_num_threads(1);
    state = startOf(*scenario, work);
  }

  void run(double until_s, const StepObserver& watch) {
    const TimeCase& time = scenario->definition.time;
    advance(model, stage, {time.step_safety, time.max_step_s}, until_s, state, frequency, work, watch);
  }

  std::unique_ptr<Scenario> scenario;
  const Model& model;
  const Stage& stage;
  StepWork work;
  State state;
  Frequency frequency;
};

/// The largest relative error of the momentum balance over the steps, and what the steps had in them.
struct AuditWatch {
  double worst = 0;
  int steps = 0, with_contact = 0;
  void operator()(const StepReport& r) {
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    ++steps;
    with_contact += norm(r.momentum.obstacles) > 0;
  }
};

/// Of what is free to move [m].
inline Vec3 centreOfMass(const Model& m, const State& s) {
  Vec3 moment{};
  double mass = 0;
  for (int i = 0; i < m.freeCount(); ++i) {
    moment += m.mass_kg[i] * s.p[i];
    mass += m.mass_kg[i];
  }
  return moment / mass;
}

/// The surface at `per_cell` points along each edge of each cell, joined to triangles.
inline TriangleMesh denseSurface(const Model& m, const State& s, int per_cell) {
  std::vector<Vec3> q(m.shell.controlCount());
  m.map.T.multiply<Vec3>(s.p, q);
  TriangleMesh mesh;
  std::size_t offset = 0;
  for (const NurbsPatch& patch : m.shell.garment().patches) {
    const auto grid = [&](const KnotVector& k) {
      const std::vector<double> ends = breakpoints(k);
      std::vector<double> at;
      for (std::size_t c = 0; c + 1 < ends.size(); ++c)
        for (int i = 0; i < per_cell; ++i) at.push_back(ends[c] + (ends[c + 1] - ends[c]) * i / per_cell);
      at.push_back(ends.back());
      return at;
    };
    const std::vector<double> us = grid(patch.u), vs = grid(patch.v);
    const int first = static_cast<int>(mesh.vertices.size()), nu = static_cast<int>(us.size());
    for (double v : vs)
      for (double u : us) {
        const SurfaceBasis b = surfaceBasis(patch, u, v);
        Vec3 x{};
        for (std::size_t k = 0; k < b.columns.size(); ++k) x += b.values[0][k] * q[offset + b.columns[k]];
        mesh.vertices.push_back(x);
      }
    for (int j = 0; j + 1 < static_cast<int>(vs.size()); ++j)
      for (int i = 0; i + 1 < nu; ++i) {
        const int a = first + i + nu * j;
        mesh.triangles.push_back({a, a + 1, a + nu + 1});
        mesh.triangles.push_back({a, a + nu + 1, a + nu});
      }
    offset += patch.points.size();
  }
  return mesh;
}

}  // namespace gambeson
