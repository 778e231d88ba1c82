// The terms of laboratories in each other's: published pairs, cards that say them, and what contradicts itself.
#include "cases/cloth/card_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/cloth/card.hpp"
#include "cases/cloth/card_library.hpp"
#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "cases/cloth/law_table.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

TEST(CardTerms, HaveThePublishedPairs) {
  EXPECT_NEAR(lab::kGfCm2PerCm_Nm, 9.807e-5, 5e-9);       // 1 gf cm^2/cm
  EXPECT_NEAR(lab::kGfPerCmDeg_N_per_m, 56.19, 5e-3);     // 1 gf/(cm deg) per radian
  EXPECT_NEAR(500 * lab::kGfPerCm_N_per_m, 490.3, 0.05);  // the largest load of KES-FB1
  // FAST instruction manual: B = 9.81e-6 W C^3 uN m of g/m^2 and mm, G = 123/EB5 N/m, formability B (E20 - E5)/14.7.
  EXPECT_NEAR(lab::rigidityOfLength(18e-3, 0.2), 9.81e-12 * 200 * 18 * 18 * 18, 5e-9);
  EXPECT_NEAR(lab::shearOfBias(0.03), 123 / 3., 0.2);
  EXPECT_NEAR(lab::formability(11.4e-6, 0.005, 0.02), 11.4e-6 * 0.015 / 14.7, 1e-11);
  // WT = LT EMT 500/2 in gf cm/cm^2: denim D of Journal of Textiles 2016, 4614168, table 5.
  EXPECT_NEAR(lab::linearity(8.675 * 0.980665, 0.05135, 490.3325), 0.676, 1e-3);
}

TEST(CardTerms, Invert) {
  EXPECT_NEAR(lab::lengthOfRigidity(lab::rigidityOfLength(0.021, 0.3), 0.3), 0.021, 1e-15);
  EXPECT_NEAR(lab::biasOfShear(lab::shearOfBias(0.04)), 0.04, 1e-15);
  EXPECT_NEAR(lab::strainUnder(490, lab::stiffnessAt(490, 0.3)), 0.3, 1e-14);
  EXPECT_NEAR(lab::strainUnder(5, lab::stiffnessAt(5, 0.01)), 0.01, 1e-15);
}

// Line 1 is that of the brace.
const std::string fast = R"json({
  "name": "suiting",
  "source": "a sheet of FAST",
  "W": "200 g/m^2",
  "T0": "0.62 mm",
  "Tm": "0.5 mm",
  "FAST": {
    "E5_weft": "0.5 %", "E20_weft": "1.6 %", "E100_weft": "4.4 %",
    "E5_warp": "0.2 %", "E20_warp": "0.7 %", "E100_warp": "2.1 %",
    "EB5": "3.1 %", "G": "39.6 N/m",
    "C_weft": "16 mm", "C_warp": "18 mm", "B_weft": "8 uN m", "B_warp": "11.4 uN m",
    "ST": "0.11 mm"
  },
  "elongation": "30 %",
  "strength_weft": "60 N/m",
  "strength_warp": "9000 N/m"
}
)json";

TEST(CardTerms, ASheetOfFastIsAFabric) {
  const Folder folder;
  const FabricCard card = readCard(folder.write("fast.card.json", fast));
  EXPECT_EQ(card.thickness_m, 0.62e-3);
  EXPECT_NEAR(card.shear->rigidity.mean(), 4.903325 / (4 * 0.031), 1e-9);
  EXPECT_NEAR(*card.bending.rigidity.warp, 0.2 * 9.80665 * std::pow(0.018, 3), 1e-16);
  const FabricCase f = fabricOf(card).fabric;
  const Voigt A = pointLaw(f).section.A;
  // 100 gf/cm stretch the weft by 4.4 %, and the strength of 60 N/m is reached before the elongation.
  EXPECT_NEAR(A[0] * 1.044 * (0.044 + 0.5 * 0.044 * 0.044), 98.0665, 1e-9);
  const double E = *f.limit_strain_weft, e = std::sqrt(1 + 2 * E) - 1;
  EXPECT_NEAR(A[0] * E * (1 + e), 60, 1e-9);
  EXPECT_NEAR(*f.limit_strain_warp, 0.3 + 0.045, 1e-15) << "elongation, e + e^2/2";
}

TEST(CardTerms, ALimitOfTheCardIsThatOfTheFabricUnlessTheCaseSaysAnother) {
  const Folder folder;
  folder.write("fast.card.json", fast);
  const auto read = [&](const std::string& text) {
    const std::filesystem::path file = folder.write("fabric.json", text);
    const JsonNode root = readJson(file);
    const std::string name = file.string();
    const schema::Entry entry{root, "", name};
    schema::FabricInput in;
    schema::readObject(schema::fabricTable(), entry, &in);
    return schema::resolveFabric(entry, in);
  };
  EXPECT_NEAR(*read(R"({"card": "fast.card.json"})").limit_strain_warp, 0.345, 1e-15);
  EXPECT_EQ(*read(R"({"card": "fast.card.json", "limit_strain_warp": 0.1})").limit_strain_warp, 0.1);
  EXPECT_LT(*read(R"({"card": "fast.card.json", "limit_strain_warp": 0.1})").limit_strain_weft, 0.1);
}

schema::FabricInput inputOf(const schema::Entry& entry) {
  schema::FabricInput in;
  schema::readObject(schema::fabricTable(), entry, &in);
  return in;
}

FabricCase fabricOfText(const std::string& text) {
  const JsonNode root = parseJson(text, "fabric.json");
  const std::string name = "fabric.json";
  const schema::Entry entry{root, "", name};
  return schema::resolveFabric(entry, inputOf(entry));
}

// What laboratories give per width needs no thickness: forces per width are those of the same sheet with one.
TEST(CardTerms, AFabricInNewtonsPerMetreNeedsNoThickness) {
  const std::string bending = R"("bending": {"law": "linear", "rigidity": "1e-5 N m"})";
  const std::string membrane =
      R"json("stiffness_weft": "8000 N/m", "stiffness_warp": "500 N/5cm", "shear_stiffness": "1 gf/(cm deg)",)json";
  const FabricCase thin = fabricOfText("{\"surface_density\": \"320 gsm\", " + membrane + bending + "}"),
                   thick = fabricOfText("{\"thickness\": \"2 mm\", \"surface_density\": \"320 gsm\", " + membrane +
                                        bending + "}");
  EXPECT_NEAR(thin.thickness_m, 0.32 / 400, 1e-15);
  EXPECT_EQ(thick.thickness_m, 2e-3);
  EXPECT_TRUE(thin.thickness_assumed);
  EXPECT_FALSE(thick.thickness_assumed);
  for (const FabricCase* f : {&thin, &thick}) {
    EXPECT_NEAR(f->young_weft_Pa * f->thickness_m, 8000, 1e-9);
    EXPECT_NEAR(f->young_warp_Pa * f->thickness_m, 10000, 1e-9);
    EXPECT_NEAR(f->shear_Pa * f->thickness_m, 56.187965, 1e-5);
    EXPECT_NEAR(f->surfaceDensity(), 0.32, 1e-15);
  }
  const Voigt a = pointLaw(thin).section.A, b = pointLaw(thick).section.A;
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-12 * 10000);
  const FabricCase even =
      fabricOfText(R"({"surface_density": "320 gsm", "stiffness": "600 N/m", "poisson": 0.2, )" + bending + "}");
  EXPECT_NEAR(even.shear_Pa * even.thickness_m, 600 / 2.4, 1e-9);
  // In place of a card's.
  const FabricCase of_card = fabricOfText(R"({"card": "denim_a", "stiffness_weft": "3000 N/m"})");
  EXPECT_NEAR(of_card.young_weft_Pa * of_card.thickness_m, 3000, 1e-9);
  EXPECT_EQ(of_card.young_warp_Pa, fabricOf(readCard("denim_a")).fabric.young_warp_Pa);
  const auto refused = [&](const std::string& text) {
    try {
      fabricOfText(text);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refused("{\"density\": 400, " + membrane + bending + "}"), "thickness");
  EXPECT_EQ(refused(R"({"surface_density": 0.3, "stiffness_weft": 8000, "shear_stiffness": 50, )" + bending + "}"),
            "stiffness_warp");
  EXPECT_EQ(refused(R"({"surface_density": 0.3, "stiffness": 8000, "stiffness_weft": 8000, )" + bending + "}"),
            "stiffness_weft");
  EXPECT_EQ(refused(R"({"thickness": 1e-3, "surface_density": 0.3, "stiffness": 8000, "shear": 1e5, )" + bending + "}"),
            "stiffness");
}

TEST(CardTerms, PointsAreACurveWhereTheCardSaysSo) {
  const Folder folder;
  const FabricCard card = readCard(folder.write("curve.card.json", R"json({
  "name": "knit", "source": "a strip", "weight": "180 g/m^2",
  "tensile": {"law": "curve", "curve_weft": [["5 %", "2 gf/cm"], ["20 %", "20 gf/cm"], ["40 %", "200 gf/cm"]],
              "curve_warp": [["3 %", "2 gf/cm"], ["30 %", "200 gf/cm"]]},
  "shear": {"G": "0.5 gf/(cm deg)"},
  "bending": {"c": "1.5 cm"},
  "strength": "150 N/m"
})json"));
  const CardFabric made = fabricOf(card);
  const FabricCase& f = made.fabric;
  ASSERT_TRUE(f.energy && f.energy_source);
  EXPECT_NEAR(f.thickness_m, 0.18 / 400, 1e-15);
  EXPECT_NEAR(f.energy->at({{0.2 + 0.02, 0, 0}, {}}).resultant[0] * 1.2, 20 * 0.980665, 1e-9);
  EXPECT_NEAR(f.energy->at({{0, 0, 0.1}, {}}).resultant[2], 0.05 * 56.187965, 1e-6);
  EXPECT_NEAR(f.energy->at({{}, {10, 0, 0}}).moment[0], 10 * 0.18 * 9.80665 * std::pow(0.015, 3), 1e-12);
  const double E = *f.limit_strain_warp;
  EXPECT_NEAR(f.energy->at({{0, E, 0}, {}}).resultant[1] * std::sqrt(1 + 2 * E), 150, 1e-6);
  // Written out, as a finished run has it, it is the same without its card.
  const schema::FabricInput in = schema::restoreFabric(f);
  const std::string text = schema::toText(schema::writeObject(schema::fabricTable(), &in));
  const JsonNode root = parseJson(text, "again.json");
  const std::string name = "again.json";
  const schema::Entry entry{root, "", name, true};
  schema::FabricInput again;
  schema::readObject(schema::fabricTable(), entry, &again);
  const FabricCase same = schema::resolveFabric(entry, again);
  EXPECT_EQ(same.energy_source->table(), f.energy_source->table());
  EXPECT_EQ(same.limit_strain_weft, f.limit_strain_weft);
  EXPECT_NE(schema::lawInWords(*f.energy_source).find("40.0 %"), std::string::npos)
      << schema::lawInWords(*f.energy_source);
}

TEST(CardTerms, WhatContradictsItselfIsSaid) {
  const Folder folder;
  const std::vector<Bad> cases{
      {"39.6 N/m", "45 N/m", 10, "FAST.G", "contradicts EB5"},
      {"8 uN m", "12 uN m", 11, "FAST.B_weft", "contradicts C and W"},
      {"\"E20_weft\": \"1.6 %\"", "\"E20_weft\": \"0.4 %\"", 8, "FAST.E20_weft", "contradicts E5"},
      {"\"E20_weft\": \"1.6 %\", ", "", 7, "FAST.E20_weft", "is required beside"},
      {"\"Tm\": \"0.5 mm\"", "\"Tm\": \"0.7 mm\"", 6, "Tm", "contradicts T0"},
      {"  \"W\": \"200 g/m^2\",\n", "", 1, "W", "is required where FAST has C"},
      {"\"W\": \"200 g/m^2\"", "\"W\": \"200 g/m^2\", \"weight\": \"200 g/m^2\"", 4, "W", "excludes"},
      {"\"elongation\": \"30 %\"", "\"bending\": {\"B\": \"9 uN m\"}", 14, "bending", "is said by C or B of FAST"},
      {"\"elongation\": \"30 %\"", "\"shear\": {\"G\": \"40 N/(m rad)\"}", 14, "shear", "is said by EB5"},
      {"\"elongation\": \"30 %\"", "\"tensile\": {\"EMT\": \"5 %\"}", 14, "tensile", "is said by E100"},
      {"strength_warp", "strength", 16, "strength", "excludes"}};
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.from + " -> " + c.to);
    try {
      readCard(folder.write("bad.card.json", replaced(fast, c.from, c.to)));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().line, c.line) << e.what();
      EXPECT_EQ(e.where().key, c.key) << e.what();
      EXPECT_NE(e.reason().find(c.reason), std::string::npos) << e.what();
    }
  }
}

TEST(CardTerms, WorkAndLinearityAgreeOrAreSaidNotTo) {
  const Folder folder;
  const std::string kes = R"json({
  "name": "denim", "source": "table 5", "weight": "380 g/m^2",
  "tensile": {"EMT": "5.735 %", "WT": "9.4 gf cm/cm^2"},
  "bending": {"B": "0.144 gf cm^2/cm"}
}
)json";
  const FabricCard card = readCard(folder.write("kes.card.json", kes));
  EXPECT_NEAR(*card.tensile->linearity.both, 0.655, 1e-3) << "as the table has it";
  const auto refused = [&](const std::string& from, const std::string& to) -> std::string {
    try {
      readCard(folder.write("bad.card.json", replaced(kes, from, to)));
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().line, 3) << e.what();
      return e.what();
    }
    return "accepted";
  };
  // Denim A is printed with WT 0.825 beside EMT 5.515 % and LT 0.712: a digit is lost.
  EXPECT_NE(refused(R"("EMT": "5.735 %", "WT": "9.4)", R"("EMT": "5.515 %", "LT": 0.712, "WT": "0.825)")
                .find("contradicts LT 0.712"),
            std::string::npos);
  EXPECT_NE(refused("9.4 gf", "30 gf").find("out of range"), std::string::npos);
  EXPECT_NE(refused("\"WT\": \"9.4 gf cm/cm^2\"", "\"law\": \"curve\"").find("needs LT or WT"), std::string::npos);
  EXPECT_NE(refused("\"WT\": \"9.4 gf cm/cm^2\"", "\"modulus\": \"8000 N/m\"").find("excludes \"EMT\""),
            std::string::npos);
  EXPECT_NE(refused("\"WT\"", "\"law\": \"curve\", \"poisson\": 0.2, \"WT\"").find("do not couple"), std::string::npos);
}

TEST(CardLibrary, ANameIsACard) {
  EXPECT_EQ(readCard("denim_b").name, "Denim B");
  EXPECT_GE(libraryCards().size(), 16u);
  const auto read = [](const std::string& text) {
    const JsonNode root = parseJson(text, "case.json");
    const std::string name = "case.json";
    const schema::Entry entry{root, "", name};
    schema::FabricInput in;
    schema::readObject(schema::fabricTable(), entry, &in);
    return schema::resolveFabric(entry, in);
  };
  const FabricCase f = read(R"({"card": "denim_b"})");
  EXPECT_EQ(f.name, "Denim B");
  EXPECT_EQ(f.card, "denim_b");
  try {
    read(R"({"card": "denim_bb"})");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "card");
    EXPECT_EQ(e.where().line, 1);
    EXPECT_NE(e.reason().find("did you mean"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace gambeson
