/// Every check that a run makes has words for when it fails.

#include "cases/wear/results/check_words.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/input/message.hpp"
#include "cases/wear/results/write.hpp"

namespace gambeson {
namespace {

TEST(CheckWords, EveryCheckOfARunHasThem) {
  Measured m;
  m.limited = true;
  m.surface_depth.emplace();
  SupportMeasure springs;
  springs.springs = true;
  springs.name = "waist";
  m.supports = {springs};
  JointMeasure joint;
  joint.peak.value = 1;
  joint.second_stride.emplace();
  joint.second_stride->samples = 1;
  m.joints = {joint};
  m.garment_order = {{"shirt", "trousers", 1}};
  m.comfort.push_back({"waist", {}, 900, 3e5, 0.5, 0, 0});
  const auto checks = auditOf(m);
  EXPECT_EQ(checks.size(), 14u);
  const std::string unknown = checkWords("no such check", 1, 0, "").means;
  for (const AuditCheck& c : checks) {
    EXPECT_NE(checkWords(c.name, 1, c.limit, c.unit).means, unknown) << c.name;
    EXPECT_FALSE(checkWords(c.name, 1, c.limit, c.unit).wrong.empty());
    const std::string said = notMet(c.name, 12345.678, c.limit, c.unit);
    EXPECT_EQ(messageText(said), said) << "is too long for a message";
  }
  EXPECT_TRUE(checkWords("no such check", 1, 0, "").order);  // what is not known spoils everything
}

TEST(CheckWords, SayWhatIsAllowed) {
  EXPECT_EQ(checkWords("Penetration", 0.51, 0.2, "mm").wrong,
            "contact points of the cloth lie up to 0.51 mm (allowed: 0.20 mm) inside the body");
  EXPECT_NE(checkWords("Repeatability, shape", 0.1, 0.05, "").wrong.find("allowed: at least 0.95"), std::string::npos);
  EXPECT_NE(checkWords("Contact solver", 1.04, 1, "%").wrong.find("1.04 % (allowed: 1.00 %)"), std::string::npos);
  // A sign and a multiple in words, where "-490 % of the work is unaccounted for" says nothing.
  EXPECT_EQ(checkWords("Energy", -490, 5, "%").wrong,
            "the cloth lost energy that no work on it explains, 4.9 times the work of all forces together (allowed: "
            "5.0 % either way)");
  EXPECT_EQ(checkWords("Energy", 7.5, 5, "%").wrong,
            "the cloth gained energy that no work on it explains, 7.5 % of the work of all forces (allowed: 5.0 % "
            "either way)");
  EXPECT_EQ(checkWords("Energy", NAN, 5, "%").wrong, "the energy of the cloth is no number");
  // Where nothing is allowed there is nothing to say.
  EXPECT_EQ(checkWords("Intersections", 3, 0, "").wrong, "cloth passes through cloth at 3 places at the end");
}

}  // namespace
}  // namespace gambeson
