#pragma once
/// The impacts of a step with their rows on any device, for whoever has all on the host: tests and checks. What runs on
/// a device from the start uses StepImpacts (step_impacts.hpp).

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/motion/model.hpp"
#include "gpu/finding/impact_search.hpp"
#include "gpu/step/impact_lists.hpp"

namespace gambeson::gpu {

/// Positions of all vertices, as CollisionModel numbers them, and what else a step prescribes.
struct ImpactMotion {
  std::span<const Vec3> x0, x1;
  std::span<const char> exempt;           ///< of each sample: inside of a body
  std::span<const Placement> start, end;  ///< of the obstacles
};

class ImpactStep {
 public:
  virtual ~ImpactStep() = default;

  virtual void setMotion(const ImpactMotion& motion) = 0;
  virtual ImpactCounts find(Trees trees) = 0;
  /// Of the last pass, sorted.
  virtual std::vector<StepHit> hits() = 0;
  virtual const ImpactSizes& sizes() const = 0;
  virtual int repeats() const = 0;  ///< of passes, for want of room, since the start

  /// The rows of the step so far, with room for so many.
  virtual void setRows(const HostRows& rows, unsigned long long room) = 0;
  /// Those of the hits of the last pass join them. Where they have no room it is repeated with more.
  virtual void addRows(const ImpactRowTerms& step) = 0;
  virtual HostRows rows() = 0;
  virtual int rowRepeats() const = 0;

  /// Median of so many passes, without the host between them and nothing waited for.
  virtual double medianMilliseconds(Trees trees, int passes) = 0;
  virtual double medianOfFinds(Trees trees, int passes) = 0;  ///< with the wait for its counts, by the host's clock
  virtual double medianOfRows(const ImpactRowTerms& step, int passes) = 0;
  virtual std::vector<ImpactSearch::StageTime> stageTimes(int passes) = 0;
};

/// The model outlives it. `start`: of all vertices.
std::unique_ptr<ImpactStep> impactStepOnReference(const Model& model, std::span<const Vec3> start,
                                                  const ImpactSizes& room);
/// groups_per_block: 1 or 4; no matter to what is found.
std::unique_ptr<ImpactStep> impactStepOnCuda(const Model& model, std::span<const Vec3> start, const ImpactSizes& room,
                                             int groups_per_block = 4);

}  // namespace gambeson::gpu
