/// Places that halve points, and parts of items that are halved with them.

#include "core/contact/halving.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

namespace gambeson {
namespace {

std::vector<Vec3> anyPoints(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> d(-1, 1);
  std::vector<Vec3> x;
  for (int i = 0; i < count; ++i) x.push_back({3 * d(random), d(random), 0.1 * d(random)});
  return x;
}

/// Of points by their places: whichever half, the one has no point beyond the other's along its longest extent.
void expectHalves(const std::vector<Vec3>& x, int first, int end) {
  if (end - first < 2) return;
  Vec3 extent;
  for (int axis = 0; axis < 3; ++axis)
    for (int a = first; a < end; ++a)
      for (int b = first; b < end; ++b) extent[axis] = std::max(extent[axis], x[a][axis] - x[b][axis]);
  const int axis = static_cast<int>(std::max_element(&extent.x, &extent.x + 3) - &extent.x);
  const int middle = middleOf(first, end);
  double most = -1e9, least = 1e9;
  for (int k = first; k < middle; ++k) most = std::max(most, x[k][axis]);
  for (int k = middle; k < end; ++k) least = std::min(least, x[k][axis]);
  EXPECT_LE(most, least);
  expectHalves(x, first, middle);
  expectHalves(x, middle, end);
}

TEST(Halving, PlacesHalvePointsAlongTheirLongestExtent) {
  for (int count : {0, 1, 2, 3, 37, 200}) {
    const std::vector<Vec3> x = anyPoints(count);
    const std::vector<int> place = halvedPlaces(x);
    std::vector<Vec3> sorted(x.size());
    std::vector<char> taken(x.size(), 0);
    for (int i = 0; i < count; ++i) {
      EXPECT_FALSE(std::exchange(taken[place[i]], 1));
      sorted[place[i]] = x[i];
    }
    expectHalves(sorted, 0, count);
  }
}

TEST(Halving, PointsOfOnePositionKeepTheirOrder) {
  const std::vector<Vec3> x(9, Vec3{1, 2, 3});
  EXPECT_EQ(halvedPlaces(x), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
}

/// Every item is in one part; parts end at halves of the places, are small enough, and no larger part would be.
TEST(Halving, PartsAreTheLargestThatAreSmallEnough) {
  std::mt19937 random(12);
  const int places = 300, most = 20;
  for (int items : {1, 20, 21, 500}) {
    std::vector<int> at;
    for (int i = 0; i < items; ++i) at.push_back(static_cast<int>(random() % (i % 2 ? places : 30)));
    std::sort(at.begin(), at.end());
    const auto place = [&](int i) { return at[i]; };
    const auto within = [&](int first, int end) {
      return std::count_if(at.begin(), at.end(), [&](int p) { return p >= first && p < end; });
    };
    int next = 0;
    for (int k = 0; k < items; ++k) {
      int begin = 0, end = items;
      halveAround(k, places, most, place, begin, end);
      EXPECT_EQ(begin, k < next ? begin : next);
      EXPECT_TRUE(begin <= k && k < end);
      next = end;
      EXPECT_LE(end - begin, most);
      // The way down to it.
      int first = 0, last = places;
      while (within(first, last) > most) (at[k] < middleOf(first, last) ? last : first) = middleOf(first, last);
      EXPECT_EQ(end - begin, within(first, last));
    }
    EXPECT_EQ(next, items);
  }
}

TEST(Halving, ItemsOfOnePlaceAreOnePart) {
  const std::vector<int> at{2, 2, 2, 2, 2, 5};
  for (int k = 0; k < 6; ++k) {
    int begin = 0, end = 6;
    halveAround(
        k, 8, 3, [&](int i) { return at[i]; }, begin, end);
    EXPECT_EQ(begin, k < 5 ? 0 : 5);
    EXPECT_EQ(end, k < 5 ? 5 : 6);
  }
}

}  // namespace
}  // namespace gambeson
