// Fabric cards: what is refused, what is assumed, and the fabric that a case gets from one.
#include "cases/cloth/card.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "cases/wear/case/case.hpp"
#include "core/material/fabric_law.hpp"
#include "core/material/hysteresis.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

// The first line below is line 1 of the file.
const std::string denim = R"json({
  "name": "denim",
  "source": "table 5",
  "thickness": "1.066 mm",
  "weight": "430 g/m^2",
  "tensile": {"EMT": "5.515 %", "LT": 0.712, "poisson": 0.1},
  "shear": {"G": "2.18 gf/(cm deg)", "2HG": "5.012 gf/cm", "2HG5": "7.412 gf/cm"},
  "bending": {
    "B": "0.172 gf cm^2/cm",
    "2HB": "0.139 gf cm/cm",
    "2HB_at": "1 1/cm",
    "K0": "0.6 1/cm"
  },
  "MIU": 0.18
}
)json";

TEST(Card, RefusesWhatIsWrong) {
  const Folder folder;
  ASSERT_NO_THROW(readCard(folder.write("good.card.json", denim)));
  const std::vector<Bad> cases{
      {"0.172 gf", "-0.172 gf", 9, "bending.B", "out of range; allowed: > 0"},
      {"\"0.172 gf cm^2/cm\"", "0.172", 9, "bending.B", "has no unit"},
      {"\"0.172 gf cm^2/cm\"", "\"0.172\"", 9, "bending.B", "has no unit"},
      {"0.172 gf cm^2/cm", "0.172 gf cm/cm", 9, "bending.B", "wrong unit"},
      {"    \"B\": \"0.172 gf cm^2/cm\",\n", "", 8, "bending.B", "is required"},
      {"\"B\":", "\"B_weft\":", 8, "bending.B_warp", "is required beside B_weft"},
      {"\"B\":", "\"rigidity\":", 9, "bending.rigidity", "unknown key"},
      {"\"1 1/cm\"", "\"2.5 1/cm\"", 11, "bending.2HB_at", "< 2.5 1/cm"},
      {"\"0.6 1/cm\"", "\"2.6 1/cm\"", 12, "bending.K0", "<= 2.5 1/cm"},
      {"\"0.6 1/cm\"", "\"0 1/cm\"", 12, "bending.K0", "> 0"},
      {"\"0.139 gf cm/cm\"", "\"-0.139 gf cm/cm\"", 10, "bending.2HB", "> 0"},
      {"    \"2HB\": \"0.139 gf cm/cm\",\n", "", 10, "bending.2HB_at", "no meaning without 2HB"},
      // A friction that is overcome at 2.4/cm only rises between 0.5 and 1.5/cm by more than all of B.
      {"\"0.139 gf cm/cm\",\n    \"2HB_at\": \"1 1/cm\",\n    \"K0\": \"0.6 1/cm\"",
       "\"0.8 gf cm/cm\",\n    \"2HB_at\": \"1 1/cm\",\n    \"K0\": \"2.4 1/cm\"", 10, "bending.2HB",
       "allowed: at most"},
      {"\"EMT\": \"5.515 %\"", "\"EMT\": \"60 %\"", 6, "tensile.EMT", "<= 50 %"},
      {"\"EMT\": \"5.515 %\", ", "", 6, "tensile.EMT", "is required, or modulus"},
      {"\"LT\": 0.712", "\"LT\": 2", 6, "tensile.LT", "<= 1.9"},
      {"\"poisson\": 0.1", "\"poisson\": 1", 6, "tensile.poisson", "< 1"},
      {"\"poisson\": 0.1", "\"secant_at\": \"600 gf/cm\"", 6, "tensile.secant_at", "at most load"},
      {"\"G\": \"2.18 gf/(cm deg)\"", "\"G\": \"2.18 gf/cm\"", 7, "shear.G", "wrong unit"},
      {"\"2HG\": \"5.012 gf/cm\", ", "", 7, "shear.2HG5", "needs 2HG"},
      {"7.412 gf/cm", "4.9 gf/cm", 7, "shear.2HG5", "out of range; allowed beside 2HG"},
      {"2.18 gf/(cm deg)", "0.2 gf/(cm deg)", 7, "shear.2HG", "what friction alone gives it"},
      {"  \"thickness\": \"1.066 mm\",\n  \"weight\": \"430 g/m^2\",\n", "", 1, "thickness", "is required, or weight"},
      {"\"430 g/m^2\"", "\"0 g/m^2\"", 5, "weight", ">= 0.1 and <= 10000 g/m^2"},
      {"\"MIU\": 0.18", "\"MIU\": 1.8e3", 14, "MIU", "<= 2"},
      {"\"source\"", "\"sauce\"", 3, "sauce", "did you mean \"source\"?"}};
  for (const Bad& c : cases) {
    SCOPED_TRACE(c.from + " -> " + c.to);
    const std::filesystem::path file = folder.write("bad.card.json", replaced(denim, c.from, c.to));
    try {
      readCard(file);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, file.string()) << e.what();
      EXPECT_EQ(e.where().line, c.line) << e.what();
      EXPECT_EQ(e.where().key, c.key) << e.what();
      EXPECT_NE(e.reason().find(c.reason), std::string::npos) << e.what();
    }
  }
}

TEST(Card, GivesTheFabricThatWasMeasured) {
  const Folder folder;
  const FabricCard card = readCard(folder.write("d.card.json", denim));
  const CardFabric made = fabricOf(card);
  const FabricCase& f = made.fabric;
  EXPECT_NEAR(f.surfaceDensity(), 0.43, 1e-12);
  const KesShear sheared = readKesShear({f.shear_Pa * f.thickness_m, f.shear_friction});
  EXPECT_NEAR(sheared.rigidity_N_per_m, 2.18 * 56.187965, 1e-3);
  EXPECT_NEAR(sheared.hysteresis_N_per_m, 5.012 * 0.980665, 1e-9);
  EXPECT_NEAR(sheared.hysteresis_5_N_per_m, 7.412 * 0.980665, 1e-9);
  // Pulled to EMT at kept width, the law n = A E has 500 gf/cm.
  const Voigt A = pointLaw(f).section.A;
  const double e = 0.05515;
  EXPECT_NEAR((1 + e) * A[0] * (e + 0.5 * e * e), 490.3325, 1e-9);
  EXPECT_NEAR(A[0], A[1], 1e-9);
  EXPECT_EQ(f.poisson, 0.1);
  const auto& law = std::get<IsotropicHysteresisBending>(f.law);
  const KesBending read = readKes(Stops<kStops>{law.shape, law.first_Nm[0], law.weft_Nm, law.span_per_m[0]});
  EXPECT_NEAR(read.rigidity_Nm, 0.172 * 9.80665e-5, 1e-15);
  EXPECT_NEAR(read.hysteresis_N, 0.139 * 9.80665e-3, 1e-12);
  EXPECT_EQ(law.span_per_m[0], 60);
  ASSERT_FALSE(made.assumed.empty());
  for (const std::string& line : made.assumed) EXPECT_EQ(line.find("K0"), std::string::npos) << "the card has it";
}

TEST(Card, SaysWhatItAssumes) {
  const Folder folder;
  const CardFabric made = fabricOf(readCard(folder.write("little.card.json",
                                                         R"({"name": "a", "source": "b", "thickness": "1 mm",
          "bending": {"B": "0.1 gf cm", "2HB": "0.02 gf", "2HB_at": "1 1/cm"}})")));
  for (const char* what : {"weight 400", "EMT 5 %", "poisson 0", "G 1 gf", "K0 0.5/cm", "about all axes"})
    EXPECT_TRUE(std::any_of(made.assumed.begin(), made.assumed.end(), [&](const std::string& s) {
      return s.find(what) != std::string::npos;
    })) << what;
}

TEST(Card, SecantsFollowTheCurveOfLt) {
  FabricCard card;
  card.name = card.source = "x";
  card.thickness_m = 1e-3;
  card.bending.rigidity.both = 1e-5;
  CardTensile& t = card.tensile.emplace();
  t.extension.both = 0.05;
  t.linearity.both = 2. / 3;  // F = F_max (e/EMT)^2
  t.secant_at_N_per_m = t.load_N_per_m / 4;
  const double e = 0.025;
  EXPECT_NEAR(pointLaw(fabricOf(card).fabric).section.A[0], t.load_N_per_m / 4 / ((1 + e) * (e + 0.5 * e * e)), 1e-9);
}

const std::string usual_fabric = R"(  "fabric": {
    "thickness": "1 mm",
    "density": "436 kg/m^3",
    "young": "1.2 MPa",
    "poisson": 0.3,
    "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"}
  },)";

TEST(Card, IsTheFabricOfACase) {
  const Folder folder;
  folder.write("d.card.json", denim);
  const FabricCase made = fabricOf(readCard(folder.path() / "d.card.json")).fabric;
  const Case c = readCase(
      folder.write("case.json", replaced(example, usual_fabric, "  \"fabric\": {\"card\": \"d.card.json\"},")));
  EXPECT_EQ(static_cast<const Fabric&>(c.fabric), static_cast<const Fabric&>(made));
  EXPECT_EQ(c.fabric.card, folder.path() / "d.card.json");
  const std::vector<std::filesystem::path> inputs = inputsOf(c);
  EXPECT_NE(std::find(inputs.begin(), inputs.end(), c.fabric.card), inputs.end());
  // Written out in full it is the same case, and stays so without its card once it has run.
  const std::filesystem::path full = folder.write("full.json", writeCase(c));
  EXPECT_EQ(readCase(full).fabric, c.fabric);
  const std::string identity = caseIdentity(c);
  // What else is given stands in place of the card's.
  const Case other = readCase(folder.write(
      "other.json", replaced(example, usual_fabric,
                             "  \"fabric\": {\"card\": \"d.card.json\", \"surface_density\": 0.2, \"shear\": 5e4, "
                             "\"bending\": {\"law\": \"linear\", \"rigidity\": 1e-5}},")));
  EXPECT_NEAR(other.fabric.surfaceDensity(), 0.2, 1e-15);
  EXPECT_EQ(other.fabric.shear_Pa, 5e4);
  EXPECT_EQ(other.fabric.young_weft_Pa, made.young_weft_Pa);
  EXPECT_TRUE(std::holds_alternative<LinearBending>(other.fabric.law));
  // The content of the card is part of the case.
  folder.write("d.card.json", replaced(denim, "table 5", "table 6"));
  EXPECT_NE(caseIdentity(readCase(folder.path() / "case.json")), identity);
}

TEST(Card, WrongCardsAreNamedWithTheirLine) {
  const Folder folder;
  folder.write("d.card.json", replaced(denim, "0.172 gf", "-1 gf"));
  const std::filesystem::path file =
      folder.write("case.json", replaced(example, usual_fabric, "  \"fabric\": {\"card\": \"d.card.json\"},"));
  try {
    readCase(file);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, (folder.path() / "d.card.json").string());
    EXPECT_EQ(e.where().line, 9);
  }
}

}  // namespace
}  // namespace gambeson
