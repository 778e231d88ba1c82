#include "cases/structure/mover.hpp"

#include <cmath>

#include "core/cloth/constraint.hpp"
#include "core/motion/structure_motion.hpp"

namespace gambeson {
namespace {

/// Unknowns of displacements of the free points, by least squares: C y = u.
std::vector<double> unknownsOf(const Structure& s, const std::vector<double>& u) {
  const SparseRows normal = multiply(s.dofs.Ct, s.dofs.C);
  SymmetricMatrix m;
  m.size = s.dofs.unknowns();
  for (int column = 0; column < m.size; ++column) {
    for (int k = normal.offsets[column]; k < normal.offsets[column + 1]; ++k)
      if (normal.columns[k] >= column) {
        m.rows.push_back(normal.columns[k]);
        m.values.push_back(normal.values[k]);
      }
    m.offsets.push_back(static_cast<int>(m.rows.size()));
  }
  SymmetricFactor factor(m);
  factor.factorise(m);
  std::vector<double> right(static_cast<std::size_t>(m.size)), y(right.size());
  s.dofs.Ct.multiply<double>(u, right);
  factor.solve(right, y);
  return y;
}

}  // namespace

Mover::Mover(const StructureCase& c, const StructureModel& model) : case_(c), model_(model) {
  const DynamicOptions& o = c.dynamics;
  if (model.motion) {
    StepControl control;
    control.safety = o.safety;
    control.max_step_s = o.end_s;
    control.fixed_s = o.step_s;
    integrator_ = makeIntegrator(o.motion, *model.motion, *model.stage, control, frequency_, work_);
  } else {
    ImplicitOptions options{
        o.scheme == TimeScheme::newmark ? ImplicitScheme::newmark : ImplicitScheme::generalised_alpha,
        o.beta,
        o.gamma,
        o.spectral_radius,
        o.step_s,
        o.iterations,
        o.tolerance,
        o.lumped_mass};
    auto steps = std::make_unique<ImplicitSteps>(*model.structure, options);
    implicit_ = steps.get();
    integrator_ = std::move(steps);
  }
}

State Mover::start() {
  const Structure& s = *model_.structure;
  std::vector<double> y(static_cast<std::size_t>(s.dofs.unknowns()), 0.0), v = y;
  const auto onFree = [&](auto value) {
    std::vector<double> u;
    for (std::size_t f = 0; f < s.cloth->map().home.size(); ++f) {
      const Vec3 d = value(f);
      u.insert(u.end(), {d.x, d.y, d.z});
    }
    u.resize(static_cast<std::size_t>(s.dofs.C.rows()));
    return unknownsOf(s, u);
  };
  if (case_.initial.noise) {
    const std::vector<Vec3> noise = s.cloth->fromDraft(noiseOf(model_.sheet, *case_.initial.noise));
    y = onFree([&](std::size_t f) { return noise[static_cast<std::size_t>(s.cloth->map().home[f])]; });
  }
  if (norm(case_.initial.velocity_m_per_s) > 0) v = onFree([&](std::size_t) { return case_.initial.velocity_m_per_s; });
  State state = structureState(s, 0, y, v, {});
  if (!model_.motion) return state;
  State moving = initialState(*model_.motion, *model_.stage, 0, work_);
  moving.p = state.p;
  moving.v = state.v;
  moving.inner = state.inner;
  moving.inner_rate = state.inner_rate;
  attachSprings(*model_.motion, *model_.stage, moving, work_);
  return moving;
}

}  // namespace gambeson
