// The loop of bending and laws of friction as a case file writes them.
#include <gtest/gtest.h>

#include "cases/cloth/fabric_input.hpp"
#include "cases/wear/case/case.hpp"
#include "core/material/hysteresis.hpp"
#include "core/material/kes_shear.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

const std::string usual = R"("bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"})";

std::string withBending(const std::string& bending) { return replaced(example, usual, "\"bending\": " + bending); }

FrictionInBending loopOf(const std::string& bending) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", withBending(bending)));
  const auto& law = c.garments[0].fabric ? c.garments[0].fabric->law : c.fabric.law;
  if (const auto* apart = std::get_if<HysteresisBending>(&law)) return *apart;
  return std::get<IsotropicHysteresisBending>(law);
}

TEST(LoopInput, SlopesOfTheThesis) {
  const FrictionInBending law = loopOf(
      R"({"law": "hysteresis", "rigidity": "1.4e-5 N m", "twist": 7e-6,
          "loop": {"initial_rigidity": "4.64e-5 N m", "c1": -2.15e-7, "set": 0.08, "fatigue": 0.02}})");
  EXPECT_NEAR(law.span_per_m[0], 75.35, 0.01);
  EXPECT_EQ(law.first_Nm[1], 4.64e-5);
  EXPECT_DOUBLE_EQ(law.first_Nm[2], 0.5 * 4.64e-5) << "twist has the loop of the weft";
  EXPECT_EQ(law.weft_Nm, 1.4e-5);
  EXPECT_EQ(law.setting, 0.08);
  EXPECT_EQ(law.fatigue, 0.02);
}

TEST(LoopInput, WhatKesReads) {
  const FrictionInBending law = loopOf(
      R"({"law": "hysteresis", "rigidity_weft": "0.1 gf cm", "rigidity_warp": "0.2 gf cm",
          "loop": {"hysteresis_weft": "0.1 gf", "hysteresis_warp": "0.15 gf", "friction_curvature": "30 1/m"}})");
  const Stops<kStops> weft{law.shape, law.first_Nm[0], law.weft_Nm, law.span_per_m[0]};
  EXPECT_NEAR(readKes(weft).rigidity_Nm, 9.80665e-6, 1e-15);
  EXPECT_NEAR(readKes(weft).hysteresis_N, 9.80665e-4, 1e-12);
  const Stops<kStops> warp{law.shape, law.first_Nm[1], law.warp_Nm, law.span_per_m[1]};
  EXPECT_NEAR(readKes(warp).hysteresis_N, 1.4709975e-3, 1e-12);
}

TEST(LoopInput, AMeasuredCurveAndASharpOne) {
  const FrictionInBending curve = loopOf(
      R"({"law": "hysteresis", "loop": {"axes": "isotropic", "virgin": [[20, 0.004], [60, 0.007], [100, 0.009]]}})");
  EXPECT_NEAR(curve.first_Nm[0], 2e-4, 1e-18);
  EXPECT_NEAR(curve.weft_Nm, 5e-5, 1e-18);
  EXPECT_NEAR(curve.twist_Nm, 2.5e-5, 1e-18);
  EXPECT_EQ(curve.span_per_m[0], 60);
  const FrictionInBending sharp = loopOf(
      R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"shape": "sharp", "initial_rigidity": 3e-5, "friction_curvature": 31.4}})");
  BentLine<kStops> line(Stops<kStops>{sharp.shape, sharp.first_Nm[0], sharp.weft_Nm, sharp.span_per_m[0]});
  EXPECT_NEAR(line.bend(31.4), 3e-5 * 31.4, 1e-15);
  EXPECT_NEAR(line.bend(50), 3e-5 * 31.4 + 1e-5 * (50 - 31.4), 1e-15);
  EXPECT_NEAR(line.bend(50 - 62.8), 1e-5 * (50 - 62.8) - 2e-5 * 31.4, 1e-15) << "back over twice the yield curvature";
}

/// What a case file says in full is what was read, to the last bit.
TEST(LoopInput, IsWrittenAsItWasRead) {
  const Folder folder;
  for (
      const char* bending :
      {R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"initial_rigidity": 3e-5, "friction_curvature": 60}})",
       R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"axes": "isotropic", "shape": "zheng", "initial_rigidity": 6e-5, "friction_curvature": 60, "set": 0.2}})",
       R"({"law": "hysteresis", "rigidity_weft": 1e-5, "rigidity_warp": 2e-5, "twist": 1e-6, "loop": {"hysteresis": 8e-4, "hysteresis_at": 50, "friction_curvature": 30}})",
       R"({"law": "hysteresis", "loop": {"virgin": [[20, 0.004], [60, 0.007], [100, 0.009]], "fatigue": 0.1}})",
       R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "set": 0.2, "set_by": "cycles"}})",
       R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "recovery": 0.3, "recovery_time": "10 s"}})",
       R"({"law": "hysteresis", "rigidity": 1e-5, "loop": {"axes": "isotropic", "initial_rigidity": 3e-5, "friction_curvature": 60, "recovery": 0.3, "recovery_time": "10 s"}})"}) {
    const Case c = readCase(folder.write("case.json", withBending(bending)));
    const std::string full = writeCase(c);
    EXPECT_EQ(writeCase(readCase(folder.write("again.json", full))), full);
    EXPECT_EQ(caseIdentity(readCase(folder.path() / "again.json")), caseIdentity(c));
  }
}

TEST(LoopInput, SaysWhatIsWrong) {
  const std::string loop = R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60})";
  const std::string bending = R"({"law": "hysteresis", "rigidity": 1e-5, )" + loop + "}";
  const auto refused = [&](const std::string& to, const std::string& key, const std::string& words) {
    expectRefused(withBending(bending), {{loop, to, 13, "fabric.bending" + key, words}});
  };
  refused(R"("twist": 0)", ".loop", "is required for the law hysteresis");
  refused(R"("loop": {"friction_curvature": 60})", ".loop.initial_rigidity", "is required, or");
  refused(R"("loop": {"initial_rigidity": 1e-6, "friction_curvature": 60})", ".loop.initial_rigidity",
          "1e-06 N m is out of range; allowed: above the rigidity, 1e-05 N m");
  refused(R"("loop": {"initial_rigidity": 3e-5})", ".loop.friction_curvature", "is required");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 0})", ".loop.friction_curvature", "allowed: > 0");
  refused(R"("loop": {"initial_rigidity": 3e-5, "c1": 1})", ".loop.c1", "1 N m^2 is out of range");
  refused(R"("loop": {"initial_rigidity": 3e-5, "c1": -1e-6, "friction_curvature": 60})", ".loop.c1", "excludes");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "fatigue": 1})", ".loop.fatigue", "< 1");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "set": -1})", ".loop.set", ">= 0");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "cycle": 1})", ".loop.cycle",
          "must make a stop slip");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "set_by": "cycle"})", ".loop.set_by", "slip");
  refused(R"("loop": {"axes": "isotropic", "initial_rigidity": 3e-5, "friction_curvature": 60, "set_by": "cycles"})",
          ".loop.set_by", "not possible with isotropic");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "set_by": "cycles", "set": 2})", ".loop.set",
          "<= 1");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "recovery": 0.3})", ".loop.recovery_time",
          "required with recovery");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "recovery_time": 3})", ".loop.recovery_time",
          "goes with recovery");
  refused(
      R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "set_by": "cycles", "recovery": 1, "recovery_time": 1})",
      ".loop.recovery", "without time");
  refused(R"("loop": {"hysteresis": 0.1, "friction_curvature": 200})", ".loop.hysteresis", "steeper by itself");
  refused(R"("loop": {"hysteresis": 1e-4, "initial_rigidity": 3e-5, "friction_curvature": 60})", ".loop.hysteresis",
          "excludes");
  refused(R"("loop": {"virgin": [[20, 0.004], [60, 0.007]]})", ".rigidity", "excludes \"virgin\"");
  refused(R"("loop": {"initial_rigidity": 3e-5, "friction_curvature": 60, "stops": [[0.5, 0.2]]})", ".loop.stops",
          "sum is 0.5");
  refused(R"("twist": 1, "loop": {"axes": "isotropic", "initial_rigidity": 3e-5, "friction_curvature": 60})", ".twist",
          "leave it out");
  refused(
      R"("loop": {"axes": "isotropic", "initial_rigidity_weft": 3e-5, "initial_rigidity_warp": 4e-5, "friction_curvature": 60})",
      ".loop.axes", "one loop");
  const auto refusedWhole = [&](const std::string& to, const std::string& key, const std::string& words) {
    expectRefused(withBending(bending), {{bending, to, 13, "fabric.bending.loop" + key, words}});
  };
  refusedWhole(R"({"law": "hysteresis", "loop": {"virgin": [[20, 0.004], [60, 0.02]]}})", ".virgin", "concave");
  refusedWhole(R"({"law": "linear", "rigidity": 1e-5, "loop": {"set": 0}})", "", "no meaning for the law linear");
}

TEST(FrictionInput, ANumberOrAnObject) {
  const Folder folder;
  const auto read = [&](const std::string& friction) {
    return readCase(folder.write("case.json", replaced(example, "\"friction\": 0.2", friction)));
  };
  const Case coulomb = read("\"friction\": 0.2");
  EXPECT_EQ(coulomb.contact.friction, FrictionLaw(0.2));
  EXPECT_FALSE(coulomb.contact.friction_cloth);
  const Case slips =
      read(R"("friction": {"kinetic": 0.1, "static": 0.4, "stribeck_speed": "40 cm/s", "stribeck_power": 0.2},
      "friction_cloth": 0.15)");
  EXPECT_EQ(slips.contact.friction.still, 0.4);
  EXPECT_EQ(slips.contact.friction.stribeck_m_per_s, 0.4);
  EXPECT_EQ(slips.contact.friction_cloth, FrictionLaw(0.15));
  const std::string full = writeCase(slips);
  EXPECT_EQ(writeCase(readCase(folder.write("again.json", full))), full);
  EXPECT_EQ(read(R"("friction": {"kinetic": 0.1})").contact.friction, FrictionLaw(0.1));
  const Case own = readCase(
      folder.write("own.json", replaced(example, "\"name\": \"floor\",",
                                        "\"name\": \"floor\", \"friction\": {\"kinetic\": 0.5, \"static\": 0.6},")));
  EXPECT_EQ(own.obstacles[1].friction->still, 0.6);
  expectRefused(
      example,
      {{"\"friction\": 0.2", R"("friction": {"kinetic": 0.4, "static": 0.3})", 27, "contact.friction.static",
        "0.3 is out of range; allowed: at least kinetic, 0.4"},
       {"\"friction\": 0.2", R"("friction": {"static": 0.3})", 27, "contact.friction.kinetic", "is required"},
       {"\"friction\": 0.2", R"("friction": {"kinetic": 0.4, "stribeck_power": 0})", 27,
        "contact.friction.stribeck_power", "allowed: > 0"},
       {"\"friction\": 0.2", R"("friction": {"kinetic": 0.4, "pressure_power": 0.8})", 27, "contact.friction.pressure",
        "is required with pressure_power"},
       {"\"friction\": 0.2", R"("friction": {"kinetik": 0.4})", 27, "contact.friction.kinetik", "did you mean"},
       {"\"friction\": 0.2", "\"friction\": true", 27, "contact.friction", "expected"}});
}

/// The fabric of the example with friction in shear.
FabricCase withShear(const std::string& loop) {
  const Folder folder;
  const std::string young = "\"young\": \"1.2 MPa\",";
  return readCase(folder.write("case.json", replaced(example, young, young + " \"shear\": \"122.5 kPa\", \"shear_loop\": " + loop + ",")))
      .fabric;
}

TEST(ShearLoopInput, WhatKesReads) {
  const FabricCase f = withShear(R"({"hysteresis": "4.9 N/m", "hysteresis_5": "7.2 N/m"})");
  const KesShear read = readKesShear({f.shear_Pa * f.thickness_m, f.shear_friction});
  EXPECT_NEAR(read.rigidity_N_per_m, 122.5, 1e-9);
  EXPECT_NEAR(read.hysteresis_N_per_m, 4.9, 1e-12);
  EXPECT_NEAR(read.hysteresis_5_N_per_m, 7.2, 1e-12);
  EXPECT_LT(f.shear_Pa, 122.5e3) << "a part of G is friction";
  const FabricCase own = withShear(R"({"rise": 200, "growth": 100, "friction_angle": "2 deg"})");
  EXPECT_EQ(own.shear_Pa, 122.5e3);
  EXPECT_EQ(own.shear_friction.rise_N_per_m, 200);
  EXPECT_EQ(own.shear_friction.growth_N_per_m, 100);
}

TEST(ShearLoopInput, ComesBackAsItWasWritten) {
  const Folder folder;
  const std::string young = "\"young\": \"1.2 MPa\",";
  const Case c = readCase(folder.write(
      "case.json", replaced(example, young, young + R"( "shear_loop": {"hysteresis": 4.9, "hysteresis_5": 7.2},)")));
  EXPECT_EQ(readCase(folder.write("full.json", writeCase(c))).fabric, c.fabric);
}

TEST(ShearLoopInput, RefusesWhatIsWrong) {
  const std::string young = "\"young\": \"1.2 MPa\",";
  const std::string good = replaced(example, young, young + R"( "shear_loop": {"hysteresis": 4.9, "hysteresis_5": 7.2},)");
  expectRefused(good, {{"\"hysteresis\": 4.9, ", "", 11, "fabric.shear_loop.hysteresis", "is required, or rise"},
                       {"\"hysteresis\": 4.9", "\"hysteresis\": 0", 11, "fabric.shear_loop.hysteresis", "> 0"},
                       {"\"hysteresis\": 4.9", "\"rise\": 4.9", 11, "fabric.shear_loop.hysteresis_5", "goes with"},
                       {"\"hysteresis\": 4.9", "\"rise\": 3, \"hysteresis\": 4.9", 11, "fabric.shear_loop.rise", "excludes"},
                       {"\"hysteresis_5\": 7.2", "\"growth\": 7.2", 11, "fabric.shear_loop.growth", "goes with rise"},
                       {"\"hysteresis_5\": 7.2", "\"hysteresis_5\": 4", 11, "fabric.shear_loop.hysteresis_5", "allowed"},
                       {"\"hysteresis_5\": 7.2", "\"friction_angle\": \"9 deg\"", 11, "fabric.shear_loop.friction_angle", "<= 8.02141 deg"},
                       {"\"hysteresis\": 4.9", "\"hysteresis\": 300", 11, "fabric.shear_loop.hysteresis_5", "out of range"}});
}

}  // namespace
}  // namespace gambeson
