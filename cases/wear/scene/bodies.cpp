#include "cases/wear/scene/bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/body/skin.hpp"
#include "human/motion/foot_ground.hpp"
#include "human/skin/bridge_folds.hpp"
#include "human/skin/make_skin.hpp"
#include "human/skin/overlap.hpp"

namespace gambeson {
namespace {

/// Feet of our own motions slip and sink by a centimetre or two at most.
bool plausible(const FootReport& f) { return f.slip_m < 0.05 && f.penetration_m < 0.02 && f.hover_m < 0.02; }

/// Says where the skin passes through itself. Our own motions keep our own skins from it
/// (tests/unit/human/skin/fold_test.cpp). Where its folds are bridged, what of it lies inside as a whole is switched
/// off, an eye say.
void noteFolds(const HumanCase& human, MadeBodies& s) {
  if (const double room_m = bridgedFolds_m(human); room_m > 0) {
    Skin skin = *s.human->skin;
    std::vector<Vec3> x(skin.rest.vertices.size());
    const Posture first = s.motion->at(0);
    skinPositions(skin, linkPoses(s.human->skeleton, first.q, first.root), x);
    skin.off = wholeParts(skin.rest, overlapOf(skin.rest.triangles, x, room_m).triangles);
    s.human->skin = std::make_shared<const Skin>(std::move(skin));
    return;
  }
  constexpr double every_s = 0.02;
  const OverlapOfMotion o = overlapOf(*s.human, *s.motion, every_s);
  if (o.folded == 0) return;
  std::string note = fmt::format(
      "the skin passes through itself at {} of {} instants of the motion, with at most {:.1f} cm^2 (at {:.2f} s), at "
      "{}",
      o.folded, o.instants, 1e4 * o.largest_m2, o.largest_time_s, fmt::join(o.links, ", "));
  if (human.character || human.scan)
    note += "; cloth is pinched there, and \"bridge_folds\": \"10 mm\" keeps it out of folds";
  if (kindOf(human).holds_apart) note += "; hips_apart and arms_apart hold the limbs apart";
  s.notes.push_back(note);
}

/// The human of the case and his motion.
void makeHuman(const Case& c, MadeBodies& s) {
  WearerNotes told;
  s.human = underKey("human", [&] { return humanOf(*c.human, &told); });
  s.notes = std::move(told.notes), s.facts = std::move(told.facts);
  const MotionKind& kind = kindOf(*c.human);
  MadeMotion made = underKey("human.motion", [&] { return kind.make(*c.human, *s.human); });
  s.motion = std::move(made.motion);
  s.mean_velocity_m_per_s = made.mean_velocity_m_per_s;
  s.air_ramp_s = made.air_ramp_s;
  s.hurdle = made.hurdle;
  s.notes.insert(s.notes.end(), made.notes.begin(), made.notes.end());
  s.facts.insert(s.facts.end(), made.facts.begin(), made.facts.end());
  if (s.human->skin && !(kind.ours && c.human->skin)) noteFolds(*c.human, s);
  s.feet = footReport(*s.human, *s.motion, c.time.duration_s.value_or(s.motion->duration()));
  if (s.feet && !kind.tells_feet && !plausible(*s.feet))
    s.notes.push_back("the feet do not stand well: " + feetText(*s.feet));
}

/// Returns the obstacles of the scenario's human.
std::vector<Obstacle> placeHuman(const HumanCase& human, Scenario& s, CaseStage& stage) {
  stage.human = &*s.human;
  stage.motion = s.motion.get();
  for (const Link& link : s.human->skeleton.links) s.bodies.push_back(link.name);
  if (s.human->skin)
    s.body_of_obstacle.push_back(-1);
  else
    for (const BodyShape& shape : s.human->shapes) s.body_of_obstacle.push_back(shape.link);
  if (human.feet) {
    stage.feet_back_s = human.feet->back_s, stage.feet_grow_s = human.feet->grow_s;
    for (const auto& foot : underKey("human.feet", [&] { return footShapes(*s.human); }))
      for (const BodyShape* shape : foot) stage.feet.push_back(static_cast<int>(shape - s.human->shapes.data()));
  }
  return obstaclesOf(*s.human);
}

/// The case's own obstacles, after those of the human.
void placeObstacles(const Case& c, std::vector<MadeObstacle> made, Scenario& s, CaseStage& stage,
                    std::vector<Obstacle>& obstacles) {
  stage.first_own = static_cast<int>(obstacles.size());
  for (Obstacle& o : stage.own.place(c.obstacles, std::move(made))) {
    s.body_of_obstacle.push_back(static_cast<int>(s.bodies.size()));
    s.bodies.push_back(o.segment);
    obstacles.push_back(std::move(o));
  }
}

}  // namespace

double bridgedFolds_m(const HumanCase& human) {
  if (human.character) return human.character->bridge_folds_m;
  return human.scan ? human.scan->bridge_folds_m : 0;
}

MadeBodies makeBodies(const Case& c) {
  MadeBodies made;
  if (c.human) makeHuman(c, made);
  made.obstacles = makeObstacles(c.obstacles, made.hurdle ? &*made.hurdle : nullptr);
  for (const MadeObstacle& o : made.obstacles) made.facts.insert(made.facts.end(), o.notes.begin(), o.notes.end());
  return made;
}

std::vector<Obstacle> placeBodies(const Case& c, MadeBodies made, Scenario& s, CaseStage& stage) {
  s.human = std::move(made.human);
  s.motion = std::move(made.motion);
  s.mean_velocity_m_per_s = made.mean_velocity_m_per_s;
  s.air_ramp_s = made.air_ramp_s;
  s.feet = made.feet;
  s.notes = std::move(made.notes);
  s.facts = std::move(made.facts);
  std::vector<Obstacle> obstacles;
  if (s.human) obstacles = placeHuman(*c.human, s, stage);
  stage.air_velocity = c.air.with_pelvis ? s.mean_velocity_m_per_s : c.air.velocity_m_per_s;
  stage.air_ramp_s = c.air.with_pelvis ? s.air_ramp_s : 0;
  placeObstacles(c, std::move(made.obstacles), s, stage, obstacles);
  return obstacles;
}

}  // namespace gambeson
