#pragma once
/// Supports of a structure in motion: they hold components of points, couple points, or move.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/cloth/strain_rows.hpp"
#include "core/contact/response.hpp"
#include "core/math/cholesky.hpp"
#include "core/motion/held_directors.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

/// What the supports of a structure leave of the motion of its free points, p = rest + C y + shifts(t) (DofMap), with
/// masses M and damping D of the points. Constant after it is built. Lives no longer than the structure.
class Supports {
 public:
  /// Masses are positive.
  Supports(const Structure& structure, std::span<const double> mass_kg, std::span<const double> damping_kg_per_s);

  /// Points that they hold whole, and all that they take hold of at all (held whole, in parts, or with others).
  const std::vector<char>& held() const { return held_; }
  const std::vector<int>& bound() const { return bound_; }
  bool binds(int point) const { return binds_[static_cast<std::size_t>(point)]; }
  /// Whether impulses on some points move others, or other components: else each point has its own mass or none moves
  /// it.
  bool couple() const { return couples_; }

  /// Positions of what is not free follow what is, as prescribed at time t.
  void place(double t, std::span<Vec3> p) const;
  /// Velocities of what is not free follow what is; prescribed: the mean from t0 to t1.
  void drive(double t0, double t1, std::span<Vec3> v) const;
  /// Prescribed accelerations at t, from second differences over dt_s, are added.
  void addPrescribed(double t, double dt_s, std::span<Vec3> a) const;

  /// Inner unknowns that supports hold or turn (a clamp those of its edge) are where the points and time t say. They
  /// have no inertia of their own, and what acts on them acts on the points.
  void placeInner(double t, std::span<const Vec3> p, std::span<double> inner) const;
  void handInner(std::span<double> inner_force, std::span<Vec3> f) const;

  /// a = C (Cᵀ (M + h D) C)^-1 Cᵀ f. Keeps the factor while h changes by rounding alone; of one Supports at a time.
  class Solver {
   public:
    void accelerations(const Supports& supports, double h_s, std::span<const Vec3> f, std::span<Vec3> a);

   private:
    const Supports* of_ = nullptr;
    double h_s_ = -1;
    std::unique_ptr<SymmetricFactor> factor_;
    std::vector<double> right_, solution_;
  };
  /// What is left of changes of velocity, M^-1 times impulses: P M change, with P = C (Cᵀ M C)^-1 Cᵀ.
  void hold(std::span<Vec3> change) const;
  /// How far impulses along n, with weights on some free points, move these, as a part of what they would without
  /// supports. Of supports that couple.
  double givesWay(std::span<const int> points, std::span<const double> weight, const Vec3& n) const;
  /// P M on some points alone (free points): three rows and columns each, in their order.
  SparseRows holdOf(std::span<const int> points) const;
  /// P.
  Mobility mobility() const;

 private:
  /// Cᵀ (M + h D) C, or the entry of an unknown where it is diagonal.
  SymmetricMatrix matrix(double h_s) const;
  SparseRows mobilityRows() const;
  double massOf(int unknown, double h_s) const;
  void findTurned();
  void addShifts(std::span<const double> value, std::span<Vec3> u) const;

  /// An inner unknown that follows components of points.
  struct Turned {
    int inner = 0;
    double start = 0;
    std::vector<std::pair<int, double>> terms;
    std::vector<double> shift;  ///< by program
  };

  const Structure& s_;
  DofMap dofs_;  ///< of the points
  std::vector<Turned> turned_;
  HeldDirectors directors_;
  std::vector<double> mass_kg_, damping_kg_per_s_;
  std::vector<char> held_, binds_;
  std::vector<int> bound_;
  bool moves_ = false, couples_ = false, damps_ = false;
  std::vector<int> guided_;  ///< components that are no unknowns of their own
  // Of those that couple components.
  bool diagonal_ = false;  ///< Cᵀ M C has no more than its diagonal, whatever M
  SparseRows squares_;     ///< of Cᵀ, where it is diagonal
  SparseRows mobility_;    ///< P
};

/// Supports, and the limits of strain under them where there are such, in the place of M^-1 for the contacts.
class SupportHold : public MotionHold {
 public:
  /// `limits`: null or what comes after the supports.
  SupportHold(const Supports& supports, const MotionHold* limits) : supports_(supports), limits_(limits) {}
  bool bearsTension() const override { return limits_ != nullptr; }
  void hold(std::span<Vec3> change) const override;
  void touch(std::span<const int> points) override;
  void holdTouched(std::span<Vec3> change) const override;

 private:
  const Supports& supports_;
  const MotionHold* limits_;
  std::vector<int> points_;
  SparseRows touched_;  ///< of the supports alone
  mutable std::vector<Vec3> all_;
};

}  // namespace gambeson
