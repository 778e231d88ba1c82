#pragma once
/// Vectors of doubles for the element kernels, one lane per cell. Included only by files that are compiled once per
/// instruction set: everything here has internal linkage.

#include <cmath>
#include <type_traits>

#if defined(__AVX2__)
#include <immintrin.h>
#else
#include <emmintrin.h>
#endif

#include "core/cloth/shell/shell_kernel.hpp"
#include "core/material/jamming.hpp"

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
typedef long long M __attribute__((vector_size(8 * kLanes)));

inline V load(const double* p) { return *reinterpret_cast<const V*>(p); }
inline void store(double* p, V v) { *reinterpret_cast<V*>(p) = v; }
inline V splat(double s) { return V{} + s; }
inline V absolute(V v) { return v < 0 ? -v : v; }
inline V squareRoot(V v) {
#if defined(__AVX512F__)
  return _mm512_sqrt_pd(v);
#elif defined(__AVX2__)
  return _mm256_sqrt_pd(v);
#else
  return _mm_sqrt_pd(v);
#endif
}

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

/// Control points, one of each lane's cell.
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

/// core/material/bending.hpp, in lanes. Returns the moment; adds the energy.
template <bool kEnergy>
inline V moment(V k, double b0, double k0, double kr, V& energy) {
  if (k0 == 0) {
    if constexpr (kEnergy) energy += 0.5 * b0 * k * k;
    return b0 * k;
  }
  const V a = absolute(k);
  const double steep = 2 * b0 * std::sqrt(k0 / kr);
  const V ratio2 = (a * a) * (1 / (kr * kr));
  const V root = squareRoot(k0 * a);
  const V m = a > k0 ? b0 * (a + k0) : a > kr ? 2 * b0 * root : steep * a * (1.25 - 0.25 * ratio2);
  if constexpr (kEnergy) {
    const V below = a < kr ? a : splat(kr);
    const V r2 = below * below * (1 / (kr * kr));
    V e = steep * below * below * (0.625 - 0.0625 * r2);
    const V mid = a < k0 ? a : splat(k0);
    const V e_root = 4.0 / 3.0 * b0 * std::sqrt(k0) * (mid * squareRoot(mid) - kr * std::sqrt(kr));
    e = a > kr ? e + e_root : e;
    e = a > k0 ? e + b0 * (0.5 * (a * a - k0 * k0) + k0 * (a - k0)) : e;
    energy += e;
  }
  return k < 0 ? -m : m;
}

/// PointLaw, in lanes.
struct LawLanes {
  V A[6], B[6], D[6], kappa0, kappa_regular, tension, jam, jam_s;
};
static_assert(sizeof(LawLanes) == kLawDoubles * sizeof(V));

/// The parts that ShellLaw leaves out become zero; `steepest` replaces eq. 2.14 by its steepest slope and a tension
/// field by the membrane that it relaxes.
inline void leaveOut(const ShellLaw& law, LawLanes& l) {
  for (int i = 0; i < 6; ++i) {
    if (!law.membrane) l.A[i] = V{};
    if (!law.membrane || !law.bending) l.B[i] = V{};
    if (!law.bending) l.D[i] = V{};
  }
  if (law.steepest) {
    const V k0 = l.kappa0 > 0 ? l.kappa0 : splat(1), kr = l.kappa0 > 0 ? l.kappa_regular : splat(1);
    const V steep = l.kappa0 > 0 ? 2.5 * squareRoot(k0 / kr) : splat(1);
    l.D[0] *= steep;
    l.D[1] *= steep;
    l.kappa0 = l.tension = V{};
  }
  if (!law.membrane) l.tension = l.jam = V{};
}

inline void constantLaw(const ShellLaw& law, LawLanes& l) {
  const double* values = reinterpret_cast<const double*>(&law.point);
  V* out = reinterpret_cast<V*>(&l);
  for (int i = 0; i < kLawDoubles; ++i) out[i] = splat(values[i]);
  leaveOut(law, l);
}

inline void lawAtPoint(const ShellLaw& law, const double* data, LawLanes& l) {
  V* out = reinterpret_cast<V*>(&l);
  for (int i = 0; i < kLawDoubles; ++i) out[i] = load(data + i * kLanes);
  leaveOut(law, l);
}

/// y = S x + y for a symmetric S in the order of Voigt.
inline void addSymmetric(const V* S, const V* x, V* y) {
  y[0] += S[0] * x[0] + S[3] * x[1] + S[4] * x[2];
  y[1] += S[3] * x[0] + S[1] * x[1] + S[5] * x[2];
  y[2] += S[4] * x[0] + S[5] * x[1] + S[2] * x[2];
}

/// `moment` with a law of its own in each lane: linear where k0 = 0. `slope` becomes dm/dk.
template <bool kEnergy, bool kSlope>
inline V momentLanes(V k, V b0, V k0, V kr, V& energy, V& slope) {
  const M on = k0 > 0;
  const V k0s = on ? k0 : splat(1), krs = on ? kr : splat(1), a = absolute(k);
  const V r = a / krs, steep = 2.0 * b0 * squareRoot(k0s / krs), root = squareRoot(k0s * a);
  V m = a > k0s ? b0 * (a + k0s) : a > krs ? 2.0 * b0 * root : steep * a * (1.25 - 0.25 * (r * r));
  m = on ? (k < 0 ? -m : m) : b0 * k;
  if constexpr (kSlope) {
    const V away = a > 0 ? a : splat(1);
    const V s = a > k0s ? b0 : a > krs ? b0 * squareRoot(k0s / away) : steep * (1.25 - 0.75 * (r * r));
    slope = on ? s : b0;
  }
  if constexpr (kEnergy) {
    const V below = a < krs ? a : krs, r2 = below / krs, mid = a < k0s ? a : k0s;
    V e = steep * below * below * (0.625 - 0.0625 * (r2 * r2));
    const V e_root = (4.0 / 3.0) * b0 * squareRoot(k0s) * (mid * squareRoot(mid) - krs * squareRoot(krs));
    e = a > krs ? e + e_root : e;
    e = a > k0s ? e + b0 * (0.5 * (a * a - k0s * k0s) + k0s * (a - k0s)) : e;
    energy += on ? e : 0.5 * b0 * k * k;
  }
  return m;
}

/// core/material/jamming.hpp, in lanes: adds to n, to the energy and to the slope of n (in the order of Voigt).
template <bool kEnergy, bool kSlope>
inline void addJam(V k, V s0, const V* e, V* n, V& energy, V* slope) {
  const V a = 1.0 + 2.0 * e[0], b = 1.0 + 2.0 * e[1], det = a * b - e[2] * e[2];
  const V s = det > jam_least_s ? det : splat(jam_least_s), inv = 1.0 / s;
  const V ratio = s0 * inv, r = ratio > 1.0 ? ratio - 1.0 : V{};
  const V push = -0.25 * k * r * ratio * inv;  // dW/ds
  const V grad[3] = {2.0 * b, 2.0 * a, -2.0 * e[2]};
  for (int i = 0; i < 3; ++i) n[i] += push * grad[i];
  if constexpr (kEnergy) energy += 0.125 * k * (r * r);
  if constexpr (kSlope) {
    const V steep = ratio > 1.0 ? 0.25 * k * ratio * inv * inv * (ratio + 2.0 * r) : V{};  // d2W/ds2
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int i = 0; i < 6; ++i) slope[i] += steep * grad[row[i]] * grad[column[i]];
    slope[3] += 4.0 * push;
    slope[2] -= 2.0 * push;
  }
}

/// The general law: strain e = (E11, E22, 2 E12), curvature change k = (k11, k22, 2 k12), to n, m and the energy per
/// area. With kSlope A and D of `l` become the slopes of n and m.
template <bool kEnergy, bool kSlope, class Lanes>
inline void generalLaw(const ShellLaw& law, Lanes& l, const V* e, const V* k, V* n, V* m, V& energy) {
  n[0] = n[1] = n[2] = m[0] = m[1] = m[2] = V{};
  addSymmetric(l.A, e, n);
  V membrane{};
  if constexpr (kEnergy) membrane = 0.5 * (n[0] * e[0] + n[1] * e[1] + n[2] * e[2]);
  if (law.tension) {
    alignas(64) V slope[6];
    for (int i = 0; i < 6; ++i) slope[i] = l.A[i];
    tensionFieldLanes(kLanes, reinterpret_cast<const double*>(l.A), reinterpret_cast<const double*>(e),
                      reinterpret_cast<const double*>(&l.tension), reinterpret_cast<double*>(n),
                      reinterpret_cast<double*>(&membrane), kSlope ? reinterpret_cast<double*>(slope) : nullptr);
    if constexpr (kSlope)
      for (int i = 0; i < 6; ++i) l.A[i] = slope[i];
  }
  if constexpr (kEnergy) energy += membrane;
  if (law.jams) {
    V* slope = nullptr;
    if constexpr (kSlope) slope = l.A;
    addJam<kEnergy, kSlope>(l.jam, l.jam_s, e, n, energy, slope);
  }
  V coupled[3]{};
  addSymmetric(l.B, e, coupled);
  if constexpr (kEnergy) energy += coupled[0] * k[0] + coupled[1] * k[1] + coupled[2] * k[2];
  addSymmetric(l.B, k, n);
  if (law.zheng) {
    // No coupling and no off-diagonal rigidity where kappa0 > 0; a linear point among them keeps its own.
    V s1{}, s2{}, bending{};
    const V linear_m[3] = {l.D[3] * k[1] + l.D[4] * k[2], l.D[3] * k[0] + l.D[5] * k[2],
                           l.D[4] * k[0] + l.D[5] * k[1] + l.D[2] * k[2]};
    m[0] = momentLanes<kEnergy, kSlope>(k[0], l.D[0], l.kappa0, l.kappa_regular, bending, s1) + linear_m[0];
    m[1] = momentLanes<kEnergy, kSlope>(k[1], l.D[1], l.kappa0, l.kappa_regular, bending, s2) + linear_m[1];
    m[2] = linear_m[2];
    if constexpr (kEnergy) energy += bending + 0.5 * (linear_m[0] * k[0] + linear_m[1] * k[1] + linear_m[2] * k[2]);
    if constexpr (kSlope) {
      l.D[0] = s1;
      l.D[1] = s2;
    }
  } else {
    addSymmetric(l.D, k, m);
    if constexpr (kEnergy) energy += 0.5 * (m[0] * k[0] + m[1] * k[1] + m[2] * k[2]);
  }
  for (int i = 0; i < 3; ++i) m[i] += coupled[i];
}

/// The numbers of ShellLaw alone: orthotropic membrane, bending of weft and warp, twist.
struct FabricLaw {
  const ShellLaw& law;
  template <bool kEnergy>
  void evaluate(const V* e, const V* k, V* n, V* m, V& energy) const {
    n[0] = law.d1 * e[0] + law.d3 * e[1];
    n[1] = law.d3 * e[0] + law.d2 * e[1];
    n[2] = law.d4 * e[2];
    if constexpr (kEnergy) energy += 0.5 * (n[0] * e[0] + n[1] * e[1] + n[2] * e[2]);
    if (law.jams && law.membrane)
      addJam<kEnergy, false>(splat(law.point.jam_N_per_m), splat(law.point.jam_s), e, n, energy, nullptr);
    m[0] = moment<kEnergy>(k[0], law.bending_weft, law.kappa0, law.kappa_regular, energy);
    m[1] = moment<kEnergy>(k[1], law.bending_warp, law.kappa0, law.kappa_regular, energy);
    m[2] = law.twist * k[2];
    if constexpr (kEnergy) energy += 0.5 * m[2] * k[2];
  }
};

struct GeneralLaw {
  const ShellLaw& law;
  LawLanes lanes{};
  template <bool kEnergy>
  void evaluate(const V* e, const V* k, V* n, V* m, V& energy) const {
    generalLaw<kEnergy, false>(law, lanes, e, k, n, m, energy);
  }
};

}  // namespace
}  // namespace gambeson
