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

/// Relative velocity of a row at w.moved.
inline Vec3 velocityOf(const ContactWork& w, int row) {
  V4 part0{}, part1{}, part2{}, part3{};
  const int* column = w.points.columns.data() + w.points.offsets[row];
  const double *value = w.points.values.data() + w.points.offsets[row],
               *end = w.points.values.data() + w.points.offsets[row + 1];
  for (; value + kWays <= end; value += kWays, column += kWays) {
    part0 += value[0] * quad(w.moved[column[0]]);
    part1 += value[1] * quad(w.moved[column[1]]);
    part2 += value[2] * quad(w.moved[column[2]]);
    part3 += value[3] * quad(w.moved[column[3]]);
  }
  if (value < end) part0 += value[0] * quad(w.moved[column[0]]);
  if (value + 1 < end) part1 += value[1] * quad(w.moved[column[1]]);
  if (value + 2 < end) part2 += value[2] * quad(w.moved[column[2]]);
  const V4 sum = (part0 + part1) + (part2 + part3);
  return {sum[0], sum[1], sum[2]};
}

}  // namespace gambeson
