#include "cases/case.hpp"
#include "cases/fields.hpp"
#include "cases/table.hpp"

namespace gambeson::schema {
namespace {

Object motionTable() {
  using Motions = decltype(HumanCase::motion);
  const auto self = [](auto& m) -> auto& { return m; };
  using W = WalkOptions;
  return Table<Motions>("Motion")
      .alternative<StandMotion>("stand", self,
                                Table<StandMotion>("Standing")
                                    .number("duration", &StandMotion::duration_s, "s", aboveTo(0, 600), "how long")
                                    .build(),
                                "stands still")
      .in("motion")
      .alternative<WalkOptions>(
          "walk", self,
          Table<W>("Walking")
              .number("stand", &W::stand_s, "s", between(0, 60), "time at rest before the first step")
              .number("lead_in", &W::lead_in_s, "s", between(0.1, 10), "smooth start from standing into the stride")
              .integer("strides", &W::strides, 1, 100, "full strides (two steps each) after the lead-in")
              .number("stride_time", &W::stride_time_s, "s", between(0.5, 3), "time of one stride")
              .build(),
          "walks at natural speed")
      .in("motion")
      .alternative<TrajectoryMotion>(
          "trajectory", self,
          Table<TrajectoryMotion>("Trajectory")
              .path("file", &TrajectoryMotion::file,
                    "CSV with a column time_s and one per joint, such as hip_flexion_left_deg")
              .required()
              .build(),
          "moves its joints as a file says")
      .in("motion")
      .oneOf("motion", true)
      .build();
}

}  // namespace

Object humanTable() {
  using H = HumanCase;
  std::vector<std::pair<std::string, std::string>> manikins;
  for (const char* name : {"male_p5", "male_p50", "male_p95", "female_p5", "female_p50", "female_p95"})
    manikins.emplace_back(name, name);
  return Table<H>("Human")
      .choice("manikin", &H::manikin, manikins, "one of our own humans, by sex and percentile of stature")
      .in("who")
      .path("urdf", &H::urdf, "skeleton of a human of your own")
      .in("who")
      .oneOf("who", true)
      .path("body", &H::body, "body file that goes with urdf: ellipsoids per link")
      .defaultsTo("the geometry in the URDF")
      .object("motion", &H::motion, motionTable(), "what the human does")
      .required()
      .check([](const Place& p, const H& h) {
        if (h.urdf.empty() && !h.body.empty()) p.failAt("body", "goes with \"urdf\"; a manikin has its own body");
      })
      .build();
}

}  // namespace gambeson::schema
