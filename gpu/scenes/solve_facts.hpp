#pragma once
/// What a contact solve ends with, in numbers: equal on every device.

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/scenes/contact_problem.hpp"
#include "gpu/solve/contact_sweeps.hpp"

namespace gambeson::gpu {

struct SweepFacts {
  int rows = 0, islands = 0;
  int iterations = 0;      ///< of the island that takes most
  std::uint64_t hash = 0;  ///< of tractions, velocities and the islands' states, in their order
  bool operator==(const SweepFacts&) const = default;
};
SweepFacts factsOf(const ContactWork& work);

/// Iterates from the problem's start to its goal, at most `most` times, on a device or (null) by core.
ContactWork solved(const ContactProblem& problem, int most, ContactSweeps* device);

/// Problems whose facts are kept in gpu/manifest.json: seconds on a host.
std::vector<ContactProblem> manifestProblems();
constexpr int kManifestIterations = 150;

}  // namespace gambeson::gpu
