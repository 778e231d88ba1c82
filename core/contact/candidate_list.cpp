#include "core/contact/candidate_list.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

/// By trial on the drape over a sphere (tests/bench/README.md): of the values tried, between half and four times these,
/// none was quicker beyond the noise. They decide what a step costs, never what it finds.
constexpr double kSteps = 5;    ///< like the one that a list is made for
constexpr double kTremors = 3;  ///< ways off the path, in units of what is usual in a step
constexpr double kLeastSlack_m = 1e-4;
constexpr double kLeastChange = 0.2;  ///< of gradients
constexpr double kMemory = 16;        ///< steps of which drift and tremor are means

/// Positions that agree to this have gradients that agree to a part in a million of kLeastChange on edges of 0.1 mm.
constexpr double kSame_m = 1e-12;

bool within(std::span<const double> moved, std::span<const double> slack) {
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (!(moved[i] <= slack[i])) return false;
  return true;
}

}  // namespace

void CandidateList::begin(double start_s, double end_s, std::span<const Vec3> x0) {
  const double passed = start_s - start_s_;
  if (x0_.size() != x0.size()) {
    drift_.assign(x0.size(), {});
    tremor2_.assign(x0.size(), 0.0);
  } else if (passed > 0) {
    for (std::size_t i = 0; i < x0.size(); ++i) {
      const Vec3 change = (x0[i] - x0_[i]) / passed - drift_[i];
      drift_[i] += (1 / kMemory) * change;
      tremor2_[i] += (1 / kMemory) * (norm2(change) - tremor2_[i]);
    }
  }
  x0_.assign(x0.begin(), x0.end());
  start_s_ = start_s;
  end_s_ = end_s;
  start_moved_.clear();
}

void CandidateList::leavePath(std::span<const Vec3> x, double time_s, std::vector<double>& out) const {
  const double t = time_s - listed_s_;
  out.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = norm(x[i] - listed_at_[i] - t * listed_velocity_[i]);
}

/// The gradients do at x0, which most often is where the last step was found to end.
bool CandidateList::startHolds() const {
  bool same = last_end_.size() == x0_.size();
  for (std::size_t i = 0; same && i < x0_.size(); ++i) same = norm2(x0_[i] - last_end_[i]) < kSame_m * kSame_m;
  return same || tree_.gradientsHold(x0_);
}

bool CandidateList::holds(std::span<const Vec3> x1) {
  if (listed_at_.size() != x0_.size() || start_s_ < listed_s_ || end_s_ > listed_s_ + horizon_s_) return false;
  if (start_moved_.empty()) {
    leavePath(x0_, start_s_, start_moved_);
    if (!within(start_moved_, slack_m_) || !startHolds()) return false;
  }
  leavePath(x1, end_s_, moved_);
  if (!within(moved_, slack_m_) || !tree_.gradientsHold(x1)) return false;
  last_end_.assign(x1.begin(), x1.end());
  return true;
}

void CandidateList::make(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules,
                         std::span<const Vec3> x1) {
  const double dt = end_s_ - start_s_;
  listed_s_ = start_s_;
  horizon_s_ = kSteps * dt;
  listed_at_ = x0_;
  listed_velocity_ = drift_;
  slack_m_.resize(x0_.size());
  for (std::size_t i = 0; i < x0_.size(); ++i)
    slack_m_[i] = kLeastSlack_m + kTremors * dt * std::sqrt(tremor2_[i]) + 2 * norm(x1[i] - x0_[i] - dt * drift_[i]);
  tree_.gradientChanges(mesh, x0_, x1, change_);
  for (double& c : change_) c = std::max(kSteps * c, kLeastChange);
  const ListedMotion motion{listed_at_, listed_velocity_, slack_m_, horizon_s_};
  tree_.refit(mesh, motion, change_);
  collector.collect(mesh, tree_, motion, rules, pairs_);
  start_moved_.assign(x0_.size(), 0);
  leavePath(x1, end_s_, moved_);
  last_end_.clear();
  ++builds_;
}

void CandidateList::cover(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules,
                          std::span<const Vec3> x1) {
  if (!holds(x1)) make(mesh, collector, rules, x1);
  for (std::size_t i = 0; i < moved_.size(); ++i) moved_[i] = std::max(moved_[i], start_moved_[i]);
  edge_moved_.resize(mesh.edges.size());
  for (std::size_t e = 0; e < edge_moved_.size(); ++e)
    edge_moved_[e] = std::max(moved_[mesh.edges[e][0]], moved_[mesh.edges[e][1]]);
  triangle_moved_.resize(mesh.triangles.size());
  for (std::size_t t = 0; t < triangle_moved_.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    triangle_moved_[t] = std::max({moved_[a], moved_[b], moved_[c]});
  }
}

}  // namespace gambeson
