/// Detail of kind.hpp: segments that markers move directly.

#include "cases/input/table.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "human/recorded/marker_body.hpp"

namespace gambeson {
namespace schema {
namespace {

Object markersTable() {
  using M = MarkersOptions;
  return Table<M>("Recorded markers")
      .path("path", &M::path, "trajectories of markers (.trc)")
      .required()
      .text("forward", &M::forward, "axis of the file's world that is our x, such as x or -y")
      .text("up", &M::up, "axis of the file's world that points up")
      .number("from", &M::from_s, "s", between(-1e6, 1e6), "begin of the window in the file's own time")
      .defaultsTo("its first instant")
      .number("to", &M::to_s, "s", between(-1e6, 1e6), "end of the window")
      .defaultsTo("its last instant")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

/// Mean of the segments' centres.
Vec3 middle(const Human& human, const Posture& p) {
  const std::vector<Pose> X = linkPoses(human.skeleton, p.q, p.root);
  Vec3 sum;
  for (const BodyShape& s : human.shapes) sum += X[s.link].origin;
  return sum / static_cast<double>(human.shapes.size());
}

}  // namespace

extern const MotionKind markers_motion;
const MotionKind markers_motion{
    .word = "markers",
    .addTo =
        [](schema::Table<MotionKind::Options>& table) {
          table.alternative<MarkersOptions>("markers", std::identity{}, schema::markersTable(),
                                            "its segments stand where markers of a file say, with no skeleton between");
        },
    .ours = false,
    .make =
        [](const HumanCase& moved, const Human& human) {
          MadeMotion made{loadMarkers(std::get<MarkersOptions>(moved.motion), moved.segments)};
          const Motion& m = *made.motion;
          const Vec3 way = middle(human, m.at(m.duration())) - middle(human, m.at(0));
          made.mean_velocity_m_per_s = Vec3{way.x, way.y, 0} / m.duration();
          return made;
        },
    .assumption = [](const Motion&) -> std::string {
      return "Each segment is an ellipsoid between two joints and a marker of the recording (Man 2006, 5.1): where "
             "markers slid on the skin, segments part or lengthen. The wearer does not change the motion because of "
             "the garment.";
    },
    .files = [](MotionKind::Options& options, const MotionKind::Take& take,
                const std::function<void(std::string&)>&) { take(std::get<MarkersOptions>(options).path); },
};

}  // namespace gambeson
