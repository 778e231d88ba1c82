#include "core/dynamics/collisions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <variant>

#include "core/contact/certified_impact.hpp"
#include "core/contact/mesh_topology.hpp"

namespace gambeson {
namespace {

constexpr double kSeparation_m = 1e-6;

double reachOf(const CollisionModel& m) { return std::max(contactReach(m.largest_thickness_m), 2 * kSeparation_m); }

/// What a list allows for: so many steps like the one that it was made for, and not less than this; cloth trembles, so
/// each vertex is given the mean way of all as well.
constexpr double kSteps = 6, kLeastSlack_m = 1e-4, kLeastChange = 0.05;

/// Mean way of the cloth from where it was listed.
Vec3 shift(const CollisionModel& m, const CollisionWork& w, std::span<const Vec3> x) {
  Vec3 sum{};
  for (int i = 0; i < m.cloth.cloth_vertices; ++i) sum += x[i] - w.listed_at[i];
  return sum / m.cloth.cloth_vertices;
}

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// The list was made for these positions.
bool listHolds(const CollisionModel& m, const CollisionWork& w) {
  if (w.listed_at.size() != w.x0.size()) return false;
  const Vec3 shift0 = shift(m, w, w.x0), shift1 = shift(m, w, w.x1);
  for (std::size_t i = 0; i < w.x0.size(); ++i) {
    if (!(largest(w.x0[i] - w.listed_at[i] - shift0) <= w.slack_m[i])) return false;
    if (!(largest(w.x1[i] - w.listed_at[i] - shift1) <= w.slack_m[i])) return false;
  }
  return w.tree.gradientsHold(m.mesh, w.x0, w.change) && w.tree.gradientsHold(m.mesh, w.x1, w.change);
}

/// Sees to it that the list holds all pairs that come within contactReach along each axis between x0 and x1.
void listPairs(const CollisionModel& m, CollisionWork& w) {
  if (listHolds(m, w)) return;
  w.listed_at = w.x0;
  const Vec3 shift1 = shift(m, w, w.x1);
  w.slack_m.resize(w.x0.size());
  double mean = 0;
  for (std::size_t i = 0; i < w.x0.size(); ++i) {
    w.slack_m[i] = kSteps * largest(w.x1[i] - w.x0[i] - shift1);
    mean += w.slack_m[i] / static_cast<double>(w.x0.size());
  }
  for (double& slack : w.slack_m) slack = std::max(slack, mean) + kLeastSlack_m;
  w.tree.gradientChanges(m.mesh, w.x0, w.x1, w.change);
  for (double& c : w.change) c = std::max(kSteps * c, kLeastChange);
  w.tree.refit(m.mesh, w.listed_at, w.slack_m, w.change);
  m.collector.collect(m.mesh, w.tree, w.listed_at, w.slack_m, reachOf(m), m.least, w.pairs);
  if (!m.self) {
    std::erase_if(w.pairs.points, [&](const PointTriangle& p) {
      return m.body_of_vertex[p.vertex] < 0 && m.body_of_vertex[m.mesh.triangles[p.triangle][0]] < 0;
    });
    std::erase_if(w.pairs.edges, [&](const EdgeEdge& p) {
      return m.body_of_vertex[m.mesh.edges[p.a][0]] < 0 && m.body_of_vertex[m.mesh.edges[p.b][0]] < 0;
    });
  }
  ++w.report.builds;
}

/// The row that keeps a pair apart: weights at the hit, normal there, from side b to side a as they stood at the start.
ContactRow rowOf(const CollisionModel& m, const PairHit& hit, const FourPoints& x0, const FourPoints& x1,
                 const std::array<int, 4>& vertex, const ImpactTime& at, double dt) {
  const double u = at.u, v = at.v;
  const std::array<double, 4> weight =
      hit.edges ? std::array<double, 4>{1 - u, u, v - 1, -v} : std::array<double, 4>{1, u + v - 1, -u, -v};
  std::array<Vec3, 4> x;
  Vec3 start{};
  for (int k = 0; k < 4; ++k) {
    x[k] = x0[k] + at.time * (x1[k] - x0[k]);
    start += weight[k] * x0[k];
  }
  Vec3 n = hit.edges ? cross(x[1] - x[0], x[3] - x[2]) : cross(x[2] - x[1], x[3] - x[1]);
  const double size = norm(n), length = norm(start);
  // Parallel edges and triangles without area have no normal; then the way between them at the start.
  const double scale = hit.edges ? norm(x[1] - x[0]) * norm(x[3] - x[2]) : norm(x[2] - x[1]) * norm(x[3] - x[1]);
  n = size > 1e-6 * scale ? n / size : length > 0 ? start / length : Vec3{0, 0, 1};
  if (dot(n, start) < 0) n = -n;
  ContactRow row;
  row.impact = true;
  row.pair = {hit.edges ? 1 : 0, hit.a, hit.b};
  row.contact.normal = n;
  row.contact.gap_m = dot(n, start);
  row.contact.obstacle = hit.edges ? kEdgeOnEdge : kSampleOnCloth;
  row.contact.sample = hit.a;
  row.contact.feature = hit.b;
  Vec3 touched{};
  double body_weight = 0;
  for (int k = 0; k < 4; ++k) {
    const int body = m.body_of_vertex[vertex[k]];
    if (body < 0) {
      if (weight[k] != 0) row.stencil.add(vertex[k], weight[k]);
      continue;
    }
    row.contact.obstacle = m.bodies[body].obstacle;
    row.body_velocity -= (weight[k] / dt) * (x1[k] - x0[k]);
    touched += weight[k] * m.bodies[body].local[vertex[k] - m.bodies[body].first_vertex];
    body_weight += weight[k];
  }
  if (body_weight != 0) {
    row.contact.local = touched / body_weight;
    row.contact.sample = row.stencil.sample[0];
    if (body_weight > 0) {
      // The body is the first side: written from the cloth's.
      for (int k = 0; k < row.stencil.count; ++k) row.stencil.weight[k] = -row.stencil.weight[k];
      row.body_velocity = -row.body_velocity;
      row.contact.normal = -row.contact.normal;
    }
  }
  return row;
}

}  // namespace

CollisionModel buildCollisions(const Surface& surface, std::span<const Vec3> rest, std::vector<int> layer,
                               std::vector<double> thickness_m, std::span<const Obstacle> obstacles,
                               std::span<const Placement> placement, bool self) {
  CollisionModel m;
  m.self = self;
  m.cloth = {surface.size(), {rest.begin(), rest.end()}, std::move(layer), std::move(thickness_m)};
  for (double h : m.cloth.thickness_m) m.largest_thickness_m = std::max(m.largest_thickness_m, h);
  std::vector<std::array<int, 3>> triangles = surface.triangles;
  std::vector<Vec3> x(rest.begin(), rest.end());
  std::vector<TriangleRange> ranges;
  m.body_of_vertex.assign(surface.size(), -1);
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const auto* mesh = std::get_if<TriangleMesh>(&obstacles[o].shape);
    if (!mesh) continue;
    const MeshTopology topology = meshTopology(*mesh);
    const int first = static_cast<int>(x.size()), first_triangle = static_cast<int>(triangles.size());
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      if (topology.collapsed(static_cast<int>(t))) continue;
      const auto& [a, b, c] = topology.triangles[t];
      triangles.push_back({first + a, first + b, first + c});
    }
    ranges.push_back({first_triangle, static_cast<int>(triangles.size())});
    m.body_of_vertex.resize(x.size() + mesh->vertices.size(), static_cast<int>(m.bodies.size()));
    m.bodies.push_back({static_cast<int>(o), first, mesh->vertices});
    for (const Vec3& p : mesh->vertices) x.push_back(placement[o] * p);
  }
  m.mesh = contactMesh(static_cast<int>(x.size()), triangles);
  const SurfaceCharts charts = surfaceCharts(surface, rest);
  // Primitives of a whole cell without a common vertex are at least as far apart at rest as a corner from the diagonal.
  double apart = std::numeric_limits<double>::infinity();
  for (const GridChart& chart : charts.charts)
    for (int cell = 0; cell < chart.triangles.size(); ++cell) {
      if (!chart.whole[cell]) continue;
      Box box;
      for (const Vec2& corner : charts.corners[chart.triangles[cell][0]]) box.add(Vec3{corner.x, corner.y, 0});
      const double a = box.hi.x - box.lo.x, b = box.hi.y - box.lo.y;
      apart = std::min(apart, a * b / std::hypot(a, b));
    }
  m.least = contactReach(m.largest_thickness_m) / std::max(apart, neighbourDistance(m.largest_thickness_m));
  for (int body : m.body_of_vertex) m.is_body.push_back(body >= 0);
  const bool layered =
      std::any_of(m.cloth.layer.begin(), m.cloth.layer.end(), [&](int l) { return l != m.cloth.layer[0]; });
  if (layered || !m.bodies.empty()) {
    m.layer_of_vertex = m.cloth.layer;
    m.layer_of_vertex.resize(x.size(), -1);
  }
  m.tree = ContactTree(m.mesh, charts.charts, charts.corners, ranges, x);
  m.collector = PairCollector(m.mesh);
  return m;
}

int findTangles(const CollisionModel& m, bool search, double dt, CollisionWork& w, std::vector<ContactRow>& restoring) {
  restoring.clear();
  w.tangle.assign(m.mesh.vertex_count, Tangle::kFree);
  if (!search || (!m.self && m.bodies.empty())) return 0;
  const std::vector<Untangling> found = untangle(m.mesh, w.x0, m.layer_of_vertex, m.is_body, m.untangling);
  w.tangle = tangledVertices(m.mesh, found);
  for (const Untangling& u : found)
    for (const RestoringRow& r : restoringRows(m.mesh, u)) {
      ContactRow row;
      row.contact.obstacle = kRestoring;
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
        row.contact.local += std::abs(r.weight[k]) * m.bodies[body].local[v - m.bodies[body].first_vertex];
      }
      if (row.stencil.count == 0) continue;
      row.contact.sample = row.stencil.sample[0];
      restoring.push_back(row);
    }
  return static_cast<int>(found.size());
}

void placeVertices(const CollisionModel& m, std::span<const Vec3> x0, std::span<const Vec3> x1,
                   std::span<const Placement> start, std::span<const Placement> end, CollisionWork& w) {
  w.x0.assign(x0.begin(), x0.end());
  w.x1.assign(x1.begin(), x1.end());
  w.x0.resize(m.mesh.vertex_count);
  w.x1.resize(m.mesh.vertex_count);
  for (const CollisionModel::Body& body : m.bodies)
    for (std::size_t k = 0; k < body.local.size(); ++k) {
      w.x0[body.first_vertex + k] = start[body.obstacle] * body.local[k];
      w.x1[body.first_vertex + k] = end[body.obstacle] * body.local[k];
    }
}

void nearCloth(const CollisionModel& m, CollisionWork& w) {
  w.points.clear();
  if (w.tree.empty()) w.tree = m.tree;
  if (!m.self && m.bodies.empty()) return;
  listPairs(m, w);
  if (!m.self) return;
  clothContacts(m.mesh, m.cloth, w.pairs, w.x0, w.x1, w.points);
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
  listPairs(m, w);
  w.path.resize(w.x0.size());
  for (std::size_t v = 0; v < w.x0.size(); ++v) w.path[v] = {minimum(w.x0[v], w.x1[v]), maximum(w.x0[v], w.x1[v])};
  w.edge_path.resize(m.mesh.edges.size());
  for (std::size_t e = 0; e < m.mesh.edges.size(); ++e) {
    w.edge_path[e] = w.path[m.mesh.edges[e][0]];
    w.edge_path[e].add(w.path[m.mesh.edges[e][1]]);
  }
  const auto ask = [&](PairHit hit, const std::array<int, 4>& vertex) {
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
    if (!first(kSeparation_m)) return;
    const double start = hit.edges ? edgeEdgeGap(x0) : pointTriangleGap(x0);
    if (!(start > 0)) {  // no side to stay on
      ++w.report.touching;
      return;
    }
    const auto at = first(std::min(kSeparation_m, 0.1 * start));
    if (!at) return;
    w.report.capped += at->capped;
    hit.time = at->time;
    hit.row = rowOf(m, hit, x0, x1, vertex, *at, dt);
    hits.push_back(hit);
  };
  for (const PointTriangle& p : w.pairs.points) {
    const auto& [a, b, c] = m.mesh.triangles[p.triangle];
    Box triangle = w.edge_path[m.mesh.face_edges[p.triangle][0]];
    triangle.add(w.path[c]);
    if (!overlap(w.path[p.vertex].grown(2 * kSeparation_m), triangle)) continue;
    ask({false, p.vertex, p.triangle, 0, {}}, {p.vertex, a, b, c});
  }
  for (const EdgeEdge& p : w.pairs.edges) {
    if (!overlap(w.edge_path[p.a].grown(2 * kSeparation_m), w.edge_path[p.b])) continue;
    const auto [a, b] = m.mesh.edges[p.a];
    const auto [c, d] = m.mesh.edges[p.b];
    ask({true, p.a, p.b, 0, {}}, {a, b, c, d});
  }
  std::sort(hits.begin(), hits.end(), [](const PairHit& p, const PairHit& q) {
    return std::tie(p.edges, p.a, p.b) < std::tie(q.edges, q.a, q.b);
  });
  w.report.candidates = static_cast<int>(w.pairs.points.size() + w.pairs.edges.size());
}

}  // namespace gambeson
