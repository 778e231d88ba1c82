#include "core/math/block_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

namespace gambeson {
namespace {

/// Points on a strip three wide, of which each four around a place are a group.
struct Strip {
  int length;
  int size() const { return 3 * length; }
  std::vector<int> offsets{0}, members;
  explicit Strip(int n) : length(n) {
    for (int i = 0; i + 1 < n; ++i)
      for (int j = 0; j < 2; ++j) {
        for (int p : {3 * i + j, 3 * i + j + 1, 3 * i + 3 + j, 3 * i + 4 + j}) members.push_back(p);
        offsets.push_back(static_cast<int>(members.size()));
      }
  }
};

TEST(BlockLu, SolvesWhatAFullMatrixSolves) {
  const Strip strip(17);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  BlockLu lu(strip.size(), strip.offsets, strip.members);
  for (int round = 0; round < 2; ++round) {  // once more with other values
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * strip.size(), 3 * strip.size());
    lu.clear();
    const auto add = [&](int r, int c, const Eigen::Matrix3d& block) {
      lu.add(r, c, block);
      A.block<3, 3>(3 * r, 3 * c) += block;
    };
    for (int i = 0; i < strip.size(); ++i) add(i, i, 8 * Eigen::Matrix3d::Identity());
    for (std::size_t g = 0; g + 1 < strip.offsets.size(); ++g)
      for (int a = strip.offsets[g]; a < strip.offsets[g + 1]; ++a)
        for (int b = strip.offsets[g]; b < strip.offsets[g + 1]; ++b)
          add(strip.members[a], strip.members[b], Eigen::Matrix3d::NullaryExpr([&] { return part(random); }));
    Eigen::VectorXd b = Eigen::VectorXd::NullaryExpr(3 * strip.size(), [&] { return part(random); });
    std::vector<Vec3> x(strip.size());
    for (int i = 0; i < strip.size(); ++i) x[i] = {b[3 * i], b[3 * i + 1], b[3 * i + 2]};
    ASSERT_TRUE(lu.factorise());
    lu.solve(x);
    const Eigen::VectorXd exact = A.partialPivLu().solve(b);
    for (int i = 0; i < 3 * strip.size(); ++i) EXPECT_NEAR(x[i / 3][i % 3], exact[i], 1e-11);
  }
}

TEST(BlockLu, SaysThatAPivotIsSingular) {
  const std::vector<int> offsets{0, 2}, members{0, 1};
  BlockLu lu(2, offsets, members);
  lu.clear();
  lu.add(0, 0, Eigen::Matrix3d::Identity());
  lu.add(1, 1, Eigen::Vector3d(1, 0, 1).asDiagonal());
  EXPECT_FALSE(lu.factorise());
}

}  // namespace
}  // namespace gambeson
