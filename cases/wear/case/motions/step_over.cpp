/// Detail of kind.hpp: stepping over an obstacle.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/motion/step_over.hpp"

namespace gambeson {
namespace schema {
namespace {

Object stepOverTable() {
  using S = StepOverOptions;
  return Table<S>("Stepping over an obstacle")
      .number("stand", &S::stand_s, "s", between(0, 60), "time at rest before the first step")
      .integer("before", &S::before, 1, 20, "full strides (two steps each) up to the obstacle")
      .integer("after", &S::after, 1, 20,
               "full strides after the one that leads over it; the last step puts the feet side by side")
      .number("height", &S::height_m, "m", between(0.05, 1),
              "of the obstacle; legs of our men and of tall women clear 0.5 m, those of small women 0.44 m")
      .number("depth", &S::depth_m, "m", between(0, 0.1), "of the obstacle, along the way")
      .number("clearance", &S::clearance_m, "m", between(0, 0.1), "of the feet from the obstacle, at least")
      .number("stride_time", &S::stride_time_s, "s", between(0.5, 3),
              "time of a stride on the level; the one over the obstacle takes 2.2 times as long")
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind step_over_motion;
const MotionKind step_over_motion{
    .word = "step_over",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<StepOverOptions>("step_over", std::identity{}, schema::stepOverTable(),
                                             "walks up to an obstacle, steps over it and walks on");
        },
    .ours = false,
    .make =
        [](const HumanCase& moved, const Human& human) {
          const auto& o = std::get<StepOverOptions>(moved.motion);
          MadeMotion made;
          Hurdle& hurdle = made.hurdle.emplace();
          made.motion = makeStepOver(human, o, &hurdle);
          const Motion& m = *made.motion;
          const Vec3 way = m.at(m.duration()).root.origin - m.at(0).root.origin;
          made.mean_velocity_m_per_s = Vec3{way.x, way.y, 0} / (m.duration() - o.stand_s);
          made.air_ramp_s = o.stand_s + o.stride_time_s;
          made.notes.push_back(fmt::format(
              "motion step_over: the obstacle stands from x = {:.3f} to {:.3f} m and is {:.2f} m high; cloth "
              "touches it where obstacles of the case have it (hurdle)",
              hurdle.front_m, hurdle.front_m + hurdle.depth_m, hurdle.height_m));
          return made;
        },
    .assumption = [](const Motion&) -> std::string {
      return "Walking over the obstacle is prescribed: feet and pelvis go smooth ways, the joints of the legs follow, "
             "arms are those of natural walking (Bovi et al. 2011). Nobody was recorded. The wearer does not change "
             "gait because of the garment.";
    },
};

}  // namespace gambeson
