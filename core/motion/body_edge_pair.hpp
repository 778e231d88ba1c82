#pragma once
/// Whether cloth touches a sharp edge or corner of a body between its samples, decided a pair at a time. Detail of
/// core/motion/body_edges.hpp, which states the law, for host and device.

#include <array>

#include "core/contact/box.hpp"
#include "core/contact/reach.hpp"
#include "core/contact/segment_pair.hpp"
#include "core/contact/sharp_view.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {

/// A point of cloth on a point of a body.
struct BodyEdgeTouch {
  Vec3 normal;  ///< to the cloth
  double gap_m = 0;
  Vec3 body_velocity;  ///< mean over the step
  int count = 0;       ///< samples of the stencil
  int stencil[3] = {};
  double weight[3] = {};
  int body_count = 0;  ///< vertices of the body
  int body[2] = {};
  double body_weight[2] = {};
  int pair[3] = {};  ///< 0, corner, triangle; or 1 and two edges
  int feature = 0;
};

struct BodyEdgeView {
  ContactMeshView mesh;
  const char* sharp_edge = nullptr;     ///< of bodies; those that deform are asked
  const char* sharp_corner = nullptr;   ///< likewise
  const int* body_of_vertex = nullptr;  ///< -1: cloth
  const char* deforms = nullptr;        ///< of each body
  const double* thickness_m = nullptr;  ///< of each sample of cloth
  double largest_thickness_m = 0;
  double dt_s = 0;
  const Vec3 *x0 = nullptr, *x1 = nullptr;
};

/// Counts: counts(v) tells whether a sample of cloth takes part.
template <class Counts>
class BodyEdgePairs {
 public:
  GAMBESON_HD BodyEdgePairs(const BodyEdgeView& m, const Counts& counts) : m_(m), counts_(counts), x_(m.x0) {}

  GAMBESON_HD bool cornerOn(int v, int triangle, BodyEdgeTouch& touch) const {
    const std::array<int, 3>& t = m_.mesh.triangles[triangle];
    if (!m_.sharp_corner[v] || m_.body_of_vertex[t[0]] >= 0) return false;
    if (!counts(t) || !mayReach(std::array<int, 1>{v}, t)) return false;
    if (deforms(v) && !isSharpCorner(m_.mesh, x_, v)) return false;
    const std::array<Vec3, 3> corner{x_[t[0]], x_[t[1]], x_[t[2]]};
    const TrianglePoint foot = closestOnTriangle(corner, x_[v]);
    if (foot.feature != kFace) return false;
    const Vec3 way = foot.position - x_[v];
    const double gap = norm(way);
    if (!(gap > 0) || !cornerIsNearest(v, way / gap)) return false;
    const Vec3 u = corner[1] - corner[0], s = corner[2] - corner[0], r = foot.position - corner[0], n = cross(u, s);
    const double b = dot(cross(r, s), n) / norm2(n), c = dot(cross(u, r), n) / norm2(n);
    touch = {};
    touch.pair[0] = 0, touch.pair[1] = v, touch.pair[2] = triangle;
    touch.feature = -1 - v;
    return add(std::array<int, 3>{t[0], t[1], t[2]}, std::array<double, 3>{1 - b - c, b, c}, std::array<int, 1>{v},
               std::array<double, 1>{1.0}, way / gap, gap, touch);
  }

  GAMBESON_HD bool edgeOn(int ea, int eb, BodyEdgeTouch& touch) const {
    const bool a_is_body = m_.body_of_vertex[m_.mesh.edges[ea][0]] >= 0;
    const bool b_is_body = m_.body_of_vertex[m_.mesh.edges[eb][0]] >= 0;
    if (a_is_body == b_is_body) return false;
    const int cloth = a_is_body ? eb : ea, body = a_is_body ? ea : eb;
    if (!m_.sharp_edge[body]) return false;
    const std::array<int, 2>&c = m_.mesh.edges[cloth], &e = m_.mesh.edges[body];
    if (!counts(c) || !mayReach(e, c) || (deforms(e[0]) && !isSharpEdge(m_.mesh, x_, body))) return false;
    const SegmentPair near = nearestOnSegments(x_[c[0]], x_[c[1]], x_[e[0]], x_[e[1]]);
    if (!(std::min(std::min(near.s, 1 - near.s), std::min(near.t, 1 - near.t)) > kInside)) return false;
    const Vec3 at = x_[e[0]] + near.t * (x_[e[1]] - x_[e[0]]);
    const Vec3 way = x_[c[0]] + near.s * (x_[c[1]] - x_[c[0]]) - at;
    const double gap = norm(way);
    if (!(gap > 0) || !edgeIsNearest(body, way / gap)) return false;
    touch = {};
    touch.pair[0] = 1, touch.pair[1] = ea, touch.pair[2] = eb;
    touch.feature = -1 - (m_.mesh.vertex_count + body);
    return add(c, std::array<double, 2>{1 - near.s, near.s}, e, std::array<double, 2>{1 - near.t, near.t}, way / gap,
               gap, touch);
  }

 private:
  static constexpr double kAway = 1e-3;  ///< of faces from the cloth: else they are nearer than the edge
  static constexpr double kInside = 1e-6;

  GAMBESON_HD bool deforms(int v) const { return m_.deforms[m_.body_of_vertex[v]]; }

  template <std::size_t N>
  GAMBESON_HD bool counts(const std::array<int, N>& cloth) const {
    for (int v : cloth)
      if (!counts_(v)) return false;
    return true;
  }

  template <std::size_t N, std::size_t M>
  GAMBESON_HD bool mayReach(const std::array<int, N>& body, const std::array<int, M>& cloth) const {
    double far = contactReach(m_.largest_thickness_m), body_way = 0, cloth_way = 0;
    Box a, b;
    for (int v : body) a.add(x_[v]), body_way = std::max(body_way, norm(m_.x1[v] - x_[v]));
    for (int v : cloth) b.add(x_[v]), cloth_way = std::max(cloth_way, norm(m_.x1[v] - x_[v]));
    far += body_way + cloth_way;
    return overlap(a.grown(far), b);
  }

  /// The corner is the nearest point of its faces: all edges at it lead away from `way`.
  GAMBESON_HD bool cornerIsNearest(int v, const Vec3& way) const {
    for (int e : m_.mesh.vertex_edges[v])
      if (!(dot(alongFrom(m_.mesh, x_, v, e), way) < -kAway)) return false;
    return true;
  }

  GAMBESON_HD bool edgeIsNearest(int edge, const Vec3& way) const {
    for (int t : m_.mesh.edge_faces[edge])
      if (!(dot(acrossFrom(m_.mesh, x_, edge, t), way) < -kAway)) return false;
    return true;
  }

  template <std::size_t N, std::size_t M>
  GAMBESON_HD bool add(const std::array<int, N>& cloth, const std::array<double, N>& weight,
                       const std::array<int, M>& body, const std::array<double, M>& body_weight, const Vec3& normal,
                       double gap, BodyEdgeTouch& touch) const {
    touch.normal = normal;
    touch.gap_m = gap;
    Vec3 way{};
    double thickness = 0;
    for (std::size_t k = 0; k < N; ++k) {
      touch.stencil[k] = cloth[k];
      touch.weight[k] = weight[k];
      way += weight[k] * (m_.x1[cloth[k]] - x_[cloth[k]]);
      thickness += weight[k] * m_.thickness_m[cloth[k]];
    }
    touch.count = static_cast<int>(N);
    for (std::size_t k = 0; k < M; ++k) {
      touch.body[k] = body[k];
      touch.body_weight[k] = body_weight[k];
      touch.body_velocity += (body_weight[k] / m_.dt_s) * (m_.x1[body[k]] - x_[body[k]]);
    }
    touch.body_count = static_cast<int>(M);
    way -= m_.dt_s * touch.body_velocity;
    return comesWithin(contactReach(thickness), gap * normal, way);
  }

  BodyEdgeView m_;
  Counts counts_;
  const Vec3* x_;
};

}  // namespace gambeson
