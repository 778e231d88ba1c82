#include "core/contact/cloth_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/contact/segment_pair.hpp"
#include "core/contact/triangle.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr double kSharp = 0.05;  ///< sine of the angle by which the faces of an edge bend away

class Search {
 public:
  Search(const ContactMesh& mesh, const ClothFacts& facts, std::span<const Vec3> x0, std::span<const Vec3> x1)
      : mesh_(mesh), facts_(facts), x_(x0), end_(x1) {}

  std::array<Vec3, 3> corners(int t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return {x_[a], x_[b], x_[c]};
  }

  /// Number of a triangle's feature in the mesh: faces, then edges, then vertices.
  int featureOf(int t, int feature) const {
    const int faces = static_cast<int>(mesh_.triangles.size()), edges = static_cast<int>(mesh_.edges.size());
    if (feature == kFace) return t;
    return feature >= kEdge0 ? faces + mesh_.face_edges[t][feature - kEdge0]
                             : faces + edges + mesh_.triangles[t][feature - kCorner0];
  }

  void sampleOn(const PointTriangle& pair, std::vector<ClothContactPoint>& out) const {
    const int v = pair.vertex, t = pair.triangle;
    if (v >= facts_.cloth_vertices || mesh_.triangles[t][0] >= facts_.cloth_vertices) return;
    const std::array<Vec3, 3> corner = corners(t);
    const auto& [a, b, c] = mesh_.triangles[t];
    const auto path = [&](int i) { return norm(end_[i] - x_[i]); };
    const auto& h = facts_.thickness_m;
    const double far =
        contactReach(0.5 * (h[v] + std::max({h[a], h[b], h[c]}))) + path(v) + std::max({path(a), path(b), path(c)});
    if (boxDistance2(
            {minimum(minimum(corner[0], corner[1]), corner[2]), maximum(maximum(corner[0], corner[1]), corner[2])},
            x_[v]) >= far * far)
      return;
    const TrianglePoint foot = closestOnTriangle(corner, x_[v]);
    if (!(foot.dist2_m2 < far * far)) return;
    if (foot.feature != kFace && (!nearestAround(v, t, foot) || besideBorder(v, t, foot))) return;
    const Vec3 w = barycentric(corner, foot.position);
    const double layer = 0.5 * (h[v] + w.x * h[a] + w.y * h[b] + w.z * h[c]);
    const Vec3 rest = w.x * facts_.rest[a] + w.y * facts_.rest[b] + w.z * facts_.rest[c];
    if (neighbours(v, a, rest - facts_.rest[v], layer)) return;
    ClothContactPoint p;
    p.contact.sample = v;
    p.contact.obstacle = -1;
    p.contact.kind = ContactKind::sample_on_cloth;
    p.contact.feature = featureOf(t, foot.feature);
    p.contact.gap_m = std::sqrt(foot.dist2_m2);
    p.contact.normal = direction(x_[v] - foot.position, cross(corner[1] - corner[0], corner[2] - corner[0]));
    p.layer_m = layer;
    p.stencil.add(v, 1);
    for (int k = 0; k < 3; ++k)
      if (w[k] > 0) p.stencil.add(mesh_.triangles[t][k], -w[k]);
    keep(p, out);
  }

  void edgeOn(const EdgeEdge& pair, std::vector<ClothContactPoint>& out) const {
    const auto [a, b] = mesh_.edges[pair.a];
    const auto [c, d] = mesh_.edges[pair.b];
    if (std::max(b, d) >= facts_.cloth_vertices) return;
    if (blunt(pair.a) || blunt(pair.b)) return;
    const SegmentPair near = nearestOnSegments(x_[a], x_[b], x_[c], x_[d]);
    constexpr double inside = 1e-6;
    if (!(near.s > inside && near.s < 1 - inside && near.t > inside && near.t < 1 - inside)) return;
    const Vec3 p = x_[a] + near.s * (x_[b] - x_[a]), q = x_[c] + near.t * (x_[d] - x_[c]);
    const Vec3 way = direction(p - q, cross(x_[b] - x_[a], x_[d] - x_[c]));
    if (!sharp(pair.a, p, -way) || !sharp(pair.b, q, way)) return;
    const auto& h = facts_.thickness_m;
    const auto path = [&](int i) { return norm(end_[i] - x_[i]); };
    const double most = contactReach(0.5 * (std::max(h[a], h[b]) + std::max(h[c], h[d]))) + std::max(path(a), path(b)) +
                        std::max(path(c), path(d));
    if (!(near.dist2_m2 < most * most)) return;
    const double layer = 0.5 * ((1 - near.s) * h[a] + near.s * h[b] + (1 - near.t) * h[c] + near.t * h[d]);
    const auto& X = facts_.rest;
    const Vec3 rest = X[c] + near.t * (X[d] - X[c]) - (X[a] + near.s * (X[b] - X[a]));
    if (neighbours(a, c, rest, layer)) return;
    ClothContactPoint out_point;
    out_point.contact.sample = pair.a;
    out_point.contact.obstacle = -1;
    out_point.contact.kind = ContactKind::edge_on_edge;
    out_point.contact.feature = pair.b;
    out_point.contact.gap_m = std::sqrt(near.dist2_m2);
    out_point.contact.normal = way;
    out_point.layer_m = layer;
    out_point.stencil.add(a, 1 - near.s);
    out_point.stencil.add(b, near.s);
    out_point.stencil.add(c, near.t - 1);
    out_point.stencil.add(d, -near.t);
    keep(out_point, out);
  }

 private:
  /// Where the two points come, or are, close enough on their way.
  void keep(const ClothContactPoint& p, std::vector<ClothContactPoint>& out) const {
    const Vec3 start = p.contact.gap_m * p.contact.normal;
    Vec3 way{};
    for (int k = 0; k < p.stencil.count; ++k)
      way += p.stencil.weight[k] * (end_[p.stencil.sample[k]] - x_[p.stencil.sample[k]]);
    if (comesWithin(contactReach(p.layer_m), start, way)) out.push_back(p);
  }

  static Vec3 direction(const Vec3& way, const Vec3& otherwise) {
    const double length = norm(way);
    if (length > 1e-12) return way / length;
    const double other = norm(otherwise);
    return other > 0 ? otherwise / other : Vec3{0, 0, 1};
  }

  static Vec3 barycentric(const std::array<Vec3, 3>& corner, const Vec3& p) {
    const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], r = p - corner[0];
    const double uu = norm2(u), uv = dot(u, v), vv = norm2(v), ru = dot(r, u), rv = dot(r, v);
    const double det = uu * vv - uv * uv;
    if (!(det > 0)) return {1, 0, 0};
    const double b = std::clamp((vv * ru - uv * rv) / det, 0.0, 1.0),
                 c = std::clamp((uu * rv - uv * ru) / det, 0.0, 1.0 - b);
    return {1 - b - c, b, c};
  }

  bool neighbours(int v, int w, const Vec3& apart_at_rest, double layer) const {
    return facts_.garment[v] == facts_.garment[w] && norm(apart_at_rest) < neighbourDistance(layer);
  }

  /// No triangle at the foot's edge or corner is nearer, and this one is the first of them.
  bool nearestAround(int v, int t, const TrianglePoint& foot) const {
    const std::span<const int> around = foot.feature >= kEdge0
                                            ? mesh_.edge_faces[mesh_.face_edges[t][foot.feature - kEdge0]]
                                            : mesh_.vertex_faces[mesh_.triangles[t][foot.feature]];
    if (around.front() != t) return false;  // that one answers for the feature
    return std::none_of(around.begin() + 1, around.end(), [&](int other) {
      return closestOnTriangle(corners(other), x_[v]).dist2_m2 < foot.dist2_m2 * (1 - 1e-12);
    });
  }
  bool onBorder(int vertex) const {
    const std::span<const int> edges = mesh_.vertex_edges[vertex];
    return std::any_of(edges.begin(), edges.end(), [&](int e) { return mesh_.border(e); });
  }
  /// The foot is on the border of the other cloth, and inside of the sample's own cloth a point beside the sample is
  /// nearer to it: not the sample meets the border, whose own samples lie on the faces there. A border that slides over
  /// cloth would meet each sample with a tilted normal just before it passes, and be lifted and slowed down (two
  /// fabrics at 0.5 m/s: by a tenth of mu m g).
  bool besideBorder(int v, int t, const TrianglePoint& foot) const {
    const bool border = foot.feature >= kEdge0 ? mesh_.border(mesh_.face_edges[t][foot.feature - kEdge0])
                                               : onBorder(mesh_.triangles[t][foot.feature]);
    if (!border || onBorder(v)) return false;
    const std::span<const int> own = mesh_.vertex_faces[v];
    return std::any_of(own.begin(), own.end(), [&](int face) {
      return closestOnTriangle(corners(face), foot.position).dist2_m2 < foot.dist2_m2 * (1 - 1e-12);
    });
  }

  /// What leads from an edge to a corner of a face at it, square to the edge: `from` any point of its line.
  static Vec3 across(const Vec3& corner, const Vec3& from, const Vec3& along, double length2) {
    const Vec3 r = corner - from;
    return r - (dot(r, along) / length2) * along;
  }

  /// The edge's two faces bend away from no direction by as much as sharp() asks for, since they hardly bend: two unit
  /// vectors that both have less than -kSharp in common with a third one are less than 2 acos(kSharp) apart.
  bool blunt(int edge) const {
    constexpr double kFlat = 2 * kSharp * kSharp - 1 - 1e-4;  // cosine; the last part is far more than rounding
    const std::span<const int> faces = mesh_.edge_faces[edge];
    if (faces.size() != 2) return false;
    const auto [a, b] = mesh_.edges[edge];
    const Vec3 along = x_[b] - x_[a];
    const double length2 = norm2(along);
    const auto acrossFace = [&](int t) {
      Vec3 corner{};
      for (int c : mesh_.triangles[t])
        if (c != a && c != b) corner = x_[c];
      return across(corner, x_[a], along, length2);
    };
    const Vec3 one = acrossFace(faces[0]), two = acrossFace(faces[1]);
    const double common = dot(one, two);
    return common < 0 && common * common > kFlat * kFlat * norm2(one) * norm2(two);
  }

  /// The faces at an edge bend away from `way` (unit) at its point p.
  bool sharp(int edge, const Vec3& p, const Vec3& way) const {
    const auto [a, b] = mesh_.edges[edge];
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

  const ContactMesh& mesh_;
  const ClothFacts& facts_;
  std::span<const Vec3> x_, end_;
};

/// The sample that the foot of a sample lies on, or nearly: within a twentieth of the gap. -1: none.
int sampleUnder(const ClothContactPoint& p, std::span<const Vec3> x) {
  constexpr double kNearly = 0.05;
  int nearest = -1;
  double most = 0;
  Vec3 foot{};
  for (int k = 1; k < p.stencil.count; ++k) {
    foot -= p.stencil.weight[k] * x[p.stencil.sample[k]];
    if (-p.stencil.weight[k] > most) most = -p.stencil.weight[k], nearest = p.stencil.sample[k];
  }
  const double near = kNearly * p.contact.gap_m;
  return nearest >= 0 && norm2(foot - x[nearest]) <= near * near ? nearest : -1;
}

/// Two samples that lie on each other are one contact, that of the first of them. `contacts` of samples come first,
/// sorted.
void joinPartners(std::span<const Vec3> x, std::vector<ClothContactPoint>& contacts) {
  const auto end = std::partition_point(contacts.begin(), contacts.end(), [](const ClothContactPoint& p) {
    return p.contact.kind == ContactKind::sample_on_cloth;
  });
  constexpr int kJoined = -2;
  for (auto p = contacts.begin(); p != end; ++p) {
    const int sample = p->contact.sample, under = p->partner == kJoined ? -1 : sampleUnder(*p, x);
    if (under < 0) continue;
    for (auto again = p + 1; again != end && again->contact.sample == sample; ++again)
      if (sampleUnder(*again, x) == under) again->partner = kJoined;
    if (under < sample) continue;
    const auto firstOf = [&](const ClothContactPoint& c) { return c.contact.sample < under; };
    for (auto other = std::partition_point(p, end, firstOf); other != end && other->contact.sample == under; ++other)
      if (sampleUnder(*other, x) == sample) {
        p->partner = under;
        other->partner = kJoined;
      }
  }
  std::erase_if(contacts, [](const ClothContactPoint& p) { return p.partner == kJoined; });
}

}  // namespace

void clothContacts(const ContactMesh& mesh, const ClothFacts& facts, const CandidatePairs& pairs,
                   std::span<const Vec3> x0, std::span<const Vec3> x1, std::vector<ClothContactPoint>& out) {
  out.clear();
  const Search search(mesh, facts, x0, x1);
  appendInOrder(static_cast<int>(pairs.points.size()), Each::sum, out, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k) search.sampleOn(pairs.points[k], list);
  });
  appendInOrder(static_cast<int>(pairs.edges.size()), Each::sum, out, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k) search.edgeOn(pairs.edges[k], list);
  });
  const auto key = [](const ClothContactPoint& p) {
    return std::tuple(p.contact.kind, p.contact.sample, p.contact.feature);
  };
  std::sort(out.begin(), out.end(),
            [&](const ClothContactPoint& a, const ClothContactPoint& b) { return key(a) < key(b); });
  joinPartners(x0, out);
}

}  // namespace gambeson
