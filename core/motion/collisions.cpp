#include "core/motion/collisions.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

#include "core/contact/certified_impact.hpp"
#include "core/contact/mesh_topology.hpp"
#include "core/math/parallel.hpp"
#include "core/motion/body_edges.hpp"
#include "core/motion/impact_side.hpp"

namespace gambeson {
namespace {

constexpr double kSeparation_m = kImpactSeparation_m,
                 kBeyond_m = 2 * kSeparation_m;  ///< what is beyond that does not meet

/// What samples of cloth may keep from a body, whatever their thickness.
constexpr double kBodyReach_m = contactReach(kLargestClearance_m);

PairRules rulesOf(const CollisionModel& m) {
  const double body = m.bodies.empty() ? 0 : kBodyReach_m;
  return {std::max({contactReach(m.largest_thickness_m), body, 2 * kSeparation_m}), m.least, m.self, 2 * kSeparation_m,
          body};
}

/// Within which two primitives have contacts, of their half reaches (CollisionModel).
double reachOf(float a, float b) {
  return a < 0 || b < 0 ? std::max(2.0 * std::max(a, b), kBodyReach_m) : static_cast<double>(a) + b;
}

/// Of each primitive, the largest half reach of its vertices.
template <class Primitives>
std::vector<float> largestHalfReaches(const Primitives& primitives, std::span<const float> half_reach_m) {
  std::vector<float> out;
  for (const auto& vertices : primitives) {
    float most = -1;
    for (int v : vertices) most = std::max(most, half_reach_m[v]);
    out.push_back(most);
  }
  return out;
}

/// Samples are carried by the faces of bodies, and cloth by what is sharp; all else meets only in impacts.
BluntFeatures bluntFeatures(const CollisionModel& m) {
  BluntFeatures out{std::vector<char>(m.mesh.vertex_count, 0), std::vector<char>(m.mesh.edges.size(), 0)};
  for (int v = 0; v < m.mesh.vertex_count; ++v) out.vertex[v] = m.body_of_vertex[v] >= 0 && !m.sharp_corner[v];
  for (std::size_t e = 0; e < m.mesh.edges.size(); ++e)
    out.edge[e] = m.body_of_vertex[m.mesh.edges[e][0]] >= 0 && !m.sharp_edge[e];
  return out;
}

/// A vertex of a body in its frame; of one that deforms, in the world at the start.
Vec3 onBody(const CollisionModel& m, const CollisionWork& w, int vertex) {
  const CollisionModel::Body& body = m.bodies[m.body_of_vertex[vertex]];
  return body.deforms ? w.x0[vertex] : body.local[vertex - body.first_vertex];
}

/// The row that keeps a pair apart (impact_row.hpp).
ContactRow rowOf(const CollisionModel& m, const CollisionWork& w, const ImpactPair& pair, double dt) {
  const auto bodyOf = [&](int v, BodyVertex& out) {
    if (m.body_of_vertex[v] < 0) return false;
    const CollisionModel::Body& body = m.bodies[m.body_of_vertex[v]];
    out = {body.obstacle, v - body.first_vertex, body.deforms, onBody(m, w, v)};
    return true;
  };
  const ImpactRow found = impactRow(pair, dt, bodyOf);
  ContactRow row;
  row.impact = true;
  row.pair = {pair.edges ? 1 : 0, pair.a, pair.b};
  row.body_velocity = found.body_velocity;
  Contact& contact = row.contact;
  contact.normal = found.normal;
  contact.gap_m = found.gap_m;
  contact.obstacle = found.obstacle;
  contact.kind = found.kind;
  contact.sample = found.sample;
  contact.feature = found.feature;
  contact.local = found.local;
  for (int k = 0; k < found.count; ++k) row.stencil.add(found.stencil[k], found.weight[k]);
  for (int k = 0; k < found.touched_count; ++k) contact.touched.add(found.touched[k], found.touched_weight[k]);
  return row;
}

}  // namespace

CollisionModel buildCollisions(const Surface& surface, std::span<const Vec3> rest, std::vector<int> garment,
                               std::vector<double> thickness_m, std::span<const Obstacle> obstacles,
                               std::span<const Placement> placement, bool self) {
  CollisionModel m;
  m.self = self;
  m.cloth = {surface.size(), {rest.begin(), rest.end()}, std::move(garment), std::move(thickness_m)};
  for (double h : m.cloth.thickness_m) m.largest_thickness_m = std::max(m.largest_thickness_m, h);
  std::vector<std::array<int, 3>> triangles = surface.triangles;
  std::vector<Vec3> x(rest.begin(), rest.end());
  std::vector<TriangleRange> ranges;
  m.cloth_triangles = static_cast<int>(triangles.size());
  m.body_of_vertex.assign(surface.size(), -1);
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const auto* mesh = std::get_if<TriangleMesh>(&obstacles[o].shape);
    m.body_of_obstacle.push_back(mesh ? static_cast<int>(m.bodies.size()) : -1);
    if (!mesh) continue;
    const MeshTopology topology = meshTopology(*mesh);
    const int first = static_cast<int>(x.size()), first_triangle = static_cast<int>(triangles.size());
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      if (topology.collapsed(static_cast<int>(t))) continue;
      const auto& [a, b, c] = topology.triangles[t];
      triangles.push_back({first + a, first + b, first + c});
      m.body_triangle.push_back(static_cast<int>(t));
    }
    ranges.push_back({first_triangle, static_cast<int>(triangles.size())});
    m.body_of_vertex.resize(x.size() + mesh->vertices.size(), static_cast<int>(m.bodies.size()));
    m.bodies.push_back({static_cast<int>(o), first, mesh->vertices, obstacles[o].deforms});
    m.deforms = m.deforms || obstacles[o].deforms;
    for (const Vec3& p : mesh->vertices) x.push_back(placement[o] * p);
  }
  m.mesh = contactMesh(static_cast<int>(x.size()), triangles, surface.twins);
  markSharp(m, x);
  const SurfaceCharts charts = surfaceCharts(surface, rest);
  for (int body : m.body_of_vertex) m.is_body.push_back(body >= 0);
  for (const Obstacle& o : obstacles) m.is_mesh.push_back(std::holds_alternative<TriangleMesh>(o.shape));
  const bool several =
      std::any_of(m.cloth.garment.begin(), m.cloth.garment.end(), [&](int l) { return l != m.cloth.garment[0]; });
  if (several || !m.bodies.empty()) {
    m.garment_of_vertex = m.cloth.garment;
    m.garment_of_vertex.resize(x.size(), -1);
  }
  m.tree = ContactTree(m.mesh, charts.charts, charts.corners, ranges, x);
  m.least =
      contactReach(m.largest_thickness_m) / std::max(m.tree.apartAtRest(), neighbourDistance(m.largest_thickness_m));
  m.vertex_half_reach_m.assign(m.mesh.vertex_count, -1);
  for (std::size_t v = 0; v < m.cloth.thickness_m.size(); ++v)
    m.vertex_half_reach_m[v] = roundUp(0.5 * contactReach(m.cloth.thickness_m[v]));
  m.edge_half_reach_m = largestHalfReaches(m.mesh.edges, m.vertex_half_reach_m);
  m.triangle_half_reach_m = largestHalfReaches(m.mesh.triangles, m.vertex_half_reach_m);
  m.tree.setHalfReaches(m.vertex_half_reach_m);
  m.collector = PairCollector(m.mesh, bluntFeatures(m));
  std::vector<char> deforms;
  for (int body : m.body_of_vertex) deforms.push_back(body >= 0 && m.bodies[body].deforms);
  m.bluntness = Bluntness(m.mesh, deforms);
  return m;
}

bool mayTangle(const CollisionModel& m) { return m.self || !m.bodies.empty(); }

std::vector<Contour> findTangles(const CollisionModel& m, const CollisionWork& w) {
  return traceContours(m.mesh, w.x0, findCrossings(m.mesh, w.x0, m.is_body));
}

void freeTangles(const CollisionModel& m, std::vector<Contour> contours, double dt, CollisionWork& w,
                 std::vector<ContactRow>& restoring) {
  restoring.clear();
  w.tangle.assign(m.mesh.vertex_count, Tangle::kFree);
  if (contours.empty()) return;
  const std::vector<Untangling> found =
      untangleContours(m.mesh, w.x0, std::move(contours), m.garment_of_vertex, m.untangling);
  w.tangle = tangledVertices(m.mesh, found);
  for (const Untangling& u : found)
    for (const RestoringRow& r : restoringRows(m.mesh, u)) {
      ContactRow row;
      row.contact.obstacle = -1;
      row.contact.kind = ContactKind::restoring;
      row.contact.sample = -1;
      row.contact.normal = r.direction;
      row.target_m_per_s = r.speed_mps;
      row.impact = true;
      row.slippery = true;
      for (int k = 0; k < 5; ++k) {
        const int v = r.vertex[k], body = m.body_of_vertex[v];
        if (body < 0) {
          if (r.weight[k] != 0) row.stencil.add(v, r.weight[k]);
          continue;
        }
        row.contact.obstacle = m.bodies[body].obstacle;
        row.body_velocity -= (r.weight[k] / dt) * (w.x1[v] - w.x0[v]);
        row.contact.local += std::abs(r.weight[k]) * onBody(m, w, v);
        touch(m, v, std::abs(r.weight[k]), row.contact);
      }
      if (row.stencil.count == 0) continue;
      row.contact.sample = row.stencil.sample[0];
      restoring.push_back(row);
    }
}

void touch(const CollisionModel& m, int vertex, double weight, Contact& contact) {
  const CollisionModel::Body& body = m.bodies[m.body_of_vertex[vertex]];
  if (body.deforms && weight != 0) contact.touched.add(vertex - body.first_vertex, weight);
}

namespace {

/// Positions that agree to this are the same but for rounding.
constexpr double kSame_m = 1e-12;

bool same(std::span<const Vec3> x, std::span<const Vec3> y) {
  return countOf(Each::value, static_cast<int>(x.size()),
                 [&](int i) { return !(norm2(x[i] - y[i]) < kSame_m * kSame_m); }) == 0;
}

/// Which samples are known to be outside of bodies that deform, at the start of the next step. A sample stays on its
/// side where it stays apart from all triangles all the way: the list knows of all that come near, at the paths it was
/// told last, and impacts with these were looked for on the same paths, but for tangled samples.
void keepOutside(const CollisionModel& m, double time_s, std::span<const Vec3> x0, const ObstacleMotion& obstacles,
                 CollisionWork& w) {
  std::vector<char>& known = w.near_bodies.outside_of;
  if (known.empty()) return;
  const auto isAt = [&](double time, std::span<const Vec3> x) {
    if (!(std::abs(time - time_s) <= 1e-12) || !same(x0, x.first(x0.size()))) return false;
    return std::all_of(m.bodies.begin(), m.bodies.end(), [&](const CollisionModel::Body& b) {
      return !b.deforms || same(obstacles.start_vertices[b.obstacle], x.subspan(b.first_vertex, b.local.size()));
    });
  };
  if (w.x0.size() == static_cast<std::size_t>(m.mesh.vertex_count)) {
    if (isAt(w.start_s, w.x0)) return;
    if (isAt(w.end_s, w.x1)) {
      if (std::all_of(w.tangle.begin(), w.tangle.end(), [](Tangle t) { return t == Tangle::kFree; })) return;
      for (const PointTriangle& p : w.list.pairs().points) {
        if (p.triangle < m.cloth_triangles || w.list.apart(m.mesh, p) > 0 || w.tangle[p.vertex] == Tangle::kFree)
          continue;
        const CollisionModel::Body& body = m.bodies[m.body_of_vertex[m.mesh.triangles[p.triangle][0]]];
        known[static_cast<std::size_t>(body.obstacle) * m.cloth.cloth_vertices + p.vertex] = 0;
      }
      return;
    }
  }
  std::fill(known.begin(), known.end(), 0);
}

void copyAll(std::span<const Vec3> from, std::span<Vec3> to) {
  forAll(Each::value, static_cast<int>(from.size()), [&](int i) { to[i] = from[i]; });
}

}  // namespace

void placeVertices(const CollisionModel& m, double time_s, double dt, std::span<const Vec3> x0,
                   const ObstacleMotion& obstacles, CollisionWork& w) {
  keepOutside(m, time_s, x0, obstacles, w);
  w.start_s = time_s;
  w.end_s = time_s + dt;
  w.x0.resize(m.mesh.vertex_count);
  copyAll(x0, w.x0);
  w.x1.resize(m.mesh.vertex_count);
  for (const CollisionModel::Body& body : m.bodies) {
    if (body.deforms) {
      copyAll(obstacles.start_vertices[body.obstacle], std::span(w.x0).subspan(body.first_vertex));
      copyAll(obstacles.end_vertices[body.obstacle], std::span(w.x1).subspan(body.first_vertex));
      continue;
    }
    const int count = static_cast<int>(body.local.size());
    forAll(Each::value, count, [&](int k) {
      w.x0[body.first_vertex + k] = obstacles.start[body.obstacle] * body.local[k];
      w.x1[body.first_vertex + k] = obstacles.end[body.obstacle] * body.local[k];
    });
  }
  if (w.list.empty()) w.list = CandidateList(m.tree, m.bluntness);
  w.list.begin(time_s, time_s + dt, w.x0);
}

Vec3 wayOfBody(const CollisionModel& m, const ObstacleMotion& obstacles, const Contact& c) {
  const int body = m.body_of_obstacle[c.obstacle];
  if (body >= 0 && m.bodies[body].deforms)
    return c.touched.of(obstacles.end_vertices[c.obstacle]) - c.touched.of(obstacles.start_vertices[c.obstacle]);
  return obstacles.end[c.obstacle] * c.local - obstacles.start[c.obstacle] * c.local;
}

void moveVertices(std::span<const Vec3> x1, CollisionWork& w) { copyAll(x1, w.x1); }

namespace {

/// Of w.near_points those of cloth: w.near.points.
void keepCloth(const CollisionModel& m, CollisionWork& w) {
  for (const PointTriangle& p : w.near_points)
    if (p.triangle < m.cloth_triangles) w.near.points.push_back(p);
}

/// Those of bodies: w.near_bodies.
void keepBodies(const CollisionModel& m, CollisionWork& w) {
  for (const PointTriangle& p : w.near_points) {
    if (p.triangle < m.cloth_triangles) continue;
    const int body = m.body_of_vertex[m.mesh.triangles[p.triangle][0]];
    ++w.near_bodies.first[p.vertex + 1];
    w.near_bodies.items.push_back({m.bodies[body].obstacle, m.body_triangle[p.triangle - m.cloth_triangles]});
  }
  for (int v = 0; v < m.cloth.cloth_vertices; ++v) w.near_bodies.first[v + 1] += w.near_bodies.first[v];
}

}  // namespace

void listNear(const CollisionModel& m, CollisionWork& w) {
  w.near.points.clear();
  w.near.edges.clear();
  w.near_bodies.first.assign(m.cloth.cloth_vertices + 1, 0);
  w.near_bodies.items.clear();
  if (!m.self && m.bodies.empty()) return;
  w.list.cover(m.mesh, m.collector, rulesOf(m), w.x1);
  const std::span<const PointTriangle> points = w.list.pairs().points;
  const std::span<const EdgeEdge> edges = w.list.pairs().edges;
  w.near_points.clear();
  appendInOrder(static_cast<int>(points.size()), Each::value, w.near_points, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k)
      if (w.list.mayCome(m.mesh, points[k],
                         reachOf(m.vertex_half_reach_m[points[k].vertex], m.triangle_half_reach_m[points[k].triangle])))
        list.push_back(points[k]);
  });
  forAllUneven(Each::much, 2, [&](int of) { of == 0 ? keepCloth(m, w) : keepBodies(m, w); });
  appendInOrder(static_cast<int>(edges.size()), Each::value, w.near.edges, [&](int first, int end, auto& list) {
    for (int k = first; k < end; ++k)
      if (w.list.mayCome(m.mesh, edges[k], reachOf(m.edge_half_reach_m[edges[k].a], m.edge_half_reach_m[edges[k].b])))
        list.push_back(edges[k]);
  });
}

void dropUnreached(const CollisionModel& m, const ObstacleMotion& obstacles, const CollisionWork& w,
                   std::vector<Contact>& near) {
  const int n = static_cast<int>(near.size());
  std::vector<char> reached(near.size(), 1);
  forAll(Each::sum, n, [&](int k) {
    const Contact& c = near[k];
    if (!(c.gap_m > 0)) return;
    const Vec3 from = c.gap_m * c.normal;
    const Vec3 way = w.x1[c.sample] - w.x0[c.sample] - wayOfBody(m, obstacles, c);
    reached[k] = comesWithin(contactReach(std::max(m.cloth.thickness_m[c.sample], c.clearance_m)), from, way);
  });
  std::size_t kept = 0;
  for (int k = 0; k < n; ++k)
    if (reached[k]) near[kept++] = near[k];
  near.resize(kept);
}

void nearCloth(const CollisionModel& m, CollisionWork& w) {
  w.points.clear();
  if (!m.self) return;
  clothContacts(m.mesh, m.cloth, w.near, w.x0, w.x1, w.points);
  std::erase_if(w.points, [&](const ClothContactPoint& p) {
    for (int k = 0; k < p.stencil.count; ++k)
      if (w.tangle[p.stencil.sample[k]] != Tangle::kFree) return true;
    return false;
  });
}

void findImpacts(const CollisionModel& m, double dt, std::span<const char> exempt, CollisionWork& w,
                 std::vector<PairHit>& hits) {
  hits.clear();
  if (!m.self && m.bodies.empty()) return;
  w.list.cover(m.mesh, m.collector, rulesOf(m), w.x1);
  const auto path = [&](int v) { return Box{minimum(w.x0[v], w.x1[v]), maximum(w.x0[v], w.x1[v])}; };
  const auto edgePath = [&](int e) {
    Box box = path(m.mesh.edges[e][0]);
    box.add(path(m.mesh.edges[e][1]));
    return box;
  };
  const ImpactSurfaces surfaces{viewOf(m.mesh), m.cloth.cloth_vertices, w.x0.data(), w.x1.data()};
  std::atomic<int> touching = 0, capped = 0;
  const auto ask = [&](PairHit hit, const std::array<int, 4>& vertex, std::vector<PairHit>& found) {
    bool cloth_inside = false, body = false;
    for (int v : vertex) {
      if (m.body_of_vertex[v] >= 0)
        body = true;
      else
        cloth_inside = cloth_inside || exempt[v];
      if (m.body_of_vertex[v] < 0 && w.tangle[v] != Tangle::kFree) return;
    }
    if (body && cloth_inside) return;
    FourPoints x0, x1;
    for (int k = 0; k < 4; ++k) {
      x0[k] = w.x0[vertex[k]];
      x1[k] = w.x1[vertex[k]];
    }
    const auto first = [&](double separation) {
      return hit.edges ? edgeEdgeImpact(x0, x1, separation) : pointTriangleImpact(x0, x1, separation);
    };
    auto at = first(kSeparation_m);
    if (!at) return;
    const double start = hit.edges ? edgeEdgeGap(x0) : pointTriangleGap(x0);
    if (!(start > 0)) {  // no side to stay on
      ++touching;
      return;
    }
    if (const double separation = separationFrom(start); separation < kSeparation_m) at = first(separation);
    if (!at) return;
    capped += at->capped;
    const ImpactPair pair{hit.edges, hit.a, hit.b, vertex, x0, x1, at->time, at->u, at->v};
    if (comesFromInside(pair, surfaces)) return;
    hit.time = at->time;
    hit.row = rowOf(m, w, pair, dt);
    found.push_back(hit);
  };
  const std::span<const PointTriangle> points = w.list.pairs().points;
  const std::span<const EdgeEdge> edges = w.list.pairs().edges;
  appendInOrder(static_cast<int>(points.size()), Each::value, hits,
                [&](int first, int end, std::vector<PairHit>& found) {
                  for (int k = first; k < end; ++k) {
                    const PointTriangle& p = points[k];
                    if (!w.list.mayCome(m.mesh, p, kBeyond_m)) continue;
                    const auto& [a, b, c] = m.mesh.triangles[p.triangle];
                    Box triangle = path(a);
                    triangle.add(path(b));
                    triangle.add(path(c));
                    if (!overlap(path(p.vertex).grown(2 * kSeparation_m), triangle)) continue;
                    ask({false, p.vertex, p.triangle, 0, {}}, {p.vertex, a, b, c}, found);
                  }
                });
  appendInOrder(
      static_cast<int>(edges.size()), Each::value, hits, [&](int first, int end, std::vector<PairHit>& found) {
        for (int k = first; k < end; ++k) {
          const EdgeEdge& p = edges[k];
          if (!w.list.mayCome(m.mesh, p, kBeyond_m) || !overlap(edgePath(p.a).grown(2 * kSeparation_m), edgePath(p.b)))
            continue;
          const auto [a, b] = m.mesh.edges[p.a];
          const auto [c, d] = m.mesh.edges[p.b];
          ask({true, p.a, p.b, 0, {}}, {a, b, c, d}, found);
        }
      });
  w.report.touching += touching;
  w.report.capped += capped;
  std::sort(hits.begin(), hits.end(), [](const PairHit& p, const PairHit& q) {
    return std::tie(p.edges, p.a, p.b) < std::tie(q.edges, q.a, q.b);
  });
  w.report.candidates = static_cast<int>(w.list.pairs().points.size() + w.list.pairs().edges.size());
}

}  // namespace gambeson
