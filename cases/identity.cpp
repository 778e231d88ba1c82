#include "cases/case.hpp"
#include "cases/fingerprint.hpp"

namespace gambeson {

std::string caseIdentity(const Case& c) {
  Fingerprint hash;
  Case named = c;
  for (GarmentCase& g : named.garments)
    if (auto* file = std::get_if<FileGarment>(&g.shape)) hash.addFile(file->path);
  if (named.human) {
    hash.addFile(named.human->urdf);
    hash.addFile(named.human->body);
    if (auto* trajectory = std::get_if<TrajectoryMotion>(&named.human->motion)) hash.addFile(trajectory->file);
    if (auto* recorded = std::get_if<MotionFileOptions>(&named.human->motion)) {
      hash.addFile(recorded->path);
      hash.addFile(recorded->model);
      std::filesystem::path map = recorded->map;
      if (map.is_absolute()) {  // not the name of one that ships
        hash.addFile(map);
        recorded->map = map.string();
      }
    }
  }
  hash.addFile(named.dressing.from);
  for (ObstacleCase& o : named.obstacles)
    if (auto* mesh = std::get_if<MeshObstacle>(&o.shape)) hash.addFile(mesh->file);
  hash.add(writeCase(named));
  return hash.text();
}

}  // namespace gambeson
