/// Detail of case.hpp: the files that a case names, and its hash.

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/fingerprint.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/body/urdf.hpp"
#include "human/files/mesh.hpp"

namespace gambeson {

namespace {

/// A joint map that is a file, not one that ships.
template <class Take>
void takeMap(std::string& map, Take take) {
  std::filesystem::path file = map;
  if (!file.is_absolute()) return;
  take(file);
  map = file.string();
}

/// Calls `take` with the path of every file that the case names, empty ones too; it may put another in its place.
template <class Take>
void eachFile(Case& named, Take take) {
  const auto takeFabric = [&](FabricCase& f) {
    if (f.card.is_absolute()) take(f.card);  // else of the library, whose numbers the case says
    if (f.energy_source) take(f.energy_source->file);
  };
  for (GarmentCase& g : named.garments) {
    kindOf(g).files(g, take);
    if (g.fabric) takeFabric(*g.fabric);
    for (FabricCase& f : g.other_fabrics) takeFabric(f);
  }
  takeFabric(named.fabric);
  if (named.human) {
    if (!named.human->urdf.empty())
      for (std::filesystem::path file : filesBesideUrdf(named.human->urdf)) take(file);
    take(named.human->urdf);
    take(named.human->body);
    if (auto& character = named.human->character) {
      for (std::filesystem::path file : filesBeside(character->file)) take(file);
      take(character->file);
      take(character->skeleton);
      take(character->weights);
      for (MorphTarget& t : character->targets) take(t.file);
      takeMap(character->map, take);
    }
    if (auto& scan = named.human->scan) {
      for (std::filesystem::path file : filesBeside(scan->file)) take(file);
      take(scan->file);
    }
    kindOf(*named.human).files(named.human->motion, take, [&](std::string& map) { takeMap(map, take); });
  }
  take(named.dressing.from);
  for (ObstacleCase& o : named.obstacles) kindOf(o).files(o, take);
}

}  // namespace

std::string caseIdentity(const Case& c) {
  Fingerprint hash;
  Case named = c;
  eachFile(named, [&](std::filesystem::path& file) { hash.addFile(file); });
  hash.add(writeCase(named));
  return hash.text();
}

std::vector<std::filesystem::path> inputsOf(const Case& c) {
  std::vector<std::filesystem::path> files{c.file};
  Case named = c;
  eachFile(named, [&](std::filesystem::path& file) {
    if (!file.empty()) files.push_back(file);
  });
  return files;
}

}  // namespace gambeson
