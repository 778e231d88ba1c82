#include "core/motion/capacity.hpp"

namespace gambeson {
namespace {

// For each sample.
constexpr int kNear = 2, kClothPoints = 8, kEdges = 1, kRestoring = 1, kHits = 1;
constexpr int kListedPoints = 32, kListedEdges = 96;

}  // namespace

StepCapacity capacityOf(const Model& m) {
  StepCapacity c;
  c.points = m.freeCount();
  c.held = static_cast<int>(m.held_points.size());
  c.springs = static_cast<int>(m.springs.size());
  c.samples = m.surface.size();
  c.vertices = m.collisions.mesh.vertex_count;
  const bool touches = m.collisions.self || !m.obstacles.empty();
  if (!touches) return c;
  if (!m.obstacles.empty()) c.near = kNear * c.samples;
  c.hits = kHits * c.samples;
  if (!mayTangle(m.collisions)) return c;  // ellipsoids alone
  c.edges = kEdges * c.samples;
  c.restoring = kRestoring * c.samples;
  if (m.collisions.self) c.cloth_points = kClothPoints * c.samples;
  c.listed_points = kListedPoints * c.samples;
  c.listed_edges = kListedEdges * c.samples;
  return c;
}

void reserve(const StepCapacity& c, StepWork& w) {
  const auto points = static_cast<std::size_t>(c.points), samples = static_cast<std::size_t>(c.samples),
             rows = static_cast<std::size_t>(c.rows());
  for (std::vector<Vec3>* v : {&w.predictor, &w.velocity, &w.impact_zone_change, &w.lasting, &w.unsolved})
    v->reserve(points);
  for (std::vector<Vec3>* v : {&w.x0, &w.x1, &w.sample_velocity, &w.sample_impulse, &w.sample_pressing})
    v->reserve(samples);
  w.reach.reserve(samples);
  w.inside.reserve(samples);
  w.near.reserve(static_cast<std::size_t>(c.near));
  w.collisions.points.reserve(static_cast<std::size_t>(c.cloth_points));
  w.edge_rows.reserve(static_cast<std::size_t>(c.edges));
  w.restoring.reserve(static_cast<std::size_t>(c.restoring));
  w.hits.reserve(static_cast<std::size_t>(c.hits));
  w.pair_hits.reserve(static_cast<std::size_t>(c.hits));
  w.rows.reserve(rows);
  w.warm.reserve(rows);
  w.slip.reserve(rows);
  w.impulses.reserve(rows);
  w.contact_impulses.reserve(static_cast<std::size_t>(c.near + c.edges + c.points));
  w.spring_impulses.reserve(static_cast<std::size_t>(c.springs));
  w.held_impulses.reserve(static_cast<std::size_t>(c.held));
}

bool fits(const StepCapacity& c, const StepWork& w) {
  const auto within = [](const auto& array, int room) { return std::ssize(array) <= room; };
  return within(w.near, c.near) && within(w.collisions.points, c.cloth_points) && within(w.edge_rows, c.edges) &&
         within(w.restoring, c.restoring) && within(w.hits, c.hits) && within(w.pair_hits, c.hits) &&
         within(w.rows, c.rows()) && within(w.collisions.list.pairs().points, c.listed_points) &&
         within(w.collisions.list.pairs().edges, c.listed_edges);
}

}  // namespace gambeson
