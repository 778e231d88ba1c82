#pragma once
/// The laws of one point of a sheet, put together: membrane, tension field, jamming, section and bending law.

#include "core/material/laws/bending_laws.hpp"
#include "core/material/laws/jamming.hpp"
#include "core/material/laws/membrane.hpp"
#include "core/material/laws/shear_friction.hpp"
#include "core/material/laws/tension_field.hpp"
#include "core/material/section.hpp"

namespace gambeson {

/// The numbers of all laws at a point: n = A e + B k, m = B e + D k (core/material/section.hpp); the moment by law
/// `kind` of BendingLaws instead of D k where that is not 0, its rigidities in D11, D22, D33; the membrane relaxed to
/// its tension field where `tension` is not 0; jamming with `jam_N_per_m` below the square `jam_s` of an area ratio;
/// friction in shear by `shear` (rise, span, growth of ShearFriction; all 0: none). A tension field, jamming and a law of
/// the list stand only where they make sense together: neither jamming nor friction with a tension field, no B and no
/// other D with a law of the list or (B) with a tension field.
struct PointLaw {
  Section section;
  double kind = 0;
  std::array<double, kLawNumbers> numbers{};
  double tension = 0;
  double jam_N_per_m = 0, jam_s = 0;
  std::array<double, 3> shear{};
};
constexpr int kLawDoubles = 25 + kLawNumbers;  ///< a PointLaw as an array
static_assert(sizeof(PointLaw) == kLawDoubles * sizeof(double));

/// A PointLaw of S, in the same order.
template <class S>
struct PointNumbers {
  S A[6], B[6], D[6], kind, numbers[kLawNumbers], tension, jam, jam_s, shear[3];
};
static_assert(sizeof(PointNumbers<double>) == sizeof(PointLaw));

/// Which laws any point of many follows: the rest is not evaluated.
struct LawUse {
  unsigned kinds = 0;  ///< bit k: kind k of BendingLaws
  bool tension = false, jams = false;
  bool shears = false;  ///< with friction

  GAMBESON_HD bool has(int kind) const { return kinds >> kind & 1; }
  GAMBESON_HD bool remembers() const { return (kinds & BendingLaws::remembering) || shears; }
  /// Doubles that a point has room for: as many as the bending law of these that remembers most, and behind them those
  /// of the friction in shear.
  GAMBESON_HD int historySize() const { return shearHistory() + (shears ? kShearHistory : 0); }
  GAMBESON_HD int shearHistory() const { return BendingLaws::historyOf(kinds); }  ///< where that begins
};

/// What all laws of a point answer: n [N/m] and m [N] with their own slopes. That of n by k, and of m by e, is B.
template <class S>
struct PointAnswer {
  Answer<S, 3> membrane, bending;
  S energy{};  ///< of both [J/m^2]
};

/// `bending` by law L where the point follows it.
template <unsigned kParts, class L, class S>
GAMBESON_LAW void replaceByLaw(const LawUse& use, const PointNumbers<S>& l, const S* k, History<S> history,
                               Answer<S, 3>& bending) {
  constexpr int kKind = BendingLaws::kind<L>;
  if (!use.has(kKind)) return;
  const auto on = l.kind == static_cast<double>(kKind);
  Answer<S, 3> own;
  if constexpr (L::history_size > 0) history.follows = pick(on, spread<S>(1.0), S{});
  L::template bend<kParts>(l.D, l.numbers, k, history, own);
  bending.resultant[0] = pick(on, own.resultant[0], bending.resultant[0]);
  bending.resultant[1] = pick(on, own.resultant[1], bending.resultant[1]);
  bending.resultant[2] = pick(on, own.resultant[2], bending.resultant[2]);
  if constexpr (kParts & with_energy) {
    bending.energy = pick(on, own.energy, bending.energy);
    bending.lost = pick(on, own.lost, bending.lost);
  }
  if constexpr (kParts & with_slope)
    for (int i = 0; i < 6; ++i) bending.slope[i] = pick(on, own.slope[i], bending.slope[i]);
}
template <unsigned kParts, class... Laws, class S>
GAMBESON_LAW void replaceByLaws(LawList<Laws...>, const LawUse& use, const PointNumbers<S>& l, const S* k,
                                History<S> history, Answer<S, 3>& bending) {
  (replaceByLaw<kParts, Laws>(use, l, k, history, bending), ...);
}

/// n of the strain e = (E11, E22, 2 E12) alone, its energy and slope. `history`: of the point.
template <unsigned kParts, class S>
GAMBESON_LAW void evaluateMembrane(const LawUse& use, const PointNumbers<S>& l, const S* e, History<S> history,
                                   Answer<S, 3>& membrane) {
  stVenantKirchhoff<kParts>(l.A, e, membrane);
  if (use.tension) {
    if constexpr (Number<S>::lanes == 1) {
      if (l.tension != 0.0) {
        const TensionFieldOf<S> field = tensionField(l.A, e);
        for (int i = 0; i < 3; ++i) membrane.resultant[i] = field.n[i];
        membrane.energy = field.energy;
        for (int i = 0; i < 6; ++i) membrane.slope[i] = field.slope[i];
      }
    } else {
      tensionFieldLanes(Number<S>::lanes, reinterpret_cast<const double*>(l.A), reinterpret_cast<const double*>(e),
                        reinterpret_cast<const double*>(&l.tension), reinterpret_cast<double*>(membrane.resultant),
                        reinterpret_cast<double*>(&membrane.energy),
                        kParts & with_slope ? reinterpret_cast<double*>(membrane.slope) : nullptr);
    }
  }
  if (use.jams) addJamming<kParts>(l.jam, l.jam_s, e, membrane);
  if (use.shears) {
    history.follows = spread<S>(1.0);  // points without friction have stops of no strength
    addShearFriction<kParts>(l.shear, e[2], history, use.shearHistory(), membrane);
  }
}

/// m of the change of curvature k = (k11, k22, 2 k12) alone. `history`: of the bending law.
template <unsigned kParts, class S>
GAMBESON_LAW void evaluateBending(const LawUse& use, const PointNumbers<S>& l, const S* k, History<S> history,
                                  Answer<S, 3>& bending) {
  linearMoment<kParts>(l.D, k, bending);
  replaceByLaws<kParts>(BendingLaws{}, use, l, k, history, bending);
}

/// Both, with what couples them.
template <unsigned kParts, class S>
GAMBESON_LAW void evaluateLaws(const LawUse& use, const PointNumbers<S>& l, const S* e, const S* k, History<S> history,
                               PointAnswer<S>& out) {
  Answer<S, 3>&membrane = out.membrane, &bending = out.bending;
  evaluateMembrane<kParts>(use, l, e, history, membrane);
  S coupled[3]{};
  addProduct(l.B, e, coupled);
  if constexpr (kParts & with_energy) membrane.energy += coupled[0] * k[0] + coupled[1] * k[1] + coupled[2] * k[2];
  addProduct(l.B, k, membrane.resultant);
  evaluateBending<kParts>(use, l, k, history, bending);
  if constexpr (kParts & with_energy) out.energy = membrane.energy + bending.energy;
  bending.resultant[0] += coupled[0];
  bending.resultant[1] += coupled[1];
  bending.resultant[2] += coupled[2];
}

/// The rigidities of law L become its steepest slopes where the point follows it.
template <class L, class S>
GAMBESON_LAW void takeSteepestOf(const LawUse& use, PointNumbers<S>& l) {
  constexpr int kKind = BendingLaws::kind<L>;
  if (!use.has(kKind)) return;
  const auto on = l.kind == static_cast<double>(kKind);
  if constexpr (requires { L::steepening(l.numbers); }) {
    const S factor = pick(on, L::steepening(l.numbers), spread<S>(1.0));
    l.D[0] *= factor;
    l.D[1] *= factor;
  } else {
    const S D[3] = {l.D[0], l.D[1], l.D[2]};
    for (int i = 0; i < 3; ++i) l.D[i] = pick(on, L::steepest(i, D, l.numbers), D[i]);
  }
}

/// Leaves out what a stable time step must not count on: a law of the list becomes linear with its steepest slope, a
/// tension field the membrane that it relaxes.
template <class S, class... Laws>
GAMBESON_LAW void takeSteepest(LawList<Laws...>, const LawUse& use, PointNumbers<S>& l) {
  (takeSteepestOf<Laws>(use, l), ...);
  if (use.shears) l.A[2] += steepestShearFriction(l.shear);
  l.kind = l.tension = S{};
}

}  // namespace gambeson
