#pragma once
/// From a case to what the solvers take.

#include <memory>

#include "cases/contact/stage.hpp"
#include "cases/structure/case.hpp"
#include "core/motion/structure_motion.hpp"

namespace gambeson {

struct StructureModel {
  Sheet sheet;  ///< with fabrics
  std::unique_ptr<Structure> structure;
  // Of explicit steps; else null.
  std::unique_ptr<const Model> motion;  ///< refers to the structure
  std::unique_ptr<const ObstacleStage> stage;
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

/// `options` gets its supports and loads. Without `motion`: not everything has a mass.
StructureModel buildModel(const StructureCase& c, StructureOptions& options);
/// Adds what explicit steps need, where the case takes them. Throws InputError with keys such as "obstacles[0].mesh".
void addMotion(const StructureCase& c, StructureModel& model);
StructureModel buildModel(const StructureCase& c);

}  // namespace gambeson
