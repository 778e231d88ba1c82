/// Detail of build.hpp: the model as a whole.

#include "cases/structure/build.hpp"

namespace gambeson {

StructureModel buildModel(const StructureCase& c) {
  StructureModel m;
  m.sheet = sheetOf(c);
  const StructureOptions options = optionsOf(c, m.sheet);
  m.structure = buildStructure(m.sheet.garment, options);
  m.stress = std::make_unique<StressField>(m.structure->shell);
  return m;
}

}  // namespace gambeson
