/// Every way to get a structure's case wrong says where and why.

#include "unit/cases/malformed.hpp"
#include "unit/cases/structure/example.hpp"

namespace gambeson {
namespace {

TEST(MalformedStructure, EachSaysFileLineKeyAndReason) {
  expectRefused(
      structure_example,
      {
          // Kinds and keys.
          {"\"static\"", "\"statics\"", 2, "kind", "allowed: wear, static, dynamic, modal or cell"},
          {"\"static\"", "3", 2, "kind", "expected one of"},
          {"\"steps\"", "\"step\"", 29, "solver.step", "did you mean \"steps\"?"},
          {"\"clamp\"", "\"clamped\"", 20, "supports[0].clamped", "did you mean \"clamp\"?"},
          {"\"young2\": 1100, \"shear\": 660, \"poisson12\": 0.25},", "\"young2\": 1100, \"poisson12\": 0.25},", 15,
           "material.laminate.plies[0].shear", "is required"},
          {"\"name\": \"example\",", "", 1, "name", "is required"},
          {"{\"gravity\": [0, 0, -9.81]}", "{}", 24, "loads[0]", "one of force, force_per_length"},
          // Types and numbers.
          {"\"clamp\": true", "\"clamp\": 1", 20, "supports[0].clamp", "expected true or false, not the number 1"},
          {"\"hold\": \"xyz\"", "\"hold\": \"abc\"", 20, "supports[0].hold", "allowed: x, y, z"},
          {"\"hold\": \"xyz\"", "\"hold\": [[1, 0, 0], [1, 1, 0]]", 20, "supports[0].hold[1]", "right angles"},
          {"\"width\": 2", "\"width\": -2", 5, "sheet.plate.width", "out of range; allowed: > 0"},
          {"\"width\": 2", "\"width\": NaN", 5, "sheet.plate.width", "invalid literal"},
          {"\"width\": 2", "\"width\": \"nan m\"", 5, "sheet.plate.width", "not a finite number"},
          {"\"width\": 2", "\"width\": \"2 kg\"", 5, "sheet.plate.width", "wrong unit"},
          {"[1, 0.5], \"force\"", "[1, 1.5], \"force\"", 26, "loads[2].point[1]",
           "out of range; allowed: >= 0 and <= 1"},
          {"[1, 0.5], \"force\"", "[1], \"force\"", 26, "loads[2].point", "expected a list of two numbers"},
          {"\"gravity\": [0, 0, -9.81]", "\"gravity\": -9.81", 24, "loads[0].gravity", "list of three numbers"},
          // Refinement.
          {"\"degree\": 2, \"cells_u\"", "\"degree\": 1, \"cells_u\"", 6, "sheet.degree", "allowed: >= 2"},
          {"\"cells_u\": 8", "\"cells_u\": 0", 6, "sheet.cells_u", "allowed: >= 1"},
          {"\"cells_u\": 8", "\"cells_u\": 8.5", 6, "sheet.cells_u", "whole number"},
          {"\"cells_u\": 8", "\"split\": 8", 6, "sheet.split", "goes with nurbs and file"},
          {"[0.3]", "[1.0]", 6, "sheet.refine_u[0]", "allowed: > 0 and < 1"},
          {"[0.3]", "[0.3, 0.3, 0.3]", 6, "sheet.refine_u", "multiplicity"},
          {"[0.3]", "0.3", 6, "sheet.refine_u", "expected a list of numbers"},
          {"[0, 1, 0]},", "[1, 1, 0]},", 5, "sheet.plate.axis_v", "not at right angles"},
          // Trimming.
          {"\"radius\": 0.2", "\"radius\": 0.6", 8, "sheet.trim[0]", "leaves the patch"},
          {"\"center\": [0.5, 0.5]", "\"center\": [5, 0.5]", 8, "sheet.trim[0]", "leaves the patch"},
          {"\"radius\": 0.2", "\"radius\": 0", 8, "sheet.trim[0].circle.radius", "allowed: > 0"},
          {"[0.5, 0.5], \"radius\"", "[1.2, 0.5], \"radius\"", 9, "sheet.trim[1]", "may not cross"},
          {"[1.6, 0.3], [1.6, 0.7], [1.2, 0.7]", "[1.6, 0.7], [1.6, 0.3], [1.2, 0.6]", 9, "sheet.trim[1]",
           "may not cross"},
          {", [1.6, 0.7], [1.2, 0.7]]", "]", 9, "sheet.trim[1].polygon.points", "at least 3"},
          {"[1.6, 0.7], [1.2, 0.7]]", "[1.4, 0.3]]", 9, "sheet.trim[1]", "encloses nothing"},
          {"{\"circle\": {\"center\": [0.5, 0.5], \"radius\": 0.2}}",
           "{\"loop\": {\"curves\": [{\"degree\": 1, \"knots\": [0, 0, 1, 2, 2], \"points\": [[0.3, 0.3], [0.7, 0.3], "
           "[0.7, 0.7]]}]}}",
           8, "sheet.trim[0]", "end"},
          {"{\"circle\": {\"center\": [0.5, 0.5], \"radius\": 0.2}}",
           "{\"loop\": {\"curves\": [{\"degree\": 1, \"knots\": [0, 0, 1], \"points\": [[0.3, 0.3], [0.7, 0.3]]}]}}", 8,
           "sheet.trim[0].loop.curves[0].knots", "allowed: 4"},
          {"\"radius\": 0.2}}", "\"radius\": 0.2}, \"patch\": 3}", 8, "sheet.trim[0].patch", "there is no patch 3"},
          {"\"radius\": 0.2}}", "\"radius\": 0.2}, \"polygon\": {\"points\": []}}", 8, "sheet.trim[0].polygon",
           "excludes \"circle\""},
          // Fields.
          {"[[1, 1.5], [1, 1.5]]", "[[1, 1.5], [1]]", 11, "sheet.fields[0].thickness.values[1]", "has 1 values"},
          {"[[1, 1.5], [1, 1.5]]", "[[1, 1.5]]", 11, "sheet.fields[0].thickness.values", "too few for degree 1"},
          {"[[1, 1.5], [1, 1.5]]", "[[1, -1], [1, 1.5]]", 11, "sheet.fields[0].thickness.values[0][1]", "allowed: > 0"},
          // Material.
          {"\"poisson12\": 0.25, \"angle\"", "\"poisson12\": 1.9, \"angle\"", 16,
           "material.laminate.plies[1].poisson12", "below sqrt(E1 / E2)"},
          {", \"density\": 1000", "", 14, "material.laminate.density", "is required: mass per volume, for gravity"},
          {"\"density\": 1000}", "\"density\": 1000}, \"tension_field\": true", 17, "material.tension_field",
           "couples"},
          // Supports.
          {"{\"edge\": \"u0\", \"hold\"", "{\"edge\": \"w0\", \"hold\"", 20, "supports[0].edge", "is not an edge"},
          {"{\"edge\": \"u0\", \"hold\"", "{\"edge\": \"1.u0\", \"hold\"", 20, "supports[0].edge",
           "there is no patch 1"},
          {"\"edge\": \"u0\", \"hold\"", "\"corner\": \"u0v0\", \"hold\"", 20, "supports[0].clamp",
           "goes with an edge"},
          {"\"edge\": \"u0\", \"hold\"", "\"hold\"", 20, "supports[0]", "one of edge, point or corner is required"},
          {"\"hold\": \"xyz\", \"clamp\": true", "\"clamp\": false", 20, "supports[0]", "says nothing about the place"},
          {"\"move\": [0, 0, 0.1]", "\"move\": [0.1, 0, 0]", 21, "supports[1].move", "contradicts hold"},
          {"\"program\": \"up\"},\n    {\"point\"", "\"program\": \"pu\"},\n    {\"point\"", 25, "loads[1].program",
           "allowed: up"},
          {"{\"edge\": \"u1\", \"hold\": \"z\"", "{\"edge\": \"u0\", \"hold\": \"z\"", 21, "supports[1]",
           "contradicts the supports before it"},
          {"\"clamp\": true", "\"symmetry\": [1, 0, 0]", 20, "supports[0].symmetry", "already holds"},
          {"\"hold\": \"xyz\", \"clamp\": true", "\"symmetry\": [0, 1, 0]", 20, "supports[0]", "plane"},
          // Loads and programs.
          {"\"edge\": \"u1\", \"force\"", "\"force\"", 25, "loads[1].force", "give edge, point or corner"},
          {"\"point\": [1, 0.5], \"force\": [0, 1, 0]", "\"point\": [1, 0.5], \"moment\": 1", 26, "loads[2].edge",
           "is required"},
          {"\"gravity\": [0, 0, -9.81]", "\"edge\": \"u0\", \"pressure\": 1", 24, "loads[0].edge", "no meaning"},
          {"[0.5, 1], [1, 1]", "[1, 1], [0.5, 1]", 28, "programs.up[2]", "does not come after"},
          {"[[0, 0], [0.5, 1], [1, 1]]", "3", 28, "programs.up", "expected a list of pairs"},
          // Solver and output.
          {"\"steps\": 4", "\"linear\": true, \"arc_length\": true", 29, "solver.arc_length", "contradicts linear"},
          {"\"steps\": 4", "\"stop_factor\": 2", 29, "solver.stop_factor", "goes with"},
          {"\"tolerance\": 1e-9", "\"tolerance\": 0", 29, "solver.tolerance", "allowed: >= 1e-14"},
          {"\"name\": \"corner\"", "\"name\": \"tip\"", 31, "output.points[1].name", "used twice"},
          {"\"name\": \"corner\"", "\"name\": \"my corner\"", 31, "output.points[1].name", "allowed: letters"},
          {"\"name\": \"root\", \"edge\": \"u0\"", "\"name\": \"root\"", 32, "output.edges[0].edge", "is required"},
      });
}

const std::string dynamic_example = R"json({
  "kind": "dynamic",
  "name": "example",
  "sheet": {
    "cylinder": {"radius": 1, "length": 2, "end_angle": "360 deg"},
    "degree": 2, "cells_u": 8, "cells_v": 4
  },
  "material": {"isotropic": {"young": 1e6, "poisson": 0.3, "thickness": 0.01, "density": 1000}},
  "supports": [{"edge": "v0", "hold": "xyz", "move": [0, 0, 0.1], "program": "shake"}],
  "loads": [{"pressure": 10}],
  "programs": {"shake": [[0, 0], [0.1, 1]]},
  "solver": {"end": 0.5, "step": 0.01},
  "initial": {"noise": {"amplitude": 1e-4, "from": 2, "to": 5}},
  "output": {"points": [{"name": "top", "point": [0.25, 1]}]}
})json";

TEST(MalformedStructure, DynamicCasesAndClosedShapes) {
  expectRefused(
      dynamic_example,
      {
          {"\"cells_u\": 8", "\"cells_u\": 3", 6, "sheet.cells_u", "at least 4 for this arc"},
          {"\"360 deg\"", "\"400 deg\"", 5, "sheet.cylinder.end_angle", "<= 2 pi"},
          {"\"edge\": \"v0\"", "\"edge\": \"u0\"", 9, "supports[0].edge", "closed there and has no such edge"},
          {"\"radius\": 1", "\"radius\": 1, \"zero\": [1, 0, 0]", 5, "sheet.cylinder.zero", "not at right angles"},
          {", \"density\": 1000", "", 8, "material.isotropic.density", "in a dynamic case"},
          {", \"program\": \"shake\"", "", 9, "supports[0].program", "is required: the motion over time"},
          {", \"step\": 0.01", "", 12, "solver.step", "is required for implicit schemes"},
          {"\"step\": 0.01", "\"step\": 1", 12, "solver.step", "at most end"},
          {"\"step\": 0.01", "\"step\": 0.01, \"beta\": 0.3", 12, "solver.beta", "it goes with newmark"},
          {"\"step\": 0.01", "\"step\": 0.01, \"scheme\": \"newmark\", \"beta\": 0.1", 12, "solver.beta", "stable"},
          {"\"end\": 0.5", "\"end\": 0", 12, "solver.end", "allowed: > 0"},
          {"\"step\": 0.01", "\"step\": 0.01, \"scheme\": \"leapfrog\"", 12, "solver.scheme",
           "allowed: generalised_alpha, newmark, explicit, euler, symplectic_euler, rk2, rk4, implicit_euler or "
           "semi_implicit"},
          {"\"step\": 0.01", "\"scheme\": \"implicit_euler\"", 12, "solver.step",
           "which no step bounds; allowed: > 0 s"},
          {"\"step\": 0.01", "\"scheme\": \"rk2\"", 12, "solver.step", "without damping"},
          {"\"step\": 0.01", "\"step\": 0.01, \"substeps\": 3", 12, "solver.substeps", "it goes with semi_implicit"},
          {"\"step\": 0.01", "\"step\": 0.01, \"scheme\": \"rk4\", \"solve_tolerance\": 1e-3", 12,
           "solver.solve_tolerance", "it goes with implicit_euler and semi_implicit"},
          {"\"step\": 0.01", "\"step\": 0.01, \"scheme\": \"implicit_euler\", \"safety\": 0.5", 12, "solver.safety",
           "has no meaning for this scheme"},
          {"\"from\": 2", "\"from\": 7", 13, "initial.noise.to", "allowed: >= from"},
          {"\"initial\"", "\"initially\"", 13, "initially", "did you mean \"initial\"?"},
          {"\"point\": [0.25, 1]", "\"point\": [0.25, 1], \"patch\": 9", 14, "output.points[0].patch", "no patch 9"},
          {"\"dynamic\"", "\"modal\"", 13, "initial", "unknown key"},
      });
}

const std::string limited_example = R"json({
  "kind": "dynamic",
  "name": "example",
  "sheet": {"plate": {"width": 0.2, "height": 0.2}, "cells_u": 4, "cells_v": 4},
  "material": {"isotropic": {"young": 10000, "thickness": 0.001, "density": 100}},
  "supports": [{"edge": "v1", "hold": "xyz"}],
  "loads": [{"gravity": [0, -9.81, 0]}],
  "solver": {"scheme": "explicit", "end": 0.05},
  "strain_limit": {"mode": "upper_limit", "limit": 0.005, "max_projections": 9, "points": "threads"},
  "output": {"thread_strains": true}
})json";

const std::string touching_example = R"json({
  "kind": "dynamic",
  "name": "example",
  "sheet": {"plate": {"width": 0.2, "height": 0.2}, "cells_u": 4, "cells_v": 4},
  "material": {"isotropic": {"young": 10000, "thickness": 0.001, "density": 100}},
  "supports": [{"edge": "v1", "hold": "xyz"}],
  "loads": [{"gravity": [0, 0, -9.81]}],
  "solver": {"scheme": "explicit", "end": 0.05},
  "obstacles": [{"name": "ball", "sphere": {"radius": 0.1, "center": [0.1, 0.1, -0.2]}}],
  "contact": {"friction": 0.3},
  "output": {"points": [{"name": "tip", "corner": "u1v0"}]}
})json";

TEST(MalformedStructure, Contact) {
  expectRefused(
      touching_example,
      {
          {"\"scheme\": \"explicit\"", "\"step\": 0.01", 9, "obstacles", "goes with explicit steps"},
          {"{\"friction\": 0.3}", "{}", 10, "contact.friction", "is required"},
          {"  \"contact\": {\"friction\": 0.3},\n", "", 1, "contact", "is required where there is an obstacle"},
          {"\"friction\": 0.3", "\"friction\": -1", 10, "contact.friction", "allowed: >= 0"},
          {"\"friction\": 0.3", "\"friction\": 0.3, \"method\": \"forward_increment\"", 10, "contact.method",
           "allowed: together"},
          {"\"ball\"", "\"tip\"", 11, "output.points[0].name", "used twice"},
          {"\"ball\"", "\"a ball\"", 9, "obstacles[0].name", "letters, digits"},
          {"\"radius\": 0.1", "\"radius\": 0", 9, "obstacles[0].sphere.radius", "allowed: > 0"},
          {"{\"name\": \"ball\", \"sphere\": {\"radius\": 0.1, \"center\": [0.1, 0.1, -0.2]}}],\n  \"contact\": "
           "{\"friction\": 0.3",
           "],\n  \"contact\": {\"friction\": 0.3, \"self\": false", 10, "contact.self", "nothing to touch"},
          {"\"dynamic\"", "\"static\"", 9, "obstacles", "know no contact"},
          {"\"dynamic\"", "\"modal\"", 9, "obstacles", "know no contact"},
          {"\"center\": [0.1, 0.1, -0.2]}}],",
           "\"center\": [0.1, 0.1, -0.2]}}], \"strain_limit\": {\"mode\": \"equality\", "
           "\"method\": \"closest\"},",
           9, "strain_limit.method", "touches nothing"},
      });
}

TEST(MalformedStructure, StrainLimits) {
  expectRefused(
      limited_example,
      {
          {"\"upper_limit\"", "\"lower_limit\"", 9, "strain_limit.mode", "upper_limit or equality"},
          {"\"upper_limit\"", "true", 9, "strain_limit.mode", "expected one of"},
          {"\"mode\": \"upper_limit\", ", "", 9, "strain_limit.mode", "is required"},
          {"\"limit\": 0.005, ", "", 9, "strain_limit.limit", "is required for upper_limit"},
          {"\"upper_limit\"", "\"equality\"", 9, "strain_limit.limit", "has no meaning for equality"},
          {"\"limit\": 0.005", "\"limit\": -0.005", 9, "strain_limit.limit", "allowed: >= 0"},
          {"\"limit\": 0.005", "\"limit\": 2", 9, "strain_limit.limit", "<= 1"},
          {"\"limit\": 0.005", "\"limit\": \"0.5 mm\"", 9, "strain_limit.limit", "unit"},
          {"\"limit\": 0.005", "\"limit\": 0.005, \"tolerance\": 0", 9, "strain_limit.tolerance", ">= 1e-05"},
          {"\"max_projections\": 9", "\"max_projections\": 0", 9, "strain_limit.max_projections", ">= 1"},
          {"\"max_projections\"", "\"max_projection\"", 9, "strain_limit.max_projection", "did you mean"},
          {"\"threads\"", "\"cells\"", 9, "strain_limit.points", "threads, gauss or centres"},
          {"\"points\": \"threads\"", "\"method\": \"closest\"", 9, "strain_limit.method",
           "closest goes with mode equality"},
          {"\"max_projections\": 9", "\"stiffness\": 1", 9, "strain_limit.stiffness", ">= 100"},
          {"\"height\": 0.2}, \"cells_u\": 4, \"cells_v\": 4},\n", "\"height\": 0.2}, \"weft\": [1, 1, 0]},\n", 9,
           "strain_limit.points", "across its knot lines"},
          {"{\"mode\": \"upper_limit\", \"limit\": 0.005, \"max_projections\": 9, \"points\": \"threads\"}", "0.005", 9,
           "strain_limit", "expected an object"},
          {"\"scheme\": \"explicit\"", "\"step\": 0.01", 9, "strain_limit", "goes with explicit steps"},
          {"\"dynamic\"", "\"modal\"", 9, "strain_limit", "unknown key"},
          {"\"thread_strains\": true", "\"thread_strains\": 1", 10, "output.thread_strains", "expected true or false"},
      });
}

const std::string patches_example = R"json({
  "kind": "modal",
  "name": "example",
  "sheet": {
    "nurbs": {
      "patches": [
        {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
         "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]},
        {"degree": [1, 1], "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
         "points": [[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0]], "weights": [1, 1, 1, 1]}
      ],
      "seams": [{"a": "0.u1", "b": "1.u0"}]
    },
    "degree": 2, "split": 2
  },
  "material": {"isotropic": {"young": 1e6, "thickness": 0.01, "density": 1000}},
  "supports": [{"edge": "0.u0", "hold": "xyz", "clamp": true}],
  "solver": {"count": 3},
  "output": {"points": [{"name": "end", "point": [1, 1], "patch": 1}]}
})json";

TEST(MalformedStructure, PatchesOfYourOwn) {
  expectRefused(
      patches_example,
      {
          {"[[1, 0, 0], [2, 0, 0], [1, 1, 0], [2, 1, 0]]", "[[1, 0, 0], [2, 0, 0], [1, 1, 0]]", 9,
           "sheet.nurbs.patches[1]", "points"},
          {"\"weights\": [1, 1, 1, 1]", "\"weights\": [1, 1, 1, -1]", 10, "sheet.nurbs.patches[1].weights[3]",
           "allowed: > 0"},
          {"[[1, 0, 0], [2, 0, 0]", "[[1.5, 0, 0], [2, 0, 0]", 12, "sheet.nurbs.seams[0]", "the edges do not meet"},
          {"\"b\": \"1.u0\"", "\"b\": \"2.u0\"", 12, "sheet.nurbs.seams[0]", "there is no patch 2"},
          {"\"b\": \"1.u0\"", "\"b\": \"u0\"", 12, "sheet.nurbs.seams[0].b", "names the patch"},
          {"\"split\": 2", "\"cells_u\": 2", 14, "sheet.cells_u", "refined by split"},
          {"\"edge\": \"0.u0\"", "\"edge\": \"u0\"", 17, "supports[0].edge", "has 2 patches"},
          {", \"patch\": 1", "", 19, "output.points[0].patch", "is required: the sheet has 2 patches"},
          {"\"count\": 3", "\"count\": 3, \"at\": \"equilibrium\"", 18, "solver.at", "there is no load"},
          {"\"count\": 3", "\"count\": 0", 18, "solver.count", "allowed: >= 1"},
      });
}

}  // namespace
}  // namespace gambeson
