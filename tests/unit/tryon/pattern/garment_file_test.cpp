// The garment file: what is written comes back to the bit, and what is wrong is named.
#include "tryon/pattern/garment_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

class GarmentFile : public testing::Test {
 protected:
  std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) /
      (std::string("garment_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".json");
  ~GarmentFile() override { std::filesystem::remove(path); }

  Json good() {
    TubePattern t;
    t.radius_m = 0.06;
    t.length_m = 0.5;
    t.patches = 2;
    t.cells_around = 6;
    t.cells_along = 1;
    std::filesystem::remove(path);
    writeGarment(makeTube(t), path);
    std::ifstream in(path);
    return Json::parse(in);
  }
  InputError::Where failure(const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
    try {
      loadGarment(path);
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, path.string());
      EXPECT_FALSE(e.reason().empty());
      return e.where();
    }
    return {"", 0, "accepted"};
  }
  template <class F>
  std::string damaged(F damage) {
    Json j = good();
    damage(j);
    return failure(j.dump()).key;
  }
};

TEST_F(GarmentFile, ComesBackToTheBit) {
  Garment g = makeShorts({}, makeManikin("male_p50"));
  g.patches[4].weights.back() = 1;  // stays unwritten
  writeGarment(g, path);
  const Garment h = loadGarment(path);
  EXPECT_EQ(h.name, "shorts");
  ASSERT_EQ(h.patches.size(), g.patches.size());
  for (std::size_t n = 0; n < g.patches.size(); ++n) {
    EXPECT_EQ(h.patches[n].u, g.patches[n].u);
    EXPECT_EQ(h.patches[n].v, g.patches[n].v);
    EXPECT_TRUE(h.patches[n].points == g.patches[n].points);
    EXPECT_EQ(h.patches[n].weights, g.patches[n].weights);
    EXPECT_EQ(h.weft[n], g.weft[n]);
  }
  ASSERT_EQ(h.seams.size(), g.seams.size());
  for (std::size_t n = 0; n < g.seams.size(); ++n) {
    EXPECT_EQ(h.seams[n].kind, g.seams[n].kind);
    EXPECT_EQ(h.seams[n].stiffness_N, g.seams[n].stiffness_N);
    for (auto e : {&Seam::a, &Seam::b}) {
      EXPECT_EQ((h.seams[n].*e).patch, (g.seams[n].*e).patch);
      EXPECT_EQ((h.seams[n].*e).side, (g.seams[n].*e).side);
      EXPECT_EQ((h.seams[n].*e).reversed, (g.seams[n].*e).reversed);
    }
  }
}

TEST_F(GarmentFile, KeepsTrimsPartsPlacesAndNames) {
  const Human human = makeManikin("male_p50");
  const BodyForm form(human);
  Fabric fabric;
  fabric.thickness_m = 2.29e-3;
  fabric.young_warp_Pa = 1.44e6;
  for (const Garment& g : {makeShirt({}, form, 3e-3, {}), makeBelt({}, form, fabric, 2.29e-3, {})}) {
    writeGarment(g, path);
    const Garment h = loadGarment(path);
    for (std::size_t n = 0; n < g.patches.size(); ++n) EXPECT_TRUE(h.patches[n].points == g.patches[n].points);
    EXPECT_EQ(h.patch_names, g.patch_names);
    EXPECT_TRUE(h.placed == g.placed);
    ASSERT_EQ(h.seams.size(), g.seams.size());
    for (std::size_t n = 0; n < g.seams.size(); ++n) EXPECT_EQ(h.seams[n].first_cell, g.seams[n].first_cell);
    ASSERT_EQ(h.edges.size(), g.edges.size());
    for (std::size_t n = 0; n < g.edges.size(); ++n) {
      EXPECT_EQ(h.edges[n].name, g.edges[n].name);
      ASSERT_EQ(h.edges[n].edges.size(), g.edges[n].edges.size());
      for (std::size_t k = 0; k < g.edges[n].edges.size(); ++k)
        EXPECT_EQ(h.edges[n].edges[k].side, g.edges[n].edges[k].side);
    }
    ASSERT_EQ(h.trims.size(), g.trims.size());
    for (std::size_t n = 0; n < g.trims.size(); ++n) {
      ASSERT_EQ(h.trims[n].loops.size(), g.trims[n].loops.size());
      for (std::size_t l = 0; l < g.trims[n].loops.size(); ++l)
        for (std::size_t k = 0; k < g.trims[n].loops[l].size(); ++k) {
          const NurbsCurve &a = h.trims[n].loops[l][k], &b = g.trims[n].loops[l][k];
          EXPECT_EQ(a.knots, b.knots);
          ASSERT_EQ(a.points.size(), b.points.size());
          for (std::size_t i = 0; i < a.points.size(); ++i)
            EXPECT_TRUE(a.points[i].x == b.points[i].x && a.points[i].y == b.points[i].y);
          EXPECT_EQ(a.weights, b.weights);
        }
    }
    // What is written again is the same file.
    std::ifstream first_in(path);
    const std::string first((std::istreambuf_iterator<char>(first_in)), {});
    writeGarment(h, path);
    std::ifstream again_in(path);
    EXPECT_EQ(std::string((std::istreambuf_iterator<char>(again_in)), {}), first);
  }
}

TEST_F(GarmentFile, NamesWhatIsWrongWithTrimsPartsAndNames) {
  const Human human = makeManikin("male_p50");
  writeGarment(makeShirt({}, BodyForm(human), 3e-3, {}), path);
  std::ifstream in(path);
  const Json shirt = Json::parse(in);
  const auto key = [&](const std::function<void(Json&)>& damage) {
    Json j = shirt;
    damage(j);
    return failure(j.dump()).key;
  };
  EXPECT_EQ(key([](Json& j) { j["patches"][1]["name"] = "front"; }), "patches[1].name");
  EXPECT_EQ(key([](Json& j) { j["patches"][1]["placed_m"] = Json::array({{0, 0, 0}}); }), "patches[1].placed_m");
  EXPECT_EQ(key([](Json& j) { j["patches"][0]["trim"]["loops"][0][1]["points"][0] = {0.5}; }),
            "patches[0].trim.loops[0][1].points[0]");
  EXPECT_EQ(key([](Json& j) { j["patches"][0]["trim"]["loops"][0][1]["degree"] = 7; }),
            "patches[0].trim.loops[0][1].knots");
  EXPECT_EQ(key([](Json& j) { j["patches"][0]["trim"]["unused_fraction"] = 2; }), "patches[0].trim.unused_fraction");
  EXPECT_EQ(key([](Json& j) { j["seams"][0]["first_cell"] = -1; }), "seams[0].first_cell");
  EXPECT_EQ(key([](Json& j) { j["seams"][0]["first_cell"] = 1000; }), "seams[0]");
  EXPECT_EQ(key([](Json& j) { j["seams"][2]["first_cell"] = 1; }), "seams[2]");  // elsewhere
  EXPECT_EQ(key([](Json& j) { j["edges"][0]["of"] = Json::array(); }), "edges[0].of");
  EXPECT_EQ(key([](Json& j) { j["edges"][1]["name"] = "hem"; }), "edges[1].name");
  EXPECT_EQ(key([](Json& j) { j["edges"][0]["of"][0]["patch"] = 6; }), "edges[0]");
}

TEST_F(GarmentFile, KeepsWeights) {
  Garment g = makeSheet({.width_m = 1, .height_m = 1, .cells_u = 2, .cells_v = 2});
  g.patches[0].weights[5] = 1.0 / 3;
  writeGarment(g, path);
  EXPECT_EQ(loadGarment(path).patches[0].weights, g.patches[0].weights);
}

TEST_F(GarmentFile, NamesWhatIsWrong) {
  EXPECT_EQ(damaged([](Json&) {}), "accepted");
  EXPECT_EQ(damaged([](Json& j) { j["patchs"] = 1; }), "patchs");
  EXPECT_EQ(damaged([](Json& j) { j.erase("seams"); }), "seams");
  EXPECT_EQ(damaged([](Json& j) { j["format"] = "x"; }), "format");
  EXPECT_EQ(damaged([](Json& j) {
              j["patches"] = Json::array();
              j["seams"] = Json::array();
            }),
            "patches");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][1]["degree"] = {2, 2.5}; }), "patches[1].degree[1]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][1]["degree"] = {2, 3}; }), "patches[1].v.knots");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][1]["degree"] = {-1, 2}; }), "patches[1].degree[0]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["knots_u"][3] = "a"; }), "patches[0].knots_u[3]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["knots_u"][3] = 7; }), "patches[0].u.knots[4]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["points_m"][2] = {1, 2}; }), "patches[0].points_m[2]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["points_m"].erase(0); }), "patches[0].points");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["weights"] = {1, 1}; }), "patches[0].weights");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["weft"] = {0, 0, 0}; }), "weft[0]");
  EXPECT_EQ(damaged([](Json& j) { j["seams"][0]["a"]["patch"] = 9; }), "seams[0].a.patch");
  EXPECT_EQ(damaged([](Json& j) { j["seams"][0]["a"]["side"] = "w0"; }), "seams[0].a.side");
  EXPECT_EQ(damaged([](Json& j) { j["seams"][0]["a"]["side"] = "u0"; }), "seams[0]");
  EXPECT_EQ(damaged([](Json& j) { j["seams"][0]["kind"] = "G2"; }), "seams[0].kind");
  EXPECT_EQ(damaged([](Json& j) { j["seams"][0]["stiffness_N"] = -1; }), "seams[0].stiffness_N");
  EXPECT_EQ(damaged([](Json& j) { j["seams"].push_back(j["seams"][0]); }), "seams[2]");
  EXPECT_EQ(damaged([](Json& j) { j["patches"][0]["points_m"][2][1] = 1e200; }), "patches[0].points_m[2]");
  // A point beside a G1 seam moved by a micrometre; one on the seam moved on one side only.
  EXPECT_EQ(damaged([](Json& j) {
              j["patches"][0]["points_m"][6][0] = j["patches"][0]["points_m"][6][0].get<double>() + 1e-6;
            }),
            "seams[1].kind");
  EXPECT_EQ(damaged([](Json& j) {
              j["patches"][0]["points_m"][5][0] = j["patches"][0]["points_m"][5][0].get<double>() + 1e-6;
            }),
            "seams[1]");
}

TEST_F(GarmentFile, NamesTheLineOfBrokenSyntax) {
  EXPECT_EQ(failure("{\"format\": 1,\n\n \"name\": }").line, 3);
  EXPECT_EQ(failure("").line, 0);  // is empty
  EXPECT_GT(failure(good().dump(1).substr(0, 400)).line, 5);
  EXPECT_EQ(failure("{\"format\": 1e999}").key, "");
  EXPECT_EQ(failure("[]").key, "");
  // Deep enough to overflow the stack of anything that recurses.
  const std::string deep(3000000, '['), back(3000000, ']');
  EXPECT_EQ(failure("{\"format\": " + deep + back + "}").key, "");
  path = path.parent_path() / "no_such_garment.json";
  EXPECT_THROW(loadGarment(path), InputError);
  EXPECT_THROW(loadGarment(path.parent_path()), InputError);
}

}  // namespace
}  // namespace gambeson
