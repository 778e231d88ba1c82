#include "cases/wear/scene/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cases/input/overloaded.hpp"
#include "cases/input/places.hpp"
#include "cases/wear/case/factors.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/scene/cloth.hpp"
#include "cases/wear/scene/contact_regions.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/obstacle_shape.hpp"
#include "cases/wear/scene/stage.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"
#include "core/material/coarseness.hpp"
#include "core/motion/step.hpp"
#include "human/body/body.hpp"
#include "human/body/mesh_sequence.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/trajectory.hpp"
#include "human/skin/overlap.hpp"
#include "tryon/projecting.hpp"
#include "tryon/skin_projecting.hpp"

namespace gambeson {
namespace {

/// Feet of our own motions slip and sink by a centimetre or two at most.
bool plausible(const FootReport& f) { return f.slip_m < 0.05 && f.penetration_m < 0.02 && f.hover_m < 0.02; }

void noteDefects(const MeshObstacle& file, const std::string& name, const Obstacle& obstacle,
                 std::vector<std::string>& notes) {
  std::string defects;
  try {
    defects = meshDefects(meshTopology(std::get<TriangleMesh>(obstacle.shape)));
  } catch (const InputError& e) {
    throw InputError({file.file.string(), 0, ""}, "the mesh of obstacle " + name + ": " + e.reason());
  }
  if (!defects.empty()) notes.push_back("obstacle " + name + " (" + file.file.filename().string() + ") " + defects);
}

void noteSequence(const SequenceObstacle& file, const MeshSequence& sequence, const std::string& name,
                  std::vector<std::string>& notes) {
  std::string defects;
  try {
    defects = meshDefects(meshTopology(sequence.first()));
  } catch (const InputError& e) {
    throw InputError({file.folder.string(), 0, ""}, "the mesh of obstacle " + name + ": " + e.reason());
  }
  notes.push_back(fmt::format("obstacle {} ({}): {} frames from {:.3f} to {:.3f} s, {} triangles{}", name,
                              file.folder.filename().string(), sequence.frames(), file.begin_s, sequence.end_s(),
                              sequence.triangles().size(), defects.empty() ? "" : "; it " + defects));
}

}  // namespace

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

/// Reads a recorded motion, its mean velocity, and what a user should know of it; returns when its window begins.
double readRecorded(const MotionFileOptions& m, Scenario& s) {
  MotionFileNotes notes;
  s.motion = loadMotionFile(m, *s.human, &notes);
  const Vec3 way = s.motion->at(s.motion->duration()).root.origin - s.motion->at(notes.window_s).root.origin;
  s.mean_velocity_m_per_s = Vec3{way.x, way.y, 0} / (s.motion->duration() - notes.window_s);
  const std::string file = m.path.filename().string();
  for (const std::string& line : notes.lines) s.notes.push_back(fmt::format("motion {}: {}", file, line));
  if (notes.beyond_limits_deg > 5)
    s.notes.push_back(fmt::format("motion {}: {} goes {:.0f} degrees beyond its limits", file, notes.beyond_joint,
                                  notes.beyond_limits_deg));
  s.notes.push_back(fmt::format(
      "motion {}: feet at most {:.0f} mm below and {:.0f} mm above the ground, slip of carrying feet {:.2f} m/s RMS",
      file, 1e3 * notes.feet.deepest_m, 1e3 * notes.feet.highest_m, notes.feet.slip_m_per_s));
  return notes.window_s;
}

void noteCharacter(const CharacterOptions& options, const CharacterReport& found, std::vector<std::string>& notes) {
  const std::string file = options.file.filename().string();
  notes.push_back(fmt::format(
      "character {}: bones as in the map {}, {}-pose (arms {:.0f} degrees from hanging down), {:.3f} m tall, {:.1f} "
      "litres",
      file, found.map, found.pose, found.arms_deg, found.height_m, 1000 * found.volume_m3));
  for (const std::string& note : found.notes) notes.push_back(fmt::format("character {}: {}", file, note));
}

/// Says where the skin passes through itself, and switches it off there where asked. Our own motions keep our own skins
/// from it (tests/unit/human/skin/fold_test.cpp).
void noteFolds(const HumanCase& human, Scenario& s) {
  constexpr double every_s = 0.05;
  const OverlapOfMotion o = overlapOf(*s.human, *s.motion, every_s);
  if (o.folded == 0) return;
  std::string note = fmt::format(
      "the skin passes through itself at {} of {} instants of the motion, with at most {:.1f} cm^2 (at {:.2f} s), at "
      "{}",
      o.folded, o.instants, 1e4 * o.largest_m2, o.largest_time_s, fmt::join(o.links, ", "));
  if (human.character && human.character->folds_off) {
    Skin skin = *s.human->skin;
    skin.off = o.triangles;
    s.human->skin = std::make_shared<const Skin>(std::move(skin));
    note += fmt::format("; {:.1f} cm^2 are switched off", 1e4 * o.area_m2);
  } else if (std::holds_alternative<MotionFileOptions>(human.motion)) {
    note += "; hips_apart and arms_apart hold the limbs apart";
  }
  s.notes.push_back(note);
}

class Standing : public Motion {
 public:
  Standing(Posture p, double d) : posture_(std::move(p)), duration_(d) {}
  double duration() const override { return duration_; }
  Posture at(double) const override { return posture_; }

 private:
  Posture posture_;
  double duration_;
};

/// The human of the case and his motion; returns his obstacles.
std::vector<Obstacle> addHuman(const Case& c, Scenario& s, CaseStage& stage) {
  CharacterReport character;
  s.human = underKey("human", [&] { return humanOf(*c.human, &character); });
  if (c.human->character) noteCharacter(*c.human->character, character, s.notes);
  underKey("human.motion", [&] {
    std::visit(
        Overloaded{
            [&](const StandMotion& m) { s.motion = std::make_unique<Standing>(standing(*s.human), m.duration_s); },
            [&](const WalkOptions& w) {
              s.motion = makeWalk(*s.human, w, &s.mean_velocity_m_per_s);
              stage.air_ramp_s = w.stand_s + w.lead_in_s;
            },
            [&](const StairOptions& o) {
              s.motion = makeStairs(*s.human, o, &s.mean_velocity_m_per_s);
              stage.air_ramp_s = o.stand_s + o.lead_in_s;
            },
            [&](const AimOptions& o) { s.motion = makeAim(*s.human, o); },
            [&](const TrajectoryMotion& t) { s.motion = loadTrajectory(t.file, *s.human); },
            [&](const MotionFileOptions& m) { stage.air_ramp_s = readRecorded(m, s); },
        },
        c.human->motion);
  });
  const bool own_motion = !std::holds_alternative<MotionFileOptions>(c.human->motion) &&
                          !std::holds_alternative<TrajectoryMotion>(c.human->motion);
  if (s.human->skin && !(own_motion && c.human->skin)) noteFolds(*c.human, s);
  s.feet = footReport(*s.human, *s.motion);
  const bool told = std::holds_alternative<MotionFileOptions>(c.human->motion);  // by its own reader
  if (s.feet && !told && !plausible(*s.feet)) s.notes.push_back("the feet do not stand well: " + feetText(*s.feet));
  stage.human = &*s.human;
  stage.motion = s.motion.get();
  for (const Link& link : s.human->skeleton.links) s.bodies.push_back(link.name);
  if (s.human->skin)
    s.body_of_obstacle.push_back(-1);
  else
    for (const BodyShape& shape : s.human->shapes) s.body_of_obstacle.push_back(shape.link);
  return obstaclesOf(*s.human);
}

/// The case's own obstacles, after those of the human.
void addObstacles(const Case& c, Scenario& s, CaseStage& stage, std::vector<Obstacle>& obstacles) {
  stage.first_fixed = static_cast<int>(obstacles.size());
  for (std::size_t k = 0; k < c.obstacles.size(); ++k) {
    const ObstacleCase& o = c.obstacles[k];
    const std::string key = fmt::format("obstacles[{}]", k);
    Placement at;
    stage.sequence.push_back(nullptr);
    if (const auto* frames = std::get_if<SequenceObstacle>(&o.shape)) {
      stage.sequence.back() = std::make_unique<const MeshSequence>(*frames);
      obstacles.push_back({stage.sequence.back()->first(), o.name, true});
      noteSequence(*frames, *stage.sequence.back(), o.name, s.notes);
    } else {
      obstacles.push_back({underKey(key, [&] { return shapeOf(o, at); }), o.name});
    }
    if (const auto* mesh = std::get_if<MeshObstacle>(&o.shape)) noteDefects(*mesh, o.name, obstacles.back(), s.notes);
    stage.fixed.push_back(at);
    stage.fixed_velocity.push_back(o.velocity_m_per_s);
    s.body_of_obstacle.push_back(static_cast<int>(s.bodies.size()));
    s.bodies.push_back(o.name);
  }
}

/// Of a case's garments the only one that a scenario has; all of them where `of` is null.
struct Only {
  const Case* of = nullptr;
  std::size_t garment = 0;
  bool panels = false;
};

/// What is drafted over other garments is drafted over them also where it is put on by itself: it is the same garment.
std::vector<Garment> draftOf(const Case& c, const Only& only, const Human* human) {
  if (!only.of) return draftGarments(c, human);
  return {std::move(draftGarments(withFactors(*only.of), human)[only.garment])};
}

/// Runs f; an InputError of it about the cloth as a whole is said at the garment, where there is one, or at garments.
template <class F>
auto underGarments(const Case& c, const Only& only, F f) {
  const std::string key = c.garments.size() == 1 ? fmt::format("garments[{}]", only.garment) : "garments";
  try {
    return f();
  } catch (const InputError& e) {
    const std::string& inner = e.where().key;
    if (!e.where().file.empty() || inner.starts_with("strain_limit")) throw;
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
    if (N > kCoarse)
      s.notes.push_back(fmt::format(
          "{}cells of up to {:.3g} mm are coarse for cloth that bends so easily: it folds as if it were stiffer, at a "
          "coarseness of {:.0f} ({:.0f}: tips of heavy strips off by 3 % of their length, 100: by 10 % and more); "
          "cells of {:.2g} mm would do",
          c.garments[k].name.empty() ? "" : c.garments[k].name + ": ", 1e3 * cell, N, kCoarse,
          1e3 * fineEnough(cell, N)));
  }
}

std::unique_ptr<Scenario> buildUnnamed(const Case& written, const Only& only) {
  auto s = std::make_unique<Scenario>();
  s->definition = written;
  const Case c = withFactors(written);
  auto stage = std::make_unique<CaseStage>();
  std::vector<Obstacle> obstacles;
  if (c.human) obstacles = addHuman(c, *s, *stage);
  stage->air_velocity = c.air.with_pelvis ? s->mean_velocity_m_per_s : c.air.velocity_m_per_s;
  if (!c.air.with_pelvis) stage->air_ramp_s = 0;
  addObstacles(c, *s, *stage, obstacles);

  const Human* human = s->human ? &*s->human : nullptr;
  const std::vector<Garment> garments = draftOf(c, only, human);
  std::vector<int> first{0};
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const Garment& g = garments[k];
    const std::string& name = c.garments[k].name;
    for (const std::string& part : g.patch_names)
      s->patch_names.push_back(garments.size() == 1 ? part : g.patch_names.size() == 1 ? name : name + " " + part);
    if (std::find(s->fabric_names.begin(), s->fabric_names.end(), g.fabric.name) == s->fabric_names.end())
      s->fabric_names.push_back(g.fabric.name);
    first.push_back(first.back() + static_cast<int>(g.patch_names.size()));
  }
  ClothDraft draft = underGarments(c, only, [&] { return clothOf(c, written.factors, garments, only.panels); });
  s->samples_per_cell = draft.samples_per_cell;
  const std::vector<Vec3>& start = draft.start_m;
  ModelOptions options;
  options.stitches = std::move(draft.stitches);
  options.patch_samples_per_cell = s->samples_per_cell;
  options.self_contact = c.contact.self;
  options.anchor_count = human ? static_cast<int>(human->skeleton.links.size()) : 0;
  const Surface surface = underGarments(c, only, [&] { return draft.cloth->surface(s->samples_per_cell); });
  addSupports(c, *draft.cloth, first, draft.edges, surface, human, options, s->supports);
  if (const auto& limit = c.strain_limit) options.strain_limit = wornLimit(*limit);
  Environment environment{c.gravity_m_per_s2, c.air.drag_kg_per_m2s};
  const double g = norm(c.gravity_m_per_s2);
  const ContactParameters contact{c.contact.layer_m.value_or(0), c.contact.friction,
                                  c.contact.relaxation_s,        c.contact.tolerance * (g > 0 ? g : 9.81),
                                  c.contact.max_iterations,      c.contact.compliance_m_per_Pa};
  s->model = underGarments(
      c, only, [&] { return buildModel(std::move(draft.cloth), options, environment, contact, std::move(obstacles)); });
  noteCoarseness(c, garments, first, *s);
  findHeldPoints(*s->model, s->supports);

  if (std::any_of(start.begin(), start.end(), [](const Vec3& n) { return n != Vec3{}; }))
    for (std::size_t i = 0; i < s->model->cloth->map().home.size(); ++i)
      s->shift_m.push_back(s->model->held[i] ? Vec3{}
                                             : start[static_cast<std::size_t>(s->model->cloth->map().home[i])]);

  std::vector<Vec3> at_start = s->model->cloth->rest();
  for (std::size_t i = 0; i < at_start.size(); ++i) at_start[i] += start[i];
  nameContactRegions(*s, garments, first, at_start);

  const bool project = c.dressing.projecting && human && !c.dressing.layer_by_layer && c.dressing.from.empty();
  const double grow = project ? c.dressing.projecting->grow_s : 0, settle = human ? c.dressing.settle_s : 0;
  s->start_s = -(grow + settle);
  s->end_s = c.time.duration_s ? *c.time.duration_s : s->motion ? s->motion->duration() : 0;
  stage->grow_start_s = s->start_s;
  stage->grow_s = grow;
  stage->settle_start_s = -settle;
  if (!c.dressing.from.empty()) {
    const Dressed dressed = readDressed(c.dressing.from);
    wear(*s, dressed);
    stage->dressed = dressed.posture;
  } else if (settle > 0 && std::any_of(c.garments.begin(), c.garments.end(),
                                       [](const GarmentCase& worn) { return kindOf(worn).drafted; })) {
    stage->dressed = standing(*s->human);  // which the garments are drafted for
  }
  if (project) {
    std::vector<Vec3> X(s->model->surface.size());
    s->model->surface.W.multiply<Vec3>(at_start, X);
    const Posture posture = stage->postureAt(s->start_s);
    const std::vector<Pose> poses = linkPoses(human->skeleton, posture.q, posture.root);
    const double clearance = c.dressing.projecting->clearance_m;
    if (human->skin) {
      stage->shrunk_skin = shrinkSkinToFree(*human, poses, X, clearance).x;
    } else {
      const std::vector<Obstacle> shapes = obstaclesOf(*human);
      stage->shrunk = shrinkToFree(ProximityQuery(shapes), shapes, placementsOf(*human, poses), X, clearance);
    }
  }
  s->stage = std::move(stage);
  return s;
}

}  // namespace

State startOf(const Scenario& s, StepWork& work) {
  State state = initialState(*s.model, *s.stage, s.start_s, work);
  if (s.shift_m.empty() && s.start_m.empty()) return state;
  const std::vector<Vec3> drafted = state.anchors;
  if (!s.start_m.empty())
    state.p = s.start_m;
  else
    for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] += s.shift_m[i];
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

std::unique_ptr<Scenario> buildAlone(const Case& one, const Case& whole, std::size_t garment) {
  return build(one, {&whole, garment});
}

std::unique_ptr<Scenario> buildPanels(const Case& one, const Case& whole, std::size_t garment) {
  if (one.garments.size() != 1 || !one.garments[0].stitching)
    throw InputError({one.file.string(), 0, "stitching"}, "panels are those of one garment that is to be stitched");
  return build(one, {&whole, garment, true});
}

}  // namespace gambeson
