#pragma once
/// From a case to what the solvers take.

#include <memory>

#include "cases/structure/case.hpp"
#include "core/cloth/shell/stress_field.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

struct StructureModel {
  Sheet sheet;  ///< with fabrics
  std::unique_ptr<Structure> structure;
  std::unique_ptr<StressField> stress;  ///< how its stress is shown
};

/// The sheet with its materials. Throws InputError whose key is relative to the case ("sheet.trim[0]").
Sheet sheetOf(const StructureCase& c);
/// Supports and loads of a sheet. Throws InputError with keys such as "supports[1]" or "loads[0].edge".
StructureOptions optionsOf(const StructureCase& c, const Sheet& sheet);
/// Whether `at: rest` of a modal case leaves the loads out.
inline bool withLoads(const StructureCase& c) { return c.kind != StructureKind::modal || c.modal.at_equilibrium; }

StructureModel buildModel(const StructureCase& c);

}  // namespace gambeson
