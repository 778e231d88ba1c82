#include "cases/wear/run/close_seams.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "core/motion/free_steps.hpp"
#include "core/motion/sewing.hpp"
#include "human/motion/standing.hpp"
#include "tryon/girth.hpp"

namespace gambeson {
namespace {

/// Seams of panels are closed [sides of a cell]. Those of triangles close exactly, and what is left of a gap both sides
/// are moved by at once when they become one.
double closedCells(const Scenario& s) {
  return s.definition.garments[0].cloth.kind == ClothKind::triangles ? 1e-3 : 0.01;
}

/// Of panels without weight: the speed of the widest gap, and the part of a gap that closes in a second. And what
/// contacts may leave of it, as a part of g dt: some mm/s.
constexpr double closing_m_per_s = 0.5, closing_per_s = 15, closing_tolerance = 2;

/// Seams close by a tenth in some hundredths of a second. Those that have not for so long, jam: the wearer or other
/// cloth stands between them, and each step costs all sweeps.
constexpr double nearer = 0.9, jammed_s = 1;

/// Resistance to all motion while seams close: force over mass and velocity. Without weight, friction and resistance
/// nothing takes what seams and contacts give: panels flutter at some m/s, and leave the wearer.
constexpr double closing_drag_per_s = 20;

bool areSame(const Posture& a, const Posture& b) {
  constexpr double little = 1e-9;
  double apart = norm(a.root.origin - b.root.origin);
  for (std::size_t j = 0; j < a.q.size(); ++j) apart = std::max(apart, std::abs(a.q[j] - b.q[j]));
  for (const Vec3& e : {a.root.rotation.a - b.root.rotation.a, a.root.rotation.b - b.root.rotation.b})
    apart = std::max(apart, norm(e));
  return apart < little;
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

/// Where the garment is short around the body, and by how much; empty where it fits.
std::string fitText(const Scenario& s, const State& state) {
  const Model& m = *s.model;
  std::vector<Vec3> rest(static_cast<std::size_t>(m.surface.size())), worn;
  m.surface.W.multiply<Vec3>(m.cloth->rest(), rest);
  samplePositions(m, state.p, worn);
  return shortText(
      shortGirths(m.surface, rest, worn, {0, 0, 1}, standsOf(fabricOf(s.definition, s.definition.garments[0]))));
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

/// Why seams do not close: where the garment is short comes first, since nothing else helps there.
std::string gapingText(const Scenario& s, const State& state, double widest, double closed_cells) {
  const std::string fit = fitText(s, state);
  const std::string gape =
      fmt::format("seams gape after {:.3g} s, {:.2g} sides of a cell at most (to be closed: {}): {}",
                  state.time_s - s.start_s, widest, closed_cells, gapesText(s, state));
  if (!fit.empty()) return fmt::format("the garment does not fit: {}. Its {}", fit, gape);
  return gape +
         "; more time (close_within), panels that stand nearer to the wearer, or the other way to place them "
         "(\"placing\" in the pattern's file: given, regions) may close them";
}

/// Its seams close around the body (core/motion/sewing.hpp), without weight, up to closed_s.
State closedAround(const Scenario& s, double closed_s, Frequency& frequency, DressingProgress& progress) {
  const Model& m = *s.model;
  StepWork work;
  State state = stateAt(Donning::wearing, s, work, frequency, progress);
  const TimeCase& time = s.definition.time;
  const std::unique_ptr<Integrator> integrator =
      makeIntegrator(time.motion, m, *s.stage, time.control(), frequency, work);
  double widest = widestGap(m, state.p), least = widest, since_s = state.time_s;
  const double closed_cells = closedCells(s);
  while (widest > closed_cells && state.time_s < closed_s - 1e-9 && state.time_s < since_s + jammed_s) {
    integrator->advance(std::min(closed_s, state.time_s + seams_look_s), state, nobody);
    widest = widestGap(m, state.p);
    if (widest < nearer * least) least = widest, since_s = state.time_s;
    progress.keep(Donning::wearing, state, frequency);
  }
  if (widest > closed_cells) throw RunError(gapingText(s, state, widest, closed_cells));
  requireWorn(s, state);
  return state;
}

/// Triangles bend by hinges that are quadratic in the positions while seams close, where these know their fabrics:
/// cells that are crushed on the way fold back, where tensors of curvature grow as stiff as cells grow small.
void bendSoftly(const Case& c, GarmentCase& worn) {
  if (worn.cloth.kind != ClothKind::triangles) return;
  std::vector<Fabric> fabrics = otherFabrics(worn);
  fabrics.push_back(fabricOf(c, worn));
  if (std::all_of(fabrics.begin(), fabrics.end(),
                  [](const Fabric& f) { return std::holds_alternative<LinearBending>(f.law) && !hasRestCurvature(f); }))
    worn.cloth.bending = BendingElements::quadratic;
}

}  // namespace

std::unique_ptr<Scenario> standingPanels(const Case& one, const Case& whole, std::size_t garment) {
  Case standing = one;
  standing.supports.clear();
  standing.dressing.projecting.reset();
  const double close_s = std::get<PatternGarment>(one.garments[0].shape).close_within_s;
  standing.dressing.settle_s = close_s;
  standing.air = {};
  standing.contact.friction = 0;
  standing.contact.tolerance = std::max(standing.contact.tolerance, closing_tolerance);
  standing.contact.friction_cloth.reset();
  standing.garments[0].friction.reset();
  for (ObstacleCase& obstacle : standing.obstacles) obstacle.friction.reset();
  bendSoftly(standing, standing.garments[0]);
  std::unique_ptr<Scenario> s = buildAlone(standing, whole, garment);
  Model& m = *s->model;
  m.sewing_options = {closing_per_s, closing_m_per_s};
  // Points of trimmed patches are no places of the cloth: where all weigh the same, those that bear little lag.
  if (one.garments[0].cloth.kind == ClothKind::triangles) evenMasses(m);
  for (std::size_t i = 0; i < m.mass_kg.size(); ++i) m.drag_kg_per_s[i] = closing_drag_per_s * m.mass_kg[i];
  const double move_s = whole.dressing.settle_s;
  if (!s->human) return s;
  if (const Posture placed = puttingOnPosture(whole, one.garments[0], *s->human);
      move_s > 0 && !areSame(placed, s->motion->at(0))) {
    s->stage->dressed = placed;
    s->stage->settle_start_s = -move_s;
    s->start_s = s->stage->grow_start_s = -(close_s + move_s);
  }
  bridgeSkin(*s, 0);
  return s;
}

void requireWorn(const Scenario& panels, const State& closed) {
  if (!panels.human) return;
  StepWork work;
  const double rise_m = meanHeight(*panels.model, closed) - meanHeight(*panels.model, startOf(panels, work));
  if (!(std::abs(rise_m) <= most_rise_m))
    throw RunError(
        fmt::format("it has slipped off its wearer while its seams closed: it is {:.0f} cm {} than its panels stood "
                    "(at most {:.0f}); "
                    "finer cells, or the other way to place its panels (\"placing\" in the pattern's file: given, "
                    "regions), may keep it on",
                    100 * std::abs(rise_m), rise_m > 0 ? "higher" : "lower", 100 * most_rise_m));
}

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

}  // namespace gambeson
