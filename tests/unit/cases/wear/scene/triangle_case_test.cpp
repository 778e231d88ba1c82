/// Garments of triangles in cases: from drafts, from OBJ files, with other cloth, and what is refused.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "cases/wear/run/draft.hpp"
#include "cases/wear/scene/garments.hpp"
#include "core/error.hpp"
#include "scene.hpp"

namespace gambeson {
namespace {

class TriangleCase : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ("triangles_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  /// A case of a sheet above a plane; `garment`: what is in its braces.
  std::filesystem::path caseOf(const std::string& garment, const std::string& more = "") const {
    return write("case.json",
                 "{\"name\": \"t\", \"garment\": {" + garment +
                     "}, \"fabric\": {\"name\": \"f\", \"thickness\": \"1 mm\", \"density\": \"400 kg/m^3\", "
                     "\"young\": \"1 MPa\", \"poisson\": 0.2, \"bending\": {\"law\": \"linear\", \"rigidity\": "
                     "\"1e-5 N m\"}}, \"obstacles\": [{\"name\": \"ground\", \"plane\": {\"point\": [0, 0, 0], "
                     "\"normal\": [0, 0, 1]}}], \"contact\": {\"friction\": 0.3}, \"time\": {\"duration\": \"0.1 s\"}" +
                     more + "}");
  }
  /// The message of the InputError that reading and building gives; empty where there is none.
  std::string refusal(const std::filesystem::path& file) const {
    try {
      buildScenario(readCase(file));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

const char* const kSheet =
    "\"sheet\": {\"width\": \"0.2 m\", \"height\": \"0.2 m\", \"cells_u\": 6, \"cells_v\": 6, \"corner\": [0, 0, "
    "0.01]}";

/// The positions after a while.
std::vector<Vec3> after(const Case& c, double time_s) {
  SceneRun scene(c);
  scene.run(scene.scenario->start_s + time_s,
            [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  return scene.state.p;
}

// What `draft --obj` writes is worn with the same bits, supports and fabric threads included.
TEST_F(TriangleCase, ShortsFromAnObjAreTheDraftedOnes) {
  const std::vector<std::string> set{"garment.model=triangles", "garment.mesh=equilateral",
                                     "garment.shorts.cell=40 mm"};
  Case drafted = libraryCase("shorts_walk", set);
  std::ostringstream said;
  draftToFile(drafted, "", folder_ / "shorts.obj", true, said);
  Case read = drafted;
  read.garments[0].shape = MeshGarment{folder_ / "shorts.obj"};
  const std::vector<Vec3> a = after(drafted, 0.05), b = after(read, 0.05);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i], b[i]) << i;
}

// On NURBS, on triangles cut of the same sheet, and on a mesh from a file.
TEST_F(TriangleCase, NoiseMovesAllButWhatIsHeldByASeed) {
  write("square.obj",
        "v 0 0 0.01\nv 0.2 0 0.01\nv 0.2 0.2 0.01\nv 0 0.2 0.01\nv 0.1 0.1 0.01\n"
        "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  const std::string sheet = kSheet, file = "\"mesh_file\": {\"path\": \"square.obj\"}";
  const std::string edge = ", \"supports\": [{\"fixed\": {\"edge\": \"v1\"}}]";
  for (const auto& [garment, more] : {std::pair(sheet, edge), std::pair(sheet + ", \"model\": \"triangles\"", edge),
                                      std::pair(file, std::string())}) {
    const auto start = [&](const std::string& noise, std::vector<char>* held = nullptr) {
      const auto s = buildScenario(readCase(caseOf(garment + noise, more)));
      StepWork work;
      if (held) held->assign(s->model->held.begin(), s->model->held.end());
      return startOf(*s, work).p;
    };
    std::vector<char> held;
    const std::vector<Vec3> still = start("", &held), first = start(", \"noise\": \"1 mm\", \"noise_seed\": 1");
    EXPECT_EQ(start(", \"noise\": 0, \"noise_seed\": 7"), still) << garment;
    EXPECT_EQ(start(", \"noise\": \"1 mm\""), first) << "the seed that is not said, " << garment;
    const std::vector<Vec3> second = start(", \"noise\": \"1 mm\", \"noise_seed\": 2");
    double most = 0, least = 0;
    int moved = 0;
    for (std::size_t i = 0; i < still.size(); ++i) {
      const Vec3 d = first[i] - still[i];
      EXPECT_LE(std::hypot(d.x, d.y), 1e-15) << garment;
      EXPECT_EQ(d.z != 0, !held[i]) << i << " " << garment;
      EXPECT_EQ(second[i] != first[i], !held[i]) << i << " " << garment;
      most = std::max(most, d.z), least = std::min(least, d.z);
      moved += !held[i];
    }
    EXPECT_LE(std::max(most, -least), 1e-3) << garment;
    if (moved > 10) {
      EXPECT_GT(most, 5e-4) << garment;
      EXPECT_LT(least, -5e-4) << garment;
    }
    EXPECT_EQ(std::count(held.begin(), held.end(), 1) > 0, !more.empty()) << garment;
  }
  // The bits of the first seed, the same on every machine: 2 (random >> 11) 2^-53 - 1 of std::mt19937_64.
  std::mt19937_64 random(1);
  const auto s = buildScenario(readCase(caseOf(file + ", \"noise\": \"1 mm\"")));
  StepWork work;
  std::vector<double> z, bits;
  for (const Vec3& p : startOf(*s, work).p) {
    z.push_back(p.z);
    bits.push_back(0.01 + 1e-3 * (2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1));
  }
  EXPECT_EQ(std::multiset<double>(z.begin(), z.end()), std::multiset<double>(bits.begin(), bits.end()));
}

// A NURBS sheet falls on one of triangles, and both rest on the ground.
TEST_F(TriangleCase, TwoKindsOfClothTouchEachOther) {
  const std::string sheets =
      "[{\"name\": \"low\", \"model\": \"triangles\", \"sheet\": {\"width\": \"0.2 m\", \"height\": \"0.2 m\", "
      "\"cells_u\": "
      "6, \"cells_v\": 6, \"corner\": [0, 0, 0.003]}}, {\"name\": \"high\", \"sheet\": {\"width\": \"0.2 m\", "
      "\"height\": "
      "\"0.2 m\", \"cells_u\": 5, \"cells_v\": 5, \"corner\": [0.01, 0.01, 0.006]}}]";
  std::ostringstream text;
  text << std::ifstream(caseOf(kSheet)).rdbuf();
  std::string all = text.str();
  const std::size_t from = all.find("\"garment\""), end = all.find("\"fabric\"");
  const auto file = write("both.json", all.substr(0, from) + "\"garments\": " + sheets + ", " + all.substr(end));
  Case c = readCase(file);
  c.time.duration_s = 0.6;
  SceneRun scene(c);
  const Model& m = scene.model;
  ASSERT_EQ(m.cloth->patches().size(), 2u);
  AuditWatch audit;
  int cloth_contacts = 0;
  Vec3 received{};
  scene.run(0.5,
            [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) { audit(r); });
  scene.run(0.6, [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
    audit(r);
    cloth_contacts = std::max(cloth_contacts, r.cloth_contacts);
    received += r.momentum.obstacles;
    EXPECT_EQ(r.intersections, 0);
  });
  EXPECT_GT(cloth_contacts, 30);
  EXPECT_LT(audit.worst, 1e-9);
  EXPECT_NEAR(-received.z / 0.1, 2 * 0.04 * 0.4 * 9.81, 0.03 * 2 * 0.04 * 0.4 * 9.81);
  std::vector<Vec3> x;
  samplePositions(m, scene.state.p, x);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i].z, m.surface.patch[i] == 0 ? 1e-3 : 2e-3, 3e-4) << i;
}

// What runs and studies write of a case is read again: of triangles too, which have no samples within cells, and of
// meshes, which have no seams.
TEST_F(TriangleCase, WhatIsWrittenIsRead) {
  write("square.obj", "v 0 0 0.01\nv 0.2 0 0.01\nv 0.2 0.2 0.01\nv 0 0.2 0.01\nf 1 2 3\nf 1 3 4\n");
  for (const std::string& garment :
       {std::string(kSheet), std::string(kSheet) + ", \"samples_per_cell\": 3, \"seam_stiffness\": \"2 N/rad\"",
        std::string(kSheet) + ", \"model\": \"triangles\", \"seam_stiffness\": \"2 N/rad\"",
        std::string(kSheet) + ", \"model\": \"springs\"", std::string(kSheet) + ", \"model\": \"shell\"",
        std::string("\"mesh_file\": {\"path\": \"square.obj\"}")}) {
    const Case c = readCase(caseOf(garment));
    const Case again = readCase(write("again.json", writeCase(c)));
    EXPECT_EQ(writeCase(again), writeCase(c)) << garment;
    EXPECT_EQ(again.garments[0].samples_per_cell, c.garments[0].samples_per_cell) << garment;
    EXPECT_EQ(again.garments[0].seam_stiffness_N, c.garments[0].seam_stiffness_N) << garment;
  }
}

TEST_F(TriangleCase, RefusesWhatItCannotBe) {
  EXPECT_NE(refusal(caseOf(std::string(kSheet) + ", \"mesh\": \"single\"")).find("\"model\": \"triangles\""),
            std::string::npos);
  EXPECT_NE(refusal(caseOf(std::string(kSheet) + ", \"model\": \"squares\"")).find("nurbs"), std::string::npos);
  EXPECT_NE(refusal(caseOf(std::string(kSheet) + ", \"model\": \"triangles\", \"samples_per_cell\": 2"))
                .find("samples_per_cell"),
            std::string::npos);
  EXPECT_EQ(refusal(caseOf(std::string(kSheet) + ", \"model\": \"triangles\", \"mesh\": \"equilateral\"")), "");
  const auto says = [&](const std::string& keys, const std::string& reason) {
    const std::string text = refusal(caseOf(std::string(kSheet) + keys));
    EXPECT_NE(text.find(reason), std::string::npos) << text;
  };
  says(", \"bending_elements\": \"hinge\"", "garment.bending_elements: is for \"model\": \"triangles\"");
  says(", \"model\": \"triangles\", \"bending_elements\": \"plate\"", "midedge, triangle, hinge, springs or quadratic");
  says(", \"model\": \"triangles\", \"bending_spring\": \"1 N/m\"", "\"bending_elements\": \"springs\"");
  says(", \"model\": \"triangles\", \"bending_elements\": \"springs\", \"bending_spring\": \"-1 N/m\"", ">= 0");
  for (const char* elements : {"midedge", "triangle", "hinge", "springs", "quadratic"})
    EXPECT_EQ(refusal(caseOf(std::string(kSheet) + ", \"model\": \"triangles\", \"bending_elements\": \"" + elements +
                             "\"")),
              "");
  says(", \"model\": \"triangles\", \"bending_elements\": \"quadratic\", \"bending_spring\": \"1 N/m\"",
       "\"bending_elements\": \"springs\"");
  const std::string square = "v 0 0 0.01\nv 0.2 0 0.01\nv 0.2 0.2 0.01\nv 0 0.2 0.01\nf 1 2 3\nf 1 3 4\n";
  write("square.obj", square);
  const std::string file = "\"mesh_file\": {\"path\": \"square.obj\"}";
  EXPECT_EQ(refusal(caseOf(file)), "");
  EXPECT_NE(refusal(caseOf(file + ", \"model\": \"nurbs\"")).find("model"), std::string::npos);
  EXPECT_NE(refusal(caseOf(file + ", \"noise\": \"11 cm\""))
                .find("case.json:1: garment.noise: 11 cm is out of range; allowed: >= 0 and <= 10 cm"),
            std::string::npos);
  EXPECT_NE(refusal(caseOf("\"mesh_file\": {\"path\": \"square.obj\", \"rest\": \"uv\"}")).find("uv"),
            std::string::npos);
  EXPECT_NE(refusal(caseOf(file, ", \"supports\": [{\"fixed\": {\"edge\": \"top\"}}]")).find("top"), std::string::npos);
  // PLY: one patch, its threads as they lie; no uv to lie flat by. (A square of two triangles.)
  write("square.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0.01\n0.2 0 0.01\n0.2 0.2 0.01\n0 0.2 0.01\n3 0 1 2\n3 0 2 3\n");
  const std::string ply = "\"mesh_file\": {\"path\": \"square.ply\"}";
  EXPECT_EQ(refusal(caseOf(ply)), "");
  EXPECT_NE(refusal(caseOf("\"mesh_file\": {\"path\": \"square.ply\", \"rest\": \"uv\"}")).find("uv"),
            std::string::npos);
  write("square.stl", "solid\n");
  EXPECT_NE(refusal(caseOf("\"mesh_file\": {\"path\": \"square.stl\"}")).find(".obj or .ply"), std::string::npos);
  struct Broken {
    const char *text, *says;
  };
  for (const Broken& b : {Broken{"v 0 0 x\nf 1 2 3\n", "square.obj:1"},
                          {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ":4"},
                          {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "no area"},
                          {"", "no faces"},
                          {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "three corners"},
                          {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 2 4\n", "same way"}}) {
    write("square.obj", b.text);
    EXPECT_NE(refusal(caseOf(file)).find(b.says), std::string::npos) << b.text << refusal(caseOf(file));
  }
}

}  // namespace
}  // namespace gambeson
