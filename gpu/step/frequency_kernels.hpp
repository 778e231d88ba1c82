#pragma once
/// Kernels of an estimate of the largest frequency (core/motion/frequency.cpp). Vectors are of free points; one by
/// which points are moved is M^-1/2 times one of the basis.

#include <cmath>

#include "core/motion/lanczos.hpp"
#include "gpu/forces/sliced_rows.hpp"

namespace gambeson::gpu {

struct NumberSum {
  double value = 0;
  GAMBESON_HD void add(const NumberSum& more) { value += more.value; }
};
/// Of a vector: its squared length, and the largest component of what points are moved by with it.
struct LengthSum {
  double length2 = 0, farthest = 0;
  GAMBESON_HD void add(const LengthSum& more) {
    length2 += more.length2;
    if (more.farthest > farthest) farthest = more.farthest;
  }
  /// What makes it a unit vector; of nothing: nothing.
  GAMBESON_HD double toUnit() const { return length2 > 0 ? 1 / std::sqrt(length2) : 0.0; }
  /// By what part of it points are moved once it is a unit vector.
  GAMBESON_HD double part() const {
    const double far = farthest * toUnit();
    return far > 0 ? kComparedOver_m / far : 0.0;
  }
};

struct StartVector {
  const double* root;  ///< of 1/mass; 0: held
  const Vec3* mode;    ///< null: none yet
  double noise;
  Vec3* to;
  GAMBESON_HD void operator()(int i) const {
    to[i] = root[i] == 0 ? Vec3{} : startOfLanczos(i, mode ? mode + i : nullptr, noise);
  }
};
struct LengthOf {
  const Vec3* vector;
  const double* root;
  GAMBESON_HD LengthSum operator()(int, int i) const {
    const Vec3& v = vector[i];
    const double x = ::fabs(v.x), y = ::fabs(v.y), z = ::fabs(v.z), xy = x > y ? x : y;
    return {norm2(v), root[i] * (xy > z ? xy : z)};
  }
};
/// A unit vector, what it moves points by, and how long it was.
struct TakeUnit {
  const Vec3* vector;
  const double* root;
  const LengthSum* sum;
  Vec3* unit;
  Point4* moved;
  double* length;
  GAMBESON_HD void operator()(int i) const {
    const Vec3 b = sum->toUnit() * vector[i], y = root[i] * b;
    unit[i] = b;
    moved[i] = {y.x, y.y, y.z, 0.0};
    if (i == 0) *length = std::sqrt(sum->length2);
  }
};

/// Where all points are; what `to` has as its fourth number stays.
struct PlaceAll {
  SlicedView map;
  bool all_free;  ///< there is no map
  const Point4* free;
  Point4* to;
  GAMBESON_HD void operator()(int i) const {
    const Point4 x = all_free ? free[i] : map.times(i, free);
    to[i].x = x.x, to[i].y = x.y, to[i].z = x.z;
  }
};
/// All points moved there and back.
struct MoveBothWays {
  SlicedView map;
  bool all_free;
  const Point4 *position, *moved;
  const LengthSum* sum;
  Point4 *before, *after;
  GAMBESON_HD void operator()(int i) const {
    const double part = sum->part();
    const Point4 x = position[i];
    const Vec3 way = part * vec(all_free ? moved[i] : map.times(i, moved)), a = vec(x) - way, b = vec(x) + way;
    before[i] = {a.x, a.y, a.z, x.w};
    after[i] = {b.x, b.y, b.z, x.w};
  }
};
/// M^-1/2 K times what points were moved by, from the forces before and after it (null: none) and the springs' pulls.
struct StiffnessTimes {
  SlicedView transposed;
  bool all_free;
  const Point4 *before, *after;
  const LengthSum* sum;
  SlicedView pulled;
  const Point4* pull;  ///< null: none
  const double* root;
  Vec3* to;
  GAMBESON_HD void operator()(int i) const {
    Vec3 of_forces{}, of_springs{};
    if (before) {
      if (all_free)
        of_forces = vec(before[i]) - vec(after[i]);
      else
        of_forces = vec(transposed.times(i, before)) - vec(transposed.times(i, after));
      const double way = 2 * sum->part();
      of_forces = way > 0 ? of_forces / way : Vec3{};
    }
    if (pull) of_springs = vec(pulled.times(i, pull));
    to[i] = root[i] * (of_forces + of_springs);
  }
};

/// Products of vectors of the basis with one, from one of the basis on.
struct OverlapOf {
  const Vec3* basis;
  int first, n;
  const Vec3* vector;
  GAMBESON_HD NumberSum operator()(int k, int i) const {
    return {dot(basis[static_cast<std::size_t>(first + k) * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)],
                vector[i])};
  }
};
/// Takes away what a vector has of the first of the basis. `last`: where the product with the last of these goes; null:
/// nowhere.
struct TakeAway {
  const Vec3* basis;
  int count, n;
  const NumberSum* overlap;
  Vec3* vector;
  double* last;
  GAMBESON_HD void operator()(int i) const {
    Vec3 v = vector[i];
    const Vec3* b = basis + i;
    for (int k = 0; k < count; ++k, b += n) v -= overlap[k].value * *b;
    vector[i] = v;
    if (last && i == 0) *last = overlap[count - 1].value;
  }
};
struct TakeNumber {
  const NumberSum* from;
  double* to;
  GAMBESON_HD void operator()(int) const { *to = from->value; }
};
/// What the basis makes with these weights.
struct Together {
  const Vec3* basis;
  int count, n;
  const double* weight;
  Vec3* to;
  GAMBESON_HD void operator()(int i) const {
    Vec3 v{};
    const Vec3* b = basis + i;
    for (int k = 0; k < count; ++k, b += n) v += weight[k] * *b;
    to[i] = v;
  }
};

}  // namespace gambeson::gpu
