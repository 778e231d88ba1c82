/// What an island does between sweeps when its residual does not fall.

#include "core/contact/row_sweep.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

constexpr SweepLimits kLimits{1e-9, 100000, 100000};

/// After `sweeps`, each of which finds the residual `grows` times as large as the one before.
ContactWork::Island swept(int sweeps, double grows) {
  ContactWork::Island island;
  island.row_end = 2;
  double residual = 1;
  for (int k = 0; k < sweeps; ++k, residual *= grows) {
    const Ahead ahead = aheadOf(island.momentum);
    sweptWith(residual * residual, kLimits, island);
    goOn(-1, kLimits, ahead, island);
  }
  return island;
}

/// Momentum may go round, but not grow without end: its sequence begins anew with shorter steps, and in the end no
/// more.
TEST(RowSweep, GrowthWithoutEndEndsMomentum) {
  const ContactWork::Island few = swept(16, 1.3), many = swept(80, 1.3);
  EXPECT_GT(few.caution, 1);
  EXPECT_FALSE(few.calm);
  EXPECT_GT(few.beta, 0);
  EXPECT_DOUBLE_EQ(many.caution, 4 / 1.2);
  EXPECT_TRUE(many.calm);
  EXPECT_EQ(many.beta, 0);
}

/// A residual that stays gets shorter steps, but keeps its momentum: patterns that hardly move need it.
TEST(RowSweep, WaitingKeepsMomentum) {
  const ContactWork::Island island = swept(2000, 1);
  EXPECT_DOUBLE_EQ(island.caution, 4 / 1.2);
  EXPECT_FALSE(island.calm);
  EXPECT_GT(island.beta, 0);
}

}  // namespace
}  // namespace gambeson
