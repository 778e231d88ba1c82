#include "cases/wear/recording/recorded_scene.hpp"

#include <variant>

#include "cases/wear/recording/scene_fields.hpp"
#include "cases/wear/scene/bodies.hpp"

namespace gambeson {

/// One of the case's own obstacles.
struct RecordedObstacle {
  Shape shape;
  Vec3 origin_m;
  std::optional<Snapshots> snapshots;
};
template <class A, Of<RecordedObstacle> T>
void fields(A& a, T& o) {
  auto& [shape, origin, snapshots] = o;
  a("shape", shape)("origin", origin)("snapshots", snapshots);
}

/// All of a scene.
struct RecordedScene {
  std::optional<Human> human;
  std::optional<Postures> motion;
  Vec3 mean_velocity_m_per_s;
  double air_ramp_s = 0;
  std::optional<Posture> dressed;
  std::vector<Placement> shrunk;
  std::vector<Vec3> shrunk_skin;
  BridgedFolds bridged;
  std::optional<FootReport> feet;
  std::vector<RecordedObstacle> obstacles;
  Wardrobe wardrobe;
  std::vector<std::string> notes, facts;
};
template <class A, Of<RecordedScene> T>
void fields(A& a, T& s) {
  auto& [human, motion, velocity, ramp, dressed, shrunk, shrunk_skin, bridged, feet, obstacles, wardrobe, notes,
         facts] = s;
  a("human", human)("motion", motion)("mean_velocity", velocity)("air_ramp", ramp)("dressed", dressed);
  a("shrunk", shrunk)("shrunk_skin", shrunk_skin)("feet", feet)("obstacles", obstacles);
  a("garments", wardrobe.drafts)("meshes", wardrobe.meshes)("notes", notes);
  if (a.has("facts")) a("facts", facts);               // recordings from before have none
  if (a.has("bridged.vertex")) a("bridged", bridged);  // likewise
}

std::map<std::string, Values> sceneOf(const Scenario& s) {
  const CaseStage& stage = *s.stage;
  RecordedScene scene;
  scene.human = s.human;
  if (s.motion) scene.motion = posturesOf(s);
  scene.mean_velocity_m_per_s = s.mean_velocity_m_per_s;
  scene.air_ramp_s = s.air_ramp_s;
  scene.dressed = stage.dressed;
  scene.shrunk = stage.shrunk;
  scene.shrunk_skin = stage.shrunk_skin;
  scene.bridged = stage.bridged;
  scene.feet = s.feet;
  for (std::size_t k = 0; k < stage.own.count(); ++k) {
    RecordedObstacle& o = scene.obstacles.emplace_back();
    o.shape = s.model->obstacles[static_cast<std::size_t>(stage.first_own) + k].shape;
    o.origin_m = stage.own.start(k).origin;
    if (const MeshSequence* sequence = stage.own.sequence(k)) o.snapshots = sequence->snapshots();
  }
  scene.wardrobe = s.wardrobe;
  scene.notes = s.notes;
  scene.facts = s.facts;
  ArchiveWriter archive;
  fields(archive, scene);
  return archive.values();
}

std::unique_ptr<Scenario> scenarioOf(const Case& c, const std::map<std::string, Values>& values,
                                     const std::string& file) {
  RecordedScene scene;
  ArchiveReader archive(values, file);
  fields(archive, scene);
  MadeBodies bodies;
  bodies.human = std::move(scene.human);
  if (scene.motion) bodies.motion = std::make_unique<RecordedMotion>(std::move(*scene.motion));
  bodies.mean_velocity_m_per_s = scene.mean_velocity_m_per_s;
  bodies.air_ramp_s = scene.air_ramp_s;
  bodies.feet = scene.feet;
  for (RecordedObstacle& o : scene.obstacles)
    bodies.obstacles.push_back({std::move(o.shape), o.origin_m,
                                o.snapshots ? std::make_unique<const MeshSequence>(std::move(*o.snapshots)) : nullptr});
  bodies.notes = std::move(scene.notes);
  bodies.facts = std::move(scene.facts);
  if (bodies.obstacles.size() != c.obstacles.size() || scene.wardrobe.drafts.size() != c.garments.size() ||
      scene.wardrobe.meshes.size() != c.garments.size() || bodies.human.has_value() != c.human.has_value())
    throw InputError({file, 0, ""}, "damaged file of a recording: its scene is not that of its case");
  std::unique_ptr<Scenario> s = buildRecorded(c, std::move(bodies), std::move(scene.wardrobe));
  s->stage->dressed = std::move(scene.dressed);
  s->stage->shrunk = std::move(scene.shrunk);
  s->stage->shrunk_skin = std::move(scene.shrunk_skin);
  s->stage->bridged = std::move(scene.bridged);
  return s;
}

}  // namespace gambeson
