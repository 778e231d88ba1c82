/// Drafts as nodes: on the surface, moved with the control points, and joined where the draft is.

#include "core/cloth/draft/nodal_draft.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/cloth/springs/spring_cloth.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(NodalDraft, NodesLieOnTheSurfaceAtTheCornersOfCells) {
  const NurbsPatch curved = curvedPatch(2, 3, true);
  const NodalDraft nodal = nodalDraft(garmentOf({curved}, {}, plainFabric()));
  const NurbsPatch& nodes = nodal.garment.patches[0];
  const std::vector<double> us = breakpoints(curved.u), vs = breakpoints(curved.v);
  ASSERT_EQ(nodes.size(), static_cast<int>(us.size() * vs.size()));
  EXPECT_EQ(nodes.u.degree, 1);
  EXPECT_EQ(nodes.v.degree, 1);
  for (std::size_t j = 0; j < vs.size(); ++j)
    for (std::size_t i = 0; i < us.size(); ++i) {
      const Vec3 x = surfaceDerivatives(curved, us[i], vs[j])[0];
      EXPECT_LT(norm(nodes.points[i + us.size() * j] - x), 1e-15);
      // In the draft's own parameters.
      EXPECT_LT(norm(surfaceDerivatives(nodes, us[i], vs[j])[0] - x), 1e-15);
    }
}

TEST(NodalDraft, MovesWithTheControlPoints) {
  const Garment draft = fourPatches(2, 2, false, SeamKind::G1, 0, plainFabric());
  const SpringCloth c(draft, {7, 3, 0.5});
  const std::vector<Vec3> control = restPoints(draft);
  EXPECT_EQ(c.draftPoints(), static_cast<int>(control.size()));
  // An affine motion of the control points is the same of the nodes.
  const auto way = [](const Vec3& x) { return Vec3{0.1 * x.x - 0.2 * x.y + 1, 0.3 * x.z, x.x + 2}; };
  std::vector<Vec3> moves;
  for (const Vec3& x : control) moves.push_back(way(x));
  const std::vector<Vec3> nodes = c.fromDraft(moves);
  ASSERT_EQ(nodes.size(), c.rest().size());
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_LT(norm(nodes[i] - way(c.rest()[i])), 1e-13);
}

/// Positions alone are joined along smooth seams, so that nodes beside them are free; the net keeps the kind.
TEST(NodalDraft, JoinsPositionsAlongSmoothSeams) {
  const Garment draft = fourPatches(2, 2, false, SeamKind::G1, 0, plainFabric());
  const NodalDraft nodal = nodalDraft(draft);
  const SpringCloth c(draft, {7, 3, 0.5});
  int joined = 0;
  for (int i = 0; i < c.points(); ++i) {
    const int begin = c.map().T.offsets[static_cast<std::size_t>(i)],
              end = c.map().T.offsets[static_cast<std::size_t>(i) + 1];
    ASSERT_EQ(end - begin, 1);
    EXPECT_EQ(c.map().T.values[static_cast<std::size_t>(begin)], 1);
  }
  joined = c.points() - c.map().T.column_count;
  const auto& p = nodal.garment.patches;
  EXPECT_GT(joined, std::max(p[0].u.count(), p[0].v.count()));
  for (std::size_t k = 0; k < draft.seams.size(); ++k) EXPECT_EQ(nodal.garment.seams[k].kind, SeamKind::G1);
  for (const Seam& seam : heldAtNodes(nodal.garment).seams) EXPECT_EQ(seam.kind, SeamKind::C0);
}

}  // namespace
}  // namespace gambeson
