#pragma once
/// The angle of a hinge between two triangles, with its first and second derivatives.

#include <array>
#include <span>

#include "core/math/vec.hpp"

namespace gambeson {

/// Corners: 0 and 1 the common edge, 2 the third corner of the triangle that runs 0, 1, 2, and 3 that of the other,
/// which runs 1, 0, 3.
using HingePoints = std::array<Vec3, 4>;

/// The angle between the normals [rad] in (-pi, pi]: positive where the corners 2 and 3 rise to the side that the
/// normals point to. Its gradient where `gradient` is not null: moving the corners by it turns nothing rigidly, and it
/// sums to zero.
double foldAngle(const HingePoints& x, HingePoints* gradient);

/// Second derivatives of the angle: blocks[4 I + J] (3 x 3, row by row) of corners I and J; symmetric.
void foldAngleHessian(const HingePoints& x, std::array<std::array<double, 9>, 16>& blocks);

}  // namespace gambeson
