/// Faces as they go into CAD files and come back.

#include "cases/cad/cad_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "cases/cad/tidy.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// Quadratic in u, linear in v, curved and not even: 0.3 m x 0.2 m about the origin, with numbers that need all digits.
NurbsPatch bent(double shift_m) {
  NurbsPatch p{uniformKnots(2, 3), uniformKnots(1, 2), {}, {}};
  for (int j = 0; j < p.v.count(); ++j)
    for (int i = 0; i < p.u.count(); ++i) {
      const double u = i / (p.u.count() - 1.0), v = j / (p.v.count() - 1.0);
      p.points.push_back({0.3 * u + shift_m, 0.2 * v, 0.05 * std::sin(3 * (u + shift_m / 0.3) + 1.0 / 3)});
      p.weights.push_back(1);
    }
  return p;
}

std::filesystem::path placeFor(const char* name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gambeson_cad_file_test";
  std::filesystem::create_directories(folder);
  std::filesystem::remove(folder / name);
  return folder / name;
}

class Formats : public testing::TestWithParam<const char*> {};

TEST_P(Formats, FacesComeBackWithEveryControlPointAndTheirHoles) {
  const NurbsPatch whole = bent(0), holed = bent(0.5);
  CadShape shape;
  for (const CadFace& f : cadFaces("front", whole, {})) shape.faces.push_back(f);
  const Trim hole{{{circle({0.4, 0.6}, 0.2, 0.15, true)}}};
  for (const CadFace& f : cadFaces("back", holed, hole)) shape.faces.push_back(f);
  ASSERT_EQ(shape.faces.size(), 2u);
  const auto file = placeFor(GetParam());
  writeCad(file, "two faces", shape);
  const CadShape back = readCad(file);
  ASSERT_EQ(back.faces.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const NurbsPatch &a = shape.faces[k].patch, &b = back.faces[k].patch;
    if (std::string(GetParam()).ends_with(".step")) {
      EXPECT_EQ(back.faces[k].name, k == 0 ? "front" : "back");
    }
    EXPECT_EQ(a.u.degree, b.u.degree);
    ASSERT_EQ(a.u.knots.size(), b.u.knots.size());
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_LT(norm(a.points[i] - b.points[i]), 1e-12);
    const double area = areaOf(a, k == 0 ? Trim{} : hole);
    EXPECT_NEAR(areaOf(b, trimOf(back.faces[k])), area, 1e-6 * area);
    EXPECT_EQ(isWhole(back.faces[k]), k == 0);
  }
}

TEST_P(Formats, NeighboursAreSewn) {
  // A surface and its mirror image meet in the edge u = 1.
  const NurbsPatch left = bent(0);
  NurbsPatch right = bent(0);
  for (Vec3& x : right.points) x.x = 0.6 - x.x;
  CadShape shape;
  for (const auto& [name, patch] : {std::pair("left", left), std::pair("right", right)})
    for (const CadFace& f : cadFaces(name, patch, {})) shape.faces.push_back(f);
  const auto file = placeFor(GetParam());
  writeCad(file, "neighbours", shape);
  const CadShape back = readCad(file);
  ASSERT_EQ(back.seams.size(), 1u);
  EXPECT_NEAR(back.seams[0].length_m, 0.2, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Cad, Formats, testing::Values("a.step", "a.igs"),
                         [](const auto& p) { return std::string(p.param).substr(2); });

TEST(CadFile, OnlyStepAndIgesAreWritten) {
  EXPECT_THROW(writeCad("a.brep", "", {}), InputError);
  EXPECT_THROW(readCad("no_such_file.step"), InputError);
  EXPECT_THROW(readCad("a.obj"), InputError);
}

TEST(CadTidy, AnEllipseInAPlaneHasItsArea) {
  NurbsPatch p{
      uniformKnots(1, 1), uniformKnots(1, 1), {{0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0.4, 0.3, 0}}, {1, 1, 1, 1}};
  const Trim trim{{{circle({0.5, 0.5}, 0.4, 0.4, false)}}};
  const double exact = std::numbers::pi * 0.16 * 0.12;
  EXPECT_NEAR(areaOf(p, trim), exact, 1e-9 * exact);
}

TEST(CadTidy, FacesThatAreInsideOutAreTurned) {
  CadShape shape;
  CadFace f = cadFaces("panel", bent(0), {{{circle({0.4, 0.6}, 0.2, 0.15, true)}}}).at(0);
  f.area_m2 = areaOf(f.patch, trimOf(f));
  f.inside_out = true;
  shape.faces = {f};
  tidyFaces(shape);
  const NurbsPatch& p = shape.faces[0].patch;
  const auto before = surfaceDerivatives(f.patch, 0.3, 0.2), after = surfaceDerivatives(p, 0.2, 0.3);
  EXPECT_LT(norm(before[0] - after[0]), 1e-15);
  EXPECT_LT(norm(cross(before[1], before[2]) + cross(after[1], after[2])), 1e-15);
  EXPECT_FALSE(isWhole(shape.faces[0]));
}

TEST(CadTidy, BordersThatAreOpenOrDoNotFitAreRefusedByFace) {
  CadShape shape;
  CadFace f = cadFaces("panel", bent(0), {{{circle({0.4, 0.6}, 0.2, 0.15, true)}}}).at(0);
  f.area_m2 = 1.01 * areaOf(f.patch, trimOf(f));
  shape.faces = {f};
  try {
    tidyFaces(shape);
    FAIL() << "another area was taken";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "face 1 (panel)");
  }
  f.loops.back().back().points.back().x += 0.1;
  shape.faces = {f};
  EXPECT_THROW(tidyFaces(shape), InputError);
}

}  // namespace
}  // namespace gambeson
