#include "cases/wear/scene/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cases/cloth/usual.hpp"
#include "cases/input/message.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/scene/bodies.hpp"
#include "cases/wear/scene/cloth.hpp"
#include "cases/wear/scene/contact_regions.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/stage.hpp"
#include "cases/wear/scene/supports.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/contact/penalty.hpp"
#include "core/error.hpp"
#include "core/material/coarseness.hpp"
#include "core/motion/step.hpp"
#include "human/body/body.hpp"
#include "human/skin/bridge_folds.hpp"
#include "tryon/projecting.hpp"
#include "tryon/skin_projecting.hpp"

namespace gambeson {

std::string feetText(const FootReport& f) {
  return fmt::format(
      "the foot that stands slips by up to {:.1f} mm (at most {:.2f} m/s, at {:.2f} s), feet enter the "
      "ground by up to {:.1f} mm (at {:.2f} s) and hover up to {:.1f} mm above it (at {:.2f} s)",
      1e3 * f.slip_m, f.slip_m_per_s, f.slip_time_s, 1e3 * f.penetration_m, f.penetration_time_s, 1e3 * f.hover_m,
      f.hover_time_s);
}

std::vector<Placement> Scenario::obstaclePlacements(double time_s) const {
  std::vector<Placement> obstacles(model->obstacles.size()), anchors(model->anchor_count);
  stage->placements(time_s, obstacles, anchors);
  return obstacles;
}

int Scenario::bodyOf(int obstacle, const MaterialPoint& touched) const {
  const int body = body_of_obstacle[obstacle];
  if (body >= 0) return body;
  const auto most = std::max_element(touched.weight.begin(), touched.weight.end()) - touched.weight.begin();
  return human->skin->segment[touched.vertex[most]];
}

std::vector<Pose> Scenario::bodyPoses(double time_s) const {
  std::vector<Placement> obstacles(model->obstacles.size()), anchors(model->anchor_count);
  stage->placements(time_s, obstacles, anchors);
  std::vector<Pose> poses;
  for (const Placement& a : anchors) poses.push_back({a.rotation, a.origin});
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    if (body_of_obstacle[o] >= static_cast<int>(anchors.size()))
      poses.push_back({obstacles[o].rotation, obstacles[o].origin});
  return poses;
}

namespace {

/// Of a case's garments the only one that a scenario has; all of them where `of` is null.
struct Only {
  const Case* of = nullptr;
  std::size_t garment = 0;
  bool panels = false;
  bool closing = false;  ///< its seams are still to be closed
};

/// What is drafted over other garments is drafted over them also where it is put on by itself: it is the same garment.
/// `fits`: takes how each of them fits.
Wardrobe makeGarments(const Case& c, const Only& only, const Human* human, std::vector<GarmentFit>& fits) {
  Wardrobe made;
  if (only.of)
    made.drafts = {std::move(draftGarments(withFactors(*only.of), human)[only.garment])};
  else
    made.drafts = draftGarments(c, human, &fits);
  made.meshes = readMeshes(c, made.drafts);
  return made;
}

/// Runs f; an InputError of it about the cloth as a whole is said at the garment, where there is one, or at garments.
template <class F>
auto underGarments(const Case& c, const Only& only, F f) {
  const std::string key = c.garments.size() == 1 ? fmt::format("garments[{}]", only.garment) : "garments";
  try {
    return f();
  } catch (const InputError& e) {
    const std::string& inner = e.where().key;
    if (!e.where().file.empty() || inner.starts_with("strain_limit") || inner.starts_with("contact.")) throw;
    const bool sampling = inner == "sampling" && c.garments.size() == 1;
    throw InputError({"", 0, sampling ? key + ".samples_per_cell" : keyUnder(key, inner)}, e.reason());
  }
}

/// Says where cells are too coarse for the folds of thin cloth: of each garment its largest cell.
void noteCoarseness(const Case& c, std::span<const Garment> garments, std::span<const int> first_patch, Scenario& s) {
  const double g = norm(c.gravity_m_per_s2);
  for (std::size_t k = 0; k < garments.size(); ++k) {
    double cell = 0;
    for (int i = 0; i < s.model->surface.size(); ++i)
      if (s.model->surface.patch[i] >= first_patch[k] && s.model->surface.patch[i] < first_patch[k + 1])
        cell = std::max(cell, s.model->cell_m[i]);
    const double N = cell > 0 ? coarseness(garments[k].fabric, cell, g) : 0;
    if (!(N > kCoarse)) continue;
    const double fine = fineEnough(cell, N), longer = std::pow(cell / fine, kTimeOfCells);
    s.notes.push_back(fmt::format(
        "{}cells of up to {:.3g} mm are coarse for cloth that bends so easily: it folds as if it were stiffer, by "
        "which "
        "the end of a strip that hangs is off by {} of its length; cells of {:.2g} mm would do (3 %), and take {} "
        "times as long",
        c.garments[k].name.empty() ? "" : c.garments[k].name + ": ", 1e3 * cell, coarseError(N), 1e3 * fine,
        longer < 100 ? fmt::format("some {:.0f}", longer) : "more than a hundred"));
  }
}

/// Names patches and fabrics; returns the first patch of each garment, and their number.
std::vector<int> nameParts(const Case& c, std::span<const Garment> garments, Scenario& s) {
  std::vector<int> first{0};
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const Garment& g = garments[k];
    const std::string& name = c.garments[k].name;
    for (const std::string& part : g.patch_names)
      s.patch_names.push_back(garments.size() == 1 ? part : g.patch_names.size() == 1 ? name : name + " " + part);
    if (std::find(s.fabric_names.begin(), s.fabric_names.end(), g.fabric.name) == s.fabric_names.end())
      s.fabric_names.push_back(g.fabric.name);
    first.push_back(first.back() + static_cast<int>(g.patch_names.size()));
  }
  return first;
}

/// The model of the drafted cloth, with what holds it, among the obstacles.
void buildModelOf(const Case& c, const Only& only, ClothDraft&& draft, const std::vector<int>& first,
                  std::vector<Obstacle> obstacles, Scenario& s) {
  const Human* human = s.human ? &*s.human : nullptr;
  s.samples_per_cell = draft.samples_per_cell;
  ModelOptions options;
  options.stitches = std::move(draft.stitches);
  options.patch_samples_per_cell = s.samples_per_cell;
  options.self_contact = c.contact.self;
  options.anchor_count = human ? static_cast<int>(human->skeleton.links.size()) : 0;
  const Surface surface = underGarments(c, only, [&] { return draft.cloth->surface(s.samples_per_cell); });
  addSupports(c, *draft.cloth, first, draft.edges, surface, human, options, s.supports, s.stage->held_drives);
  if (const auto& limit = c.strain_limit) options.strain_limit = wornLimit(*limit);
  const Environment environment{c.gravity_m_per_s2, c.air.drag_kg_per_m2s};
  ContactParameters contact =
      contactOf(c.contact, norm(c.gravity_m_per_s2), c.obstacles, obstacles.size() - c.obstacles.size());
  if (std::any_of(c.garments.begin(), c.garments.end(), [](const GarmentCase& g) { return g.friction.has_value(); }))
    for (const GarmentCase& g : c.garments) contact.of_garment.push_back(g.friction);
  s.model = underGarments(
      c, only, [&] { return buildModel(std::move(draft.cloth), options, environment, contact, std::move(obstacles)); });
  const double springs = penaltyFrequency(s.model->contact, s.model->density_kg_per_m2);
  if (c.time.step_s * springs > 2)
    throw InputError(
        {"", 0, "time.step"},
        fmt::format("{:.3e} s is longer than the stable step of contact.penalty; allowed: at most {:.3e} s",
                    c.time.step_s, 2 / springs));
  findHeldPoints(*s.model, s.supports);
}

/// Where the cloth's points start, which lie at rest but for `start`; what is held has no noise, and is where its
/// garment's draft has it (`placed`).
std::vector<Vec3> placeCloth(const std::vector<Vec3>& start, const std::vector<Vec3>& placed, Scenario& s) {
  const FreeMap& map = s.model->cloth->map();
  if (std::any_of(start.begin(), start.end(), [](const Vec3& n) { return n != Vec3{}; }))
    for (std::size_t i = 0; i < map.home.size(); ++i)
      s.shift_m.push_back((s.model->held[i] ? placed : start)[static_cast<std::size_t>(map.home[i])]);
  std::vector<Vec3> at_start = s.model->cloth->rest();
  for (std::size_t i = 0; i < at_start.size(); ++i) at_start[i] += start[i];
  return at_start;
}

/// Whether the body starts shrunk inside of the garments and grows into them.
bool isProjected(const Case& c) {
  return c.dressing.projecting && c.human && !c.dressing.layer_by_layer && c.dressing.from.empty();
}

/// When growing, settling and the motion begin.
void planTimes(const Case& c, Scenario& s, CaseStage& stage) {
  const double grow = isProjected(c) ? c.dressing.projecting->grow_s : 0, settle = c.dressing.settle_s;
  s.start_s = -(grow + settle);
  s.end_s = c.time.duration_s ? *c.time.duration_s : s.motion ? s.motion->duration() : 0;
  stage.grow_start_s = s.start_s;
  stage.grow_s = grow;
  stage.settle_start_s = -settle;
}

/// What is worn at the start, and in which posture the garments are put on.
void putOnAtStart(const Case& c, const Only& only, Scenario& s) {
  if (!c.dressing.from.empty()) {
    const Dressed dressed = readDressed(c.dressing.from);
    wear(s, dressed);
    s.stage->dressed = dressed.posture;
  } else if (s.stage->settle_start_s < 0 &&
             std::any_of(c.garments.begin(), c.garments.end(),
                         [](const GarmentCase& worn) { return kindOf(worn).drafted || kindOf(worn).sewn; }) &&
             s.human) {
    // Drafts settle from the posture that they are drafted for; panels have been brought to the first one
    // (close_seams).
    const bool sewn =
        std::any_of(c.garments.begin(), c.garments.end(), [](const GarmentCase& worn) { return kindOf(worn).sewn; });
    s.stage->dressed = sewn && !only.of ? s.motion->at(0) : dressingPosture(only.of ? *only.of : c, *s.human);
  }
}

/// Virtual projecting: the body as it starts, free of the cloth.
void shrinkBody(const Case& c, const std::vector<Vec3>& at_start, Scenario& s) {
  const Human& human = *s.human;
  CaseStage& stage = *s.stage;
  std::vector<Vec3> X(s.model->surface.size());
  s.model->surface.W.multiply<Vec3>(at_start, X);
  const Posture posture = stage.postureAt(s.start_s);
  const std::vector<Pose> poses = linkPoses(human.skeleton, posture.q, posture.root);
  const double clearance = c.dressing.projecting->clearance_m;
  if (human.skin) {
    stage.shrunk_skin = shrinkSkinToFree(human, poses, X, clearance).x;
  } else {
    const std::vector<Obstacle> shapes = obstaclesOf(human);
    stage.shrunk = shrinkToFree(ProximityQuery(shapes), shapes, placementsOf(human, poses), X, clearance);
  }
}

/// A scenario that lacks the start of its run, and where the cloth's points lie at it.
struct Assembled {
  std::unique_ptr<Scenario> scenario;
  std::vector<Vec3> at_start;
};

/// From what was made; `c`: with its factors. Reads no file.
Assembled assemble(const Case& written, const Case& c, const Only& only, MadeBodies bodies, Wardrobe wardrobe) {
  auto s = std::make_unique<Scenario>();
  s->definition = written;
  s->stage = std::make_unique<CaseStage>();
  s->wardrobe = std::move(wardrobe);
  std::vector<Obstacle> obstacles = placeBodies(c, std::move(bodies), *s, *s->stage);
  const std::vector<Garment>& garments = s->wardrobe.drafts;
  const std::vector<int> first = nameParts(c, garments, *s);
  ClothDraft draft =
      underGarments(c, only, [&] { return clothOf(c, written.factors, s->wardrobe, only.panels, only.closing); });
  const std::vector<Vec3> start = std::move(draft.start_m), placed = std::move(draft.placed_m);
  buildModelOf(c, only, std::move(draft), first, std::move(obstacles), *s);
  noteCoarseness(c, garments, first, *s);
  std::vector<Vec3> at_start = placeCloth(start, placed, *s);
  nameContactRegions(*s, garments, first, at_start);
  planTimes(c, *s, *s->stage);
  drawCords(c, s->start_s, s->supports, *s->model);
  return {std::move(s), std::move(at_start)};
}

std::unique_ptr<Scenario> buildUnnamed(const Case& written, const Only& only) {
  const Case c = withFactors(written);
  MadeBodies bodies = makeBodies(c);
  std::vector<GarmentFit> fits;
  Wardrobe wardrobe = makeGarments(c, only, bodies.human ? &*bodies.human : nullptr, fits);
  auto [s, at_start] = assemble(written, c, only, std::move(bodies), std::move(wardrobe));
  // Unusual numbers come first, then what was assumed.
  const JsonNode node = schema::writeObject(schema::caseTable(), &written);
  for (const std::vector<std::string>& notes : {assumedThicknesses(node), unusualNumbers(schema::caseTable(), node)})
    s->notes.insert(s->notes.begin(), notes.begin(), notes.end());
  for (GarmentFit& fit : fits) {
    s->notes.insert(s->notes.end(), fit.notes.begin(), fit.notes.end());
    s->panel_girths.push_back(std::move(fit.girths));
  }
  putOnAtStart(c, only, *s);
  if (!only.closing) bridgeSkin(*s, only.of ? 0 : s->end_s);
  if (isProjected(c)) shrinkBody(c, at_start, *s);
  return std::move(s);
}

}  // namespace

void bridgeSkin(Scenario& s, double until_s) {
  const double room_m = s.hasSkin() ? bridgedFolds_m(*s.definition.human) : 0;
  if (!(room_m > 0)) return;
  // Joints turn by up to 400 degrees a second, and back within a tenth: between instants of 20 ms a fold closes by 0.3
  // degrees more than it is seen to, well within the room; between those of 50 ms by 2, which is 4 mm at a knee.
  constexpr double every_s = 0.02;
  BridgingReport r;
  const CaseStage& stage = *s.stage;
  s.stage->bridged = bridgeFolds(
      *s.human, [&](double t) { return stage.postureAt(t); }, std::min(0.0, stage.settle_start_s),
      std::min(until_s, s.motion->duration()), every_s, room_m, r);
  if (s.stage->bridged.empty()) return;
  std::string note = fmt::format(
      "the skin comes nearer to itself than {:.3g} mm at {} of {} instants, with at most {:.1f} cm^2 (at {:.2f} s), at "
      "{}; its folds are bridged by a surface up to {:.1f} mm from it",
      1e3 * room_m, r.tight, r.instants, 1e4 * r.largest_m2, r.largest_time_s, fmt::join(r.links, ", "),
      1e3 * r.farthest_m);
  if (r.left_m2 > 0)
    note +=
        fmt::format("; {:.1f} cm^2 pass through themselves all the same (at {:.2f} s)", 1e4 * r.left_m2, r.left_time_s);
  s.notes.push_back(note);
}

State startOf(const Scenario& s, StepWork& work) {
  State state = initialState(*s.model, *s.stage, s.start_s, work);
  if (!s.start_history.empty()) state.history = s.start_history;
  const std::vector<Vec3> drafted = state.anchors;
  if (!s.start_m.empty())
    state.p = s.start_m;
  else
    for (std::size_t i = 0; i < s.shift_m.size(); ++i) state.p[i] += s.shift_m[i];
  settleInner(*s.model, state, work);
  if (s.shift_m.empty() && s.start_m.empty() && state.inner.empty()) return state;
  attachSprings(*s.model, *s.stage, state, work);
  if (!s.start_m.empty()) hangSprings(*s.model, *s.stage, drafted, state, work);
  return state;
}

namespace {

/// What only building shows to be wrong (a pattern that does not fit the body, say) is said at its place in the case.
std::unique_ptr<Scenario> build(const Case& c, const Only& only) {
  try {
    return buildUnnamed(c, only);
  } catch (const InputError& e) {
    sayInCase(c.file, c.overrides, e);
  }
}

}  // namespace

std::unique_ptr<Scenario> buildScenario(const Case& c) { return build(c, {}); }

std::unique_ptr<Scenario> buildRecorded(const Case& c, MadeBodies bodies, Wardrobe wardrobe) {
  const Case effective = withFactors(c);
  for (std::size_t k = 0; k < wardrobe.drafts.size(); ++k) {
    addFabric(effective, effective.garments[k], wardrobe.drafts[k]);
    if (wardrobe.meshes[k]) wardrobe.meshes[k]->fabrics = {wardrobe.drafts[k].fabric};
  }
  std::vector<std::string> notes = bodies.notes;  // with all that was said of the garments
  std::unique_ptr<Scenario> s = assemble(c, effective, {}, std::move(bodies), std::move(wardrobe)).scenario;
  s->notes = std::move(notes);
  return s;
}

std::unique_ptr<Scenario> buildAlone(const Case& one, const Case& whole, std::size_t garment) {
  return build(one, {&whole, garment, false, kindOf(one.garments[0]).sewn});
}

std::unique_ptr<Scenario> buildPanels(const Case& one, const Case& whole, std::size_t garment) {
  if (one.garments.size() != 1 || !one.garments[0].stitching)
    throw InputError({one.file.string(), 0, "stitching"}, "panels are those of one garment that is to be stitched");
  return build(one, {&whole, garment, true});
}

}  // namespace gambeson
