#pragma once
/// What sweeps and steps along the gradient share. Internal to the iteration of a contact solve.

#include <cmath>

#include "core/contact/contact_rows.hpp"

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

inline Vec3 projected(const Vec3& traction, const ContactWork::Row& facts) {
  return project(traction, facts.normal, facts.friction, facts.drag);
}

/// v - drift, and what the layer yields.
inline Vec3 missing(const Vec3& v, const Vec3& traction, const ContactWork::Row& facts) {
  return v + (facts.compliance * dot(traction, facts.normal)) * facts.normal - facts.drift;
}

/// Squared residual of a row as it is defined, |tau - P(tau - rho (v - drift))|/rho.
inline double residual2(const Vec3& v, const Vec3& traction, const ContactWork::Row& facts) {
  const Vec3 next = projected(traction - (1 / facts.slope) * missing(v, traction, facts), facts);
  return norm2(next - traction) * (facts.slope * facts.slope);
}

/// Sets the momentum of the island's next step, after a step whose product with the gradient is `against`.
inline void advance(double against, ContactWork::Island& island) {
  if (against > 0) {
    island.momentum = 0.5 * (1 + island.momentum);
    island.beta = 0;
  } else {
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * island.momentum * island.momentum));
    island.beta = (island.momentum - 1) / next;
    island.momentum = next;
  }
}

}  // namespace gambeson
