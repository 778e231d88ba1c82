#pragma once
/// Whether two primitives of cloth touch, decided a pair at a time. Detail of cloth_contacts.hpp, which states the law,
/// for host and device.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/contact/box.hpp"
#include "core/contact/contact_mesh_view.hpp"
#include "core/contact/reach.hpp"
#include "core/contact/segment_pair.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {

/// Of the samples of cloth, which are the mesh's first vertices.
struct ClothView {
  int cloth_vertices = 0;
  const Vec3* rest = nullptr;
  const int* garment = nullptr;
  const double* thickness_m = nullptr;
};

/// Where two primitives of cloth touch.
struct ClothTouch {
  int sample = 0, feature = 0;  ///< of a sample, and what it touches; or two edges
  int partner = -1;             ///< two samples that lie on each other are one contact: the other one
  int count = 0;                ///< samples of the stencil
  Vec3 normal;                  ///< to the sample, or to edge `sample`
  double gap_m = 0;
  double layer_m = 0;  ///< half the sum of the thicknesses
  int stencil[4] = {};
  double weight[4] = {};

  GAMBESON_HD void add(int vertex, double w) {
    stencil[count] = vertex;
    weight[count++] = w;
  }
};

class ClothPairs {
 public:
  /// Positions at the start of the step, and where the vertices would go.
  GAMBESON_HD ClothPairs(const ContactMeshView& mesh, const ClothView& facts, const Vec3* x0, const Vec3* x1)
      : mesh_(mesh), facts_(facts), x_(x0), end_(x1) {}

  /// Surely no contact, whatever the positions: a foot anywhere on the triangle is a neighbour of the sample at rest.
  GAMBESON_HD bool neighboursAtRest(int v, int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    if (v >= facts_.cloth_vertices || facts_.garment[v] != facts_.garment[a]) return false;
    const double* h = facts_.thickness_m;
    const double layer = 0.5 * (h[v] + std::min(std::min(h[a], h[b]), h[c]));
    return allNear(neighbourDistance(layer), {rest(a, v), rest(b, v), rest(c, v)});
  }
  /// The same of two edges, where the neighbours are points of both.
  GAMBESON_HD bool neighbourEdgesAtRest(int ea, int eb) const {
    const auto& [a, b] = mesh_.edges[ea];
    const auto& [c, d] = mesh_.edges[eb];
    if (facts_.garment[a] != facts_.garment[c]) return false;
    const double* h = facts_.thickness_m;
    const double near = neighbourDistance(0.5 * (std::min(h[a], h[b]) + std::min(h[c], h[d])));
    return allNear(near, {rest(a, c), rest(a, d), rest(b, c)}) && norm2(rest(b, d)) < kSurely * near * near;
  }

  GAMBESON_HD bool sampleOn(int v, int t, ClothTouch& p) const {
    if (v >= facts_.cloth_vertices || mesh_.triangles[t][0] >= facts_.cloth_vertices) return false;
    const std::array<Vec3, 3> corner = corners(t);
    const auto& [a, b, c] = mesh_.triangles[t];
    const double* h = facts_.thickness_m;
    const double far = contactReach(0.5 * (h[v] + std::max(std::max(h[a], h[b]), h[c]))) + path(v) +
                       std::max(std::max(path(a), path(b)), path(c));
    if (boxDistance2(
            {minimum(minimum(corner[0], corner[1]), corner[2]), maximum(maximum(corner[0], corner[1]), corner[2])},
            x_[v]) >= far * far)
      return false;
    const TrianglePoint foot = closestOnTriangle(corner, x_[v]);
    if (!(foot.dist2_m2 < far * far)) return false;
    const int partner = partnerAt(v, t, foot);
    if (partner == kPassed) return false;
    if (partner < 0 && foot.feature != kFace && (!nearestAround(v, t, foot) || besideBorder(v, t, foot))) return false;
    const Vec3 w = barycentric(corner, foot.position);
    const double layer = 0.5 * (h[v] + w.x * h[a] + w.y * h[b] + w.z * h[c]);
    const Vec3 at_rest = w.x * facts_.rest[a] + w.y * facts_.rest[b] + w.z * facts_.rest[c];
    if (neighbours(v, a, at_rest - facts_.rest[v], layer)) return false;
    p = {};
    p.sample = v;
    p.feature = featureOf(t, foot.feature);
    p.partner = partner;
    p.gap_m = std::sqrt(foot.dist2_m2);
    p.normal = direction(x_[v] - foot.position, cross(corner[1] - corner[0], corner[2] - corner[0]));
    p.layer_m = layer;
    p.add(v, 1);
    for (int k = 0; k < 3; ++k)
      if (w[k] > 0) p.add(mesh_.triangles[t][k], -w[k]);
    return keeps(p);
  }

  GAMBESON_HD bool edgeOn(int ea, int eb, ClothTouch& out) const {
    const auto& [a, b] = mesh_.edges[ea];
    const auto& [c, d] = mesh_.edges[eb];
    if (std::max(b, d) >= facts_.cloth_vertices) return false;
    if (blunt(ea) || blunt(eb)) return false;
    const SegmentPair near = nearestOnSegments(x_[a], x_[b], x_[c], x_[d]);
    constexpr double inside = 1e-6;
    if (!(near.s > inside && near.s < 1 - inside && near.t > inside && near.t < 1 - inside)) return false;
    const Vec3 p = x_[a] + near.s * (x_[b] - x_[a]), q = x_[c] + near.t * (x_[d] - x_[c]);
    const Vec3 way = direction(p - q, cross(x_[b] - x_[a], x_[d] - x_[c]));
    if (!sharp(ea, p, -way) || !sharp(eb, q, way)) return false;
    const double* h = facts_.thickness_m;
    const double most = contactReach(0.5 * (std::max(h[a], h[b]) + std::max(h[c], h[d]))) + std::max(path(a), path(b)) +
                        std::max(path(c), path(d));
    if (!(near.dist2_m2 < most * most)) return false;
    const double layer = 0.5 * ((1 - near.s) * h[a] + near.s * h[b] + (1 - near.t) * h[c] + near.t * h[d]);
    const Vec3* X = facts_.rest;
    const Vec3 at_rest = X[c] + near.t * (X[d] - X[c]) - (X[a] + near.s * (X[b] - X[a]));
    if (neighbours(a, c, at_rest, layer)) return false;
    out = {};
    out.sample = ea;
    out.feature = eb;
    out.gap_m = std::sqrt(near.dist2_m2);
    out.normal = way;
    out.layer_m = layer;
    out.add(a, 1 - near.s);
    out.add(b, near.s);
    out.add(c, near.t - 1);
    out.add(d, -near.t);
    return keeps(out);
  }

  /// The edge's two faces bend away from no direction by as much as sharp() asks for, since they hardly bend: two unit
  /// vectors that both have less than -kSharp in common with a third one are less than 2 acos(kSharp) apart.
  GAMBESON_HD bool blunt(int edge) const {
    constexpr double kFlat = 2 * kSharp * kSharp - 1 - 1e-4;  // cosine; the last part is far more than rounding
    const std::span<const int> faces = mesh_.edge_faces[edge];
    if (faces.size() != 2) return false;
    const auto& [a, b] = mesh_.edges[edge];
    const Vec3 along = x_[b] - x_[a];
    const double length2 = norm2(along);
    Vec3 out[2];
    for (int k = 0; k < 2; ++k) {
      Vec3 corner{};
      for (int c : mesh_.triangles[faces[k]])
        if (c != a && c != b) corner = x_[c];
      out[k] = across(corner, x_[a], along, length2);
    }
    const double common = dot(out[0], out[1]);
    return common < 0 && common * common > kFlat * kFlat * norm2(out[0]) * norm2(out[1]);
  }

 private:
  static constexpr double kSharp = 0.05;        ///< sine of the angle by which the faces of an edge bend away
  static constexpr double kSurely = 1 - 1e-12;  ///< of squared lengths, in spite of rounding
  static constexpr double kNearly = 0.05;       ///< of the gap: so near to a sample is on it
  static constexpr int kPassed = -2;

  GAMBESON_HD double path(int i) const { return norm(end_[i] - x_[i]); }
  GAMBESON_HD Vec3 rest(int i, int from) const { return facts_.rest[i] - facts_.rest[from]; }
  GAMBESON_HD static bool allNear(double near, const std::array<Vec3, 3>& ways) {
    const double most2 = kSurely * near * near;
    return norm2(ways[0]) < most2 && norm2(ways[1]) < most2 && norm2(ways[2]) < most2;
  }
  GAMBESON_HD std::array<Vec3, 3> corners(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {x_[a], x_[b], x_[c]};
  }

  /// Number of a triangle's feature in the mesh: faces, then edges, then vertices.
  GAMBESON_HD int featureOf(int t, int feature) const {
    const int faces = mesh_.triangle_count, edges = mesh_.edge_count;
    if (feature == kFace) return t;
    return feature >= kEdge0 ? faces + mesh_.face_edges[t][feature - kEdge0]
                             : faces + edges + mesh_.triangles[t][feature - kCorner0];
  }

  /// Where the two points come, or are, close enough on their way.
  GAMBESON_HD bool keeps(const ClothTouch& p) const {
    const Vec3 start = p.gap_m * p.normal;
    Vec3 way{};
    for (int k = 0; k < p.count; ++k) way += p.weight[k] * (end_[p.stencil[k]] - x_[p.stencil[k]]);
    return comesWithin(contactReach(p.layer_m), start, way);
  }

  GAMBESON_HD static Vec3 direction(const Vec3& way, const Vec3& otherwise) {
    const double length = norm(way);
    if (length > 1e-12) return way / length;
    const double other = norm(otherwise);
    return other > 0 ? otherwise / other : Vec3{0, 0, 1};
  }

  GAMBESON_HD static Vec3 barycentric(const std::array<Vec3, 3>& corner, const Vec3& p) {
    const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], r = p - corner[0];
    const double uu = norm2(u), uv = dot(u, v), vv = norm2(v), ru = dot(r, u), rv = dot(r, v);
    const double det = uu * vv - uv * uv;
    if (!(det > 0)) return {1, 0, 0};
    const double b = std::clamp((vv * ru - uv * rv) / det, 0.0, 1.0),
                 c = std::clamp((uu * rv - uv * ru) / det, 0.0, 1.0 - b);
    return {1 - b - c, b, c};
  }

  GAMBESON_HD bool neighbours(int v, int w, const Vec3& apart_at_rest, double layer) const {
    return facts_.garment[v] == facts_.garment[w] && norm(apart_at_rest) < neighbourDistance(layer);
  }

  /// No triangle at the foot's edge or corner is nearer, and this one is the first of them.
  GAMBESON_HD bool nearestAround(int v, int t, const TrianglePoint& foot) const {
    const std::span<const int> around = foot.feature >= kEdge0
                                            ? mesh_.edge_faces[mesh_.face_edges[t][foot.feature - kEdge0]]
                                            : mesh_.vertex_faces[mesh_.triangles[t][foot.feature]];
    if (around[0] != t) return false;  // that one answers for the feature
    for (std::size_t k = 1; k < around.size(); ++k)
      if (closestOnTriangle(corners(around[k]), x_[v]).dist2_m2 < foot.dist2_m2 * (1 - 1e-12)) return false;
    return true;
  }
  GAMBESON_HD bool onBorder(int vertex) const {
    for (int e : mesh_.vertex_edges[vertex])
      if (mesh_.border(e)) return true;
    return false;
  }
  /// The foot is on the border of the other cloth, and inside of the sample's own cloth a point beside the sample is
  /// nearer to it: not the sample meets the border, whose own samples lie on the faces there. A border that slides over
  /// cloth would meet each sample with a tilted normal just before it passes, and be lifted and slowed down (two
  /// fabrics at 0.5 m/s: by a tenth of mu m g).
  GAMBESON_HD bool besideBorder(int v, int t, const TrianglePoint& foot) const {
    const bool border = foot.feature >= kEdge0 ? mesh_.border(mesh_.face_edges[t][foot.feature - kEdge0])
                                               : onBorder(mesh_.triangles[t][foot.feature]);
    if (!border || onBorder(v)) return false;
    for (int face : mesh_.vertex_faces[v])
      if (closestOnTriangle(corners(face), foot.position).dist2_m2 < foot.dist2_m2 * (1 - 1e-12)) return true;
    return false;
  }
  /// Of the points of the faces around w the one nearest to v is w, nearly. `face`: the first that has it.
  GAMBESON_HD bool liesOn(int v, int w, int& face) const {
    TrianglePoint nearest;
    nearest.dist2_m2 = std::numeric_limits<double>::infinity();
    for (int t : mesh_.vertex_faces[w])
      if (const TrianglePoint foot = closestOnTriangle(corners(t), x_[v]); foot.dist2_m2 < nearest.dist2_m2) {
        nearest = foot;
        face = t;
      }
    return norm2(nearest.position - x_[w]) <= kNearly * kNearly * nearest.dist2_m2;
  }
  /// The sample that v lies on, and that lies on v, if the foot is there: the two are one contact, that of the first of
  /// them with the first face. -1: none; kPassed: that contact is another pair's.
  GAMBESON_HD int partnerAt(int v, int t, const TrianglePoint& foot) const {
    int under = -1;
    for (int corner : mesh_.triangles[t])
      if (norm2(foot.position - x_[corner]) <= kNearly * kNearly * foot.dist2_m2) under = corner;
    int face = -1, other = -1;
    if (under < 0 || !liesOn(v, under, face) || !liesOn(under, v, other)) return -1;
    return under < v || face != t ? kPassed : under;
  }

  /// What leads from an edge to a corner of a face at it, square to the edge: `from` any point of its line.
  GAMBESON_HD static Vec3 across(const Vec3& corner, const Vec3& from, const Vec3& along, double length2) {
    const Vec3 r = corner - from;
    return r - (dot(r, along) / length2) * along;
  }

  /// The faces at an edge bend away from `way` (unit) at its point p.
  GAMBESON_HD bool sharp(int edge, const Vec3& p, const Vec3& way) const {
    const auto& [a, b] = mesh_.edges[edge];
    const Vec3 along = x_[b] - x_[a];
    const double length2 = norm2(along);
    for (int t : mesh_.edge_faces[edge])
      for (int c : mesh_.triangles[t]) {
        if (c == a || c == b) continue;
        const Vec3 r = across(x_[c], p, along, length2);
        if (!(dot(r, way) < -kSharp * norm(r))) return false;
      }
    return true;
  }

  ContactMeshView mesh_;
  ClothView facts_;
  const Vec3 *x_, *end_;
};

}  // namespace gambeson
