#pragma once
/// The keys of a cell's yarns, in the table of whatever is a CellDesign.

#include "cases/input/table.hpp"
#include "cases/yarns/fields.hpp"

namespace gambeson::schema {

template <class C>
void addDesign(Table<C>& table) {
  table.object("weave", &C::weave, weaveTable(), "how yarns cross")
      .required()
      .object("weft", &C::weft, yarnTable(), "yarns along axis 1")
      .required()
      .object("warp", &C::warp, yarnTable(), "yarns along axis 2")
      .defaultsTo("as the weft: a balanced weave")
      .choice(
          "yarns", &C::yarns,
          std::vector<std::pair<std::string, YarnModel>>{
              {"rod", YarnModel::rod}, {"solid", YarnModel::solid}, {"truss", YarnModel::truss}},
          "what they are computed as. rod: yarns stretch, shear, bend and twist, at any rotation, and press on each "
          "other; solid: hexahedra with fibres along the yarn, whose surfaces touch (Man 2006, 4.3), for strains of "
          "flat cloth; truss: Kawabata's straight yarns joined at the crossings of a plain weave (Man 2006, 4.1.2.1), "
          "for loads along the yarns")
      .flag("contact", &C::contact, "whether yarns press on each other; false: they pass through each other")
      .object("compression", &C::compression, compressionTable(), "how yarns give way to each other at crossings")
      .defaultsTo("required with contact, but for solids, which give way by themselves")
      .choice("touch", &C::by_section, std::vector<std::pair<std::string, bool>>{{"axis", false}, {"section", true}},
              "where rods press on each other. axis: along their middles, by the thickness of sections alone; section: "
              "over the ellipses of the sections, which turn each other over their widths, and side by side, so that "
              "yarns jam where they are as near as they are wide")
      .unwritten()
      .choice(
          "faces", &C::holds_faces, std::vector<std::pair<std::string, bool>>{{"glide", false}, {"held", true}},
          "whether sections in the faces of the cell, half way between crossings, may move through the cloth; held: "
          "as in the thesis (4.3.5.3), all points of these sections keep their height, which stiffens the cell")
      .number("height", &C::height_m, "m", aboveTo(0, 1e3),
              "of the cell, by which forces per width become stress; no force depends on it")
      .defaultsTo("twice the half thicknesses of weft and warp");
}

template <class C>
void addSolver(Table<C>& table) {
  table.object("solver", &C::solver, cellSolverTable(), "how it is solved");
}

}  // namespace gambeson::schema
