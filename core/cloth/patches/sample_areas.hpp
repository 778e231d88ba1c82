#pragma once
/// Areas of surface samples that stand for the cloth: W^T a = A, the integrals of all functions.

#include <span>
#include <vector>

#include "core/math/sparse.hpp"

namespace gambeson {

/// The smallest a with WTᵀ a = A. Throws InputError where a function vanishes at all samples.
std::vector<double> consistentAreas(const SparseRows& WT, std::span<const double> free_area);

struct SampleAreas {
  std::vector<double> area_m2;  ///< all positive; or empty
  bool undecided = false;       ///< empty since steps ran out: positive ones may exist, and `against` proves nothing
  /// Where no positive ones exist, a function (by free points) that says why: one of positive integral that is nowhere
  /// positive at a sample (Farkas), or one that vanishes at all. Samples where it is high are missing.
  std::vector<double> against;
};

/// The a with WTᵀ a = A that is nearest to g > 0 in the sense of least sum a log(a/g) - a, always positive:
/// a = g exp(WT y), with y from Newton on the convex dual sum g exp(WT y) - A y. Its first step is the minimum of
/// sum (a - g)^2 / g. No area changes more than e-fold in a step; after 300 of them it is undecided.
SampleAreas positiveAreas(const SparseRows& WT, std::span<const double> free_area, std::span<const double> g);

}  // namespace gambeson
