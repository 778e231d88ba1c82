/// Detail of kind.hpp: what was recorded of a person.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/fields_map.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/recorded/motion_file.hpp"

namespace gambeson {
namespace schema {
namespace {

Object fileTable() {
  using M = MotionFileOptions;
  return Table<M>("Recorded motion")
      .path("path", &M::path, "OpenSim coordinates (.mot, .sto), a hierarchy of bones (.bvh) or markers (.trc)")
      .required()
      .path("model", &M::model, "the subject's scaled OpenSim model (.osim): where markers sit and joints are")
      .defaultsTo("none; markers that are not at joints need it")
      .custom(
          mapField("what its joints, bones or markers are in our human: gait2392, rajagopal, snu_woody, makehuman, "
                   "makehuman_default, unreal, mixamo, gait2392_markers, joint_centres, or a file of one's own "
                   "(human/data/MAPS.md)",
                   "that which goes with the names in the file"),
          [](const Entry& p, M& m) { m.map = readMap(p); },
          [](const M& m) { return m.map.empty() ? std::nullopt : std::optional(nodeOf(m.map)); })
      .number("from", &M::from_s, "s", between(-1e6, 1e6), "begin of the window in the file's own time")
      .defaultsTo("its first instant")
      .number("to", &M::to_s, "s", between(-1e6, 1e6), "end of the window")
      .defaultsTo("its last instant")
      .number("stand", &M::stand_s, "s", between(0, 60), "time at rest before the lead-in")
      .number("lead_in", &M::lead_in_s, "s", between(0, 10),
              "from standing into the window; 0: starts in the window's first posture")
      .integer("repeat", &M::repeat, 1, 1000, "a clip of one whole stride is walked so many times")
      .number("slower", &M::slower, "", between(0.1, 10), "the file's time times this")
      .number("scale", &M::scale, "", aboveTo(0, 100), "of the recorded path")
      .defaultsTo("our leg over the subject's; where that is not known, what lets the feet slip least")
      .number("floor", &M::floor_m, "m", between(-100, 100),
              "height of the ground in the file, if its heights are to stand")
      .defaultsTo("the feet are put on the ground")
      .text("forward", &M::forward, "axis of the file's world that one faces, such as x or -y; with up")
      .defaultsTo("that of the map")
      .text("up", &M::up, "axis of the file's world that points up; with forward")
      .defaultsTo("that of the map")
      .choice("heading", &M::heading,
              std::vector<std::pair<std::string, Heading>>{{"keep", Heading::keep}, {"straight", Heading::straight}},
              "turns are kept (the first second faces x), or taken out")
      .choice("travel", &M::travel,
              std::vector<std::pair<std::string, Travel>>{{"file", Travel::file}, {"feet", Travel::feet}},
              "the pelvis goes as in the file, or where the feet take it (treadmills)")
      .number("hips_apart", &M::hips_apart_rad, "rad", between(-0.6, 0.6),
              "abduction of the hips held on top of the recorded one, where our thighs are thicker than the subject's")
      .number("arms_apart", &M::arms_apart_rad, "rad", between(-1.6, 1.6), "likewise of the shoulders")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

/// What was read is a fact; joints beyond their limits and feet that do not stand bear on the result.
void tell(const MotionFileOptions& o, const MotionFileNotes& read, MadeMotion& made) {
  const std::string file = o.path.filename().string();
  for (const std::string& line : read.lines) made.facts.push_back(fmt::format("motion {}: {}", file, line));
  if (read.beyond_limits_deg > 5)
    made.notes.push_back(fmt::format("motion {}: {} goes {:.0f} degrees beyond its limits", file, read.beyond_joint,
                                     read.beyond_limits_deg));
  // As feet of our own motions are judged (bodies.cpp).
  const bool stand = read.feet.deepest_m < 0.02 && read.feet.highest_m < 0.02;
  (stand ? made.facts : made.notes)
      .push_back(fmt::format("motion {}: feet at most {:.0f} mm below and {:.0f} mm above the ground, slip of carrying "
                             "feet {:.2f} m/s RMS",
                             file, 1e3 * read.feet.deepest_m, 1e3 * read.feet.highest_m, read.feet.slip_m_per_s));
}

}  // namespace

extern const MotionKind file_motion;
const MotionKind file_motion{
    .word = "file",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<MotionFileOptions>("file", std::identity{}, schema::fileTable(),
                                               "moves as a person was recorded");
        },
    .ours = false,
    .tells_feet = true,
    .holds_apart = true,
    .make =
        [](const HumanCase& moved, const Human& human) {
          const auto& o = std::get<MotionFileOptions>(moved.motion);
          MadeMotion made;
          MotionFileNotes read;
          made.motion = loadMotionFile(o, human, &read);
          const Motion& m = *made.motion;
          const Vec3 way = m.at(m.duration()).root.origin - m.at(read.window_s).root.origin;
          made.mean_velocity_m_per_s = Vec3{way.x, way.y, 0} / (m.duration() - read.window_s);
          made.air_ramp_s = read.window_s;
          tell(o, read, made);
          return made;
        },
    .files =
        [](MotionKind::Options& options, const MotionKind::Take& take,
           const std::function<void(std::string&)>& take_map) {
          auto& o = std::get<MotionFileOptions>(options);
          take(o.path);
          take(o.model);
          take_map(o.map);
        },
};

}  // namespace gambeson
