#include "core/contact/candidate_list.hpp"
#include "core/math/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// These were found by trial on the drape over a sphere (tests/bench/README.md). They decide what a step costs, never
/// what it finds.
constexpr int kProbe = 4;        ///< steps, about as many as a list serves
constexpr double kMemory = 16;   ///< steps of which corrections and strays are means
constexpr double kStrays = 3;    ///< ways off the path, in units of what is usual at the end of a probe
constexpr double kHorizon = 10;  ///< steps like the one that a list is made for
constexpr double kLeastSlack_m = 1e-4, kLeastSlack = 0.04;  ///< and of the margin: some vertex does what it never did
constexpr double kBodySlack_m = 4e-5;                       ///< for bodies, whose motions are smooth
constexpr int kMended = 64;                                 ///< one in so many vertices of cloth at a time

/// Calls f(i) for all i below n.
template <class F>
void each(std::size_t n, F&& f) {
  const int count = static_cast<int>(n);
  forAll(Each::value, count, [&](int i) { f(i); });
}

void copyAll(std::span<const Vec3> from, std::vector<Vec3>& to) {
  to.resize(from.size());
  each(from.size(), [&](int i) { to[i] = from[i]; });
}

}  // namespace

/// What the step that has passed tells.
void CandidateList::learn(double passed_s, double now_s, std::span<const Vec3> x) {
  const double share = 1 / std::min(kMemory, static_cast<double>(++steps_));
  each(told_.size(),
       [&](int i) { correction_[i] += share * ((x[i] - x0_[i]) / passed_s - told_[i] - correction_[i]); });
  if (probe_steps_ < 0 || ++probe_steps_ < kProbe) return;
  const double t = now_s - probe_s_, probe_share = std::max(kProbe / kMemory, 1.0 / ++probes_);
  each(x.size(), [&](int i) {
    strays2_[i] += probe_share * (norm2(x[i] - probe_at_[i] - t * probe_velocity_[i]) - strays2_[i]);
  });
  probe_steps_ = -1;
}

void CandidateList::begin(double start_s, double end_s, std::span<const Vec3> x0) {
  if (x0_.size() != x0.size()) {
    correction_.assign(x0.size(), {});
    strays2_.assign(x0.size(), 0.0);
    steps_ = probes_ = 0;
    probe_steps_ = -1;
  } else if (start_s > start_s_) {
    learn(start_s - start_s_, start_s, x0);
  }
  told_.clear();
  copyAll(x0, x0_);
  start_s_ = start_s;
  end_s_ = end_s;
  start_moved_.clear();
}

/// Of the first end that a step is told of, as it would be without contact.
void CandidateList::expect(std::span<const Vec3> x1) {
  const double dt = end_s_ - start_s_;
  told_.resize(x0_.size());
  expected_.resize(x0_.size());
  each(x0_.size(), [&](int i) {
    told_[i] = (x1[i] - x0_[i]) / dt;
    expected_[i] = told_[i] + correction_[i];
  });
  if (probe_steps_ >= 0) return;
  copyAll(x0_, probe_at_);
  copyAll(expected_, probe_velocity_);
  probe_s_ = start_s_;
  probe_steps_ = 0;
}

/// How far vertices are off their paths, and no less than they were before; whether all keep within their slack.
bool CandidateList::leavePath(std::span<const Vec3> x, double time_s, std::span<const double> before_m,
                              std::vector<double>& out) const {
  const double t = time_s - listed_s_;
  out.resize(x.size());
  return countOf(Each::value, static_cast<int>(x.size()), [&](int i) {
           const double off = norm(x[i] - listed_at_[i] - t * listed_velocity_[i]);
           out[i] = before_m.empty() ? off : std::max(off, before_m[i]);
           return !(out[i] <= slack_m_[i]);
         }) == 0;
}

/// Whether the list still holds for the step to x1, except for what its straying vertices of cloth ask for (mend).
bool CandidateList::holds(std::span<const Vec3> x1) {
  if (listed_at_.size() != x0_.size() || start_s_ < listed_s_ || end_s_ > listed_s_ + horizon_s_) return false;
  if (start_moved_.empty()) {
    leavePath(x0_, start_s_, {}, start_moved_);
    if (!bluntness_.holds(x0_)) return false;
  }
  kept_ = leavePath(x1, end_s_, start_moved_, moved_);
  return true;
}

/// Where this step leaves the paths, a vertex may do so once more.
double CandidateList::slackFor(int vertex, double least, std::span<const Vec3> x1) const {
  return least + kStrays * std::sqrt(strays2_[vertex]) +
         2 * norm(x1[vertex] - x0_[vertex] - (end_s_ - start_s_) * expected_[vertex]);
}

/// New paths for vertices that stray, where these are few and of cloth.
bool CandidateList::mend(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules,
                         std::span<const Vec3> x1) {
  if (kept_) return true;
  const int cloth = std::min<int>(tree_.firstObstacleVertex(), static_cast<int>(x0_.size()));
  strays_.clear();
  for (int i = 0; i < static_cast<int>(x0_.size()); ++i) {
    if (moved_[i] <= slack_m_[i]) continue;
    if (i >= cloth || kMended * std::ssize(strays_) >= cloth) return false;
    strays_.push_back(i);
  }
  for (int i : strays_) {
    listed_velocity_[i] = expected_[i];
    listed_at_[i] = x0_[i] - (start_s_ - listed_s_) * expected_[i];
    slack_m_[i] = slackFor(i, slack_m_[i], x1);
    start_moved_[i] = 0;
    moved_[i] = norm(x1[i] - x0_[i] - (end_s_ - start_s_) * expected_[i]);
  }
  tree_.refitSome(mesh, listedMotion(), strays_);
  collector.mend(mesh, tree_, listedMotion(), rules, pairs_);
  ++mends_;
  return true;
}

void CandidateList::make(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules,
                         std::span<const Vec3> x1) {
  listed_s_ = start_s_;
  horizon_s_ = kHorizon * (end_s_ - start_s_);
  copyAll(x0_, listed_at_);
  copyAll(expected_, listed_velocity_);
  slack_m_.resize(x0_.size());
  const int first_of_bodies = tree_.firstObstacleVertex();
  const double least = std::max(kLeastSlack_m, kLeastSlack * rules.margin_m);
  each(x0_.size(), [&](int i) { slack_m_[i] = slackFor(i, i < first_of_bodies ? least : kBodySlack_m, x1); });
  tree_.refit(mesh, listedMotion());
  if (!bluntness_.empty()) bluntness_.ask(mesh, listedMotion(), tree_.reachOfCloth(rules));
  collector.collect(mesh, tree_, listedMotion(), rules, pairs_, bluntness_.empty() ? nullptr : &bluntness_.features());
  start_moved_.assign(x0_.size(), 0);
  leavePath(x1, end_s_, {}, moved_);
  ++builds_;
}

void CandidateList::cover(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules,
                          std::span<const Vec3> x1) {
  if (told_.empty()) expect(x1);
  if (!holds(x1) || !mend(mesh, collector, rules, x1)) make(mesh, collector, rules, x1);
  most_moved_ = largestOf(Each::value, static_cast<int>(moved_.size()), 0.0, [&](int i) { return moved_[i]; });
}

}  // namespace gambeson
