#pragma once
/// From what a fabric is to what the kernels read.

#include "core/cloth/shell/shell_kernel.hpp"
#include "core/material/fabric.hpp"

namespace gambeson {

/// What the laws need to be laws at all: a positive definite membrane, an eq. 2.14 with a finite slope, a tension field
/// without coupling to bending. NaN fails. Throws InputError whose key starts with `where`.
void checkFabric(const Fabric& fabric, const char* where = "fabric");

/// The law of a fabric in its general form: membrane of eq. 2.13 times the thickness, plane stress, and its bending
/// law; or the laminate of its plies.
PointLaw pointLaw(const Fabric& fabric);

/// The same with the short form where that suffices.
ShellLaw shellLaw(const Fabric& fabric);

/// Whether bending is counted from the rest shape: always for a section that is a solid (BendingLaw::consistent,
/// plies), whose curved rest shape is free of stress; for cloth where it says so.
bool hasRestCurvature(const Fabric& fabric);

/// n and m at one point, for queries: strain (E11, E22, 2 E12), curvature change (k11, k22, 2 k12).
struct PointResultants {
  double n[3], m[3];
};
PointResultants resultants(const PointLaw& law, const double* strain, const double* change);

}  // namespace gambeson
