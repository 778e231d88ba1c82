/// Detail of fields.hpp: the table of what is written and pictured.

#include "cases/structure/fields.hpp"
#include "cases/structure/fields_place.hpp"

namespace gambeson::schema {
namespace {

template <class T>
Object outputPlaceTable(const std::string& title) {
  Table<T> table(title);
  table.text("name", &T::name, "what tables and plots call it").required();
  if constexpr (std::is_same_v<T, OutputEdge>) {
    addEdge(table, true);
  } else {
    addPoint(table);
    table.oneOf("where", true);
    addPatchOfPoint(table);
  }
  return table.build();
}

}  // namespace

Object structureOutputTable(StructureKind kind) {
  using O = StructureOutput;
  using P = StructurePicture;
  std::vector<std::pair<std::string, View>> views;
  for (const std::string& name : viewNames()) views.emplace_back(name, *viewByName(name));
  Table<P> picture("Picture of a structure");
  picture
      .choice("field", &P::field,
              std::vector<std::pair<std::string, StructureField>>{{"automatic", StructureField::automatic},
                                                                  {"stress", StructureField::stress},
                                                                  {"strain", StructureField::strain},
                                                                  {"displacement", StructureField::displacement},
                                                                  {"plain", StructureField::plain}},
              "what the colours show: first principal stress resultant, first principal strain, size of the "
              "displacement, or nothing; automatic: displacement in modal cases, else stress. The size of a mode is "
              "arbitrary: its colours are parts of the largest value")
      .choice("view", &P::view, views, "where the picture is taken from")
      .integer("width", &P::width, 64, 8192, "pixels")
      .integer("height", &P::height, 64, 8192, "pixels");
  if (kind == StructureKind::modal)
    picture.integer("mode", &P::mode, 1, 1000, "which mode, from 1")
        .number("scale", &P::scale, "", between(0, 1e9), "largest displacement shown, in tenths of the sheet's size");
  else
    picture.number("scale", &P::scale, "", between(0, 1e9), "multiplies the displacements that are shown");
  Table<O> table("Output of a structure");
  table.list("points", &O::points, outputPlaceTable<OutputPoint>("Named point"),
             "points whose displacement is written (and, in dynamic cases, velocity)");
  if (kind != StructureKind::modal)
    table.list("edges", &O::edges, outputPlaceTable<OutputEdge>("Named edge"),
               "edges whose mean displacement and total reaction (force, and moment about the mean of its points now) "
               "are written");
  table.choice(
      "shapes", &O::shapes,
      std::vector<std::pair<std::string, ShapesKept>>{
          {"last", ShapesKept::last}, {"all", ShapesKept::all}, {"none", ShapesKept::none}},
      "whole shapes that are kept with displacement, stress and strain (frames.xdmf, for ParaView); none: no pictures "
      "either. The last one is also in shape.csv");
  if (kind == StructureKind::dynamics)
    table
        .number("interval", &O::interval_s, "s", aboveTo(0, 1e9),
                "time between rows of the table and between kept shapes; each is the first step at or after it")
        .defaultsTo("a hundredth of end")
        .flag(
            "thread_strains", &O::thread_strains,
            "largest and mean absolute Green-Lagrange strain of weft and warp, at the vertices of the knot mesh and at "
            "degree x degree Gauss points a cell: columns of the table (vertex_weft_max ...) and thread_strain in "
            "summary.json (largest over the rows of the table, mean at the end)")
        .flag("audit", &O::audit,
              "balance of energy and momentum over all steps, in summary.json; costs up to two evaluations of the "
              "forces a step");
  return table
      .integer("samples_per_cell", &O::samples_per_cell, 1, 16, "how finely shapes and pictures follow a cell's edge")
      .list("pictures", &O::pictures, picture.build(), "pictures to take")
      .defaultsTo("one of the last shape")
      .build();
}

}  // namespace gambeson::schema
