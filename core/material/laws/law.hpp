#pragma once
/// What a law is: a pure function of strain or curvature, of its parameters and of what it remembers, that answers
/// with energy, resultants and slope together.
///
/// Each law stands in a file of this folder, once: equation, source, units and valid range beside it. It is templated
/// on the number S that it computes with (core/math/number.hpp) and on the number P of its parameters, which
/// may be one for all lanes. tests/unit/core/material/laws_test.cpp checks each: energy against resultants against
/// slope.

#include <concepts>

#include "core/math/number.hpp"

namespace gambeson {

/// What is asked of a law beside its resultants; each is left out of the code where it is not asked.
enum LawParts : unsigned { only_resultants = 0, with_energy = 1, with_slope = 2, all_parts = 3 };

/// What a law answers to N strains or curvatures, per area of the rest surface. A law adds to the energies, and sets
/// the rest; what was not asked stays as it was. Resultants are the gradient of stored + lost energy. The slope is
/// symmetric, in the order of Voigt for N = 3 (11 22 33 12 13 23).
template <class S, int N>
struct Answer {
  S energy{};                ///< stored [J/m^2]
  S lost{};                  ///< since the history was committed [J/m^2]; never negative
  S resultant[N];            ///< conjugate to the strains [N/m], to the curvatures [N]
  S slope[N * (N + 1) / 2];  ///< of the resultants, the committed history held fixed
};

/// What a law remembers at one point: `history_size` numbers each, the lanes of each side by side, numbers `stride`
/// doubles apart. A law reads what was committed and writes what it would remember if the step were accepted; it never
/// commits.
template <class S>
struct History {
  const double* committed = nullptr;  ///< null: new cloth, which remembers zeros
  double* trial = nullptr;            ///< null: not asked
  long stride = Number<S>::lanes;
  /// Whether the law is that of all lanes. Else it is of those where `follows` is not 0, and the others keep what they
  /// have in `trial`.
  bool of_all = false;
  S follows{};
  /// Time since the commit [s]; infinite in statics, where none passes. Only laws that go with time read it.
  double elapsed_s = 0;

  GAMBESON_LAW S before(int i) const { return committed ? Number<S>::loaded(committed + i * stride) : S{}; }
  GAMBESON_LAW void keep(int i, const S& value) const {
    if (!trial) return;
    double* const at = trial + i * stride;
    Number<S>::stored(at, of_all ? value : pick(follows != 0.0, value, Number<S>::loaded(at)));
  }
};

/// A bending law that a linear section (core/material/section.hpp) does not express: what the elements evaluate at a
/// point beside it. D are the rigidities of the section along weft (D[0]), along warp (D[1]) and of twist (D[2]) [N m],
/// `numbers` what else the law has, k = (k11, k22, 2 k12) the changes of curvature [1/m].
/// `steepest`: the steepest slope of m_i by k_i, i = 0, 1, 2, over all curvatures and histories [N m]: what a stable
/// time step must allow for. Where the slopes along weft and warp go with their rigidities, and twist is linear, a law
/// may also give `steepening(numbers)`, the factor of both: one root for the lanes of a point instead of two.
template <class L>
concept BendingFormula = requires(const double* D, const double* numbers, const double* k, Answer<double, 3>& out) {
  { L::number_count } -> std::convertible_to<int>;  ///< doubles beside the section's
  { L::history_size } -> std::convertible_to<int>;  ///< doubles that it remembers at a point; 0: none
  L::template bend<only_resultants>(D, numbers, k, History<double>{}, out);
  L::template bend<all_parts>(D, numbers, k, History<double>{}, out);
  { L::steepest(0, D, numbers) } -> std::same_as<double>;
};

}  // namespace gambeson
