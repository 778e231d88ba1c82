/// Every way to get a cell's case wrong says where and why.

#include "unit/cases/malformed.hpp"
#include "unit/cases/cell/example.hpp"

namespace gambeson {
namespace {

TEST(MalformedCell, EachSaysFileLineKeyAndReason) {
  expectRefused(
      cell_example,
      {
          {"\"kind\": \"cell\"", "\"kind\": \"cells\"", 2, "kind", "allowed: wear, static, dynamic, modal or cell"},
          {"\"compression\"", "\"compresion\"", 13, "compresion", "did you mean \"compression\"?"},
          // Weave.
          {"\"pattern\": \"plain\"", "\"pattern\": \"plane\"", 4, "weave.pattern", "plain, twill, satin or matrix"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"twill\", \"over\": 2", 4, "weave.under", "is required of a twill"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"twill\", \"over\": 0, \"under\": 1", 4, "weave.over",
           "allowed: >= 1"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"plain\", \"ends\": 5", 4, "weave.ends", "goes with pattern satin"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"satin\", \"ends\": 6, \"step\": 3", 4, "weave.step",
           "without a factor in common"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"matrix\", \"matrix\": [[1, 0], [1, 0]]", 4, "weave.matrix",
           "not woven in"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"matrix\", \"matrix\": [[1, 0], [0]]", 4, "weave.matrix",
           "must have 2"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"matrix\", \"matrix\": [[1, 2], [0, 1]]", 4, "weave.matrix[0][1]",
           "allowed: >= 0 and <= 1"},
          {"\"pattern\": \"plain\"", "\"pattern\": \"matrix\", \"matrix\": 3", 4, "weave.matrix", "a list of 1 to 64"},
          // Yarns.
          {"\"0.24 mm\"", "\"0.6 mm\"", 6, "weft.half_width", "must be"},
          {"\"amplitude\": \"0.16 mm\", \"half_width\": \"0.25 mm\"",
           "\"amplitude\": \"0.1 mm\", \"half_width\": \"0.25 mm\"", 6, "weft.amplitude", "must be"},
          {"\"84.63 GPa\"", "\"-1 GPa\"", 7, "weft.moduli.young", "allowed: > 0"},
          {"\"84.63 GPa\"", "\"84.63 GN\"", 7, "weft.moduli.young", "wrong unit"},
          {"\"axial_shear\": \"0.244 GPa\"", "\"axial_shear\": 0", 7, "weft.moduli.axial_shear", "allowed: > 0"},
          {"\"torsion\": 1e-6", "\"torsion\": -1e-6", 11, "warp.section.torsion", "allowed: >= 0"},
          {"\"bending_through\": 6e-5, ", "", 11, "warp.section.bending_through", "is required"},
          {"\"section\": {\"stretch\"", "\"moduli\": {\"young\": 1, \"axial_shear\": 1}, \"section\": {\"stretch\"", 11,
           "warp.section", "excludes \"moduli\""},
          {"\"half_force\": \"800 N\", ", "", 13, "compression.half_force", "is required"},
          {"\"exponent\": 3", "\"exponent\": 7", 13, "compression.exponent", "allowed: >= 2 and <= 6"},
          {"\"compression\": {\"half_force\": \"800 N\", \"exponent\": 3},\n", "\n", 1, "compression",
           "is required with contact"},
          {"\"height\": \"0.64 mm\"", "\"contact\": false, \"height\": \"0.64 mm\"", 13, "compression",
           "goes with contact"},
          {"\"0.64 mm\"", "0", 14, "height", "allowed: > 0"},
          {"\"height\": \"0.64 mm\"", "\"friction\": {\"coefficient\": -0.1}, \"height\": \"0.64 mm\"", 14,
           "friction.coefficient", "allowed: >= 0 and <= 10"},
          {"\"height\": \"0.64 mm\"", "\"friction\": {\"stick_stiffness\": 1}, \"height\": \"0.64 mm\"", 14,
           "friction.coefficient", "is required"},
          {"\"height\": \"0.64 mm\"",
           "\"friction\": {\"coefficient\": 0.3, \"stick_stiffness\": 0}, \"height\": \"0.64 mm\"", 14,
           "friction.stick_stiffness", "allowed: > 0"},
          {"\"compression\": {\"half_force\": \"800 N\", \"exponent\": 3}",
           "\"contact\": false, \"friction\": {\"coefficient\": 0.3}", 13, "friction", "goes with contact"},
          {"\"height\": \"0.64 mm\"", "\"touch\": \"width\", \"height\": \"0.64 mm\"", 14, "touch", "axis or section"},
          {"\"height\": \"0.64 mm\"", "\"extent\": \"half\", \"height\": \"0.64 mm\"", 14, "extent", "full or quarter"},
          {"{\"pattern\": \"plain\"}", "{\"pattern\": \"twill\", \"over\": 1, \"under\": 2}, \"extent\": \"quarter\"",
           4, "extent", "must be full unless the weave is plain"},
          {"\"compression\": {\"half_force\": \"800 N\", \"exponent\": 3}",
           "\"contact\": false, \"touch\": \"section\"", 13, "touch", "goes with contact"},
          // Loads.
          {"\"name\": \"one\"", "\"name\": \"both\"", 17, "loads[1].name", "used twice"},
          {"\"name\": \"one\"", "\"name\": \"an other\"", 17, "loads[1].name", "allowed: letters"},
          {"{\"extension\": 0.04}, \"steps\": 4", "{\"extension\": 0.04}, \"steps\": 0", 16, "loads[0].steps",
           "allowed: >= 1"},
          {"{\"extension\": 0.04}, \"steps\": 4", "{\"extension\": -0.04}, \"steps\": 4", 16,
           "loads[0].biaxial.extension", "allowed: > 0"},
          {"\"biaxial\": {\"extension\": 0.04}", "\"biaxial\": {\"extension\": 1, \"ratio\": -0.6}", 16,
           "loads[0].biaxial.ratio", "by less than 0.5"},
          {"\"biaxial\": {\"extension\": 0.04}", "\"pull\": {}", 16, "loads[0].pull", "unknown key"},
          {", \"biaxial\": {\"extension\": 0.04}", "", 16, "loads[0]", "one of biaxial"},
          {"\"biaxial\": {\"extension\": 0.04}", "\"shear\": {\"shear\": 0.8, \"extension\": -0.3}", 16,
           "loads[0].shear.shear", "allowed: below 1 + extension"},
          {"\"5 1/m\"", "\"4 1/mm\"", 18, "loads[2].bending.curvature", "allowed: below"},
          {"\"10 deg\"", "\"90 deg\"", 19, "loads[3].trellis.angle", "allowed: >= -80.2141 and <= 80.2141 deg"},
          {"\"height\": \"0.64 mm\"", "\"faces\": \"held\"", 18, "loads[2].bending", "do not bend"},
          {"\"height\": \"0.64 mm\"", "\"extent\": \"quarter\"", 18, "loads[2].bending", "allowed with extent full"},
          {"\"height\": \"0.64 mm\"", "\"yarns\": \"truss\"", 22, "solver.pieces_per_spacing", "goes with yarns rod"},
          {"\"height\": \"0.64 mm\",", "\"yarns\": \"beam\",", 14, "yarns", "allowed: rod, solid or truss"},
          // The rest.
          {"[1e9, 3e9]", "[1e9, 0]", 21, "bars[0].young[1]", "allowed: > 0"},
          {"[1e9, 3e9]", "[1e9]", 21, "bars[0].young", "1 values for 2 pieces"},
          {"\"pieces_per_spacing\": 8", "\"pieces_per_spacing\": 9", 22, "solver.pieces_per_spacing", "is odd"},
          {"\"pieces_per_spacing\": 8", "\"pieces_per_spacing\": 2", 22, "solver.pieces_per_spacing", "allowed: >= 4"},
          {"\"output\": {", "\"output\": {\"shapes\": \"none\", ", 23, "output.pictures", "need a shape"},
          {"\"path\": \"both\"", "\"path\": \"bothe\"", 23, "output.pictures[0].path", "allowed: bent, both, one"},
      });
}

const std::string truss_example = R"json({
  "kind": "cell", "name": "truss", "yarns": "truss",
  "weave": {"pattern": "plain"},
  "weft": {"spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.24 mm", "half_thickness": "0.16 mm", "moduli": {"young": "84.63 GPa", "axial_shear": "0.244 GPa"}},
  "compression": {"half_force": "800 N"},
  "loads": [{"name": "pull", "biaxial": {"extension": 0.04}}]
})json";

TEST(MalformedCell, WhatATrussCannotDo) {
  expectRefused(
      truss_example,
      {
          {"{\"pattern\": \"plain\"}", "{\"pattern\": \"twill\", \"over\": 2, \"under\": 2}", 3, "weave.pattern",
           "allowed with yarns truss: plain"},
          {"\"amplitude\": \"0.16 mm\"", "\"amplitude\": \"0.18 mm\"", 4, "weft.amplitude", "allowed: within 1 %"},
          {"\"compression\": {\"half_force\": \"800 N\"}", "\"contact\": false", 5, "contact",
           "allowed with yarns truss"},
          {"\"compression\"", "\"faces\": \"held\", \"compression\"", 5, "faces", "goes with yarns rod"},
          {"\"compression\"", "\"extent\": \"quarter\", \"compression\"", 5, "extent", "goes with yarns rod"},
          {"\"compression\"", "\"touch\": \"section\", \"compression\"", 5, "touch", "goes with yarns rod"},
          {"\"compression\"", "\"friction\": {\"coefficient\": 0.3}, \"compression\"", 5, "friction",
           "goes with yarns rod"},
          {"\"biaxial\": {\"extension\": 0.04}", "\"trellis\": {\"angle\": 0.1}", 6, "loads[0].trellis",
           "allowed with yarns truss: biaxial or uniaxial"},
      });
}

const std::string solid_example = R"json({
  "kind": "cell", "name": "solid", "yarns": "solid",
  "weave": {"pattern": "plain"},
  "weft": {"spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.24 mm", "half_thickness": "0.16 mm",
           "moduli": {"young": "84.63 GPa", "axial_shear": "0.244 GPa", "transverse_young": "1.34 GPa", "poisson_axial": 0.3}},
  "solids": {"across": 2, "along": 5},
  "loads": [{"name": "pull", "biaxial": {"extension": 0.04}}]
})json";

TEST(MalformedCell, WhatSolidsCannotDo) {
  const std::string moduli =
      R"("moduli": {"young": "84.63 GPa", "axial_shear": "0.244 GPa", "transverse_young": "1.34 GPa", "poisson_axial": 0.3})";
  expectRefused(
      solid_example,
      {
          // Constants of no stable material.
          {"\"poisson_axial\": 0.3", "\"poisson_axial\": 5, \"poisson_transverse\": 0.3", 5,
           "weft.moduli.poisson_axial", "is not allowed: between -4."},
          {"\"poisson_axial\": 0.3", "\"poisson_axial\": 0.3, \"poisson_transverse\": 1", 5,
           "weft.moduli.poisson_transverse", "-1 to 1, both excluded"},
          {"\"1.34 GPa\"", "0", 5, "weft.moduli.transverse_young", "allowed: > 0"},
          {", \"transverse_young\": \"1.34 GPa\"", "", 5, "weft.moduli", "is required with yarns solid"},
          {", \"poisson_axial\": 0.3", "", 5, "weft.moduli", "is required with yarns solid"},
          {moduli, R"("isotropic": {"young": "84 GPa", "poisson": 0.5})", 5, "weft.isotropic.poisson",
           "allowed: > -1 and < 0.5"},
          {moduli,
           R"("section": {"stretch": 1, "shear_across": 1, "shear_through": 1, "torsion": 1, "bending_through": 1, "bending_in_plane": 1})",
           5, "weft.section", "allowed with yarns solid: moduli or isotropic"},
          // The mesh.
          {"\"along\": 5", "\"along\": 6", 6, "solids.along", "allowed: odd numbers"},
          {"\"along\": 5", "\"along\": 3", 6, "solids.along", "allowed: >= 5"},
          {"\"across\": 2", "\"across\": 17", 6, "solids.across", "allowed: >= 2 and <= 16"},
          {"{\"across\": 2, \"along\": 5}", "{\"across\": 16, \"along\": 63}", 6, "solids.across",
           "allowed: at most 60000"},
          // What it does not go with.
          {"\"yarns\": \"solid\"", "\"yarns\": \"rod\", \"contact\": false", 6, "solids", "goes with yarns solid"},
          {"\"solids\"", "\"compression\": {\"half_force\": \"5 N\"}, \"solids\"", 6, "compression",
           "goes with yarns rod or truss"},
          {"\"solids\"", "\"solver\": {\"pieces_per_spacing\": 8}, \"solids\"", 6, "solver.pieces_per_spacing",
           "with yarns solid: solids.along"},
          {"\"solids\"", "\"solver\": {\"iterations\": 8}, \"solids\"", 6, "solver.iterations",
           "with yarns solid: solids.iterations"},
          {"\"solids\"", "\"friction\": {\"coefficient\": 0.3, \"stick_stiffness\": 1}, \"solids\"", 6,
           "friction.stick_stiffness", "with yarns solid: solids.penalty"},
          {"\"solids\": {", "\"friction\": {\"coefficient\": 0.3}, \"solids\": {\"contact_method\": \"multipliers\", ",
           6, "solids.contact_method", "know no friction"},
          {"\"solids\": {", "\"friction\": {\"coefficient\": 0.3}, \"solids\": {\"contact_method\": \"penalty\", ", 6,
           "solids.contact_method", "allowed with friction"},
          {"{\"pattern\": \"plain\"}", "{\"pattern\": \"twill\", \"over\": 2, \"under\": 2}, \"extent\": \"quarter\"",
           3, "extent", "must be full unless the weave is plain"},
          {"\"biaxial\": {\"extension\": 0.04}", "\"bending\": {\"curvature\": 1, \"direction\": 0}", 7,
           "loads[0].bending", "cells of solids stay flat"},
      });
  expectRefused(cell_example, {{"\"path\": \"both\"", "\"path\": \"both\", \"field\": \"pressure\"", 23,
                                "output.pictures[0].field", "allowed with yarns rod or truss"}});
}

/// Refused before anything of that size is built.
TEST(MalformedCell, TooMuchIsCountedFirst) {
  std::string matrix = "[";
  for (int j = 0; j < 64; ++j) {
    matrix += j == 0 ? "[" : ", [";
    for (int i = 0; i < 64; ++i) matrix += std::string(i == 0 ? "" : ", ") + ((i + j) % 2 == 0 ? "1" : "0");
    matrix += "]";
  }
  matrix += "]";
  expectRefused(cell_example, {{"\"pattern\": \"plain\"", "\"pattern\": \"matrix\", \"matrix\": " + matrix, 22,
                                "solver.pieces_per_spacing", "allowed: at most 40000"}});
}

}  // namespace
}  // namespace gambeson
