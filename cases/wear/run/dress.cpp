#include "cases/wear/run/dress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/message.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/supports/kind.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/error.hpp"
#include "core/motion/free_steps.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step.hpp"
#include "human/motion/standing.hpp"
#include "tryon/girth.hpp"
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

/// Where the garment in hand was stopped, or the start.
State stateAt(Donning donning, const Scenario& s, StepWork& work, Frequency& frequency, DressingProgress& progress) {
  if (std::optional<State> kept = progress.take(donning, frequency)) return std::move(*kept);
  return startOf(s, work);
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
    integrator->advance(std::min(0.0, state.time_s + look_s), state,
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

/// Seams of panels are closed [sides of a cell].
constexpr double closed_cells = 0.01;

/// Of panels without weight; and what contacts may leave of it, as a part of g dt: some mm/s.
constexpr double closing_m_per_s = 0.5, closing_tolerance = 2;

bool areSame(const Posture& a, const Posture& b) {
  constexpr double little = 1e-9;
  double apart = norm(a.root.origin - b.root.origin);
  for (std::size_t j = 0; j < a.q.size(); ++j) apart = std::max(apart, std::abs(a.q[j] - b.q[j]));
  for (const Vec3& e : {a.root.rotation.a - b.root.rotation.a, a.root.rotation.b - b.root.rotation.b})
    apart = std::max(apart, norm(e));
  return apart < little;
}

/// A garment of flat panels by itself, without supports: first with the time that its seams have to close around the
/// body in the posture that they are placed for (puttingOnPosture: arms aside, or as it was scanned), and then, from
/// settle_start_s of the stage on, on its way to where the motion starts, if that is elsewhere. Without friction, by
/// which edges that close over a shoulder, say, jam.
std::unique_ptr<Scenario> standingPanels(const Case& one, const Case& whole, std::size_t garment) {
  Case standing = one;
  standing.supports.clear();
  standing.dressing.projecting.reset();
  const double close_s = std::get<PatternGarment>(one.garments[0].shape).close_within_s;
  standing.dressing.settle_s = close_s;
  standing.contact.friction = 0;
  standing.contact.tolerance = std::max(standing.contact.tolerance, closing_tolerance);
  standing.contact.friction_cloth.reset();
  standing.garments[0].friction.reset();
  for (ObstacleCase& obstacle : standing.obstacles) obstacle.friction.reset();
  std::unique_ptr<Scenario> s = buildAlone(standing, whole, garment);
  s->model->sewing_options.close_m_per_s = closing_m_per_s;
  const double move_s = whole.dressing.settle_s;
  if (!s->human || !(move_s > 0)) return s;
  const Posture placed = puttingOnPosture(whole, one.garments[0], *s->human);
  if (areSame(placed, s->motion->at(0))) return s;
  s->stage->dressed = placed;
  s->stage->settle_start_s = -move_s;
  s->start_s = s->stage->grow_start_s = -(close_s + move_s);
  return s;
}

/// "armhole" gapes by up to 12.3 mm, the widest first.
std::string gapesText(const Scenario& s, const State& state) {
  const SewnRows rows = s.model->cloth->sewnRows();
  const std::vector<Vec3> q = controlPoints(s, state);
  std::vector<Vec3> gap(static_cast<std::size_t>(rows.rows()));
  rows.C.multiply<Vec3>(q, gap);
  const std::vector<SewnSeam>& seams = s.wardrobe.drafts[0].sewn_seams;
  std::vector<std::pair<double, std::size_t>> widest;
  for (std::size_t k = 0; k < seams.size(); ++k) widest.push_back({0, k});
  for (std::size_t r = 0; r < gap.size(); ++r) {
    double& most = widest[static_cast<std::size_t>(rows.seam[r])].first;
    most = std::max(most, norm(gap[r]));
  }
  std::sort(widest.begin(), widest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, widest.size()); ++k)
    text +=
        fmt::format("{}\"{}\" by {:.1f} mm", k == 0 ? "" : ", ", seams[widest[k].second].name, 1e3 * widest[k].first);
  return text;
}

/// Stretched by more around the body a garment does not fit; what ease and the fabric's own give is less.
constexpr double fitting_stretch = 0.02;

/// Where the garment is short around the body, and by how much; empty where it fits.
std::string fitText(const Scenario& s, const State& state) {
  const Model& m = *s.model;
  std::vector<Vec3> rest(static_cast<std::size_t>(m.surface.size())), worn;
  m.surface.W.multiply<Vec3>(m.cloth->rest(), rest);
  samplePositions(m, state.p, worn);
  return shortText(shortGirths(m.surface, rest, worn, {0, 0, 1}, fitting_stretch));
}

/// Height of a garment, the mean over its samples.
double meanHeight(const Model& m, const State& state) {
  std::vector<Vec3> x;
  samplePositions(m, state.p, x);
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += m.surface.area_m2[i] * x[i].z, area += m.surface.area_m2[i];
  return sum / area;
}

/// Panels go inwards, and up or down by some centimetres, while their seams close; farther, and what has closed is
/// beside the body: nothing else holds it there.
constexpr double most_rise_m = 0.15;

void nobody(const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {}

/// Its seams close around the body (core/motion/sewing.hpp), without weight, up to closed_s.
State closedAround(const Scenario& s, double closed_s, Frequency& frequency, DressingProgress& progress) {
  const Model& m = *s.model;
  StepWork work;
  State state = stateAt(Donning::wearing, s, work, frequency, progress);
  const TimeCase& time = s.definition.time;
  const std::unique_ptr<Integrator> integrator =
      makeIntegrator(time.motion, m, *s.stage, time.control(), frequency, work);
  StepWork scratch;
  const double stood_m = meanHeight(m, startOf(s, scratch));
  double widest = widestGap(m, state.p);
  while (widest > closed_cells && state.time_s < closed_s - 1e-9) {
    integrator->advance(std::min(closed_s, state.time_s + look_s), state, nobody);
    widest = widestGap(m, state.p);
    progress.keep(Donning::wearing, state, frequency);
  }
  if (widest > closed_cells)
    throw RunError(
        fmt::format("seams gape after {} s, {:.2g} sides of a cell at most (to be closed: {}): {}; more time "
                    "(close_within), panels that stand nearer to the wearer, or the other way to place them "
                    "(\"placing\" in the pattern's file: given, regions) may close them{}{}",
                    closed_s - s.start_s, widest, closed_cells, gapesText(s, state),
                    fitText(s, state).empty() ? "" : ". It does not fit: ", fitText(s, state)));
  if (const double rise = meanHeight(m, state) - stood_m; s.human && std::abs(rise) > most_rise_m)
    throw RunError(
        fmt::format("it has slipped off its wearer while its seams closed: it is {:.0f} cm {} than its panels stood "
                    "(at most {:.0f}); "
                    "finer cells, or the other way to place its panels (\"placing\" in the pattern's file: given, "
                    "regions), may keep it on",
                    100 * std::abs(rise), rise > 0 ? "higher" : "lower", 100 * most_rise_m));
  if (const std::string fit = fitText(s, state); !fit.empty())
    sayNote(fmt::format("garment \"{}\" does not fit: {}", s.wardrobe.drafts[0].name, fit));
  return state;
}

/// Its seams close around the body; then it goes along to where the motion starts.
State sewnAround(const Scenario& s, DressingProgress& progress) {
  const Model& m = *s.model;
  const TimeCase& time = s.definition.time;
  const double closed_s = s.human && s.stage->settle_start_s > s.start_s ? s.stage->settle_start_s : 0;
  Frequency frequency;
  std::optional<State> following = progress.take(Donning::following, frequency);
  State state = following ? std::move(*following) : closedAround(s, closed_s, frequency, progress);
  if (closed_s < 0) {
    if (!following)
      state.time_s = closed_s;  // a time that others have not seen: what steps keep of the way before does not go on
    StepWork work;
    makeIntegrator(time.motion, m, *s.stage, time.control(), frequency, work)
        ->advance(0, state,
                  [&](const State&, const State& after, const StepReport&, const StepResult&, const Frequency& f) {
                    progress.keep(Donning::following, after, f);
                  });
  }
  return state;
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
  if (dressing.layer_by_layer && dressing.from.empty()) {
    const Dressed worn = putOnApart(c, progress);
    wear(s, worn);
    const auto sewn = [](const GarmentCase& g) { return kindOf(g).sewn; };
    if (s.stage->dressed && std::any_of(c.garments.begin(), c.garments.end(), sewn)) s.stage->dressed = worn.posture;
  }
  if (c.human || !kindOf(c.garments[0]).sewn) return;
  const std::unique_ptr<Scenario> panels = standingPanels(alone(c, 0), c, 0);
  s.start_m = sewnAround(*panels, progress).p;
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
