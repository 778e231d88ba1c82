/// Detail of build.hpp: the model as a whole.

#include <algorithm>

#include "cases/structure/build.hpp"

namespace gambeson {

StructureModel buildModel(const StructureCase& c, StructureOptions& options) {
  StructureModel m;
  m.sheet = sheetOf(c);
  std::unique_ptr<const Cloth> cloth = clothOf(c, m.sheet);
  options = optionsOf(c, m.sheet, *cloth);
  m.structure = buildStructure(std::move(cloth), options);
  m.stress = m.structure->cloth->stress();
  return m;
}

namespace {

/// As many samples along a cell as see every control point: two, or the patch's degree.
std::vector<int> samplesOf(const Sheet& sheet) {
  std::vector<int> samples;
  for (const NurbsPatch& p : sheet.garment.patches) samples.push_back(std::max({2, p.u.degree, p.v.degree}));
  return samples;
}

/// Of the loads that act on all of it [m/s^2]: what a tolerance of contacts is a part of.
double gravityOf(const StructureCase& c) {
  double most = 0;
  for (const StructureLoad& l : c.loads)
    if (l.sort == LoadSort::gravity) most = std::max(most, norm(l.vector));
  return most;
}

}  // namespace

void addMotion(const StructureCase& c, StructureModel& m) {
  if (c.kind != StructureKind::dynamics || !c.dynamics.stepsPoints()) return;
  auto stage = std::make_unique<ObstacleStage>();
  ModelOptions o;
  o.structure = m.structure.get();
  o.self_contact = c.contact && c.contact->self;
  if (c.contact) o.patch_samples_per_cell = samplesOf(m.sheet);
  if (c.strain_limit) o.strain_limit = limitOf(*c.strain_limit);
  std::vector<Obstacle> obstacles = stage->place(c.obstacles, makeObstacles(c.obstacles));
  m.motion = buildModel(m.structure->cloth, o, {Vec3{}, 0},
                        c.contact ? contactOf(*c.contact, gravityOf(c), c.obstacles, 0) : ContactParameters{},
                        std::move(obstacles));
  m.stage = std::move(stage);
}

StructureModel buildModel(const StructureCase& c) {
  StructureOptions options;
  return buildModel(c, options);
}

}  // namespace gambeson
