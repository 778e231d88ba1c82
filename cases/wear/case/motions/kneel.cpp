/// Detail of kind.hpp: taking aim on one knee.

#include "human/motion/kneel.hpp"
#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object kneelTable() {
  using K = KneelOptions;
  return Table<K>("Kneeling")
      .number("stand", &K::stand_s, "s", between(0, 60), "time at low ready before it")
      .number("duration", &K::duration_s, "s", between(0.2, 60), "from low ready down onto the right knee")
      .number("hold", &K::hold_s, "s", between(0, 60), "time aiming")
      .number("rise", &K::rise_s, "s", between(0, 60), "back to low ready, at least 0.2 s; 0: stays down")
      .check([](const Entry& p, const K& k) {
        if (k.rise_s > 0 && k.rise_s < 0.2) p.failAt("rise", "must be 0 or at least 0.2 s");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind kneel_motion;
const MotionKind kneel_motion{
    .word = "kneel",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<KneelOptions>("kneel", std::identity{}, schema::kneelTable(),
                                          "goes down on the right knee, aims, and gets up again");
        },
    .ours = false,
    .make = [](const HumanCase& moved,
               const Human& human) { return MadeMotion{makeKneel(human, std::get<KneelOptions>(moved.motion))}; },
    .assumption = [](const Motion&) -> std::string {
      return "Kneeling is prescribed: the posture at its end is built from written descriptions of the position, "
             "pelvis, trunk and arms get there with minimum jerk, knees and hips such that the feet stand and the "
             "right knee comes to lie on the ground. There is no rifle.";
    },
};

}  // namespace gambeson
