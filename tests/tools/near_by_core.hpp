#pragma once
/// What core finds near in a step, as arrays: the truth for the search on a device.

#include "core/motion/body_edges.hpp"
#include "core/motion/clearance.hpp"
#include "core/motion/step_contact.hpp"
#include "core/motion/step_rows.hpp"
#include "gpu/scenes/dressed.hpp"

namespace gambeson::gpu {

/// Persistent rows of a step as core/motion makes them (resolveContacts), without tangles, which leave a device's loop.
struct CoreStep {
  Model m;
  StepWork w;
  double dt_s;

  CoreStep(const DressedScene& scene, const State& in) : dt_s(scene.dt_s) {
    m.collisions = scene.collisions;
    m.obstacles = scene.obstacles;
    m.bulges = scene.bulges;
    m.layer_m = scene.collisions.cloth.thickness_m;
    m.surface.area_m2.assign(scene.x0.size(), 1);
    m.density_kg_per_m2.assign(scene.x0.size(), 0.3);
    m.contact.relaxation_s = 0.01;
    m.proximity = std::make_unique<ProximityQuery>(m.obstacles);
    w.x0 = scene.x0;
    w.x1 = scene.x1;
    w.stage.start.obstacles = scene.start;
    w.stage.end.obstacles = scene.end;
    w.stage.start.vertices = scene.start_vertices;
    w.stage.end.vertices = scene.end_vertices;
    w.stage.surfaces = DeformedSurfaces(m.obstacles);
    w.stage.surfaces.move(scene.start_vertices, scene.end_vertices);
    const ObstacleMotion motion = {w.stage.start.obstacles, w.stage.end.obstacles, w.stage.start.vertices,
                                   w.stage.end.vertices};
    for (std::size_t s = 0; s < w.x0.size(); ++s)
      w.reach.push_back(contactReach(std::max(m.layer_m[s], kLargestClearance_m)) + norm(w.x1[s] - w.x0[s]));
    placeVertices(m.collisions, 0, dt_s, w.x0, motion, w.collisions);
    moveVertices(w.x1, w.collisions);
    listNear(m.collisions, w.collisions);
    m.proximity->near(w.stage.start.obstacles, w.stage.end.obstacles, w.x0, w.reach, w.near, &w.collisions.near_bodies,
                      &w.stage.surfaces);
    findClearances(m, w);
    dropUnreached(m.collisions, motion, w.collisions, w.near);
    w.inside.assign(w.x0.size(), 0);
    for (const Contact& c : w.near)
      if (!(c.gap_m > 0)) w.inside[c.sample] = 1;
    w.collisions.tangle.assign(m.collisions.mesh.vertex_count, Tangle::kFree);
    nearCloth(m.collisions, w.collisions);
    bodyEdgeRows(m.collisions, dt_s, w.inside, w.collisions, w.edge_rows);
    persistentRows(m, in, dt_s, w);
  }

  /// What contacts of these tractions leave: their mean pressures, and what core keeps for the next step.
  std::vector<WarmStart> bear(const std::vector<Vec3>& tractions, State& out) {
    w.warm = tractions;
    std::vector<WarmStart> borne;
    for (std::size_t k = 0; k < w.rows.size(); ++k) {
      const ContactRow& row = w.rows[k];
      double density = 0;
      for (int i = 0; i < row.stencil.count; ++i)
        if (row.stencil.weight[i] > 0) density += row.stencil.weight[i] * m.density_kg_per_m2[row.stencil.sample[i]];
      const double pressure =
          atLayer(row.contact.gap_m, layerOf(m, row)) ? dot(w.warm[k], row.contact.normal) / dt_s : 0;
      borne.push_back({w.warm[k], lastingPressure(row.mean_Pa, pressure, dt_s, density, m.contact), 0});
    }
    leaveToNext(m, {}, dt_s, {}, w, out);
    return borne;
  }
};

/// Rows of core as arrays.
inline NearContacts contactsOf(const Model& m, std::span<const ContactRow> rows) {
  NearContacts out;
  for (const ContactRow& row : rows) {
    const Contact& c = row.contact;
    ContactFacts f;
    f.normal = c.normal;
    f.gap_m = c.gap_m;
    f.body_velocity = row.body_velocity;
    f.layer_m = layerOf(m, row);
    f.clearance_m = c.clearance_m;
    f.kind = static_cast<int>(c.kind), f.sample = c.sample, f.obstacle = c.obstacle, f.feature = c.feature;
    f.partner = row.partner;
    // The cloth's triangle, which stands behind a corner, or the cloth's edge, which comes before the body's.
    if (c.kind == ContactKind::edge_on_body && !row.impact) f.pair = row.pair[0] == 0 ? row.pair[2] : row.pair[1];
    out.facts.push_back(f);
    ContactStencil stencil;
    for (int k = 0; k < row.stencil.count; ++k) stencil.add(row.stencil.sample[k], row.stencil.weight[k]);
    out.stencil.push_back(stencil);
    BodyTouch touch;
    touch.local = c.local;
    for (int k = 0; k < 3; ++k) touch.vertex[k] = c.touched.vertex[k], touch.weight[k] = c.touched.weight[k];
    out.touch.push_back(touch);
  }
  return out;
}
inline NearContacts nearByCore(const DressedScene& scene) {
  const CoreStep step(scene, {});
  return contactsOf(step.m, step.w.rows);
}

/// Whether a contact is core's to the last bit. Of a sample that is deeper in a body than contacts reach, core's own
/// bits depend on what its lists hold: a triangle on them gives the foot by its plane, else the search for the nearest
/// point does, which rounds otherwise. There numbers agree to rounding.
inline bool sameAsCore(const NearContacts& got, const NearContacts& truth, std::size_t i) {
  const ContactFacts &f = got.facts[i], &g = truth.facts[i];
  if (f.kind == kSampleOnBody && f.gap_m < -contactReach(kLargestClearance_m)) {
    constexpr double kRounding = 1e-12;
    return !comesBefore(f, g) && !comesBefore(g, f) && norm(f.normal - g.normal) < kRounding &&
           std::abs(f.gap_m - g.gap_m) < kRounding * 1e-1 && std::abs(f.clearance_m - g.clearance_m) < kRounding &&
           norm(f.body_velocity - g.body_velocity) < 1e-6 * norm(g.body_velocity) + kRounding &&
           norm(got.touch[i].local - truth.touch[i].local) < kRounding;
  }
  const auto one = [&](const NearContacts& of) {
    return hashOf(NearContacts{{of.facts[i]}, {of.stencil[i]}, {of.touch[i]}});
  };
  return one(got) == one(truth);
}

/// How many contacts differ; all where there are more or fewer.
inline std::size_t differencesToCore(const NearContacts& got, const NearContacts& truth) {
  if (got.facts.size() != truth.facts.size()) return std::max(got.facts.size(), truth.facts.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < got.facts.size(); ++i) different += !sameAsCore(got, truth, i);
  return different;
}

}  // namespace gambeson::gpu
