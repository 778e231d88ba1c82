#include "cases/wear/run/dress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/wear/case/supports/kind.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/error.hpp"
#include "core/motion/free_steps.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

/// Between looks at how far the seams are closed [s].
constexpr double look_s = 0.01;

/// Of garments that are put on by themselves, which what is under them does not hold yet.
constexpr double holding_friction = 1;

/// Without weight, and held where it is: a belt that is drafted over shorts slides off the bare body, by its weight and
/// by its tension.
Case alone(const Case& c, std::size_t g) {
  Case one = c;
  one.gravity_m_per_s2 = {};
  if (one.contact.friction.still < holding_friction) one.contact.friction = holding_friction;
  one.garments = {c.garments[g]};
  one.supports.clear();
  for (const SupportCase& support : c.supports) {
    const EdgeCase& edge = edgeOf(support);
    if (edge.garment.empty() || edge.garment == c.garments[g].name) one.supports.push_back(support);
  }
  one.dressing.layer_by_layer = false;
  one.dressing.from.clear();
  return one;
}

State settled(const Scenario& s, bool* tangled) {
  StepWork work;
  State state = startOf(s, work);
  Frequency frequency;
  const TimeCase& time = s.definition.time;
  bool last = false;
  makeIntegrator(time.motion, *s.model, *s.stage, time.control(), frequency, work)
      ->advance(0, state, [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
        last = r.intersections > 0 || r.inside > 0 || r.pinched > 0;
      });
  if (tangled) *tangled = last;
  return state;
}

/// The garment as its panels are closed: without supports, beside the body.
std::unique_ptr<Scenario> floatingPanels(const Case& one, const Case& whole, std::size_t garment) {
  Case floating = one;
  floating.supports.clear();
  floating.dressing.projecting.reset();
  floating.dressing.settle_s = one.garments[0].stitching->within_s;
  return buildPanels(floating, whole, garment);
}

/// The panels of the garment, closed by springs.
struct Closed {
  std::unique_ptr<Scenario> panels;
  State state;
};
Closed closePanels(const Case& one, const Case& whole, std::size_t garment) {
  const Stitching& law = *one.garments[0].stitching;
  std::unique_ptr<Scenario> panels = floatingPanels(one, whole, garment);
  const Model& m = *panels->model;
  StepWork work;
  State state = startOf(*panels, work);
  Frequency frequency;
  double widest = widestStitch(m.stitches, m.surface.WT, state.p);
  const std::unique_ptr<Integrator> integrator =
      makeIntegrator(one.time.motion, m, *panels->stage, one.time.control(), frequency, work);
  while (widest > law.close_m && state.time_s < -1e-9) {
    integrator->advance(std::min(0.0, state.time_s + look_s), state,
                 [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
    widest = widestStitch(m.stitches, m.surface.WT, state.p);
  }
  if (widest > law.close_m)
    throw RunError(
        fmt::format("the panels of the garment \"{}\" are still {:.1f} mm apart after {} s of stitching (to be "
                    "sewn: {:.1f} mm); stiffer springs, more time or a larger offset may close them",
                    one.garments[0].name, 1e3 * widest, law.within_s, 1e3 * law.close_m));
  return {std::move(panels), std::move(state)};
}

}  // namespace

Dressed putOnApart(const Case& c) {
  Dressed dressed;
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    Case one = alone(c, g);
    const bool stitched = one.garments[0].stitching.has_value();
    Closed closed;
    try {
      if (stitched) {
        closed = closePanels(one, c, g);
        one.dressing.projecting.reset();
      }
      const std::unique_ptr<Scenario> s = buildAlone(one, c, g);
      if (stitched) {
        s->start_m = sew(s->model->cloth->map(), controlPoints(*closed.panels, closed.state));
        s->start_history = carriedHistory(*closed.panels->model->cloth, closed.state.history, *s->model->cloth);
      }
      const State state = settled(*s, nullptr);
      Dressed worn = dressedOf(*s, state);
      dressed.body = worn.body;
      dressed.posture = worn.posture;
      dressed.garments.push_back(std::move(worn.garments[0]));
    } catch (const RunError& e) {
      throw RunError(fmt::format("putting on the garment \"{}\": {}", c.garments[g].name, e.what()));
    }
  }
  return dressed;
}

void buildApart(const Case& c) {
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    Case one = alone(c, g);
    if (one.garments[0].stitching) {
      floatingPanels(one, c, g);
      one.dressing.projecting.reset();
    }
    buildAlone(one, c, g);
  }
}

void putOn(Scenario& s) {
  const DressingCase& dressing = s.definition.dressing;
  if (dressing.layer_by_layer && dressing.from.empty()) wear(s, putOnApart(s.definition));
}

namespace {

Dressed freed(const Scenario& s) {
  bool tangled = false;
  const State state = settled(s, &tangled);
  if (tangled)
    throw RunError(
        fmt::format("cloth still passes through cloth or the body after {} s of settling; more time "
                    "(dressing.settle) may free it",
                    s.definition.dressing.settle_s));
  return dressedOf(s, state);
}

}  // namespace

Dressed wearTogether(const Case& c, const Dressed& apart) {
  const std::unique_ptr<Scenario> s = buildScenario(c);
  wear(*s, apart);
  return freed(*s);
}

Dressed dress(const Case& c) {
  const std::unique_ptr<Scenario> s = buildScenario(c);
  putOn(*s);
  return freed(*s);
}

}  // namespace gambeson
