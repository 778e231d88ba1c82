/// Detail of kind.hpp: taking aim at the ground.

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"

namespace gambeson {
namespace schema {
namespace {

Object aimTable() {
  using A = AimOptions;
  return Table<A>("Taking aim")
      .number("stand", &A::stand_s, "s", between(0, 60), "time at low ready before it")
      .number("duration", &A::duration_s, "s", between(0.2, 60), "from low ready to aiming at the ground")
      .number("hold", &A::hold_s, "s", between(0, 60), "time aiming after it")
      .number("rifle", &A::rifle_mass_kg, "kg", between(0, 50),
              "mass of the rifle; it enters the natural moments, not contact")
      .build();
}

}  // namespace
}  // namespace schema

extern const MotionKind aim_motion;
const MotionKind aim_motion{
    .word = "aim",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<AimOptions>("aim", std::identity{}, schema::aimTable(),
                                        "takes aim at the ground, leaning left, from low ready");
        },
    .task = Task::aiming,
    .make = [](const HumanCase& moved,
               const Human& human) { return MadeMotion{makeAim(human, std::get<AimOptions>(moved.motion))}; },
    .carried_kg = [](const MotionKind::Options& options) -> std::optional<double> {
      return std::get<AimOptions>(options).rifle_mass_kg;
    },
    .assumption = [](const Motion&) -> std::string {
      return "Taking aim is prescribed: end posture after Zheng 2013, 6.6, hips and trunk with minimum jerk, knees, "
             "ankles "
             "and hip rotations such that the feet stand. The rifle loads the wearer, not the garment.";
    },
};

}  // namespace gambeson
