#pragma once
/// On which side of a plane a point lies, exactly, and never "on it": ties are broken by simulation of simplicity
/// (Edelsbrunner and Mücke, 1990) instead of the random noise of Zheng 2013, section 4.1.

#include <array>
#include <span>

#include "core/math/vec.hpp"

namespace gambeson {

/// Sign, +1 or -1, of n . (x_d - x_a), n = (x_b - x_a) x (x_c - x_a) for four different vertices {a, b, c, d}.
/// Where the four points lie in one plane the answer is that of points moved by infinitely small amounts: coordinate c
/// of vertex v by eps^(2^(3 v + 2 - c)), eps -> 0, so lower vertices move farther. All answers about one mesh belong to
/// the same moved points: no vertex of these lies on a foreign face, no edge meets a foreign edge. Exact for
/// coordinates that are 0 or between 1e-60 and 1e60 in size (no product of three underflows or overflows), compiled
/// without contraction of multiply-add: the callers see to both.
int orientation(std::span<const Vec3> x, const std::array<int, 4>& vertices);

}  // namespace gambeson
