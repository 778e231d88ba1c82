/// Detail of fields.hpp: the table of loads.

#include "cases/cell/fields.hpp"
#include "cases/input/table.hpp"

namespace gambeson::schema {
namespace {

const Range stretching = aboveTo(0, 2), before = between(-0.5, 2);
const std::string before_doc = "of both directions before it, which brings yarns into contact";

Object biaxialTable() {
  using B = BiaxialPath;
  return Table<B>("Biaxial extension")
      .number("extension", &B::extension, "", stretching, "Phi11 - 1 at its end")
      .required()
      .number("ratio", &B::ratio, "", between(-1, 100), "extension along the warp over that along the weft")
      .build();
}

Object uniaxialTable() {
  using U = UniaxialPath;
  return Table<U>("Uniaxial extension")
      .number("extension", &U::extension, "", stretching, "stretch less 1 at its end")
      .required()
      .choice("along", &U::along,
              std::vector<std::pair<std::string, YarnDirection>>{{"weft", along_weft}, {"warp", along_warp}},
              "which yarns are pulled")
      .choice("sides", &U::free_sides, std::vector<std::pair<std::string, bool>>{{"held", false}, {"free", true}},
              "held: the other direction keeps its length; free: it takes the length at which it carries nothing")
      .build();
}

Object compressionPathTable() {
  using P = CompressionPath;
  return Table<P>("Compression along both directions")
      .number("shortening", &P::shortening, "", aboveTo(0, 0.5), "1 - Phi11 = 1 - Phi22 at its end")
      .required()
      .build();
}

Object shearTable() {
  using S = ShearPath;
  return Table<S>("Shear as printed")
      .number("shear", &S::shear, "", between(-0.9, 0.9),
              "Phi12 = Phi21 at its end (Man 2006, 4.3.5), which stretches the yarns too")
      .required()
      .number("extension", &S::extension, "", before, before_doc)
      .build();
}

Object trellisTable() {
  using T = TrellisPath;
  return Table<T>("Trellis shear")
      .number("angle", &T::angle_rad, "rad", between(-1.4, 1.4),
              "by which the yarns turn towards each other; their spacing along themselves stays")
      .required()
      .number("extension", &T::extension, "", before, before_doc)
      .build();
}

Object bendingTable() {
  using B = BendingPath;
  return Table<B>("Bending")
      .number("curvature", &B::curvature_per_m, "1/m", between(-1e6, 1e6),
              "of the cylinder at its end, positive where its axis lies on the upper side")
      .required()
      .number("direction", &B::direction_rad, "rad", between(-7, 7), "of the arcs, from the weft towards the warp")
      .build();
}

}  // namespace

Object pathTable() {
  using P = PathCase;
  return Table<P>("Load of a cell")
      .text("name", &P::name, "what tables, plots and pictures call it")
      .required()
      .alternative<BiaxialPath>("biaxial", &P::load, biaxialTable(), "stretched along both directions")
      .in("load")
      .alternative<UniaxialPath>("uniaxial", &P::load, uniaxialTable(), "stretched along one direction")
      .in("load")
      .alternative<CompressionPath>("compression", &P::load, compressionPathTable(), "shortened along both directions")
      .in("load")
      .alternative<ShearPath>("shear", &P::load, shearTable(), "sheared as the thesis prints it")
      .in("load")
      .alternative<TrellisPath>("trellis", &P::load, trellisTable(), "sheared as a picture frame does it")
      .in("load")
      .alternative<BendingPath>("bending", &P::load, bendingTable(),
                                "bent to a cylinder, exact at any curvature; of cloth that nothing pulls")
      .in("load")
      .oneOf("load", true)
      .integer("steps", &P::steps, 1, 10000, "equal steps from its begin to its end")
      .integer("cycles", &P::cycles, 0, 100, "how often it goes there and back; 0: there")
      .build();
}

std::string wordOf(const PathLoads& load) {
  static const std::vector<std::string> words{"biaxial", "uniaxial", "compression", "shear", "trellis", "bending"};
  return words[load.index()];
}

}  // namespace gambeson::schema
