#include "cases/wear/scene/bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/input/overloaded.hpp"
#include "cases/input/places.hpp"
#include "cases/wear/case/human.hpp"
#include "cases/wear/scene/obstacle_shape.hpp"
#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"
#include "human/body/mesh_sequence.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/trajectory.hpp"
#include "human/skin/overlap.hpp"

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

}  // namespace

std::vector<Obstacle> placeBodies(const Case& c, Scenario& s, CaseStage& stage) {
  std::vector<Obstacle> obstacles;
  if (c.human) obstacles = addHuman(c, s, stage);
  stage.air_velocity = c.air.with_pelvis ? s.mean_velocity_m_per_s : c.air.velocity_m_per_s;
  if (!c.air.with_pelvis) stage.air_ramp_s = 0;
  addObstacles(c, s, stage, obstacles);
  return obstacles;
}

}  // namespace gambeson
