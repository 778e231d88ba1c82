#include "cases/cell/fields.hpp"

#include "cases/input/table.hpp"
#include "cases/yarns/design_rows.hpp"

namespace gambeson::schema {
namespace {

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
  Table<C> table("Case of kind cell",
                 "one repeat of a woven cloth made of its yarns, taken through loads of the cloth: what the cloth "
                 "carries, and its stiffness");
  table
      .custom(
          kind, [](const Entry& p, C&) { readChoice(p, {"cell"}); },
          [](const C&) { return std::optional(nodeOf(std::string("cell"))); })
      .text("name", &C::name, "title of the pictures and the report")
      .required()
      .text("description", &C::description, "what the case is about");
  addDesign(table);
  table.object("friction", &C::friction, yarnFrictionTable(), "between yarns that touch (Coulomb's law)")
      .defaultsTo("none: yarns slide on each other freely")
      .choice(
          "extent", &C::quarter, std::vector<std::pair<std::string, bool>>{{"full", false}, {"quarter", true}},
          "how much of the repeat moves by itself. quarter: of a plain weave one weft and one warp over one spacing "
          "(Man 2006, fig. 19c), whose images, mirrored in the middle of the cloth, are the others; a plain weave "
          "keeps that symmetry under any strain of its plane, unless it buckles, and under no bend")
      .unwritten()
      .object("solids", &C::solids, solidsTable(), "how solid yarns are cut, and how what touches is found")
      .defaultsTo("of yarns solid all of its defaults; others have none");
  table.list("loads", &C::paths, pathTable(), "what the cell is taken through, each from rest")
      .defaultsTo("none: its stiffness at rest alone")
      .list("bars", &C::bars, barTable(),
            "bars of periodic stiffness, whose mean stiffness has a closed form (Man 2006, 4.13 to 4.32); beside the "
            "cell, without a part in it");
  addSolver(table);
  return table.object("output", &C::output, cellOutputTable(), "what is recorded and pictured").build();
}

}  // namespace

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
                                                                              {"pressure", CellField::pressure},
                                                                              {"direction", CellField::direction}},
                               "what the colours show: stress along the yarns; of solids the pressure of the warp, "
                               "taken off, on the weft; or weft and warp")
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
