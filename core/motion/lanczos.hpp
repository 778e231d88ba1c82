#pragma once
/// What an estimate of the largest frequency (frequency.cpp) consists of, whatever makes it.

#include <cstdint>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Of the largest component of a displacement over which forces are compared [m].
constexpr double kComparedOver_m = 1e-7;

/// A fixed number in (-1, 1) for each index, so that a start vector is never blind to a mode.
GAMBESON_HD inline double scatter(std::uint64_t i) {
  i += 0x9e3779b97f4a7c15ULL;
  i = (i ^ (i >> 30)) * 0xbf58476d1ce4e5b9ULL;
  i = (i ^ (i >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((i ^ (i >> 31)) >> 11) / 4503599627370496.0 - 1.0;
}

/// Block i of what an estimate starts from: the last mode with `noise` of everything, or (null) everything alone.
GAMBESON_HD inline Vec3 startOfLanczos(int i, const Vec3* mode, double noise) {
  const std::uint64_t at = 3 * static_cast<std::uint64_t>(i);
  const Vec3 all{scatter(at), scatter(at + 1), scatter(at + 2)};
  return mode ? *mode + noise * all : all;
}
/// For vectors of n blocks.
double noiseOfLanczos(int n);

/// Whether a new direction of this length is one, or all have been found. `first`: the first of the diagonal.
bool goesOn(double length, double first);

/// The largest eigenvalue of a tridiagonal matrix, and its vector.
struct LargestOf {
  double value = 0;
  std::vector<double> vector;
};
/// `off`: at least one fewer than the diagonal has.
LargestOf largestOf(std::span<const double> diagonal, std::span<const double> off);

}  // namespace gambeson
