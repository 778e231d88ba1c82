/// Detail of kind.hpp: what the human steps over.

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace schema {
namespace {

Object hurdleTable() {
  return Table<HurdleObstacle>("Hurdle")
      .number("width", &HurdleObstacle::width_m, "m", between(0.2, 100), "across the way, half of it to either side")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

Shape boxOf(const Hurdle& h, double width_m) {
  const double y = 0.5 * width_m;
  TriangleMesh box;
  for (const double z : {0.0, h.height_m})
    for (const auto& [ahead, side] : {std::pair{0.0, -y}, {h.depth_m, -y}, {h.depth_m, y}, {0.0, y}})
      box.vertices.push_back({ahead, side, z});
  box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    box.triangles.push_back({k, next, next + 4});
    box.triangles.push_back({k, next + 4, k + 4});
  }
  return box;
}

}  // namespace

extern const ObstacleKind hurdle_obstacle;
const ObstacleKind hurdle_obstacle{
    .word = "hurdle",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<HurdleObstacle>("hurdle", &ObstacleCase::shape, schema::hurdleTable(),
                                            "what the human steps over (motion step_over), a box across the way that "
                                            "stands where the motion has it; of some depth");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle* stepped_over) {
          if (!stepped_over)
            throw InputError({"", 0, "hurdle"}, "is what a human steps over; allowed: with the motion step_over");
          if (!(stepped_over->depth_m > 0))
            throw InputError({"", 0, "hurdle"}, "has no depth; allowed: with a depth above 0 of the motion step_over");
          return MadeObstacle{boxOf(*stepped_over, std::get<HurdleObstacle>(o.shape).width_m),
                              {stepped_over->front_m, 0, 0}};
        },
};

}  // namespace gambeson
