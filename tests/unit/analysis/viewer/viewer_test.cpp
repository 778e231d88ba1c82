#include "analysis/viewer/viewer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/report/report.hpp"
#include "analysis/viewer/packed.hpp"
#include "unit/analysis/viewer/page_reader.hpp"

namespace gambeson {
namespace {

using viewed::PageRun;

/// Two triangles of cloth that move, and one triangle of a body that turns as a whole.
ViewerRun smallRun() {
  ViewerRun run("Small </script> \"run\"", "", {0, 0.02}, {{0, 0, 0}, {0.5, 0, 0}}, {0, 0, 1});
  run.startAt(0.019, "stress", "left");
  const MovingMesh cloth{
      "vest",
      {{0, 1, 2}, {2, 1, 3}},
      {{0, 0, 1, 0.1f, 0, 1, 0, 0.1f, 1, 0.1f, 0.1f, 1}, {0.5f, 0, 1, 0.6f, 0, 1, 0.5f, 0.1f, 1, 0.6f, 0.1f, 1.01f}},
      {},
      {}};
  run.addMoving(ViewerRun::Kind::cloth, cloth, {"front", "back"}, {0, 0, 1, 1});
  FixedMesh body{"thigh", 0, {}};
  body.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  body.mesh.triangles = {{0, 1, 2}};
  const Placement turned{{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, {2, 3, 4}, 1};  // x to y
  run.addFixed(ViewerRun::Kind::body, body, {Placement{}, turned});
  return run;
}

Vec3 placedBy(const std::vector<float>& rows, std::size_t frame, const Vec3& x) {
  Vec3 out;
  for (int r = 0; r < 3; ++r) {
    const float* row = rows.data() + 12 * frame + 4 * static_cast<std::size_t>(r);
    out[r] = row[0] * x.x + row[1] * x.y + row[2] * x.z + row[3];
  }
  return out;
}

TEST(Viewer, MeshesComeBack) {
  const ViewerRun run = smallRun();
  const PageRun page(run.firstHtml(0) + run.restHtml(0));
  ASSERT_EQ(page.head["meshes"].size(), 2u);
  EXPECT_EQ(page.head["title"], "Small </script> \"run\"");
  const auto& cloth = page.head["meshes"][0];
  EXPECT_EQ(cloth["kind"], "cloth");
  EXPECT_EQ(cloth["name"], "vest");
  std::vector<int> corners;
  int now = 0;
  for (const std::int32_t change : viewed::numbersOf<std::int32_t>(page.piece(cloth["triangles"])))
    corners.push_back(now += change);
  EXPECT_EQ(corners, (std::vector<int>{0, 1, 2, 2, 1, 3}));
  EXPECT_EQ(viewed::numbersOf<std::uint16_t>(viewed::inflated(page.blocks[cloth["part"]])),
            (std::vector<std::uint16_t>{0, 0, 1, 1}));
  const std::vector<int> parents = parentsOf(4, std::vector<std::array<int, 3>>{{0, 1, 2}, {2, 1, 3}});
  const std::vector<int> p = viewed::unpacked(page.blocks[cloth["moving"]], 2, 4, 3, parents);
  // The frame of the start alone, which is read first.
  EXPECT_EQ(page.head["start"]["frame"], 1);
  EXPECT_EQ(page.head["start"]["time_s"], 0.02);
  EXPECT_EQ(viewed::decoded(page.piece(cloth["start"]), 1, 4, 3, parents), std::vector<int>(p.begin() + 12, p.end()));
  const PageRun first(run.firstHtml(0));
  EXPECT_EQ(first.first, page.first);
  EXPECT_TRUE(first.blocks.empty());
  const double q = cloth["quantum_m"], x = page.head["origin_m"][1][0];
  EXPECT_NEAR(x + q * p[12 + 9], 0.6, 1e-4);
  EXPECT_NEAR(q * p[12 + 11], 1.01, 1e-4);
  // Rows take a point of the body to where it stands, about the origin of the frame.
  const auto rows = viewed::numbersOf<float>(page.piece(page.head["meshes"][1]["placed"]));
  const Vec3 at = placedBy(rows, 1, {1, 2, 0});
  EXPECT_LT(norm(at - (Vec3{0, 4, 4} - Vec3{0.5, 0, 0})), 1e-6);
  EXPECT_LT(norm(placedBy(rows, 0, {1, 2, 0}) - Vec3{1, 2, 0}), 1e-6);
}

TEST(Viewer, FieldsComeBackWithinTheirError) {
  ViewerRun run = smallRun();
  const std::vector<std::vector<float>> values{{100, 0, -3, 250}, {110, 1, -2, 240}};
  run.addField({"stress", "Stress", "N/m", false, false, 200, {{0, -1, 230, "limit of the vest"}}}, values);
  run.addField({"body_pressure", "Pressure", "kPa", true, true, 0, {}},
               std::vector<std::vector<float>>{{0, 1, 2}, {0, 2, 4}});
  run.addField({"set", "nothing", "1/m", false, false, 0, {}},
               std::vector<std::vector<float>>{{0, 0, 0, 0}, {0, 0, 0, 0}});
  const PageRun page(run.firstHtml(0) + run.restHtml(0));
  ASSERT_EQ(page.head["fields"].size(), 2u);  // one without values is left out
  const auto& field = page.head["fields"][0];
  const std::vector<int> parents = parentsOf(4, std::vector<std::array<int, 3>>{{0, 1, 2}, {2, 1, 3}});
  const std::vector<int> p = viewed::unpacked(page.blocks[field["block"]], 2, 4, 1, parents);
  for (std::size_t t = 0; t < 2; ++t)
    for (std::size_t v = 0; v < 4; ++v)
      EXPECT_NEAR(field["scale"].get<double>() * std::sinh(field["step"].get<double>() * p[4 * t + v]), values[t][v],
                  0.0021 * std::abs(values[t][v]) + 1e-3);
  EXPECT_EQ(viewed::decoded(page.piece(field["start"]), 1, 4, 1, parents), std::vector<int>(p.begin() + 4, p.end()));
  EXPECT_FALSE(page.head["fields"][1].contains("start"));
  EXPECT_EQ(field["least"], -3);
  EXPECT_EQ(field["most"], 250);
  EXPECT_EQ(field["limits"][0]["value"], 230);
  EXPECT_EQ(page.head["fields"][1]["on"], "body");
  EXPECT_EQ(page.head["fields"][1]["high"], 4);  // none is given: the largest
}

TEST(Viewer, WhatDoesNotFitIsOurMistake) {
  ViewerRun run = smallRun();
  const std::vector<std::vector<float>> short_frame{{1, 2, 3}, {1, 2, 3}},
      odd_times{{1, 2, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 4}};
  EXPECT_THROW(run.addField({"stress", "", "", false, false, 0, {}}, short_frame), std::logic_error);
  EXPECT_THROW(run.addField({"stress", "", "", false, false, 0, {}}, odd_times), std::logic_error);
  EXPECT_THROW(run.startAt(0, "", "front"), std::logic_error);  // after its meshes
  EXPECT_THROW(ViewerRun("", "", {0, 1}, {{}}, {0, 0, 1}), std::logic_error);
}

/// A page holds all that it shows, asks nobody for anything, and names the licence of what it takes from others.
TEST(Viewer, ThePageIsWhole) {
  ReportInput in;
  in.title = "Run";
  const std::string bare = formatReport(in);
  EXPECT_EQ(bare.find("viewer-run"), std::string::npos);
  EXPECT_EQ(bare.find("three.js"), std::string::npos);
  in.viewer.push_back(smallRun());
  const std::string page = formatReport(in);
  EXPECT_NE(page.find("<section class=\"look\" id=\"look-around\" aria-labelledby=\"look\" hidden>"),
            std::string::npos);
  EXPECT_NE(page.find("Permission is hereby granted, free of charge"), std::string::npos);
  EXPECT_NE(page.find("three.js authors"), std::string::npos);
  for (const char* asks : {"http://", "https://", "import(", "<link"})
    EXPECT_EQ(page.find(asks), std::string::npos) << asks;
  EXPECT_EQ(page.find("Small </script>"), std::string::npos);  // it would end the script that names it
  EXPECT_LT(page.size(), 600000u);                             // three.js takes 0.3 MB of it
}

}  // namespace
}  // namespace gambeson
