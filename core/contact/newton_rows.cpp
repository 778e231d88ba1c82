#include "core/contact/newton_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/contact/iteration_lanes.hpp"
#include "core/math/block_lu.hpp"

namespace gambeson {
namespace {

using Island = ContactWork::Island;

constexpr int kFactors = 80;                                          ///< of an island at most
constexpr int kRounds = 60;                                           ///< proximal problems
constexpr int kOfOne = 10;                                            ///< of one proximal problem
constexpr int kFew = 3;                                               ///< after which s may grow
constexpr double kFirst = 5e3, kLeast = 10, kMost = 1e8, kGrows = 5;  ///< s
constexpr double kInner = 0.1;  ///< what the equations of the points may leave, of the goal
constexpr int kHalvings = 8;    ///< of a step

/// One island's equations.
class Equations {
 public:
  Equations(const Island& island, ContactWork& work)
      : w_(work),
        island_(island),
        n_(island.free_end - island.free_point),
        known_(island.row_end - island.row),
        velocity_(n_),
        left_(n_),
        lu_(factorOf(island, work)) {
    for (int i = 0; i < n_; ++i) velocity_[i] = vec(w_.moved[island_.free_point + i]);
    for (std::size_t k = 0; k < known_.size(); ++k) known_[k] = vec(w_.candidate[island_.row + k]);
  }

  /// Newton's method from the velocities as they are. False: not solved, and these are what they were.
  bool solve(double s, double goal, int& factors) {
    const std::vector<Vec3> start = velocity_;
    for (int taken = 0;; ++taken) {
      assemble(s, taken < kOfOne);
      if (largestLeft() <= kInner * goal) {
        taken_ = taken;
        return true;
      }
      ++factors;
      if (taken == kOfOne || !go(s)) break;
    }
    velocity_ = start;
    return false;
  }

  int taken() const { return taken_; }  ///< factorisations of the last problem that was solved

  /// The tractions of the problem are known from now on, and the work's.
  void accept(double s) {
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const int row = island_.row + static_cast<int>(k);
      known_[k] = tractionOf(row, s, nullptr);
      w_.candidate[row] = quadOf(known_[k]);
    }
    for (int f = island_.free_point; f < island_.free_end; ++f) w_.moved[f] = w_.base[f];
    for (int row = island_.row; row < island_.row_end; ++row) {
      const Vec3 impulse = w_.row_area[row] * vec(w_.candidate[row]);
      eachPoint(row, [&](int f, double weight) {
        w_.moved[f] = quadOf(vec(w_.moved[f]) + (weight * w_.inverse_mass[f]) * impulse);
      });
    }
    for (int i = 0; i < n_; ++i) velocity_[i] = vec(w_.moved[island_.free_point + i]);
  }

 private:
  static BlockLu factorOf(const Island& island, const ContactWork& w) {
    const auto first = w.points.offsets.begin();
    std::vector<int> offsets(first + island.row, first + island.row_end + 1);
    std::vector<int> members(w.points.columns.begin() + offsets.front(), w.points.columns.begin() + offsets.back());
    for (int& f : members) f -= island.free_point;
    const int begin = offsets.front();
    for (int& o : offsets) o -= begin;
    return {island.free_end - island.free_point, offsets, members};
  }

  template <class Visit>
  void eachPoint(int row, const Visit& visit) const {
    for (int e = w_.points.offsets[row]; e < w_.points.offsets[row + 1]; ++e)
      visit(w_.points.columns[e], w_.points.values[e]);
  }

  /// tau of a row at the velocities as they are; `slope`: of it and -v.
  Vec3 tractionOf(int row, double s, Eigen::Matrix3d* slope) const {
    const ContactWork::Row& facts = w_.facts[row];
    Vec3 v = -facts.drift;
    eachPoint(row, [&](int f, double weight) { v += weight * velocity_[f - island_.free_point]; });
    const double sigma = s / facts.slope, gives = sigma * facts.compliance / (1 + sigma * facts.compliance);
    const Vec3 rigid = known_[row - island_.row] - sigma * v, &n = facts.normal;
    const Vec3 trial = rigid - (gives * dot(rigid, n)) * n;
    const double normal[3] = {n.x, n.y, n.z}, p[3] = {trial.x, trial.y, trial.z};
    double cut[3], by_trial[9];
    coulombImpulse<only_resultants | with_slope>(facts.friction, facts.drag, normal, p, cut, by_trial);
    if (slope) {
      const Eigen::Map<const Eigen::Vector3d> along(normal);
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> of(by_trial);
      *slope = sigma * (of - gives * (of * along) * along.transpose());
    }
    return {cut[0], cut[1], cut[2]};
  }

  /// left = M (v - base) - B^T a tau, and the matrix of its slope.
  void assemble(double s, bool with_matrix) {
    if (with_matrix) lu_.clear();
    for (int i = 0; i < n_; ++i) {
      const int f = island_.free_point + i;
      left_[i] = (1 / w_.inverse_mass[f]) * (velocity_[i] - vec(w_.base[f]));
      if (with_matrix) lu_.add(i, i, Eigen::Matrix3d::Identity() / w_.inverse_mass[f]);
    }
    Eigen::Matrix3d slope;
    for (int row = island_.row; row < island_.row_end; ++row) {
      const Vec3 impulse = w_.row_area[row] * tractionOf(row, s, with_matrix ? &slope : nullptr);
      eachPoint(row, [&](int f, double weight) { left_[f - island_.free_point] -= weight * impulse; });
      if (!with_matrix || slope.isZero(0)) continue;
      slope *= w_.row_area[row];
      eachPoint(row, [&](int f, double of_f) {
        eachPoint(row, [&](int g, double of_g) {
          lu_.add(f - island_.free_point, g - island_.free_point, (of_f * of_g) * slope);
        });
      });
    }
  }

  /// [m/s]
  double largestLeft() const {
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      const double of = w_.inverse_mass[island_.free_point + i] * norm(left_[i]);
      if (!(of <= largest)) largest = of;  // also what is no number
    }
    return largest;
  }

  double energyLeft() const {
    double sum = 0;
    for (int i = 0; i < n_; ++i) sum += w_.inverse_mass[island_.free_point + i] * norm2(left_[i]);
    return sum;
  }

  /// One step of Newton's method, as far as what is left becomes less. False: it does not.
  bool go(double s) {
    const double before = energyLeft();
    if (!std::isfinite(before) || !lu_.factorise()) return false;
    std::vector<Vec3> way = left_;
    lu_.solve(way);
    const std::vector<Vec3> from = velocity_;
    double part = 1;
    for (int k = 0; k <= kHalvings; ++k, part *= 0.5) {
      for (int i = 0; i < n_; ++i) velocity_[i] = from[i] - part * way[i];
      assemble(s, false);
      if (energyLeft() < before) return true;
    }
    return false;
  }

  ContactWork& w_;
  const Island& island_;
  int n_;
  std::vector<Vec3> known_;  ///< tau_k
  std::vector<Vec3> velocity_, left_;
  BlockLu lu_;
  int taken_ = 0;
};

double residualOf(const Island& island, const ContactWork& w) {
  double largest2 = 0;
  for (int k = island.row; k < island.row_end; ++k)
    largest2 = std::max(largest2, residual2(velocityOf(w, k), vec(w.candidate[k]), w.facts[k]));
  return std::sqrt(largest2);
}

void finish(double goal, Island& island, ContactWork& w) {
  const auto rows = [&](std::vector<Quad>& of) {
    return std::span(of).subspan(island.row, island.row_end - island.row);
  };
  const auto points = [&](std::vector<Quad>& of) {
    return std::span(of).subspan(island.free_point, island.free_end - island.free_point);
  };
  const std::vector<Quad> candidate(rows(w.candidate).begin(), rows(w.candidate).end());
  const std::vector<Quad> moved(points(w.moved).begin(), points(w.moved).end());
  Equations equations(island, w);
  int factors = 0;
  double s = kFirst;
  for (int round = 0; round < kRounds && factors < kFactors && s >= kLeast; ++round) {
    if (!equations.solve(s, goal, factors)) {
      s /= kGrows;
      continue;
    }
    equations.accept(s);
    if (equations.taken() <= kFew) s = std::min(kGrows * s, kMost);
    const double residual = residualOf(island, w);
    if (!std::isfinite(residual)) break;
    if (residual > goal) continue;
    island.residual_m_per_s = residual;
    island.done = true;
    break;
  }
  island.iterations += factors;
  if (!island.done) {
    std::ranges::copy(candidate, rows(w.candidate).begin());
    std::ranges::copy(moved, points(w.moved).begin());
    return;
  }
  std::ranges::copy(rows(w.candidate), rows(w.previous).begin());
  std::ranges::copy(points(w.moved), points(w.moved_before).begin());
  island.momentum = 1;
  island.beta = 0;
}

}  // namespace

void finishByNewton(double goal, ContactWork& w) {
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < w.islands.size(); ++i)
    if (!w.islands[i].done && !w.islands[i].held) finish(goal, w.islands[i], w);
}

}  // namespace gambeson
