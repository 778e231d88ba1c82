#include "cases/cell/engine.hpp"

#include "cases/cell/rod_engine.hpp"
#include "cases/cell/solid_engine.hpp"
#include "cases/cell/truss_engine.hpp"
#include "cases/yarns/design.hpp"

namespace gambeson {

std::unique_ptr<const CellEngine> makeEngine(const CellCase& c) {
  switch (c.yarns) {
    case YarnModel::rod:
      return std::make_unique<RodEngine>(rodDesign(c), equilibriumOptions(c.solver));
    case YarnModel::solid:
      return std::make_unique<SolidEngine>(solidDesign(c), solidOptions(c), *c.height_m);
    case YarnModel::truss:
      return std::make_unique<TrussEngine>(trussOf(c), wovenYarns(c));
  }
  return nullptr;
}

}  // namespace gambeson
