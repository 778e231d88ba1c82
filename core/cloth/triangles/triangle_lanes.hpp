#pragma once
/// What the kernels of triangles share, in lanes. Included only by kernels.

#include <utility>

#include "core/cloth/law_lanes.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr int kChunk = 64;  ///< groups that a thread takes at a time
/// Groups of edges that take each step together. From corners to moment is one long chain of operations that wait for
/// each other; step by step a core has several groups under way.
constexpr int kRun = 16;
constexpr int kGeneral = -1;

inline void write(double* slot, V3 f) {
  store(slot, f.x);
  store(slot + kLanes, f.y);
  store(slot + 2 * kLanes, f.z);
}

/// Values, one of each lane's element.
inline V gatherOne(const double* values, const int* at) {
  return [&]<int... kLane>(std::integer_sequence<int, kLane...>) { return V{values[at[kLane]]...}; }
  (std::make_integer_sequence<int, kLanes>{});
}

/// The folds between triangles of a run, in each lane of its groups.
struct Folds {
  V sine[kRun], cosine[kRun];  ///< of the angle, in this proportion
  V theta[kRun];               ///< the angle [rad]
  V per_length[kRun];          ///< 1/|e| of the common edge [1/m]
};

/// Sine and cosine as foldAngle has them: the sine goes with e . (nb x na) = |e|^2 na . b. `corners`: [group][4][lane].
inline void foldsOf(const int* all_corners, int begin, int end, const double* q, Folds& folds) {
  for (int group = begin; group < end; ++group) {
    const int* corners = all_corners + 4L * group * kLanes;
    const V3 x0 = gather(q, corners);
    const V3 e = gather(q, corners + kLanes) - x0, a = gather(q, corners + 2 * kLanes) - x0,
             b = gather(q, corners + 3 * kLanes) - x0;
    const V3 na = cross(e, a), nb = cross(b, e);
    const V length2 = dot(e, e), per_length = 1.0 / squareRoot(length2);
    const int at = group - begin;
    folds.sine[at] = length2 * per_length * dot(na, b);
    folds.cosine[at] = dot(na, nb);
    folds.per_length[at] = per_length;
  }
}

inline void anglesOf(int groups, Folds& folds) {
  for (int at = 0; at < groups; ++at) folds.theta[at] = angleOf(folds.sine[at], folds.cosine[at]);
}

/// Moments of a change of curvature by the laws of a block. kKind: of the plain law, 0 linear; or kGeneral. Known at
/// compile time, what follows from its numbers is computed once.
template <int kKind>
struct BendingLaw {
  const BlockLaw& law;
  const PlainLaw plain;  ///< a copy that no store can change: what follows from it is computed once
  LawLanes numbers;

  explicit BendingLaw(const BlockLaw& block) : law(block), plain(block.plain) {
    if constexpr (kKind == kGeneral) constantLaw(law, numbers);
  }
  template <unsigned kParts>
  void evaluate(long point, const V* change, Answer<V, 3>& answer) const {
    if constexpr (kKind == kGeneral) {
      const History<V> history = law.remembers() ? historyAt(law, point, false) : History<V>{};
      evaluateBending<kParts>(law.evaluated(), numbers, change, history, answer);
    } else if constexpr (kKind == 0) {
      linearMoment<kParts>(DiagonalStiffness<double>{plain.rigidity[0], plain.rigidity[1], plain.rigidity[2]}, change,
                           answer);
    } else {
      BendingLaws::forEach([&]<class L, int kOf>(std::type_identity<L>, std::integral_constant<int, kOf>) {
        if constexpr (kOf == kKind) {
          History<V> history{};
          if constexpr (L::history_size > 0)
            if (law.remembers()) history = historyAt(law, point, false);
          L::template bend<kParts>(plain.rigidity.data(), plain.numbers.data(), change, history, answer);
        }
      });
    }
  }
};

/// f(std::integral_constant<int, kKind>) with the kind of the block's bending law, as BendingLaw has it: laws of the
/// list from their own numbers, also those that remember.
template <class F>
void forBendingOf(const BlockLaw& law, const F& f) {
  if (law.plain.kind == 0)
    return law.general ? f(std::integral_constant<int, kGeneral>{}) : f(std::integral_constant<int, 0>{});
  BendingLaws::forEach([&]<class L, int kKind>(std::type_identity<L>, std::integral_constant<int, kKind> kind) {
    if (law.plain.kind == kKind) f(kind);
  });
}

/// The same where what is not plain in any respect counts as general.
template <class F>
void forKindOf(const BlockLaw& law, const F& f) {
  if (law.general) return f(std::integral_constant<int, kGeneral>{});
  if (law.plain.kind == 0) return f(std::integral_constant<int, 0>{});
  BendingLaws::forEach([&]<class L, int kKind>(std::type_identity<L>, std::integral_constant<int, kKind> kind) {
    if constexpr (L::history_size == 0)
      if (law.plain.kind == kKind) f(kind);
  });
}

}  // namespace
}  // namespace gambeson
