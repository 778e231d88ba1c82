#include "core/motion/deforming.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/motion/model.hpp"

namespace gambeson {
namespace {

void evaluate(const Model& m, const Stage& stage, double time_s, DeformedVertices& x) {
  x.resize(m.obstacles.size());
  for (std::size_t o = 0; o < m.obstacles.size(); ++o) {
    if (!m.obstacles[o].deforms) continue;
    x[o].resize(std::get<TriangleMesh>(m.obstacles[o].shape).vertices.size());
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

void placeDeforming(const Model& m, const Stage& stage, double start_s, double end_s, DeformingWork& w) {
  if (w.model != &m || w.stage != &stage) {
    w = {};
    w.model = &m;
    w.stage = &stage;
    w.surfaces = DeformedSurfaces(m.obstacles);
  }
  if (w.surfaces.empty()) return;
  if (start_s != w.start_s) {
    if (start_s == w.end_s) {
      std::swap(w.start, w.end);
      std::swap(w.start_s, w.end_s);
    } else {
      evaluate(m, stage, start_s, w.start);
      w.start_s = start_s;
    }
  }
  if (end_s != w.end_s) {
    evaluate(m, stage, end_s, w.end);
    w.end_s = end_s;
  }
  if (w.surfaces_start_s == start_s && w.surfaces_end_s == end_s) return;
  w.surfaces.move(w.start, w.end);
  w.surfaces_start_s = start_s;
  w.surfaces_end_s = end_s;
}

}  // namespace gambeson
