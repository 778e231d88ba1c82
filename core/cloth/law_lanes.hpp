#pragma once
/// The laws of a block of elements, in lanes. Included only by kernels.

#include "core/cloth/block_law.hpp"
#include "core/math/lanes.hpp"

namespace gambeson {
namespace {

/// PointLaw, in lanes.
using LawLanes = PointNumbers<V>;
static_assert(sizeof(LawLanes) == kLawDoubles * sizeof(V));

inline void constantLaw(const BlockLaw& law, LawLanes& l) {
  const double* values = reinterpret_cast<const double*>(&law.point);
  V* out = reinterpret_cast<V*>(&l);
  for (int i = 0; i < kLawDoubles; ++i) out[i] = splat(values[i]);
  leaveOut(law, l);
}

/// `l` is of another point of the block, or constant. Few numbers vary, and all of them are much to read.
inline void lawAtPoint(const BlockLaw& law, const LawsByPoint& laws, long point, LawLanes& l) {
  V* out = reinterpret_cast<V*>(&l);
  const double* data = laws.numbers + point * kLawDoubles * kLanes;
  if (law.steepest) {  // has changed numbers of what was there
    for (int i = 0; i < kLawDoubles; ++i) out[i] = load(data + i * kLanes);
  } else {
    for (const int i : laws.varying) out[i] = load(data + i * kLanes);
  }
  leaveOut(law, l);
}

/// What the laws remember at a point of each lane; `point` counts the block's law points. Where the block's laws differ
/// from point to point, what a law does not write is what was committed.
inline History<V> historyAt(const BlockLaw& law, long point, bool differ) {
  const int size = law.use.historySize();
  const long first = law.history_first + point * size * kLanes;
  History<V> history{law.committed ? law.committed + first : nullptr, law.trial ? law.trial + first : nullptr};
  history.of_all = !differ;
  history.elapsed_s = law.elapsed_s;
  if (differ && law.trial)
    for (int i = 0; i < size; ++i) Number<V>::stored(history.trial + i * kLanes, history.before(i));
  return history;
}

/// The moment by the law of the list whose kind it is, if that remembers nothing.
template <unsigned kParts, class L>
GAMBESON_LAW void bendIfOf(const PlainLaw& plain, const V* k, Answer<V, 3>& bending) {
  if constexpr (L::history_size == 0)
    if (plain.kind == BendingLaws::kind<L>)
      L::template bend<kParts>(plain.rigidity.data(), plain.numbers.data(), k, History<V>{}, bending);
}
template <unsigned kParts, class... Laws>
GAMBESON_LAW void bendByKind(LawList<Laws...>, const PlainLaw& plain, const V* k, Answer<V, 3>& bending) {
  (bendIfOf<kParts, Laws>(plain, k, bending), ...);
}

/// The moment by the plain law; adds to its energy.
template <unsigned kParts>
GAMBESON_LAW void bendPlain(const PlainLaw& plain, const V* k, Answer<V, 3>& bending) {
  const double* D = plain.rigidity.data();
  if (plain.kind == 0)
    linearMoment<kParts>(DiagonalStiffness<double>{D[0], D[1], D[2]}, k, bending);
  else
    bendByKind<kParts>(BendingLaws{}, plain, k, bending);
}

/// The membrane of the plain law, with jamming.
template <unsigned kParts>
GAMBESON_LAW void stretchPlain(const BlockLaw& law, const V* e, Answer<V, 3>& membrane) {
  stVenantKirchhoff<kParts>(law.plain.membrane, e, membrane);
  if (law.use.jams && law.membrane) addJamming<kParts>(law.point.jam_N_per_m, law.point.jam_s, e, membrane);
}

/// The numbers of BlockLaw::plain.
struct FabricLaw {
  const BlockLaw& law;
  template <unsigned kParts>
  void evaluate(const LawsByPoint&, long, const V* e, const V* k, PointAnswer<V>& out) const {
    const PlainLaw& plain = law.plain;
    stretchPlain<kParts>(law, e, out.membrane);
    out.bending.energy = out.membrane.energy;
    bendPlain<kParts>(plain, k, out.bending);
    out.energy = out.bending.energy;
  }
};

/// The numbers of BlockLaw::point, or of the block's points.
struct GeneralLaw {
  const BlockLaw& law;
  LawLanes lanes{};

  /// `point` counts the block's points. The numbers begin as constantLaw.
  template <unsigned kParts>
  void evaluate(const LawsByPoint& laws, long point, const V* e, const V* k, PointAnswer<V>& out) {
    if (laws.numbers) lawAtPoint(law, laws, point, lanes);
    const History<V> history = law.remembers() ? historyAt(law, point, laws.numbers != nullptr) : History<V>{};
    evaluateLaws<kParts>(law.evaluated(), lanes, e, k, history, out);
  }
};

/// Energy of the lanes of a group: what the laws hold and what they have lost.
struct GroupEnergy {
  V stored{}, lost{};
  void add(V area, const PointAnswer<V>& answer) {
    stored += area * answer.energy;
    lost += area * (answer.bending.lost + answer.membrane.lost);
  }
  void write(const BlockLaw& law, long group, double* energy) const {
    store(energy + group * kLanes, stored);
    if (law.lost) store(law.lost + group * kLanes, lost);
  }
};

}  // namespace
}  // namespace gambeson
