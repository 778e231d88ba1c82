#pragma once
/// Garments as strain limits see them, for the tests of the constraints and of what is made of them.

#include <vector>

#include "core/cloth/patches/strain_points.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson::shapes {

inline std::vector<double> uniformInverse(const FreeMap& map, double mass = 0.01) {
  return std::vector<double>(map.T.column_count, 1 / mass);
}

struct Net {
  Garment garment;
  FreeMap map;
  std::vector<double> inverse;
  StrainRows rows;
  std::vector<Vec3> p;

  explicit Net(const Garment& g)
      : garment(g),
        map(buildFreeMap(g)),
        inverse(uniformInverse(map)),
        rows(buildStrainRows(g, map, {inverse, {}})),
        p(deformedFree(g, map, 0)) {}
  /// Each point at random by up to `size`.
  void shake(double size, unsigned seed = 5) { p = deformedFree(garment, map, size, seed); }
};

inline Garment seamed() { return fourPatches(2, 3, true, SeamKind::G1, 0, plainFabric()); }

/// Two flat patches of 0.1 m, joined along x = 0.1 with a fold allowed, the second with cells half as wide.
inline Garment folded() {
  NurbsPatch a = flatPatch(uniformKnots(2, 3), uniformKnots(2, 4), 0.1, 0.1), b = a;
  b = flatPatch(uniformKnots(2, 6), uniformKnots(2, 4), 0.1, 0.1);
  for (Vec3& x : b.points) x.x += 0.1;
  return garmentOf({a, b}, {{{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 0}}, plainFabric());
}

}  // namespace gambeson::shapes
