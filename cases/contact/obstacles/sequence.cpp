/// Detail of kind.hpp: a surface that deforms, frame by frame.

#include <fmt/format.h>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"
#include "human/files/mesh.hpp"

namespace gambeson {
namespace schema {
namespace {

Object sequenceTable() {
  using S = SequenceObstacle;
  Field folder;
  folder.key = "folder";
  folder.kind = Kind::path;
  folder.doc =
      "of mesh files (OBJ, PLY, STL or glTF), one for each frame, in the order of the numbers in their names: one mesh "
      "whose vertices move";
  return Table<S>("Sequence of meshes")
      .custom(
          folder, [](const Entry& p, S& o) { o.folder = readFolder(p); },
          [](const S& o) { return std::optional(nodeOf(o.folder.string())); })
      .required()
      .number("rate", &S::rate_Hz, "Hz", aboveTo(0, 1e5), "frames per second")
      .number("scale", &S::scale, "", aboveTo(0, 1e6), "metres per unit of the files")
      .number("begin", &S::begin_s, "s", between(-1e4, 1e4),
              "when the first frame is there; it starts at rest from it, and ends at rest in the last")
      .text("forward", &S::forward, "axis of the files that points along our x, such as z or -y; with up")
      .defaultsTo("x")
      .text("up", &S::up, "axis of the files that points along our z; with forward")
      .defaultsTo("z")
      .build();
}

}  // namespace
}  // namespace schema

extern const ObstacleKind sequence_obstacle;
const ObstacleKind sequence_obstacle{
    .word = "sequence",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<SequenceObstacle>("sequence", &ObstacleCase::shape, schema::sequenceTable(),
                                              "a surface that deforms, frame by frame");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& s = std::get<SequenceObstacle>(o.shape);
          auto sequence = std::make_unique<const MeshSequence>(s);
          const std::string defects = defectsOf(sequence->first(), o.name, s.folder);
          std::string note = fmt::format("obstacle {} ({}): {} frames from {:.3f} to {:.3f} s, {} triangles{}", o.name,
                                         s.folder.filename().string(), sequence->frames(), s.begin_s, sequence->end_s(),
                                         sequence->triangles().size(), defects.empty() ? "" : "; it " + defects);
          return MadeObstacle{sequence->first(), {}, std::move(sequence), {std::move(note)}};
        },
    .check = [](const ObstacleCase& o) { MeshSequence{std::get<SequenceObstacle>(o.shape)}; },
    .files =
        [](ObstacleCase& o, const ObstacleKind::Take& take) {
          auto& s = std::get<SequenceObstacle>(o.shape);
          for (std::filesystem::path frame : framesIn(s.folder)) {
            for (std::filesystem::path file : filesBeside(frame)) take(file);
            take(frame);
          }
          s.folder = s.folder.filename();
        },
};

}  // namespace gambeson
