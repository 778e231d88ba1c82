#pragma once
/// Vectors of doubles for the element kernels, one lane for each element. Included only by files that are compiled once
/// per instruction set: everything here has internal linkage.

#include <cmath>
#include <numbers>
#include <type_traits>

#if defined(__AVX2__)
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif

#include "core/math/number.hpp"

#define GAMBESON_CONCAT2(a, b) a##b
#define GAMBESON_CONCAT(a, b) GAMBESON_CONCAT2(a, b)
#define GAMBESON_STRING2(a) #a
#define GAMBESON_STRING(a) GAMBESON_STRING2(a)

namespace gambeson {
namespace {

#if defined(__AVX512F__)
constexpr int kLanes = 8;
#elif defined(__AVX2__)
constexpr int kLanes = 4;
#else
constexpr int kLanes = 2;
#endif
typedef double V __attribute__((vector_size(8 * kLanes)));
typedef long M __attribute__((vector_size(8 * kLanes)));

inline V load(const double* p) { return *reinterpret_cast<const V*>(p); }
inline void store(double* p, V v) { *reinterpret_cast<V*>(p) = v; }
inline V splat(double s) { return V{} + s; }
inline V squareRoot(V v) {
#if defined(__AVX512F__)
  return _mm512_sqrt_pd(v);
#elif defined(__AVX2__)
  return _mm256_sqrt_pd(v);
#else
  return _mm_sqrt_pd(v);
#endif
}

}  // namespace

template <>
struct Number<V> {
  static constexpr int lanes = kLanes;
  GAMBESON_LAW static V of(double x) { return splat(x); }
  GAMBESON_LAW static V pick(M first, V a, V b) { return first ? a : b; }
  GAMBESON_LAW static bool any(M mask) {
#if defined(__AVX512F__)
    return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(mask), reinterpret_cast<__m512i>(mask)) != 0;
#elif defined(__AVX2__)
    return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)) != 0;
#else
    return _mm_movemask_pd(reinterpret_cast<__m128d>(mask)) != 0;
#endif
  }
  GAMBESON_LAW static V root(V x) { return squareRoot(x); }
  GAMBESON_LAW static V loaded(const double* p) { return *reinterpret_cast<const Anywhere*>(p); }
  GAMBESON_LAW static void stored(double* p, V x) { *reinterpret_cast<Anywhere*>(p) = x; }
  typedef double Anywhere __attribute__((vector_size(8 * kLanes), aligned(8)));
};
namespace {

struct V3 {
  V x, y, z;
};
inline V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator*(V s, V3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline V dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(V3 a, V3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline void add(V3& a, V s, V3 b) {
  a.x += s * b.x;
  a.y += s * b.y;
  a.z += s * b.z;
}

/// Points, one of each lane's element. Where vectors have four lanes or more, a point is loaded whole, its three
/// numbers and nothing behind them, and lanes and components are then exchanged: a third of the loads.
#if defined(__AVX512F__)
inline V3 gather(const double* q, const int* nodes) {
  const auto point = [&](int l) { return _mm256_maskz_loadu_pd(7, q + 3L * nodes[l]); };
  const auto pair = [&](int l) { return _mm512_insertf64x4(_mm512_castpd256_pd512(point(l)), point(l + 4), 1); };
  const V a = pair(0), b = pair(1), c = pair(2), d = pair(3);  // (x, y, z, 0) of a lane and of the fourth behind it
  const V xz_ab = _mm512_unpacklo_pd(a, b), xz_cd = _mm512_unpacklo_pd(c, d);
  const V y_ab = _mm512_unpackhi_pd(a, b), y_cd = _mm512_unpackhi_pd(c, d);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13), high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  return {_mm512_permutex2var_pd(xz_ab, low, xz_cd), _mm512_permutex2var_pd(y_ab, low, y_cd),
          _mm512_permutex2var_pd(xz_ab, high, xz_cd)};
}
#elif defined(__AVX2__)
inline V3 gather(const double* q, const int* nodes) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const auto point = [&](int l) { return _mm256_maskload_pd(q + 3L * nodes[l], three); };
  const V a = point(0), b = point(1), c = point(2), d = point(3);
  const V xz_ab = _mm256_unpacklo_pd(a, b), xz_cd = _mm256_unpacklo_pd(c, d);
  const V y_ab = _mm256_unpackhi_pd(a, b), y_cd = _mm256_unpackhi_pd(c, d);
  return {_mm256_permute2f128_pd(xz_ab, xz_cd, 0x20), _mm256_permute2f128_pd(y_ab, y_cd, 0x20),
          _mm256_permute2f128_pd(xz_ab, xz_cd, 0x31)};
}
#else
inline V3 gather(const double* q, const int* nodes) {
  V3 x;
  for (int l = 0; l < kLanes; ++l) {
    const double* at = q + 3L * nodes[l];
    x.x[l] = at[0];
    x.y[l] = at[1];
    x.z[l] = at[2];
  }
  return x;
}
#endif

/// The angle [rad] in [-pi, pi] whose sine and cosine are in this proportion, within two units in the last place. Not
/// for 0 and 0. With t the smaller over the larger of their sizes, atan(t)/t is a Chebyshev fit in t^2 on [0, 1], off
/// by 5e-18 at most.
inline V angleOf(V sine, V cosine) {
  constexpr double fit[] = {1.0,
                            -0.3333333333333286,
                            0.19999999999929946,
                            -0.14285714281592693,
                            0.11111110982087126,
                            -0.09090906605656898,
                            0.0769227555520563,
                            -0.06666371187721098,
                            0.05880342002401543,
                            -0.052527255573225747,
                            0.04719723992321112,
                            -0.042125723963855326,
                            0.03651081352721035,
                            -0.02970071773623423,
                            0.021740213830758134,
                            -0.013674139288399478,
                            0.007038646202989813,
                            -0.0028047655531701315,
                            0.0008033604181626027,
                            -0.00014617088163625013,
                            1.2631178430477426e-05};
  const V up = sine < 0.0 ? -sine : sine, along = cosine < 0.0 ? -cosine : cosine;
  const M steep = up > along;
  const V t = (steep ? along : up) / (steep ? up : along), z = t * t, z2 = z * z;
  // Even and odd powers side by side: half as long a chain.
  V even = splat(fit[20]), odd = splat(fit[19]);
  for (int k = 18; k >= 0; k -= 2) even = even * z2 + fit[k];
  for (int k = 17; k >= 1; k -= 2) odd = odd * z2 + fit[k];
  V angle = t * (even + z * odd);
  angle = steep ? 0.5 * std::numbers::pi - angle : angle;
  angle = cosine < 0.0 ? std::numbers::pi - angle : angle;
  return sine < 0.0 ? -angle : angle;
}

}  // namespace
}  // namespace gambeson
