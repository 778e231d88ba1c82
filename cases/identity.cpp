#include "cases/case.hpp"
#include "cases/fingerprint.hpp"

namespace gambeson {

namespace {

/// A joint map that is a file, not one that ships.
void addMap(Fingerprint& hash, std::string& map) {
  std::filesystem::path file = map;
  if (!file.is_absolute()) return;
  hash.addFile(file);
  map = file.string();
}

}  // namespace

std::string caseIdentity(const Case& c) {
  Fingerprint hash;
  Case named = c;
  for (GarmentCase& g : named.garments)
    if (auto* file = std::get_if<FileGarment>(&g.shape)) hash.addFile(file->path);
  if (named.human) {
    hash.addFile(named.human->urdf);
    hash.addFile(named.human->body);
    if (auto& character = named.human->character) {
      for (std::filesystem::path file : filesBeside(character->file)) hash.addFile(file);
      hash.addFile(character->file);
      hash.addFile(character->skeleton);
      hash.addFile(character->weights);
      for (MorphTarget& t : character->targets) hash.addFile(t.file);
      addMap(hash, character->map);
    }
    if (auto* trajectory = std::get_if<TrajectoryMotion>(&named.human->motion)) hash.addFile(trajectory->file);
    if (auto* recorded = std::get_if<MotionFileOptions>(&named.human->motion)) {
      hash.addFile(recorded->path);
      hash.addFile(recorded->model);
      addMap(hash, recorded->map);
    }
  }
  hash.addFile(named.dressing.from);
  for (ObstacleCase& o : named.obstacles)
    if (auto* mesh = std::get_if<MeshObstacle>(&o.shape)) {
      hash.addFile(mesh->file);
    } else if (auto* sequence = std::get_if<SequenceObstacle>(&o.shape)) {
      for (std::filesystem::path file : framesIn(sequence->folder)) hash.addFile(file);
      sequence->folder = sequence->folder.filename();
    }
  hash.add(writeCase(named));
  return hash.text();
}

}  // namespace gambeson
