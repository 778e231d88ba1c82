#pragma once
/// Closed curves in which planes cut a mesh.

#include <vector>

#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A plane with axes of its own: x = origin + u e1 + v e2.
struct CutPlane {
  Vec3 origin, e1, e2;

  /// The plane through a point with a unit normal; e1 x e2 is the normal.
  static CutPlane across(const Vec3& origin, const Vec3& normal);
  /// A level: e1 forward (x), e2 left (y).
  static CutPlane level(double z) { return {{0, 0, z}, {1, 0, 0}, {0, 1, 0}}; }
  Vec3 normal() const { return cross(e1, e2); }
};

/// One curve, in the plane's axes. `centre` and `area_m2` are those of what it encloses, without sign.
struct CutLoop {
  std::vector<Vec2> points;
  Vec2 centre;
  double area_m2 = 0;
  bool closed = true;  ///< false: it ends at holes of the mesh

  double girth() const;  ///< by the tape [m]
  double low(int axis) const;
  double high(int axis) const;
};

/// The curves of a plane through the mesh, in the order of the triangles where they start.
std::vector<CutLoop> cutLoops(const TriangleMesh& mesh, const CutPlane& plane);

/// The loop whose centre lies nearest to a point of the plane; null where there is none.
const CutLoop* nearestLoop(const std::vector<CutLoop>& loops, const Vec2& to);

}  // namespace gambeson
