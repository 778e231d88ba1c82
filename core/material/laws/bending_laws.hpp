#pragma once
/// The list of bending laws: what a fabric may choose from, and what elements evaluate. A new law is entered here.

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/material/laws/consistent_bending.hpp"
#include "core/material/laws/cyclic_bending.hpp"
#include "core/material/laws/hysteresis_bending.hpp"
#include "core/material/laws/laminate.hpp"
#include "core/material/laws/linear_bending.hpp"
#include "core/material/laws/recovering_bending.hpp"
#include "core/material/laws/stop_bending.hpp"
#include "core/material/laws/zheng_bending.hpp"

namespace gambeson {

/// Whether it compares its own numbers: a base's comparison would find laws of different numbers alike.
template <class L>
concept ComparesItself = requires {
  static_cast<bool (L::*)(const L&) const>(&L::operator==);
};

template <BendingFormula... Laws>
struct LawList {
  static_assert((ComparesItself<Laws> && ...), "a law needs an operator== of its own");
  static constexpr int count = sizeof...(Laws);
  static constexpr int most_numbers = std::max({0, Laws::number_count...});
  static constexpr int most_history = std::max({0, Laws::history_size...});
  /// Bit k: kind k remembers.
  static constexpr unsigned remembering = [] {
    unsigned mask = 0;
    int at = 0;
    ((++at, mask |= Laws::history_size > 0 ? 1u << at : 0u), ...);
    return mask;
  }();
  /// The most that any of these kinds remembers.
  static constexpr int historyOf(unsigned kinds) {
    int most = 0, at = 0;
    ((++at, most = kinds >> at & 1 ? std::max(most, Laws::history_size) : most), ...);
    return most;
  }
  /// The slot of a fabric. Linear laws, which a section expresses, beside those of the list.
  using Slot = std::variant<LinearBending, Laws..., ConsistentBending, Laminate>;

  /// The place of a law in the list, counted from 1; 0: linear.
  template <class L>
  static constexpr int kind = [] {
    int at = 0, found = 0;
    ((++at, found = std::is_same_v<L, Laws> ? at : found), ...);
    return found;
  }();
  /// f(law, kind) for each law of the list: the law for its type, the kind a constant.
  template <class F>
  static void forEach(const F& f) {
    (f(std::type_identity<Laws>{}, std::integral_constant<int, kind<Laws>>{}), ...);
  }
};

using BendingLaws =
    LawList<ZhengBending, StopBending, HysteresisBending, IsotropicHysteresisBending, CyclicHysteresisBending,
            Recovering<HysteresisBending>, Recovering<IsotropicHysteresisBending>>;
/// The law of a fabric.
using BendingLaw = BendingLaws::Slot;

/// The steepest slope along weft of a law with given rigidities, were they all this one [N m].
template <class L>
double steepestSlope(const L& law, double rigidity_Nm) {
  const double D[3] = {rigidity_Nm, rigidity_Nm, rigidity_Nm};
  if constexpr (BendingLaws::kind < L >> 0)
    return L::steepest(0, D, law.numbers().data());
  else
    return rigidity_Nm;
}

/// The rigidities of a law that has its own; null for a solid.
inline const GivenRigidities* givenRigidities(const BendingLaw& slot) {
  return std::visit(
      []<class L>(const L& law) -> const GivenRigidities* {
        if constexpr (L::is_solid)
          return nullptr;
        else
          return &law;
      },
      slot);
}
inline GivenRigidities* givenRigidities(BendingLaw& slot) {
  return const_cast<GivenRigidities*>(givenRigidities(std::as_const(slot)));
}

constexpr int kLawNumbers = BendingLaws::most_numbers;   ///< of a point, beside its section
constexpr int kMostHistory = BendingLaws::most_history;  ///< doubles that a point may remember of bending

}  // namespace gambeson
