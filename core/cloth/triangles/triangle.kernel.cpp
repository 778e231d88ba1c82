/// Internal force of constant-strain triangles and dihedral hinges (TriangleCloth), vectorised over elements. Compiled
/// once per instruction set with GAMBESON_ISA defined.

#include <algorithm>
#include <utility>

#include "core/cloth/law_lanes.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr int kChunk = 64;  ///< groups that a thread takes at a time
/// Groups of hinges that take each step together. From corners to moment is one long chain of operations that wait for
/// each other; step by step a core has several groups under way.
constexpr int kRun = 16;
constexpr int kGeneral = -1;

void write(double* slot, V3 f) {
  store(slot, f.x);
  store(slot + kLanes, f.y);
  store(slot + 2 * kLanes, f.z);
}

/// Values, one of each lane's element.
V gatherOne(const double* values, const int* at) {
  return [&]<int... kLane>(std::integer_sequence<int, kLane...>) { return V{values[at[kLane]]...}; }
  (std::make_integer_sequence<int, kLanes>{});
}

/// Forces of a triangle's hinges on its corners 1 and 2 over its normal N = e1 x e2 [N/m^2]. A moment M acts by the
/// gradient of its angle (foldAngle): |e| N/|N|^2 at the corner that faces the edge e, and what balances it at the ends
/// of e, shared as the foot of that corner divides e. `m`: M/|e| [N] of the edges that face the corners 0, 1 and 2, so
/// that no root is needed. e1, e2 and e0 run from corner 0 to 1, from 0 to 2 and from 1 to 2. Feet come from the edges
/// themselves: differences of squares cancel where one is much shorter than the others.
struct HingeMoments {
  V first, second;

  HingeMoments(V3 e0, V3 e1, V3 e2, V3 normal, const V* m) {
    const V inverse2 = 1.0 / dot(normal, normal);
    const V w0 = m[0] * inverse2, w1 = m[1] * inverse2, w2 = m[2] * inverse2;
    const V d11 = dot(e1, e1), d22 = dot(e2, e2), d12 = dot(e1, e2), d01 = dot(e0, e1), d02 = dot(e0, e2);
    // The foot of corner 0 divides e0 as d02 : -d01, that of 1 divides e2 as d12 : d02, that of 2 e1 as d12 : -d01.
    first = w1 * d22 - w0 * d02 - w2 * d12;
    second = w2 * d11 + w0 * d01 - w1 * d12;
  }
};

/// The membrane as TriangleCloth has it, and the hinges at the triangle's edges.
template <bool kEnergy>
void triangleForces(const ElementBlock& block, const BlockLaw& law, int begin, int end, const double* q,
                    const double* moment, double* slots, double* energy) {
  constexpr unsigned kParts = kEnergy ? with_energy : only_resultants;
  for (int group = begin; group < end; ++group) {
    const int* corners = block.corners.data() + 3L * group * kLanes;
    const int* hinge = block.hinge.data() + 3L * group * kLanes;
    const double* rest = block.rest.data() + long{kMembraneDoubles} * group * kLanes;
    const V3 x0 = gather(q, corners), x1 = gather(q, corners + kLanes), x2 = gather(q, corners + 2 * kLanes);
    const V3 e1 = x1 - x0, e2 = x2 - x0;
    const V g1x = load(rest), g1y = load(rest + kLanes), g2x = load(rest + 2 * kLanes), g2y = load(rest + 3 * kLanes),
            area = load(rest + 4 * kLanes);
    const V3 weft = g1x * e1 + g2x * e2, warp = g1y * e1 + g2y * e2;
    const V strain[3] = {0.5 * (dot(weft, weft) - 1.0), 0.5 * (dot(warp, warp) - 1.0), dot(weft, warp)};
    Answer<V, 3> answer;
    if (!law.general) {
      stretchPlain<kParts>(law, strain, answer);
    } else {
      LawLanes numbers;
      constantLaw(law, numbers);
      const History<V> history = law.remembers() ? historyAt(law, group, false) : History<V>{};
      evaluateMembrane<kParts>(law.evaluated(), numbers, strain, history, answer);
    }
    const V* n = answer.resultant;
    const V3 p1 = area * (n[0] * weft + n[2] * warp), p2 = area * (n[2] * weft + n[1] * warp);

    const V3 normal = cross(e1, e2);
    const V m[3] = {gatherOne(moment, hinge), gatherOne(moment, hinge + kLanes), gatherOne(moment, hinge + 2 * kLanes)};
    const HingeMoments along(x2 - x1, e1, e2, normal, m);
    const V3 f1 = g1x * p1 + g1y * p2 + along.first * normal, f2 = g2x * p1 + g2y * p2 + along.second * normal;
    double* slot = slots + 9L * group * kLanes;
    write(slot, V3{} - f1 - f2);
    write(slot + 3 * kLanes, f1);
    write(slot + 6 * kLanes, f2);
    if constexpr (kEnergy) {
      store(energy + static_cast<long>(group) * kLanes, area * answer.energy);
      if (law.lost) store(law.lost + static_cast<long>(group) * kLanes, area * answer.lost);
    }
  }
}

/// The hinges of a run, in each lane of its groups.
struct Folds {
  V sine[kRun], cosine[kRun];  ///< of the angle, in this proportion
  V theta[kRun];               ///< the angle [rad]
  V per_length[kRun];          ///< 1/|e| of the common edge [1/m]
};

/// Sine and cosine as foldAngle has them: the sine goes with e . (nb x na) = |e|^2 na . b.
void foldsOf(const ElementBlock& block, int begin, int end, const double* q, Folds& folds) {
  for (int group = begin; group < end; ++group) {
    const int* corners = block.corners.data() + 4L * group * kLanes;
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

void anglesOf(int groups, Folds& folds) {
  for (int at = 0; at < groups; ++at) folds.theta[at] = angleOf(folds.sine[at], folds.cosine[at]);
}

/// Moments by the law. kKind: of the plain law, 0 linear; or kGeneral. Known at compile time, what follows from its
/// numbers is computed once.
template <bool kEnergy, int kKind>
void momentsOf(const ElementBlock& block, const BlockLaw& law, int begin, int end, const Folds& folds, double* moment,
               double* energy) {
  constexpr unsigned kParts = kEnergy ? with_energy : only_resultants;
  const PlainLaw plain = law.plain;  // a copy that no store can change: what follows from it is computed once
  for (int group = begin; group < end; ++group) {
    const double* rest = block.rest.data() + long{kHingeDoubles} * group * kLanes;
    const V theta = folds.theta[group - begin], per_length = folds.per_length[group - begin];
    const V per_angle = load(rest + kLanes), area = load(rest + 2 * kLanes);
    const V d[3] = {load(rest + 3 * kLanes), load(rest + 4 * kLanes), load(rest + 5 * kLanes)};
    const V kappa = per_angle * (theta - load(rest));
    const V change[3] = {kappa * d[0], kappa * d[1], kappa * d[2]};
    Answer<V, 3> answer;
    if constexpr (kKind == kGeneral) {
      LawLanes numbers;
      constantLaw(law, numbers);
      const History<V> history = law.remembers() ? historyAt(law, group, false) : History<V>{};
      evaluateBending<kParts>(law.evaluated(), numbers, change, history, answer);
    } else if constexpr (kKind == 0) {
      linearMoment<kParts>(DiagonalStiffness<double>{plain.rigidity[0], plain.rigidity[1], plain.rigidity[2]}, change,
                           answer);
    } else {
      BendingLaws::forEach([&]<class L, int kOf>(std::type_identity<L>, std::integral_constant<int, kOf>) {
        if constexpr (kOf == kKind)
          L::template bend<kParts>(plain.rigidity.data(), plain.numbers.data(), change, History<V>{}, answer);
      });
    }
    const V* m = answer.resultant;
    store(moment + static_cast<long>(group) * kLanes,
          per_length * area * per_angle * (m[0] * d[0] + m[1] * d[1] + m[2] * d[2]));
    if constexpr (kEnergy) {
      store(energy + static_cast<long>(group) * kLanes, area * answer.energy);
      if (law.lost) store(law.lost + static_cast<long>(group) * kLanes, area * answer.lost);
    }
  }
}

template <bool kEnergy, int kKind>
void hingeMoments(const ElementBlock& block, const BlockLaw& law, int begin, int end, const double* q, double* moment,
                  double* energy) {
  Folds folds;
  for (int first = begin; first < end; first += kRun) {
    const int last = std::min(first + kRun, end);
    foldsOf(block, first, last, q, folds);
    anglesOf(last - first, folds);
    momentsOf<kEnergy, kKind>(block, law, first, last, folds, moment, energy);
  }
}

template <int kKind>
void hingesOfKind(const ElementBlock& block, const BlockLaw& law, const double* q, double* moment, double* energy) {
  forAll(Each::much, (block.groups + kChunk - 1) / kChunk, [&](int chunk) {
    const int begin = chunk * kChunk, end = std::min(begin + kChunk, block.groups);
    energy ? hingeMoments<true, kKind>(block, law, begin, end, q, moment, energy)
           : hingeMoments<false, kKind>(block, law, begin, end, q, moment, energy);
  });
}

void hinges(const ElementBlock& block, const BlockLaw& law, const double* q, double* moment, double* energy) {
  if (law.general) return hingesOfKind<kGeneral>(block, law, q, moment, energy);
  if (law.plain.kind == 0) return hingesOfKind<0>(block, law, q, moment, energy);
  BendingLaws::forEach([&]<class L, int kKind>(std::type_identity<L>, std::integral_constant<int, kKind>) {
    if constexpr (L::history_size == 0)
      if (law.plain.kind == kKind) hingesOfKind<kKind>(block, law, q, moment, energy);
  });
}

void triangles(const ElementBlock& block, const BlockLaw& law, const double* q, const double* moment, double* slots,
               double* energy) {
  forAll(Each::much, (block.groups + kChunk - 1) / kChunk, [&](int chunk) {
    const int begin = chunk * kChunk, end = std::min(begin + kChunk, block.groups);
    energy ? triangleForces<true>(block, law, begin, end, q, moment, slots, energy)
           : triangleForces<false>(block, law, begin, end, q, moment, slots, energy);
  });
}

}  // namespace

extern const TriangleKernels GAMBESON_CONCAT(kTriangles_, GAMBESON_ISA);
const TriangleKernels GAMBESON_CONCAT(kTriangles_, GAMBESON_ISA){GAMBESON_STRING(GAMBESON_ISA), kLanes, hinges,
                                                                 triangles};

}  // namespace gambeson
