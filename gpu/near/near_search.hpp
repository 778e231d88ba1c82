#pragma once
/// What is near what at the start of a step of a dressed body, on any device: the persistent contacts of cloth with
/// cloth and with bodies, as core finds them (core/contact/cloth_contacts.hpp, proximity.hpp,
/// core/motion/clearance.hpp, body_edges.hpp), to the same bits, without lists that outlast the step.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/bulge.hpp"
#include "core/motion/collisions.hpp"
#include "gpu/near/warm_starts.hpp"

namespace gambeson::gpu {

/// Lists of a pass; what has no room is counted and left out.
enum NearList {
  kClothPoints,  ///< samples and triangles of cloth whose boxes meet
  kClothEdges,   ///< edges and edges of cloth, likewise
  kOpenPoints,   ///< of these, what neighbours at rest are not
  kOpenEdges,    ///< likewise, and no edge is blunt
  kBodyPoints,   ///< samples and triangles of bodies
  kCorners,      ///< sharp corners of bodies and triangles of cloth
  kBodyEdges,    ///< edges of cloth and sharp ones of bodies
  kFeet,         ///< of samples on meshes, all minima
  kOnBodies,     ///< contacts of samples with bodies before what is not reached is dropped
  kContacts,
  kNearLists
};
using NearSizes = std::array<unsigned long long, kNearLists>;

/// Constant, with all that it names: they outlive the search.
struct NearModel {
  const CollisionModel& collisions;
  std::span<const Obstacle> obstacles;
  const Bulges& bulges;
};

/// A step: the cloth's samples at its start, and where they would go without contact.
struct NearStep {
  std::span<const Vec3> x0, x1;
  double dt_s = 0;
  ObstacleMotion obstacles;
};

/// Contacts, sorted.
struct NearContacts {
  std::vector<ContactFacts> facts;
  std::vector<ContactStencil> stencil;
  std::vector<BodyTouch> touch;
};

class NearSearch {
 public:
  virtual ~NearSearch() = default;

  virtual void setStep(const NearStep& step) = 0;
  /// One pass. Where a list runs over, it is repeated with more room. `rebuild`: trees anew, not only refitted.
  virtual void find(bool rebuild) = 0;
  /// Samples are no longer known to be outside of bodies: the next step does not go on from the last one.
  virtual void forget() = 0;

  /// What contacts have left, sorted by key, and the time of the next step over that of the one that left it.
  virtual void setWarm(std::span<const WarmEntry> sorted, double scale) = 0;
  /// What contacts of the last pass have borne, in their order: becomes what is known.
  virtual void keepWarm(std::span<const WarmStart> borne, double scale) = 0;
  virtual std::vector<WarmEntry> warmEntries() = 0;

  /// Of the last pass.
  virtual NearSizes sizes() = 0;
  virtual NearContacts contacts() = 0;
  virtual std::vector<WarmStart> warmStarts() = 0;  ///< of each contact
  virtual int repeats() const = 0;                  ///< of passes, for want of room, since the start

  /// Median of so many passes, without the host between them and nothing waited for.
  virtual double medianMilliseconds(bool rebuild, int passes) = 0;
  struct StageTime {
    std::string name;
    double median_ms;
  };
  virtual std::vector<StageTime> stageTimes(int passes) = 0;
};

/// `x0`: of the samples, where trees start from.
std::unique_ptr<NearSearch> nearOnReference(const NearModel& model, const NearStep& start, const NearSizes& room);
/// groups_per_block: 1 or 4; no matter to what is found.
std::unique_ptr<NearSearch> nearOnCuda(const NearModel& model, const NearStep& start, const NearSizes& room,
                                       int groups_per_block = 4);
/// Ample for usual cloth of that size.
NearSizes roomForNear(const CollisionModel& model);

}  // namespace gambeson::gpu
