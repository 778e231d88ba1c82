/// Detail of kind.hpp: standing still.

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace schema {
namespace {

Object standTable() {
  return Table<StandMotion>("Standing")
      .number("duration", &StandMotion::duration_s, "s", aboveTo(0, 600), "how long")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

class Standing : public Motion {
 public:
  Standing(Posture p, double d) : posture_(std::move(p)), duration_(d) {}
  double duration() const override { return duration_; }
  Posture at(double) const override { return posture_; }

 private:
  Posture posture_;
  double duration_;
};

}  // namespace

extern const MotionKind stand_motion;
const MotionKind stand_motion{
    .word = "stand",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<StandMotion>("stand", std::identity{}, schema::standTable(), "stands still");
        },
    .make =
        [](const HumanCase& moved, const Human& human) {
          return MadeMotion{
              std::make_unique<Standing>(standing(human), std::get<StandMotion>(moved.motion).duration_s)};
        },
    .duration = [](const MotionKind::Options& options) { return std::get<StandMotion>(options).duration_s; },
};

}  // namespace gambeson
