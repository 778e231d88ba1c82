#pragma once
/// Four numbers in single precision, worked on at once.

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <cmath>

namespace gambeson {

using Four = float __attribute__((vector_size(16)));
using FourBits = int __attribute__((vector_size(16)));

// One instruction each where the compiler makes three of the comparison. Of `signs`, bit k: comparison k holds.
#ifdef __SSE2__
inline Four least(const Four& a, const Four& b) { return _mm_min_ps(a, b); }
inline Four most(const Four& a, const Four& b) { return _mm_max_ps(a, b); }
inline int signs(const FourBits& m) { return _mm_movemask_ps(reinterpret_cast<Four>(m)); }
inline Four root(const Four& a) { return _mm_sqrt_ps(a); }
#else
inline Four least(const Four& a, const Four& b) { return a < b ? a : b; }
inline Four most(const Four& a, const Four& b) { return a > b ? a : b; }
inline int signs(const FourBits& m) { return (m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8); }
inline Four root(const Four& a) { return Four{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])}; }
#endif

inline bool any(const FourBits& m) { return signs(m) != 0; }
inline Four all(float x) { return Four{x, x, x, x}; }
/// The least and the most of four numbers, in all places.
inline Four leastOf(Four a) {
  a = least(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return least(a, __builtin_shufflevector(a, a, 1, 0, 3, 2));
}
inline Four mostOf(Four a) {
  a = most(a, __builtin_shufflevector(a, a, 2, 3, 0, 1));
  return most(a, __builtin_shufflevector(a, a, 1, 0, 3, 2));
}

/// Rows become columns.
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Four AB = __builtin_shufflevector(a, b, 2, 6, 3, 7), CD = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  c = __builtin_shufflevector(AB, CD, 0, 1, 4, 5), d = __builtin_shufflevector(AB, CD, 2, 3, 6, 7);
}

}  // namespace gambeson
