/// Detail of kind.hpp: sitting down and standing up.

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object sitTable() {
  using S = SitOptions;
  return Table<S>("Sitting down")
      .number("stand", &S::stand_s, "s", between(0, 60), "time at rest before it")
      .number("duration", &S::duration_s, "s", between(1, 60), "down, seated, and up again")
      .number("seat_height", &S::seat_height_m, "m", between(0.2, 0.8),
              "where the lowest point of the pelvis is, seated; the box under it is an obstacle of the case, lower by "
              "what the cloth between needs, and ends behind the thighs")
      .integer("repeats", &S::repeats, 1, 100, "how often")
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind sit_motion;
const MotionKind sit_motion{
    .word = "sit",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<SitOptions>("sit", std::identity{}, schema::sitTable(),
                                        "sits down and stands up, with both feet where they stand");
        },
    .make = [](const HumanCase& moved,
               const Human& human) { return MadeMotion{makeSit(human, std::get<SitOptions>(moved.motion))}; },
    .assumption = [](const Motion&) -> std::string {
      return "Sitting down is prescribed: knees and shanks with minimum jerk, feet where they stand, the trunk leaning "
             "as far as balance asks for until the seat carries. Flesh does not yield to the seat.";
    },
};

}  // namespace gambeson
