#include "core/motion/body_edges.hpp"

#include <algorithm>
#include <tuple>

#include "core/contact/sharp.hpp"
#include "core/math/parallel.hpp"
#include "core/motion/body_edge_pair.hpp"

namespace gambeson {
namespace {

/// The samples that take part.
struct Counts {
  const Tangle* tangle;
  const char* inside;
  bool operator()(int v) const { return tangle[v] == Tangle::kFree && !inside[v]; }
};

ContactRow rowOf(const CollisionModel& m, std::span<const Vec3> x, const BodyEdgeTouch& touch) {
  ContactRow row;
  row.pair = {touch.pair[0], touch.pair[1], touch.pair[2]};
  row.contact.normal = touch.normal;
  row.contact.gap_m = touch.gap_m;
  row.contact.sample = touch.stencil[0];
  row.contact.kind = ContactKind::edge_on_body;
  row.contact.feature = touch.feature;
  const CollisionModel::Body& of = m.bodies[m.body_of_vertex[touch.body[0]]];
  row.contact.obstacle = of.obstacle;
  for (int k = 0; k < touch.count; ++k) row.stencil.add(touch.stencil[k], touch.weight[k]);
  row.body_velocity = touch.body_velocity;
  for (int k = 0; k < touch.body_count; ++k) {
    const int v = touch.body[k];
    row.contact.local += touch.body_weight[k] * (of.deforms ? x[v] : of.local[v - of.first_vertex]);
    gambeson::touch(m, v, touch.body_weight[k], row.contact);
  }
  return row;
}

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
  std::vector<char> deforms;
  for (const CollisionModel::Body& b : m.bodies) deforms.push_back(b.deforms);
  const BodyEdgePairs<Counts> search(
      {viewOf(m.mesh), m.sharp_edge.data(), m.sharp_corner.data(), m.body_of_vertex.data(), deforms.data(),
       m.cloth.thickness_m.data(), m.largest_thickness_m, dt, w.x0.data(), w.x1.data()},
      {w.tangle.data(), inside.data()});
  appendInOrder(static_cast<int>(w.near.points.size()), Each::sum, rows, [&](int first, int end, auto& list) {
    BodyEdgeTouch found;
    for (int k = first; k < end; ++k)
      if (search.cornerOn(w.near.points[k].vertex, w.near.points[k].triangle, found))
        list.push_back(rowOf(m, w.x0, found));
  });
  appendInOrder(static_cast<int>(w.near.edges.size()), Each::sum, rows, [&](int first, int end, auto& list) {
    BodyEdgeTouch found;
    for (int k = first; k < end; ++k)
      if (search.edgeOn(w.near.edges[k].a, w.near.edges[k].b, found)) list.push_back(rowOf(m, w.x0, found));
  });
  const auto key = [](const ContactRow& r) {
    return std::tuple(r.contact.sample, r.contact.obstacle, r.contact.feature, r.pair);
  };
  std::sort(rows.begin(), rows.end(), [&](const ContactRow& a, const ContactRow& b) { return key(a) < key(b); });
}

}  // namespace gambeson
