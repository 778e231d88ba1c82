/// Detail of impact_step.hpp: on the host.
#include "gpu/device/reference.hpp"
#include "gpu/step/impact_step_on.hpp"

namespace gambeson::gpu {

ImpactSizes roomForImpacts(const CollisionModel& m) {
  const unsigned long long vertices = static_cast<unsigned long long>(m.mesh.vertex_count) + 1024;
  ImpactSizes room;
  room[kPointPairs] = 8 * vertices, room[kPointOpen] = vertices;
  room[kEdgePairs] = 16 * vertices, room[kEdgeOpen] = 2 * vertices;
  room[kPointHard] = room[kEdgeHard] = room[kPointMet] = room[kEdgeMet] = room[kStepHits] = vertices / 4;
  return room;
}

std::unique_ptr<ImpactStep> impactStepOnReference(const Model& model, std::span<const Vec3> start,
                                                  const ImpactSizes& room) {
  return std::make_unique<ImpactStepOn<Reference>>(model, start, room);
}

}  // namespace gambeson::gpu
