#pragma once
/// Control points that trimming leaves (nearly) without support (Zheng 2013, eq. 2.37), and what they follow.

#include <map>
#include <utility>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// A control point that is not free: the sum of coefficient times control point. Coefficients sum to 1.
struct TrimFollower {
  int patch = 0;
  std::vector<std::pair<int, double>> of;  ///< control points of the garment that keep their support
  bool supported = false;                  ///< some of its support is kept: the rest shape is reproduced
};

/// The control points whose kept area ∫ N dA is below Trim::unused_fraction of the whole one, and what they follow: the
/// polynomial of the patch's degree through the nearest block of (p + 1) x (q + 1) control points that keep their
/// support (extended B-splines, Hoellig, Reif and Wipper 2001, SIAM J. Numer. Anal. 39), of a lower degree where no
/// such block is at hand. The least change of the coefficients then makes them sum to 1 and reproduce the rest
/// position, so that rigid motions stay exact on curved and rational patches too. The thesis gives such a point the
/// displacement of the nearest used one, which strains the rim under a rigid rotation. Throws InputError where a trim
/// takes a control point or a stretch of edge that a seam needs, or leaves no control point.
std::map<int, TrimFollower> trimFollowers(const Garment& garment);

}  // namespace gambeson
