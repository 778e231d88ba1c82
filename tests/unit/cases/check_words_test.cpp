/// Every check that a run makes has words for when it fails.

#include "cases/check_words.hpp"

#include <gtest/gtest.h>

#include "cases/results_write.hpp"

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
  const auto checks = auditOf(m);
  EXPECT_EQ(checks.size(), 12u);
  const std::string unknown = checkWords("no such check", 1, "").means;
  for (const AuditCheck& c : checks) {
    EXPECT_NE(checkWords(c.name, 1, c.unit).means, unknown) << c.name;
    EXPECT_FALSE(checkWords(c.name, 1, c.unit).wrong.empty());
  }
  EXPECT_TRUE(checkWords("no such check", 1, "").order);  // what is not known spoils everything
}

}  // namespace
}  // namespace gambeson
