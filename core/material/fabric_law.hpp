#pragma once
/// From what a fabric is to the numbers that its laws read.

#include "core/material/fabric.hpp"
#include "core/material/laws/point_law.hpp"

namespace gambeson {

/// What the laws need to be laws at all: a positive definite membrane, a bending law with a finite slope, a tension
/// field without coupling to bending. NaN fails. Throws InputError whose key starts with `where`.
void checkFabric(const Fabric& fabric, const char* where = "fabric");

/// The laws of a fabric at any of its points.
PointLaw pointLaw(const Fabric& fabric);

/// Which laws its points follow.
LawUse lawUse(const Fabric& fabric);

/// Whether bending is counted from the rest shape: always for a section that is a solid (ConsistentBending, Laminate),
/// whose curved rest shape is free of stress; for cloth where it says so.
bool hasRestCurvature(const Fabric& fabric);

/// n and m at one point, for queries: strain (E11, E22, 2 E12), curvature change (k11, k22, 2 k12).
PointAnswer<double> resultants(const PointLaw& law, const double* strain, const double* change,
                               History<double> history = {});
/// The same numbers as laws read them, and which laws these are.
PointNumbers<double> numbersOf(const PointLaw& law);
LawUse lawUse(const PointLaw& law);

}  // namespace gambeson
