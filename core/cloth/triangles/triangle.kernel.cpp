/// Internal force of constant-strain triangles and dihedral hinges (TriangleCloth), vectorised over elements. Compiled
/// once per instruction set with GAMBESON_ISA defined.

#include <algorithm>

#include "core/cloth/triangles/membrane_lanes.hpp"
#include "core/cloth/triangles/triangle_lanes.hpp"

namespace gambeson {
namespace {

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

/// The membrane as TriangleCloth has it, or of springs or conditions, and the hinges at the triangle's edges.
template <MembraneElements kElements, bool kEnergy>
void triangleForces(const ElementBlock& block, const BlockLaw& law, int begin, int end, const double* q,
                    const double* moment, double* slots, double* energy) {
  constexpr unsigned kParts = kEnergy ? with_energy : only_resultants;
  for (int group = begin; group < end; ++group) {
    const int* corners = block.corners.data() + 3L * group * kLanes;
    const int* hinge = block.hinge.data() + 3L * group * kLanes;
    const double* rest = block.rest.data() + long{kMembraneDoubles} * group * kLanes;
    const V3 x0 = gather(q, corners), x1 = gather(q, corners + kLanes), x2 = gather(q, corners + 2 * kLanes);
    const V3 e1 = x1 - x0, e2 = x2 - x0;
    const V3 normal = cross(e1, e2);
    const V m[3] = {gatherOne(moment, hinge), gatherOne(moment, hinge + kLanes), gatherOne(moment, hinge + 2 * kLanes)};
    const HingeMoments along(x2 - x1, e1, e2, normal, m);
    double* slot = slots + 9L * group * kLanes;
    if constexpr (kElements == MembraneElements::springs) {
      SpringForces springs(block, group, x2 - x1, e1, e2);
      if (law.use.jams) springs.jam<kParts>(law, rest, e1, e2);
      const V3 f1 = springs.first + along.first * normal, f2 = springs.second + along.second * normal;
      write(slot, V3{} - f1 - f2);
      write(slot + 3 * kLanes, f1);
      write(slot + 6 * kLanes, f2);
      if constexpr (kEnergy) store(energy + static_cast<long>(group) * kLanes, springs.energy);
      continue;
    }
    const V g1x = load(rest), g1y = load(rest + kLanes), g2x = load(rest + 2 * kLanes), g2y = load(rest + 3 * kLanes),
            area = load(rest + 4 * kLanes);
    const V3 weft = g1x * e1 + g2x * e2, warp = g1y * e1 + g2y * e2;
    const V strain[3] = {0.5 * (dot(weft, weft) - 1.0), 0.5 * (dot(warp, warp) - 1.0), dot(weft, warp)};
    Answer<V, 3> answer;
    if constexpr (kElements == MembraneElements::baraff_witkin) {
      baraffWitkin<kParts>(block.membrane.threads, strain, answer);
      if (law.use.jams) addJamming<kParts>(law.point.jam_N_per_m, law.point.jam_s, strain, answer);
    } else if (!law.general) {
      stretchPlain<kParts>(law, strain, answer);
    } else {
      LawLanes numbers;
      constantLaw(law, numbers);
      const History<V> history = law.remembers() ? historyAt(law, group, false) : History<V>{};
      evaluateMembrane<kParts>(law.evaluated(), numbers, strain, history, answer);
    }
    const V* n = answer.resultant;
    const V3 p1 = area * (n[0] * weft + n[2] * warp), p2 = area * (n[2] * weft + n[1] * warp);

    const V3 f1 = g1x * p1 + g1y * p2 + along.first * normal, f2 = g2x * p1 + g2y * p2 + along.second * normal;
    write(slot, V3{} - f1 - f2);
    write(slot + 3 * kLanes, f1);
    write(slot + 6 * kLanes, f2);
    if constexpr (kEnergy) {
      store(energy + static_cast<long>(group) * kLanes, area * answer.energy);
      if (law.lost) store(law.lost + static_cast<long>(group) * kLanes, area * answer.lost);
    }
  }
}

/// Moments by the law.
template <bool kEnergy, int kKind>
void momentsOf(const ElementBlock& block, const BendingLaw<kKind>& bending, int begin, int end, const Folds& folds,
               double* moment, double* energy) {
  constexpr unsigned kParts = kEnergy ? with_energy : only_resultants;
  for (int group = begin; group < end; ++group) {
    const double* rest = block.rest.data() + long{kHingeDoubles} * group * kLanes;
    const V theta = folds.theta[group - begin], per_length = folds.per_length[group - begin];
    const V per_angle = load(rest + kLanes), area = load(rest + 2 * kLanes);
    const V d[3] = {load(rest + 3 * kLanes), load(rest + 4 * kLanes), load(rest + 5 * kLanes)};
    const V kappa = per_angle * (theta - load(rest));
    const V change[3] = {kappa * d[0], kappa * d[1], kappa * d[2]};
    Answer<V, 3> answer;
    bending.template evaluate<kParts>(group, change, answer);
    const V* m = answer.resultant;
    store(moment + static_cast<long>(group) * kLanes,
          per_length * area * per_angle * (m[0] * d[0] + m[1] * d[1] + m[2] * d[2]));
    if constexpr (kEnergy) {
      store(energy + static_cast<long>(group) * kLanes, area * answer.energy);
      if (bending.law.lost) store(bending.law.lost + static_cast<long>(group) * kLanes, area * answer.lost);
    }
  }
}

template <bool kEnergy, int kKind>
void hingeMoments(const ElementBlock& block, const BlockLaw& law, int begin, int end, const double* q, double* moment,
                  double* energy) {
  const BendingLaw<kKind> bending(law);
  Folds folds;
  for (int first = begin; first < end; first += kRun) {
    const int last = std::min(first + kRun, end);
    foldsOf(block.corners.data(), first, last, q, folds);
    anglesOf(last - first, folds);
    momentsOf<kEnergy>(block, bending, first, last, folds, moment, energy);
  }
}

void hinges(const ElementBlock& block, const BlockLaw& law, const double* q, double* moment, double* energy) {
  forKindOf(law, [&](auto kind) {
    forAll(Each::much, (block.groups + kChunk - 1) / kChunk, [&](int chunk) {
      const int begin = chunk * kChunk, end = std::min(begin + kChunk, block.groups);
      energy ? hingeMoments<true, decltype(kind)::value>(block, law, begin, end, q, moment, energy)
             : hingeMoments<false, decltype(kind)::value>(block, law, begin, end, q, moment, energy);
    });
  });
}

template <MembraneElements kElements>
void trianglesOf(const ElementBlock& block, const BlockLaw& law, const double* q, const double* moment, double* slots,
                 double* energy) {
  forAll(Each::much, (block.groups + kChunk - 1) / kChunk, [&](int chunk) {
    const int begin = chunk * kChunk, end = std::min(begin + kChunk, block.groups);
    energy ? triangleForces<kElements, true>(block, law, begin, end, q, moment, slots, energy)
           : triangleForces<kElements, false>(block, law, begin, end, q, moment, slots, energy);
  });
}

/// Without its membrane a triangle is the continuum of a law that has none.
void triangles(const ElementBlock& block, const BlockLaw& law, const double* q, const double* moment, double* slots,
               double* energy) {
  switch (law.membrane ? block.membrane.elements : MembraneElements::continuum) {
    case MembraneElements::continuum:
      return trianglesOf<MembraneElements::continuum>(block, law, q, moment, slots, energy);
    case MembraneElements::springs:
      return trianglesOf<MembraneElements::springs>(block, law, q, moment, slots, energy);
    case MembraneElements::baraff_witkin:
      return trianglesOf<MembraneElements::baraff_witkin>(block, law, q, moment, slots, energy);
  }
}

}  // namespace

extern const BendingKernels GAMBESON_CONCAT(kBending_, GAMBESON_ISA);
extern const TriangleKernels GAMBESON_CONCAT(kTriangles_, GAMBESON_ISA);
const TriangleKernels GAMBESON_CONCAT(kTriangles_, GAMBESON_ISA){GAMBESON_STRING(GAMBESON_ISA), kLanes, hinges,
                                                                 triangles, dampTriangles,
                                                                 &GAMBESON_CONCAT(kBending_, GAMBESON_ISA)};

}  // namespace gambeson
