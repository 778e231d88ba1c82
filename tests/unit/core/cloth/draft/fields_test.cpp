/// Functions over the parameter domain of a patch.

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/block_law.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(Fields, BilinearFieldReproducesItsBilinearFunction) {
  const auto f = [](double s, double t) { return 2 + 3 * s - t + 0.5 * s * t; };
  PatchField field{1, 4, 3, {}};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) field.values.push_back(f(i / 3.0, j / 2.0));
  validate(field);
  for (double s : {0.0, 0.1, 1.0 / 3, 0.77, 1.0})
    for (double t : {0.0, 0.5, 0.6, 1.0}) EXPECT_NEAR(fieldAt(field, {s, t}), f(s, t), 1e-14);
}

TEST(Fields, DegreeZeroIsAValuePerRectangle) {
  const PatchField field{0, 2, 3, {1, 2, 3, 4, 5, 6}};
  EXPECT_EQ(fieldAt(field, {0.25, 0.1}), 1);
  EXPECT_EQ(fieldAt(field, {0.75, 0.5}), 4);
  EXPECT_EQ(fieldAt(field, {1.0, 1.0}), 6);
}

TEST(Fields, SmoothFieldStaysWithinItsCoefficientsAndIsContinuous) {
  const PatchField field{2, 4, 3, {1, 2, 0, 3, 5, 1, 1, 2, 2, 2, 4, 1}};
  double last = fieldAt(field, {0, 0.4});
  for (int k = 1; k <= 400; ++k) {
    const double value = fieldAt(field, {k / 400.0, 0.4});
    EXPECT_GE(value, 0);
    EXPECT_LE(value, 5);
    EXPECT_LT(std::abs(value - last), 0.05);
    last = value;
  }
}

Garment sheetWithFields() {
  Garment g = garmentOf({flatPatch(uniformKnots(2, 4), uniformKnots(2, 4), 1, 1)}, {}, plainFabric());
  g.fields.resize(1);
  return g;
}

/// A homogeneous plate: membrane goes with the thickness, bending with its cube, mass with the thickness.
TEST(Fields, ThicknessScalesMassAndBending) {
  Garment g = sheetWithFields();
  g.fields[0].thickness = PatchField{1, 2, 2, {1, 2, 1, 2}};
  validateFields(g);
  const Vec2 right{g.patches[0].u.back(), 0.5 * g.patches[0].v.back()};
  const Fabric f = fabricAt(g, 0, right);
  EXPECT_DOUBLE_EQ(f.thickness_m, 2 * g.fabric.thickness_m);
  EXPECT_DOUBLE_EQ(rigidities(f).weft_Nm, 8 * rigidities(g.fabric).weft_Nm);
  EXPECT_DOUBLE_EQ(f.young_weft_Pa, g.fabric.young_weft_Pa);
  EXPECT_DOUBLE_EQ(surfaceDensityAt(g, 0, right), 2 * g.fabric.surfaceDensity());
  EXPECT_DOUBLE_EQ(surfaceDensityAt(g, 0, {g.patches[0].u.front(), 0}), g.fabric.surfaceDensity());
}

TEST(Fields, MaterialsAreChosenAndMixed) {
  Garment g = sheetWithFields();
  Fabric other = g.fabric;
  other.young_weft_Pa *= 3;
  g.other_fabrics.push_back(other);
  g.fields[0].material = PatchField{1, 2, 2, {0, 1, 0, 1}};
  validateFields(g);
  const double a = g.patches[0].u.front(), b = g.patches[0].u.back(), v = g.patches[0].v.front();
  EXPECT_DOUBLE_EQ(fabricAt(g, 0, {a, v}).young_weft_Pa, g.fabric.young_weft_Pa);
  EXPECT_DOUBLE_EQ(fabricAt(g, 0, {b, v}).young_weft_Pa, other.young_weft_Pa);
  const Voigt middle = pointLaw(fabricAt(g, 0, {0.5 * (a + b), v})).section.A, left = pointLaw(g.fabric).section.A,
              right = pointLaw(other).section.A;
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(middle[k], 0.5 * (left[k] + right[k]), 1e-12 * right[0]);
}

/// Moduli and Poisson's ratio of these two, averaged one by one, would not be a material: 2.5^2 > 1.
TEST(Fields, AMixtureOfTwoMaterialsIsAMaterial) {
  Garment g = sheetWithFields();
  g.fabric.young_weft_Pa = 1e6;
  g.fabric.young_warp_Pa = 1e4;
  g.fabric.poisson = 5;
  Fabric other = g.fabric;
  other.young_weft_Pa = 1e4;
  other.young_warp_Pa = 1e6;
  other.poisson = 0.05;
  g.other_fabrics.push_back(other);
  g.fields[0].material = PatchField{1, 2, 2, {0, 1, 0, 1}};
  validateFields(g);
  EXPECT_NO_THROW(Shell(g, widestKernels()));
}

TEST(Fields, WhatDoesNotFitIsRefused) {
  Garment g = sheetWithFields();
  const auto refused = [&](PatchField f, auto member, const char* key) {
    Garment bad = g;
    bad.fields[0].*member = f;
    try {
      validateFields(bad);
      FAIL() << key;
    } catch (const InputError& e) {
      EXPECT_NE(e.where().key.find(key), std::string::npos) << e.what();
    }
  };
  refused({1, 2, 2, {1, 1, 1}}, &PatchFields::thickness, "fields[0].thickness.values");
  refused({1, 2, 2, {1, 1, 0, 1}}, &PatchFields::thickness, "fields[0].thickness.values");
  refused({4, 5, 5, std::vector<double>(25, 1)}, &PatchFields::thickness, "fields[0].thickness.degree");
  refused({1, 1, 2, {1, 1}}, &PatchFields::fibre_angle, "fields[0].fibre_angle.values");
  refused({1, 2, 2, {1, 1, NAN, 1}}, &PatchFields::fibre_angle, "fields[0].fibre_angle.values");
  refused({0, 1, 1, {1}}, &PatchFields::material, "fields[0].material.values");
  Fabric laminated = g.fabric;
  laminated.law = Laminate{{{1e-3, 1e9, 1e9, 1e8, 0.3, 0}}};
  g.other_fabrics.push_back(laminated);
  refused({0, 1, 1, {0.5}}, &PatchFields::material, "fields[0].material");
  g.fields.resize(3);
  EXPECT_THROW(validateFields(g), InputError);
}

}  // namespace
}  // namespace gambeson
