#pragma once
/// What a pass found, in numbers that do not depend on any order: equal on every device.

#include <string>

#include "gpu/scenes/scene.hpp"

namespace gambeson::gpu {

struct KindFacts {
  ListSizes sizes;
  std::uint64_t pairs_hash = 0, hits_hash = 0;
  bool operator==(const KindFacts&) const = default;
};
using Facts = std::array<KindFacts, kPairKinds>;

/// Of the last pass.
Facts factsOf(ImpactSearch& search);

/// Two lines for people.
std::string print(const Facts& facts);

/// Scenes whose facts are kept in gpu/manifest.json: seconds on a host.
std::vector<Scene> manifestScenes();

/// Room for lists of a scene of this size, ample for cloth and the balls.
BothSizes roomFor(const Mesh& mesh);

}  // namespace gambeson::gpu
