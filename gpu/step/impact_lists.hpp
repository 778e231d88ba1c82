#pragma once
/// What a search for the impacts of a step counts and finds, by itself: without a device.

#include <array>
#include <vector>

#include "core/motion/collisions.hpp"
#include "gpu/near/contact.hpp"
#include "gpu/step/step_rows.hpp"

namespace gambeson::gpu {

/// Lists of a pass; what has no room is counted and left out.
enum ImpactList {
  kPointPairs,  ///< vertices and triangles whose boxes meet, not both of bodies
  kPointOpen,   ///< of these, what boxes and coplanarity leave
  kPointHard,   ///< what the first look leaves
  kPointMet,    ///< come within the separation of all pairs
  kEdgePairs,   ///< likewise edges
  kEdgeOpen,
  kEdgeHard,
  kEdgeMet,
  kStepHits,  ///< of all sorts
  kImpactLists
};
using ImpactSizes = std::array<unsigned long long, kImpactLists>;
/// Ample for usual cloth of that size.
ImpactSizes roomForImpacts(const CollisionModel& model);

/// Of a pass.
struct ImpactCounts {
  unsigned long long samples = 0;  ///< that enter ellipsoids
  unsigned long long points = 0, edges = 0;
  unsigned long long touching = 0;  ///< pairs without a gap at the start: nothing tells which side is right
  unsigned long long capped = 0;    ///< queries that reached their cap

  unsigned long long all() const { return samples + points + edges; }
  bool operator==(const ImpactCounts&) const = default;
};

/// In the order in which core adds them.
enum StepHitKind : int { kSampleHit, kPointHit, kEdgeHit };

/// A sample that enters an ellipsoid (`second`: the obstacle's number), or a pair that would come closer than its
/// separation: a vertex and a triangle, or two edges.
struct StepHit {
  int kind, first, second;
  double time;  ///< in [0, 1], a lower bound
  double u, v;  ///< of a pair (ImpactTime)
  bool operator==(const StepHit&) const = default;
};

GAMBESON_HD inline bool comesBefore(const StepHit& a, int kind, int first, int second) {
  return a.kind != kind ? a.kind < kind : a.first != first ? a.first < first : a.second < second;
}

/// What rows of impacts need to know of a step.
struct ImpactRowTerms {
  double dt_s = 0;
  double restored = 0;  ///< 1 - exp(-dt/tau), the part of its layer that a row asks for
  int round = 1;        ///< of solves, from 1 on
};

/// Rows as a host has them (StepRows).
struct HostRows {
  std::vector<ContactFacts> facts;
  std::vector<ContactStencil> stencil;
  std::vector<BodyTouch> touch;
  std::vector<RowTerms> terms;
  std::vector<Vec3> traction, impulse;

  std::size_t size() const { return facts.size(); }
};

}  // namespace gambeson::gpu
