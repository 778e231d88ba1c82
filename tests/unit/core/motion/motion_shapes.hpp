#pragma once
/// Sheets in motion for the tests of core/motion.

#include <memory>
#include <utility>
#include <vector>

#include "core/motion/step.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson::shapes {

/// Obstacles that stand or move with constant velocity, anchors that stand in the world.
class UniformStage : public Stage {
 public:
  std::vector<Placement> at;
  std::vector<Vec3> velocity;
  Vec3 wind;

  void placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const override {
    for (std::size_t k = 0; k < at.size(); ++k) {
      obstacles[k] = at[k];
      obstacles[k].origin += t * velocity[k];
    }
    for (Placement& a : anchors) a = {};
  }
  Vec3 air(double) const override { return wind; }
};

/// The fabric of Zheng 2013, 3.7.2, with a linear bending law.
inline Fabric sheetFabric() {
  Fabric f;
  f.thickness_m = 1.177e-3;
  f.density_kg_per_m3 = 0.144 / f.thickness_m;
  f.young_weft_Pa = f.young_warp_Pa = 30e3;
  f.poisson = 0.3;
  f.shear_Pa = 30e3 / 2.6;
  f.law = LinearBending{{7e-6, 7e-6}};
  return f;
}

/// A flat square of edge `side`, its corner at (0, 0, height), `cells` cells of degree 2 along each edge.
inline Garment squareSheet(int cells, double side, double height, const Fabric& fabric = sheetFabric()) {
  NurbsPatch s = flatPatch(uniformKnots(2, cells), uniformKnots(2, cells), side, side);
  for (Vec3& x : s.points) x.z += height;
  return garmentOf({s}, {}, fabric);
}

/// A scene of one garment, stepped by hand.
struct Motion {
  std::unique_ptr<Model> model;
  UniformStage stage;
  StepWork work;
  State state, next;

  Motion(const Garment& g, const Environment& e, const ContactParameters& c = {}, const ModelOptions& o = {},
         std::vector<Obstacle> obstacles = {}, std::vector<Placement> at = {}, std::vector<Vec3> velocity = {},
         const ShellOptions& shell = {}) {
    velocity.resize(obstacles.size());
    at.resize(obstacles.size());
    stage.at = std::move(at);
    stage.velocity = std::move(velocity);
    model = buildModel(g, o, e, c, std::move(obstacles), shell);
    state = initialState(*model, stage, 0, work);
  }
  Motion(std::shared_ptr<const Cloth> cloth, const Environment& e, const ContactParameters& c = {},
         const ModelOptions& o = {}) {
    model = buildModel(std::move(cloth), o, e, c, {});
    state = initialState(*model, stage, 0, work);
  }

  /// Forces again, after positions or velocities were set by hand.
  void restart() { attachSprings(*model, stage, state, work); }

  StepReport step(double dt) {
    StepReport r = gambeson::step(*model, stage, state, dt, next, work);
    if (r.failure == StepFailure::none) std::swap(state, next);
    return r;
  }
  Energy energy() { return energyOf(*model, stage, state, work); }
};

/// A sheet in free vibration, stretched, bent and sheared by its start velocities, with one edge held.
inline Motion vibration() {
  ModelOptions o;
  const Garment g = squareSheet(6, 0.2, 0);
  for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  Motion m(g, {{0, 0, 0}, 0}, {}, o);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const Vec3 x = m.state.p[i] / 0.2;
    if (!m.model->held[i]) m.state.v[i] = 0.5 * Vec3{x.x * std::cos(2 * x.y), 0.3 * x.x * x.y, x.x * x.x};
  }
  m.restart();
  return m;
}

}  // namespace gambeson::shapes
