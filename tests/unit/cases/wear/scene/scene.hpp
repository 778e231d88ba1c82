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
#include "core/motion/free_steps.hpp"
#include "unit/shell_of.hpp"

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
    makeIntegrator(time.motion, model, stage, time.control(), frequency, work)->advance(until_s, state, watch);
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
  std::vector<Vec3> q(static_cast<std::size_t>(m.cloth->points()));
  m.cloth->map().T.multiply<Vec3>(s.p, q);
  const PlaceMesh places = m.cloth->placeMesh(per_cell);
  TriangleMesh mesh;
  for (std::size_t k = 0; k < places.uv.size(); ++k) {
    const PlaceRow row = m.cloth->mounting().place(places.patch[k], places.uv[k]);
    mesh.vertices.push_back(combine(row.columns, row.value, q));
  }
  mesh.triangles = places.triangles;
  return mesh;
}

}  // namespace gambeson
