/// What `check` accepts a run can start from: what only building shows is said by both, at its place in the file.

#include <gtest/gtest.h>

#include "cases/structure/run.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/structure/example.hpp"

namespace gambeson {
namespace {

/// A sheet beside a woman who stands; line 3 has the garment, line 6 the dressing.
const std::string worn = R"({
  "name": "worn",
  "garment": {"sheet": {"width": "20 cm", "height": "20 cm", "cells_u": 4, "cells_v": 4, "corner": [1, 0, 1]}},
  "fabric": {"thickness": "1 mm", "density": "436 kg/m^3", "young": "1.2 MPa", "poisson": 0.3, "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "human": {"manikin": "female_p50", "motion": {"stand": {"duration": "10 ms"}}},
  "dressing": {"settle": 0},
  "contact": {"friction": 0.2}
})";
const std::string sheet =
    R"("sheet": {"width": "20 cm", "height": "20 cm", "cells_u": 4, "cells_v": 4, "corner": [1, 0, 1]})";

/// Whatever f refuses must be refused there, with these words.
template <class F>
void expectSaid(F f, const std::filesystem::path& file, int line, const std::string& key, const std::string& words) {
  try {
    f();
    ADD_FAILURE() << key << ": accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, file.string()) << e.what();
    EXPECT_EQ(e.where().line, line) << e.what();
    EXPECT_EQ(e.where().key, key) << e.what();
    EXPECT_NE(e.reason().find(words), std::string::npos) << e.what();
  }
}

struct Bad {
  std::string from, to;
  int line;
  const char *key, *words;
};

TEST(CheckBuilds, WhatARunOfClothingRefuses) {
  const Folder folder;
  const auto good = readCase(folder.write("good.json", worn));
  EXPECT_NO_THROW(checkRun(good));
  const auto shorts = [](const char* values) { return R"("shorts": {"cell": "50 mm", )" + std::string(values) + "}"; };
  for (const Bad& bad : {
           Bad{R"("width": "20 cm")", R"("width": 1e-300)", 3, "garment.sheet", "area"},
           Bad{R"("cells_u": 4, "cells_v": 4)", R"("cells_u": 1000, "cells_v": 1000)", 3, "garment.sheet",
               "at most 1,100,000 cells"},
           Bad{"}},\n  \"fabric\"", "}, \"samples_per_cell\": 8},\n  \"fabric\"", 0, "", ""},
           Bad{"}},\n  \"fabric\"", "}, \"samples_per_cell\": 1},\n  \"fabric\"", 3, "garment.samples_per_cell",
               "do not see every control point"},
           Bad{sheet, shorts(R"("inseam": "90 cm")"), 3, "garment.shorts.inseam", "cm on female_p50"},
           Bad{sheet, shorts(R"("inseam": "8 cm", "rise": "10 cm")"), 3, "garment.shorts.rise", "allowed: at least 11 cm on"},
           Bad{R"("poisson": 0.3)", R"("poisson": 0.3, "jam_area": 0.5)", 0, "", ""},
       }) {
    const Case c = readCase(folder.write("bad.json", replaced(worn, bad.from, bad.to)));
    if (bad.line == 0) {
      EXPECT_NO_THROW(checkRun(c)) << bad.to;
      continue;
    }
    expectSaid([&] { checkRun(c); }, c.file, bad.line, bad.key, bad.words);
    expectSaid([&] { buildScenario(c); }, c.file, bad.line, bad.key, bad.words);
  }
}

TEST(CheckBuilds, WhateverStandsInADressedState) {
  const Folder folder;
  folder.write("d.json", "");
  const Case c =
      readCase(folder.write("bad.json", replaced(worn, R"("settle": 0)", R"("settle": 0, "from": "d.json")")));
  const auto said = [&](const std::string& text, const char* words) {
    folder.write("d.json", text);
    try {
      checkRun(c);
      ADD_FAILURE() << text << " was accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, (folder.path() / "d.json").string()) << e.what();
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  said("{}", "format: is missing");
  said("[", "parse error");
  said(std::string(100000, '['), "nested deeper");
  const std::string turned =
      R"({"format": "gambeson dressed 1", "body": "0", "posture": {"joints": [], "origin_m": [0, 0, 0], "rotation": [ROTATION]}, "garments": []})";
  said(replaced(turned, "ROTATION", "1, 0, 0, 0, 1, 0, 0, 0, 1"), "another body");
  said(replaced(turned, "ROTATION", "1, 0, 0, 0, 1, 0, 0, 0, 0"), "posture.rotation: must turn");
  said(replaced(turned, "ROTATION", "1, 0, 0, 0, 1, 0, 0, 0, -1"), "posture.rotation: must turn");
  std::filesystem::remove(folder.path() / "d.json");
  ASSERT_EQ(std::system(("mkfifo '" + (folder.path() / "d.json").string() + "'").c_str()), 0);
  EXPECT_THROW(checkRun(c), InputError);
}

TEST(CheckBuilds, AWearerThatAGarmentDoesNotFit) {
  const Folder folder;
  folder.write("arm.urdf",
               R"(<robot name="a"><link name="upper"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
<link name="lower"><visual><geometry><sphere radius="0.1"/></geometry></visual></link><joint name="elbow" type="continuous">
<parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/></joint></robot>)");
  folder.write("t.csv", "time_s,elbow_rad\n0,0\n0.1,0.1\n");
  std::string text = replaced(worn, R"("manikin": "female_p50", "motion": {"stand": {"duration": "10 ms"}})",
                              R"("urdf": "arm.urdf", "motion": {"trajectory": {"file": "t.csv"}})");
  EXPECT_NO_THROW(checkRun(readCase(folder.write("good.json", text))));
  for (const auto& [garment, key] : {std::pair{R"("shorts": {"inseam": "15 cm"})", "garment.shorts"},
                                     {R"("shirt": {"cell": "50 mm"})", "garment.shirt"},
                                     {R"("skirt": {"length": "40 cm"})", "garment.skirt"}}) {
    const Case c = readCase(folder.write("bad.json", replaced(text, sheet, garment)));
    expectSaid([&] { checkRun(c); }, c.file, 3, key, "");
  }
}

TEST(CheckBuilds, WhatARunOfAStructureRefuses) {
  const Folder folder;
  EXPECT_NO_THROW(checkStructure(readStructureCase(folder.write("good.json", structure_example))));
  const std::string fabric = R"("fabric": {"thickness": "1 mm", "young": "1.2 MPa", "poisson": 0.3, "density": 436,
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}}, "tension_field": true})";
  const std::size_t begin = structure_example.find("\"laminate\""), end = structure_example.find("  \"supports\"");
  std::string text = structure_example;
  text.replace(begin, end - begin, fabric + ",\n");
  const auto file = folder.write("bad.json", text);
  expectSaid([&] { readStructureCase(file); }, file, 14, "material.fabric.jam_area", "tension field");
}

/// What divides by the mass refuses a sheet without any, and so does what checks the case.
TEST(CheckBuilds, AStructureWithoutMass) {
  const Folder folder;
  const std::string strip = R"({
  "kind": "KIND", "name": "strip", "sheet": {"plate": {"width": 2, "height": 1}, "cells_u": 2, "cells_v": 2},
  "material": {"isotropic": {"young": "1 MPa", "poisson": 0.3, "thickness": THICKNESS, "density": DENSITY}},
  "supports": [{"edge": "u0", "hold": "xyz"}], "solver": {SOLVER}, "output": {"pictures": []}
})";
  const auto read = [&](const char* kind, const char* solver, const char* thickness, const char* density) {
    std::string text = strip;
    for (const auto& [word, value] :
         {std::pair{"KIND", kind}, {"SOLVER", solver}, {"THICKNESS", thickness}, {"DENSITY", density}})
      text = replaced(text, word, value);
    return readStructureCase(folder.write("strip.json", text));
  };
  for (const auto& [kind, solver] : {std::pair{"dynamic", R"("scheme": "explicit", "end": "5 ms")"},
                                     {"dynamic", R"("step": "1 ms", "end": "5 ms")"},
                                     {"dynamic", R"("step": "1 ms", "end": "5 ms", "mass": "lumped")"},
                                     {"modal", R"("count": 1)"},
                                     {"modal", R"("count": 1, "mass": "lumped")"}}) {
    EXPECT_NO_THROW(checkStructure(read(kind, solver, "1e-3", "1000"))) << solver;
    const StructureCase c = read(kind, solver, "1e-3", "1e-322");
    expectSaid([&] { checkStructure(c); }, c.file, 3, "material", "no mass");
    expectSaid([&] { runStructure(c, {.out = folder.path() / "out", .threads = 1}); }, c.file, 3, "material",
               "no mass");
  }
}

}  // namespace
}  // namespace gambeson
