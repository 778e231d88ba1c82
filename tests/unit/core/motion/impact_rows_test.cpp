/// Rows of hits: each takes the place of the row that is of the same sample and obstacle, or the same pair.

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/motion/step_contact.hpp"
#include "core/motion/step_rows.hpp"

namespace gambeson {
namespace {

constexpr double kStep_s = 1e-3;

struct Rows {
  Model model;
  StepWork work;

  Rows() {
    model.contact.relaxation_s = 0.01;
    model.layer_m.assign(40, 1e-3);
    work.stage.start.obstacles = work.stage.end.obstacles = std::vector<Placement>(3);
  }
  void addLasting(int sample, int obstacle) { put(bodyRow(at(sample, obstacle), {}, 0, false)); }
  void addImpact(int sample, int obstacle) { put(bodyRow(at(sample, obstacle), {}, 0, true)); }
  void addPair(const std::array<int, 3>& pair) { put(ofPair(pair)); }
  void hit(int sample, int obstacle) {
    SampleHit h;
    static_cast<Contact&>(h) = at(sample, obstacle);
    work.hits.push_back(h);
  }
  void hitPair(const std::array<int, 3>& pair) {
    PairHit h;
    h.edges = pair[0] == 1, h.a = pair[1], h.b = pair[2];
    h.row = ofPair(pair);
    work.pair_hits.push_back(h);
  }
  void take(int round) {
    addImpacts(model, {}, kStep_s, round, work);
    work.hits.clear(), work.pair_hits.clear();
  }
  int count() const { return static_cast<int>(work.rows.size()); }
  /// A gap tells a row from the others: each that is made has another.
  double gap(int row) const { return work.rows.at(static_cast<std::size_t>(row)).contact.gap_m; }

 private:
  Contact at(int sample, int obstacle) {
    Contact c;
    c.sample = sample, c.obstacle = obstacle, c.normal = {0, 0, 1};
    c.gap_m = 1e-6 * ++made_;
    return c;
  }
  ContactRow ofPair(const std::array<int, 3>& pair) {
    ContactRow row = bodyRow(at(pair[1], 0), {}, 0, true);
    row.stencil.add(pair[2], -1);
    row.pair = pair;
    return row;
  }
  void put(const ContactRow& row) {
    work.rows.push_back(row);
    work.warm.push_back({0, 0, static_cast<double>(work.rows.size())});
  }
  int made_ = 0;
};

TEST(ImpactRows, TakeThePlaceOfTheirOwn) {
  Rows r;
  r.addLasting(3, 0);
  r.addImpact(3, 1);
  r.addPair({1, 4, 7});
  r.addLasting(5, 0);
  r.hit(3, 1);           // gap 5: in the place of row 1
  r.hit(5, 1);           // 6: of another obstacle, a new row
  r.hitPair({1, 4, 7});  // 7: in the place of row 2
  r.hitPair({0, 4, 7});  // 8: no edges, a new row
  r.hitPair({1, 7, 4});  // 9: another pair, a new row
  r.take(1);
  ASSERT_EQ(r.count(), 7);
  const double expected[] = {1, 5, 7, 4, 6, 8, 9};
  for (int k = 0; k < 7; ++k) EXPECT_DOUBLE_EQ(r.gap(k), 1e-6 * expected[k]) << k;
  // Those that were there keep their tractions, the others begin without.
  for (int k = 0; k < 7; ++k) EXPECT_EQ(r.work.warm[static_cast<std::size_t>(k)].z, k < 4 ? k + 1 : 0) << k;
}

/// What lasts is added to in the first two rounds, and gives way from the third on.
TEST(ImpactRows, TakeThePlaceOfWhatLastsFromTheThirdRoundOn) {
  for (const int round : {1, 2, 3, 4}) {
    Rows r;
    r.addLasting(3, 0);
    r.hit(3, 0);
    r.take(round);
    EXPECT_EQ(r.count(), round > 2 ? 1 : 2) << round;
    EXPECT_TRUE(r.work.rows.back().impact) << round;
  }
}

/// Of many at random, as a search through all rows finds them.
TEST(ImpactRows, AreThoseOfASearchThroughAllRows) {
  std::mt19937 random(3);
  const auto below = [&](int n) { return std::uniform_int_distribution(0, n - 1)(random); };
  Rows r;
  for (int k = 0; k < 30; ++k) r.addLasting(k, below(3));
  int replaced = 0;
  for (int round = 1; round <= 4; ++round) {
    std::map<std::pair<int, int>, int> samples;
    std::map<std::array<int, 3>, int> pairs;
    while (samples.size() < 40) samples[{below(40), below(3)}] = 0;
    while (pairs.size() < 40) pairs[{below(2), below(12), below(12)}] = 0;
    for (const auto& [of, unused] : samples) r.hit(of.first, of.second);
    for (const auto& [pair, unused] : pairs) r.hitPair(pair);
    std::vector<ContactRow> expected = r.work.rows;
    const auto put = [&](const ContactRow& row, auto&& same) {
      const auto old = std::find_if(expected.begin(), expected.end(), same);
      if (old == expected.end())
        expected.push_back(row);
      else
        *old = row, ++replaced;
    };
    for (const SampleHit& h : r.work.hits)
      put(bodyRow(h, {}, 0, true), [&](const ContactRow& row) {
        return row.pair[0] < 0 && row.contact.sample == h.sample && row.contact.obstacle == h.obstacle &&
               (row.impact || round > 2);
      });
    for (const PairHit& h : r.work.pair_hits) put(h.row, [&](const ContactRow& row) { return row.pair == h.row.pair; });
    r.take(round);
    ASSERT_EQ(r.work.rows.size(), expected.size());
    ASSERT_EQ(r.work.warm.size(), expected.size());
    for (int k = 0; k < r.count(); ++k) {
      const ContactRow &row = r.work.rows[static_cast<std::size_t>(k)], &e = expected[static_cast<std::size_t>(k)];
      EXPECT_EQ(row.contact.gap_m, e.contact.gap_m) << k;
      EXPECT_EQ(row.pair, e.pair) << k;
    }
  }
  EXPECT_GT(replaced, 20);
}

}  // namespace
}  // namespace gambeson
