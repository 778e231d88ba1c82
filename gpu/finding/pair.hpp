#pragma once
/// Two primitives that may meet, and when they do.

#include <compare>

namespace gambeson::gpu {

enum class PairKind { pointTriangle, edgeEdge };
constexpr int kPairKinds = 2;

/// A vertex and a face, or two edges, the smaller first.
struct alignas(8) Pair {
  int first, second;
  auto operator<=>(const Pair&) const = default;
};

/// As core/contact/certified_impact.hpp has it: up to that time, in [0, 1], they are further apart than the separation.
struct Hit {
  Pair pair;
  double time;
  bool operator==(const Hit&) const = default;
};

}  // namespace gambeson::gpu
