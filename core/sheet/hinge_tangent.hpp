#pragma once
/// Second derivatives of the springs along seams.

#include "core/sheet/seams.hpp"

namespace gambeson {

/// d2/dq2 of 1/2 stiffness (theta - theta0)^2 length: pairs of columns I <= J, I slowest; nine values each, row by row,
/// rows for the components of I. `pairs` holds 9 n (n + 1) / 2 values for n columns.
void hingeTangent(const HingePoint& hinge, std::span<const Vec3> q, double* pairs);

}  // namespace gambeson
