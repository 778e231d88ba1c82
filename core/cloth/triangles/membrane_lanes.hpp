#pragma once
/// The membranes of springs and of conditions, and what damps them, in lanes. Included only by kernels.

#include <algorithm>

#include "core/cloth/law_lanes.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/material/laws/spring.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

/// dE/dx of corners 1 and 2 by the springs of a group's triangles, and their energy. e1, e2 and e0 run from corner 0 to
/// 1, from 0 to 2 and from 1 to 2.
struct SpringForces {
  V3 first, second;
  V energy;

  SpringForces(const ElementBlock& block, long group, V3 e0, V3 e1, V3 e2) {
    const double* own = block.springs.data() + kSpringDoubles * group * kLanes;
    const auto of = [&](int k, V3 e) {
      return linearSpring<with_energy>(load(own + (3 + k) * kLanes), load(own + k * kLanes), dot(e, e));
    };
    const SpringAnswer<V> a = of(0, e1), b = of(1, e2), c = of(2, e0);
    first = a.per_length * e1 - c.per_length * e0;
    second = b.per_length * e2 + c.per_length * e0;
    energy = a.energy + b.energy + c.energy;
  }

  /// Adds what keeps the triangles' areas. `rest`: of the group, as MembraneTriangle has it.
  template <unsigned kParts>
  void jam(const BlockLaw& law, const double* rest, V3 e1, V3 e2) {
    const V g1x = load(rest), g1y = load(rest + kLanes), g2x = load(rest + 2 * kLanes), g2y = load(rest + 3 * kLanes),
            area = load(rest + 4 * kLanes);
    const V3 weft = g1x * e1 + g2x * e2, warp = g1y * e1 + g2y * e2;
    const V strain[3] = {0.5 * (dot(weft, weft) - 1.0), 0.5 * (dot(warp, warp) - 1.0), dot(weft, warp)};
    Answer<V, 3> answer;
    answer.resultant[0] = answer.resultant[1] = answer.resultant[2] = V{};
    addJamming<kParts>(law.point.jam_N_per_m, law.point.jam_s, strain, answer);
    const V* n = answer.resultant;
    const V3 p1 = area * (n[0] * weft + n[2] * warp), p2 = area * (n[2] * weft + n[1] * warp);
    first = first + g1x * p1 + g1y * p2;
    second = second + g2x * p1 + g2y * p2;
    energy = energy + area * answer.energy;
  }
};

inline void writeDamping(double* slots, double* power, long group, V3 f1, V3 f2, V taken) {
  double* slot = slots + 9L * group * kLanes;
  const V3 f[3] = {V3{} - f1 - f2, f1, f2};
  for (int i = 0; i < 3; ++i) {
    store(slot + 3 * i * kLanes, f[i].x);
    store(slot + (3 * i + 1) * kLanes, f[i].y);
    store(slot + (3 * i + 2) * kLanes, f[i].z);
  }
  if (power) store(power + group * kLanes, taken);
}

inline void dampGroup(const ElementBlock& block, long group, const double* q, const double* v, double* slots,
                      double* power) {
  const int* corners = block.corners.data() + 3L * group * kLanes;
  const V3 x0 = gather(q, corners), x1 = gather(q, corners + kLanes), x2 = gather(q, corners + 2 * kLanes);
  const V3 v0 = gather(v, corners), v1 = gather(v, corners + kLanes), v2 = gather(v, corners + 2 * kLanes);
  const V3 e1 = x1 - x0, e2 = x2 - x0, w1 = v1 - v0, w2 = v2 - v0;
  if (block.membrane.elements == MembraneElements::springs) {
    const V damping = load(block.springs.data() + (kSpringDoubles * group + 6) * kLanes);
    V taken{};
    const auto of = [&](V3 e, V3 w) {
      const V along = dot(e, w), per_length = springDamping(damping, dot(e, e), along);
      taken += per_length * along;
      return per_length * e;
    };
    const V3 a = of(e1, w1), b = of(e2, w2), c = of(x2 - x1, v2 - v1);
    writeDamping(slots, power, group, a - c, b + c, taken);
    return;
  }
  const double* rest = block.rest.data() + long{kMembraneDoubles} * group * kLanes;
  const V g1x = load(rest), g1y = load(rest + kLanes), g2x = load(rest + 2 * kLanes), g2y = load(rest + 3 * kLanes),
          area = load(rest + 4 * kLanes);
  const V3 weft = g1x * e1 + g2x * e2, warp = g1y * e1 + g2y * e2;
  const V3 weft_rate = g1x * w1 + g2x * w2, warp_rate = g1y * w1 + g2y * w2;
  const V strain[3] = {0.5 * (dot(weft, weft) - 1.0), 0.5 * (dot(warp, warp) - 1.0), dot(weft, warp)};
  const V rate[3] = {dot(weft, weft_rate), dot(warp, warp_rate), dot(weft, warp_rate) + dot(warp, weft_rate)};
  Answer<V, 3> answer;
  baraffWitkinDamping<with_energy>(block.membrane.threads, strain, rate, answer);
  const V* n = answer.resultant;
  const V3 p1 = area * (n[0] * weft + n[2] * warp), p2 = area * (n[2] * weft + n[1] * warp);
  writeDamping(slots, power, group, g1x * p1 + g1y * p2, g2x * p1 + g2y * p2, area * answer.energy);
}

inline void dampTriangles(const ElementBlock& block, const double* q, const double* v, double* slots, double* power) {
  constexpr int chunk_groups = 64;  // that a thread takes at a time
  forAll(Each::much, (block.groups + chunk_groups - 1) / chunk_groups, [&](int chunk) {
    const int end = std::min((chunk + 1) * chunk_groups, block.groups);
    for (int group = chunk * chunk_groups; group < end; ++group) dampGroup(block, group, q, v, slots, power);
  });
}

}  // namespace
}  // namespace gambeson
