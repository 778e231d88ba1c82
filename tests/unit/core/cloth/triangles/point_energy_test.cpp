// Triangles refuse what they do not carry: laws that are an energy at a point.
#include <gtest/gtest.h>

#include <memory>

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/cloth/springs/spring_net.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/error.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/law_table.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(PointEnergy, IsCarriedByNoOtherCloth) {
  const Fabric fabric = withEnergy(plainFabric(), std::make_shared<const LawTable>(tableOf({}, 5, 3)));
  EXPECT_NE(whatSpringsLack(fabric), "");
  EXPECT_NE(whatShellLacks(fabric), "");
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1)}, {}, fabric);
  try {
    TriangleCloth({meshDraft(g, MeshKind{})});
    ADD_FAILURE() << "was taken";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "fabric.law");
  }
}

}  // namespace
}  // namespace gambeson
