/// Detail of kind.hpp: climbing stairs.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/motion/walk_curves.hpp"

namespace gambeson {
namespace schema {
namespace {

Object stairsTable() {
  using S = StairOptions;
  return Table<S>("Climbing stairs")
      .number("stand", &S::stand_s, "s", between(0, 60), "time at rest before the first step")
      .number("lead_in", &S::lead_in_s, "s", between(0.2, 2.1),
              "the first step, from standing; 0.4 to 0.7 of stride_time")
      .integer("strides", &S::strides, 1, 100, "full strides (two steps each) after the lead-in")
      .integer("lead_in_strides", &S::lead_in_strides, 0, 99,
               "how many of the strides come before what is measured; fewer than strides")
      .number("stride_time", &S::stride_time_s, "s", between(0.5, 3), "time of one stride")
      .check([](const Entry& p, const S& o) {
        if (!(o.lead_in_s >= 0.4 * o.stride_time_s && o.lead_in_s <= 0.7 * o.stride_time_s))
          p.failAt("lead_in", "must be 0.4 to 0.7 of stride_time");
        if (o.lead_in_strides >= o.strides) p.failAt("lead_in_strides", "must be fewer than strides");
      })
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind stairs_motion;
const MotionKind stairs_motion{
    .word = "stairs",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<StairOptions>("stairs", std::identity{}, schema::stairsTable(),
                                          "climbs stairs; rise and tread are those that the legs and the steps imply");
        },
    .task = Task::natural_stairs,
    .make =
        [](const HumanCase& moved, const Human& human) {
          const auto& o = std::get<StairOptions>(moved.motion);
          MadeMotion made;
          made.motion = makeStairs(human, o, &made.mean_velocity_m_per_s);
          made.air_ramp_s = o.stand_s + o.lead_in_s;
          return made;
        },
    .strides = [](const MotionKind::Options& options) -> std::optional<Strides> {
      const auto& o = std::get<StairOptions>(options);
      return Strides{o.measuredFrom_s(), o.stride_time_s, o.strides - o.lead_in_strides, 0, stairAscent().foot_off};
    },
    .assumption =
        [](const Motion& motion) {
          const Stairs stairs = *motion.stairs();
          return fmt::format(
              "Climbing stairs is prescribed: hip angles of healthy adults (Bovi et al. 2011), whose swing is "
              "interpolated through published peaks because the recorded stride ended on a landing. The steps "
              "imply stairs of {:.0f} mm rise and {:.0f} mm tread; knees and ankles keep the feet on them. The "
              "wearer does not change gait because of the garment.",
              1e3 * stairs.rise_m, 1e3 * stairs.tread_m);
        },
};

}  // namespace gambeson
