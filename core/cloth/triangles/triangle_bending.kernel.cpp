/// Bending of triangles by the curvature tensor of each (BendingTriangles), vectorised over edges and triangles.
/// Compiled once per instruction set with GAMBESON_ISA defined.

#include <algorithm>

#include "core/cloth/triangles/triangle_lanes.hpp"
#include "core/material/laws/spring.hpp"

namespace gambeson {
namespace {

/// A group's numbers of a list that holds `count`; behind its end zeros.
V loadSome(const double* values, int group, int count) {
  const int first = group * kLanes;
  if (first + kLanes <= count) return Number<V>::loaded(values + first);
  V v{};
  for (int l = 0; first + l < count; ++l) v[l] = values[first + l];
  return v;
}
void storeSome(double* values, int group, int count, V v) {
  const int first = group * kLanes;
  if (first + kLanes <= count) return Number<V>::stored(values + first, v);
  for (int l = 0; first + l < count; ++l) values[first + l] = v[l];
}

template <bool kRotates>
void foldAngles(const EdgeBlock& block, int begin, int end, const double* q, const double* turn, double* angle,
                double* per_length) {
  Folds folds;
  for (int first = begin; first < end; first += kRun) {
    const int last = std::min(first + kRun, end);
    foldsOf(block.corners.data(), first, last, q, folds);
    anglesOf(last - first, folds);
    for (int group = first; group < last; ++group) {
      const V half = 0.5 * folds.theta[group - first];
      store(per_length + long{group} * kLanes, folds.per_length[group - first]);
      if constexpr (kRotates) {
        const V phi = turn ? loadSome(turn, group, block.count) : V{};
        store(angle + 2L * group * kLanes, half + phi);
        store(angle + (2L * group + 1) * kLanes, half - phi);
      } else {
        store(angle + long{group} * kLanes, half);
      }
    }
  }
}

template <class F>
void forChunks(int groups, const F& f) {
  forAll(Each::much, (groups + kChunk - 1) / kChunk,
         [&](int chunk) { f(chunk * kChunk, std::min((chunk + 1) * kChunk, groups)); });
}

void angles(const EdgeBlock& block, const double* q, const double* turn, double* angle, double* per_length) {
  forChunks(block.groups, [&](int begin, int end) {
    if (block.kind == EdgeBlock::Kind::border)
      for (int group = begin; group < end; ++group)
        store(angle + long{group} * kLanes, turn ? loadSome(turn, group, block.count) : V{});
    else if (block.kind == EdgeBlock::Kind::turning)
      foldAngles<true>(block, begin, end, q, turn, angle, per_length);
    else
      foldAngles<false>(block, begin, end, q, nullptr, angle, per_length);
  });
}

template <bool kEnergy, int kKind>
void bendSome(const BendingBlock& block, const BlockLaw& law, int begin, int end, const double* angle, double* couple,
              double* energy) {
  constexpr unsigned kParts = kEnergy ? with_energy : only_resultants;
  const BendingLaw<kKind> bending(law);
  for (int group = begin; group < end; ++group) {
    const int* at = block.angle.data() + 3L * group * kLanes;
    const double* rest = block.rest.data() + long{kBendingDoubles} * group * kLanes;
    V change[3] = {-load(rest), -load(rest + kLanes), -load(rest + 2 * kLanes)};
    const V area = load(rest + 3 * kLanes);
    const double* per_angle = rest + 4L * kLanes;
    for (int i = 0; i < 3; ++i) {
      const V alpha = gatherOne(angle, at + long{i} * kLanes);
      for (int k = 0; k < 3; ++k) change[k] += alpha * load(per_angle + (3L * i + k) * kLanes);
    }
    Answer<V, 3> answer;
    bending.template evaluate<kParts>(group, change, answer);
    const V m[3] = {area * answer.resultant[0], area * answer.resultant[1], area * answer.resultant[2]};
    for (int i = 0; i < 3; ++i) {
      const double* d = per_angle + 3L * i * kLanes;
      store(couple + (3L * group + i) * kLanes,
            m[0] * load(d) + m[1] * load(d + kLanes) + m[2] * load(d + 2 * kLanes));
    }
    if constexpr (kEnergy) {
      store(energy + long{group} * kLanes, area * answer.energy);
      if (law.lost) store(law.lost + long{group} * kLanes, area * answer.lost);
    }
  }
}

void bend(const BendingBlock& block, const BlockLaw& law, const double* angle, double* couple, double* energy) {
  forBendingOf(law, [&](auto kind) {
    forChunks(block.groups, [&](int begin, int end) {
      energy ? bendSome<true, decltype(kind)::value>(block, law, begin, end, angle, couple, energy)
             : bendSome<false, decltype(kind)::value>(block, law, begin, end, angle, couple, energy);
    });
  });
}

void moments(const EdgeBlock& block, const double* couple, double* moment, double* turn_force) {
  forChunks(block.groups, [&](int begin, int end) {
    for (int group = begin; group < end; ++group) {
      const int* at = block.couple.data() + long{block.sides()} * group * kLanes;
      const V first = gatherOne(couple, at);
      if (block.kind == EdgeBlock::Kind::border) {
        if (turn_force) storeSome(turn_force, group, block.count, -first);
        continue;
      }
      const V second = gatherOne(couple, at + kLanes);
      double* own = moment + long{group} * kLanes;
      store(own, 0.5 * (first + second) * load(own));
      if (block.kind == EdgeBlock::Kind::turning && turn_force)
        storeSome(turn_force, group, block.count, second - first);
    }
  });
}

template <bool kEnergy>
void pullSome(const PointBlock& block, int begin, int end, const double* q, double* slots, double* energy) {
  for (int group = begin; group < end; ++group) {
    const int* corners = block.corners.data() + 2L * group * kLanes;
    const double* rest = block.rest.data() + long{kSpringElementDoubles} * group * kLanes;
    const V3 way = gather(q, corners + kLanes) - gather(q, corners);
    const V rest_m = load(rest), stiffness = load(rest + kLanes);
    const SpringAnswer<V> answer =
        linearSpring<kEnergy ? with_energy : only_resultants>(stiffness, rest_m, dot(way, way));
    const V3 pull = answer.per_length * way;
    double* slot = slots + 6L * group * kLanes;
    write(slot, V3{} - pull);
    write(slot + 3 * kLanes, pull);
    if constexpr (kEnergy) store(energy + long{group} * kLanes, answer.energy);
  }
}

void springs(const PointBlock& block, const double* q, double* slots, double* energy) {
  forChunks(block.groups, [&](int begin, int end) {
    energy ? pullSome<true>(block, begin, end, q, slots, energy)
           : pullSome<false>(block, begin, end, q, slots, energy);
  });
}

/// E = 1/2 |s|^2, s = sum_k w_k (x_k - x_0) (quadratic_hinges.hpp).
template <bool kEnergy>
void straightenSome(const PointBlock& block, int begin, int end, const double* q, double* slots, double* energy) {
  for (int group = begin; group < end; ++group) {
    const int* corners = block.corners.data() + 4L * group * kLanes;
    const double* rest = block.rest.data() + long{kStencilDoubles} * group * kLanes;
    double* slot = slots + 12L * group * kLanes;
    const V3 x0 = gather(q, corners);
    V weight[3];
    V3 sum{}, others{};
    for (int k = 0; k < 3; ++k) {
      weight[k] = load(rest + long{k} * kLanes);
      sum = sum + weight[k] * (gather(q, corners + long{k + 1} * kLanes) - x0);
    }
    for (int k = 0; k < 3; ++k) {
      const V3 f = weight[k] * sum;
      write(slot + 3L * (k + 1) * kLanes, f);
      others = others + f;
    }
    write(slot, V3{} - others);
    if constexpr (kEnergy) store(energy + long{group} * kLanes, 0.5 * dot(sum, sum));
  }
}

void stencils(const PointBlock& block, const double* q, double* slots, double* energy) {
  forChunks(block.groups, [&](int begin, int end) {
    energy ? straightenSome<true>(block, begin, end, q, slots, energy)
           : straightenSome<false>(block, begin, end, q, slots, energy);
  });
}

}  // namespace

extern const BendingKernels GAMBESON_CONCAT(kBending_, GAMBESON_ISA);
const BendingKernels GAMBESON_CONCAT(kBending_, GAMBESON_ISA){angles, bend, moments, springs, stencils};

}  // namespace gambeson
