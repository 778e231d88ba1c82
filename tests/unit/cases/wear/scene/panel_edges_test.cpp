/// Patterns in cases: their seams edited there, and edges of their panels held by name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/cases/malformed.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

const std::string hung_skirt = R"json({
  "name": "hung skirt",
  "garment": {"pattern": {"path": ")json" GAMBESON_SOURCE_DIR
                               R"json(/cases/library/garments/skirt_of_two_panels.json", "cell": "5 cm",
    "seams": [
      {"seam": "left side", "use": "opening", "open": true, "buttons": 2, "stiffness": 0},
      {"seam": "front.3", "remove": true},
      {"seam": "right", "a": ["back.1"], "b": ["front.3 reversed"], "stiffness": "2 mN"}
    ]}},
  "fabric": {"thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa", "poisson": 0.2,
             "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
  "supports": [
    {"fixed": {"edge": "front.waist"}},
    {"cord": {"edge": "back.2", "tension": "1 N"}}
  ],
  "contact": {"friction": 0.3},
  "time": {"duration": "10 ms"}
})json";

TEST(PanelEdges, AreHeldByTheirNames) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", hung_skirt));
  const auto s = buildScenario(c);
  const Model& m = *s->model;
  std::vector<Vec3> X(static_cast<std::size_t>(m.surface.size()));
  m.surface.W.multiply<Vec3>(m.cloth->rest(), X);
  // Samples all along the edge at the top of its panel, in their order, and no others.
  for (const std::size_t k : {0u, 1u}) {
    const std::vector<int>& at = s->supports[k].samples;
    const double x = k == 0 ? 0.2 : -0.22;
    ASSERT_GE(at.size(), 12u);
    for (const int i : at) {
      EXPECT_NEAR(X[static_cast<std::size_t>(i)].z, 0.97, 1e-9);
      EXPECT_NEAR(X[static_cast<std::size_t>(i)].x, x, 1e-9);
    }
    EXPECT_NEAR(norm(X[static_cast<std::size_t>(at.front())] - X[static_cast<std::size_t>(at.back())]), 0.43, 1e-9);
    double way = 0;
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      way += norm(X[static_cast<std::size_t>(at[i + 1])] - X[static_cast<std::size_t>(at[i])]);
    EXPECT_NEAR(way, 0.43, 1e-9);
    EXPECT_EQ(std::count_if(X.begin(), X.end(),
                            [&](const Vec3& p) { return std::abs(p.z - 0.97) < 1e-9 && std::abs(p.x - x) < 1e-9; }),
              static_cast<long>(at.size()));
  }
  EXPECT_EQ(s->supports[0].name, "front.waist held");
  EXPECT_EQ(s->supports[1].cord.size(), s->supports[1].samples.size() - 1);
  // Whatever the free points do, the edge that is fixed stays.
  std::vector<Vec3> moved(static_cast<std::size_t>(m.freeCount()), Vec3{1, 2, 3});
  for (const int i : m.held_points) moved[static_cast<std::size_t>(i)] = {};
  std::vector<Vec3> way(X.size());
  m.surface.WT.multiply<Vec3>(moved, way);
  for (const int i : s->supports[0].samples) EXPECT_LT(norm(way[static_cast<std::size_t>(i)]), 1e-9);
  EXPECT_LT(m.held_points.size(), static_cast<std::size_t>(m.freeCount()) / 3);

  const std::vector<SewnSeam>& seams = s->wardrobe.drafts[0].sewn_seams;
  ASSERT_EQ(seams.size(), 4u);  // both, and the buttons
  EXPECT_EQ(seams[0].hold, SeamHold::open);
  EXPECT_EQ(seams[1].stiffness_N, 2e-3);
  EXPECT_NE(seams[3].name.find("button 2"), std::string::npos);
  EXPECT_EQ(writeCase(readRecordedCase(folder.write("again.json", writeCase(c)))), writeCase(c));
}

TEST(PanelEdges, WhatIsWrongIsSaidInTheCase) {
  expectRefused(
      hung_skirt,
      {{"\"left side\"", "\"left sid\"", 5, "garment.pattern.seams[0].seam", "did you mean \"left side\"?"},
       {"\"left side\"", "\"front.5\"", 5, "garment.pattern.seams[0].seam",
        "there is no edge 5 of panel \"front\"; allowed: 0 to 3, hem (0), waist (2)"},
       {"\"use\": \"opening\", ", "", 5, "garment.pattern.seams[0].open", "allowed: with \"use\": \"opening\""},
       {"\"opening\"", "\"zip\"", 5, "garment.pattern.seams[0].use", "zip"},
       {"\"buttons\": 2", "\"buttons\": 200", 5, "garment.pattern.seams[0].buttons", "allowed: >= 0 and <= 100"},
       {"\"buttons\"", "\"butons\"", 5, "garment.pattern.seams[0].butons", "did you mean \"buttons\"?"},
       {", \"stiffness\": 0}", "}", 5, "garment.pattern.seams[0]", "stiffness: is of a seam that is sewn"},
       {"\"remove\": true", "\"remove\": true, \"open\": false", 6, "garment.pattern.seams[1].open",
        "has no meaning for a seam that is taken away"},
       {", \"remove\": true", "", 6, "garment.pattern.seams[1]", "changes nothing"},
       {"{\"seam\": \"front.3\", \"remove\": true},", "", 7, "garment.pattern.seams[1].a[0]",
        "is sewn already, by seam \"right side\""},
       {", \"b\": [\"front.3 reversed\"]", "", 7, "garment.pattern.seams[2].a", "both a and b"},
       {"\"front.waist\"", "\"front.wasit\"", 12, "supports[0].fixed.edge",
        "is not an edge of this garment; allowed: front.0, front.1, front.2, front.3, front.hem or front.waist, or "
        "patch"},
       {"\"front.waist\"", "\"fornt.waist\"", 12, "supports[0].fixed.edge", "back.hem"}});
}

/// What goes without sewn seams is named by its key.
TEST(PanelEdges, WhatSewnSeamsDoNotGoWithIsNamed) {
  const Folder folder;
  const std::filesystem::path file = folder.write("case.json", hung_skirt);
  for (const auto& [set, key] : {std::pair("strain_limit={\"mode\": \"upper_limit\", \"limit\": 0.05}", "strain_limit"),
                                 {"garment.model=springs", "garment.model"},
                                 {"garment.model=triangles", "supports[0].fixed.edge"},
                                 {"time.scheme=rk4", "time.scheme"}})
    try {
      buildScenario(readCase(file, {set}));
      ADD_FAILURE() << set;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
    }
}

}  // namespace
}  // namespace gambeson
