#pragma once
/// Pairs of primitives that may touch, kept from step to step for as long as that is certain.

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/contact/bluntness.hpp"
#include "core/contact/pairs.hpp"

namespace gambeson {

/// A list is made for a motion (ListedMotion): each vertex goes on with the velocity that the step is told of first,
/// put right by what contact made of it in the last steps, and may leave that path by a few times the way by which it
/// left such paths before. As long as all vertices do that, the list is
/// complete, and each pair on it has a lower bound of its distance that costs two subtractions. Where a few vertices of
/// cloth stray farther they are given new paths, from there on, and the list is mended around them. Both ends of the
/// straight paths of a step are checked, and so all between. What a query finds does not depend on when its list was
/// made or mended.
class CandidateList {
 public:
  CandidateList() = default;
  /// `bluntness`: of bodies that deform; what is blunt for as long as the list lasts matters to it like BluntFeatures.
  explicit CandidateList(ContactTree tree, Bluntness bluntness = {})
      : tree_(std::move(tree)), bluntness_(std::move(bluntness)) {}

  bool empty() const { return tree_.empty(); }

  /// The next step: from x0 at start_s to positions at end_s that `cover` is told.
  void begin(double start_s, double end_s, std::span<const Vec3> x0);
  /// Sees to it that the list holds all pairs that come within the margin of each other between x0 and x1.
  void cover(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules, std::span<const Vec3> x1);

  const CandidatePairs& pairs() const { return pairs_; }
  /// The pair is at least that far apart all the way from x0 to x1.
  double apart(const ContactMesh& mesh, const PointTriangle& p) const {
    return alongPaths(p) - moved_[p.vertex] - most(mesh.triangles[p.triangle]);
  }
  double apart(const ContactMesh& mesh, const EdgeEdge& p) const {
    return alongPaths(p) - most(mesh.edges[p.a]) - most(mesh.edges[p.b]);
  }
  /// Whether `apart` may be less than `reach_m`: cheap where the pair is far apart whatever its vertices do.
  template <class Pair>
  bool mayCome(const ContactMesh& mesh, const Pair& p, double reach_m) const {
    return alongPaths(p) - most_moved_ - most_moved_ < reach_m && apart(mesh, p) < reach_m;
  }
  int builds() const { return builds_; }  ///< so far
  int mends() const { return mends_; }    ///< likewise

 private:
  void learn(double passed_s, double now_s, std::span<const Vec3> x);
  void expect(std::span<const Vec3> x1);
  bool holds(std::span<const Vec3> x1);
  bool mend(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules, std::span<const Vec3> x1);
  double slackFor(int vertex, double least, std::span<const Vec3> x1) const;
  ListedMotion listedMotion() const { return {listed_at_, listed_velocity_, slack_m_, horizon_s_}; }
  void make(const ContactMesh& mesh, const PairCollector& collector, const PairRules& rules, std::span<const Vec3> x1);
  bool leavePath(std::span<const Vec3> x, double time_s, std::span<const double> before_m,
                 std::vector<double>& out) const;
  /// The same of two primitives that keep to their paths.
  double alongPaths(const auto& pair) const { return pair.apart.within(start_s_ - listed_s_, end_s_ - listed_s_); }
  template <std::size_t N>
  double most(const std::array<int, N>& vertices) const {
    double far = moved_[vertices[0]];
    for (std::size_t k = 1; k < N; ++k) far = std::max(far, moved_[vertices[k]]);
    return far;
  }

  ContactTree tree_;
  Bluntness bluntness_;
  CandidatePairs pairs_;
  std::vector<Vec3> x0_;  ///< of this step
  double start_s_ = 0, end_s_ = 0;
  // How the vertices move. Now and then a probe of some steps is opened, to see how far off their paths they are then.
  std::vector<Vec3> told_, expected_;  ///< velocity of this step as it was told of first [m/s], and put right
  std::vector<Vec3> correction_;       ///< what the velocities of the last steps differed from `told_` by, in the mean
  std::vector<double> strays2_;        ///< mean square of the distance from the path at the end of a probe [m^2]
  std::vector<Vec3> probe_at_, probe_velocity_;
  double probe_s_ = 0;
  int steps_ = 0, probes_ = 0;  ///< that have taught
  int probe_steps_ = -1;        ///< so far; -1: none is open
  // What the list was made for.
  std::vector<Vec3> listed_at_, listed_velocity_;
  std::vector<double> slack_m_;
  double listed_s_ = 0, horizon_s_ = 0;
  // How far each vertex is off its path: at x0 (empty: not looked at yet), and the most in this step.
  std::vector<double> start_moved_, moved_;
  double most_moved_ = 0;    ///< the largest of moved_
  bool kept_ = false;        ///< all have kept within their slack
  std::vector<int> strays_;  ///< scratch
  int builds_ = 0, mends_ = 0;
};

}  // namespace gambeson
