/// Detail of case.hpp: the files that a case names, and its hash.

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/fingerprint.hpp"
#include "cases/structure/case.hpp"

namespace gambeson {

namespace {

template <class Take>
void eachFile(StructureCase& named, Take take) {
  if (auto* file = std::get_if<SheetFile>(&named.sheet.shape)) take(file->path);
  for (ObstacleCase& o : named.obstacles) kindOf(o).files(o, take);
  const auto takeMaterial = [&](MaterialCase& m) {
    if (m.card.is_absolute()) take(m.card);  // else of the library, whose numbers the case says
    if (m.energy_source) take(m.energy_source->file);
  };
  takeMaterial(named.material);
  for (MaterialCase& m : named.other_materials) takeMaterial(m);
}

}  // namespace

std::string caseIdentity(const StructureCase& c) {
  Fingerprint hash;
  StructureCase named = c;
  eachFile(named, [&](std::filesystem::path& file) { hash.addFile(file); });
  hash.add(writeCase(named));
  return hash.text();
}

std::vector<std::filesystem::path> inputsOf(const StructureCase& c) {
  std::vector<std::filesystem::path> files{c.file};
  StructureCase named = c;
  eachFile(named, [&](std::filesystem::path& file) {
    if (!file.empty()) files.push_back(file);
  });
  return files;
}

}  // namespace gambeson
