// What a study takes a variant's folder for: what is done is not done again, whatever the cloth.
#include <gtest/gtest.h>

#include "cases/study/run.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/run/run.hpp"
#include "core/math/instruction_sets.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::study {
namespace {

std::string sheet(const std::string& name, double height_m, const std::string& model) {
  return "{\"name\": \"" + name + "\", \"sheet\": {\"width\": \"0.1 m\", \"height\": \"0.1 m\", \"cells_u\": 3, " +
         "\"cells_v\": 3, \"corner\": [0, 0, " + std::to_string(height_m) + "]}, \"model\": \"" + model + "\"}";
}

std::string caseOf(const std::string& garments) {
  return "{\"name\": \"t\", \"garments\": [" + garments + R"(],
  "fabric": {"thickness": "1 mm", "density": "400 kg/m^3", "young": "0.1 MPa", "poisson": 0,
             "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
  "obstacles": [{"name": "ground", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
  "contact": {"friction": 0.3}, "time": {"duration": "10 ms"}, "output": {"pictures": []}})";
}

/// The kernels that a run of two sheets was made with, after a look at its folder.
std::string kernelsOf(const std::string& lower, const std::string& upper) {
  const Folder folder;
  const auto out = folder.path() / "out";
  const Case c =
      readCase(folder.write("case.json", caseOf(sheet("lower", 0.002, lower) + ", " + sheet("upper", 0.01, upper))));
  EXPECT_EQ(standOf(out, caseIdentity(c)), Stand::fresh);
  EXPECT_EQ(runCase(c, {out, 1}), 0);
  EXPECT_EQ(standOf(out, caseIdentity(c)), Stand::done) << lower << ", " << upper;
  EXPECT_EQ(standOf(out, caseIdentity(c) + "0"), Stand::fresh);
  EXPECT_EQ(standOf(out, caseIdentity(c), DeviceKind::cpu, true), Stand::done);
  EXPECT_EQ(standOf(out, caseIdentity(c) + "0", DeviceKind::cpu, true), Stand::fresh);
  return readRunFacts(out).kernels;
}

TEST(Stand, WhatIsDoneIsKeptWhateverTheCloth) {
  EXPECT_EQ(kernelsOf("springs", "shell"), kOneForAll);
  EXPECT_EQ(kernelsOf("nurbs", "springs"), widestInstructionSet());
}

// Rounding of the whole hangs on the part that is computed in vectors, wherever that stands.
TEST(Stand, VectorsOfAnyPartCount) { EXPECT_EQ(kernelsOf("springs", "nurbs"), widestInstructionSet()); }

}  // namespace
}  // namespace gambeson::study
