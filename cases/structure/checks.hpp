#pragma once
/// What a structure's numbers must meet to be worth reading.

#include <vector>

#include "cases/structure/results.hpp"

namespace gambeson {

/// Largest strain up to which two laws that are equally linear, St. Venant-Kirchhoff's and one in logarithmic strain,
/// stay within 15 % of stress of each other: (lambda^2 - 1) lambda/2 against ln(lambda)/lambda at 5 %.
constexpr double kStrainOfLinearLaw = 0.05;

/// Holds or fails, with limits: numbers are finite, forces balance (static), modes are modes (modal), energy does not
/// appear (dynamic), strain is in the range of the material's law (no point beyond that of a table), displacements are of the sheet's size, the path is
/// known between its points. A fabric's range is that of the source of its law (kStrainOfLaw of
/// cases/cloth/fabric.hpp).
std::vector<AuditCheck> structureChecks(const StructureCase& c, const StructureModel& model, const PathTable& path,
                                        const std::vector<ModeRow>& modes, const MeasuredState& last,
                                        const MeshShape& shape, const StructureFacts& facts);

}  // namespace gambeson
