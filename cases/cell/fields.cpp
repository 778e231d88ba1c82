#include "cases/cell/fields.hpp"

#include "cases/input/table.hpp"

namespace gambeson::schema {
namespace {

Object compressionTable() {
  using L = LateralCompression;
  return Table<L>("Lateral compression")
      .number(
          "half_force", &L::half_force_N, "N", aboveTo(0, 1e12),
          "P of F = P ((D - d)/d)^p: what presses two crossing yarns from the distance D of their middles, at which "
          "they touch, to D/2")
      .required()
      .number("exponent", &L::exponent, "", between(2, 6), "p")
      .build();
}

Object yarnFrictionTable() {
  using F = YarnFriction;
  return Table<F>("Friction between yarns")
      .number("coefficient", &F::coefficient, "", between(0, 10),
              "mu: what slides carries mu times the force that presses; each step of a load is one step of friction")
      .required()
      .number("stick_stiffness", &F::stick_stiffness_N_per_m3, "N/m^3", aboveTo(0, 1e18),
              "rods: tangential force by slip, by the lengths of both yarns, of what sticks; it gives way where the "
              "force is mu times that which presses")
      .defaultsTo("half_force/(sum of both half thicknesses)^3: about as stiff as lateral compression")
      .build();
}

Object barTable() {
  using B = BarCase;
  const auto bar = [](auto member) {
    return [member](auto& b) -> auto& { return b.bar.*member; };
  };
  const auto numbers = [&](const char* key, const std::string& unit, auto get, const std::string& doc) {
    Field f = fieldOf(key, Kind::numbers, unit, aboveTo(0, 1e18), doc);
    f.required = true;
    return std::tuple(
        f, [get, f](const Entry& p, B& b) { get(b) = readNumbers(p, f.unit, f.range); },
        [get](const B& b) { return std::optional(nodeOfList(get(b))); });
  };
  Table<B> table("Bar of periodic stiffness");
  table.text("name", &B::name, "what tables call it").required();
  std::apply([&](auto... parts) { table.custom(parts...); },
             numbers("lengths", "m", bar(&PeriodicBar::length), "of the pieces of one period, in order"));
  std::apply([&](auto... parts) { table.custom(parts...); },
             numbers("young", "Pa", bar(&PeriodicBar::young_Pa), "Young's modulus of each piece"));
  return table
      .check([](const Entry& p, const B& b) {
        if (b.bar.length.empty()) p.failAt("lengths", "there is no piece; allowed: at least one");
        if (b.bar.length.size() != b.bar.young_Pa.size())
          p.failAt("young", std::to_string(b.bar.young_Pa.size()) + " values for " +
                                std::to_string(b.bar.length.size()) + " pieces; allowed: one for each");
      })
      .build();
}

Object makeTable() {
  using C = CellCase;
  Field kind = fieldOf("kind", Kind::choice, "", any(), "what the case is");
  kind.choices = {"cell"};
  kind.required = true;
  return Table<C>("Case of kind cell",
                  "one repeat of a woven cloth made of its yarns, taken through loads of the cloth: what the cloth "
                  "carries, and its stiffness")
      .custom(
          kind, [](const Entry& p, C&) { readChoice(p, {"cell"}); },
          [](const C&) { return std::optional(nodeOf(std::string("cell"))); })
      .text("name", &C::name, "title of the pictures and the report")
      .required()
      .text("description", &C::description, "what the case is about")
      .object("weave", &C::weave, weaveTable(), "how yarns cross")
      .required()
      .object("weft", &C::weft, yarnTable(), "yarns along axis 1")
      .required()
      .object("warp", &C::warp, yarnTable(), "yarns along axis 2")
      .defaultsTo("as the weft: a balanced weave")
      .choice(
          "yarns", &C::yarns,
          std::vector<std::pair<std::string, YarnModel>>{{"rod", YarnModel::rod}, {"truss", YarnModel::truss}},
          "what they are computed as. rod: yarns stretch, shear, bend and twist, at any rotation, and press on each "
          "other; truss: Kawabata's straight yarns joined at the crossings of a plain weave (Man 2006, 4.1.2.1), "
          "for loads along the yarns")
      .flag("contact", &C::contact, "whether yarns press on each other; false: they pass through each other")
      .object("compression", &C::compression, compressionTable(), "how yarns give way to each other at crossings")
      .defaultsTo("required with contact")
      .object("friction", &C::friction, yarnFrictionTable(), "between yarns that touch (Coulomb's law)")
      .defaultsTo("none: yarns slide on each other freely")
      .choice("extent", &C::quarter, std::vector<std::pair<std::string, bool>>{{"full", false}, {"quarter", true}},
              "how much of the repeat moves by itself. quarter: of a plain weave one weft and one warp over one spacing "
              "(Man 2006, fig. 19c), whose images, mirrored in the middle of the cloth, are the others; a plain weave "
              "keeps that symmetry under any strain of its plane, unless it buckles, and under no bend")
      .unwritten()
      .choice(
          "faces", &C::holds_faces, std::vector<std::pair<std::string, bool>>{{"glide", false}, {"held", true}},
          "whether sections in the faces of the cell, half way between crossings, may move through the cloth; held: "
          "as in the thesis (4.3.5.3), which stiffens weaves with floats")
      .number("height", &C::height_m, "m", aboveTo(0, 1e3),
              "of the cell, by which forces per width become stress; no force depends on it")
      .defaultsTo("twice the half thicknesses of weft and warp")
      .list("loads", &C::paths, pathTable(), "what the cell is taken through, each from rest")
      .defaultsTo("none: its stiffness at rest alone")
      .list("bars", &C::bars, barTable(),
            "bars of periodic stiffness, whose mean stiffness has a closed form (Man 2006, 4.13 to 4.32); beside the "
            "cell, without a part in it")
      .object("solver", &C::solver, cellSolverTable(), "how it is solved")
      .object("output", &C::output, cellOutputTable(), "what is recorded and pictured")
      .build();
}

}  // namespace

Object cellSolverTable() {
  using S = CellSolver;
  return Table<S>("Solver of a cell")
      .integer("pieces_per_spacing", &S::pieces_per_spacing, 4, 256,
               "rods: pieces of a yarn between two crossings, an even number; with fewer than 16 yarns catch on each "
               "other's sections, and a lightly pressed crossing may be unstable")
      .number("tolerance", &S::tolerance, "", between(1e-13, 1e-3),
              "rods: residual force as a part of the forces that balance")
      .integer("iterations", &S::iterations, 1, 10000, "rods: Newton iterations of a step")
      .integer("halvings", &S::halvings, 0, 30, "rods: how often a step that fails is halved")
      .check([](const Entry& p, const S& s) {
        if (s.pieces_per_spacing % 2 != 0)
          p.failAt("pieces_per_spacing",
                   std::to_string(s.pieces_per_spacing) + " is odd; allowed: even numbers from 4 to 256");
      })
      .build();
}

Object cellOutputTable() {
  using O = CellOutput;
  using P = CellPicture;
  std::vector<std::pair<std::string, View>> views;
  for (const std::string& name : viewNames()) views.emplace_back(name, *viewByName(name));
  Object picture = Table<P>("Picture of a cell")
                       .text("path", &P::path, "name of the load at whose end it is taken")
                       .defaultsTo("none: the cell at rest")
                       .choice("field", &P::field,
                               std::vector<std::pair<std::string, CellField>>{{"stress", CellField::stress},
                                                                              {"direction", CellField::direction}},
                               "what the colours show: stress along the yarns, or weft and warp")
                       .choice("view", &P::view, views, "where it is taken from; axis 1 points to the viewer of front")
                       .integer("repeats", &P::repeats, 1, 8, "how many cells are shown either way")
                       .defaultsTo("as many as show four yarns")
                       .integer("width", &P::width, 64, 8192, "pixels")
                       .integer("height", &P::height, 64, 8192, "pixels")
                       .build();
  return Table<O>("Output of a cell")
      .choice("shapes", &O::shapes,
              std::vector<std::pair<std::string, CellShapesKept>>{
                  {"last", CellShapesKept::last}, {"all", CellShapesKept::all}, {"none", CellShapesKept::none}},
              "shapes of the yarns that are kept (frames.xdmf, for ParaView): at rest and at the end of each load, or "
              "at every step; none: no pictures either")
      .list("pictures", &O::pictures, std::move(picture), "pictures to take")
      .defaultsTo("one of the cell at rest, and one of the end of each load")
      .build();
}

const Object& cellTable() {
  static const Object table = makeTable();
  return table;
}

}  // namespace gambeson::schema
