#pragma once
/// A step on any device, for the control of steps on the host (device_verlet.hpp).

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/motion/step.hpp"

namespace gambeson::gpu {

/// Why a step was left to the CPU. `none`: it was not.
enum class ByCpu { none, tangled, pinched, inside, impacts, unsolved, not_finite, room, kReasons };
const char* inWords(ByCpu reason);

/// A body of the model that deforms, in a step: a skin with the poses of its links at the start, then at the end; or by
/// all of its vertices.
struct BodyShape {
  int obstacle = 0;
  const Skin* skin = nullptr;
  std::vector<Pose> poses;
  std::vector<Vec3> start, end;
};

struct DeviceStepInput {
  double step_s = 0, last_step_s = 0;
  std::span<const Placement> start, end;  ///< of the obstacles
  std::span<const BodyShape> shapes;      ///< of those that deform, in their order
  std::span<const Vec3> anchors;          ///< of the springs at the end of the step, in the world
  Vec3 air;                               ///< at the end [m/s]
};

/// Where the free points of a state are: where the next step starts, where the last one has ended, accepted or not, or
/// not on the device.
enum class StandsAt { start, end, host };

struct StepDone;
/// Arrays of a step on their way to the host.
class StepArrays {
 public:
  virtual ~StepArrays() = default;
  /// Waits for them.
  virtual void unpack(StepDone& done) = 0;
};

/// What a step has left for the host. Arrays of free points where they are no rows'.
struct StepDone {
  ByCpu by_cpu = ByCpu::none;
  ContactSolve contact;
  int contacts = 0, cloth_contacts = 0, impacts = 0, impact_rounds = 0;
  PhaseTimes times;  ///< of its phases
  double smallest_gap_m = std::numeric_limits<double>::max(), largest_way = 0;
  double shown_frequency2 = 0;                        ///< of its motion (ControlledSteps::shownFrequency2)
  double most_jerk_per_s4 = 0;                        ///< swingOfJerk
  bool presses = false;                               ///< any of its contacts lasts
  std::shared_ptr<StepArrays> arrays;                 ///< what follows, where it is not there yet
  std::vector<Vec3> velocity, acceleration, pressed;  ///< at the half step, at the end; State::pressed
  std::vector<Vec3> free_force;                       ///< of the cloth at the end [N], where points are held
  std::vector<ContactRow> rows;                       ///< that carry something
  std::vector<Vec3> tractions, impulses;              ///< of these

  StepDone& leftTo(ByCpu reason) {
    by_cpu = reason;
    return *this;
  }
  void unpack() {
    if (const auto under_way = std::move(arrays)) under_way->unpack(*this);
    arrays = nullptr;
  }
};

class StepOnDevice {
 public:
  virtual ~StepOnDevice() = default;
  /// The state that the next step starts from; nothing is known of it.
  virtual void set(const State& state) = 0;
  /// Makes a step from the state; it is not accepted yet, and may be made again.
  virtual StepDone make(const DeviceStepInput& input) = 0;
  /// The state becomes that at the end of the last step. Nothing where none was made since.
  virtual void accept() = 0;
  /// largestFrequency at a state's points (`p`: where these are not on the device), from `mode`, which becomes that
  /// found. Nothing that a step reads changes.
  virtual Frequency frequency(StandsAt at, std::span<const Vec3> p, std::vector<Vec3>& mode, int iterations) = 0;
  virtual long repeats() const = 0;  ///< of passes, for want of room
  /// Completes a host's copy of the state by what stayed here: warm contacts and history.
  virtual void complete(State& state) = 0;
};

/// `start`: a state, with the stage at its time; `room`: the part of their usual room that lists begin with.
std::unique_ptr<StepOnDevice> stepOnReference(const Model& model, const State& start, const StageWork& stage,
                                              double room);
std::unique_ptr<StepOnDevice> stepOnCuda(const Model& model, const State& start, const StageWork& stage, double room);

}  // namespace gambeson::gpu
