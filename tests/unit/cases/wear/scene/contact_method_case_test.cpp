/// contact.method and contact.penalty: what they say, what they go with, and what is refused where.

#include <gtest/gtest.h>

#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

const char* const sheet_on_ball = R"json({
  "name": "sheet on a ball",
  "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 4, "cells_v": 4, "corner": [-0.1, -0.1, 0.15]},
              "model": "triangles"},
  "fabric": {"thickness": "1 mm", "density": 436, "young": "1.2 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "7e-6 N m"}},
  "obstacles": [{"name": "ball", "sphere": {"radius": "10 cm"}},
                {"name": "floor", "plane": {"point": [0, 0, -0.2]}}],
  "contact": {"friction": 0.3, "method": "projection"},
  "time": {"duration": 1}
})json";

struct Refusal {
  std::string key, reason;
  int line = 0;
};

Refusal refusal(const std::vector<std::string>& overrides) {
  const Folder folder;
  try {
    buildScenario(readCase(folder.write("case.json", sheet_on_ball), overrides));
  } catch (const InputError& e) {
    EXPECT_NE(e.reason().find("allowed"), std::string::npos) << e.what();
    return {e.where().key, e.reason(), e.where().line};
  }
  return {"accepted", "", 0};
}

TEST(ContactMethodCase, ReachesTheModel) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", sheet_on_ball));
  EXPECT_EQ(c.contact.method, ContactMethod::projection);
  const std::string full = writeCase(
      readCase(folder.path() / "case.json", {"garment.model=nurbs", "contact.method=penalty", "contact.penalty=2e6"}));
  EXPECT_EQ(writeCase(readCase(folder.write("again.json", full))), full);
  EXPECT_NE(full.find("penalty"), std::string::npos);
  EXPECT_NE(buildScenario(c)->model->method, nullptr);
  const Case soft = readCase(folder.path() / "case.json", {"contact.method=penalty", "contact.penalty=\"2 MPa/m\""});
  const auto s = buildScenario(soft);
  EXPECT_EQ(s->model->contact.method, ContactMethod::penalty);
  EXPECT_EQ(s->model->contact.penalty_Pa_per_m, 2e6);
}

/// A case that says nothing of it is written as it always was: its hash stays.
TEST(ContactMethodCase, TheDefaultIsNotWritten) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", sheet_on_ball), {"contact.method=together"});
  EXPECT_EQ(writeCase(c).find("method"), std::string::npos);
  EXPECT_EQ(writeCase(c).find("penalty"), std::string::npos);
  EXPECT_EQ(buildScenario(c)->model->method, nullptr);
}

TEST(ContactMethodCase, WhatItDoesNotGoWithIsRefusedByKey) {
  const std::string law = R"({"kinetic": 0.2, "static": 0.3})";
  const std::vector<std::pair<std::string, std::string>> refused{
      {"contact.friction=" + law, "contact.friction"},
      {"contact.friction_cloth=" + law, "contact.friction_cloth"},
      {"garment.friction=" + law, "garment.friction"},
      {"obstacles[1].friction=" + law, "obstacles[1].friction"},
      {R"(strain_limit={"mode": "upper_limit", "limit": 0.1})", "contact.method"},
      {"time.scheme=rk4", "contact.method"},
      {"contact.penalty=1000", "contact.penalty"},
      {"contact.method=penalty", "contact.penalty"},
      {"contact.method=projecting", "contact.method"},
  };
  EXPECT_EQ(refusal({}).key, "accepted");
  for (const auto& [set, key] : refused) EXPECT_EQ(refusal({set}).key, key) << set;
}

TEST(ContactMethodCase, ProjectionKnowsPointsEllipsoidsAndPlanes) {
  const Refusal patches = refusal({"garment.model=nurbs"});
  EXPECT_EQ(patches.key, "contact.method");
  EXPECT_EQ(patches.line, 9);
  EXPECT_NE(patches.reason.find("triangles"), std::string::npos) << patches.reason;
  const Refusal mesh = refusal({"obstacles[0].sphere.rings=8", "obstacles[0].sphere.segments=8"});
  EXPECT_EQ(mesh.key, "contact.method");
  EXPECT_NE(mesh.reason.find("\"ball\""), std::string::npos) << mesh.reason;
  EXPECT_NE(mesh.reason.find("forward_increment"), std::string::npos) << mesh.reason;
  for (const char* other : {"contact.method=together", "contact.method=forward_increment"})
    EXPECT_EQ(refusal({"garment.model=nurbs", other}).key, "accepted");
}

TEST(ContactMethodCase, AStepLongerThanThePenaltyAllowsIsRefused) {
  // rho = 0.436 kg/m^2: 2 sqrt(rho/eps) is 1.32e-3 s.
  const std::vector<std::string> soft{"contact.method=penalty", "contact.penalty=1e6"};
  const auto step = [&](const char* length) {
    std::vector<std::string> all = soft;
    all.push_back(std::string("time.step=") + length);
    return refusal(all).key;
  };
  EXPECT_EQ(step("1.3e-3"), "accepted");
  EXPECT_EQ(step("1.35e-3"), "time.step");
}

}  // namespace
}  // namespace gambeson
