/// Detail of impact_step.hpp: on the host.
#include "gpu/device/reference.hpp"
#include "gpu/step/impact_step_on.hpp"

namespace gambeson::gpu {

ImpactSizes roomForImpacts(const CollisionModel& m) {
  const unsigned long long vertices = static_cast<unsigned long long>(m.mesh.vertex_count) + 1024;
  ImpactSizes room;
  room[kPointPairs] = 12 * vertices, room[kPointOpen] = 2 * vertices;
  room[kEdgePairs] = 24 * vertices, room[kEdgeOpen] = 4 * vertices;
  room[kPointHard] = room[kEdgeHard] = room[kPointMet] = room[kEdgeMet] = room[kStepHits] = vertices;
  return room;
}

std::unique_ptr<ImpactStep> impactStepOnReference(const Model& model, std::span<const Vec3> start,
                                                  const ImpactSizes& room) {
  return std::make_unique<ImpactStepOn<Reference>>(model, start, room);
}

}  // namespace gambeson::gpu
