/// Quadratic hinges where folds are small: plates, beams and stable steps are those of hinges. What they refuse.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/motion/structure_motion.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"
#include "quadratic_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::unique_ptr<TriangleCloth> plate(BendingElements bending, int nu, int nv, double width, double height,
                                     MeshKind kind) {
  MeshDraft draft = flatTriangles(nu, nv, width, height, linear(), kind, 0.15);
  draft.bending = bending;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  return std::make_unique<TriangleCloth>(std::move(garments));
}

/// The lowest frequencies of a free plate beyond the rigid ones [rad/s].
std::vector<double> frequencies(BendingElements bending, MeshKind kind) {
  const auto s = buildStructure(plate(bending, 10, 10, 0.2, 0.2, kind), {});
  std::vector<double> all;
  for (const Mode& m : naturalModes(*s, {}, 0, 10, true))
    if (m.omega_rad_per_s > 1e-2) all.push_back(m.omega_rad_per_s);
  return all;
}

TEST(QuadraticHinges, AFreePlateHasTheFrequenciesOfHinges) {
  for (const MeshKind kind : kKinds) {
    const std::vector<double> ours = frequencies(kQuadratic, kind), hinges = frequencies(kHinge, kind);
    ASSERT_GE(ours.size(), 3u);
    ASSERT_EQ(ours.size(), hinges.size());
    for (std::size_t k = 0; k < ours.size(); ++k) EXPECT_NEAR(ours[k] / hinges[k], 1, 1e-6);
  }
}

/// Deflection of the end of a strip that is clamped at the other, of a hundredth of its length.
double deflection(BendingElements bending, MeshKind kind) {
  const double length = 0.2, width = 0.05, load = 0.01 * length * 3 * 2e-5 / std::pow(length, 3);
  auto c = plate(bending, 16, 4, length, width, kind);
  StructureOptions o;
  const PatchEdge clamp{0, Side::u0, false}, tip{0, Side::u1, false};
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  o.constraints = c->mounting().holdEdge(clamp, all, {});
  for (LinearConstraint& l : c->mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
  o.dead = {{c->mounting().edgeForce(tip, {0, 0, load}), 0}};
  const int end = c->sidePoints(tip)[2];
  const auto s = buildStructure(std::move(c), o);
  double w = 0;
  const StaticReport r = solveStatic(*s, {.steps = 2}, [&](const StaticPoint& p) {
    w = controlPoints(*s, p.y, p.factor)[static_cast<std::size_t>(end)].z;
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  return w;
}

TEST(QuadraticHinges, ACantileverDeflectsAsOneOfHinges) {
  for (const MeshKind kind : kKinds) {
    const double hinges = deflection(kHinge, kind);
    EXPECT_GT(hinges, 5e-4);
    EXPECT_NEAR(deflection(kQuadratic, kind) / hinges, 1, 1e-3);
  }
}

/// The largest frequency of a sheet that bends and does little else [rad/s].
double fastest(BendingElements bending, MeshKind kind) {
  Fabric f = linear();
  f.young_weft_Pa = f.young_warp_Pa = f.shear_Pa = 1e-3;
  MeshDraft draft = flatTriangles(8, 8, 0.1, 0.1, f, kind, 0.15);
  draft.bending = bending;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  ModelOptions o;
  o.self_contact = false;
  const auto model = buildModel(std::make_unique<TriangleCloth>(std::move(garments)), o, {Vec3{}, 0}, {}, {});
  const UniformStage stage;
  StepWork work;
  State state = initialState(*model, stage, 0, work);
  return largestFrequency(*model, stage, state, 120, work).largest_rad_per_s;
}

/// The stable step sees them: where bending governs it, it is that of hinges.
TEST(QuadraticHinges, TheStableStepIsThatOfHinges) {
  for (const MeshKind kind : kKinds) EXPECT_NEAR(fastest(kQuadratic, kind) / fastest(kHinge, kind), 1, 0.01);
}

/// Key and reason of the refusal of a sheet that rises with `bend` x^2; empty: none.
std::string refusal(const Fabric& f, MeshRest rest, double bend) {
  MeshDraft g = flatTriangles(2, 2, 0.02, 0.02, f, MeshKind::single);
  for (Vec3& x : g.mesh.vertices) x.z += bend * x.x * x.x;
  g.rest = rest;
  g.bending = kQuadratic;
  try {
    shapes::clothOf(std::move(g));
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(QuadraticHinges, RefuseOtherLawsAndAnglesAtRest) {
  const auto says = [](const std::string& text, const char* part) {
    EXPECT_EQ(text.find("bending_elements: quadratic is for"), 0u) << text;
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  const BendingLaw others[] = {ZhengBending{{2e-5, 5e-5, 1e-5}, 40, 2}, StopBending{{2e-5, 3e-5, 1e-5}, 1e-5}};
  for (const BendingLaw& law : others)
    says(refusal(fabricOf(law), MeshRest::fabric, 0), "allowed with it: the bending law linear");
  says(refusal(linear(), MeshRest::shape, 1), "angles at rest");
  Fabric counts = linear();
  counts.rest_curvature_of_shape = true;
  says(refusal(counts, MeshRest::fabric, 1), "angles at rest");
  says(refusal(solid(), MeshRest::fabric, 1), "angles at rest");
  EXPECT_EQ(refusal(linear(), MeshRest::shape, 0), "");
  EXPECT_EQ(refusal(linear(), MeshRest::fabric, 1), "");
  EXPECT_EQ(refusal(linear(), MeshRest::flat, 1), "");
  Fabric rubbing = linear();  // friction in shear is the membrane's
  rubbing.shear_friction = {20, 0.05, 0};
  EXPECT_EQ(refusal(rubbing, MeshRest::fabric, 0), "");
}

}  // namespace
}  // namespace gambeson
