// Dressing garment by garment, Zheng 2013, sections 6.3 and 4.5.3.
#include "cases/wear/run/dress.hpp"
#include "cases/wear/scene/worn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cases/wear/scene/garments.hpp"
#include "core/error.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// A tube around the waist, put on as drafted, and one of the same radius, of four panels that are stitched.
// clang-format off
const std::string worn = R"json({
  "name": "worn",
  "garments": [
    {"name": "inner", "tube": {"radius": "0.18 m", "length": "0.1 m", "cells_around": 16, "cells_along": 3,
                               "start": [-0.01, 0, 1.0], "axis": [0, 0, 1]}},
    {"name": "outer", "tube": {"radius": "0.18 m", "length": "0.14 m", "cells_around": 16, "cells_along": 4, "patches": 4,
                               "start": [-0.01, 0, 0.98], "axis": [0, 0, 1]},
     "position": ["6 mm", "4 mm", 0], "stitching": {"offset": "2 cm", "stiffness": "2000 N/m^2", "damping": "2 kg/(m s)"}}
  ],
  "fabric": {
    "thickness": "1 mm", "density": "1440 kg/m^3", "young": "0.5 MPa",
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.5},
  "dressing": {"layer_by_layer": true, "settle": "0.06 s"}
})json";
// clang-format on

std::string bytesOf(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::stringstream out;
  out << stream.rdbuf();
  return out.str();
}

TEST(Dress, PanelsAreSewnAndGarmentsComeFreeOfEachOther) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", worn));
  const Dressed apart = putOnApart(readCase(folder.path() / "case.json", {"dressing.settle=0.5 ms"}));
  ASSERT_EQ(apart.garments.size(), 2u);
  EXPECT_EQ(apart.garments[0].name, "inner");
  EXPECT_EQ(apart.garments[1].name, "outer");
  // Sewn: all control points come from the seams' map.
  const auto s = buildScenario(c);
  wear(*s, apart);
  std::vector<Vec3> q(static_cast<std::size_t>(s->model->cloth->map().T.rows())), given;
  s->model->cloth->map().T.multiply<Vec3>(s->start_m, q);
  for (const DressedGarment& g : apart.garments) given.insert(given.end(), g.points_m.begin(), g.points_m.end());
  ASSERT_EQ(q.size(), given.size());
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LT(norm(q[i] - given[i]), 1e-9);
  // Both were drafted at one radius, so they pass through each other until they are worn together.
  StepWork work;
  const State start = startOf(*s, work);
  State next;
  const StepReport first = step(*s->model, *s->stage, start, 1e-5, next, work);
  EXPECT_GT(first.intersections, 0);
  const Dressed together = wearTogether(c, apart);
  wear(*s, together);
  const StepReport last = step(*s->model, *s->stage, startOf(*s, work), 1e-5, next, work);
  EXPECT_EQ(last.intersections, 0);

  const std::filesystem::path file = folder.path() / "dressed.json";
  writeDressed(together, file);
  const Dressed back = readDressed(file);
  EXPECT_EQ(back.body, together.body);
  EXPECT_EQ(back.posture.q, together.posture.q);
  EXPECT_EQ(back.posture.root, together.posture.root);
  for (std::size_t g = 0; g < 2; ++g) EXPECT_EQ(back.garments[g].points_m, together.garments[g].points_m);
  writeDressed(back, folder.path() / "again.json");
  EXPECT_EQ(bytesOf(file), bytesOf(folder.path() / "again.json"));

  // Another run starts from it.
  const auto from = buildScenario(readCase(folder.path() / "case.json", {"dressing.from=" + file.string()}));
  EXPECT_EQ(startOf(*from, work).p, s->start_m);
}

void expectSame(const Dressed& a, const Dressed& b) {
  EXPECT_EQ(a.body, b.body);
  EXPECT_EQ(a.posture.q, b.posture.q);
  ASSERT_EQ(a.garments.size(), b.garments.size());
  for (std::size_t g = 0; g < a.garments.size(); ++g) {
    EXPECT_EQ(a.garments[g].name, b.garments[g].name);
    EXPECT_EQ(a.garments[g].points_m, b.garments[g].points_m);
    EXPECT_EQ(a.garments[g].law, b.garments[g].law);
    EXPECT_EQ(a.garments[g].history, b.garments[g].history);
  }
}

/// Stopped while a garment settles, while panels are drawn together and between garments: to the same bits.
TEST(Dress, GoesOnFromWhereItWasStopped) {
  struct Stop {};
  const Folder folder;
  const Case c = readCase(folder.write("case.json", worn),
                          {"dressing.settle=2 ms", R"(fabric.bending={"law": "stop", "rigidity": "1e-4 N m",
                                                        "yield_moment": "5e-5 N"})"});
  const Dressed whole = putOnApart(c);
  const std::filesystem::path file = folder.path() / "dressing.h5";
  // Stops when it is kept for the `at`th time; returns how often it was.
  const auto dressUpTo = [&](int at) {
    int kept = 0;
    DressingProgress progress(file, "this run", false);
    progress.every = {};
    progress.kept = [&] {
      if (++kept == at) throw Stop();
    };
    try {
      expectSame(putOnApart(c, progress), whole);
    } catch (const Stop&) {
    }
    return kept;
  };
  const int all = dressUpTo(-1);
  ASSERT_GT(all, 6);
  std::size_t furthest = 0;
  for (const int at : {all / 2, all - 1}) {
    SCOPED_TRACE(at);
    ASSERT_EQ(dressUpTo(at), at);
    DressingProgress progress(file, "this run", true);
    ASSERT_TRUE(progress.resumes());
    furthest = std::max(furthest, progress.worn().garments.size());
    expectSame(putOnApart(c, progress), whole);
  }
  EXPECT_EQ(furthest, 1u);  // the second was in hand
  EXPECT_FALSE(DressingProgress(file, "another run", true).resumes());
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// A garment that keeps its folds knows of being put on, alone as with others, from memory and from a file; or not,
/// where the case wipes that. The panels' seams are where they are sewn.
TEST(Dress, WhatLawsRememberIsKeptOrWiped) {
  const Folder folder;
  const std::string stop = R"(fabric.bending={"law": "stop", "rigidity": "1e-4 N m", "yield_moment": "5e-5 N"})";
  const std::filesystem::path file = folder.write("case.json", worn), dressed_file = folder.path() / "dressed.json";
  for (const std::string& model : {std::string("nurbs"), std::string("triangles")}) {
    const std::vector<std::string> settings{stop, "dressing.settle=2 ms", "garments[0].model=\"" + model + "\"",
                                            "garments[1].model=\"" + model + "\""};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), settings.begin(), settings.end());
      return readCase(file, more);
    };
    const Dressed apart = putOnApart(with({}));
    const auto s = buildScenario(with({}));
    wear(*s, apart);
    StepWork work;
    const State start = startOf(*s, work);
    ASSERT_EQ(start.history.size(), s->model->cloth->historySize());
    for (int g = 0; g < 2; ++g) {
      const std::vector<double>& kept = apart.garments[static_cast<std::size_t>(g)].history;
      ASSERT_FALSE(kept.empty());
      EXPECT_NE(kept, std::vector<double>(kept.size(), 0.0)) << "a tube of flat cloth yields";
      EXPECT_EQ(historyOf(*s->model->cloth, start.history, g), kept);
    }
    writeDressed(apart, dressed_file);
    EXPECT_EQ(readDressed(dressed_file).garments[1].history, apart.garments[1].history);
    EXPECT_EQ(readDressed(dressed_file).garments[1].law, "stop");
    const std::string from = "dressing.from=" + dressed_file.string();
    EXPECT_EQ(startOf(*buildScenario(with({from})), work).history, start.history);
    EXPECT_EQ(startOf(*buildScenario(with({from, "dressing.history=wiped"})), work).history,
              std::vector<double>(start.history.size(), 0.0));
    try {
      buildScenario(readCase(file, {from, settings[2], settings[3]}));
      ADD_FAILURE() << "cloth without memory takes no history";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("\"dressing.history\" be \"wiped\""), std::string::npos) << e.what();
    }
  }
}

/// Each is drafted over those before it.
// clang-format off
const std::string several = R"json({
  "name": "layers",
  "garments": [
    {"name": "shorts", "shorts": {"cell": "50 mm"}},
    {"name": "belt", "belt": {"cell": "45 mm"}},
    {"name": "shirt", "shirt": {"cell": "38 mm"}}
  ],
  "fabric": {
    "thickness": "2 mm", "density": "1440 kg/m^3", "young": "1.44 MPa",
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.2},
  "dressing": {"layer_by_layer": true, "settle": "0.5 ms"}
})json";
// clang-format on

/// What is drafted over other garments is the same garment where it is put on by itself, without them.
TEST(Dress, GarmentsThatAreDraftedOverOthersAreTheirOwn) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", several));
  const auto together = buildScenario(c);
  const Dressed apart = putOnApart(c);
  wear(*together, apart);  // as many control points
  StepWork work;
  const State drafted = initialState(*together->model, *together->stage, together->start_s, work);
  const State put_on = startOf(*together, work);
  for (std::size_t i = 0; i < drafted.p.size(); ++i)
    EXPECT_LT(norm(put_on.p[i] - drafted.p[i]), 0.03);  // of the same pattern, at the same place
}

/// With weight, a belt that is tight over shorts slides off the bare body: by 104 mm within 0.8 s on a skin.
TEST(Dress, ABeltStaysWhereItIsWornUntilThereAreShortsUnderIt) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", several), {"dressing.settle=0.15"});
  Case belted = c;
  belted.garments.pop_back();
  const auto height = [](const std::vector<Vec3>& points) {
    double sum = 0;
    for (const Vec3& x : points) sum += x.z;
    return sum / static_cast<double>(points.size());
  };
  const std::vector<Garment> drafted = draftGarments(belted, &*buildScenario(belted)->human);
  EXPECT_NEAR(height(putOnApart(belted).garments[1].points_m), height(drafted[1].patches[0].points), 0.005);
}

/// Springs that are too soft and hardly damped let the panels flap: they were 10.8 mm apart then.
TEST(Dress, AShirtOfArmourIsStitchedWithTheDefaults) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", R"json({
  "name": "stitched",
  "garments": [{"name": "shirt", "shirt": {"cell": "38 mm"}, "stitching": {"within": "0.2 s"}}],
  "fabric": {
    "thickness": "3.11 mm", "density": "1440 kg/m^3", "young": "1.44 MPa",
    "bending": {"law": "zheng", "rigidity": "0.00371 N m", "kappa0": "30 1/m"}
  },
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.2},
  "dressing": {"layer_by_layer": true, "settle": "0.5 ms"}
})json"));
  EXPECT_NO_THROW(putOnApart(c));
}

TEST(Dress, PanelsThatDoNotCloseAreReported) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", worn), {"garments[1].stitching.within=0.02"});
  try {
    putOnApart(c);
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("putting on the garment \"outer\""), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("mm apart after 0.02 s"), std::string::npos) << e.what();
  }
}

TEST(Dress, ADressedStateOfSomethingElseIsRefused) {
  const Folder folder;
  const Case plain = readCase(folder.write("case.json", worn));
  const auto s = buildScenario(plain);
  StepWork work;
  const Dressed good = dressedOf(*s, startOf(*s, work));
  writeDressed(good, folder.path() / "d.json");
  const Case c = readCase(folder.path() / "case.json", {"dressing.from=" + (folder.path() / "d.json").string()});
  EXPECT_NO_THROW(buildScenario(c));
  const auto expect = [&](const Dressed& d, const std::string& says) {
    writeDressed(d, folder.path() / "d.json");
    try {
      buildScenario(c);
      FAIL() << says;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("d.json"), std::string::npos) << e.what();
    }
  };
  Dressed bad = good;
  bad.body = "another";
  expect(bad, "another body");
  bad = good;
  bad.garments.pop_back();
  expect(bad, "holds 1 garments, the case 2");
  bad = good;
  bad.garments[0].name = "coat";
  expect(bad, "garment 1 is \"coat\", in the case \"inner\"");
  bad = good;
  bad.garments[1].points_m.pop_back();
  expect(bad, "control points, in the case");
  bad = good;
  bad.garments[1].points_m[3].y = std::nan("");
  expect(bad, "garments[1].points_m[3]");
  folder.write("d.json", "{\"format\": \"gambeson dressed 9\"}");
  EXPECT_THROW(buildScenario(c), InputError);
  folder.write("d.json", "{\"format\"");
  EXPECT_THROW(buildScenario(c), InputError);
}

TEST(Dress, RulesOfItsFields) {
  expectRefused(worn,
                {
                    {"\"layer_by_layer\": true, ", "", 8, "garments[1].stitching", "needs dressing.layer_by_layer"},
                    {"\"2 cm\"", "\"2 m\"", 8, "garments[1].stitching.offset", "out of range"},
                    {"\"2000 N/m^2\"", "0", 8, "garments[1].stitching.stiffness", "out of range"},
                });
}

}  // namespace
}  // namespace gambeson
