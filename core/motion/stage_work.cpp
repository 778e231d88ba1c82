#include "core/motion/stage_work.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/motion/model.hpp"

namespace gambeson {
namespace {

void evaluate(const Model& m, const Stage& stage, double time_s, DeformedVertices& x) {
  if (x.size() != m.obstacles.size()) x = DeformedVertices(m.obstacles);
  for (std::size_t o = 0; o < m.obstacles.size(); ++o) {
    if (!m.obstacles[o].deforms) continue;
    stage.vertices(static_cast<int>(o), time_s, x[o]);
    for (std::size_t v = 0; v < x[o].size(); ++v)
      if (!(std::isfinite(x[o][v].x) && std::isfinite(x[o][v].y) && std::isfinite(x[o][v].z)))
        throw RunError("vertex " + std::to_string(v) + " of " + m.obstacles[o].segment + " is not finite at " +
                       std::to_string(time_s) + " s");
  }
}

}  // namespace

void Stage::vertices(int obstacle, double, std::span<Vec3>) const {
  throw std::logic_error("obstacle " + std::to_string(obstacle) + " deforms and the stage does not say how");
}

DeformedVertices deformedVertices(const Model& m, const Stage& stage, double time_s) {
  DeformedVertices x;
  evaluate(m, stage, time_s, x);
  return x;
}

namespace {

void ask(const Model& m, const Stage& stage, double time_s, StageInstant& at) {
  at.obstacles.resize(m.obstacles.size());
  at.anchors.resize(static_cast<std::size_t>(m.anchor_count));
  stage.placements(time_s, at.obstacles, at.anchors);
  evaluate(m, stage, time_s, at.vertices);
  at.time_s = time_s;
}

}  // namespace

void placeEnds(const Model& m, const Stage& stage, double start_s, double end_s, StageWork& w) {
  if (w.model != &m || w.stage != &stage) {
    w = {};
    w.model = &m;
    w.stage = &stage;
    w.surfaces = DeformedSurfaces(m.obstacles);
  }
  if (start_s != w.start.time_s && start_s == w.end.time_s) std::swap(w.start, w.end);
  if (start_s != w.start.time_s) ask(m, stage, start_s, w.start);
  if (end_s != w.end.time_s) ask(m, stage, end_s, w.end);
}

void placeStage(const Model& m, const Stage& stage, double start_s, double end_s, StageWork& w) {
  placeEnds(m, stage, start_s, end_s, w);
  if (w.surfaces.empty() || (w.surfaces_start_s == start_s && w.surfaces_end_s == end_s)) return;
  w.surfaces.move(w.start.vertices, w.end.vertices);
  w.surfaces_start_s = start_s;
  w.surfaces_end_s = end_s;
}

}  // namespace gambeson
