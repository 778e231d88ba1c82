/// The certified query as kernels have it against core's, and the rough boxes before it.
#include <gtest/gtest.h>

#include "core/contact/impact_query.hpp"
#include "gpu/finding/float_point.hpp"
#include "tools/impact_questions.hpp"

namespace gambeson::gpu {
namespace {

TEST(Answers, AreCoresToTheLastBit) {
  const std::vector<ImpactQuestion> asked = impactQuestions(100000);
  const std::vector<ImpactAnswer> got = answersOnReference(asked);
  int hits = 0;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    ASSERT_TRUE(sameBits(got[i], answerOfCore(asked[i]))) << i;
    hits += got[i].meets;
  }
  EXPECT_GT(hits, 30000);
  EXPECT_LT(hits, 90000);
}

template <int N>
bool apartInDouble(const ImpactQuestion& q) {
  const auto query = certified::queryOf<N>(q.x0, q.x1, q.separation_m);
  return query.sound && query.boxesApart();
}

/// Rough boxes leave every pair that exact ones leave, and hardly any other.
TEST(Answers, RoughBoxesAreNeverApartWhereExactOnesAreNot) {
  int exact = 0, rough = 0;
  for (const ImpactQuestion& q : impactQuestions(100000)) {
    const bool edges = q.kind == PairKind::edgeEdge;
    FloatPoint p[4];
    for (int k = 0; k < 4; ++k) p[k] = floatPoint({q.x0[k], q.x1[k]});
    const float separation_m = roundedUp(q.separation_m, 0);
    const bool says_rough = edges ? surelyApart<4>(p, separation_m) : surelyApart<3>(p, separation_m);
    const bool says_exact = edges ? apartInDouble<4>(q) : apartInDouble<3>(q);
    ASSERT_TRUE(says_exact || !says_rough);
    exact += says_exact, rough += says_rough;
  }
  EXPECT_GT(exact, 1000);
  EXPECT_GT(rough, 0.9 * exact);
}

}  // namespace
}  // namespace gambeson::gpu
