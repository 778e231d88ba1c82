#include "cases/wear/run/dress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/message.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "cases/wear/run/close_seams.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/error.hpp"
#include "core/motion/free_steps.hpp"
#include "core/motion/step.hpp"
#include "tryon/stitching.hpp"

namespace gambeson {
namespace {

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

State settled(const Scenario& s, DressingProgress& progress, bool* tangled = nullptr) {
  StepWork work;
  Frequency frequency;
  State state = stateAt(Donning::wearing, s, work, frequency, progress);
  const TimeCase& time = s.definition.time;
  bool last = false;
  makeIntegrator(time.motion, *s.model, *s.stage, time.control(), frequency, work)
      ->advance(0, state,
                [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency& f) {
                  last = r.intersections > 0 || r.inside > 0 || r.pinched > 0;
                  progress.keep(Donning::wearing, after, f);
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
Closed closePanels(const Case& one, const Case& whole, std::size_t garment, DressingProgress& progress) {
  const Stitching& law = *one.garments[0].stitching;
  std::unique_ptr<Scenario> panels = floatingPanels(one, whole, garment);
  progress.show(one.garments[0].name, panels->start_s);
  const Model& m = *panels->model;
  StepWork work;
  Frequency frequency;
  State state = stateAt(Donning::stitching, *panels, work, frequency, progress);
  double widest = widestStitch(m.stitches, m.surface.WT, state.p);
  const std::unique_ptr<Integrator> integrator =
      makeIntegrator(one.time.motion, m, *panels->stage, one.time.control(), frequency, work);
  while (widest > law.close_m && state.time_s < -1e-9) {
    integrator->advance(std::min(0.0, state.time_s + seams_look_s), state,
                        [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
    widest = widestStitch(m.stitches, m.surface.WT, state.p);
    progress.keep(Donning::stitching, state, frequency);
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
  DressingProgress forgets;
  return putOnApart(c, forgets);
}

Dressed putOnApart(const Case& c, DressingProgress& progress) {
  for (std::size_t g = progress.worn().garments.size(); g < c.garments.size(); ++g) {
    Case one = alone(c, g);
    const bool stitched = one.garments[0].stitching.has_value();
    Closed closed;
    try {
      const bool closing = stitched && !progress.isPast(Donning::stitching);
      if (closing) closed = closePanels(one, c, g, progress);
      if (stitched) one.dressing.projecting.reset();
      const bool sewn = kindOf(one.garments[0]).sewn;
      const std::unique_ptr<Scenario> s = sewn ? standingPanels(one, c, g) : buildAlone(one, c, g);
      if (closing) {
        s->start_m = sew(s->model->cloth->map(), controlPoints(*closed.panels, closed.state));
        s->start_history = carriedHistory(*closed.panels->model->cloth, closed.state.history, *s->model->cloth);
      }
      progress.show(c.garments[g].name.empty() ? "the garment" : c.garments[g].name, s->start_s);
      progress.add(dressedOf(*s, sewn ? sewnAround(*s, progress) : settled(*s, progress)));
    } catch (const RunError& e) {
      const std::string& name = c.garments[g].name;
      throw RunError(fmt::format("putting on the garment{}: {}", name.empty() ? "" : " \"" + name + "\"", e.what()));
    }
  }
  return progress.worn();
}

void buildApart(const Case& c) {
  for (std::size_t g = 0; g < c.garments.size(); ++g) {
    Case one = alone(c, g);
    if (one.garments[0].stitching) {
      floatingPanels(one, c, g);
      one.dressing.projecting.reset();
    }
    kindOf(one.garments[0]).sewn ? standingPanels(one, c, g) : buildAlone(one, c, g);
  }
}

void putOn(Scenario& s) {
  DressingProgress forgets;
  putOn(s, forgets);
}

void putOn(Scenario& s, DressingProgress& progress) {
  const DressingCase& dressing = s.definition.dressing;
  const Case& c = s.definition;
  if (dressing.layer_by_layer && dressing.from.empty()) wear(s, putOnApart(c, progress));
  if (c.human || !kindOf(c.garments[0]).sewn) return;
  const std::unique_ptr<Scenario> panels = standingPanels(alone(c, 0), c, 0);
  s.start_m = sew(s.model->cloth->map(), controlPoints(*panels, sewnAround(*panels, progress)));
}

namespace {

Dressed freed(const Scenario& s) {
  bool tangled = false;
  DressingProgress forgets;
  const State state = settled(s, forgets, &tangled);
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
  for (const std::string& note : s->notes) sayNote(note);
  putOn(*s);
  return freed(*s);
}

}  // namespace gambeson
