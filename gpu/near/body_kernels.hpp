#pragma once
/// Where bodies are in a step: vertices of the mesh, and what feet need to know of each body.

#include "gpu/near/dressed_mesh.hpp"
#include "gpu/near/placing.hpp"
#include "gpu/near/raise.hpp"

namespace gambeson::gpu {

/// How far a point of a rigid shape can move: the motion is affine, so a corner of its box moves most. As core's
/// ProximityQuery has it.
GAMBESON_HD inline double motionBound(const Box& local, const Placement& start, const Placement& end) {
  if (start == end) return 0;
  double d2 = 0;
  for (int i = 0; i < 8; ++i) d2 = std::max(d2, norm2(placed(end, local.corner(i)) - placed(start, local.corner(i))));
  return std::sqrt(d2);
}

/// Of the vertices of a body: bounds at the start, and the largest way squared (raise.hpp).
struct BodyExtent {
  Count less[3];  ///< of the negative coordinates
  Count more[3];
  Count way2;
};

/// Vertices of bodies that do not deform.
struct PlaceVertices {
  const int* body_of_vertex;
  const BodySurface* body;
  int first;  ///< vertex of a body
  Vec3 *x0, *x1;

  GAMBESON_HD void operator()(int i) const {
    const int v = first + i;
    const BodySurface& b = body[body_of_vertex[v]];
    if (b.deforms) return;
    x0[v] = placed(b.start, b.at[v - b.first_vertex]);
    x1[v] = placed(b.end, b.at[v - b.first_vertex]);
  }
};

constexpr int kExtentPart = 16;  ///< vertices that a lane looks at

/// Of body `which`, some vertices.
struct FindExtent {
  const BodySurface* body;
  int which;
  const Vec3 *x0, *x1;
  BodyExtent* extent;

  GAMBESON_HD void operator()(int part) const {
    const BodySurface& b = body[which];
    Box box;
    double way2 = 0;
    const int end = std::min((part + 1) * kExtentPart, b.vertices);
    for (int v = part * kExtentPart; v < end; ++v)
      way2 = std::max(way2, norm2(x1[b.first_vertex + v] - x0[b.first_vertex + v]));
    const int named_end = std::min((part + 1) * kExtentPart, b.named_count);
    bool any = false;
    for (int k = part * kExtentPart; k < named_end; ++k) {
      box.add(x0[b.first_vertex + b.named[k]]);
      any = true;
    }
    BodyExtent& e = extent[which];
    raise(&e.way2, inOrder(way2));
    for (int k = 0; k < 3 && any; ++k) {
      raise(&e.less[k], inOrder(-box.lo[k]));
      raise(&e.more[k], inOrder(box.hi[k]));
    }
  }
};

struct EndBodies {
  BodySurface* body;
  int bodies;
  EllipsoidBody* ellipsoid;
  const BodyExtent* extent;
  const Vec3* x0;

  GAMBESON_HD void operator()(int i) const {
    if (i >= bodies) {
      EllipsoidBody& e = ellipsoid[i - bodies];
      const Vec3& axes = e.metric.semi_axes;
      e.motion_m = motionBound(Box{-axes, axes}, e.start, e.end);
      return;
    }
    BodySurface& b = body[i];
    if (!b.deforms) {
      b.motion_m = motionBound(b.local, b.start, b.end);
      b.view.x = b.at;
      return;
    }
    const BodyExtent& e = extent[i];
    for (int k = 0; k < 3; ++k) {
      b.bounds.lo[k] = -fromOrder(e.less[k]);
      b.bounds.hi[k] = fromOrder(e.more[k]);
    }
    b.motion_m = std::sqrt(fromOrder(e.way2));
    b.view.x = x0 + b.first_vertex;
    b.view.tolerance_m = 1e-10 * norm(b.bounds.halfSize());
  }
};

}  // namespace gambeson::gpu
