#include "core/yarn/cell_faces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

WovenYarns cloth() { return {plainWeave(), {WovenYarn{1, 0.16, 0.24, 0.16}, WovenYarn{1.3, 0.16, 0.2, 0.16}}}; }

double apart(const Pose& a, const Pose& b) {
  return norm(a.origin - b.origin) + norm(a.rotation.a - b.rotation.a) + norm(a.rotation.b - b.rotation.b) +
         norm(a.rotation.c - b.rotation.c);
}

const CellLoad kLoads[] = {{},
                           {0.1, -0.05, 0.3, 0, 0},
                           {0, 0, 0, 0.4, 0},
                           {0.1, -0.05, 0.3, 0.4, 0.7},
                           {0.1, -0.05, 0.3, -1e-4, 2.1},
                           {-0.02, 0.04, -0.2, 1.5, -0.4}};

/// A load with one of its first four numbers moved.
CellLoad with(CellLoad load, int which, double by) {
  (which == 0 ? load.e11 : which == 1 ? load.e22 : which == 2 ? load.g12 : load.curvature_per_m) += by;
  return load;
}

TEST(CellFaces, StepsCommuteAndStretchAsTheLoadSays) {
  const WovenYarns yarns = cloth();
  for (const CellLoad& load : kLoads) {
    const CellFaces f = facesOf(yarns, load);
    EXPECT_LT(apart(f.step[0] * f.step[1], f.step[1] * f.step[0]), 1e-14);
    if (load.curvature_per_m != 0) continue;
    const Vec3 a = f.step[0].origin / yarns.period_m(along_weft), b = f.step[1].origin / yarns.period_m(along_warp);
    EXPECT_NEAR(0.5 * (dot(a, a) - 1), load.e11, 1e-15);
    EXPECT_NEAR(0.5 * (dot(b, b) - 1), load.e22, 1e-15);
    EXPECT_NEAR(dot(a, b), load.g12, 1e-15);
  }
  // A quarter of a cylinder: the cell bent upwards about axis 2.
  CellLoad quarter;
  quarter.curvature_per_m = 0.5 * std::numbers::pi / yarns.period_m(along_weft);
  const double R = 1 / quarter.curvature_per_m;
  const CellFaces f = facesOf(yarns, quarter);
  EXPECT_LT(norm(f.step[0].origin - Vec3{R, 0, R}), 1e-15);
  EXPECT_LT(norm(f.step[0].rotation * Vec3{1, 0, 0} - Vec3{0, 0, 1}), 1e-15);
  EXPECT_LT(norm(f.step[1].origin - Vec3{0, yarns.period_m(along_warp), 0}), 1e-15);
}

TEST(CellFaces, MotionsAreDerivatives) {
  const WovenYarns yarns = cloth();
  for (const CellLoad& load : kLoads) {
    const auto motions = faceMotions(yarns, load);
    for (int e = 0; e < 4; ++e) {
      const double h = 1e-5;
      const CellFaces here = facesOf(yarns, load), a = facesOf(yarns, with(load, e, -h)),
                      b = facesOf(yarns, with(load, e, h));
      for (int g = 0; g < 2; ++g) {
        EXPECT_LT(norm((b.step[g].origin - a.step[g].origin) / (2 * h) - motions[e].dt_m[g]), 1e-8) << e << g;
        const Mat3& R = here.step[g].rotation;
        const Vec3 da = (b.step[g].rotation * Vec3{1, 2, 3} - a.step[g].rotation * Vec3{1, 2, 3}) / (2 * h);
        EXPECT_LT(norm(da - cross(motions[e].spin_rad[g], R * Vec3{1, 2, 3})), 1e-8) << e << g;
      }
    }
    if (load.curvature_per_m != 0) continue;
    const auto second = faceCurvature(yarns, load);
    constexpr int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int v = 0; v < 6; ++v)
      for (int turn = 0; turn < 2; ++turn) {
        const int i = pairs[v][turn], j = pairs[v][1 - turn];
        const double h = 1e-5;
        const auto a = faceMotions(yarns, with(load, i, -h)), b = faceMotions(yarns, with(load, i, h));
        for (int g = 0; g < 2; ++g)
          EXPECT_LT(norm((b[j].dt_m[g] - a[j].dt_m[g]) / (2 * h) - second[v][g]), 1e-8) << v << g;
      }
  }
}

/// What is carried goes on to the next cell as it did before.
TEST(CellFaces, CarriedSectionsKeepTheirNeighbours) {
  const WovenYarns yarns = cloth();
  const std::vector<Pose> flat{{rotationAbout({0.6, 0, 0.8}, 0.3), {0.3, 0.9, 0.11}}};
  for (const CellLoad& load : kLoads) {
    const std::vector<Pose> here = carried(flat, {}, load);
    const CellFaces rest = facesOf(yarns, {}), faces = facesOf(yarns, load);
    for (int g = 0; g < 2; ++g) {
      const std::vector<Pose> next = carried(std::vector<Pose>{rest.step[g] * flat[0]}, {}, load);
      EXPECT_LT(apart(next[0], faces.step[g] * here[0]), 1e-14);
    }
    EXPECT_LT(apart(carried(here, load, {})[0], flat[0]), 1e-11);
  }
}

TEST(CellFaces, LoadsAreThoseOfTheThesis) {
  const CellLoad shear = shearAsPrinted(0.2, 1.01);
  EXPECT_NEAR(shear.e11, 0.5 * (1.01 * 1.01 + 0.04 - 1), 1e-16) << "shear as printed stretches too";
  EXPECT_NEAR(shear.g12, 2 * 1.01 * 0.2, 1e-16);
  const CellLoad biaxial = loadOf({1.2, 0, 0, 1.2});
  EXPECT_NEAR(biaxial.e11, 0.22, 1e-15);
  EXPECT_NEAR(biaxial.e22, 0.22, 1e-15);
  const CellLoad frame = trellis(0.3, 1.02);
  EXPECT_NEAR(frame.e11, 0.5 * (1.02 * 1.02 - 1), 1e-15);
  EXPECT_NEAR(frame.e22, frame.e11, 1e-15);
  EXPECT_NEAR(frame.g12, 1.02 * 1.02 * std::sin(0.3), 1e-15);
}

TEST(CellFaces, StrainsOfNoPlaneAreRefused) {
  const auto refused = [](const CellLoad& load, const std::string& key) {
    try {
      checkLoad(load);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
    }
  };
  refused({-0.5, 0, 0, 0, 0}, "load.e11");
  refused({0, std::nan(""), 0, 0, 0}, "load.e22");
  refused({0, 0, 1, 0, 0}, "load.g12");
  refused({0, 0, 0, INFINITY, 0}, "load.curvature");
  refused({0, 0, 0, 0, std::nan("")}, "load.direction");
  EXPECT_NO_THROW(checkLoad({0.2, 0.3, -0.9, 5, 1}));
}

}  // namespace
}  // namespace gambeson
