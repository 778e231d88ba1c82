#include "cases/structure_build.hpp"

namespace gambeson {

StructureModel buildModel(const StructureCase& c) {
  StructureModel m;
  m.sheet = sheetOf(c);
  const StructureOptions options = optionsOf(c, m.sheet);
  m.structure = buildStructure(m.sheet.garment, options);
  return m;
}

}  // namespace gambeson
