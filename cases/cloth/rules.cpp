#include "cases/cloth/rules.hpp"

namespace gambeson::schema {

void checkBending(const Entry& entry, const ClothModel& model) {
  const auto refuse = [&](const char* key, const char* reason) {
    if (entry.node.find(key)) entry.failAt(key, reason);
  };
  if (model.kind == ClothKind::nurbs) refuse("bending_elements", "is for \"model\": \"triangles\"");
  if (model.kind == ClothKind::nurbs || model.bending != BendingElements::springs)
    refuse("bending_spring", "is for triangles with \"bending_elements\": \"springs\"");
}

}  // namespace gambeson::schema
