#include "core/yarn/rod_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

RodCellDesign smallCell() {
  RodCellDesign d;
  d.yarns = {plainWeave(), {WovenYarn{1, 0.16, 0.24, 0.16}, WovenYarn{1.2, 0.16, 0.24, 0.16}}};
  d.section = {RodSection{10, 0.5, 0.4, 0.01, 0.03, 0.05}, RodSection{8, 0.3, 0.2, 0.02, 0.04, 0.06}};
  d.compression = {0.1, 3};
  d.pieces_per_spacing = 4;
  return d;
}

/// Anywhere near rest, yarns pressed together, faces strained and bent.
struct Somewhere {
  CellLoad load{0.03, -0.04, 0.1, 0.3, 0.6};
  CellFaces faces;
  std::vector<Pose> sections;
};
/// `slide`: of the yarns across themselves, so that they touch beyond a face of the cell; `squeeze`: of every other
/// yarn against the rest, so that neighbours touch.
Somewhere somewhere(const RodCell& cell, double slide = 0, double squeeze = 0) {
  Somewhere s;
  s.faces = facesOf(cell.yarns(), s.load);
  s.sections = carried(cell.rest(), {}, s.load);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  const int first_warp = cell.firstSection(along_warp, 0);
  for (int i = 0; i < cell.sections(); ++i) {
    Pose& p = s.sections[i];
    p.origin += 0.01 * Vec3{in(random), in(random), in(random)};
    // Crossings lie nearer than at rest, wherever the yarns are on top.
    p.origin.z -= (p.origin.z > 0 ? 1 : -1) * (i < first_warp ? 0.05 : 0.03);
    const bool weft = i < first_warp;
    const int yarn = (weft ? i : i - first_warp) / cell.sectionsOf(weft ? along_weft : along_warp);
    p.origin += (slide + (yarn % 2 == 0 ? squeeze : 0)) * (weft ? Vec3{0, 1, 0} : Vec3{1, 0, 0});
    p.rotation = turned(p.rotation, 0.1 * Vec3{in(random), in(random), in(random)});
  }
  return s;
}

/// Block b of the cell's unknowns moved along c.
void move(const RodCell& cell, Somewhere& s, int b, int c, double by) {
  Vec3 way{};
  way[c] = by;
  if (b >= 2 * cell.sections())
    s.faces.step[b - 2 * cell.sections()].origin += way;
  else if (b % 2 == 0)
    s.sections[b / 2].origin += way;
  else
    s.sections[b / 2].rotation = turned(s.sections[b / 2].rotation, way / cell.turnLength_m());
}

void expectDerivatives(const RodCell& cell, const std::vector<std::array<double, 2>>& moves) {
  for (const auto& [slide, squeeze] : moves) {
    const Somewhere here = somewhere(cell, slide, squeeze);
    CellAnswer answer, moved;
    cell.evaluate(here.faces, here.sections, answer);
    ASSERT_GT(answer.touching.size(), 8u);
    BlockMatrix K = cell.sparsity(cell.nearPairs(here.faces, here.sections, 0.05));
    cell.evaluate(here.faces, here.sections, answer, &K);
    double force = 0, force_error = 0, slope = 0, slope_error = 0;
    const double h = 1e-4;
    const auto at = [&](int b, int c, double by) {
      Somewhere s = here;
      move(cell, s, b, c, by);
      cell.evaluate(s.faces, s.sections, moved);
      return moved;
    };
    for (int b = 0; b < cell.blocks(); ++b)
      for (int c = 0; c < 3; ++c) {
        const CellAnswer m2 = at(b, c, -2 * h), m1 = at(b, c, -h), p1 = at(b, c, h), p2 = at(b, c, 2 * h);
        const double energy = (8 * (p1.energy_J - m1.energy_J) - (p2.energy_J - m2.energy_J)) / (12 * h);
        force = std::max(force, std::abs(answer.gradient[b][c]));
        force_error = std::max(force_error, std::abs(energy - answer.gradient[b][c]));
        // Places and faces: their derivatives are those of the gradient. (A turn's own axes turn with it.)
        for (int r = 0; r < cell.blocks(); ++r) {
          const bool places = b % 2 == 0 || b >= 2 * cell.sections();
          if (!places) continue;
          const long k = K.find(std::min(r, b), std::max(r, b));
          const Vec3 d = (8 * (p1.gradient[r] - m1.gradient[r]) - (p2.gradient[r] - m2.gradient[r])) / (12 * h);
          for (int i = 0; i < 3; ++i) {
            const double exact = k < 0 ? 0 : K.values[9 * k + (r <= b ? 3 * i + c : 3 * c + i)];
            slope = std::max(slope, std::abs(exact));
            slope_error = std::max(slope_error, std::abs(d[i] - exact));
          }
        }
      }
    EXPECT_LT(force_error, 1e-8 * force) << slide;
    EXPECT_LT(slope_error, 1e-7 * slope) << slide;
  }
}

TEST(RodCell, ForcesAndTangentAreDerivatives) {
  RodCellDesign design = smallCell();
  design.pieces_per_spacing = 6;
  expectDerivatives(RodCell(design), {{0, 0}, {-0.45, 0}, {0.45, 0}});
}

/// Wide warps in a straight weft.
RodCellDesign closeCell() {
  RodCellDesign d = smallCell();
  d.yarns.yarn = {WovenYarn{1, 0, 0.15, 0.08}, WovenYarn{1, 0.16, 0.47, 0.08}};
  d.touch = RodTouch::section;
  return d;
}

/// Pressed by their sections where they cross, and side by side within the cell and beyond its faces.
TEST(RodCell, ForcesAndTangentOfSectionsAreDerivatives) {
  RodCellDesign design = smallCell();
  design.pieces_per_spacing = 6;
  design.touch = RodTouch::section;
  expectDerivatives(RodCell(design), {{0, 0}, {-0.2, 0}, {0.2, 0}});
  expectDerivatives(RodCell(closeCell()), {{0, 0.12}, {0, -0.12}});
}

TEST(RodCell, SpinsOfTheFacesDoTheirWork) {
  RodCellDesign crossed = smallCell();
  crossed.touch = RodTouch::section;
  for (const auto& [design, slide, squeeze] : {std::tuple{smallCell(), 0.0, 0.0},
                                               {smallCell(), -0.45, 0.0},
                                               {smallCell(), 0.45, 0.0},
                                               {crossed, 0.2, 0.0},
                                               {closeCell(), 0.0, 0.12},
                                               {closeCell(), 0.0, -0.12}}) {
    const RodCell cell(design);
    const Somewhere here = somewhere(cell, slide, squeeze);
    CellAnswer answer, moved;
    cell.evaluate(here.faces, here.sections, answer);
    for (int g = 0; g < 2; ++g)
      for (int c = 0; c < 3; ++c) {
        const double h = 1e-4;
        Vec3 axis{};
        axis[c] = 1;
        const auto energy = [&](double by) {
          CellFaces faces = here.faces;
          faces.step[g].rotation = rotationAbout(axis, by) * faces.step[g].rotation;
          cell.evaluate(faces, here.sections, moved);
          return moved.energy_J;
        };
        const double work = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
        EXPECT_NEAR(work, answer.face_moment_Nm[g][c], 1e-8 * norm(answer.face_moment_Nm[g])) << slide << g << c;
      }
  }
}

/// Warps that lie close in a straight weft jam where the cloth is shortened to their width, and not before.
TEST(RodCell, NeighboursJamAtTheLockingSpacing) {
  RodCellDesign design = closeCell();
  design.pieces_per_spacing = 24;
  const RodCell cell(design);
  design.contact = false;
  const RodCell loose(design);
  const auto pressed = [&](double stretch) {
    const CellLoad load = loadOf({stretch, 0, 0, 1});
    const CellFaces faces = facesOf(cell.yarns(), load);
    const std::vector<Pose> sections = carried(cell.rest(), {}, load);
    CellAnswer with, without;
    cell.evaluate(faces, sections, with);
    loose.evaluate(faces, sections, without);
    return with.energy_J - without.energy_J;
  };
  EXPECT_EQ(pressed(1), 0);
  EXPECT_EQ(pressed(0.9405), 0) << "twice the half width is 0.94";
  EXPECT_GT(pressed(0.935), 0);
  EXPECT_GT(pressed(0.9), 5 * pressed(0.92));
}

TEST(RodCell, RestIsWithoutForceWhereverItStands) {
  RodCellDesign design = smallCell();
  for (const auto& [weave, touch] : {std::pair{plainWeave(), RodTouch::axis},
                                     {plainWeave(), RodTouch::section},
                                     {twillWeave(2, 2), RodTouch::axis},
                                     {twillWeave(2, 2), RodTouch::section},
                                     {satinWeave(5, 2), RodTouch::axis},
                                     {satinWeave(5, 2), RodTouch::section}}) {
    design.yarns.weave = weave;
    design.touch = touch;
    const RodCell cell(design);
    const Pose motion{rotationAbout({0.36, 0.48, 0.8}, 1.1), {3, -2, 1}};
    std::vector<Pose> sections;
    for (const Pose& p : cell.rest()) sections.push_back(motion * p);
    CellFaces faces = facesOf(cell.yarns(), {});
    for (Pose& g : faces.step) g = motion * g * inverse(motion);
    CellAnswer answer;
    cell.evaluate(faces, sections, answer);
    EXPECT_LT(answer.energy_J, 1e-26);
    for (const Vec3& f : answer.gradient) EXPECT_LT(norm(f), 1e-12);
  }
}

TEST(RodCell, YarnsHaveTheirLength) {
  const RodCell cell(smallCell());
  EXPECT_EQ(cell.sections(), 32);
  EXPECT_NEAR(cell.yarnLength_m(along_weft, 1), cell.yarns().arcLength_m(along_weft, 1, 0, 2.4), 1e-14);
  EXPECT_NEAR(cell.yarnLength_m(along_warp, 0), cell.yarns().arcLength_m(along_warp, 0, 0, 2.0), 1e-14);
  const RodAnswer rest = cell.pieceAt(facesOf(cell.yarns(), {}), cell.rest(), along_warp, 1, 7);
  EXPECT_LT(std::abs(rest.tension_N), 1e-14);
}

TEST(RodCell, DesignsOutOfRangeAreRefused) {
  const auto refused = [](const std::string& key, auto change) {
    RodCellDesign d = smallCell();
    change(d);
    try {
      RodCell cell(d);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
    }
  };
  refused("weft.section.stretch", [](RodCellDesign& d) { d.section[0].stretch_N = 0; });
  refused("warp.section.shear_through", [](RodCellDesign& d) { d.section[1].shear_through_N = std::nan(""); });
  refused("warp.section.torsion", [](RodCellDesign& d) { d.section[1].torsion_Nm2 = -1; });
  refused("compression.half_force", [](RodCellDesign& d) { d.compression.half_force_N = 0; });
  refused("pieces_per_spacing", [](RodCellDesign& d) { d.pieces_per_spacing = 5; });
  refused("pieces_per_spacing", [](RodCellDesign& d) { d.pieces_per_spacing = 258; });
  refused("weft.amplitude", [](RodCellDesign& d) { d.yarns.yarn[0].amplitude_m = 0.1; });
  refused("weave.matrix", [](RodCellDesign& d) { d.yarns.weave.warp_over = {1, 1, 1, 1}; });
}

}  // namespace
}  // namespace gambeson
