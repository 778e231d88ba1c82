#pragma once
/// From a case to what the solvers take.

#include <memory>

#include "cases/structure/case.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

struct StructureModel {
  Sheet sheet;  ///< with fabrics
  std::unique_ptr<Structure> structure;
  std::unique_ptr<const StressView> stress;  ///< how its stress is shown
};

/// The sheet with its materials. Throws InputError whose key is relative to the case ("sheet.trim[0]").
Sheet sheetOf(const StructureCase& c);
/// The sheet as a cloth. Throws InputError.
std::unique_ptr<const Cloth> clothOf(const StructureCase& c, const Sheet& sheet);
/// Supports and loads of a sheet. Throws InputError with keys such as "supports[1]" or "loads[0].edge".
StructureOptions optionsOf(const StructureCase& c, const Sheet& sheet, const Cloth& cloth);
/// Whether `at: rest` of a modal case leaves the loads out.
inline bool withLoads(const StructureCase& c) { return c.kind != StructureKind::modal || c.modal.at_equilibrium; }

/// `options` gets its supports and loads.
StructureModel buildModel(const StructureCase& c, StructureOptions& options);
StructureModel buildModel(const StructureCase& c);

}  // namespace gambeson
