#pragma once
/// The tension of a plane state of stress.

#include "core/math/number.hpp"

namespace gambeson {

/// The part of the symmetric tensor n = (11, 22, 12) whose principal values are positive, sum max(n_i, 0) e_i e_i^T.
/// The geometric stiffness n^ab N_I,a N_J,b of a membrane is positive semidefinite with it.
template <class S>
GAMBESON_LAW void tensilePart(const S* n, S* tension) {
  const S mean = 0.5 * (n[0] + n[1]), half = 0.5 * (n[0] - n[1]), radius = root(half * half + n[2] * n[2]);
  const S first = 0.5 * (mean + radius + magnitude(mean + radius)),
          second = 0.5 * (mean - radius + magnitude(mean - radius));
  const S middle = 0.5 * (first + second), part = 0.5 * (first - second) / pick(radius > 0.0, radius, Number<S>::of(1));
  tension[0] = middle + part * half;
  tension[1] = middle - part * half;
  tension[2] = part * n[2];
}

}  // namespace gambeson
