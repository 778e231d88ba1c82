#include "core/motion/body_edges.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/contact/segment_pair.hpp"
#include "core/contact/sharp.hpp"
#include "core/contact/triangle.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr double kAway = 1e-3;  ///< of faces from the cloth: else they are nearer than the edge
constexpr double kInside = 1e-6;

class Search {
 public:
  Search(const CollisionModel& m, double dt, std::span<const char> inside, const CollisionWork& w)
      : m_(m), dt_(dt), inside_(inside), w_(w), x_(w.x0) {}

  void cornerOn(const PointTriangle& pair, std::vector<ContactRow>& rows) const {
    const int v = pair.vertex;
    const std::array<int, 3>& t = m_.mesh.triangles[pair.triangle];
    if (!m_.sharp_corner[v] || m_.body_of_vertex[t[0]] >= 0) return;
    if (!counts(t) || !mayReach(std::array{v}, t) || (deforms(v) && !isSharpCorner(m_.mesh, x_, v))) return;
    const std::array<Vec3, 3> corner{x_[t[0]], x_[t[1]], x_[t[2]]};
    const TrianglePoint foot = closestOnTriangle(corner, x_[v]);
    if (foot.feature != kFace) return;
    const Vec3 way = foot.position - x_[v];
    const double gap = norm(way);
    if (!(gap > 0) || !cornerIsNearest(v, way / gap)) return;
    const Vec3 u = corner[1] - corner[0], s = corner[2] - corner[0], r = foot.position - corner[0], n = cross(u, s);
    const double b = dot(cross(r, s), n) / norm2(n), c = dot(cross(u, r), n) / norm2(n);
    add(std::array{t[0], t[1], t[2]}, std::array{1 - b - c, b, c}, std::array{v}, std::array{1.0}, way / gap, gap,
        {0, v, pair.triangle}, v, rows);
  }

  void edgeOn(const EdgeEdge& pair, std::vector<ContactRow>& rows) const {
    const bool a_is_body = m_.body_of_vertex[m_.mesh.edges[pair.a][0]] >= 0;
    const bool b_is_body = m_.body_of_vertex[m_.mesh.edges[pair.b][0]] >= 0;
    if (a_is_body == b_is_body) return;
    const int cloth = a_is_body ? pair.b : pair.a, body = a_is_body ? pair.a : pair.b;
    if (!m_.sharp_edge[body]) return;
    const std::array<int, 2>&c = m_.mesh.edges[cloth], &e = m_.mesh.edges[body];
    if (!counts(c) || !mayReach(e, c) || (deforms(e[0]) && !isSharpEdge(m_.mesh, x_, body))) return;
    const SegmentPair near = nearestOnSegments(x_[c[0]], x_[c[1]], x_[e[0]], x_[e[1]]);
    if (!(std::min({near.s, 1 - near.s, near.t, 1 - near.t}) > kInside)) return;
    const Vec3 at = x_[e[0]] + near.t * (x_[e[1]] - x_[e[0]]);
    const Vec3 way = x_[c[0]] + near.s * (x_[c[1]] - x_[c[0]]) - at;
    const double gap = norm(way);
    if (!(gap > 0) || !edgeIsNearest(body, way / gap)) return;
    add(c, std::array{1 - near.s, near.s}, e, std::array{1 - near.t, near.t}, way / gap, gap, {1, pair.a, pair.b},
        m_.mesh.vertex_count + body, rows);
  }

 private:
  bool deforms(int v) const { return m_.bodies[m_.body_of_vertex[v]].deforms; }

  template <std::size_t N>
  bool counts(const std::array<int, N>& cloth) const {
    return std::all_of(cloth.begin(), cloth.end(), [&](int v) { return w_.tangle[v] == Tangle::kFree && !inside_[v]; });
  }

  template <std::size_t N, std::size_t M>
  bool mayReach(const std::array<int, N>& body, const std::array<int, M>& cloth) const {
    double far = contactReach(m_.largest_thickness_m), body_way = 0, cloth_way = 0;
    Box a, b;
    for (int v : body) a.add(x_[v]), body_way = std::max(body_way, norm(w_.x1[v] - x_[v]));
    for (int v : cloth) b.add(x_[v]), cloth_way = std::max(cloth_way, norm(w_.x1[v] - x_[v]));
    far += body_way + cloth_way;
    return overlap(a.grown(far), b);
  }

  /// The corner is the nearest point of its faces: all edges at it lead away from `way`.
  bool cornerIsNearest(int v, const Vec3& way) const {
    for (int e : m_.mesh.vertex_edges[v])
      if (!(dot(alongFrom(m_.mesh, x_, v, e), way) < -kAway)) return false;
    return true;
  }

  bool edgeIsNearest(int edge, const Vec3& way) const {
    for (int t : m_.mesh.edge_faces[edge])
      if (!(dot(acrossFrom(m_.mesh, x_, edge, t), way) < -kAway)) return false;
    return true;
  }

  template <std::size_t N, std::size_t M>
  void add(const std::array<int, N>& cloth, const std::array<double, N>& weight, const std::array<int, M>& body,
           const std::array<double, M>& body_weight, const Vec3& normal, double gap, const std::array<int, 3>& pair,
           int feature, std::vector<ContactRow>& rows) const {
    ContactRow row;
    row.pair = pair;
    row.contact.normal = normal;
    row.contact.gap_m = gap;
    row.contact.sample = cloth[0];
    row.contact.kind = ContactKind::edge_on_body;
    row.contact.feature = -1 - feature;
    const CollisionModel::Body& of = m_.bodies[m_.body_of_vertex[body[0]]];
    row.contact.obstacle = of.obstacle;
    Vec3 way{};
    double thickness = 0;
    for (std::size_t k = 0; k < N; ++k) {
      row.stencil.add(cloth[k], weight[k]);
      way += weight[k] * (w_.x1[cloth[k]] - x_[cloth[k]]);
      thickness += weight[k] * m_.cloth.thickness_m[cloth[k]];
    }
    for (std::size_t k = 0; k < M; ++k) {
      row.body_velocity += (body_weight[k] / dt_) * (w_.x1[body[k]] - x_[body[k]]);
      row.contact.local += body_weight[k] * (of.deforms ? x_[body[k]] : of.local[body[k] - of.first_vertex]);
      touch(m_, body[k], body_weight[k], row.contact);
    }
    way -= dt_ * row.body_velocity;
    if (comesWithin(contactReach(thickness), gap * normal, way)) rows.push_back(row);
  }

  const CollisionModel& m_;
  double dt_;
  std::span<const char> inside_;
  const CollisionWork& w_;
  std::span<const Vec3> x_;
};

}  // namespace

void markSharp(CollisionModel& m, std::span<const Vec3> x) {
  m.sharp_edge.assign(m.mesh.edges.size(), 0);
  m.sharp_corner.assign(m.mesh.vertex_count, 0);
  const auto rigid = [&](int v) { return !m.bodies[m.body_of_vertex[v]].deforms; };
  for (std::size_t e = 0; e < m.mesh.edges.size(); ++e) {
    const int edge = static_cast<int>(e), v = m.mesh.edges[e][0];
    if (m.body_of_vertex[v] >= 0) m.sharp_edge[e] = !rigid(v) || isSharpEdge(m.mesh, x, edge);
  }
  for (int v = 0; v < m.mesh.vertex_count; ++v)
    if (m.body_of_vertex[v] >= 0) m.sharp_corner[v] = !rigid(v) || isSharpCorner(m.mesh, x, v);
}

void bodyEdgeRows(const CollisionModel& m, double dt, std::span<const char> inside, const CollisionWork& w,
                  std::vector<ContactRow>& rows) {
  rows.clear();
  if (m.bodies.empty()) return;
  const Search search(m, dt, inside, w);
  appendInOrder(static_cast<int>(w.near.points.size()), Each::sum, rows, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k) search.cornerOn(w.near.points[k], list);
  });
  appendInOrder(static_cast<int>(w.near.edges.size()), Each::sum, rows, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k) search.edgeOn(w.near.edges[k], list);
  });
  const auto key = [](const ContactRow& r) {
    return std::tuple(r.contact.sample, r.contact.obstacle, r.contact.feature, r.pair);
  };
  std::sort(rows.begin(), rows.end(), [&](const ContactRow& a, const ContactRow& b) { return key(a) < key(b); });
}

}  // namespace gambeson
