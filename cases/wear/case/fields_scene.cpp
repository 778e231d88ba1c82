/// Detail of fields.hpp: the tables of obstacles and supports.

#include <fmt/format.h>

#include "cases/input/table.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"

namespace gambeson::schema {
namespace {

const Range world = between(-1e3, 1e3);

Object ellipsoidTable() {
  using E = EllipsoidObstacle;
  return Table<E>("Ellipsoid")
      .vector("semi_axes", &E::semi_axes_m, "m", aboveTo(0, 100), "half lengths along x, y, z")
      .required()
      .vector("center", &E::center_m, "m", world, "centre")
      .build();
}

Object sphereTable() {
  using S = SphereObstacle;
  return Table<S>("Sphere")
      .number("radius", &S::radius_m, "m", aboveTo(0, 100), "radius")
      .required()
      .vector("center", &S::center_m, "m", world, "centre")
      .integer("rings", &S::rings, 0, 1000, "bands of triangles from pole to pole along z; 0: an exact sphere")
      .integer("segments", &S::segments, 0, 1000, "triangles around; 0: an exact sphere")
      .check([](const Place& p, const S& s) {
        if ((s.rings == 0) != (s.segments == 0))
          p.failAt(s.rings ? "segments" : "rings", "rings and segments go together; give both or neither");
        if (s.rings != 0 && s.rings < 2)
          p.failAt("rings", fmt::format("{} is out of range; allowed: 0 or >= 2", s.rings));
        if (s.segments != 0 && s.segments < 3)
          p.failAt("segments", fmt::format("{} is out of range; allowed: 0 or >= 3", s.segments));
      })
      .build();
}

Object planeTable() {
  using P = PlaneObstacle;
  return Table<P>("Plane")
      .vector("point", &P::point_m, "m", world, "centre of the square")
      .direction("normal", &P::normal, "points to the side where the cloth is")
      .number("size", &P::size_m, "m", aboveTo(0, 1e3), "edge of the square")
      .build();
}

Object torusTable() {
  using T = TorusObstacle;
  return Table<T>("Torus")
      .number("radius", &T::radius_m, "m", aboveTo(0, 100), "radius of the ring's middle line")
      .required()
      .number("tube", &T::tube_m, "m", aboveTo(0, 100), "radius of the tube about it, smaller than radius")
      .required()
      .vector("center", &T::center_m, "m", world, "centre")
      .direction("axis", &T::axis, "axis of the ring")
      .integer("segments", &T::segments, 3, 1000, "pieces around the axis")
      .integer("rings", &T::rings, 3, 1000, "pieces around the tube")
      .check([](const Place& p, const T& t) {
        if (!(t.tube_m < t.radius_m))
          p.failAt("tube", fmt::format("{} m is out of range; allowed: < radius = {} m", t.tube_m, t.radius_m));
      })
      .build();
}

Object meshTable() {
  using M = MeshObstacle;
  return Table<M>("Mesh")
      .path("file", &M::file, "OBJ, PLY, STL or glTF, relative to the case's folder")
      .required()
      .number("scale", &M::scale, "", aboveTo(0, 1e6), "metres per unit of the file")
      .vector("position", &M::position_m, "m", world, "where the file's origin stands")
      .build();
}

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
          folder, [](const Place& p, S& o) { o.folder = readFolder(p); },
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

/// "waist", or "2.u0" for side u0 of patch 2.
const std::vector<std::string> side_names{"u0", "u1", "v0", "v1"};

template <class S>
void edgeField(Table<S>& table) {
  table
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "whose edge it is, by the garment's name")
      .defaultsTo("the only garment; required where there are several");
  Field f;
  f.key = "edge";
  f.kind = Kind::text;
  f.required = true;
  f.doc =
      "which edge of the garment: waist, hem_left, hem_right of shorts; start, end of a tube; u0, u1, v0, v1 of a "
      "sheet; or "
      "patch and side, such as 2.u0";
  table.custom(
      f,
      [](const Place& p, S& s) {
        const std::string& text = readText(p);
        const std::size_t dot_at = text.find('.');
        if (dot_at == std::string::npos) {
          s.edge.name = text;
          return;
        }
        const std::string patch = text.substr(0, dot_at), side = text.substr(dot_at + 1);
        const auto found = std::find(side_names.begin(), side_names.end(), side);
        if (patch.empty() || patch.size() > 4 || patch.find_first_not_of("0123456789") != std::string::npos ||
            found == side_names.end())
          p.fail(describe(p.node) + " is not an edge; allowed: a name, or patch and side such as 2.u0");
        s.edge.name.clear();
        s.edge.patch = std::stoi(patch);
        s.edge.side = static_cast<Side>(found - side_names.begin());
      },
      [](const S& s) {
        return std::optional(nodeOf(
            s.edge.name.empty() ? fmt::format("{}.{}", s.edge.patch, side_names[static_cast<std::size_t>(s.edge.side)])
                                : s.edge.name));
      });
}

}  // namespace

Object obstacleTable() {
  using O = ObstacleCase;
  return Table<O>("Obstacle")
      .text("name", &O::name, "what the tables call it")
      .required()
      .alternative<EllipsoidObstacle>("ellipsoid", &O::shape, ellipsoidTable(), "an ellipsoid")
      .in("shape")
      .alternative<SphereObstacle>("sphere", &O::shape, sphereTable(), "a sphere, exact or as a mesh")
      .in("shape")
      .alternative<PlaneObstacle>("plane", &O::shape, planeTable(), "a square of a plane")
      .in("shape")
      .alternative<TorusObstacle>("torus", &O::shape, torusTable(), "a ring")
      .in("shape")
      .alternative<MeshObstacle>("mesh", &O::shape, meshTable(), "triangles from a file")
      .in("shape")
      .alternative<SequenceObstacle>("sequence", &O::shape, sequenceTable(), "a surface that deforms, frame by frame")
      .in("shape")
      .oneOf("shape", true)
      .vector("velocity", &O::velocity_m_per_s, "m/s", between(-100, 100), "constant velocity")
      .build();
}

Object supportTable() {
  const auto self = [](auto& s) -> auto& { return s; };
  Table<FixedSupport> fixed("Fixed edge");
  edgeField(fixed);
  fixed.integer("rows", &FixedSupport::rows, 1, 2, "rows of control points held: 1 holds the edge, 2 also its slope");
  Table<SpringSupport> springs("Springs");
  edgeField(springs);
  springs
      .number("stiffness", &SpringSupport::stiffness_N_per_m2, "N/m^2", aboveTo(0, 1e8),
              "force per displacement and length of edge")
      .text("link", &SpringSupport::link, "link of the human that the springs are tied to, such as pelvis")
      .required();
  Table<PinnedSupport> pinned("Pinned point");
  pinned
      .text(
          "garment", [](auto& s) -> auto& { return s.edge.garment; }, "which garment, by its name")
      .defaultsTo("the only garment; required where there are several")
      .integer(
          "patch", [](auto& s) -> auto& { return s.edge.patch; }, 0, 9999, "patch of the garment")
      .number("s", &PinnedSupport::s, "", between(0, 1), "where along u, as a part of the patch's range")
      .number("t", &PinnedSupport::t, "", between(0, 1), "where along v");
  return Table<SupportCase>("Support")
      .alternative<FixedSupport>("fixed", self, fixed.build(), "an edge that stays where it is in the world")
      .in("support")
      .alternative<SpringSupport>("springs", self, springs.build(),
                                  "an edge tied by elastic springs to a link of the human, so that it hangs where it "
                                  "was drafted; above a skin they act along it only: contact is what presses; their "
                                  "reactions are reported apart")
      .in("support")
      .alternative<PinnedSupport>("pinned", self, pinned.build(),
                                  "a point that stays where it is in the world: the control points that shape it")
      .in("support")
      .oneOf("support", true)
      .build();
}

}  // namespace gambeson::schema
