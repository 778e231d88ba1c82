#pragma once
/// Queries by themselves, random and degenerate, and whether two answers are the same to the last bit.

#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

#include "exact/query_generator.hpp"
#include "gpu/finding/impact_search.hpp"

namespace gambeson::gpu {

inline std::vector<ImpactQuestion> impactQuestions(int count) {
  std::vector<ImpactQuestion> all;
  for (const bool edges : {false, true}) {
    exact::QueryGenerator make(edges ? 32 : 31, edges);
    for (int i = 0; i < count / 2; ++i) {
      const exact::MovingPoints q = make(static_cast<exact::QueryKind>(i % exact::kQueryKinds));
      const double separation_m = i % 3 ? 0 : std::pow(10.0, -1.0 - i % 7);
      all.push_back({q.x0, q.x1, edges ? PairKind::edgeEdge : PairKind::pointTriangle, separation_m, i % 2 ? 1e-9 : 0});
    }
  }
  return all;
}

inline std::optional<ImpactTime> answerOfCore(const ImpactQuestion& q) {
  return (q.kind == PairKind::edgeEdge ? edgeEdgeImpact : pointTriangleImpact)(q.x0, q.x1, q.separation_m,
                                                                               q.tolerance_m);
}

inline bool sameBits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool sameBits(const ImpactAnswer& a, const std::optional<ImpactTime>& b) {
  if (!b || !a.meets) return a.meets == b.has_value();
  return sameBits(a.hit.time, b->time) && sameBits(a.hit.u, b->u) && sameBits(a.hit.v, b->v) &&
         sameBits(a.hit.gap_m, b->gap_m) && a.hit.capped == b->capped;
}

}  // namespace gambeson::gpu
