#pragma once
/// The stiffness of a rotational spring along a seam.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/draft/seams.hpp"

namespace gambeson {

/// d2E/dq2 of E = 1/2 stiffness_length (theta - theta0)^2, whole: material and geometric part, symmetric. blocks[I n +
/// J] (3 x 3, row by row) belongs to columns[I], columns[J]; n is their number.
void hingeStiffness(const HingePoint& hinge, std::span<const Vec3> q, std::vector<std::array<double, 9>>& blocks,
                    bool definite = false);

}  // namespace gambeson
