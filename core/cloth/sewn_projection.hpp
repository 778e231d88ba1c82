#pragma once
/// The projection on what sewn rows allow, in the metric of the points' masses.

#include <span>
#include <vector>

#include "core/cloth/sewn_rows.hpp"
#include "core/math/envelope.hpp"

namespace gambeson {

/// Of rows C and inverse masses W (0: held points),
///   v' = v - W C^T lambda,   (C W C^T) lambda = C v - r,
/// the velocities nearest to v (in kinetic energy) whose gaps change at the rates r. C and W are constant, and so the
/// factor is made once. Impulses - C^T lambda sum to 0, and their moment is that of the gaps (SewnRows). Constant after
/// it is built; scratch is the caller's.
class SewnProjection {
 public:
  struct Work {
    std::vector<Vec3> lambda, factor, moved;
  };

  SewnProjection() = default;
  SewnProjection(SparseRows C, std::vector<double> inverse_mass);

  int rows() const { return C_.rows(); }
  bool empty() const { return rows() == 0; }
  /// Rows that follow from others, or that no free point changes.
  int dependent() const { return factor_.leftOut(); }
  /// Points that some row takes hold of, ascending.
  const std::vector<int>& points() const { return points_; }
  /// A row that takes hold of points()[k].
  int rowOf(std::size_t k) const { return Ct_.columns[Ct_.offsets[k]]; }
  /// What the rows take of the mobility, H = W C^T (C W C^T)^-1 C W with v' = (W - H) i of impulses i: a row for each
  /// of points(), less entries below `least` sqrt(W_i W_j). They fall off along a seam, by 4 or so from hat to hat.
  SparseRows ties(double least) const;

  /// C x.
  void gaps(std::span<const Vec3> x, std::vector<Vec3>& g) const;
  /// Projects v; `rates` r of the rows, empty: 0. Adds the impulses - C^T lambda on all points, held ones too, to
  /// `impulse` where that is not empty. Twice, so that what rounding has left of the rows is taken as well.
  void project(std::span<Vec3> v, std::span<const Vec3> rates, std::span<Vec3> impulse, Work& work) const {
    project(v, rates, impulse, {}, work);
  }
  /// The same of rows that are not `open`, one flag each (empty: none is). Those that are share no points with others.
  void project(std::span<Vec3> v, std::span<const Vec3> rates, std::span<Vec3> impulse, std::span<const char> open,
               Work& work) const;
  /// Once, without rates: W i in, what is left of it out.
  void hold(std::span<Vec3> change, std::span<const char> open, Work& work) const;
  void hold(std::span<Vec3> change, Work& work) const { hold(change, {}, work); }

 private:
  void takeOff(std::span<Vec3> v, std::span<Vec3> impulse, std::span<const char> open, Work& work) const;

  SparseRows C_, Ct_;  ///< Ct: of `points` alone
  std::vector<int> points_;
  std::vector<double> inverse_mass_;
  EnvelopeFactor factor_;
};

/// The points nearest to q (least sum of weight |change|^2, weights > 0) with C q = 0: panels that stand near each
/// other are closed.
std::vector<Vec3> closeSeams(const SewnRows& rows, std::span<const double> weight, std::span<const Vec3> q);

}  // namespace gambeson
