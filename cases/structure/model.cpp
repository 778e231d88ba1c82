/// Detail of build.hpp: the model as a whole.

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

StructureModel buildModel(const StructureCase& c) {
  StructureOptions options;
  return buildModel(c, options);
}

}  // namespace gambeson
