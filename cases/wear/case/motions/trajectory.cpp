/// Detail of kind.hpp: joint angles over time from a file.

#include "human/motion/trajectory.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object trajectoryTable() {
  return Table<TrajectoryMotion>("Trajectory")
      .path("file", &TrajectoryMotion::file, "CSV with a column time_s and one per joint, such as hip_flexion_left_deg")
      .required()
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind trajectory_motion;
const MotionKind trajectory_motion{
    .word = "trajectory",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<TrajectoryMotion>("trajectory", std::identity{}, schema::trajectoryTable(),
                                              "moves its joints as a file says");
        },
    .ours = false,
    .make =
        [](const HumanCase& moved, const Human& human) {
          return MadeMotion{loadTrajectory(std::get<TrajectoryMotion>(moved.motion).file, human)};
        },
    .files = [](MotionKind::Options& options, const MotionKind::Take& take,
                const std::function<void(std::string&)>&) { take(std::get<TrajectoryMotion>(options).file); },
};

}  // namespace gambeson
