/// Panels that are closed around a wearer: what moves them, and where the closed garment may be.
#include "cases/wear/run/close_seams.hpp"

#include <gtest/gtest.h>

#include "cases/pattern/pattern_file.hpp"
#include "core/error.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

// clang-format off
const std::string skirt_case = R"json({
  "name": "skirt",
  "garment": {"pattern": {"path": "pattern.json", "cell": "60 mm"}},
  "fabric": {"thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa", "poisson": 0.2,
             "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.5},
  "air": {"drag": "0.3 kg/(m^2 s)", "velocity": [3, 0, 0]},
  "dressing": {"layer_by_layer": true, "settle": "0.1 s"}
})json";
// clang-format on

struct Skirt {
  Folder folder;
  Case read() {
    folder.write("pattern.json", patternText(region_patterns::skirt({})));
    return readCase(folder.write("case.json", skirt_case));
  }
  Case c = read();
  std::unique_ptr<Scenario> panels = standingPanels(c, c, 0);
  State lifted(double by_m) {
    StepWork work;
    State state = startOf(*panels, work);
    for (Vec3& p : state.p) p.z += by_m;
    return state;
  }
};

TEST(CloseSeams, NothingButResistanceHoldsPanels) {
  const Skirt skirt;
  const Model& m = *skirt.panels->model;
  ASSERT_FALSE(m.sewing.empty());
  for (std::size_t i = 0; i < m.mass_kg.size(); ++i) ASSERT_NEAR(m.drag_kg_per_s[i], 20 * m.mass_kg[i], 1e-12);
  EXPECT_EQ(norm(skirt.panels->stage->air(skirt.panels->start_s)), 0);
  EXPECT_EQ(m.contact.friction.still, 0);
}

TEST(CloseSeams, AGarmentThatHasLeftItsWearerIsNotWorn) {
  Skirt skirt;
  for (const double by_m : {-0.14, 0.0, 0.14}) EXPECT_NO_THROW(requireWorn(*skirt.panels, skirt.lifted(by_m))) << by_m;
  for (const auto& [by_m, text] : {std::pair(0.16, "16 cm higher"), {-0.16, "16 cm lower"}}) try {
      requireWorn(*skirt.panels, skirt.lifted(by_m));
      ADD_FAILURE() << by_m;
    } catch (const RunError& e) {
      EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace gambeson
