#pragma once
/// Rows of the hits of a step, as core adds them (core/motion/step_rows.hpp, addImpacts): sorted; one that stands for
/// the same pair is replaced, others come behind.
///
/// Core looks through all rows for each hit in turn. Hits of a round differ by what they ask for, so that none finds
/// the row of another: all can look at once, a row at a time.

#include "gpu/near/cloth_kernels.hpp"
#include "gpu/near/raise.hpp"
#include "gpu/step/impact_kernels.hpp"

namespace gambeson::gpu {

/// A slot for each sample on ellipsoids, each vertex on triangles, each edge on edges, in the order of hits.
struct StepHitSlots {
  int samples, vertices, edges;

  GAMBESON_HD int count() const { return samples + vertices + edges; }
  GAMBESON_HD int of(const StepHit& h) const {
    return h.kind == kSampleHit ? h.first : h.kind == kPointHit ? samples + h.first : samples + vertices + h.first;
  }
};

struct CountStepHits {
  StepHitSlots slots;
  int *of_slot, *place;
  GAMBESON_HD void operator()(const StepHit& hit, Count i) const { place[i] = fetchAdd(&of_slot[slots.of(hit)], 1); }
};
/// Numbers of hits, those of a slot together.
struct PlaceStepHits {
  StepHitSlots slots;
  const int *begin, *place;
  int* placed;
  GAMBESON_HD void operator()(const StepHit& hit, Count i) const {
    placed[begin[slots.of(hit)] + place[i]] = static_cast<int>(i);
  }
};
struct RankStepHits {
  StepHitSlots slots;
  const int *begin, *of_slot, *placed;
  const StepHit* hits;
  StepHit* sorted;
  GAMBESON_HD void operator()(const StepHit& hit, Count) const {
    const int slot = slots.of(hit), from = begin[slot], end = from + of_slot[slot];
    int at = from;
    for (int k = from; k < end; ++k) at += comesBefore(hits[placed[k]], hit.kind, hit.first, hit.second);
    sorted[at] = hit;
  }
};

/// The first row that each hit replaces: ~row, the largest of them; 0 where there is none.
struct FindReplaced {
  List<StepHit> hits;  ///< sorted
  const ContactStencil* stencil;
  const RowTerms* terms;
  int vertices;  ///< of the mesh
  int round;
  Count* replaces;

  GAMBESON_HD void operator()(const ContactFacts& row, Count i) const {
    int kind = 0, first = 0, second = 0;
    if (!askedFor(row, i, kind, first, second)) return;
    Count from = 0, end = hits.size();
    while (from < end) {
      const Count middle = (from + end) / 2;
      if (comesBefore(hits.items[middle], kind, first, second))
        from = middle + 1;
      else
        end = middle;
    }
    if (from == hits.size()) return;
    const StepHit& hit = hits.items[from];
    if (hit.kind == kind && hit.first == first && hit.second == second) raise(&replaces[from], ~i);
  }

 private:
  /// The hit that would replace the row.
  GAMBESON_HD bool askedFor(const ContactFacts& row, Count i, int& kind, int& first, int& second) const {
    const RowTerms& t = terms[i];
    if (t.pair[0] >= 0) {
      kind = kPointHit + t.pair[0], first = t.pair[1], second = t.pair[2];
      return true;
    }
    if (t.impact == 0 && row.kind == kEdgeOnBody) {
      // Cloth on a sharp part of a body, by its numbers (TouchSharp): a corner and a triangle, or two edges.
      const int part = -1 - row.feature;
      const bool corner = part < vertices;
      kind = corner ? kPointHit : kEdgeHit;
      first = corner ? part : row.pair, second = corner ? row.pair : part - vertices;
      return true;
    }
    kind = kSampleHit, first = row.sample, second = row.obstacle;
    return stencil[i].count == 1 && row.obstacle >= 0 && (t.impact != 0 || round > 2);
  }
};

struct MarkNewRows {
  const Count* replaces;
  int* is_new;
  GAMBESON_HD void operator()(const StepHit&, Count i) const { is_new[i] = replaces[i] == 0; }
};

/// A body of triangles, whatever the step.
struct ImpactBody {
  int obstacle = 0, first_vertex = 0;
  int deforms = 0;
};

/// Of sorted hits.
struct WriteImpactRows {
  ImpactPaths paths;
  int samples, ellipsoids;
  const int *face, *edge;  ///< corners
  const int* body_of_vertex;
  const ImpactBody* body;
  const Vec3* local;          ///< of vertices of bodies, in their frames
  const double* thickness_m;  ///< of each sample
  const int* ellipsoid_of;    ///< of each obstacle
  ImpactRowTerms step;
  const Count* replaces;
  const int* rank;  ///< new ones before
  StepRows rows;

  /// body(v, out) for impactRow.
  GAMBESON_HD bool operator()(int v, BodyVertex& out) const {
    if (v < samples) return false;
    const ImpactBody& b = body[body_of_vertex[v]];
    out = {b.obstacle, v - b.first_vertex, b.deforms != 0, b.deforms ? paths.x0[v] : local[v - samples]};
    return true;
  }

  GAMBESON_HD void operator()(const StepHit& hit, Count i) const {
    ContactFacts facts;
    ContactStencil stencil;
    BodyTouch touch;
    RowTerms terms;
    terms.impact = 1;
    if (hit.kind == kSampleHit)
      ofSample(hit, facts, stencil, touch);
    else
      ofPair(hit, facts, stencil, touch, terms);
    const double layer = clothLayer(stencil, thickness_m);
    facts.layer_m = facts.obstacle >= 0 ? std::max(layer, 0.0) : 0.5 * layer;
    terms.target_m_per_s = impactTarget(facts.gap_m, step.restored * facts.layer_m, step.round, step.dt_s);
    const bool is_new = replaces[i] == 0;
    const Count at = is_new ? rows.size() + static_cast<Count>(rank[i]) : ~replaces[i];
    if (at >= rows.room) return;
    rows.facts[at] = facts;
    rows.stencil[at] = stencil;
    rows.touch[at] = touch;
    rows.terms[at] = terms;
    if (is_new) rows.traction[at] = rows.impulse[at] = {};
  }

 private:
  GAMBESON_HD void ofSample(const StepHit& hit, ContactFacts& facts, ContactStencil& stencil, BodyTouch& touch) const {
    const EllipsoidBody& e = paths.ellipsoid[ellipsoid_of[hit.second]];
    EllipsoidHit at;
    entersEllipsoid(paths, hit.first, e, at);
    facts.normal = at.normal;
    facts.gap_m = at.gap_m;
    facts.body_velocity = (placed(e.end, at.local) - placed(e.start, at.local)) / step.dt_s;
    facts.kind = kSampleOnBody;
    facts.sample = hit.first, facts.obstacle = hit.second;
    stencil.add(hit.first, 1);
    touch.local = at.local;
  }
  GAMBESON_HD void ofPair(const StepHit& hit, ContactFacts& facts, ContactStencil& stencil, BodyTouch& touch,
                          RowTerms& terms) const {
    const bool edges = hit.kind == kEdgeHit;
    ImpactPair pair;
    pair.edges = edges;
    pair.a = hit.first, pair.b = hit.second;
    pair.time = hit.time, pair.u = hit.u, pair.v = hit.v;
    for (int k = 0; k < 4; ++k) {
      const int v = edges    ? edge[k < 2 ? 2 * hit.first + k : 2 * hit.second + k - 2]
                    : k == 0 ? hit.first
                             : face[3 * hit.second + k - 1];
      pair.vertex[k] = v;
      pair.x0[k] = paths.x0[v], pair.x1[k] = paths.x1[v];
    }
    const ImpactRow row = impactRow(pair, step.dt_s, *this);
    facts.normal = row.normal;
    facts.gap_m = row.gap_m;
    facts.body_velocity = row.body_velocity;
    facts.kind = static_cast<int>(row.kind);
    facts.sample = row.sample, facts.obstacle = row.obstacle, facts.feature = row.feature;
    for (int k = 0; k < row.count; ++k) stencil.add(row.stencil[k], row.weight[k]);
    touch.local = row.local;
    for (int k = 0; k < row.touched_count; ++k) {
      touch.vertex[k] = row.touched[k];
      touch.weight[k] = row.touched_weight[k];
    }
    terms.pair[0] = edges ? 1 : 0, terms.pair[1] = hit.first, terms.pair[2] = hit.second;
  }
};

/// How many rows there are then: more than there is room for where some had none.
struct EndImpactRows {
  List<StepHit> hits;
  const int *rank, *is_new;
  StepRows rows;
  GAMBESON_HD void operator()(int) const {
    const Count n = hits.size();
    if (n > 0) *rows.count = rows.size() + static_cast<Count>(rank[n - 1] + is_new[n - 1]);
  }
};

}  // namespace gambeson::gpu
