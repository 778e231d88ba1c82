/// Garments whose thickness, fibre angle or fabric varies over their patches: what a run makes of it, and what a case
/// may say.

#include <algorithm>
#include <cmath>

#include "cases/wear/case/factors.hpp"
#include "cases/wear/results/measure.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/cases/wear/scene/scene.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

/// A sheet that falls on a plane, 2.5 mm below it.
const std::string sheet = R"json({
  "name": "a sheet",
  "garment": {
    "sheet": {"width": 0.2, "height": 0.2, "cells_u": 8, "cells_v": 8, "corner": [-0.1, -0.1, "2.5 mm"]},
    "fields": [{"thickness": {"degree": 0, "values": [[1]]}}]
  },
  "fabric": {
    "thickness": "1 mm",
    "surface_density": "0.2 kg/m^2",
    "young_weft": "30 kPa", "young_warp": "60 kPa", "shear": "10 kPa",
    "poisson": 0.3,
    "bending": {"law": "zheng", "rigidity": "4e-6 N m", "kappa0": "30 1/m", "twist": "1e-6 N m"}
  },
  "obstacles": [{"name": "ground", "plane": {"point": [0, 0, 0], "size": 1}}],
  "supports": [{"pinned": {"s": 0, "t": 0}}],
  "contact": {"friction": 0.2},
  "air": {"drag": 1},
  "time": {"duration": 0.3}
})json";
const std::string plain_field = R"("fields": [{"thickness": {"degree": 0, "values": [[1]]}}])";

Case caseOf(const std::string& field, const std::vector<std::string>& overrides = {}) {
  const Folder folder;
  return readCase(folder.write("case.json", replaced(sheet, plain_field, field)), overrides);
}

/// The control points after `until_s`.
std::vector<Vec3> after(const Case& c, double until_s) {
  SceneRun scene(c);
  scene.run(until_s, [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  return scene.state.p;
}

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

TEST(GarmentFields, AUniformFieldIsTheFabricToTheBit) {
  const std::vector<Vec3> plain = after(caseOf("\"noise\": 0"), 0.1);
  EXPECT_EQ(after(caseOf(plain_field), 0.1), plain);
  EXPECT_EQ(after(caseOf(R"("fields": [{"patch": "patch_0", "fibre_angle": {"degree": 0, "values": [[0]]}}])"), 0.1),
            plain);
  // A field of ones that is not constant by rectangle is 1 to rounding.
  EXPECT_LT(
      farthest(after(caseOf(R"("fields": [{"patch": 0, "thickness": {"values": [[1, 1], [1, 1]]}}])"), 0.1), plain),
      1e-9);
  // Something moved, and a field of 1.01 is seen.
  EXPECT_GT(farthest(plain, after(caseOf("\"noise\": 0"), 1e-3)), 1e-3);
  EXPECT_GT(farthest(plain, after(caseOf(R"("fields": [{"thickness": {"degree": 0, "values": [[1.01]]}}])"), 0.1)),
            1e-6);
}

TEST(GarmentFields, TwiceTheThicknessIsAFabricTwiceAsThick) {
  const std::vector<Vec3> thick =
      after(caseOf("\"noise\": 0", {"fabric.thickness=2 mm", "fabric.surface_density=0.4 kg/m^2",
                                    "fabric.bending.rigidity=3.2e-5 N m", "fabric.bending.twist=8e-6 N m"}),
            0.1);
  EXPECT_EQ(after(caseOf(R"("fields": [{"thickness": {"degree": 0, "values": [[2]]}}])"), 0.1), thick);
}

TEST(GarmentFields, HalfTwiceAsThickWeighsAndKeepsOffSo) {
  const Case c = caseOf(R"("fields": [{"thickness": {"degree": 0, "values": [[1, 2]]}}])");
  SceneRun scene(c);
  const Model& m = scene.model;
  double mass = 0;
  for (const double kg : m.mass_kg) mass += kg;
  EXPECT_NEAR(mass, 0.2 * 0.04 * 1.5, 1e-12);
  const std::vector<GarmentMeasure> garments = garmentMeasuresOf(*scene.scenario);
  ASSERT_EQ(garments.size(), 1u);
  // Samples on the border between both carry half of each.
  EXPECT_NEAR(garments[0].mass_kg, 0.2 * 0.04 * 1.5, 0.05 * 0.2 * 0.04);
  EXPECT_DOUBLE_EQ(garments[0].least_thickness_m, 1e-3);
  EXPECT_DOUBLE_EQ(garments[0].largest_thickness_m, 2e-3);
  EXPECT_TRUE(garments[0].varies());
  // It comes to rest on its own thickness.
  scene.run(0.3, [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  std::vector<Vec3> x(m.surface.size());
  m.surface.W.multiply<Vec3>(scene.state.p, x);
  int thin = 0, thick = 0;
  for (int i = 0; i < m.surface.size(); ++i) {
    const double s = m.surface.parameters[static_cast<std::size_t>(i)].x;
    const auto at = static_cast<std::size_t>(i);
    EXPECT_DOUBLE_EQ(m.layer_m[at], s < 0.5 ? 1e-3 : 2e-3) << s;
    if (norm(x[at] - Vec3{-0.1, -0.1, 0.0025}) < 0.1) continue;  // near the corner that is held
    if (s > 0.3 && s < 0.7) continue;                            // a step in thickness is bridged
    (s < 0.5 ? thin : thick)++;
    EXPECT_NEAR(x[at].z, s < 0.5 ? 1e-3 : 2e-3, 3e-5) << s;
  }
  EXPECT_GT(thin, 10);
  EXPECT_GT(thick, 10);
}

TEST(GarmentFields, ATurnedFibreIsATurnedWeft) {
  const std::vector<Vec3> weft = after(caseOf("\"weft_angle\": 0.5"), 0.1);
  const std::vector<Vec3> fibre =
      after(caseOf(R"("fields": [{"fibre_angle": {"degree": 0, "values": [["0.5 rad"]]}}])"), 0.1);
  EXPECT_LT(farthest(weft, fibre), 1e-9);
  EXPECT_GT(farthest(weft, after(caseOf(plain_field), 0.1)), 1e-7);
}

TEST(GarmentFields, AMaterialFieldTakesTheOtherFabric) {
  const std::string other =
      R"("other_fabrics": [{"thickness": "3 mm", "surface_density": "0.9 kg/m^2", "young": "90 kPa",
    "poisson": 0.2, "bending": {"law": "zheng", "rigidity": "1e-5 N m", "kappa0": "30 1/m"}}], )";
  const Case c = caseOf(other + R"("fields": [{"material": {"degree": 0, "values": [[0], [1]]}}])");
  const SceneRun scene(c);
  double mass = 0;
  for (const double kg : scene.model.mass_kg) mass += kg;
  EXPECT_NEAR(mass, 0.02 * 0.2 + 0.02 * 0.9, 1e-12);
  for (int i = 0; i < scene.model.surface.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_DOUBLE_EQ(scene.model.layer_m[at], scene.model.surface.parameters[at].y < 0.5 ? 1e-3 : 3e-3);
  }
  // The factor of the thickness is of all fabrics.
  Case half = c;
  half.factors.thickness = 0.5;
  EXPECT_DOUBLE_EQ(withFactors(half).garments[0].other_fabrics[0].thickness_m, 1.5e-3);
  // Written and read again it is the same; a plain garment says nothing of fields.
  const Folder folder;
  const std::string written = writeCase(c);
  EXPECT_EQ(writeCase(readCase(folder.write("again.json", written))), written);
  EXPECT_NE(written.find("other_fabrics"), std::string::npos);
  EXPECT_EQ(writeCase(caseOf("\"noise\": 0")).find("fields"), std::string::npos);
}

TEST(GarmentFields, GarmentsOverEachOtherHaveTheirOwn) {
  const Folder folder;
  std::string two = replaced(sheet, "\"garment\": {\n", "\"garments\": [{\"name\": \"lower\",\n");
  two = replaced(two, "{\"pinned\": {", "{\"pinned\": {\"garment\": \"lower\", ");
  two = replaced(two, plain_field + "\n  },", R"("fields": [{"thickness": {"degree": 0, "values": [[2]]}}]
  }, {"name": "upper", "sheet": {"width": 0.1, "height": 0.1, "cells_u": 4, "cells_v": 4, "corner": [-0.05, -0.05, "6 mm"]},
      "fabric": {"thickness": "0.5 mm", "surface_density": "0.1 kg/m^2", "young": "30 kPa", "poisson": 0.3,
                 "bending": {"law": "linear", "rigidity": "4e-6 N m"}},
      "fields": [{"thickness": {"degree": 0, "values": [[1, 3]]}}]}],)");
  const Case c = readCase(folder.write("case.json", two));
  const SceneRun scene(c);
  const std::vector<GarmentMeasure> garments = garmentMeasuresOf(*scene.scenario);
  ASSERT_EQ(garments.size(), 2u);
  EXPECT_DOUBLE_EQ(garments[0].thickness_m, 2e-3);
  EXPECT_FALSE(garments[0].varies());
  EXPECT_DOUBLE_EQ(garments[1].least_thickness_m, 0.5e-3);
  EXPECT_DOUBLE_EQ(garments[1].largest_thickness_m, 1.5e-3);
  double mass = 0;
  for (const double kg : scene.model.mass_kg) mass += kg;
  EXPECT_NEAR(mass, 0.04 * 0.4 + 0.01 * 0.2, 1e-12);
}

/// Patches that are drafted by their names, and an entry for all others.
TEST(GarmentFields, PatchesByName) {
  const Case c = libraryCase(
      "shorts_walk",
      {R"(garment.fields=[{"thickness": {"degree": 0, "values": [[1]]}}, {"patch": "outer_left", "thickness": {"degree": 0, "values": [[2]]}}])",
       "garment.shorts.cell=44 mm"});
  const SceneRun scene(c);
  const Garment& g = shellOf(scene.model).garment();
  for (int i = 0; i < scene.model.surface.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool left = g.patch_names[static_cast<std::size_t>(scene.model.surface.patch[at])] == "outer_left";
    EXPECT_DOUBLE_EQ(scene.model.density_kg_per_m2[at], (left ? 2 : 1) * 1440 * 0.762e-3);
  }
}

TEST(GarmentFields, WhatDoesNotFitIsRefused) {
  expectRefused(
      sheet,
      {
          {"{\"thickness\": {\"degree\"", "{\"patch\": 1, \"thickness\": {\"degree\"", 5, "garment.fields[0].patch",
           "there is no patch 1; allowed: 0 to 0"},
          {"{\"thickness\": {\"degree\"", "{\"patch\": \"front\", \"thickness\": {\"degree\"", 5,
           "garment.fields[0].patch", "there is no patch \"front\"; allowed: patch_0, or 0 to 0"},
          {"{\"thickness\": {\"degree\"", "{\"patch\": -1, \"thickness\": {\"degree\"", 5, "garment.fields[0].patch",
           "out of range"},
          {"{\"thickness\": {\"degree\"", "{\"thicknes\": {\"degree\"", 5, "garment.fields[0].thicknes", "unknown key"},
          {"[[1]]", "[[0]]", 5, "garment.fields[0].thickness.values[0][0]", "allowed: > 0"},
          {"[[1]]", "[[-1]]", 5, "garment.fields[0].thickness.values[0][0]", "allowed: > 0"},
          {"[[1]]", "[]", 5, "garment.fields[0].thickness.values", "expected a list of rows"},
          {"[[1]]", "[[1, 2], [1]]", 5, "garment.fields[0].thickness.values[1]", "has 1 values, the first row 2"},
          {"\"degree\": 0", "\"degree\": 2", 5, "garment.fields[0].thickness.values", "too few for degree 2"},
          {"[[1]]}}]", "[[1]]}}, {\"thickness\": {\"degree\": 0, \"values\": [[1]]}}]", 5, "garment.fields[1].patch",
           "is required: another entry is of all patches already"},
          {"{\"thickness\": {\"degree\": 0, \"values\": [[1]]}}", "{\"material\": {\"degree\": 0, \"values\": [[1]]}}",
           5, "garment.fields[0].material.values", "the number of other materials"},
          {"\"fields\"",
           "\"other_fabrics\": [{\"thickness\": 1e-3, \"density\": 1, \"young\": 1, \"bending\": {\"law\": "
           "\"linear\", \"rigidity\": 1}}], \"fields\"",
           5, "garment.other_fabrics", "is of no use"},
          {"\"fields\": [{\"thickness\": {\"degree\": 0, \"values\": [[1]]}}]",
           "\"other_fabrics\": [{\"thickness\": 1e-3, \"density\": 1, \"young\": 1, \"bending\": {\"law\": \"linear\", "
           "\"rigidity\": 1}}], \"fields\": [{\"material\": {\"values\": [[0, 1], [0, 1]]}}]",
           5, "garment.fields[0].material", "only fabrics with the same laws can be mixed"},
      });
  // A belt's length is drafted from its tension.
  const auto belt = [](const std::string& tension) {
    return libraryCase("armour_stand", {"garments[1].fields=[{\"thickness\": {\"degree\": 0, \"values\": [[1, 2]]}}]",
                                        "garments[1].belt.tension=" + tension});
  };
  EXPECT_NO_THROW(belt("0 N"));
  EXPECT_THROW(belt("2 N"), InputError);
}

/// What stands in a file of regions, and comes back from it.
TEST(GarmentFields, RegionsAreReadAndWritten) {
  const std::string front =
      R"x(garment.regions=[{"name": "front", "parts": [{"patch": "trunk_left", "u": [0, 0.35]}], "thickness": 1.5}])x";
  const Case c = libraryCase("shorts_walk", {front});
  ASSERT_EQ(c.garments[0].regions.size(), 1u);
  EXPECT_EQ(c.garments[0].regions[0].parts[0].u[1], 0.35);
  EXPECT_NE(writeCase(c).find("\"regions\""), std::string::npos);
  EXPECT_EQ(writeCase(libraryCase("shorts_walk", {})).find("\"regions\""), std::string::npos);
  for (const auto& [from, to] :
       {std::pair("trunk_left", "hem"), std::pair("0.35", "0.355"), std::pair("[0, 0.35]", "[1, 0]"),
        std::pair("1.5", "0"), std::pair("[0, 0.35]", "[0]")})
    EXPECT_THROW(libraryCase("shorts_walk", {replaced(front, from, to)}), InputError) << to;
  // Names are of all garments.
  EXPECT_THROW(
      libraryCase("armour_stand", {R"(garments[0].regions=[{"name": "a"}])", R"(garments[2].regions=[{"name": "a"}])"}),
      InputError);
}

}  // namespace
}  // namespace gambeson
