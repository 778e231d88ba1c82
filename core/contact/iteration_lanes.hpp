#pragma once
/// What sweeps and steps along the gradient share. Internal to the iteration of a contact solve.

#include "core/contact/row_sweep.hpp"

namespace gambeson {

// Loops over rows or points, over a range each. Four lanes: a vector and, in the last, what the bounds of steps along
// the gradient need. The same operations in the same order whatever the instruction set: multiply-add is not contracted
// here.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GAMBESON_WIDE __attribute__((target_clones("avx2", "default"), noinline))
#else
#define GAMBESON_WIDE __attribute__((noinline))
#endif
using Quad = ContactWork::Quad;
typedef double V4 __attribute__((vector_size(32)));
inline const V4& quad(const Quad& q) { return *reinterpret_cast<const V4*>(&q); }
inline V4& quad(Quad& q) { return *reinterpret_cast<V4*>(&q); }
inline Vec3 vec(const Quad& q) { return {q.lane[0], q.lane[1], q.lane[2]}; }
inline Quad quadOf(const Vec3& v, double mark = 0) { return {{v.x, v.y, v.z, mark}}; }

}  // namespace gambeson
