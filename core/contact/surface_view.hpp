#pragma once
/// Distances to a triangle mesh, decided a triangle at a time. Detail of mesh_surface.hpp, which says what counts, for
/// host and device.

#include <algorithm>
#include <cmath>
#include <span>

#include "core/contact/mesh_topology.hpp"
#include "core/contact/triangle.hpp"
#include "core/math/angle.hpp"

namespace gambeson {

/// A foot point on a mesh: the unit normal points to the front, distance_m is negative behind.
struct MeshPoint {
  Vec3 position;
  Vec3 normal;
  double distance_m = 0;
  int feature = 0;
};

/// A mesh by where its arrays lie (MeshTopology), with its positions.
struct SurfaceView {
  /// Bit k: the face answers for its edge/corner k.
  struct Owns {
    unsigned char edges = 0, vertices = 0;
  };
  /// The nearest of the points that were looked at.
  struct Nearest {
    double dist2_m2;  ///< beyond it nothing counts
    Vec3 position{};
    int feature = -1;
  };

  const Vec3* x = nullptr;
  double tolerance_m = 0;  ///< lengths below this are rounding
  int face_count = 0, edge_count = 0;
  const std::array<int, 3>* triangles = nullptr;
  const std::array<int, 3>* face_edges = nullptr;
  const MeshTopology::Edge* edges = nullptr;
  const int* edge_begin = nullptr;
  const MeshTopology::Corner* edge_faces = nullptr;
  const int* vertex_begin = nullptr;
  const int* vertex_edges = nullptr;
  const int* corners_begin = nullptr;
  const MeshTopology::Corner* corners = nullptr;  ///< of vertex v: [corners_begin[v], corners_begin[v + 1]), by face
  const char* rim_edge = nullptr;
  const char* rim_vertex = nullptr;
  const Owns* owns = nullptr;  ///< of each face
  bool closed = false;

  GAMBESON_HD bool collapsed(int face) const { return face_edges[face][0] < 0; }
  GAMBESON_HD int edgeFeature(int e) const { return face_count + e; }
  GAMBESON_HD int vertexFeature(int v) const { return face_count + edge_count + v; }

  /// Local minima that this triangle answers for, add(MeshPoint) for each. False: it is out of reach.
  template <class Add>
  GAMBESON_HD bool faceFeet(int t, const Vec3& p, double radius, Add&& add) const;
  /// Of features that are equally near the first counts.
  GAMBESON_HD void lookAt(int t, const Vec3& p, Nearest& best) const;
  /// A foot with its normal and the signed distance of p.
  GAMBESON_HD MeshPoint signedFoot(const Vec3& p, const Vec3& foot, int feature) const;
  /// The foot's point as weights of the vertices of its triangle, edge or corner.
  GAMBESON_HD MaterialPoint material(const MeshPoint& foot) const;
  /// Of the minima of a point, by feature, those that it touches: moved to the front, and how many they are.
  GAMBESON_HD int chooseAmong(MeshPoint* feet, int count) const;

 private:
  /// On which side of an edge a point is, looked at along the plane of a face: the face's own, within the tolerance of
  /// the edge, or beyond.
  enum class Side { in, on, out };
  struct EdgeFrame {
    Vec3 direction;  ///< unit, v to w
    double length_m = 0;
  };
  /// Square of what rounding makes of a product of unit vectors and one of length 1, and far more.
  static constexpr double kRounding2 = 1e-26;

  GAMBESON_HD static Vec3 unitOrZero(const Vec3& v) {
    const double l = norm(v);
    return l > 0 ? v / l : Vec3{};
  }
  /// Whether |s|/sqrt(of2), as in `surely`, is less than `radius` in spite of any rounding.
  GAMBESON_HD static bool surelyWithin(double s, double of2, double r2, double radius) {
    const double radius2 = radius * radius;
    return s * s < 0.99 * radius2 * of2 && kRounding2 * r2 < 1e-6 * radius2;
  }
  /// Of twice the face's area.
  GAMBESON_HD Vec3 areaNormal(int t) const {
    const auto& c = triangles[t];
    return cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]);
  }
  /// Unit; 0 for a triangle without area.
  GAMBESON_HD Vec3 normalOf(int t) const { return collapsed(t) ? Vec3{} : unitOrZero(areaNormal(t)); }
  /// Whether s/sqrt(of2), how far along a unit vector a point goes that is sqrt(r2) away, is beyond the tolerance in
  /// spite of any rounding: 1 forwards, -1 backwards, 0 where that is not certain. It nearly always is, which spares
  /// the unit vector.
  GAMBESON_HD int surely(double s, double of2, double r2) const {
    if (!(s * s > 4 * (tolerance_m * tolerance_m + kRounding2 * r2) * of2)) return 0;
    return s > 0 ? 1 : -1;
  }
  /// Of a point at r from the edge's line, over a face with this normal, into which the edge e goes round.
  GAMBESON_HD Side sideOf(const Vec3& r, const Vec3& e, const Vec3& area_normal) const {
    const int sure = surely(dot(r, cross(area_normal, e)), norm2(area_normal) * norm2(e), norm2(r));
    if (sure != 0) return sure > 0 ? Side::in : Side::out;
    const double s = dot(r, unitOrZero(cross(unitOrZero(area_normal), e)));
    return s > tolerance_m ? Side::in : s < -tolerance_m ? Side::out : Side::on;
  }
  GAMBESON_HD EdgeFrame edgeOf(int e) const {
    const Vec3 d = x[edges[e].w] - x[edges[e].v];
    return {unitOrZero(d), norm(d)};
  }
  GAMBESON_HD Vec3 edgeNormal(int e) const {
    Vec3 sum{};
    for (int i = edge_begin[e]; i < edge_begin[e + 1]; ++i) sum += normalOf(edge_faces[i].face);
    return unitOrZero(sum);
  }
  GAMBESON_HD Vec3 vertexNormal(int v) const {
    Vec3 sum{};
    for (int i = corners_begin[v]; i < corners_begin[v + 1]; ++i) {
      const int t = corners[i].face, k = corners[i].k;
      const auto& c = triangles[t];
      const Vec3 e = x[c[(k + 1) % 3]] - x[c[k]], back = x[c[(k + 2) % 3]] - x[c[k]];
      sum += angleOf(norm(cross(e, back)), dot(e, back)) * normalOf(t);
    }
    return unitOrZero(sum);
  }
  GAMBESON_HD bool edgeIsMinimum(int e, const Vec3& p, int from, Vec3& foot) const;
  GAMBESON_HD bool vertexIsMinimum(int v, const Vec3& p) const;
};

GAMBESON_HD inline MaterialPoint SurfaceView::material(const MeshPoint& foot) const {
  MaterialPoint m;
  const auto set = [&](int k, int v, double w) {
    m.vertex[k] = v;
    m.weight[k] = w;
  };
  if (foot.feature >= face_count + edge_count) {
    set(0, foot.feature - face_count - edge_count, 1);
  } else if (foot.feature >= face_count) {
    const int e = foot.feature - face_count;
    const int v = edges[e].v, w = edges[e].w;
    const EdgeFrame f = edgeOf(e);
    const double t = f.length_m > 0 ? std::clamp(dot(foot.position - x[v], f.direction) / f.length_m, 0.0, 1.0) : 0;
    set(0, v, 1 - t);
    set(1, w, t);
  } else {
    const auto& c = triangles[foot.feature];
    const Vec3 u = x[c[1]] - x[c[0]], s = x[c[2]] - x[c[0]], r = foot.position - x[c[0]], n = cross(u, s);
    const double b = dot(cross(r, s), n) / norm2(n), d = dot(cross(u, r), n) / norm2(n);
    set(0, c[0], 1 - b - d);
    set(1, c[1], b);
    set(2, c[2], d);
  }
  return m;
}

GAMBESON_HD inline MeshPoint SurfaceView::signedFoot(const Vec3& p, const Vec3& foot, int feature) const {
  MeshPoint m{foot, {}, 0, feature};
  if (feature < face_count) {
    m.normal = normalOf(feature);
    m.distance_m = dot(p - foot, m.normal);
    return m;
  }
  const int e = feature - face_count, v = e - edge_count;
  const bool is_edge = e < edge_count;
  const Vec3 r = p - foot;
  const double d = norm(r);
  // Closer than this the direction is rounding.
  const bool tells = d > 10 * tolerance_m;
  // In front of each face there, as most are, it is in front of their mean.
  const auto inFront = [&](const MeshTopology::Corner& c) {
    const Vec3 n = areaNormal(c.face);
    const double h = dot(r, n);
    return h > 0 && h * h > kRounding2 * norm2(r) * norm2(n);
  };
  const MeshTopology::Corner* of = is_edge ? edge_faces : corners;
  const int begin = is_edge ? edge_begin[e] : corners_begin[v],
            end = is_edge ? edge_begin[e + 1] : corners_begin[v + 1];
  bool in_front = tells;
  for (int i = begin; i < end && in_front; ++i) in_front = inFront(of[i]);
  if (in_front) {
    m.distance_m = d;
    m.normal = r / d;
    return m;
  }
  const Vec3 pseudo = is_edge ? edgeNormal(e) : vertexNormal(v);
  const bool rim = is_edge ? rim_edge[e] : rim_vertex[v];
  const bool behind = !rim && dot(r, pseudo) < 0;
  m.distance_m = behind ? -d : d;
  m.normal = tells ? r / m.distance_m : pseudo;
  return m;
}

GAMBESON_HD inline void SurfaceView::lookAt(int t, const Vec3& p, Nearest& best) const {
  if (collapsed(t)) return;
  const auto& c = triangles[t];
  const TrianglePoint q = closestOnTriangle({x[c[0]], x[c[1]], x[c[2]]}, p);
  if (!(q.dist2_m2 <= best.dist2_m2)) return;
  const int feature = q.feature == kFace    ? t
                      : q.feature >= kEdge0 ? edgeFeature(face_edges[t][q.feature - kEdge0])
                                            : vertexFeature(c[q.feature]);
  if (q.dist2_m2 == best.dist2_m2 && best.feature >= 0 && best.feature < feature) return;
  best = {q.dist2_m2, q.position, feature};
}

/// Whether the distance of p to the edge and its faces, from face number `from` of these on, has its minimum on the
/// edge: the foot of p lies within the edge, and p above none of the faces. Sets that foot.
GAMBESON_HD inline bool SurfaceView::edgeIsMinimum(int e, const Vec3& p, int from, Vec3& foot) const {
  const Vec3& a = x[edges[e].v];
  const Vec3 r = p - a;
  for (int i = edge_begin[e] + from; i < edge_begin[e + 1]; ++i) {
    const int t = edge_faces[i].face, k = edge_faces[i].k;
    const auto& c = triangles[t];
    if (sideOf(r, x[c[(k + 1) % 3]] - x[c[k]], areaNormal(t)) == Side::in) return false;
  }
  const EdgeFrame f = edgeOf(e);
  const double t = dot(r, f.direction);
  if (!(t >= -tolerance_m && t <= f.length_m + tolerance_m)) return false;
  foot = a + std::clamp(t, 0.0, f.length_m) * f.direction;
  return true;
}

/// Whether the distance of p has its minimum around this vertex at the vertex: no edge leads from it towards p, and so
/// no triangle does, whose cone its edges span.
GAMBESON_HD inline bool SurfaceView::vertexIsMinimum(int v, const Vec3& p) const {
  const Vec3 r = p - x[v];
  const double r2 = norm2(r);
  for (int i = vertex_begin[v]; i < vertex_begin[v + 1]; ++i) {
    const int e = vertex_edges[i];
    const int from = edges[e].v, to = edges[e].w;
    const Vec3 d = x[to] - x[from];
    const int sure = surely(dot(r, d), norm2(d), r2), away = from == v ? 1 : -1;
    if (sure == away || (sure == 0 && away * dot(r, edgeOf(e).direction) > tolerance_m)) return false;
  }
  return true;
}

template <class Add>
GAMBESON_HD bool SurfaceView::faceFeet(int t, const Vec3& p, double radius, Add&& add) const {
  const auto& c = triangles[t];
  const Vec3 r[3] = {p - x[c[0]], p - x[c[1]], p - x[c[2]]}, n = areaNormal(t);
  if (norm2(n) == 0 && collapsed(t)) return false;
  if (!surelyWithin(dot(r[0], n), norm2(n), norm2(r[0]), radius) && std::abs(dot(r[0], unitOrZero(n))) > radius)
    return false;
  Side side[3];
  for (int k = 0; k < 3; ++k) side[k] = sideOf(r[k], x[c[(k + 1) % 3]] - x[c[k]], n);
  if (norm2(n) > 0 && side[0] != Side::out && side[1] != Side::out && side[2] != Side::out) {
    const Vec3 normal = unitOrZero(n);
    const double h = dot(r[0], normal);
    add(MeshPoint{p - h * normal, normal, h, t});
  }
  // This face alone often tells that it has a closer point than its edge or corner: the foot of p on the edge's line is
  // surely before its start, or past its end, or the edge leads from the corner towards p.
  const auto pastStart = [&](int k) {
    const Vec3 e = x[c[(k + 1) % 3]] - x[c[k]];
    return surely(dot(r[k], e), norm2(e), norm2(r[k]));
  };
  const auto beforeEnd = [&](int k) {
    const Vec3 e = x[c[(k + 1) % 3]] - x[c[k]];
    return surely(norm2(e) - dot(r[k], e), norm2(e), norm2(r[k]) + norm2(e));
  };
  for (int k = 0; k < 3; ++k) {
    const int edge = face_edges[t][k];
    const int next = side[k] == Side::out ? 1 : 0;  // this face is the first of the edges that it owns
    Vec3 foot;
    if ((owns[t].edges >> k & 1) && side[k] != Side::in && pastStart(k) >= 0 && beforeEnd(k) >= 0 &&
        edgeIsMinimum(edge, p, next, foot) && norm2(p - foot) <= radius * radius)
      add(signedFoot(p, foot, edgeFeature(edge)));
    if ((owns[t].vertices >> k & 1) && norm2(r[k]) <= radius * radius && pastStart(k) <= 0 &&
        beforeEnd((k + 2) % 3) <= 0 && vertexIsMinimum(c[k], p))
      add(signedFoot(p, x[c[k]], vertexFeature(c[k])));
  }
  return true;
}

GAMBESON_HD inline int SurfaceView::chooseAmong(MeshPoint* feet, int count) const {
  int nearest = 0;
  for (int k = 1; k < count; ++k)
    if (std::abs(feet[k].distance_m) < std::abs(feet[nearest].distance_m)) nearest = k;
  const double zero = 100 * tolerance_m;  // a point this deep is on the surface
  if (feet[nearest].distance_m < -zero) {
    const MeshPoint only = feet[nearest];
    feet[0] = only;
    return 1;
  }
  // Feet that neighbouring features share within the tolerance are one contact; minima on the far side are not seen.
  const double same2 = zero * zero;
  int kept = 0;
  for (int i = 0; i < count; ++i) {
    if (feet[i].distance_m < -zero) continue;
    const bool is_face = feet[i].feature < face_count;
    bool twin = false;
    for (int k = 0; k < kept && !twin; ++k)
      twin = norm2(feet[k].position - feet[i].position) <= same2 &&
             (!is_face || dot(feet[k].normal, feet[i].normal) > 1 - 1e-9);
    if (twin) continue;
    const MeshPoint keep = feet[i];
    feet[kept++] = keep;
  }
  return kept;
}

}  // namespace gambeson
