/// Detail of near_search.hpp and skin_bender.hpp: on the host.
#include "gpu/device/reference.hpp"
#include "gpu/near/near_finder.hpp"
#include "gpu/near/skin_on.hpp"

namespace gambeson::gpu {

std::unique_ptr<NearSearch> nearOnReference(const NearModel& model, const NearStep& start, const NearSizes& room) {
  return std::make_unique<NearFinder<Reference>>(model, start, room);
}

std::unique_ptr<SkinBender> skinOnReference(const Skin& skin, int most_times) {
  return std::make_unique<SkinOn<Reference>>(skin, most_times);
}

NearSizes roomForNear(const CollisionModel& m) {
  const unsigned long long samples = static_cast<unsigned long long>(m.cloth.cloth_vertices) + 256;
  NearSizes room;
  room.fill(2 * samples);
  room[kClothPoints] = room[kClothEdges] = 16 * samples;
  room[kBodyPoints] = 8 * samples;
  room[kOnBodies] = room[kContacts] = samples / 4;
  return room;
}

}  // namespace gambeson::gpu
