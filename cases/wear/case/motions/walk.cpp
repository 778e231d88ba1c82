/// Detail of kind.hpp: walking at natural speed.

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/motion/walk_curves.hpp"

namespace gambeson {
namespace schema {
namespace {

Object walkTable() {
  using W = WalkOptions;
  return Table<W>("Walking")
      .number("stand", &W::stand_s, "s", between(0, 60), "time at rest before the first step")
      .number("lead_in", &W::lead_in_s, "s", between(0.1, 10), "smooth start from standing into the stride")
      .integer("strides", &W::strides, 1, 100, "full strides (two steps each) after the lead-in")
      .integer("paces", &W::paces, 0, 200, "single steps after the lead-in, in place of strides; 0: strides count")
      .number("stride_time", &W::stride_time_s, "s", between(0.5, 3), "time of one stride")
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind walk_motion;
const MotionKind walk_motion{
    .word = "walk",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<WalkOptions>("walk", std::identity{}, schema::walkTable(), "walks at natural speed");
        },
    .task = Task::natural_walk,
    .make =
        [](const HumanCase& moved, const Human& human) {
          const auto& o = std::get<WalkOptions>(moved.motion);
          MadeMotion made;
          made.motion = makeWalk(human, o, &made.mean_velocity_m_per_s);
          made.air_ramp_s = o.stand_s + o.lead_in_s;
          return made;
        },
    .strides = [](const MotionKind::Options& options) -> std::optional<Strides> {
      const auto& o = std::get<WalkOptions>(options);
      const int count = static_cast<int>(o.strideCount());
      return Strides{o.stand_s + o.lead_in_s, o.stride_time_s, count, (o.strideCount() - count) * o.stride_time_s,
                     0.5 + naturalWalk().double_support};
    },
    .assumption = [](const Motion&) -> std::string {
      return "Walking is prescribed: joint angles of healthy adults at natural speed (Bovi et al. 2011), closed to a "
             "period and equal on both sides. "
             "The wearer does not change gait because of the garment.";
    },
};

}  // namespace gambeson
