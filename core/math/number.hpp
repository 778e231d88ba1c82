#pragma once
/// What a law asks of the type that it computes with, beside + - * / and comparisons: so that one formula serves a
/// double, a vector with one point of the cloth in each lane, a dual number that carries its derivative, and device
/// code.

#include <cmath>
#include <type_traits>

#ifdef __CUDACC__
#define GAMBESON_LAW __host__ __device__ __forceinline__
#else
/// A law is always inlined: kernels are compiled once per instruction set, and a function of doubles that two of them
/// shared would be linked from the widest.
#define GAMBESON_LAW [[gnu::always_inline]] inline
#endif

namespace gambeson {

/// Numbers that stand for one point; vectors specialise this beside their type. Both sides of `pick` are evaluated.
template <class S>
struct Number {
  static constexpr int lanes = 1;
  GAMBESON_LAW static S of(double x) { return S(x); }
  GAMBESON_LAW static S pick(bool first, const S& a, const S& b) { return first ? a : b; }
  GAMBESON_LAW static bool any(bool mask) { return mask; }
  GAMBESON_LAW static S root(const S& x) {
    using std::sqrt;
    return sqrt(x);
  }
  /// From and to an array of doubles, one for each lane.
  GAMBESON_LAW static S loaded(const double* p) { return S(*p); }
  GAMBESON_LAW static void stored(double* p, const S& x) {
    if constexpr (std::is_convertible_v<S, double>)
      *p = x;
    else
      *p = x.value;
  }
};

/// a where the mask holds, else b.
template <class S, class Mask>
GAMBESON_LAW S pick(const Mask& mask, const S& a, const S& b) {
  return Number<S>::pick(mask, a, b);
}
/// Whether the mask of a comparison of S holds anywhere.
template <class S, class Mask>
GAMBESON_LAW bool anyOf(const Mask& mask) {
  return Number<S>::any(mask);
}
template <class S>
GAMBESON_LAW S root(const S& x) {
  return Number<S>::root(x);
}
template <class S>
GAMBESON_LAW S magnitude(const S& x) {
  return Number<S>::pick(x < 0.0, -x, x);
}
/// A parameter, which may be one number for all lanes, in each of them.
template <class S, class P>
GAMBESON_LAW S spread(const P& p) {
  if constexpr (std::is_same_v<S, P>)
    return p;
  else
    return Number<S>::of(p);
}
/// (a/b)^2; where b is one number for all lanes, by its reciprocal: one division for all points.
template <class S, class P>
GAMBESON_LAW S squaredRatio(const S& a, const P& b) {
  if constexpr (std::is_same_v<S, P>) {
    const S r = a / b;
    return r * r;
  } else {
    return (a * a) * (1 / (b * b));
  }
}

}  // namespace gambeson
